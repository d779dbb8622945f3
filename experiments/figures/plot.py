"""Figures 4 to 7 of Liu et al. 2017 (PLoS ONE 12(9): e0184206), and one of all methods, from the records of a run and, for Figure 4, its meshes.

plot.py DIR [--molecules A,B] [--methods A,B] [--compared A,B] [--figure4 FILE] [--dump FILE]

Reads DIR/records/<molecule>/<method>.json and writes DIR/figures/{fig4,fig5,fig6,fig7,methods}.{svg,png}; the same bytes for the same records.
Where three or more molecules have a row in the paper, Figures 5 to 7 show these alone, and the others are in fig5-extra-1, … of ten molecules each.
--figure4 names what `figure4_input.cpp` writes; without it there is no Figure 4, and what it needs but does not find is told in a line "note: …".
With --dump what was drawn is written to FILE as JSON: {"fig6": [{"row": 0, "column": 0, "bars": [[left, width, height], ...], "points": {},
"notes": []}, ...], "methods": [{"row": 0, "column": 0, "bars": [], "points": {"molecule": [[x, y], ...], ...}, "notes": ["failed", ...]}, ...]}.
"""

import argparse
import json
import pathlib
import sys

from drawing import save, set_style
from figure4 import FIGURE4_DPI, Missing, figure4
from figure5 import figure5
from histograms import figure6, figure7
from methods_figure import methods_figure
from run_records import Run, read_records

PAPER_FIGURES = {"fig5": figure5, "fig6": figure6, "fig7": figure7}
FEWEST_PAPER_MOLECULES = 3  # with fewer the paper's figures would say little: all molecules are in them
PAGE_MOLECULES = 10  # of a figure of the others


def pages_of(run):
    """What the figures of the paper are drawn of, by the ending of their names."""
    paper = run.paper_molecules()
    others = [molecule for molecule in run.molecules if molecule not in paper]
    if len(paper) < FEWEST_PAPER_MOLECULES:
        paper, others = (run.molecules, []) if len(run.molecules) <= PAGE_MOLECULES else (run.molecules[:PAGE_MOLECULES], run.molecules[PAGE_MOLECULES:])
    pages = {"": run.of(paper)}
    for page, first in enumerate(range(0, len(others), PAGE_MOLECULES), 1):
        pages[f"-extra-{page}"] = run.of(others[first:first + PAGE_MOLECULES])
    return pages


def remove_pages(folder):
    """Those of an earlier run, which may have been more."""
    for file in folder.glob("fig[567]-extra-*.*"):
        file.unlink()


def drawn_in(figure):
    """Every bar as it was drawn (left edge, width, height), the points of each series, and what is written among them."""
    panels = []
    for axes in figure.axes:
        spec = getattr(axes, "get_subplotspec", lambda: None)()
        patches = [patch for container in axes.containers for patch in container.patches]
        bars = [[float(patch.get_x()), float(patch.get_width()), float(patch.get_height())] for patch in patches]
        points = {line.get_gid(): [[float(x), float(y)] for x, y in zip(*line.get_data())] for line in axes.lines if line.get_gid()}
        notes = [text.get_text() for text in axes.texts]
        panels.append({"row": spec.rowspan.start if spec else 0, "column": spec.colspan.start if spec else len(panels), "bars": bars,
                       "points": points, "notes": notes})
    return panels


def parse_arguments():
    names = lambda text: [name for name in text.split(",") if name]  # noqa: E731
    parser = argparse.ArgumentParser(description="The paper's figures, and that of all methods, from the records of a run.")
    parser.add_argument("directory", type=pathlib.Path)
    parser.add_argument("--molecules", type=names, default=[], help="their order; by name if not given")
    parser.add_argument("--methods", type=names, default=[], help="their order; initial, smopt, then by name if not given")
    parser.add_argument("--compared", type=names, default=[], help="the methods of the figure of all methods, in their order; all if not given")
    parser.add_argument("--figure4", type=pathlib.Path, help="the molecule, its meshes and the pair that Figure 4 shows")
    parser.add_argument("--dump", type=pathlib.Path, help="write what was drawn to this file")
    return parser.parse_args()


def draw_figure4(run, description, folder, drawn):
    try:
        figure = figure4(run, json.loads(description.read_text(encoding="utf-8")))
    except Missing as missing:
        print(f"note: figure 4 is left out: {missing}")
        return
    drawn["fig4"] = drawn_in(figure)
    save(figure, folder, "fig4", FIGURE4_DPI)


def main():
    arguments = parse_arguments()
    records = read_records(arguments.directory / "records")
    if not records:
        sys.exit(f"{arguments.directory / 'records'}: no records")
    set_style()
    run = Run(records, arguments.molecules, arguments.methods, arguments.compared)
    folder = arguments.directory / "figures"
    folder.mkdir(parents=True, exist_ok=True)
    remove_pages(folder)
    drawn = {}
    figures = [(name + ending, draw, page) for ending, page in pages_of(run).items() for name, draw in PAPER_FIGURES.items()]
    for name, draw, page in [*figures, ("methods", methods_figure, run)]:
        figure = draw(page)
        drawn[name] = drawn_in(figure)
        save(figure, folder, name)
    if arguments.figure4:
        draw_figure4(run, arguments.figure4, folder, drawn)
    if arguments.dump:
        arguments.dump.write_text(json.dumps(drawn), encoding="utf-8")


if __name__ == "__main__":
    main()
