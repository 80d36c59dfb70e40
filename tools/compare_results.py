"""Compare what two checkouts make of the same inputs, byte for byte: `python tools/compare_results.py OTHER_CHECKOUT`.

For a change that must not change results, such as a renaming. Runs 3 designs, 12 `smooth`, 12 `fill` and 12 `refill` in
both, compares the files and the reports, and exits with 1 where any differ or are refused. Times and
versions in reports are left out.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
import trimesh

ROOT = Path(__file__).resolve().parents[1]
TIMED = {"seconds", "time_s", "elapsed", "timings", "memory", "peak_bytes", "version", "files", "threads"}
DIALECTS = [
    {"slicer": "prusa"},
    {"slicer": "orca"},
    {"slicer": "bambu"},
    {"slicer": "cura"},
    {"slicer": "prusa", "absolute": True},
    {"slicer": "prusa", "crlf": True, "objects": 2, "labels": "M486"},
]
PATTERNS = [
    "gyroid",
    "schwarz-p",
    "cubic",
    "octet",
    "kelvin",
    "honeycomb",
    "grid",
    "zigzag",
    "voronoi-foam",
    "triangles",
]


def make_inputs(folder: Path) -> list[list[str]]:
    """Write the inputs; return the commands, each with OUT in place of its output."""
    commands = [["make", name, "-o", "OUT.stl"] for name in ("concentric-heart", "zigzag", "honeycomb")]
    rng = np.random.default_rng(1)
    distance = np.linalg.norm(np.indices((48, 40, 44)) - np.array([24.0, 20.0, 22.0]).reshape(3, 1, 1, 1), axis=0)
    np.save(folder / "ball.npy", distance < 15)
    np.save(folder / "grey.npy", (400 * (15 - distance) + rng.normal(0, 60, distance.shape)).astype(np.int16))
    labels = np.where(distance < 15, 1 + (np.indices(distance.shape)[2] > 22), 0).astype(np.uint8)
    np.save(folder / "labels.npy", labels)
    ring = trimesh.creation.annulus(6, 10, 8)
    box = trimesh.creation.box((40, 22, 14))
    ball = trimesh.creation.icosphere(3, 12.0)
    for name, mesh in {"ring": ring, "box": box, "sphere": ball}.items():
        mesh.export(folder / f"{name}.stl")
    open_ball = ball.copy()
    open_ball.update_faces(np.arange(len(ball.faces)) > 3)
    open_ball.export(folder / "open.ply")
    np.savetxt(folder / "cloud.xyz", trimesh.sample.sample_surface(ball, 4000, seed=1)[0])
    commands += [
        ["smooth", "ball.npy", "--spacing", "0.5", "-o", "OUT.stl"],
        ["smooth", "ball.npy", "--spacing", "0.5,0.5,1", "-o", "OUT.stl"],
        ["smooth", "ball.npy", "--spacing", "0.5", "--steps", "5", "-o", "OUT.ply"],
        ["smooth", "grey.npy", "--spacing", "0.7", "--threshold", "0", "-o", "OUT.stl"],
        ["smooth", "grey.npy", "--spacing", "0.7", "--threshold", "400", "--despeckle", "2", "-o", "OUT.obj"],
        ["smooth", "labels.npy", "--spacing", "0.5", "--label", "1", "-o", "OUT.stl"],
        ["smooth", "labels.npy", "--spacing", "0.5", "--label", "2", "-o", "OUT.3mf"],
        ["smooth", "ring.stl", "-o", "OUT.stl"],
        ["smooth", "box.stl", "--voxel", "0.8", "-o", "OUT.stl"],
        ["smooth", "open.ply", "-o", "OUT.stl"],
        ["smooth", "sphere.stl", "--resolution", "32", "-o", "OUT.glb"],
        ["smooth", "cloud.xyz", "--voxel", "0.6", "-o", "OUT.stl"],
    ]
    commands += [["fill", "box.stl", "--pattern", name, "--density", "25%", "-o", "OUT.stl"] for name in PATTERNS]
    commands.append(["fill", "ring.stl", "--drain", "1", "-o", "OUT.stl"])
    commands.append(["fill", "sphere.stl", "--density", "15%:40%", "--by", "skin", "-o", "OUT.3mf"])
    sys.path.insert(0, str(ROOT / "tests"))
    from handmade_prints import Dialect, written

    for number, words in enumerate(DIALECTS):
        (folder / f"print{number}.gcode").write_bytes(written(Dialect(**words)))  # type: ignore[arg-type]
        commands.append(["refill", f"print{number}.gcode", "-o", "OUT.gcode"])
        commands.append(["refill", f"print{number}.gcode", "--pattern", PATTERNS[number % 2 * 5], "-o", "OUT.gcode"])
    return commands


def run(checkout: Path, folder: Path, words: list[str]) -> tuple[int, str, bytes]:
    """Run a command of a checkout in the folder of inputs; return its exit status, its report and its output."""
    name = next(word for word in words if word.startswith("OUT."))
    out = folder / name
    out.unlink(missing_ok=True)
    answer = subprocess.run(
        [sys.executable, "-m", "infill", *words, "--json"],
        cwd=folder,
        env=os.environ | {"PYTHONPATH": str(checkout)},
        capture_output=True,
        text=True,
        check=False,
    )
    report = json.dumps(drop_times(json.loads(answer.stdout))) if answer.stdout else answer.stderr
    return answer.returncode, report, out.read_bytes() if out.exists() else b""


def drop_times(value: Any) -> Any:  # noqa: ANN401 - JSON
    """Drop the keys of a report that differ from run to run."""
    if isinstance(value, dict):
        return {key: drop_times(item) for key, item in value.items() if key not in TIMED}
    return [drop_times(item) for item in value] if isinstance(value, list) else value


def main() -> int:
    """Compare; print one line for each command, and a count."""
    before = Path(sys.argv[1]).resolve()
    differing = failed = 0
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        commands = make_inputs(folder)
        for words in commands:
            old, new = run(before, folder, words), run(ROOT, folder, words)
            same = [a == b for a, b in zip(old, new, strict=True)]
            parts = [part for part, equal in zip(("status", "report", "file"), same, strict=True) if not equal]
            differing += bool(parts)
            failed += new[0] != 0
            result = f"differs: {', '.join(parts)}" if parts else f"same, exit {new[0]}, {len(new[2])} bytes"
            print(f"{result:32} infill {' '.join(words)}", flush=True)
    print(f"{len(commands)} commands, {differing} with a difference, {failed} refused")
    return 1 if differing or failed else 0


if __name__ == "__main__":
    sys.exit(main())
