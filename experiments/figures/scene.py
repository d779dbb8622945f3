"""Pictures of triangle meshes by POV-Ray, a ray tracer: it needs no display and no graphics driver, and draws what is translucent in the right order."""

import os
import pathlib
import shutil
import subprocess
import tempfile

import matplotlib.image
import numpy

SURFACE = (0.72, 0.80, 0.90)
EDGE = (0.10, 0.16, 0.28)
TIME_LIMIT_SECONDS = 900

# The viewer looks along +z with x to the right and y up. One light over the left shoulder, which casts shadows, and a weak one from the viewer.
HEADER = """#version 3.7;
global_settings {{ assumed_gamma 1.0 max_trace_level 40 }}
background {{ color srgb <1, 1, 1> }}
camera {{ orthographic location <0, 0, {near:.6g}> direction z right <{width:.6g}, 0, 0> up <0, {height:.6g}, 0> }}
light_source {{ <{left:.6g}, {above:.6g}, {near:.6g}> color rgb 0.85 }}
light_source {{ <0, 0, {near:.6g}> color rgb 0.30 shadowless }}
#default {{ finish {{ ambient rgb 0.16 diffuse 0.75 specular 0.08 roughness 0.05 }} }}
"""


class Missing(Exception):
    """What is not installed, and what brings it."""


def povray():
    program = shutil.which(os.environ.get("SMOPT_POVRAY") or "povray")
    if program is None:
        raise Missing("POV-Ray is not installed (Debian package povray; or set SMOPT_POVRAY)")
    return program


def read_ply(path):
    """Points and triangles of a binary PLY as smopt writes it: doubles x, y, z; a list of three 32-bit indices."""
    content = pathlib.Path(path).read_bytes()
    header, body = content.split(b"end_header\n", 1)
    counts = {words[1]: int(words[2]) for line in header.decode().splitlines() if (words := line.split())[0] == "element"}
    points = numpy.frombuffer(body, "<f8", 3 * counts["vertex"]).reshape(-1, 3)
    faces = numpy.frombuffer(body, numpy.dtype([("count", "u1"), ("corners", "<u4", 3)]), counts["face"], offset=points.nbytes)
    return points, faces["corners"].astype(numpy.int64)


def color(rgb, transmit=0.0):
    return f"srgbt <{rgb[0]:.4g}, {rgb[1]:.4g}, {rgb[2]:.4g}, {transmit:.4g}>"


def vectors(rows, form):
    return ",".join(map(form.__mod__, map(tuple, rows.tolist())))


def mesh(points, triangles, texture):
    """Flat triangles, so that what is shown is what the mesh is."""
    return (f"mesh2 {{ vertex_vectors {{ {len(points)}, {vectors(points, '<%.6g,%.6g,%.6g>')} }}\n"
            f"face_indices {{ {len(triangles)}, {vectors(triangles, '<%d,%d,%d>')} }}\n{texture} }}\n")


def edges_of(triangles):
    """Each once, with the smaller index first."""
    sides = numpy.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    return numpy.unique(sides, axis=0)


def faces_viewer(points, triangles):
    """Which triangles turn their front to the viewer, who looks along +z."""
    a, b, c = (points[triangles[:, corner]] for corner in range(3))
    return numpy.cross(b - a, c - a)[:, 2] > 0


def ribbons(points, edges, width, lift):
    """The edges as flat bands that face the viewer, a little before the surface: far cheaper than a cylinder each."""
    start, end = points[edges[:, 0]] - [0, 0, lift], points[edges[:, 1]] - [0, 0, lift]
    along = (end - start)[:, :2]
    length = numpy.linalg.norm(along, axis=1, keepdims=True)
    along = numpy.divide(along, length, out=numpy.zeros_like(along), where=length > 0)
    across = numpy.column_stack([-along[:, 1], along[:, 0], numpy.zeros(len(along))]) * (width / 2)
    corners = numpy.stack([start - across, start + across, end + across, end - across], axis=1).reshape(-1, 3)
    first = 4 * numpy.arange(len(edges))[:, None]
    bands = numpy.concatenate([first + [0, 1, 2], first + [0, 2, 3]])
    return mesh(corners, bands, f"pigment {{ color {color(EDGE)} }} finish {{ ambient 1 diffuse 0 specular 0 }} no_shadow")


def rods(points, edges, radius, rgb):
    """The edges as round bars with round ends."""
    texture = f"pigment {{ color {color(rgb)} }} no_shadow"
    bars = [f"cylinder {{ <%.6g,%.6g,%.6g>, <%.6g,%.6g,%.6g>, {radius:.6g} }}" % (*start, *end)
            for start, end in points[edges].tolist() if start != end]
    balls = [f"sphere {{ <%.6g,%.6g,%.6g>, {radius:.6g} }}" % tuple(point) for point in points[numpy.unique(edges)].tolist()]
    return "union {{ {} {} }}\n".format("\n".join(bars + balls), texture)


def render(objects, size, width, depth):
    """The picture as an array of rows of red, green and blue. `size` is in pixels, `width` and `depth` are in the objects' unit."""
    near = -2 * depth
    header = HEADER.format(near=near, width=width, height=width * size[1] / size[0], left=-1.2 * depth, above=1.6 * depth)
    program = povray()
    with tempfile.TemporaryDirectory(prefix="smopt-povray-") as folder:
        pathlib.Path(folder, "scene.pov").write_text(header + "".join(objects), encoding="ascii")
        command = [program, "+Iscene.pov", "+Oscene.png", "+FN8", f"+W{size[0]}", f"+H{size[1]}", "+A0.1", "+AM2", "+R2", "-J", "-D", "-GA", "+BS16"]
        outcome = subprocess.run(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                 timeout=TIME_LIMIT_SECONDS, check=False)
        picture = pathlib.Path(folder, "scene.png")
        if outcome.returncode != 0 or not picture.exists():
            raise RuntimeError(f"{program} failed: {outcome.stdout.decode(errors='replace')[-2000:]}")
        return matplotlib.image.imread(picture)[:, :, :3]
