"""The figure of all methods: what they give, on every molecule, side by side."""

import collections
import statistics

import matplotlib.pyplot as plt

from drawing import PLAIN, band_rows, label_decades
from run_records import is_done, number, steps_until_divergence


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
    return "diverged" if steps_until_divergence(record) else ""


def shown_value(record, value_of, scale):
    """None where the case failed, the method diverged, or a logarithmic axis has no place for the value."""
    value = value_of(record) if is_done(record) and not steps_until_divergence(record) else None
    return None if scale == "log" and value == 0 else value


def unresolved_samples(record):
    """Samples of the result without a foot on the level set, which are not in its mean distance."""
    return number(record, "level_set_distance", "after", "unresolved") or 0


def why_no_value(record, value_of, scale):
    """Of a case that ended well: why its row has no point in this panel, or what its point leaves out; "" where there is nothing to say."""
    if not is_done(record) or steps_until_divergence(record):
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


def count_unshown(axes, run, value_of, scale):
    for row, method in enumerate(run.compared):
        records = [run.record(molecule, method) for molecule in run.molecules]
        count = sum(is_done(record) and not steps_until_divergence(record) and shown_value(record, value_of, scale) is None
                    for record in records)
        if count and method != "initial":
            axes.annotate(f"{count} without", (1, row), xycoords=("axes fraction", "data"), xytext=(-2, 6), textcoords="offset points",
                          ha="right", va="center", fontsize=NOTE_POINTS, style="italic")


def tell_unshown(axes, run, value_of, scale):
    """In the molecule's line of the method's row, and in its colour; of a crowd how many there are."""
    if is_crowd(run):
        return count_unshown(axes, run, value_of, scale)
    for index, molecule in enumerate(run.molecules):
        for row, method in enumerate(run.compared):
            record = run.record(molecule, method)
            note = why_no_value(record, value_of, scale)
            if note:
                x, offset, alignment = place_of_note(axes, shown_value(record, value_of, scale))
                axes.annotate(note, (x, row + offset_of(index, len(run.molecules))), xycoords=("axes fraction", "data"), xytext=(offset, 0),
                              textcoords="offset points", ha=alignment, va="center", fontsize=NOTE_POINTS, style="italic",
                              color=MOLECULE_COLOURS[index])


def is_crowd(run):
    """Whether there are more molecules than can be told apart: then all are like points, with the median among them."""
    return len(run.molecules) > len(MARKERS)


def style_of_molecule(run, index):
    if is_crowd(run):
        return {"marker": "o", "markersize": 3, "markeredgewidth": 0, "color": "#0072B2", "alpha": 0.6, "label": "one molecule" if index == 0 else None}
    return {"marker": MARKERS[index], "markersize": 5, "markeredgecolor": "black", "markeredgewidth": 0.5, "color": MOLECULE_COLOURS[index],
            "label": run.molecule_title(run.molecules[index])}


def draw_medians(axes, run, value_of, scale):
    medians = []
    for row, method in enumerate(run.compared):
        values = [shown_value(run.record(molecule, method), value_of, scale) for molecule in run.molecules]
        values = [value for value in values if value is not None]
        if values:
            medians.append((statistics.median(values), row))
    axes.plot([x for x, _ in medians], [y for _, y in medians], linestyle="none", marker="|", markersize=17, markeredgewidth=2, color="black",
              clip_on=False, zorder=4, label="median of those shown", gid="median")


def draw_compared_points(axes, run, value_of, scale):
    for index, molecule in enumerate(run.molecules):
        points = []
        for row, method in enumerate(run.compared):
            value = shown_value(run.record(molecule, method), value_of, scale)
            if value is not None:
                points.append((value, row + offset_of(index, len(run.molecules))))
        line, = axes.plot([x for x, _ in points], [y for _, y in points], linestyle="none", clip_on=False, zorder=3, gid=molecule,
                          **style_of_molecule(run, index))
        line.set_in_layout(bool(points))  # without any it would stand in the figure's corner as far as the layout knows
    if is_crowd(run):
        draw_medians(axes, run, value_of, scale)


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
    axes.tick_params(axis="x", labelsize=8)
    axes.set_title(title, fontsize=10)
    axes.set_xlabel("better \N{RIGHTWARDS ARROW}" if better == "right" else "\N{LEFTWARDS ARROW} better", fontsize=8)
    axes.grid(axis="x", color="#dddddd", linewidth=0.6, zorder=0)
    band_rows(axes, len(run.compared))


def tell_missing(axes, run):
    """In the first panel, where a method has no result on a molecule; of several molecules, on how many."""
    for row, method in enumerate(run.compared):
        reasons = collections.Counter(why_no_point(run.record(molecule, method)) for molecule in run.molecules)
        del reasons[""]
        if reasons:
            text = ", ".join(f"{count} {reason}" if len(run.molecules) > 1 else reason for reason, count in sorted(reasons.items()))
            axes.annotate(text, (1, row), xycoords=("axes fraction", "data"), xytext=(-2, 0), textcoords="offset points", ha="right",
                          va="center", fontsize=8, style="italic")


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
