"""Figure 4: a molecule's mesh before and after, and an intersecting pair of ISO2mesh's mesh from near; the same place in the others.

What is drawn is chosen by figure4_input.cpp and pair_view.cpp; here it is rendered and put together. All pictures look in one direction.
"""

import textwrap

import matplotlib.pyplot as plt
import numpy
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Rectangle

import scene
from drawing import grouped
from run_records import is_done, number
from scene import Missing  # noqa: F401 (for who calls figure4)

FIGURE4_DPI = 250
COLUMN = 880  # pixels of a picture's width: three and what is between them are 2800
CLOSE_UP_HEIGHT = 700
GAP, MARGIN, TITLE, CAPTION, FOOT = 50, 30, 180, 100, 110  # pixels
ASPECT = (0.8, 1.35)  # a whole molecule's picture is no flatter and no taller, height by width
FRAME = 1.04  # the picture, by what there is to see
SHORTEST_DRAWN_EDGE = 2.5  # pixels, in the mean: with shorter ones a picture is all edges
EDGE_PIXELS = 0.45  # their width
LIFT = 0.1  # of the mean edge's length: by how much they are before the surface
SMALLEST_MARK = 24  # pixels
# The radius of a close-up's bars, by that of the piece; and how much of the light behind them the triangles let through.
ROD, PAIR_ROD, CROSSING_ROD = 0.004, 0.007, 0.014
SURROUNDINGS_TRANSMIT, PAIR_TRANSMITS = 0.5, 0.15
MESSAGE_WIDTH = 42  # characters
RED, YELLOW = (0.80, 0.06, 0.08), (1.0, 0.82, 0.10)
CROSSING = (0.0, 0.0, 0.0)
TITLES = {"initial": "initial mesh", "smopt": "improved by SMOPT", "iso2mesh": "improved by ISO2mesh"}


class View:
    """Coordinates of the pictures, as POV-Ray wants them: x to the right, y up, z away from the viewer; the origin is the meshes' middle."""

    def __init__(self, towards, points):
        self.middle = (points.min(axis=0) + points.max(axis=0)) / 2
        centred = points - self.middle
        axes = numpy.linalg.eigh(centred.T @ centred)[1]  # the shortest first
        self.towards = same_way(axes[:, 0]) if towards is None else numpy.asarray(towards)
        self.up = self.most_upright(centred)
        self.right = numpy.cross(self.up, self.towards)

    def most_upright(self, centred):
        """Perpendicular to the line of sight, along the molecule's longest extent as it is seen."""
        flat = centred - numpy.outer(centred @ self.towards, self.towards)
        return same_way(numpy.linalg.eigh(flat.T @ flat)[1][:, 2])

    def of(self, points):
        return (points - self.middle) @ numpy.column_stack([self.right, self.up, -self.towards])


def same_way(axis):
    """An axis has no sign of its own: its largest component is made positive."""
    return axis * numpy.sign(axis[numpy.argmax(numpy.abs(axis))])


def round_length(longest):
    """The longest of 1, 2, 5 and their multiples by ten that is not above this one."""
    power = 10.0 ** numpy.floor(numpy.log10(longest))
    return max(step * power for step in (1, 2, 5) if step * power <= longest)


class Shown:
    """A column of the figure: a method's mesh as the viewer sees it, or why there is none."""

    def __init__(self, run, molecule, method, mesh):
        self.method = method
        self.record = run.record(molecule, method)
        self.points = self.triangles = None
        self.why_not = why_no_mesh(self.record, mesh)
        if self.why_not is None:
            points, self.triangles = scene.read_ply(mesh)
            self.points = points if numpy.isfinite(points).all() else None
            self.why_not = None if self.points is not None else "its coordinates are not finite"

    def numbers(self):
        if self.points is None:
            return ""
        pairs = number(self.record, "metrics", "after", "intersecting_pairs")
        told = "pairs not counted" if pairs is None else f"{grouped(pairs)} intersecting pair{'' if pairs == 1 else 's'}"
        return f"{grouped(len(self.points))} vertices, {told}"


def why_no_mesh(record, mesh):
    if record is not None and not is_done(record):
        return f"failed: {record['reason']}"
    if mesh is None:
        return "not run" if record is None else "its mesh was not kept"
    return None


def paint(rgb, transmit=0.0):
    return f"pigment {{ color {scene.color(rgb, transmit)} }}"


def render_whole(points, triangles, size, width):
    pixel = width / size[0]
    edges = scene.edges_of(triangles[scene.faces_viewer(points, triangles)])
    mean_edge = float(numpy.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1).mean())
    objects = [scene.mesh(points, triangles, paint(scene.SURFACE))]
    if mean_edge >= SHORTEST_DRAWN_EDGE * pixel:
        objects.append(scene.ribbons(points, edges, EDGE_PIXELS * pixel, LIFT * mean_edge))
    return scene.render(objects, size, width, float(numpy.abs(points).max()))


def pair_objects(points, triangles, pair, crossing):
    """The two triangles let a little of each other show through, so that each is seen to go on behind the other."""
    radius = pair["radius"]
    objects = [scene.mesh(points[triangles[face]], numpy.array([[0, 1, 2]]), paint(rgb, PAIR_TRANSMITS) + " no_shadow")
               for face, rgb in zip(pair["faces"], (RED, YELLOW))]
    objects.append(scene.rods(points, scene.edges_of(triangles[pair["faces"]]), PAIR_ROD * radius, scene.EDGE))
    objects.append(scene.rods(crossing, numpy.array([[0, 1]]), CROSSING_ROD * radius, CROSSING))
    return objects


def render_close_up(shown, view, pair):
    """The piece of a mesh in the sphere around the pair; None where the mesh has nothing there."""
    centre, radius = view.of(numpy.array([pair["centre"]]))[0], pair["radius"]
    points, triangles = view.of(shown.points) - centre, shown.triangles
    inside = (numpy.linalg.norm(points, axis=1) < radius)[triangles].any(axis=1)
    if not inside.any():
        return None
    has_pair = shown.method == "iso2mesh"
    inside[pair["faces"] if has_pair else []] = False
    surroundings = triangles[inside]
    objects = [scene.mesh(points, surroundings, paint(scene.SURFACE, SURROUNDINGS_TRANSMIT) + " no_shadow"),
               scene.rods(points, scene.edges_of(surroundings), ROD * radius, scene.EDGE)]
    if has_pair:
        objects += pair_objects(points, triangles, pair, view.of(numpy.array(pair["crossing"])) - centre)
    return scene.render(objects, (COLUMN, CLOSE_UP_HEIGHT), close_up_width(pair), float(numpy.abs(points[surroundings]).max()))


def close_up_width(pair):
    """Of the rectangle whose corners are on the sphere."""
    return 2 * pair["radius"] / numpy.hypot(1, CLOSE_UP_HEIGHT / COLUMN)


class Page:
    """Axes placed by the pixel, from the top left, so that a picture's pixels are the figure's."""

    def __init__(self, width, height):
        self.width, self.height = width, height
        self.figure = plt.figure(figsize=(width / FIGURE4_DPI, height / FIGURE4_DPI))

    def axes(self, left, top, size):
        axes = self.figure.add_axes((left / self.width, 1 - (top + size[1]) / self.height, size[0] / self.width, size[1] / self.height))
        axes.set_xticks([])
        axes.set_yticks([])
        axes.set(xlim=(0, size[0]), ylim=(size[1], 0))
        return axes

    def text(self, left, top, text, **style):
        self.figure.text(left / self.width, 1 - top / self.height, text, **style)


def put_picture(axes, picture, has_frame):
    axes.spines[:].set_visible(has_frame)
    height, width = picture.shape[:2]
    axes.imshow(picture, interpolation="none", extent=(0, width, height, 0), aspect="auto")


def put_message(axes, text):
    axes.spines[:].set_visible(True)
    axes.spines[:].set_color("#bbbbbb")
    axes.text(0.5, 0.5, textwrap.fill(textwrap.shorten(text, 8 * MESSAGE_WIDTH, placeholder=" …"), MESSAGE_WIDTH), transform=axes.transAxes,
              ha="center", va="center", fontsize=11)


def put_scale_bar(axes, size, width):
    """A fifth of the picture's width or less, in its lower left corner."""
    length = round_length(width / 5)
    pixels, left, base = length * size[0] / width, 0.04 * size[0], size[1] - 0.04 * size[0]
    axes.plot([left, left + pixels], [base, base], color="black", linewidth=2.5, solid_capstyle="butt")
    axes.text(left + pixels / 2, base - 12, f"{length:g} Å", ha="center", va="bottom", fontsize=11,
              bbox={"facecolor": "white", "alpha": 0.8, "linewidth": 0, "pad": 1})


def mark_place(axes, size, width, frame_middle, view, pair):
    """A frame around what the picture below shows."""
    scale = size[0] / width
    x, y = (view.of(numpy.array([pair["centre"]]))[0, :2] - frame_middle) * [scale, -scale] + numpy.array(size) / 2
    wide = max(close_up_width(pair) * scale, SMALLEST_MARK)
    high = wide * CLOSE_UP_HEIGHT / COLUMN
    for colour, line in (("white", 3.0), ("black", 1.4)):
        axes.add_patch(Rectangle((x - wide / 2, y - high / 2), wide, high, fill=False, edgecolor=colour, linewidth=line))


class WholeFrame:
    """The part of the picture plane that holds all the meshes, and the picture's size."""

    def __init__(self, all_points):
        low = numpy.min([points[:, :2].min(axis=0) for points in all_points], axis=0)
        high = numpy.max([points[:, :2].max(axis=0) for points in all_points], axis=0)
        extent = (high - low) * FRAME
        aspect = min(max(extent[1] / extent[0], ASPECT[0]), ASPECT[1])
        self.middle = (low + high) / 2
        self.width = max(extent[0], extent[1] / aspect)
        self.size = (COLUMN, round(COLUMN * aspect))

    def centred(self, points):
        return points - [*self.middle, 0]


def draw_whole(axes, shown, view, frame, pair):
    if shown.points is None:
        return put_message(axes, shown.why_not)
    put_picture(axes, render_whole(frame.centred(view.of(shown.points)), shown.triangles, frame.size, frame.width), False)
    put_scale_bar(axes, frame.size, frame.width)
    if pair:
        mark_place(axes, frame.size, frame.width, frame.middle, view, pair)


def draw_close_up(axes, shown, view, pair, why_no_pair):
    if shown.points is None:
        return put_message(axes, shown.why_not)
    if not pair:
        return put_message(axes, why_no_pair)
    picture = render_close_up(shown, view, pair)
    if picture is None:
        return put_message(axes, "this mesh has no triangle at this place")
    put_picture(axes, picture, True)
    put_scale_bar(axes, (COLUMN, CLOSE_UP_HEIGHT), close_up_width(pair))


def put_legend(page, pair):
    handles = [Patch(facecolor=RED, edgecolor="black", label="intersecting triangle"), Patch(facecolor=YELLOW, edgecolor="black", label="the triangle it intersects"),
               Line2D([], [], color=CROSSING, linewidth=3, label="where they cross"),
               Patch(facecolor="none", edgecolor="black", linewidth=1.4, label="place shown below")]
    if pair:
        page.figure.legend(handles=handles, loc="lower center", ncols=4, frameon=False, fontsize=11, bbox_to_anchor=(0.5, 0.0))


def figure4(run, description):
    scene.povray()  # before any work
    molecule, pair = description["molecule"], description["pair"]
    columns = [Shown(run, molecule, panel["method"], panel["mesh"]) for panel in description["panels"]]
    meshes = [shown.points for shown in columns if shown.points is not None]
    view = View(pair["towards"] if pair else None, meshes[0])
    frame = WholeFrame([view.of(points) for points in meshes])
    below = TITLE + frame.size[1] + CAPTION
    page = Page(3 * COLUMN + 2 * GAP + 2 * MARGIN, below + CLOSE_UP_HEIGHT + FOOT)
    page.text(MARGIN, 20, run.molecule_title(molecule), fontsize=14, va="top")
    for column, (letter, shown) in enumerate(zip("abc", columns)):
        left = MARGIN + column * (COLUMN + GAP)
        page.text(left, TITLE - 20, f"({letter}) {TITLES[shown.method]}", fontsize=13, va="bottom", fontweight="bold")
        draw_whole(page.axes(left, TITLE, frame.size), shown, view, frame, pair)
        page.text(left + COLUMN / 2, TITLE + frame.size[1] + 20, shown.numbers(), fontsize=12, va="top", ha="center")
        draw_close_up(page.axes(left, below, (COLUMN, CLOSE_UP_HEIGHT)), shown, view, pair, description["why_no_pair"])
    put_legend(page, pair)
    return page.figure
