"""The speed of smoothing: ``python -m benchmarks.smooth_speed [--sizes 400,800] [--commands 200,400] [--labels 256]``.

A binary sphere of 0.8 of the half side, 10 steps, in turn with its peers: `smooth_volume`, array in, Result out, with
the level of the volume and the verdict; the command, file in, file out, a process of its own; and, called so, kernels
alone. VTK is left out where it is not installed. Then every label of a segmentation, beside VTK and serra-mesh, which
know all labels at once. With --mesh FILE, the stages of `smooth_mesh` at 300 voxels.
"""

from __future__ import annotations

import argparse
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np
import trimesh
from numpy.typing import NDArray

from benchmarks import pairs, peer_scripts
from benchmarks.label_scene import LABELS
from benchmarks.pairs import row
from infill import Smoothing, read_mesh, smooth_mesh, smooth_volume
from infill.isosurfaces.levels import prepare_levels, surface_at_volume
from infill.isosurfaces.sparse_marching import extract_bricks
from infill.phasefield.sparse import smooth_bricks

SMOOTHING = Smoothing(steps=10)
UNIT = (1.0, 1.0, 1.0)


def ball(n: int) -> NDArray[np.bool_]:
    """Return a sphere of 0.8 of the half side on n³ cells, layer by layer."""
    x = (((np.arange(n) + 0.5) / n * 2 - 1) ** 2).astype(np.float32)
    out = np.empty((n, n, n), dtype=bool)
    for i in range(n):
        np.less(x[i] + x[:, None] + x[None, :], np.float32(0.64), out=out[i])
    return out


def ours(f: NDArray[np.generic]) -> int:
    """Smooth plainly, as the paper does, by the public function: mesh, level of the volume, verdict."""
    result = smooth_volume(f, smoothing=SMOOTHING, method="plain", tolerance=None)
    assert result.report["verdict"]["word"] == "kept"
    return len(result.surface.faces)


def as_it_comes(f: NDArray[np.bool_]) -> int:
    """Smooth by the public function with its own choice of method, which is refined."""
    return len(smooth_volume(f, smoothing=SMOOTHING, tolerance=None).surface.faces)


def kernels(f: NDArray[np.bool_]) -> int:
    """Smooth and mesh at level 0 by kernels alone."""
    return len(extract_bricks(smooth_bricks(f, SMOOTHING), spacing=UNIT).faces)


def kernels_volume(f: NDArray[np.bool_]) -> int:
    """Smooth and mesh at the level of the data's volume by kernels alone."""
    data, field, start = prepare_levels(smooth_bricks(f, SMOOTHING), spacing=UNIT)
    found = surface_at_volume(field, data, spacing=UNIT, targets=data.cells.astype(np.float64), start=start)
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
    """Return the times of each, taken in turn.

    Before each, the same is run once and does not count: so none pays for getting back from the system what memory
    another one has given back, which takes longer than what it is compared with.
    """
    times: list[list[float]] = [[] for _ in works]
    for _ in range(runs):
        for n, work in enumerate(works):
            work(f)
            times[n].append(seconds(work, f))
    return times


def ratio(theirs: list[float], own: list[float]) -> float:
    return statistics.median(a / b for a, b in zip(theirs, own, strict=True))


def compare(n: int, runs: int) -> float:
    """Print the table of one size and return our median."""
    f = ball(n)
    print(f"\n{n}³, {f.sum():,} solid cells, {runs} rounds")
    own, alone, level_0, refined = in_turn([ours, kernels_volume, kernels, as_it_comes], f, runs)
    mine = statistics.median(own)
    row("smooth_volume, plain", f"{mine:.3f} s")
    share = ratio(own, alone)
    row("kernels alone", f"{statistics.median(alone):.3f} s, ours {share:.2f} x", "1.6 x", holds=share <= 1.6)
    row("kernels alone, level 0", f"{statistics.median(level_0):.3f} s")
    row("smooth_volume as it comes: refined", f"{statistics.median(refined):.3f} s, {ratio(refined, own):.2f} x ours")
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
        f"ours(ball(40).view(np.int8) * 2 - 1)\nf = ball({n}).view(np.int8)\nnp.multiply(f, 2, out=f); f -= 1\n"
        "t = time.perf_counter(); faces = ours(f)\n"
        "print(time.perf_counter() - t, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024, faces)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    taken, peak, faces = (float(word) for word in done.stdout.split())
    what = f"smooth_volume, {n}³ int8: {faces:,.0f} triangles"
    row(what, f"{taken:.1f} s", "10 s", holds=taken < 10)
    row("", f"{peak / 2**30:.2f} GiB in all", "9 GiB", holds=peak <= 9 * 2**30)


PART_LIMITS = {"20 mm cube": 2.5, "bracket_medium.stl": 4.0, "spur_gear.stl": 4.0, "bunny_7k.off": 4.0}  # s


def parts(data: Path, runs: int) -> None:
    """Print how long the command takes for small parts, files in and out, with all defaults."""
    command = shutil.which("infill", path=Path(sys.executable).parent)
    assert command is not None
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        trimesh.creation.box((20, 20, 20)).export(folder / "20 mm cube.stl")
        for part, limit in PART_LIMITS.items():
            source = next((path for path in data.rglob(part)), folder / f"{part}.stl")
            if not source.exists():
                print(f"    {part} is not there")
                continue
            smooth = [command, "smooth", str(source), "-o", str(folder / "out.stl"), "--force", "--quiet"]
            pairs.process(smooth)
            times = [pairs.process(smooth) for _ in range(runs)]
            median = pairs.median(times)
            row(f"infill smooth {part}", _figures(times), f"{limit:g} s", holds=median <= limit)


def commands(n: int, runs: int) -> None:
    """Compare the command with a script for VTK: a process each, files in and out, compiled code and files cached."""
    command = shutil.which("infill", path=Path(sys.executable).parent)
    assert command is not None
    with tempfile.TemporaryDirectory() as folder:
        source, target, script = (Path(folder) / name for name in ("s.npy", "s.stl", "nets.py"))
        np.save(source, ball(n))
        script.write_text(peer_scripts.SURFACE_NETS, encoding="utf-8")
        plain = [command, "smooth", source, "-o", target, "--force", "--steps", "10", "--smooth", "plain"]
        theirs = partial(pairs.process, [sys.executable, str(script), str(source), str(target)])
        for name, options in (("plain, every triangle", ["--tolerance", "0"]), ("plain, simplified", [])):
            turns = runs if options else 1  # what is not judged takes long enough once
            mine, nets = pairs.paired(partial(pairs.process, [*map(str, plain), *options]), theirs, turns)
            times = pairs.ratio(mine, nets)
            figure = f"{pairs.median(mine):.2f} s, VTK {pairs.median(nets):.2f} s, {times:.2f} x"
            holds = times <= 1 if options else None
            row(f"infill smooth, {n}³, {name}", figure, "1 x" if options else "", holds=holds)
        ours = [command, "smooth", str(source), "-o", str(target), "--force", "--steps", "10"]
        pairs.process(ours)
        triangles = (target.stat().st_size - 84) // 50
        lean = Path(folder) / "lean.py"
        lean.write_text(peer_scripts.LEAN_NETS, encoding="utf-8")
        for name, script_for, most in (("nets alone", script, 5.0), ("nets, as lean", lean, 1.5)):
            other = [sys.executable, str(script_for), str(source), str(Path(folder) / "theirs.stl"), str(triangles)]
            try:
                mine, peer = pairs.paired(partial(pairs.process, ours), partial(pairs.process, other), runs)
            except RuntimeError as error:
                print(f"    {name}: {str(error).splitlines()[-1]}")
                continue
            times = pairs.ratio(mine, peer)
            figure = f"{pairs.median(mine):.2f} s, VTK {pairs.median(peer):.2f} s, {times:.2f} x"
            row(f"infill smooth, {n}³, all defaults, {name}", figure, f"{most:g} x", holds=times <= most)


def labels(size: int, runs: int) -> None:
    """Compare smoothing every label of a segmentation with its peers: a process each, files in and out."""
    command = shutil.which("infill", path=Path(sys.executable).parent)
    assert command is not None
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        source = folder / "labels.npy"
        # Made in a process of its own: a child's peak of memory begins at that of the process that starts it.
        scene = f"import numpy; from benchmarks.label_scene import segmentation; numpy.save({str(source)!r}, "
        subprocess.run([sys.executable, "-c", scene + f"segmentation({size}))"], check=True)
        print(f"\n{LABELS} labels of {size}³, {runs} rounds")
        smooth = [command, "smooth", str(source), "--force", "--quiet", "-o"]
        scripts = {
            "function": peer_scripts.OWN_LABELS,
            "nets": peer_scripts.NETS_OF_LABELS,
            "serra": peer_scripts.SERRA,
        }
        for key, text in scripts.items():
            (folder / f"{key}.py").write_text(text, encoding="utf-8")
        base: list[str] = [*smooth, str(folder / "{label}.stl")]
        others = {
            "infill smooth, all labels in a 3MF": [*smooth, str(folder / "all.3mf"), "--each-label"],
            "infill smooth, every triangle": [*base, "--tolerance", "0"],
            "infill smooth --together, every triangle, walls shared": [*base, "--together"],
            "smooth_labels and save, a 3MF": _script(folder, "function", source, "function.3mf"),
            "VTK surface nets: one mesh, no verdict, not simplified": _script(folder, "nets", source, "nets.stl"),
            "serra-mesh, 8 x Taubin: no verdict, not simplified": _script(folder, "serra", source, "serra"),
        }
        for what, other in others.items():
            try:
                mine, theirs = pairs.paired(partial(pairs.process, base), partial(pairs.process, other), runs)
            except RuntimeError as error:
                print(f"    {what}: {str(error).splitlines()[-1]}")
                continue
            row("infill smooth, an STL for each label", _figures(mine))
            row(f"    {what}", f"{_figures(theirs)}, {pairs.ratio(theirs, mine):.2f} x")


def _script(folder: Path, name: str, source: Path, target: str) -> list[str]:
    return [sys.executable, str(folder / f"{name}.py"), str(source), str(folder / target)]


def _figures(runs: list[pairs.Run]) -> str:
    cpu, memory = statistics.median(run.cpu for run in runs), max(run.memory for run in runs)
    return f"{pairs.median(runs):.2f} s, CPU {cpu:.2f} s, {memory / 2**20:.0f} MiB"


def stages(path: Path) -> None:
    """Print how long each stage of smoothing a mesh at 300 voxels takes, after a first run that does not count."""
    mesh = read_mesh(path)
    for _ in range(2):
        begin = time.perf_counter()
        report = smooth_mesh(mesh, resolution=300, tolerance=None).report
        whole = time.perf_counter() - begin
    print(f"\n{path.name} at 300 voxels: {whole:.2f} s in all")
    parts = {name: taken for name, taken in report["seconds"].items() if name != "total"}
    parts["voxels"] = whole - sum(parts.values())
    for name, taken in parts.items():
        judged = None if name in ("smooth", "surface") else taken <= whole / 3
        row(f"stage: {name}", f"{taken:.2f} s, {taken / whole:.0%}", "" if judged is None else "33 %", holds=judged)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sizes", default="400,800")
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--commands", default="200,400,800")
    parser.add_argument("--labels", type=int, default=256, help="size of the segmentation; 0 for none")
    parser.add_argument("--parts", type=Path, help="folder of data whose small parts are smoothed")
    parser.add_argument("--mesh", type=Path, help="also the stages of smoothing this mesh")
    parser.add_argument("--large", action="store_true", help="also 1600³, which takes 9 GiB")
    options = parser.parse_args()
    times = {n: compare(n, options.runs) for n in map(int, filter(None, options.sizes.split(",")))}
    if 400 in times and 800 in times:
        growth = times[800] / times[400]
        row("\n    time from 400³ to 800³", f"{growth:.2f} x", "4.6 x", holds=growth <= 4.6)
    for n in map(int, filter(None, options.commands.split(","))):
        commands(n, options.runs)
    if options.labels:
        labels(options.labels, options.runs)
    if options.parts:
        parts(options.parts, options.runs)
    if options.mesh:
        stages(options.mesh)
    if options.large:
        large(1600)
    print(f"peak of this process {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20:.2f} GiB")


if __name__ == "__main__":
    main()
