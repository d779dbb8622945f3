"""Figure 5: area and volume, how large they are and by how much each method changes them.

The paper's bars stand on one linear axis, on which a small molecule vanishes beside a ribosome, and changes of a per cent are not seen. Here each
molecule is a row: to the left the value on a logarithmic axis, to the right the change against the mesh that the methods were given.
"""

import matplotlib.pyplot as plt
from matplotlib.lines import Line2D

from drawing import PREPARED, band_rows, label_decades, styles_of
from run_records import number, steps_until_divergence

QUANTITIES = (("(a) Area", "area", "area (Å²)"), ("(b) Volume", "volume", "enclosed volume (Å³)"))
ROW_INCHES = 0.55
ROW_SHARE = 0.7  # of a molecule's row over which the methods are spread
LABEL_POINTS = 7
LEGEND_INCHES = 0.4


def surface_value(record, quantity):
    """None, too, where the method diverged: what is left is no surface, and its area would dwarf the others."""
    return None if steps_until_divergence(record) else number(record, "metrics", "after", quantity)


def series_of(run, quantity):
    """A name, a legend and one value a molecule for each marker of a row."""
    series = [(method, run.method_title(method), [surface_value(run.record(molecule, method), quantity) for molecule in run.molecules])
              for method in run.methods]
    prepared = [run.prepared(molecule, quantity) for molecule in run.molecules]
    if any(value is not None for value in prepared):
        series.insert(1 if run.methods[0] == "initial" else 0, (PREPARED, PREPARED, prepared))
    return series


def rows_of(index, count, molecules):
    """Where the markers of a series are: in each molecule's row, beside those of the others."""
    offset = 0 if count < 2 else ROW_SHARE * (index / (count - 1) - 0.5)
    return [row + offset for row in range(molecules)]


def change(value, reference):
    return None if value is None or not reference else 100 * (value / reference - 1)


def draw_markers(axes, values, rows, name, style):
    colour, marker = style
    shown = [(value, row) for value, row in zip(values, rows) if value is not None]
    if shown:  # a line without points would stand in the figure's corner as far as the layout knows
        axes.plot([value for value, _ in shown], [row for _, row in shown], linestyle="none", marker=marker, markersize=5.5, color=colour,
                  markeredgecolor="black", markeredgewidth=0.5, clip_on=False, zorder=3, gid=name)


def draw_values(axes, series, styles, molecules):
    for index, ((name, _, values), style) in enumerate(zip(series, styles)):
        draw_markers(axes, [value if value and value > 0 else None for value in values], rows_of(index, len(series), molecules), name, style)
    if any(len(line.get_xdata()) for line in axes.lines):
        axes.set_xscale("log")
        axes.margins(x=0.08)
        label_decades(axes)


def changes_of(run, quantity, series):
    """Of the improved meshes only: name and one change a molecule."""
    references = [run.prepared(molecule, quantity) for molecule in run.molecules]
    return {name: [change(value, reference) for value, reference in zip(values, references)]
            for name, _, values in series if name not in ("initial", PREPARED)}


def draw_changes(axes, changes, styles, count, order):
    for name, values in changes.items():
        draw_markers(axes, values, rows_of(order.index(name), len(order), count), name, styles[order.index(name)])
    axes.margins(x=0.12)
    axes.axvline(0, color="black", linewidth=0.8, zorder=1)


def label_smopt(axes, changes, order):
    """The paper's own claim is about these: written out."""
    if "smopt" not in changes:
        return
    rows = rows_of(order.index("smopt"), len(order), len(changes["smopt"]))
    for value, row in zip(changes["smopt"], rows):
        if value is not None:
            axes.annotate(f"{value:+.1f}".replace("-", "\N{MINUS SIGN}"), (value, row), xytext=(6, 0), textcoords="offset points", va="center",
                          fontsize=LABEL_POINTS, bbox={"facecolor": "white", "alpha": 0.8, "linewidth": 0, "pad": 0.5})


def why_none(record):
    if record is None:
        return "not run"
    steps = steps_until_divergence(record)
    return f"diverged at step {steps}" if steps else (record["status"] if record["status"] != "done" else "none")


def tell_missing(axes, run, changes, styles, order):
    for name, values in changes.items():
        rows = rows_of(order.index(name), len(order), len(values))
        for molecule, value, row in zip(run.molecules, values, rows):
            if value is None:
                text = f"{run.method_title(name)}: {why_none(run.record(molecule, name))}"
                axes.annotate(text, (0, row), xycoords=("axes fraction", "data"), xytext=(3, 0), textcoords="offset points", ha="left",
                              va="center", fontsize=LABEL_POINTS - 1, style="italic")


def style_axes(axes, run, label):
    axes.set_xlabel(label)
    axes.grid(axis="x", color="#dddddd", linewidth=0.6, zorder=0)
    band_rows(axes, len(run.molecules))


def figure5(run):
    height = 2 * (ROW_INCHES * len(run.molecules) + 1.2) + LEGEND_INCHES
    figure, panels = plt.subplots(2, 2, figsize=(11.0, height), squeeze=False, sharey=True, layout="constrained")
    for (title, quantity, label), (left, right) in zip(QUANTITIES, panels):
        series = series_of(run, quantity)
        order, styles = [name for name, _, _ in series], styles_of([name for name, _, _ in series])
        changes = changes_of(run, quantity, series)
        draw_values(left, series, styles, len(run.molecules))
        draw_changes(right, changes, styles, len(run.molecules), order)
        label_smopt(right, changes, order)
        tell_missing(right, run, changes, styles, order)
        left.set_title(title, loc="left")
        style_axes(left, run, label)
        style_axes(right, run, f"change of the {quantity} by the method (%)")
        left.set_yticks(range(len(run.molecules)), [run.molecule_title(molecule) for molecule in run.molecules])
    handles = [Line2D([], [], linestyle="none", marker=marker, color=colour, markeredgecolor="black", markeredgewidth=0.5, label=title)
               for (_, title, _), (colour, marker) in zip(series, styles)]
    figure.get_layout_engine().set(rect=(0, 0, 1, 1 - LEGEND_INCHES / height))
    figure.legend(handles=handles, loc="upper center", ncols=6, frameon=False, columnspacing=1.2, handletextpad=0.3)
    return figure
