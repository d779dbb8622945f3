#!/usr/bin/python3
"""Draws a surface coloured by its electrostatic potential, from two opposite sides: the picture of the README.

usage: electrostatic_surface.py POTENTIAL.vtp|.ply OUT.png [--limit KT] [--view X Y Z] [--title TEXT]

The file is what `smopt solvate MESH MOLECULE -o FILE` writes. Red is negative, blue positive, and full colour is reached at the given
limit (default 5 kT/e). The view is the direction from the molecule to the viewer (default: along the shortest axis of the molecule). Each
pixel is shaded by itself, with the normal and the potential interpolated over its triangle. Needs Debian's python3-matplotlib.
"""
import argparse
import base64
import gzip
import xml.etree.ElementTree as xml

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import LinearSegmentedColormap

FIELD = "potential_kT_per_e"
# Red–white–blue as the field draws it, a little darker at the ends so that shading stays visible.
COLORS = LinearSegmentedColormap.from_list(
    "potential", [(0.78, 0.05, 0.10), (0.96, 0.55, 0.50), (0.97, 0.97, 0.95), (0.52, 0.62, 0.95), (0.08, 0.15, 0.75)]
)
LIGHT = np.array([-0.35, 0.45, 0.82])  # right, up, towards the viewer
PIXELS = 760  # of the drawing's side
MARGIN = 6  # pixels above and below what is drawn
SAMPLES = 2  # a pixel is the mean of 2 × 2


def read_vtp(data):
    """Points (n × 3), triangles (m × 3) and potential (n) of a VTP file as smopt writes it."""

    def array(name, kind):
        text = next(e for e in root.iter("DataArray") if e.get("Name") == name and e.text.strip()).text
        return np.frombuffer(base64.b64decode(text)[8:], dtype=kind)

    root = xml.fromstring(data)
    return array("Points", "<f8").reshape(-1, 3), array("connectivity", "<i8").reshape(-1, 3), array(FIELD, "<f8")


def read_ply(data):
    """The same of a PLY file as smopt writes it."""
    header, body = data.split(b"end_header\n", 1)
    words = [line.split() for line in header.decode().splitlines()]
    vertices, faces = (int(line[2]) for line in words if line[0] == "element")
    names = [line[2] for line in words if line[:2] == ["property", "double"]]
    rows = np.frombuffer(body, dtype="<f8", count=vertices * len(names)).reshape(vertices, len(names))
    corners = np.frombuffer(body[rows.nbytes :], dtype=[("count", "u1"), ("corners", "<u4", 3)], count=faces)["corners"]
    return rows[:, :3], corners.astype(int), rows[:, names.index(FIELD)]


def read_surface(path):
    with (gzip.open if path.endswith(".gz") else open)(path, "rb") as file:
        data = file.read()
    if FIELD.encode() not in data:
        raise SystemExit(f"{path}: no {FIELD} in it; write it by smopt solvate MESH MOLECULE -o FILE.vtp")
    points, triangles, potential = read_ply(data) if data.startswith(b"ply") else read_vtp(data)
    a, b, c = (points[triangles[:, k]] for k in range(3))
    is_inwards = np.einsum("ij,ij", a, np.cross(b, c)) < 0
    return points, triangles[:, ::-1] if is_inwards else triangles, potential


def vertex_normals(points, triangles):
    corners = points[triangles]
    normals = np.zeros_like(points)
    face_normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    for k in range(3):
        np.add.at(normals, triangles[:, k], face_normals)
    return normals / np.maximum(np.linalg.norm(normals, axis=1), 1e-30)[:, None]


def frame(points, toward):
    """Rows: right, up and towards the viewer; the molecule's long axis lies level."""
    axes = np.linalg.svd(points - points.mean(axis=0), full_matrices=False)[2]
    toward = axes[2] if toward is None else np.asarray(toward, dtype=float)
    toward = toward / np.linalg.norm(toward)
    right = axes[0] - axes[0] @ toward * toward
    right /= np.linalg.norm(right)
    return np.array([right, np.cross(toward, right), toward])


def rasterise(xy, depth, triangles, size):
    """For each pixel of a size × size picture the nearest triangle (-1: none), its three weights, and the depth. Pixel units."""
    nearest = np.full((size, size), -1)
    weights = np.zeros((size, size, 3))
    top = np.full((size, size), -np.inf)
    for t, corners in enumerate(triangles):
        a, b, c = xy[corners]
        double_area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        if double_area <= 0:
            continue
        x0, y0 = np.maximum(np.floor(np.minimum(np.minimum(a, b), c)).astype(int), 0)
        x1, y1 = np.minimum(np.ceil(np.maximum(np.maximum(a, b), c)).astype(int) + 1, size)
        y, x = np.mgrid[y0:y1, x0:x1] + 0.5
        wa = ((b[0] - x) * (c[1] - y) - (b[1] - y) * (c[0] - x)) / double_area
        wb = ((c[0] - x) * (a[1] - y) - (c[1] - y) * (a[0] - x)) / double_area
        w = np.stack([wa, wb, 1 - wa - wb], axis=-1)
        z = w @ depth[corners]
        seen = (w.min(axis=-1) >= 0) & (z > top[y0:y1, x0:x1])
        nearest[y0:y1, x0:x1][seen] = t
        weights[y0:y1, x0:x1][seen] = w[seen]
        top[y0:y1, x0:x1][seen] = z[seen]
    return nearest, weights, top


def blurred(image, radius):
    """Three box blurs, nearly a Gaussian."""
    for axis in (0, 1) * 3:
        padded = np.pad(image, [(radius + 1, radius) if k == axis else (0, 0) for k in (0, 1)], mode="edge")
        sums = np.cumsum(padded, axis=axis)
        window = 2 * radius + 1
        below, above = range(sums.shape[axis] - window), range(window, sums.shape[axis])
        image = (np.take(sums, above, axis) - np.take(sums, below, axis)) / window
    return image


def in_hollows(top, covered, radius, reach):
    """How much each pixel lies below what is around it, 0 to 1; `reach` in the units of depth."""
    floor = top[covered].min()
    share = np.maximum(blurred(covered.astype(float), radius), 1e-6)
    around = blurred(np.where(covered, top - floor, 0.0), radius) / share
    return np.clip((around - (np.where(covered, top, floor) - floor)) / reach, 0, 1)


def draw(points, triangles, potential, axes, view, scale, limit):
    """A square picture, RGB, white where there is nothing."""
    size = PIXELS * SAMPLES
    local = (points - (points.max(axis=0) + points.min(axis=0)) / 2) @ view.T
    xy = local[:, :2] * scale * size + size / 2
    nearest, weights, top = rasterise(xy, local[:, 2], triangles, size)
    covered = nearest >= 0
    corners, w = triangles[nearest[covered]], weights[covered]
    normals = np.einsum("pk,pkd->pd", w, (vertex_normals(points, triangles) @ view.T)[corners])
    normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-30)[:, None]
    values = np.einsum("pk,pk->p", w, potential[corners])
    light = LIGHT / np.linalg.norm(LIGHT)
    diffuse = np.clip(normals @ light, 0, 1)
    halfway = (light + [0, 0, 1]) / np.linalg.norm(light + [0, 0, 1])
    gloss = np.clip(normals @ halfway, 0, 1) ** 40
    hollow = in_hollows(top, covered, size // 60, 6.0)[covered]
    shade = (0.42 + 0.62 * diffuse) * (1 - 0.55 * hollow)
    image = np.ones((size, size, 3))
    image[covered] = np.clip(COLORS(0.5 + values / (2 * limit))[:, :3] * shade[:, None] + 0.16 * gloss[:, None], 0, 1)
    image = image.reshape(PIXELS, SAMPLES, PIXELS, SAMPLES, 3).mean(axis=(1, 3))
    axes.imshow(image, origin="lower", interpolation="lanczos")
    drawn = np.nonzero(image.min(axis=(1, 2)) < 1)[0]
    axes.set_ylim(drawn[0] - MARGIN, drawn[-1] + MARGIN)
    axes.set_axis_off()


def add_legend(figure, limit, inches):
    bar = figure.add_axes([0.32, 0.52 / inches, 0.36, 0.18 / inches])
    bar.imshow(np.linspace(0, 1, 512)[None, :], aspect="auto", cmap=COLORS, extent=(-limit, limit, 0, 1))
    bar.set_yticks([])
    bar.set_xticks(np.linspace(-limit, limit, 5))
    bar.set_xticklabels([f"{x:+g}".replace("-", "−") if x else "0" for x in np.linspace(-limit, limit, 5)])
    bar.tick_params(length=3, labelsize=10)
    bar.set_xlabel("electrostatic potential on the surface (kT/e)", fontsize=10)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("surface")
    parser.add_argument("output")
    parser.add_argument("--limit", type=float, default=5.0)
    parser.add_argument("--view", nargs=3, type=float)
    parser.add_argument("--title", default="")
    options = parser.parse_args()
    points, triangles, potential = read_surface(options.surface)
    front = frame(points, options.view)
    back = np.array([-front[0], front[1], -front[2]])
    width, height = (np.ptp(points @ axis) for axis in front[:2])
    extent = max(width, height)
    inches = 5.4 * height / extent + 0.95
    figure, axes = plt.subplots(1, 2, figsize=(11, inches), dpi=110)
    figure.subplots_adjust(left=0.01, right=0.99, top=0.99 if not options.title else 0.92, bottom=0.85 / inches, wspace=0.02)
    for ax, view in zip(axes, (front, back)):
        draw(points, triangles, potential, ax, view, 0.96 / extent, options.limit)
    if options.title:
        figure.suptitle(options.title, fontsize=12)
    add_legend(figure, options.limit, inches)
    figure.savefig(options.output, metadata={"Software": None})


if __name__ == "__main__":
    main()
