"""How near smoothed voxels come to the true surface: ``python -m benchmarks.smooth_quality --cases sphere,rbox``.

Shapes with a known surface are turned into voxels of -1 and +1, smoothed by us and by other software at the
settings it recommends, and compared. All lengths are in cells. Half a minute to two minutes a case.
"""

from __future__ import annotations

import argparse
import math
import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter, uniform_filter
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial.transform import Rotation

from infill import Smoothing
from infill.bodies import bodies, data_bits
from infill.levels import at_volume, straightened
from infill.refining import refine_blocks
from infill.sparse import smooth_blocks
from infill.sparse_surface import extract_blocks
from infill.surface import Surface, extract

Points = NDArray[np.float64]
Field = NDArray[np.floating]
TURN = Rotation.from_euler("xyz", [20, 35, 10], degrees=True).as_matrix()


@dataclass(frozen=True, kw_only=True)
class Shape:
    """A solid {value < 0} about the origin, in cells.

    Parameters
    ----------
    size : (nx, ny, nz)
        Cells of its grid.
    value : function of (N, 3) points
        The signed distance if `exact`, else any smooth function with the same zero surface.
    volume : float, optional
        Cells³; the number of solid cells if left out.
    euler : int
        Its Euler number; every shape is one piece.
    """

    size: tuple[int, int, int]
    value: Callable[[Points], NDArray[np.float64]]
    exact: bool = True
    volume: float | None = None
    euler: int = 2

    def voxels(self, noise: float = 0.0) -> NDArray[np.float32]:
        """Return -1 and +1 at the cell centres, in a band of 2 cells about the surface +1 with chance `noise`."""
        x, y, z = (np.arange(n) + 0.5 - n / 2 for n in self.size)
        value = np.empty(self.size)
        for i, across in enumerate(x):
            points = np.stack(np.broadcast_arrays(across, *np.meshgrid(y, z, indexing="ij")), axis=-1)
            value[i] = self.value(points.reshape(-1, 3)).reshape(points.shape[:2])
        band = np.abs(value) <= 2
        solid = (value < 0) | (band & (np.random.default_rng(0).random(self.size) <= noise))
        return np.where(solid, np.float32(1), np.float32(-1))

    def gradient(self, points: Points) -> Points:
        """Return the unit gradient of the value."""
        slope = np.stack([self.value(points + d) - self.value(points - d) for d in 1e-4 * np.eye(3)], axis=1)
        return slope / np.linalg.norm(slope, axis=1, keepdims=True)

    def foot(self, points: Points) -> tuple[NDArray[np.float64], Points]:
        """Return the signed distance of points near the surface, and the normal where they are nearest to it.

        A value that is no distance takes a projected Newton method: onto the surface along the normal,
        then back under the point within the tangent plane.
        """
        if self.exact:
            return self.value(points), self.gradient(points)
        at = points.copy()
        for _ in range(12):
            normal = self.gradient(at)
            slope = (self.value(at + 1e-3 * normal) - self.value(at - 1e-3 * normal)) / 2e-3
            at = at - np.clip(self.value(at) / slope, -2, 2)[:, None] * normal
            aside = points - at
            at = at + 0.8 * (aside - (aside * normal).sum(axis=1, keepdims=True) * normal)
        normal = self.gradient(at)
        return ((points - at) * normal).sum(axis=1), normal


def sphere() -> Shape:
    """Return a sphere of radius 80."""
    return Shape(size=(200,) * 3, value=lambda p: np.linalg.norm(p, axis=1) - 80, volume=4 / 3 * math.pi * 80**3)


def ellipsoid() -> Shape:
    """Return an ellipsoid with half axes 160, 80 and 80."""
    axes = np.array([160.0, 80, 80])
    value, volume = (lambda p: (np.linalg.norm(p / axes, axis=1) - 1) * 80), 4 / 3 * math.pi * axes.prod()
    return Shape(size=(400, 200, 200), value=value, exact=False, volume=volume)


def torus() -> Shape:
    """Return a torus of radii 55 and 22, tilted."""

    def value(points: Points) -> NDArray[np.float64]:
        x, y, z = (points @ TURN).T
        return np.hypot(np.hypot(x, y) - 55, z) - 22

    return Shape(size=(200,) * 3, value=value, volume=2 * math.pi**2 * 55 * 22**2, euler=0)


def rbox() -> Shape:
    """Return a box of half sizes 60, 42 and 30 with edges of radius 8, turned."""
    radius, core = 8.0, np.array([52.0, 34, 22])

    def value(points: Points) -> NDArray[np.float64]:
        q = np.abs(points @ TURN) - core
        return np.linalg.norm(np.maximum(q, 0), axis=1) + np.minimum(q.max(axis=1), 0) - radius

    a, b, c = 2 * core
    volume = a * b * c + 2 * radius * (a * b + b * c + c * a) + math.pi * radius**2 * (a + b + c)
    return Shape(size=(200,) * 3, value=value, volume=volume + 4 / 3 * math.pi * radius**3)


def gyroid() -> Shape:
    """Return a gyroid sheet of period 80, 5 to 7 thick, in a ball of radius 90, blended over 8."""
    wave = 2 * math.pi / 80

    def value(points: Points) -> NDArray[np.float64]:
        x, y, z = (points * wave).T
        sheet = np.sin(x) * np.cos(y) + np.sin(y) * np.cos(z) + np.sin(z) * np.cos(x)
        a, b = np.abs(sheet) / (1.5 * wave) - 2.75, np.linalg.norm(points, axis=1) - 90
        return np.maximum(a, b) + np.maximum(8 - np.abs(a - b), 0) ** 2 / 32

    return Shape(size=(200,) * 3, value=value, exact=False, euler=-74)


def honeycomb() -> Shape:
    """Return a plate 20 high with 37 hexagonal holes, walls of exactly 3, turned by 7 degrees, edges sharp."""

    def hexagon(centre: Points, apothem: float) -> shapely.Polygon:
        angle = np.radians(np.arange(30, 390, 60) + 7)
        return shapely.Polygon(centre + apothem / math.cos(math.pi / 6) * np.stack([np.cos(angle), np.sin(angle)], 1))

    i, j = np.mgrid[-3:4, -3:4].reshape(2, -1)
    i, j = (part[np.abs(i + j) <= 3][:, None] for part in (i, j))
    angle = np.radians([7, 67])
    centres = 24 * (i * [math.cos(angle[0]), math.sin(angle[0])] + j * [math.cos(angle[1]), math.sin(angle[1])])
    plate = shapely.union_all([hexagon(c, 13.5) for c in centres])
    plate = plate.difference(shapely.union_all([hexagon(c, 10.5) for c in centres]))
    edge = plate.boundary
    shapely.prepare([plate, edge])

    def value(points: Points) -> NDArray[np.float64]:
        flat, which = np.unique(points[:, :2], axis=0, return_inverse=True)
        spots = shapely.points(flat)
        side = (shapely.distance(edge, spots) * np.where(shapely.contains(plate, spots), -1, 1))[which.ravel()]
        top = np.abs(points[:, 2]) - 10
        return np.hypot(np.maximum(side, 0), np.maximum(top, 0)) + np.minimum(np.maximum(side, top), 0)

    return Shape(size=(210, 210, 40), value=value, volume=plate.area * 20, euler=-72)


CASES = {build.__name__: (build, 0.0) for build in (sphere, ellipsoid, torus, rbox, gyroid, honeycomb)}
CASES |= {f"sphere_noise{percent}": (sphere, percent / 100) for percent in (10, 20, 30, 40)}


def surface_of(field: Field, level: float = 0.0) -> Surface:
    """Return the surface of {field > level}, in cells about the middle of the grid."""
    origin = tuple(-n / 2 for n in field.shape)
    return extract(field, spacing=(1.0, 1.0, 1.0), origin=origin, level=level)


def ours(f: Field, steps: int, level: str, *, refine: bool = False) -> Surface:
    """Return the scheme of the paper, or the refined one, at level 0 or at the level of the voxels' volume."""
    field = (refine_blocks if refine else smooth_blocks)(f > 0, Smoothing(steps=steps))
    cells, half = (1.0, 1.0, 1.0), tuple(n / 2 for n in f.shape)
    if level == "0":
        surface = extract_blocks(field, spacing=cells)
    else:
        solid = bodies(field, data_bits(field))
        straight = field if refine else straightened(field)
        found = at_volume(straight, solid, spacing=cells, targets=solid.cells.astype(np.float64))
        surface = extract_blocks(
            straight, spacing=cells, level=found.common
        )  # specks of noise get no level of their own
    return Surface(vertices=surface.vertices - half, faces=surface.faces)


def majority_sinc(f: Field, passes: int, band: float) -> Surface:
    """Return the windowed sinc after a majority vote of 3 x 3 x 3, as one does with noisy labels."""
    return windowed_sinc(uniform_filter(f, 3, mode="nearest"), passes, band)


def vtk_triangles(f: Field, mesher: Any, after: Any = None) -> Surface:
    """Run VTK's mesher on the labels, then a filter, and return the triangles, turned outwards."""
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
    from vtkmodules.vtkCommonDataModel import vtkImageData

    labels = np.pad((f > 0).astype(np.uint8), 1)
    image = vtkImageData(dimensions=labels.shape, origin=[-(n - 1) / 2 for n in labels.shape])
    image.GetPointData().SetScalars(numpy_to_vtk(labels.ravel(order="F"), deep=True))
    mesher.SetInputData(image)
    mesher.SetValue(0, 1)
    if after:
        after.SetInputConnection(mesher.GetOutputPort())
    (after or mesher).Update()
    data = (after or mesher).GetOutput()
    vertices = vtk_to_numpy(data.GetPoints().GetData()).astype(np.float64)
    faces = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    surface = Surface(vertices=vertices, faces=faces)
    return surface if surface.volume > 0 else Surface(vertices=vertices, faces=faces[:, ::-1])


def windowed_sinc(f: Field, passes: int, band: float) -> Surface:
    from vtkmodules.vtkFiltersCore import vtkWindowedSincPolyDataFilter
    from vtkmodules.vtkFiltersGeneral import vtkDiscreteFlyingEdges3D

    low_pass = vtkWindowedSincPolyDataFilter(number_of_iterations=passes, pass_band=band, normalize_coordinates=True)
    low_pass.BoundarySmoothingOff()
    return vtk_triangles(f, vtkDiscreteFlyingEdges3D(), low_pass)


def surface_nets(f: Field) -> Surface:
    from vtkmodules.vtkFiltersCore import vtkSurfaceNets3D

    nets = vtkSurfaceNets3D(number_of_iterations=16, constraint_scale=2, relaxation_factor=0.5)
    nets.SetOutputMeshTypeToTriangles()
    return vtk_triangles(f, nets)


def level_set(f: Field, which: str) -> Surface:
    """Return the zero surface of a smooth distance-like function, squeezed into [-1, 1] for our mesher."""
    if which == "mcubes":
        import mcubes

        return surface_of(np.tanh(mcubes.smooth(f > 0)))
    import SimpleITK

    image = SimpleITK.GetImageFromArray((f > 0).astype(np.uint8))
    return surface_of(np.tanh(SimpleITK.GetArrayFromImage(SimpleITK.AntiAliasBinary(image))))


def relaxed(f: Field, which: str, **settings: float) -> Surface:
    """Return the raw mesh after one of trimesh's filters."""
    import trimesh

    mesh = surface_of(f).to_trimesh()
    getattr(trimesh.smoothing, f"filter_{which}")(mesh, **settings)
    return Surface(vertices=np.asarray(mesh.vertices), faces=np.asarray(mesh.faces))


def gaussian(f: Field, sigma: float) -> Surface:
    return surface_of(gaussian_filter(f, sigma, mode="nearest"))


SINC = ((15, 0.001), (50, 0.02), (100, 0.003))
METHODS: dict[str, Callable[[Field], Surface]] = {
    **{f"ours, {n} steps, level {c}": partial(ours, steps=n, level=c) for n in (10, 20) for c in ("0", "volume")},
    "ours, 20 steps refined": partial(ours, steps=20, level="volume", refine=True),
    **{f"VTK windowed sinc {n}/{b:g}": partial(windowed_sinc, passes=n, band=b) for n, b in SINC},
    "VTK surface nets 16": surface_nets,
    "SimpleITK AntiAliasBinary": partial(level_set, which="itk"),
    "PyMCubes smooth": partial(level_set, which="mcubes"),
    **{f"SciPy Gaussian {sigma:g}": partial(gaussian, sigma=sigma) for sigma in (1, 1.5, 2.5)},
    "majority + windowed sinc": partial(majority_sinc, passes=100, band=0.003),
    "trimesh Taubin": partial(relaxed, which="taubin"),
    "trimesh Humphrey": partial(relaxed, which="humphrey"),
    "trimesh Humphrey 30, alpha 0": partial(relaxed, which="humphrey", alpha=0.0, beta=0.5, iterations=30),
}
SLOW, NOISY = {"PyMCubes smooth"}, {"SciPy Gaussian 2.5", "majority + windowed sinc"}


@dataclass(frozen=True, kw_only=True)
class Quality:
    """What is measured; distances from the vertices, in cells; the angle is weighted by area, in degrees."""

    rms: float
    largest: float
    normal: float
    volume: float
    euler: int
    parts: int
    seconds: float


def measured(surface: Surface, shape: Shape, volume: float, seconds: float) -> Quality:
    """Return the quality of a surface of `shape`, whose true volume is `volume`."""
    used, faces = np.unique(surface.faces, return_inverse=True)
    vertices, faces = surface.vertices[used].astype(np.float64), faces.reshape(-1, 3)
    distance, _ = shape.foot(vertices)
    a, b, c = (vertices[faces[:, i]] for i in range(3))
    across = np.cross(b - a, c - a)
    doubled = np.linalg.norm(across, axis=1)
    _, normal = shape.foot((a + b + c) / 3)
    cosine = (across * normal).sum(axis=1) / np.maximum(doubled, 1e-30)
    links = coo_array((np.ones(len(faces) * 2), (faces[:, [0, 0]].ravel(), faces[:, [1, 2]].ravel())))
    links.resize(len(vertices), len(vertices))
    edges = np.unique(np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)) @ [len(vertices), 1]).size
    angle = np.degrees(np.arccos(np.clip(cosine, -1, 1))) @ doubled / doubled.sum()
    return Quality(
        rms=np.sqrt((distance**2).mean()),
        largest=np.abs(distance).max(),
        normal=angle,
        volume=100 * (surface.volume / volume - 1),
        euler=len(vertices) - edges + len(faces),
        parts=connected_components(links, directed=False)[0],
        seconds=seconds,
    )


def main() -> None:
    """Print one table a case, and who comes nearest."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cases", default=",".join(CASES), help="names with commas between (default: all)")
    parser.add_argument("--slow", action="store_true", help="also what takes longer than ten seconds")
    options = parser.parse_args()
    cases = options.cases.split(",")
    if unknown := [case for case in cases if case not in CASES]:
        parser.error(f"no case {', '.join(unknown)}; there are {', '.join(CASES)}")
    for case in cases:
        build, noise = CASES[case]
        shape = build()
        f = shape.voxels(noise)
        volume = shape.volume or float((f > 0).sum())
        names = [n for n in METHODS if (n not in SLOW or options.slow) and (n not in NOISY or noise)]
        print(f"\n{case}\n{'':32s}     rms    max  normal   volume   Euler  parts    CPU")
        found: dict[str, Quality] = {}
        for name in names:
            begin = time.process_time()
            try:
                surface = METHODS[name](f)
            except ModuleNotFoundError as error:
                print(f"{name:32s}skipped: {error.name} is not installed")
                continue
            found[name] = q = measured(surface, shape, volume, time.process_time() - begin)
            line = f"{q.rms:8.3f}{q.largest:7.2f}{q.normal:7.2f}°{q.volume:+8.3f}%{q.euler:8d}{q.parts:7d}"
            print(f"{name:32s}{line}{q.seconds:6.1f}s", flush=True)
        verdict({name: q for name, q in found.items() if (q.euler, q.parts) == (shape.euler, 1)})


def verdict(found: dict[str, Quality]) -> None:
    """Print who of those with the right topology wins in distance and in normals, and by how much."""
    for what in ("rms", "normal"):
        ranked = sorted((getattr(q, what), name) for name, q in found.items())
        mine, theirs = ([r for r in ranked if r[1].startswith("ours") is own][:1] for own in (True, False))
        if mine and theirs:
            (us, our), (them, their) = mine[0], theirs[0]
            print(f"  {what}: ours {'wins' if us < them else 'loses'}, {us / them:.2f} x: {our} against {their}")


if __name__ == "__main__":
    main()
