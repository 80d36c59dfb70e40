"""Labels smoothed together beside peers: ``python -m benchmarks.labels_together [--scenes 100-128] [--methods serra]``.

Scenes are Voronoi partitions, named cells-size or cells-size-ratio (100-128-4: voxels of 1 x 1 x 4), and `organs-256`:
40 labels of `benchmarks.label_scene`; the name of a file stands for its labels. Each method runs alone in a fresh
process, once to compile and once measured, from an array to meshes in memory.
VTK (extra `bench`) and serra-mesh get the labels padded by a layer of void.

Quality is that of labels that touch no side of the box (of all if each does), 40 at most:

    apart      the share of the wall to other labels that lies over 0.1 voxels (the smallest side) from all of theirs
    volumes    the mean and the largest change of the volume of a label
    normals    the mean angle between triangles and the true walls of Voronoi cells, 3 voxels or more away from lines
    unfit      labels whose mesh by itself is not a manifold, as manifold3d says
"""

from __future__ import annotations

import argparse
import json
import re
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from benchmarks.label_scene import segmentation
from infill import Surface, smooth_labels
from infill.imaging.segmentations import read_segmentation
from infill.meshes.distance import TriangleTree
from infill.meshes.solids import FINE, manifold_status

Meshes = dict[int, Surface]
SCENES = ("10-128", "100-128", "1000-128", "100-128-4", "100-256", "1000-256", "organs-256", "1000-512")
JUDGED, SAMPLES, APART, LINES = 40, 2000, 0.1, 3.0
BESIDE = 1.5  # voxels: a place with another label as near lies at a wall to it
MOST_MEMORY = 2**40  # bytes: what is expected may be more than there is
PAD = 1  # cells of void around the labels of peers


def voronoi_seeds(count: int, size: int, ratio: float) -> NDArray[np.float64]:
    """Return the seeds of cells in voxels of 1 x 1 x ratio."""
    return np.random.default_rng(0).uniform(0, (size, size, size * ratio), (count, 3))


def make_scene(name: str) -> tuple[NDArray[np.uint16], tuple[float, float, float], NDArray[np.float64] | None]:
    """Return labels, the sides of voxels, and the seeds of Voronoi cells."""
    if Path(name).is_file():
        volume = read_segmentation(name).layers[0]
        return volume.values.astype(np.uint16), tuple(volume.cell_size.tolist()), None
    if name.startswith("organs"):
        return segmentation(int(name.split("-")[1])).astype(np.uint16), (1.0, 1.0, 1.0), None
    count, size, ratio = (*map(float, name.split("-")), 1.0)[:3]
    seeds, side = voronoi_seeds(int(count), int(size), ratio), int(size)
    tree, labels = cKDTree(seeds), np.empty((side,) * 3, dtype=np.uint16)
    for layer in range(side):
        at = np.stack(np.meshgrid([layer], np.arange(side), np.arange(side), indexing="ij"), axis=-1).reshape(-1, 3)
        labels[layer] = tree.query((at + 0.5) * (1.0, 1.0, ratio), workers=-1)[1].reshape(side, side) + 1
    return labels, (1.0, 1.0, ratio), seeds


def together(method: Any) -> Callable[..., Callable[[], Meshes]]:
    def run(labels: NDArray[np.uint16], spacing: tuple[float, ...]) -> Callable[[], Meshes]:
        options: Any = {"spacing": spacing, "tolerance": None, "max_memory": MOST_MEMORY}
        found = smooth_labels(labels, together=True, method=method, **options)
        numbers = {label["name"]: label["number"] for label in found.report["labels"]}
        for surface in found.surfaces.values():  # made one by one, as for files
            assert len(surface.faces)
        return lambda: {numbers[name]: surface for name, surface in found.surfaces.items()}

    return run


def apart(labels: NDArray[np.uint16], spacing: tuple[float, ...]) -> Callable[[], Meshes]:
    found = smooth_labels(labels, spacing=spacing, tolerance=None, allow_broken=True, keep_going=True)
    return lambda: {int(name.removeprefix("label_")): surface for name, surface in found.surfaces.items()}


def vtk_nets(labels: NDArray[np.uint16], spacing: tuple[float, ...]) -> Callable[[], Meshes]:
    """VTK's surface nets with the smoothing it recommends."""
    import vtk
    from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

    padded = np.pad(labels, PAD)
    image = vtk.vtkImageData()
    image.SetDimensions(*padded.shape[::-1])
    image.SetSpacing(*spacing[::-1])
    image.GetPointData().SetScalars(numpy_to_vtk(padded.ravel()))
    net = vtk.vtkSurfaceNets3D()
    net.SetInputData(image)
    net.GenerateValues(int(labels.max()), 1, int(labels.max()))
    net.SmoothingOn()
    net.SetNumberOfIterations(16)
    net.SetConstraintScale(2.0)
    net.SetRelaxationFactor(0.5)
    net.SetOutputMeshTypeToTriangles()
    net.Update()

    def meshes() -> Meshes:
        mesh = net.GetOutput()
        points = vtk_to_numpy(mesh.GetPoints().GetData()).astype(np.float64)[:, ::-1]
        points = points + (0.5 - PAD) * np.array(spacing)
        triangles = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)
        pairs = vtk_to_numpy(mesh.GetCellData().GetArray("BoundaryLabels")).astype(np.int64)
        found = {}
        for label in np.unique(labels[labels > 0]).tolist():
            faces = np.concatenate([triangles[pairs[:, 0] == label], triangles[pairs[:, 1] == label][:, ::-1]])
            used, corners = np.unique(faces, return_inverse=True)
            surface = Surface(vertices=points[used], faces=corners.reshape(-1, 3))
            if surface.volume < 0:
                surface = Surface(vertices=surface.vertices, faces=surface.faces[:, ::-1])
            found[label] = surface
        return found

    return meshes


def serra(labels: NDArray[np.uint16], spacing: tuple[float, ...]) -> Callable[[], Meshes]:
    """serra-mesh with the smoothing it recommends, which shares walls."""
    import serra_mesh

    mesher = serra_mesh.Mesher(voxel_resolution=list(spacing), fairing=20, fairing_taubin=True)
    mesher.mesh(np.pad(labels, PAD))
    parts = {label: mesher.get(label) for label in np.unique(labels[labels > 0]).tolist()}
    shift = (0.5 - PAD) * np.array(spacing)
    return lambda: {
        label: Surface(vertices=mesh.vertices.astype(np.float64) + shift, faces=mesh.faces.astype(np.int64))
        for label, mesh in parts.items()
    }


METHODS: dict[str, Callable[..., Callable[[], Meshes]]] = {
    "together, plain": together("plain"),
    "together, refined": together("refine"),
    "apart": apart,
    "VTK nets": vtk_nets,
    "serra": serra,
}


def peak_memory(*, reset: bool = False) -> float:
    """Return the peak of memory of this process since it was last reset, MiB; on Linux alone."""
    if reset:
        Path("/proc/self/clear_refs").write_text("5")
    status = Path("/proc/self/status").read_text()
    return float(re.search(r"VmHWM:\s*(\d+)", status)[1]) / 1024  # type: ignore[index]


def run_child(method: str, source: str, target: str) -> None:
    """Run a method in this process, write what it cost and its meshes."""
    labels, spacing = np.load(source), tuple(json.loads(Path(source).with_suffix(".json").read_text()))
    METHODS[method]((np.indices((24, 24, 24)) // 12).sum(axis=0).astype(np.uint16) + 1, spacing)()  # compiles
    before = peak_memory(reset=True)
    begin, cpu = time.perf_counter(), time.process_time()
    meshes = METHODS[method](labels, spacing)
    cost = {"seconds": time.perf_counter() - begin, "cpu": time.process_time() - cpu}
    cost["memory"] = peak_memory() - before
    arrays: dict[str, Any] = {}
    for label, surface in meshes().items():
        arrays[f"v{label}"], arrays[f"f{label}"] = surface.vertices, surface.faces
    np.savez(target, **arrays)
    print(json.dumps(cost))


def judge(
    meshes: Meshes, labels: NDArray[np.uint16], spacing: tuple[float, ...], seeds: NDArray[np.float64] | None
) -> dict[str, float]:
    """Measure the meshes of labels that touch no side of the box."""
    sides, rng = np.array(spacing), np.random.default_rng(0)
    ends = [np.take(labels, place, axis=axis).ravel() for axis in range(3) for place in (0, -1)]
    counts, outer = np.bincount(labels.ravel()), set(np.concatenate(ends).tolist())
    present = [label for label in np.flatnonzero(counts).tolist() if label]
    inner = [label for label in present if label not in outer] or present
    change = [
        abs(meshes[label].volume / (counts[label] * sides.prod()) - 1) if label in meshes else 1.0 for label in inner
    ]
    judged = rng.permutation(inner)[:JUDGED].tolist()
    unfit = sum(label not in meshes or manifold_status(meshes[label]) != FINE for label in judged)
    centres = {label: mesh.vertices[mesh.faces].mean(axis=1) for label, mesh in meshes.items()}
    gaps, angles = [], []
    for label in judged:
        if label not in meshes:
            continue
        mesh, middle = meshes[label], centres[label]
        normal = np.cross(*(mesh.vertices[mesh.faces[:, end]] - mesh.vertices[mesh.faces[:, 0]] for end in (1, 2)))
        area = np.linalg.norm(normal, axis=1)
        chosen = rng.choice(len(area), SAMPLES, p=area / area.sum())
        middle, normal = middle[chosen], normal[chosen] / area[chosen, None]
        low, high = middle.min(axis=0) - 4, middle.max(axis=0) + 4
        others = [
            surface.vertices[surface.faces[((centres[other] > low) & (centres[other] < high)).all(axis=1)]]
            for other, surface in meshes.items()
            if other != label
        ]
        corners = np.concatenate(others)
        if not len(corners):
            continue
        tree = TriangleTree.of(
            Surface(vertices=corners.reshape(-1, 3), faces=np.arange(3 * len(corners)).reshape(-1, 3))
        )
        # Walls to void, and the sides of the box, have no other side.
        at = np.floor((middle + BESIDE * sides.min() * normal) / sides).astype(np.int64)
        beside = labels[tuple(np.clip(at, 0, np.array(labels.shape) - 1).T)]
        is_shared = ((at >= 0) & (at < labels.shape)).all(axis=1) & (beside > 0) & (beside != label)
        gaps.append(float((tree.nearest(middle[is_shared])[0] > APART * sides.min()).mean()))
        if seeds is not None:
            nearest, owner = map(np.asarray, cKDTree(seeds).query(middle, k=3))
            third = (nearest[:, 2] ** 2 - nearest[:, 1] ** 2) / (
                2 * np.linalg.norm(seeds[owner[:, 2]] - seeds[owner[:, 1]], axis=1)
            )
            clear = is_shared & (owner[:, :2] == label - 1).any(axis=1) & (third > LINES * sides.max())
            across = np.where(owner[:, 0] == label - 1, owner[:, 1], owner[:, 0])
            wall = seeds[across] - seeds[label - 1]
            cosine = (wall * normal).sum(axis=1) / np.linalg.norm(wall, axis=1)
            angles += np.degrees(np.arccos(np.clip(cosine[clear], -1, 1))).tolist()
    return {
        "apart": float(np.mean(gaps)),
        "mean": float(np.mean(change)),
        "worst": float(np.max(change)),
        "angle": float(np.mean(angles)) if angles else np.nan,
        "unfit": unfit,
        "judged": len(judged),
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", nargs="+", default=SCENES)
    parser.add_argument("--methods", nargs="+", default=list(METHODS), choices=list(METHODS))
    parser.add_argument("--child", nargs=3, metavar=("METHOD", "LABELS", "MESHES"), help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.child:
        run_child(*options.child)
        return
    print("| scene | method | s | CPU s | MiB | apart | volumes, mean | worst | normals | unfit |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    for name in options.scenes:
        labels, spacing, seeds = make_scene(name)
        with tempfile.TemporaryDirectory() as folder:
            source, target = Path(folder) / "labels.npy", Path(folder) / "meshes.npz"
            np.save(source, labels)
            source.with_suffix(".json").write_text(json.dumps(spacing))
            for method in options.methods:
                command = [
                    sys.executable,
                    "-m",
                    "benchmarks.labels_together",
                    "--child",
                    method,
                    str(source),
                    str(target),
                ]
                child = subprocess.run(command, capture_output=True, text=True, check=False)
                if child.returncode:
                    print(f"| {name} | {method} | {child.stderr.strip().splitlines()[-1][:90]} |", flush=True)
                    continue
                cost = json.loads(child.stdout.splitlines()[-1])
                with np.load(target) as arrays:
                    meshes = {
                        int(key[1:]): Surface(vertices=arrays[key], faces=arrays["f" + key[1:]])
                        for key in arrays.files
                        if key[0] == "v"
                    }
                q = judge(meshes, labels, spacing, seeds)
                print(
                    f"| {name} | {method} | {cost['seconds']:.2f} | {cost['cpu']:.2f} | {cost['memory']:.0f} | "
                    f"{q['apart']:.2%} | {q['mean']:.4%} | {q['worst']:.3%} | {q['angle']:.2f}° | "
                    f"{q['unfit']} of {q['judged']} |",
                    flush=True,
                )


if __name__ == "__main__":
    main()
