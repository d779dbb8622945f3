#!/usr/bin/python3
"""Draws the same patch of two surface meshes side by side, shaded, with edges: the picture of the README.

usage: before_after.py BEFORE.off AFTER.off OUT.png [--center X Y Z] [--size ANGSTROM]

The patch is what lies within a square of the given size (default 16 Å) around the centre (default: the corner of the worst triangle of the
first mesh that faces the viewer), seen along the mean normal there. Needs Debian's python3-matplotlib.
"""
import argparse

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection

GOOD = np.array([0.36, 0.62, 0.80])  # blue: readable beside orange for every kind of colour vision
BAD = np.array([0.90, 0.45, 0.05])
BAD_ANGLE_DEG = 20.0


def read_off(path):
    """Points (n × 3) and triangles (m × 3) of an OFF file."""
    with open(path, encoding="ascii") as file:
        lines = file.read().split("\n")
    vertices, faces = (int(n) for n in lines[1].split()[:2])
    points = np.array([line.split()[:3] for line in lines[2 : 2 + vertices]], dtype=float)
    triangles = np.array([line.split()[1:4] for line in lines[2 + vertices : 2 + vertices + faces]], dtype=int)
    return points, triangles


def smallest_angles(points, triangles):
    """Smallest angle of each triangle, degrees."""
    a, b, c = (points[triangles[:, i]] for i in range(3))
    lengths = np.sort([np.linalg.norm(b - a, axis=1), np.linalg.norm(c - b, axis=1), np.linalg.norm(a - c, axis=1)], axis=0)
    cosine = (lengths[1] ** 2 + lengths[2] ** 2 - lengths[0] ** 2) / (2 * lengths[1] * lengths[2])
    return np.degrees(np.arccos(np.clip(cosine, -1, 1)))


def frame_at(points, triangles, center, radius):
    """Right, up and towards-the-viewer directions for the mean normal around the centre."""
    a, b, c = (points[triangles[:, i]] for i in range(3))
    near = np.linalg.norm(a - center, axis=1) < radius
    toward = np.cross(b - a, c - a)[near].sum(axis=0)
    toward /= np.linalg.norm(toward)
    right = np.cross(np.eye(3)[np.argmin(np.abs(toward))], toward)
    right /= np.linalg.norm(right)
    return np.array([right, np.cross(toward, right), toward])


def draw(axes, points, triangles, center, frame, size, title):
    local = (points - center) @ frame.T
    corners = local[triangles]
    middle = corners.mean(axis=1)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    shown = (np.abs(middle[:, :2]).max(axis=1) < 0.75 * size) & (normals[:, 2] > 0)
    corners, normals, middle = corners[shown], normals[shown], middle[shown]
    light = np.array([0.3, 0.4, 0.87])
    shade = np.clip(normals @ light / np.maximum(np.linalg.norm(normals, axis=1), 1e-30), 0, 1)
    bad = smallest_angles(points, triangles[shown]) < BAD_ANGLE_DEG
    colors = np.where(bad[:, None], BAD, GOOD) * (0.45 + 0.55 * shade[:, None])
    order = np.argsort(middle[:, 2])
    axes.add_collection(PolyCollection(corners[order][:, :, :2], facecolors=colors[order], edgecolors="#102030", linewidths=0.35))
    axes.set_xlim(-size / 2, size / 2)
    axes.set_ylim(-size / 2, size / 2)
    axes.set_aspect("equal")
    axes.set_xticks([])
    axes.set_yticks([])
    axes.set_title(title, fontsize=11)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("before")
    parser.add_argument("after")
    parser.add_argument("output")
    parser.add_argument("--center", nargs=3, type=float)
    parser.add_argument("--size", type=float, default=16.0)
    options = parser.parse_args()
    before, after = read_off(options.before), read_off(options.after)
    center = np.array(options.center) if options.center else before[0][before[1][np.argmin(smallest_angles(*before)), 0]]
    frame = frame_at(*before, center, options.size / 2)
    figure, axes = plt.subplots(1, 2, figsize=(11, 5.9), dpi=110)
    for ax, mesh, name in zip(axes, (before, after), ("before", "after")):
        share = 100 * np.mean(smallest_angles(*mesh) < BAD_ANGLE_DEG)
        draw(ax, *mesh, center, frame, options.size, f"{name}: {share:.1f} % of the triangles have an angle below 20° (orange)")
    figure.tight_layout()
    figure.savefig(options.output, metadata={"Software": None})


if __name__ == "__main__":
    main()
