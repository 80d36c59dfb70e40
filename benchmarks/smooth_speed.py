"""The speed of smoothing: ``python -m benchmarks.smooth_speed [--sizes 400,800] [--large]``.

A binary sphere of 0.8 of the half side, 10 steps, volume in, mesh out, in one process and in turn with its peers.
VTK is left out where it is not installed.
"""

from __future__ import annotations

import argparse
import resource
import statistics
import subprocess
import sys
import time
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from benchmarks.pairs import row
from infill import Smoothing
from infill.phasefield.sparse import smooth_bricks
from infill.surfaces.levels import at_volume, counted
from infill.surfaces.sparse_marching import extract_bricks

SMOOTHING = Smoothing(steps=10)
UNIT = (1.0, 1.0, 1.0)


def ball(n: int) -> NDArray[np.bool_]:
    """Return a sphere of 0.8 of the half side on n³ cells, layer by layer."""
    x = (((np.arange(n) + 0.5) / n * 2 - 1) ** 2).astype(np.float32)
    out = np.empty((n, n, n), dtype=bool)
    for i in range(n):
        np.less(x[i] + x[:, None] + x[None, :], np.float32(0.64), out=out[i])
    return out


def ours(f: NDArray[np.bool_]) -> int:
    """Smooth and mesh at level 0."""
    return len(extract_bricks(smooth_bricks(f, SMOOTHING), spacing=UNIT).faces)


def ours_volume(f: NDArray[np.bool_]) -> int:
    """Smooth and mesh at the level of the data's volume."""
    data, field, guess = counted(smooth_bricks(f, SMOOTHING), spacing=UNIT)
    found = at_volume(field, data, spacing=UNIT, targets=data.cells.astype(np.float64), guess=guess)
    return len(found.surface.faces)


def plain_numpy(f: NDArray[np.bool_]) -> int:
    """Do whole-array float32 NumPy steps as a textbook has them, and scikit-image's marching cubes."""
    from skimage.measure import marching_cubes

    data = np.where(f, np.float32(1), np.float32(-1))
    phi, alpha, decay, pull = data, np.float32(1 / 7), np.float32(SMOOTHING.decay), np.float32(SMOOTHING.pull)
    for _ in range(SMOOTHING.steps):
        p = np.pad(phi, 1, mode="edge")
        around = (
            p[2:, 1:-1, 1:-1]
            + p[:-2, 1:-1, 1:-1]
            + p[1:-1, 2:, 1:-1]
            + p[1:-1, :-2, 1:-1]
            + p[1:-1, 1:-1, 2:]
            + p[1:-1, 1:-1, :-2]
        )
        phi = phi + alpha * (around - 6 * phi)
        phi = phi / np.sqrt(decay + phi**2 * (1 - decay))
        phi = (phi + pull * data) / (1 + pull)
    return len(marching_cubes(phi, 0.0)[1])


def surface_nets(f: NDArray[np.bool_]) -> int:
    """Use VTK's surface nets with the smoothing it recommends: 16 iterations, constraint scale 2."""
    import vtk

    net = vtk.vtkSurfaceNets3D()
    net.SetInputData(_image(f))
    net.SetValue(0, 1)
    net.SmoothingOn()
    net.SetNumberOfIterations(16)
    net.SetConstraintScale(2.0)
    net.SetRelaxationFactor(0.5)
    net.Update()
    return int(net.GetOutput().GetNumberOfCells())


def flying_edges(f: NDArray[np.bool_]) -> int:
    """Mesh the raw data with VTK's flying edges, and smooth nothing."""
    import vtk

    edges = vtk.vtkFlyingEdges3D()
    edges.SetInputData(_image(f))
    edges.SetValue(0, 0.5)
    edges.ComputeNormalsOff()
    edges.ComputeGradientsOff()
    edges.ComputeScalarsOff()
    edges.Update()
    return int(edges.GetOutput().GetNumberOfCells())


def _image(f: NDArray[np.bool_]):
    import vtk
    from vtk.util.numpy_support import numpy_to_vtk

    image = vtk.vtkImageData()
    image.SetDimensions(*f.shape[::-1])
    image.GetPointData().SetScalars(numpy_to_vtk(f.view(np.uint8).ravel()))
    return image


def seconds(work: Callable[[NDArray[np.bool_]], int], f: NDArray[np.bool_]) -> float:
    begin = time.perf_counter()
    work(f)
    return time.perf_counter() - begin


def in_turn(works: list[Callable[[NDArray[np.bool_]], int]], f: NDArray[np.bool_], runs: int) -> list[list[float]]:
    """Return the times of each, taken in turn, after one round that does not count."""
    times: list[list[float]] = [[] for _ in works]
    for turn in range(runs + 1):
        for n, work in enumerate(works):
            taken = seconds(work, f)
            if turn:
                times[n].append(taken)
    return times


def ratio(theirs: list[float], own: list[float]) -> float:
    return statistics.median(a / b for a, b in zip(theirs, own, strict=True))


def compare(n: int, runs: int) -> float:
    """Print the table of one size and return our median."""
    f = ball(n)
    print(f"\n{n}³, {f.sum():,} solid cells, {runs} rounds")
    own, volume = in_turn([ours, ours_volume], f, runs)
    mine = statistics.median(own)
    row("ours, level 0", f"{mine:.3f} s")
    share = ratio(volume, own)
    row("ours, level of the volume", f"{statistics.median(volume):.3f} s, {share:.2f} x", "1.5 x", holds=share <= 1.5)
    if n <= 400:
        own, plain = in_turn([ours, plain_numpy], f, 1)
        gain = ratio(plain, own)
        row("NumPy float32 steps and scikit-image", f"{plain[0]:.2f} s, {gain:.0f} x ours", "30 x", holds=gain >= 30)
    try:
        import vtk
    except ImportError:
        print("    VTK is not installed: no surface nets, no flying edges")
        return mine
    for backend in ("Sequential", "STDThread"):
        vtk.vtkSMPTools.SetBackend(backend)
        own, nets, edges = in_turn([ours, surface_nets, flying_edges], f, runs)
        gain, least = ratio(nets, own), (2.0 if n >= 800 else 1.5) if backend == "Sequential" else 1.0
        row(
            f"VTK surface nets, {backend}",
            f"{statistics.median(nets):.3f} s, {gain:.2f} x ours",
            f"{least:g} x",
            holds=gain >= least,
        )
        gain = ratio(edges, own)
        judged = n >= 800 and backend == "Sequential"
        row(
            f"VTK flying edges on raw data, {backend}",
            f"{statistics.median(edges):.3f} s, {gain:.2f} x ours",
            "1 x" if judged else "",
            holds=gain > 1 if judged else None,
        )
    return mine


def large(n: int) -> None:
    """Do one run in a process of its own and print its time and peak memory; data as int8."""
    code = (
        "import time, resource, numpy as np\n"
        "from benchmarks.smooth_speed import ball, ours\n"
        f"f = ball({n}).view(np.int8)\nnp.multiply(f, 2, out=f); f -= 1\n"
        "t = time.perf_counter(); faces = ours(f)\n"
        "print(time.perf_counter() - t, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024, faces)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    taken, peak, faces = (float(word) for word in done.stdout.split())
    row(
        f"{n}³ int8: {faces:,.0f} triangles in {taken:.1f} s",
        f"{peak / 2**30:.2f} GiB in all",
        "12 GiB",
        holds=peak <= 12 * 2**30,
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sizes", default="400,800")
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--large", action="store_true", help="also 1600³, which takes 12 GiB")
    options = parser.parse_args()
    times = {n: compare(n, options.runs) for n in map(int, options.sizes.split(","))}
    if 400 in times and 800 in times:
        growth = times[800] / times[400]
        row("\n    time from 400³ to 800³", f"{growth:.2f} x", "4.6 x", holds=growth <= 4.6)
    if options.large:
        large(1600)
    print(f"peak of this process {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20:.2f} GiB")


if __name__ == "__main__":
    main()
