"""Figures 6 (edge ratios) and 7 (angles): a row of histograms a molecule, the paper's columns first."""

import textwrap

import matplotlib.pyplot as plt

from drawing import THOUSANDS, styles_of
from run_records import is_done, number, steps_until_divergence

MESSAGE_WIDTH = 34  # characters a line of a failure's reason in a panel
MESSAGE_LINES = 8
TALL_ROW = 2.1  # inches
LOW_ROW = 1.25  # where there are more than so many:
TALL_ROWS = 6
HEADROOM = 1.08  # of the axis above the highest bar


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


def highest_count(run, molecule, quantity):
    """Of the methods that gave a surface: a diverged one's heap of flat triangles would press the others down."""
    whole = [record for record in run.records_of(molecule) if not steps_until_divergence(record)]
    counts = [number(record, "metrics", "after", quantity, "histogram", "counts") or [0] for record in whole]
    return max((max(count) for count in counts), default=0)


def tell_divergence(axes, record):
    steps = steps_until_divergence(record)
    if steps:
        axes.text(0.97, 0.95, f"diverged at step {steps}", transform=axes.transAxes, ha="right", va="top", fontsize=8, style="italic")


def label_row(axes, run, molecule, count_label, is_low):
    title = run.molecule_title(molecule)
    axes.set_ylabel(textwrap.fill(title, 16) if is_low else f"{title}\n{count_label}", fontsize=9 if is_low else 10)
    if is_low:
        axes.locator_params(axis="y", nbins=3)


def histogram_figure(run, quantity, label, limits, ticks, count_label):
    rows, columns = len(run.molecules), len(run.methods)
    is_low = rows > TALL_ROWS
    height = (LOW_ROW if is_low else TALL_ROW) * rows + 0.7
    figure, panels = plt.subplots(rows, columns, figsize=(max(6.0, 3.2 * columns), height), squeeze=False, sharex=True, sharey="row",
                                  layout="constrained")
    for row, molecule in enumerate(run.molecules):
        highest = highest_count(run, molecule, quantity)
        for column, (method, (colour, _)) in enumerate(zip(run.methods, styles_of(run.methods))):
            axes = panels[row][column]
            draw_histogram(axes, run.record(molecule, method), quantity, colour)
            tell_divergence(axes, run.record(molecule, method))
            axes.set_xlim(*limits)
            axes.set_xticks(ticks)
            axes.yaxis.set_major_formatter(THOUSANDS)
            if row == 0:
                axes.set_title(run.method_title(method))
            if row == rows - 1:
                axes.set_xlabel(label)
        if highest:
            panels[row][0].set_ylim(0, HEADROOM * highest)
        label_row(panels[row][0], run, molecule, count_label, is_low)
    if is_low:
        figure.supylabel(count_label, fontsize=10)
    figure.align_ylabels(panels[:, 0])
    return figure


def figure6(run):
    return histogram_figure(run, "edge_ratio", "shortest / longest edge", (0, 1), [0, 0.2, 0.4, 0.6, 0.8, 1.0], "triangles per 0.02")


def figure7(run):
    return histogram_figure(run, "angle_deg", "angle (°)", (0, 180), [0, 30, 60, 90, 120, 150, 180], "angles per 2°")
