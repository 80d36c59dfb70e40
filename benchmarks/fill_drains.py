"""Drains of over a hundred made parts, judged by the meshes alone: ``python -m benchmarks.fill_drains``.

What was taken out of a part is part minus result, by manifold3d; what was drilled is that minus its voids as they were
before. Faces of it that lie on the part's own faces are skin that is gone: they must lie within the mouths of the holes
that the report lists. All of it must lie within those holes, and stay a wall away from every face of the part besides
the one that a hole leaves through. Voids that are closed are the shells of the result that
face inwards. Distances are those of points to triangles, by trimesh.
``--parts box`` and ``--patterns gyroid`` for a first look.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

import manifold3d
import numpy as np
import trimesh
from numpy.typing import NDArray
from trimesh import creation, transformations
from trimesh.triangles import closest_point

from infill import GeometryError, fill

SMOOTH, FACING = 30.0, 70.0  # degrees: faces that meet at more are two; how far from straight out a mouth may look
ON = 1e-5  # of the size: what is this near the skin lies on it
SPECK = 1e-3  # mm³
PROBE, FEW = 0.002, 60  # mm: the side of a cube by which solid is felt, within CLOSE of its middle; how many are
POINTS = 2000  # on what was drilled
PAIRS = 400_000  # of points and triangles at a time
CLOSE = 2e-3  # mm: single precision of manifold3d's output for parts of 100 mm, and points between the corners of holes

Floats = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Case:
    """A part and how it is filled and drained."""

    name: str
    part: trimesh.Trimesh
    drain: float
    wall: float = 1.2
    options: dict[str, Any] = field(default_factory=dict)


def solid_of(mesh: trimesh.Trimesh) -> manifold3d.Manifold:
    """Return a mesh as manifold3d has it."""
    found = manifold3d.Manifold(
        manifold3d.Mesh64(
            vert_properties=np.ascontiguousarray(mesh.vertices, dtype=np.float64),
            tri_verts=np.ascontiguousarray(mesh.faces, dtype=np.uint64),
        )
    )
    assert found.status() == manifold3d.Error.NoError, found.status()
    return found


def mesh_of(solid: manifold3d.Manifold) -> trimesh.Trimesh:
    """Return a solid of manifold3d as trimesh has it."""
    mesh = solid.to_mesh64()
    return trimesh.Trimesh(np.array(mesh.vert_properties)[:, :3], np.array(mesh.tri_verts), process=False)


def distances(points: Floats, triangles: Floats) -> Floats:
    """Return how far each point (N, 3) is from the nearest of some triangles (M, 3, 3)."""
    least = np.full(len(points), np.inf)
    low, high = triangles.min(axis=1), triangles.max(axis=1)
    at_once = max(1, PAIRS // max(len(triangles), 1))
    for begin in range(0, len(points), at_once) if len(triangles) else ():
        some = points[begin : begin + at_once]
        # A triangle is no nearer than the box around it, and no further than any of its corners.
        box = np.zeros((len(some), len(triangles)))
        corner = np.zeros((len(some), len(triangles)))
        for axis in range(3):
            place = some[:, axis, None]
            box += np.maximum(np.maximum(low[:, axis] - place, place - high[:, axis]), 0) ** 2
            corner += (triangles[:, 0, axis] - place) ** 2
        one, other = np.nonzero(box <= corner.min(axis=1, keepdims=True) + 1e-9)
        near = closest_point(triangles[other], some[one])
        np.minimum.at(least, begin + one, np.linalg.norm(near - some[one], axis=1))
    return least


def _nearest(points: Floats, triangles: Floats, far: float) -> float:
    """Return how near points (N, 3) come to triangles; infinite if to none of the box around them and so much."""
    if not len(points):
        return float("inf")
    low, high = points.min(axis=0) - far, points.max(axis=0) + far
    near = ((triangles.min(axis=1) <= high) & (triangles.max(axis=1) >= low)).all(axis=1)
    return float(distances(points, triangles[near]).min(initial=np.inf))


def _without_specks(solid: manifold3d.Manifold) -> manifold3d.Manifold:
    """Return a solid without what rounding leaves of surfaces that lie on one another."""
    return manifold3d.Manifold.compose([each for each in solid.decompose() if each.volume() > SPECK])


def _thick(points: Floats, solid: manifold3d.Manifold) -> NDArray[np.bool_]:
    """Return around which of some points (N, 3) a solid fills a share of a small cube: slivers of rounding do not."""
    found = np.zeros(len(points), dtype=bool)
    for number in np.unique(np.linspace(0, len(points) - 1, FEW).astype(int)) if len(points) else ():
        cube = manifold3d.Manifold.cube((PROBE,) * 3, True).translate(tuple(points[number]))
        found[number] = (cube ^ solid).volume() > 1e-3 * PROBE**3
    return found


def mouth_of(part: trimesh.Trimesh, at: Floats, way: Floats) -> NDArray[np.bool_]:
    """Return which faces of a part are of the smooth face that a hole leaves through, as far as that looks its way."""
    first = int(
        np.argmin(np.linalg.norm(closest_point(part.triangles, np.tile(at, (len(part.faces), 1))) - at, axis=1))
    )
    facing = part.face_normals @ way > np.cos(np.radians(FACING))
    pairs = part.face_adjacency[part.face_adjacency_angles < np.radians(SMOOTH)]
    pairs = pairs[facing[pairs].all(axis=1)]
    groups = trimesh.graph.connected_component_labels(pairs, node_count=len(part.faces))
    return facing & (groups == groups[first])


def along(points: Floats, at: Floats, to: Floats) -> tuple[Floats, Floats]:
    """Return how far points (N, 3) are from a line through two places, and how far beyond the first."""
    length = float(np.linalg.norm(at - to))
    way = (at - to) / length if length else np.array([0.0, 0.0, 1.0])
    beyond = (points - at) @ way
    return np.linalg.norm(points - at - beyond[:, None] * way, axis=1), beyond


def from_segment(points: Floats, at: Floats, to: Floats) -> Floats:
    """Return how far points (N, 3) are from the line between two places."""
    length = float(np.linalg.norm(to - at))
    share = np.clip((points - at) @ (to - at) / max(length**2, 1e-300), 0, 1) if length else np.zeros(len(points))
    return np.linalg.norm(points - at - share[:, None] * (to - at), axis=1)


def faults(case: Case, result: Any, voids: trimesh.Trimesh) -> Iterator[str]:
    """Yield in what a drained part is not what it should be; `voids` are what it had before it was drained."""
    report, part = result.report, case.part
    solid = result.mesh
    told = " ".join(report["problems"])
    if not solid.is_watertight or not report["closed"]:
        yield "not closed"
    shells = solid.split(only_watertight=False)
    outer = [each for each in shells if each.volume > 0]
    closed = [each for each in shells if each.volume < 0]
    own = [each for each in part.split(only_watertight=False) if each.volume > 0]
    if len(outer) != len(own):
        yield f"{len(outer)} components, and {len(own)} of the part"
    if len(closed) != len(report["voids"]["closed"]):
        yield f"{len(closed)} voids are closed, and {len(report['voids']['closed'])} are listed"
    if closed and "still sealed" not in told:
        yield f"{len(closed)} voids are closed, and that is not told"
    if closed and not case.options.get("open_"):
        largest = max(-each.volume for each in closed)
        if f"{largest:.3g} mm³" not in told:
            yield f"the largest closed void, {largest:.3g} mm³, is not told with its volume"
    whole, taken = solid_of(part), solid_of(part) - solid_of(solid)
    size = float(part.extents.max())
    rest = _without_specks(taken - solid_of(voids))
    drilled = mesh_of(rest)
    outlets = [hole for hole in report["drains"]["holes"] if hole["kind"] != "branch"]
    # Skin that is gone.
    on_skin = distances(drilled.triangles_center, part.triangles) < ON * size
    lost = drilled.triangles[on_skin].reshape(-1, 3)
    if report["request"]["open"] is None and len(lost):
        within = np.zeros(len(lost), dtype=bool)
        for hole in outlets:
            at, to = np.array(hole["at"]), np.array(hole["to"])
            within |= along(lost, at, to)[0] <= hole["diameter"] / 2 + CLOSE
        lost = lost[~within]
        lost = lost[_thick(lost, taken)]
        if len(lost):
            yield f"{len(lost)} corners of lost skin outside all mouths, such as {lost[0].round(3)}"
    if bool(on_skin.any()) != bool(outlets) and report["request"]["open"] is None:
        yield f"{len(outlets)} outlets, and {on_skin.sum()} faces of lost skin"
    # What was drilled.
    if not len(drilled.faces):
        if report["drains"]["holes"]:
            yield "holes are listed, and nothing was drilled"
        return
    points = np.concatenate([drilled.vertices, trimesh.sample.sample_surface(drilled, POINTS, seed=1)[0]])
    owned = np.zeros(len(points), dtype=bool)
    for hole in report["drains"]["holes"]:
        at, to, radius = np.array(hole["at"]), np.array(hole["to"]), hole["diameter"] / 2
        if hole["kind"] == "branch":
            mine = from_segment(points, at, to) <= radius + CLOSE
            other = part.triangles
        else:
            away, beyond = along(points, at, to)
            slack = radius * np.tan(np.radians(FACING)) + CLOSE
            length = float(np.linalg.norm(at - to))
            mine = (away <= radius + CLOSE) & (beyond <= slack) & (beyond >= -length - CLOSE)
            other = part.triangles[~mouth_of(part, at, (at - to) / length)]
        owned |= mine
        near = _nearest(points[mine], other, 2 * case.wall)
        if near < case.wall - CLOSE:
            yield f"a {hole['kind']} at {np.round(at, 2)} is {near:.3f} mm from other skin"
        if hole["wall"] is not None and hole["wall"] > near + 0.02 and hole["wall"] < near - CLOSE:
            yield f"a {hole['kind']} is said to be {hole['wall']:.3f} mm from other skin, and is {near:.3f}"
        if report["walls"]["least"] > near + 0.02:
            yield f"walls are said to be {report['walls']['least']:.3f} mm, and are {near:.3f}"
    stray = points[~owned]
    stray = stray[_thick(stray, rest)]
    if len(stray):
        yield f"{len(stray)} points of what was drilled lie in no hole that is listed, such as {stray[0].round(3)}"
    assert whole.volume() > 0


def run(case: Case) -> tuple[list[str], dict[str, Any] | str]:
    """Fill a part with and without drains, and return the faults and the report, or why it was refused."""
    options = {"density": 0.2, "wall": case.wall, "threads": 2, **case.options}
    try:
        result = fill(case.part, drain=case.drain, **options)
    except GeometryError as error:
        said = str(error)
        return ([] if "drain" in said and "\n" not in said else [f"refused for another reason: {said}"]), said
    return list(faults(case, result, result.stages.voids.to_trimesh())), result.report


# --- parts ------------------------------------------------------------------------------------------------------------


def box(x: float, y: float, z: float, at: tuple[float, float, float] = (0, 0, 0)) -> trimesh.Trimesh:
    mesh = creation.box((x, y, z))
    mesh.apply_translation(at)
    return mesh


def rod(radius: float, height: float, at: tuple[float, float, float] = (0, 0, 0), axis: str = "z") -> trimesh.Trimesh:
    mesh = creation.cylinder(radius=radius, height=height, sections=48)
    if axis != "z":
        mesh.apply_transform(transformations.rotation_matrix(np.pi / 2, (1, 0, 0) if axis == "y" else (0, 1, 0)))
    mesh.apply_translation(at)
    return mesh


def less(one: trimesh.Trimesh, *others: trimesh.Trimesh) -> trimesh.Trimesh:
    found = solid_of(one)
    for each in others:
        found -= solid_of(each)
    return mesh_of(found)


def union(*parts: trimesh.Trimesh) -> trimesh.Trimesh:
    found = solid_of(parts[0])
    for each in parts[1:]:
        found += solid_of(each)
    return mesh_of(found)


def tilted(mesh: trimesh.Trimesh, degrees: float, axis: tuple[float, float, float] = (1, 0.3, 0)) -> trimesh.Trimesh:
    mesh = mesh.copy()
    mesh.apply_transform(transformations.rotation_matrix(np.radians(degrees), axis))
    return mesh


def prism(points: list[tuple[float, float]], depth: float) -> trimesh.Trimesh:
    """A polygon in x and z, as deep along y, whichever way round it is given."""
    solid = manifold3d.CrossSection([points], manifold3d.FillRule.EvenOdd).extrude(depth)
    mesh = mesh_of(solid)
    mesh.apply_transform(transformations.rotation_matrix(np.pi / 2, (1, 0, 0)))
    return mesh


def cone(radius: float, height: float, *, down: bool = False) -> trimesh.Trimesh:
    mesh = creation.cone(radius=radius, height=height, sections=48)
    if down:
        mesh.apply_transform(transformations.rotation_matrix(np.pi, (1, 0, 0)))
    return mesh


def bracket() -> trimesh.Trimesh:
    """A plate and an upright one, with bolt holes in both and a rib between."""
    base = less(box(50, 32, 9), *(rod(2.7, 20, (x, y, 0)) for x in (-18, 6) for y in (-10, 10)))
    upright = less(box(9, 32, 38, (20.5, 0, 14.5)), *(rod(3, 20, (20.5, y, 22), "x") for y in (-9, 9)))
    rib = prism([(-5, 3.5), (17, 3.5), (17, 26)], 8)
    rib.apply_translation((0, 4, 0))
    return union(base, upright, rib)


PARTS: dict[str, Callable[[], trimesh.Trimesh]] = {
    "cube": lambda: box(30, 30, 30),
    "box": lambda: box(34, 22, 16),
    "tower": lambda: box(14, 14, 44),
    "plate": lambda: box(44, 34, 6),
    "strip": lambda: box(60, 8, 8),
    "cylinder": lambda: rod(13, 24),
    "lying cylinder": lambda: rod(10, 34, axis="x"),
    "tube": lambda: less(rod(17, 24), rod(8, 40)),
    "lying tube": lambda: less(rod(15, 26, axis="x"), rod(6, 40, axis="x")),
    "thin tube": lambda: less(rod(20, 22), rod(15.5, 40)),
    "ball": lambda: creation.icosphere(subdivisions=3, radius=14),
    "cone": lambda: cone(16, 26),
    "cone down": lambda: cone(18, 20, down=True),
    "wedge": lambda: prism([(0, 0), (36, 0), (36, 18)], 22),
    "wedge down": lambda: prism([(0, 0), (18, -18), (36, 0)], 24),
    "L": lambda: prism([(0, 0), (34, 0), (34, 10), (10, 10), (10, 32), (0, 32)], 20),
    "L down": lambda: prism([(0, 0), (34, 0), (34, -30), (24, -30), (24, -10), (0, -10)], 20),
    "arch": lambda: less(box(40, 20, 30), box(20, 30, 20, (0, 0, -6))),
    "slot": lambda: less(box(34, 24, 26), box(50, 14, 0.8, (0, 0, -8))),
    "bolted": lambda: less(box(36, 28, 14), *(rod(2.6, 30, (x, y, 0)) for x in (-12, 0, 12) for y in (-8, 8))),
    "cross bolted": lambda: less(
        box(36, 28, 18), *(rod(2.5, 60, (0, y, -3), "x") for y in (-8, 0, 8)), rod(3, 40, (8, 0, 0))
    ),
    "bracket": bracket,
    "chamfered": lambda: union(
        box(30, 24, 12, (0, 0, 3)),
        prism([(-15, -3), (-11, -7), (11, -7), (15, -3)], 24).apply_translation((0, 12, 0)),
    ),
    "tilted box": lambda: tilted(box(30, 22, 18), 25),
    "on its edge": lambda: tilted(box(26, 26, 26), 45, (1, 0, 0)),
    "on its corner": lambda: tilted(tilted(box(26, 26, 26), 45, (1, 0, 0)), 35.264, (0, 1, 0)),
    "tilted bracket": lambda: tilted(bracket(), 20),
    "cavity": lambda: less(box(34, 30, 30), box(12, 12, 6, (0, 0, -6))),
    "two": lambda: trimesh.util.concatenate([box(22, 20, 16), box(16, 22, 20, (30, 0, 0))]),
    "stair": lambda: union(box(40, 24, 10), box(26, 24, 20, (7, 0, 5)), box(13, 24, 30, (13.5, 0, 10))),
}
FAST = {"voxel": 0.5}  # of every fill here: the voids are those of the mesh, however fine
FILLS: dict[str, dict[str, Any]] = {
    "gyroid": {"pattern": "gyroid", "cell": 9.0, "density": 0.25},
    "grid": {"pattern": "grid", "density": 0.2},
    "octet": {"pattern": "octet", "cell": 9.0},
    "cubic": {"pattern": "cubic", "cell": 9.0, "density": 0.25},
    "honeycomb": {"pattern": "honeycomb", "density": 0.3},
}
SIZES = {"gyroid": (2.0, 1.2), "grid": (3.0, 1.0), "octet": (4.0, 1.5), "cubic": (2.5, 1.2), "honeycomb": (1.5, 0.8)}


def cases(parts: list[str], patterns: list[str]) -> Iterator[Case]:
    """Yield every part with every pattern, each pattern with drains and walls of its own; some with vents."""
    for number, name in enumerate(parts):
        for pattern in patterns:
            drain, wall = SIZES[pattern]
            vent = {"vent": True} if (number + patterns.index(pattern)) % 3 == 0 else {}
            yield Case(
                name=f"{name}, {pattern}{', vent' if vent else ''}",
                part=PARTS[name](),
                drain=drain,
                wall=wall,
                options={**FAST, **FILLS[pattern], **vent},
            )


def main() -> None:
    """Print what was found for each part."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--parts", nargs="*", default=list(PARTS), choices=list(PARTS))
    parser.add_argument("--patterns", nargs="*", default=list(FILLS), choices=list(FILLS))
    given = parser.parse_args()
    bad = count = 0
    for case in cases(given.parts, given.patterns):
        begin = time.perf_counter()
        wrong, report = run(case)
        count, bad = count + 1, bad + bool(wrong)
        if isinstance(report, str):
            said = f"refused: {report}"
        else:
            kinds = [hole["kind"] for hole in report["drains"]["holes"]]
            said = (
                f"{report['voids']['count']} voids, {len(report['voids']['closed'])} closed; "
                + ", ".join(f"{kinds.count(kind)} {kind}" for kind in dict.fromkeys(kinds))
                + f"; walls {report['walls']['least']:.3f} of {case.wall:g}"
            )
            said += "".join(f"\n    told: {each}" for each in report["problems"])
        print(f"{'FAULT' if wrong else 'well '} {case.name}: {said} ({time.perf_counter() - begin:.1f} s)", flush=True)
        for each in wrong:
            print(f"    {each}", flush=True)
    print(f"{count} parts, {bad} with faults")
    sys.exit(bool(bad))


if __name__ == "__main__":
    main()
