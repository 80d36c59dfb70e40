"""Volumes in chunks: time, memory and triangles of gyroid cells of any size, beside the same in memory.

    python -m benchmarks.chunks write 1024 build/g1024.zarr      a synthetic volume, compressed, chunk by chunk
    python -m benchmarks.chunks write 4096 build/g4096.zarr --cell 1024     larger cells, each written once, then linked
    python -m benchmarks.chunks run build/g1024.zarr             smooth it in chunks, and measure
    python -m benchmarks.chunks run build/g1024.zarr --cluster 2 --output build/out.ply      on a cluster of 2 processes
    python -m benchmarks.chunks grow 256 384 512 768             how time grows with the surface, with 1 and 2 workers
    python -m benchmarks.chunks closed build/out.ply             whether manifold3d takes a surface
    python -m benchmarks.chunks whole 800                        the same in memory, on an array of that side

Memory is the sum over the process, its children and those of a cluster, sampled ten times a second (Linux only).
"""

from __future__ import annotations

import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

CELL = 128  # voxels of a cell of the gyroid, unless another number is asked for
FAR = 30  # grey values that noise does not reach
CHUNK = 128  # voxels of a chunk of the file
THRESHOLD = 120
PAGE = 4096  # bytes


def gyroid(low, high, cell):
    """Return grey values of a box of gyroid cells, bright where solid, with noise; all edges are as sharp."""
    axes = [np.arange(a, b, dtype=np.float32) * np.float32(2 * np.pi / cell) for a, b in zip(low, high, strict=True)]
    (sx, sy, sz), (cx, cy, cz) = [np.sin(axis) for axis in axes], [np.cos(axis) for axis in axes]
    level = sx[:, None, None] * cy[None, :, None] + (sy[:, None] * cz[None])[None] + cx[:, None, None] * sz[None, None]
    level = 128 + np.float32(80 * cell / 128) * level
    if level.max() < -FAR or level.min() > 255 + FAR:  # no noise reaches the edge
        return np.full(level.shape, 0 if level.max() < 0 else 255, np.uint8)
    noise = np.random.default_rng(list(low)).normal(0, 3, level.shape).astype(np.float32)
    return np.clip(level + noise, 0, 255).astype(np.uint8)


def write(side, path, cell=CELL):
    """Write a volume as Zarr, one chunk at a time; cells of several chunks are the same files under several names."""
    import zarr

    array = zarr.create_array(
        str(path),
        shape=(side,) * 3,
        chunks=(CHUNK,) * 3,
        dtype="u1",
        overwrite=True,
        config={"write_empty_chunks": True},
    )
    period = cell // CHUNK if cell > CHUNK and not cell % CHUNK and not side % cell else side
    for place in np.ndindex(*(-(-side // CHUNK),) * 3):
        first = tuple(n % period for n in place)
        if first != place:
            link = path.joinpath("c", *map(str, place))
            link.parent.mkdir(parents=True, exist_ok=True)
            link.hardlink_to(path.joinpath("c", *map(str, first)))
            continue
        low = [n * CHUNK for n in place]
        high = [min(side, a + CHUNK) for a in low]
        array[tuple(slice(a, b) for a, b in zip(low, high, strict=True))] = gyroid(low, high, cell)


def processes_of(process):
    """Return a process and its children's children, by number."""
    found, todo = [], [process]
    while todo:
        found.append(todo.pop())
        for task in Path(f"/proc/{found[-1]}/task").glob("*/children"):
            try:
                todo += [int(word) for word in task.read_text().split()]
            except OSError:
                continue
    return found


def resident(process):
    """Return the memory of a process and its children that no other shares by a file, bytes."""
    total = 0
    for number in processes_of(process):
        try:
            _, all_pages, shared, *_ = Path(f"/proc/{number}/statm").read_text().split()
        except OSError:
            continue
        total += (int(all_pages) - int(shared)) * PAGE
    return total


def measure(words):
    """Run `infill smooth`; return its report with the seconds, those of all processors, and the peak of memory."""
    begin, peak, before = time.perf_counter(), 0, resource.getrusage(resource.RUSAGE_CHILDREN)
    with tempfile.TemporaryFile() as out:
        process = subprocess.Popen([sys.executable, "-m", "infill.cli", "smooth", *words, "--json", "-q"], stdout=out)
        while process.poll() is None:
            peak = max(peak, resident(os.getpid()))
            time.sleep(0.1)
        out.seek(0)
        text = out.read()
    if process.returncode:
        raise SystemExit(process.returncode)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return {**json.loads(text), "wall": time.perf_counter() - begin, "cpu": cpu, "peak": peak}


def vertices_of(report):
    """Return the number of vertices in a report of a volume in chunks or in memory."""
    return report.get("vertices") or report["mesh"]["vertices"]


def show(name, report):
    """Print one line of figures."""
    print(
        f"{name}: {report['request']['method']}, {report['wall']:.0f} s, {report['cpu']:.0f} s of processors, "
        f"{report['peak'] / 2**30:.2f} GiB, {report['triangles']:,} triangles, "
        f"{report['wall'] / vertices_of(report) * 1e6:.2f} µs a vertex; closed: {report['closed']}"
    )
    print("   ", {stage: round(seconds, 1) for stage, seconds in report["seconds"].items()}, report.get("chunks", ""))


def check_closed(path):
    """Print what manifold3d says of a surface."""
    import manifold3d

    from infill import read_mesh

    surface = read_mesh(path)
    mesh = manifold3d.Mesh(surface.vertices.astype(np.float32), surface.faces.astype(np.uint32))
    solid = manifold3d.Manifold(mesh)
    print(
        f"{path}: {solid.status()}, {len(surface.faces):,} triangles, genus {solid.genus()}, {solid.volume():.0f} mm³"
    )


def run(path, words, cluster):
    """Smooth a volume in chunks, on a cluster of so many processes of one thread if not 0, and print figures."""
    if not cluster:
        show(path, measure((path, *words)))
        return
    from distributed import LocalCluster

    with LocalCluster(n_workers=cluster, threads_per_worker=1, dashboard_address=None) as workers:
        show(path, measure((path, *words, "--scheduler", workers.scheduler_address)))


def grow(sides, cell, method):
    """Smooth volumes of growing sides with one worker and with two, and print how time grows with the vertices."""
    vertices, seconds = [], {1: [], 2: []}
    for side in sides:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "cells.zarr"
            write(side, path, cell)
            for workers in seconds:
                report = measure((str(path), *method, "--workers", str(workers)))
                show(f"{side} with {workers}", report)
                seconds[workers].append(report["wall"])
            vertices.append(vertices_of(report))
    for workers, times in seconds.items():
        exponent = np.polyfit(np.log(vertices), np.log(times), 1)[0]
        print(f"{workers} workers: time grows with the vertices to the power of {exponent:.2f}")
    gains = [f"{side}: {one / two:.2f}" for side, one, two in zip(sides, seconds[1], seconds[2], strict=True)]
    print("one worker takes so many times as long as two:", ", ".join(gains))


def main():
    """Write a volume, or measure one."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("what", choices=["write", "run", "grow", "closed", "whole"])
    parser.add_argument("words", nargs="*")
    parser.add_argument("--cell", type=int, default=CELL, help="voxels of a cell of the gyroid")
    parser.add_argument("--workers", default="2")
    parser.add_argument("--cluster", type=int, default=0, help="processes of a cluster on this machine")
    parser.add_argument("--max-memory", default="5G")
    parser.add_argument("--tolerance", default="0", help="mm")
    parser.add_argument("--output", help="mesh to write, too")
    parser.add_argument("--smooth", default="plain", choices=["plain", "refine", "grey", "auto"])
    given = parser.parse_args()
    method = ("--threshold", str(THRESHOLD), "--smooth", given.smooth, "--tolerance", given.tolerance)
    if given.what == "write":
        write(int(given.words[0]), Path(given.words[1]), given.cell)
    elif given.what == "run":
        more = ("-o", given.output, "--force") if given.output else ()
        workers = () if given.cluster else ("--workers", given.workers)
        run(given.words[0], (*method, *workers, "--max-memory", given.max_memory, *more), given.cluster)
    elif given.what == "grow":
        grow([int(word) for word in given.words], given.cell, (*method, "--max-memory", given.max_memory))
    elif given.what == "closed":
        check_closed(given.words[0])
    else:
        side = int(given.words[0])
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "whole.npy"
            array = np.lib.format.open_memmap(path, mode="w+", dtype=np.uint8, shape=(side,) * 3)
            for low in np.ndindex(*(-(-side // CHUNK),) * 3):
                first = [n * CHUNK for n in low]
                last = [min(side, a + CHUNK) for a in first]
                array[tuple(slice(a, b) for a, b in zip(first, last, strict=True))] = gyroid(first, last, given.cell)
            array.flush()
            more = ("-o", given.output, "--force") if given.output else ()
            options = (*method, "--strict", "--allow-broken", "--threads", given.workers, *more)
            show(f"{side} in memory", measure((str(path), *options)))


if __name__ == "__main__":
    main()
