"""What all figures have in common: matplotlib as it is everywhere, colours, numbers, files."""

import sys

try:
    import matplotlib
except ImportError:
    sys.exit(f"{sys.executable} has no matplotlib; install Debian's package python3-matplotlib, or set SMOPT_PYTHON to a Python that has it")

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402 (the backend comes first)
import matplotlib.ticker  # noqa: E402

# Okabe and Ito's colours (2008), which stay apart for the colour-blind; the markers keep them apart in black and white.
PREPARED = "initial, cavities deleted"
STYLES = {
    "initial": ("#999999", "s"),
    PREPARED: ("#56B4E9", "D"),
    "smopt": ("#0072B2", "o"),
    "laplacian": ("#E69F00", "v"),
    "iso2mesh": ("#009E73", "^"),
    "meshlab": ("#D55E00", "P"),
}
OTHER_STYLES = [("#CC79A7", "X"), ("#F0E442", "*"), ("#000000", "<"), ("#8C510A", ">")]

VERY_SHORT = 4  # high by low end of an axis: it may have none of 1, 2, 5 and their multiples by ten
PNG_DPI = 150  # 1500 pixels over a figure of ten inches

THOUSANDS = matplotlib.ticker.FuncFormatter(lambda value, _: grouped(value))
PLAIN = matplotlib.ticker.FuncFormatter(lambda value, _: f"{value:g}")


def grouped(value):
    """A whole number with its thousands apart."""
    return f"{value:,.0f}".replace(",", "\N{NO-BREAK SPACE}")


def set_style():
    matplotlib.rcdefaults()  # no settings of the user's: the same picture everywhere
    matplotlib.rcParams.update({
        "font.family": "DejaVu Sans", "font.size": 10, "axes.titlesize": 11, "axes.spines.top": False, "axes.spines.right": False,
        "figure.constrained_layout.w_pad": 0.08, "svg.hashsalt": "smopt", "savefig.dpi": PNG_DPI,
    })


def styles_of(series):
    """A colour and a marker for each name."""
    others = iter(OTHER_STYLES * len(series))
    return [STYLES[name] if name in STYLES else next(others) for name in series]


def band_rows(axes, count):
    """Every other row is shaded, the first is on top."""
    for row in range(0, count, 2):
        axes.axhspan(row - 0.5, row + 0.5, color="#f4f4f4", zorder=0, linewidth=0)
    axes.set_ylim(count - 0.5, -0.5)
    axes.tick_params(axis="y", length=0, pad=7)


def label_decades(axes):
    """Plain numbers on a logarithmic axis; between the decades, too, where there are few of them."""
    low, high = axes.get_xlim()
    if high < VERY_SHORT * low:
        axes.xaxis.set_major_locator(matplotlib.ticker.MaxNLocator(5))
        axes.xaxis.set_minor_locator(matplotlib.ticker.NullLocator())
        axes.xaxis.set_major_formatter(THOUSANDS if low >= 1 else PLAIN)
        return
    is_short = high < 40 * low
    axes.xaxis.set_major_locator(matplotlib.ticker.LogLocator(subs=(1, 2, 5) if is_short else (1,)))
    axes.xaxis.set_major_formatter(THOUSANDS if low >= 1 else PLAIN)
    axes.xaxis.set_minor_formatter(matplotlib.ticker.NullFormatter())


def save(figure, folder, name, dpi=PNG_DPI):
    figure.savefig(folder / f"{name}.svg", metadata={"Date": None, "Creator": None}, dpi=dpi)
    figure.savefig(folder / f"{name}.png", metadata={"Software": None}, dpi=dpi)
    plt.close(figure)
