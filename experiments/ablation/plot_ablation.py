"""The figures of an ablation study, from its numbers and nothing else.

plot_ablation.py DIR [--dump FILE]

Reads DIR/ablation.json and writes DIR/figures/ablation-{one-at-a-time,main-effects,interactions,thresholds}.{svg,png}, those whose design is in
the study; the same bytes for the same numbers. With --dump what was drawn is written to FILE as JSON: by figure a list of panels with title,
points ({molecule: [[x, y], ...]}), notes (what is written among them) and cells (the numbers of a heat map or of a grid, null where there is none).
"""

import argparse
import json
import math
import pathlib
import sys

try:
    import matplotlib
except ImportError:
    sys.exit(f"{sys.executable} has no matplotlib; install Debian's package python3-matplotlib, or set SMOPT_PYTHON to a Python that has it")

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402 (the backend comes first)
import matplotlib.patheffects  # noqa: E402
import numpy  # noqa: E402 (comes with matplotlib)

# Okabe and Ito's colours (2008), which stay apart for the colour-blind; the markers keep them apart in black and white.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"]
MARKERS = ["o", "s", "^", "D", "v", "P"]
SEQUENTIAL = "cividis"  # even in lightness, also for the colour-blind

PNG_DPI = 150
NOTE_POINTS = 6.5
ROW_SHARE = 0.5  # of a row over which the molecules are spread
CONTOUR_LEVELS = 8
DARK_BELOW = 0.55  # part of the colour scale below which text is white

THOUSANDS_FROM = 10_000  # larger numbers are written with their thousands apart


def plain(value):
    text = f"{value:,.0f}".replace(",", "\N{NO-BREAK SPACE}") if abs(value) >= THOUSANDS_FROM else f"{value:g}"
    return text.replace("-", "\N{MINUS SIGN}")


PLAIN = matplotlib.ticker.FuncFormatter(lambda value, _: plain(value))


def set_style():
    matplotlib.rcdefaults()  # no settings of the user's: the same picture everywhere
    matplotlib.rcParams.update({
        "font.family": "DejaVu Sans", "font.size": 9, "axes.titlesize": 10, "axes.spines.top": False, "axes.spines.right": False,
        "svg.hashsalt": "smopt", "savefig.dpi": PNG_DPI,
    })


def colour_of(index):
    return COLOURS[index % len(COLOURS)]


def marker_of(index):
    return MARKERS[index % len(MARKERS)]


def offset_of(index, count):
    """Within a row, so that the molecules' markers do not hide each other."""
    return 0 if count < 2 else ROW_SHARE * (index / (count - 1) - 0.5)


class Panel:
    """What a panel shows, for --dump."""

    def __init__(self, title):
        self.title, self.points, self.notes, self.cells = title, {}, [], []

    def as_json(self):
        return {"title": self.title, "points": self.points, "notes": self.notes, "cells": self.cells}


def is_noticeable(quantity, low, high):
    """Whether a range is worth a look; see the study's page for what counts."""
    if quantity["scale"] != "logarithmic":
        return high - low >= quantity["noticeable"]
    return high >= low * quantity["noticeable"] if low > 0 else high > low


def set_least_span(axes, along, quantity, values):
    """What is not noticeable is not to look like much."""
    if not values or is_noticeable(quantity, min(values), max(values)):
        return
    set_limits = axes.set_xlim if along == "x" else axes.set_ylim
    middle = (min(values) + max(values)) / 2
    if quantity["scale"] == "logarithmic":
        set_limits(middle / quantity["noticeable"] ** 2, middle * quantity["noticeable"] ** 2)
    else:
        set_limits(middle - 2 * quantity["noticeable"], middle + 2 * quantity["noticeable"])


def set_scale(axes, along, quantity, values):
    """Along "x" or "y". Logarithmic axes get plain numbers; a symmetric one is, where it is to show all cases beside each other ("x"), logarithmic
    on both sides of a linear middle."""
    set_to, ticks = (axes.set_xscale, axes.xaxis) if along == "x" else (axes.set_yscale, axes.yaxis)
    if quantity["scale"] == "logarithmic" and values and min(values) > 0:
        set_to("log")
        is_short = max(values) < 40 * min(values)
        ticks.set_major_locator(matplotlib.ticker.LogLocator(subs=(1, 2, 5) if is_short else (1,)))
        ticks.set_minor_formatter(matplotlib.ticker.NullFormatter())
    elif along == "x" and quantity["scale"] == "symmetric" and values and max(map(abs, values)) > 10 * quantity["linear_to"]:
        set_to("symlog", linthresh=quantity["linear_to"])
        ticks.set_major_locator(matplotlib.ticker.SymmetricalLogLocator(base=10, linthresh=quantity["linear_to"]))
        ticks.get_major_locator().set_params(numticks=6)
    else:
        ticks.set_major_locator(matplotlib.ticker.MaxNLocator(4))
    ticks.set_major_formatter(PLAIN)
    set_least_span(axes, along, quantity, values)


def rows_of(study):
    """What stands in each line of the figure: (label, case, or None for the mesh before SMOPT and for a heading, kind)."""
    rows = [("before SMOPT", None, "given"), ("all defaults", study["default"], "case")]
    for factor in study["factors"]:
        rows.append((factor["title"], None, "heading"))
        rows += [(case["title"], case["case"], "case") for case in factor["cases"]]
    return rows


def value_in_row(molecule, quantity, row):
    label, case, kind = row
    if kind == "given":
        return molecule["given"][quantity["id"]]
    return molecule["values"][case][quantity["id"]] if kind == "case" else None


def note_in_row(molecule, quantity, row):
    """Why a case's row has no point."""
    label, case, kind = row
    return molecule["missing"].get(case, {}).get(quantity["id"], "") if kind == "case" else ""


def draw_rows(axes, study, quantity, rows, panel):
    values = []
    for index, molecule in enumerate(study["molecules"]):
        shift = offset_of(index, len(study["molecules"]))
        points = [(value_in_row(molecule, quantity, row), place + shift) for place, row in enumerate(rows)]
        points = [(x, y) for x, y in points if x is not None and not (quantity["scale"] == "logarithmic" and x <= 0)]
        axes.plot([x for x, _ in points], [y for _, y in points], linestyle="none", marker=marker_of(index), markersize=4,
                  markeredgecolor="black", markeredgewidth=0.4, color=colour_of(index), label=molecule["title"], zorder=3, clip_on=False)
        default = molecule["values"][study["default"]][quantity["id"]]
        if default is not None:
            axes.axvline(default, color=colour_of(index), linewidth=0.8, linestyle=("-", "--", ":")[index % 3], zorder=1)
        panel.points[molecule["title"]] = points
        values += [x for x, _ in points]
        for place, row in enumerate(rows):
            note = note_in_row(molecule, quantity, row)
            zero = quantity["scale"] == "logarithmic" and value_in_row(molecule, quantity, row) == 0
            if note or zero:
                text = note or "0"
                axes.annotate(text, (0.02, place + shift), xycoords=("axes fraction", "data"), ha="left", va="center",
                              fontsize=NOTE_POINTS, style="italic", color=colour_of(index))
                panel.notes.append(text)
    set_scale(axes, "x", quantity, values)


def style_rows(axes, quantity, rows):
    axes.set_title(quantity["title"].replace(" ", "\n", 1), fontsize=9)
    axes.tick_params(axis="y", length=0)
    axes.tick_params(axis="x", labelsize=7)
    axes.grid(axis="x", color="#dddddd", linewidth=0.5, zorder=0)
    axes.set_ylim(len(rows) - 0.5, -0.5)
    axes.margins(x=0.08)
    for place, (_, _, kind) in enumerate(rows):
        if kind == "heading":
            axes.axhspan(place - 0.5, place + 0.5, color="#eeeeee", zorder=0, linewidth=0)


def one_at_a_time_figure(data):
    study, quantities = data["one_at_a_time"], data["quantities"]
    rows = rows_of(study)
    height = 0.2 * len(rows) + 1.6
    figure, panels = plt.subplots(1, len(quantities), figsize=(15, height), sharey=True, layout="constrained")
    drawn = []
    for axes, quantity in zip(panels, quantities):
        panel = Panel(quantity["title"])
        draw_rows(axes, study, quantity, rows, panel)
        style_rows(axes, quantity, rows)
        drawn.append(panel)
    panels[0].set_yticks(range(len(rows)), [label for label, _, _ in rows])
    for label, (_, _, kind) in zip(panels[0].get_yticklabels(), rows):
        label.set_fontweight("bold" if kind == "heading" else "normal")
        label.set_fontsize(8)
    add_legend(figure, panels[0], height, "lines: all defaults")
    return figure, drawn


def add_legend(figure, axes, height, note=""):
    handles, labels = axes.get_legend_handles_labels()
    if note:
        handles.append(matplotlib.lines.Line2D([], [], color="#555555", linewidth=0.8))
        labels.append(note)
    figure.get_layout_engine().set(rect=(0, 0, 1, 1 - 0.32 / height))
    figure.legend(handles, labels, loc="upper center", ncols=max(1, len(labels)), frameon=False)


def flat_levels(factors):
    """(place on the axis, factor, level) of each level; a gap between two factors."""
    places, place = [], 0.0
    for f, factor in enumerate(factors):
        for level in range(len(factor["levels"])):
            places.append((place, f, level))
            place += 1
        place += 0.7
    return places


def draw_main_effects(axes, study, quantity, panel):
    places, values = flat_levels(study["factors"]), []
    for index, molecule in enumerate(study["molecules"]):
        effects = molecule["effects"][quantity["id"]]
        panel.points[molecule["title"]] = []
        if effects is None:
            panel.notes.append("none")
            axes.annotate(f"{molecule['title']}: no complete part", (0.02, 0.95 - 0.08 * index), xycoords="axes fraction", fontsize=NOTE_POINTS,
                          style="italic", color=colour_of(index), va="top")
            continue
        label = molecule["title"]
        for f in range(len(study["factors"])):
            points = [(place, effects["level_means"][f][level]) for place, factor, level in places if factor == f]
            points = [(x, y) for x, y in points if y is not None]
            axes.plot([x for x, _ in points], [y for _, y in points], marker=marker_of(index), markersize=4, markeredgecolor="black",
                      markeredgewidth=0.4, linewidth=1, color=colour_of(index), linestyle=("-", "--", ":")[index % 3], label=label, zorder=3)
            label = None
            panel.points[molecule["title"]] += points
            values += [y for _, y in points]
        for left_out in effects["left_out"]:
            place = next(p for p, f, level in places if (f, level) == (left_out["factor"], left_out["level"]))
            axes.annotate("left out", (place, 0.02), xycoords=("data", "axes fraction"), rotation=90, ha="center", va="bottom",
                          fontsize=NOTE_POINTS, style="italic", color=colour_of(index))
            panel.notes.append("left out")
    set_scale(axes, "y", quantity, values)


def panel_grid(count, columns, width, height):
    rows = math.ceil(count / columns)
    figure, panels = plt.subplots(rows, columns, figsize=(width * columns, height * rows + 0.4), squeeze=False, layout="constrained")
    for axes in panels.flat[count:]:
        axes.set_axis_off()
    return figure, list(panels.flat[:count]), height * rows + 0.4


def main_effects_figure(data):
    study, quantities = data["factorial"], data["quantities"]
    places = flat_levels(study["factors"])
    figure, panels, height = panel_grid(len(quantities), 4, 4.0, 3.6)
    drawn = []
    for axes, quantity in zip(panels, quantities):
        panel = Panel(quantity["title"])
        draw_main_effects(axes, study, quantity, panel)
        axes.set_title(quantity["title"])
        axes.grid(axis="y", color="#dddddd", linewidth=0.5, zorder=0)
        is_lowest = len(drawn) >= len(quantities) - 4
        labels = [level_label(study["factors"][f], level) if is_lowest else "" for _, f, level in places]
        axes.set_xticks([place for place, _, _ in places], labels, rotation=90, fontsize=7)
        drawn.append(panel)
    add_legend(figure, panels[0], height)
    return figure, drawn


def level_label(factor, level):
    return f"{factor['title']}: {factor['levels'][level]['title']}"


def draw_shares(axes, factors, effects, panel):
    """The part of the variation of each factor (diagonal) and of each two factors (beside it), in per cent."""
    shares = effects["shares"] if effects else [[None] * len(factors)] * len(factors)
    percent = numpy.array([[math.nan if share is None else 100 * share for share in row] for row in shares])
    panel.cells = [[None if share is None else 100 * share for share in row] for row in shares]
    visible = numpy.ma.masked_invalid(numpy.where(numpy.tri(len(factors), dtype=bool), percent, math.nan))
    image = axes.imshow(visible, cmap=SEQUENTIAL, vmin=0, vmax=100)
    for i in range(len(factors)):
        for j in range(i + 1):
            value = percent[i, j]
            text = "\N{EN DASH}" if math.isnan(value) else "<1" if 0.05 <= value < 0.95 else f"{value:.0f}"
            is_dark = not math.isnan(value) and value < 100 * DARK_BELOW
            axes.text(j, i, text, ha="center", va="center", fontsize=7, color="white" if is_dark else "black")
    if effects is None or effects["rest_share"] is None:
        panel.notes.append("alike in all cases" if effects else "cannot be told")
    else:
        hardly = "" if effects["is_noticeable"] else "hardly varies; "
        panel.notes.append(f"{hardly}three and more: {100 * effects['rest_share']:.0f} %")
    axes.text(1, 1, panel.notes[-1], transform=axes.transAxes, ha="right", va="top", fontsize=7, style="italic")
    return image


def interactions_figure(data):
    study, quantities = data["factorial"], data["quantities"]
    titles = [factor["title"] for factor in study["factors"]]
    columns = len(quantities) // 2
    figure, panels, _ = panel_grid(len(quantities) * len(study["molecules"]), columns, 3.3, 3.1)
    drawn = []
    for row, molecule in enumerate(study["molecules"]):
        for column, quantity in enumerate(quantities):
            axes = panels[row * len(quantities) + column]
            panel = Panel(f"{molecule['title']}: {quantity['title']}")
            image = draw_shares(axes, study["factors"], molecule["effects"][quantity["id"]], panel)
            axes.set_title(f"{molecule['title']}\n{quantity['title']}", fontsize=9)
            axes.set_xticks(range(len(titles)), titles, rotation=90, fontsize=7)
            axes.set_yticks(range(len(titles)), titles if column % columns == 0 else [""] * len(titles), fontsize=7)
            axes.tick_params(length=0)
            for side in axes.spines.values():
                side.set_visible(False)
            drawn.append(panel)
    figure.colorbar(image, ax=panels, shrink=0.5, label="part of the variation (%): a part alone on the diagonal, two together beside it")
    return figure, drawn


def contour_levels(values, quantity):
    """Round numbers between the smallest and the largest value; on a logarithmic scale 1, 2 and 5 times powers of ten."""
    low, high = float(numpy.nanmin(values)), float(numpy.nanmax(values))
    if quantity["scale"] == "logarithmic" and low > 0 and high > 4 * low:
        steps = [m * 10.0**k for k in range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1) for m in (1, 2, 5)]
        inside = [step for step in steps if low < step < high]
        if len(inside) >= 2:
            return [max(step for step in steps if step <= low)] + inside + [min(step for step in steps if step >= high)]
    return list(matplotlib.ticker.MaxNLocator(CONTOUR_LEVELS).tick_values(low, high))


def range_text(known, decimals):
    if known.size == 0:
        return "no case has the number"
    low, high = (f"{value:.{decimals}f}".replace("-", "\N{MINUS SIGN}") for value in (known.min(), known.max()))
    return f"{low} at every threshold" if low == high else f"hardly varies: {low} to {high}"


def draw_grid(axes, figure, quantity, grid, xs, ys, panel):
    values = numpy.array([[math.nan if value is None else value for value in row] for row in grid]).T  # rows: y
    panel.cells = grid
    known = values[~numpy.isnan(values)]
    if known.size == 0 or not is_noticeable(quantity, known.min(), known.max()):
        text = range_text(known, quantity["decimals"])
        axes.text(0.5, 0.75, text, transform=axes.transAxes, ha="center", va="center", style="italic")
        panel.notes.append(text)
    else:
        levels = contour_levels(values, quantity)
        is_log = quantity["scale"] == "logarithmic" and levels[0] > 0 and levels[-1] > 4 * levels[0]
        norm = matplotlib.colors.LogNorm(levels[0], levels[-1]) if is_log else matplotlib.colors.Normalize(levels[0], levels[-1])
        filled = axes.contourf(xs, ys, numpy.ma.masked_invalid(values), levels=levels, cmap=SEQUENTIAL, norm=norm)
        lines = axes.contour(xs, ys, numpy.ma.masked_invalid(values), levels=levels[1:-1], colors="white", linewidths=0.7)
        labels = axes.clabel(lines, fmt=plain, fontsize=7, inline=True, colors="white")
        for label in labels:
            label.set_clip_on(True)
            label.set_path_effects([matplotlib.patheffects.withStroke(linewidth=1.6, foreground="#222222")])
        figure.colorbar(filled, ax=axes, format=PLAIN, ticks=levels)
    return values


def mark_cases(axes, molecule, quantity, names, xs, ys, panel):
    """A dot where a case was computed, a cross and the reason where it has no number."""
    for i, x in enumerate(xs):
        for j, y in enumerate(ys):
            why = molecule["missing"].get(names[i][j], {}).get(quantity["id"], "")
            axes.plot([x], [y], marker="x" if why else ".", markersize=6 if why else 4, color="#D55E00" if why else "black", clip_on=False,
                      zorder=4)
            if why:
                axes.annotate(why, (x, y), xytext=(0, 5), textcoords="offset points", ha="center", fontsize=NOTE_POINTS, style="italic")
                panel.notes.append(why)


def default_value(factor):
    return next(level["value"] for level in factor["levels"] if level["is_default"])


def axis_label(factor):
    return factor["title"] + (f" ({factor['unit']})" if factor["unit"] else "")


def thresholds_figure(data):
    study, quantities = data["thresholds"], data["quantities"]
    (x, y), names = study["factors"], study["cases"]
    xs, ys = ([level["value"] for level in factor["levels"]] for factor in (x, y))
    figure, panels, height = panel_grid(len(quantities) * len(study["molecules"]), len(quantities) // 2, 4.0, 3.1)
    drawn = []
    for row, molecule in enumerate(study["molecules"]):
        for column, quantity in enumerate(quantities):
            axes = panels[row * len(quantities) + column]
            panel = Panel(f"{molecule['title']}: {quantity['title']}")
            grid = [[molecule["values"][name][quantity["id"]] for name in line] for line in names]
            draw_grid(axes, figure, quantity, grid, xs, ys, panel)
            mark_cases(axes, molecule, quantity, names, xs, ys, panel)
            point = axes.plot([default_value(x)], [default_value(y)], marker="*", markersize=13, color="#E69F00", markeredgecolor="black",
                              linestyle="none", zorder=5, label="the default, which reproduces the paper's figures")
            panel.points["default"] = [[default_value(x), default_value(y)]]
            axes.set_title(f"{molecule['title']}\n{quantity['title']}", fontsize=9)
            axes.set_xlabel(axis_label(x), fontsize=8)
            axes.set_ylabel(axis_label(y), fontsize=8)
            axes.set_xlim(min(xs), max(xs))
            axes.set_ylim(min(ys), max(ys))
            axes.set_xticks(xs)
            axes.set_yticks(ys)
            for axis in (axes.xaxis, axes.yaxis):
                axis.set_major_formatter(PLAIN)
            drawn.append(panel)
    add_legend(figure, panels[0], height)
    return figure, drawn


FIGURES = {
    "ablation-one-at-a-time": ("one_at_a_time", one_at_a_time_figure),
    "ablation-main-effects": ("factorial", main_effects_figure),
    "ablation-interactions": ("factorial", interactions_figure),
    "ablation-thresholds": ("thresholds", thresholds_figure),
}


def save(figure, folder, name):
    figure.savefig(folder / f"{name}.svg", metadata={"Date": None, "Creator": None})
    figure.savefig(folder / f"{name}.png", metadata={"Software": None})
    plt.close(figure)


def main():
    parser = argparse.ArgumentParser(description="The figures of an ablation study.")
    parser.add_argument("directory", type=pathlib.Path)
    parser.add_argument("--dump", type=pathlib.Path, help="write what was drawn to this file")
    arguments = parser.parse_args()
    data = json.loads((arguments.directory / "ablation.json").read_text(encoding="utf-8"))
    set_style()
    folder = arguments.directory / "figures"
    folder.mkdir(parents=True, exist_ok=True)
    drawn = {}
    for name, (design, draw) in FIGURES.items():
        if data[design] is None:
            continue
        figure, panels = draw(data)
        drawn[name] = [panel.as_json() for panel in panels]
        save(figure, folder, name)
    if arguments.dump:
        arguments.dump.write_text(json.dumps(drawn), encoding="utf-8")


if __name__ == "__main__":
    main()
