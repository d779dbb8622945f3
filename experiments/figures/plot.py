"""Figures 5, 6 and 7 of Liu et al. 2017 (PLoS ONE 12(9): e0184206), and one of all methods, from the records of a run and nothing else.

plot.py DIR [--molecules A,B] [--methods A,B] [--compared A,B] [--dump FILE]

Reads DIR/records/<molecule>/<method>.json and writes DIR/figures/{fig5,fig6,fig7,methods}.{svg,png}; the same bytes for the same records.
With --dump what was drawn is written to FILE as JSON: {"fig6": [{"row": 0, "column": 0, "bars": [[left, width, height], ...], "points": {}},
...], "methods": [{"row": 0, "column": 0, "bars": [], "points": {"molecule": [[x, y], ...], ...}, "notes": ["failed", ...]}, ...]}.
"""

import argparse
import json
import pathlib
import sys
import textwrap

try:
    import matplotlib
except ImportError:
    sys.exit(f"{sys.executable} has no matplotlib; install Debian's package python3-matplotlib, or set SMOPT_PYTHON to a Python that has it")

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402 (the backend comes first)

# Okabe and Ito's colours (2008), which stay apart for the colour-blind; the hatches keep them apart in black and white.
PREPARED = "initial, cavities deleted"
STYLES = {
    "initial": ("#999999", ""),
    PREPARED: ("#56B4E9", "//"),
    "smopt": ("#0072B2", ""),
    "laplacian": ("#E69F00", "\\\\"),
}
OTHER_STYLES = [("#009E73", "xx"), ("#D55E00", ".."), ("#CC79A7", "++"), ("#F0E442", "oo")]

PNG_DPI = 150  # 1500 pixels over a figure of ten inches
MESSAGE_WIDTH = 34  # characters a line of a failure's reason in a panel
MESSAGE_LINES = 8

THOUSANDS = matplotlib.ticker.FuncFormatter(lambda value, _: f"{value:,.0f}".replace(",", "\N{NO-BREAK SPACE}"))
PLAIN = matplotlib.ticker.FuncFormatter(lambda value, _: f"{value:g}")


def set_style():
    matplotlib.rcdefaults()  # no settings of the user's: the same picture everywhere
    matplotlib.rcParams.update({
        "font.family": "DejaVu Sans", "font.size": 10, "axes.titlesize": 11, "axes.spines.top": False, "axes.spines.right": False,
        "hatch.linewidth": 0.6, "figure.constrained_layout.w_pad": 0.08, "svg.hashsalt": "smopt", "savefig.dpi": PNG_DPI,
    })


def read_records(folder):
    records = {}
    for file in sorted(folder.glob("*/*.json")):
        record = json.loads(file.read_text(encoding="utf-8"))
        records[record["molecule"]["name"], record["method"]] = record
    return records


def is_done(record):
    return record is not None and record["status"] == "done"


def number(record, *keys):
    """The value at a path of keys; None where the case failed or has no such number."""
    value = record if is_done(record) else None
    for key in keys:
        value = value.get(key) if isinstance(value, dict) else None
    return value


def bar_value(record, quantity):
    """As `number`; None, too, where the method diverged: what is left is no surface, and its area would dwarf the others."""
    return None if number(record, "diverged_at_step") else number(record, "metrics", "after", quantity)


def why_no_bar(record):
    step = number(record, "diverged_at_step")
    return f"diverged at step {step}" if step else "none"


class Run:
    """The records with the order in which molecules and methods are shown."""

    def __init__(self, records, molecules, methods, compared):
        self.records = records
        self.molecules = molecules or sorted({molecule for molecule, _ in records})
        self.methods = methods or sorted({method for _, method in records}, key=lambda name: (name != "initial", name != "smopt", name))

        self.compared = compared or sorted({method for _, method in records}, key=lambda name: (name != "initial", name != "smopt", name))

    def record(self, molecule, method):
        return self.records.get((molecule, method))

    def records_of(self, molecule):
        return [self.records[molecule, method] for method in self.methods if (molecule, method) in self.records]

    def molecule_title(self, molecule):
        block = self.records_of(molecule)[0]["molecule"]
        labels = {"stand-in": " (stand-in)", "near-copy": " (near copy)"}
        return block["title"] + labels.get(block["role"], "")

    def method_title(self, method):
        titles = [record["method_title"] for (_, name), record in self.records.items() if name == method]
        return titles[0] if titles else method

    def prepared(self, molecule, quantity):
        """Of the initial mesh without its cavities: what every method was given."""
        given = [number(self.record(molecule, method), "metrics", "before", quantity) for method in self.methods if method != "initial"]
        return next((value for value in given if value is not None), None)


def styles_of(series):
    others = iter(OTHER_STYLES * len(series))
    return [STYLES[name] if name in STYLES else next(others) for name in series]


def series_of(run, quantity):
    """Name, legend and one value a molecule for each bar of a group."""
    series = []
    for method in run.methods:
        values = [bar_value(run.record(molecule, method), quantity) for molecule in run.molecules]
        series.append((method, run.method_title(method), values))
    prepared = [run.prepared(molecule, quantity) for molecule in run.molecules]
    if any(value is not None for value in prepared):
        series.insert(1 if run.methods[0] == "initial" else 0, (PREPARED, PREPARED, prepared))
    return series


def label_change(axes, x, value, reference):
    """The change against the initial mesh without cavities, above a bar of an improved mesh."""
    if value is None or not reference:
        return
    text = f"{100 * (value / reference - 1):+.1f} %".replace("-", "\N{MINUS SIGN}")
    axes.annotate(text, (x, value), xytext=(0, 3), textcoords="offset points", rotation=90, ha="center", va="bottom", fontsize=8)


def draw_bar_group(axes, run, quantity, unit_label):
    series = series_of(run, quantity)
    width = 0.8 / len(series)
    for index, ((name, title, values), (colour, hatch)) in enumerate(zip(series, styles_of([name for name, _, _ in series]))):
        positions = [group + (index - (len(series) - 1) / 2) * width for group in range(len(values))]
        axes.bar(positions, [value or 0 for value in values], width, label=title, color=colour, hatch=hatch, edgecolor="black",
                 linewidth=0.6)
        if name not in ("initial", PREPARED):
            for group, (position, value) in enumerate(zip(positions, values)):
                label_change(axes, position, value, run.prepared(run.molecules[group], quantity))
        for group, (position, value) in enumerate(zip(positions, values)):
            if value is None:
                axes.annotate(why_no_bar(run.record(run.molecules[group], name)), (position, 0), xytext=(0, 3), textcoords="offset points", rotation=90, ha="center", va="bottom",
                              fontsize=8)
    axes.set_xticks(range(len(run.molecules)), [run.molecule_title(molecule) for molecule in run.molecules],
                    rotation=15 if len(run.molecules) > 6 else 0)
    axes.set_ylabel(unit_label)
    axes.margins(y=0.18)  # room for the changes above the bars
    axes.yaxis.set_major_formatter(THOUSANDS)


def figure5(run):
    width = max(7.0, 1.9 * len(run.molecules) + 1.5)
    figure, (top, bottom) = plt.subplots(2, 1, figsize=(width, 8.2), layout="constrained")
    draw_bar_group(top, run, "area", "area (Å²)")
    draw_bar_group(bottom, run, "volume", "enclosed volume (Å³)")
    top.set_title("(a) Area", loc="left")
    bottom.set_title("(b) Volume", loc="left")
    top.legend(loc="lower left", bbox_to_anchor=(0, 1.1), borderaxespad=0, ncols=3, frameon=False)
    figure.align_ylabels([top, bottom])
    bottom.set_xlabel("molecule\n(above the bars: change against the initial mesh without its cavities)")
    return figure


def why_empty(record):
    if record is None:
        return "not run"
    return f"failed: {record['reason']}" if not is_done(record) else "no histogram"


def draw_histogram(axes, record, quantity, colour):
    histogram = number(record, "metrics", "after", quantity, "histogram")
    if not histogram or not histogram["counts"]:
        text = textwrap.shorten(why_empty(record), MESSAGE_WIDTH * MESSAGE_LINES, placeholder=" …")
        axes.text(0.5, 0.5, textwrap.fill(text, MESSAGE_WIDTH), transform=axes.transAxes, ha="center", va="center", fontsize=8)
        return
    edges, counts = histogram["edges"], histogram["counts"]
    axes.bar(edges[:-1], counts, [right - left for left, right in zip(edges, edges[1:])], align="edge", color=colour, edgecolor="white",
             linewidth=0.3)


def histogram_figure(run, quantity, label, limits, ticks, count_label):
    rows, columns = len(run.molecules), len(run.methods)
    figure, panels = plt.subplots(rows, columns, figsize=(max(6.0, 3.2 * columns), 2.1 * rows + 0.7), squeeze=False, sharex=True,
                                  sharey="row", layout="constrained")
    for row, molecule in enumerate(run.molecules):
        for column, (method, (colour, _)) in enumerate(zip(run.methods, styles_of(run.methods))):
            axes = panels[row][column]
            draw_histogram(axes, run.record(molecule, method), quantity, colour)
            axes.set_xlim(*limits)
            axes.set_xticks(ticks)
            axes.yaxis.set_major_formatter(THOUSANDS)
            if row == 0:
                axes.set_title(run.method_title(method))
            if row == rows - 1:
                axes.set_xlabel(label)
        panels[row][0].set_ylabel(f"{run.molecule_title(molecule)}\n{count_label}")
    figure.align_ylabels(panels[:, 0])
    return figure


def figure6(run):
    return histogram_figure(run, "edge_ratio", "shortest / longest edge", (0, 1), [0, 0.2, 0.4, 0.6, 0.8, 1.0], "triangles per 0.02")


def figure7(run):
    return histogram_figure(run, "angle_deg", "angle (°)", (0, 180), [0, 30, 60, 90, 120, 150, 180], "angles per 2°")


def level_set_ratio(record):
    before, after = (number(record, "level_set_distance", when, "mean") for when in ("before", "after"))
    return after / before if before and after is not None else None


def method_seconds(record):
    """Processor seconds of the method itself, without what comes before any; None for the mesh as generated."""
    if record["method"] == "initial" or number(record, "cpu_seconds", "smoothing") is None:
        return None
    return sum(number(record, "cpu_seconds", stage) or 0 for stage in ("redundant", "resampling", "smoothing"))


def percentage_below_30(record):
    share = number(record, "metrics", "after", "min_angle_share", "below_30")
    return None if share is None else 100 * share


# Title, what is shown of a record, kind of axis, and where the better end is.
COMPARED = [
    ("smallest angle (°)", lambda record: number(record, "metrics", "after", "angle_deg", "min"), "linear", "right"),
    ("smallest angle < 30°\n(% of triangles)", percentage_below_30, "symlog", "left"),
    ("mean distance to the\nlevel set (× before)", level_set_ratio, "log", "left"),
    ("intersecting pairs", lambda record: number(record, "metrics", "after", "intersecting_pairs"), "symlog", "left"),
    ("processor time (s)", method_seconds, "log", "left"),
]
LINEAR_TO = {1: 0.1, 3: 1}  # where a symlog axis becomes linear: a tenth of a per cent, one pair
MARKERS = ["o", "s", "^", "D", "v", "P"]
MOLECULE_COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"]
ROW_SHARE = 0.62  # of a method's row over which its molecules are spread
OWN_METHODS = ("smopt", "smopt2")
LEGEND_INCHES = 0.4
NOTE_POINTS = 6  # a row of 24 points has room for the notes of two molecules


def offset_of(index, count):
    """Within a method's row, so that the molecules' markers do not hide each other."""
    return 0 if count < 2 else ROW_SHARE * (index / (count - 1) - 0.5)


def why_no_point(record):
    """In a word, beside the row's left end."""
    if record is None:
        return ""
    if record["status"] != "done":
        return record["status"]
    return "diverged" if number(record, "diverged_at_step") else ""


def shown_value(record, value_of, scale):
    """None where the case failed, the method diverged, or a logarithmic axis has no place for the value."""
    value = value_of(record) if is_done(record) and not number(record, "diverged_at_step") else None
    return None if scale == "log" and value == 0 else value


def unresolved_samples(record):
    """Samples of the result without a foot on the level set, which are not in its mean distance."""
    return number(record, "level_set_distance", "after", "unresolved") or 0


def why_no_value(record, value_of, scale):
    """Of a case that ended well: why its row has no point in this panel, or what its point leaves out; "" where there is nothing to say."""
    if not is_done(record) or number(record, "diverged_at_step"):
        return ""  # told beside the first panel
    value = value_of(record)
    if value is None:
        return "none"
    if shown_value(record, value_of, scale) is None:
        return f"{value:g}"
    unresolved = unresolved_samples(record) if value_of is level_set_ratio else 0
    return f"{unresolved:g} without a foot" if unresolved else ""


def place_of_note(axes, value):
    """Beside the point, on the side where there is more room; at the row's right end where there is no point. As (x, offset, alignment)."""
    if value is None:
        return 1, -2, "right"
    x, _ = axes.transAxes.inverted().transform(axes.transData.transform((value, 0)))
    return (x, 5, "left") if x < 0.5 else (x, -5, "right")


def tell_unshown(axes, run, value_of, scale):
    """In the molecule's line of the method's row, and in its colour."""
    for index, molecule in enumerate(run.molecules):
        for row, method in enumerate(run.compared):
            record = run.record(molecule, method)
            note = why_no_value(record, value_of, scale)
            if note:
                x, offset, alignment = place_of_note(axes, shown_value(record, value_of, scale))
                axes.annotate(note, (x, row + offset_of(index, len(run.molecules))), xycoords=("axes fraction", "data"), xytext=(offset, 0),
                              textcoords="offset points", ha=alignment, va="center", fontsize=NOTE_POINTS, style="italic",
                              color=MOLECULE_COLOURS[index % len(MOLECULE_COLOURS)])


def draw_compared_points(axes, run, value_of, scale):
    for index, molecule in enumerate(run.molecules):
        points = []
        for row, method in enumerate(run.compared):
            value = shown_value(run.record(molecule, method), value_of, scale)
            if value is not None:
                points.append((value, row + offset_of(index, len(run.molecules))))
        axes.plot([x for x, _ in points], [y for _, y in points], linestyle="none", marker=MARKERS[index % len(MARKERS)], markersize=5,
                  markeredgecolor="black", markeredgewidth=0.5, color=MOLECULE_COLOURS[index % len(MOLECULE_COLOURS)], clip_on=False,
                  zorder=3, label=run.molecule_title(molecule), gid=molecule)


def label_decades(axes):
    """Plain numbers on a logarithmic axis; between the decades, too, where there are few of them."""
    low, high = axes.get_xlim()
    is_short = high < 40 * low
    axes.xaxis.set_major_locator(matplotlib.ticker.LogLocator(subs=(1, 2, 5) if is_short else (1,)))
    axes.xaxis.set_major_formatter(PLAIN)
    axes.xaxis.set_minor_formatter(matplotlib.ticker.NullFormatter())


def style_compared_axes(axes, column, run):
    title, _, scale, better = COMPARED[column]
    if scale == "symlog":
        axes.set_xscale("symlog", linthresh=LINEAR_TO[column])
        axes.xaxis.set_major_formatter(PLAIN)
        axes.set_xlim(left=0)
    elif scale == "log" and any(len(line.get_xdata()) for line in axes.lines):
        axes.set_xscale("log")
        label_decades(axes)
    elif scale == "linear":
        axes.set_xlim(0, 60)  # an equilateral triangle's
        axes.set_xticks([0, 15, 30, 45, 60])
    axes.tick_params(axis="y", length=0, pad=7)
    axes.tick_params(axis="x", labelsize=8)
    axes.set_title(title, fontsize=10)
    axes.set_xlabel("better \N{RIGHTWARDS ARROW}" if better == "right" else "\N{LEFTWARDS ARROW} better", fontsize=8)
    axes.grid(axis="x", color="#dddddd", linewidth=0.6, zorder=0)
    for row in range(0, len(run.compared), 2):
        axes.axhspan(row - 0.5, row + 0.5, color="#f4f4f4", zorder=0, linewidth=0)
    axes.set_ylim(len(run.compared) - 0.5, -0.5)


def tell_missing(axes, run):
    """In the first panel, where a method has no result on a molecule."""
    for row, method in enumerate(run.compared):
        reasons = {why_no_point(run.record(molecule, method)) for molecule in run.molecules} - {""}
        if reasons:
            axes.annotate(", ".join(sorted(reasons)), (1, row), xycoords=("axes fraction", "data"), xytext=(-2, 0),
                          textcoords="offset points", ha="right", va="center", fontsize=8, style="italic")


def methods_figure(run):
    height = max(3.0, 0.34 * len(run.compared) + 1.6)
    figure, panels = plt.subplots(1, len(COMPARED), figsize=(13.0, height), squeeze=False, sharey=True, layout="constrained")
    for column, axes in enumerate(panels[0]):
        draw_compared_points(axes, run, *COMPARED[column][1:3])
        style_compared_axes(axes, column, run)
        tell_unshown(axes, run, *COMPARED[column][1:3])
    first = panels[0][0]
    tell_missing(first, run)
    first.set_yticks(range(len(run.compared)), [run.method_title(method) for method in run.compared])
    for label, method in zip(first.get_yticklabels(), run.compared):
        label.set_fontweight("bold" if method in OWN_METHODS else "normal")
    figure.get_layout_engine().set(rect=(0, 0, 1, 1 - LEGEND_INCHES / height))
    figure.legend(*first.get_legend_handles_labels(), loc="upper center", ncols=min(6, max(1, len(run.molecules))), frameon=False)
    return figure


FIGURES = {"fig5": figure5, "fig6": figure6, "fig7": figure7, "methods": methods_figure}


def drawn_in(figure):
    """Every bar as it was drawn (left edge, width, height), the points of each molecule, and what is written among them."""
    panels = []
    for axes in figure.axes:
        spec = axes.get_subplotspec()
        patches = [patch for container in axes.containers for patch in container.patches]
        bars = [[float(patch.get_x()), float(patch.get_width()), float(patch.get_height())] for patch in patches]
        points = {line.get_gid(): [[float(x), float(y)] for x, y in zip(*line.get_data())] for line in axes.lines}
        notes = [text.get_text() for text in axes.texts]
        panels.append({"row": spec.rowspan.start, "column": spec.colspan.start, "bars": bars, "points": points, "notes": notes})
    return panels


def save(figure, folder, name):
    figure.savefig(folder / f"{name}.svg", metadata={"Date": None, "Creator": None})
    figure.savefig(folder / f"{name}.png", metadata={"Software": None})
    plt.close(figure)


def parse_arguments():
    names = lambda text: [name for name in text.split(",") if name]  # noqa: E731
    parser = argparse.ArgumentParser(description="Figures 5, 6 and 7, and that of all methods, from the records of a run.")
    parser.add_argument("directory", type=pathlib.Path)
    parser.add_argument("--molecules", type=names, default=[], help="their order; by name if not given")
    parser.add_argument("--methods", type=names, default=[], help="their order; initial, smopt, then by name if not given")
    parser.add_argument("--compared", type=names, default=[], help="the methods of the figure of all methods, in their order; all if not given")
    parser.add_argument("--dump", type=pathlib.Path, help="write what was drawn to this file")
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    records = read_records(arguments.directory / "records")
    if not records:
        sys.exit(f"{arguments.directory / 'records'}: no records")
    set_style()
    run = Run(records, arguments.molecules, arguments.methods, arguments.compared)
    folder = arguments.directory / "figures"
    folder.mkdir(parents=True, exist_ok=True)
    drawn = {}
    for name, draw in FIGURES.items():
        figure = draw(run)
        drawn[name] = drawn_in(figure)
        save(figure, folder, name)
    if arguments.dump:
        arguments.dump.write_text(json.dumps(drawn), encoding="utf-8")


if __name__ == "__main__":
    main()
