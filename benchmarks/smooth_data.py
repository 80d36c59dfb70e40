"""`infill smooth` on every file of the test data: ``python -m benchmarks.smooth_data [FOLDER] [--only REGEX]``.

Each file is given to the command as a user would give it, with the default options, and what it writes is judged by
trimesh and VTK. Results go to build/smooth-report.json, and the table to docs/smooth-report.md.
"""

from __future__ import annotations

import multiprocessing
import re
import sys
import tempfile
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
import trimesh

from benchmarks.slicer_tables import table
from benchmarks.smooth_judge import Judgement, judge, judge_points
from benchmarks.smooth_page import put
from benchmarks.smooth_runs import Smoothed, arguments, command_of, keep, made_with, read_results, smoothed
from benchmarks.smooth_scenes import SCANS, Scan, isosurface, read, write

SECTION = "data"
FOLDERS = ("models", "medical", "printable", "nasty")
ENDS = {".stl", ".off", ".obj", ".ply", ".3mf", ".xyz"}
KEPT = "kept"  # what a report without a verdict says
TOLD = 110  # characters of a message in the table
CORNER = 3.5  # voxels: the tip of a cube that 20 steps round is 3.3 away
LEAST = 1e-3  # shares below are not told


@dataclass(frozen=True)
class Case:
    """A file of the test data, or a scan of it."""

    name: str
    path: Path
    scan: Scan | None = None


def cases(folder: Path) -> list[Case]:
    """Return all cases, folder by folder."""
    files = [path for each in FOLDERS for path in sorted((folder / each).glob("*")) if path.suffix.lower() in ENDS]
    found = [Case(path.relative_to(folder).as_posix(), path) for path in files]
    return found + [Case(f"volumes/{name}", folder, scan) for name, scan in SCANS.items()]


def run(case: Case, command: Sequence[str]) -> dict[str, Any]:
    """Smooth one file and return all that is known of it, plain enough for JSON."""
    with tempfile.TemporaryDirectory() as name:
        folder, source, options, image = Path(name), case.path, [], None
        if case.scan:
            image = read(case.path, case.scan)
            source = write(image, folder / "scan.nrrd")
            options = [] if case.scan.threshold is None else ["--threshold", f"{case.scan.threshold:g}"]
        done = smoothed(command, source, folder / "out.stl", options)
        row = facts(done)
        if done.status and "--units m " in done.message:  # as it advises
            row["unit"] = done.message
            done = smoothed(command, source, folder / "out.stl", ["--units", "m"])
            row |= facts(done)
        if done.status:
            return row
        result = trimesh.load(folder / "out.stl", force="mesh")
        spacing = np.asarray(done.report["grid"]["spacing"], dtype=np.float64)
        try:
            judged = _judged(case, result, spacing, image, metres="unit" in row)
        except (ValueError, IndexError) as error:
            return row | {"unread": f"trimesh: {error}".splitlines()[0]}
        return row | {"judged": asdict(judged) | {"lost": judged.lost}}


def facts(done: Smoothed) -> dict[str, Any]:
    """Return what the command told."""
    verdict = done.report.get("verdict") or {}
    return {
        "status": done.status,
        "message": done.message,
        "seconds": done.seconds,
        "memory": done.memory,
        "word": verdict.get("word"),
        "changes": verdict.get("changes", []),
        "problems": done.report.get("problems", []),
    }


def _judged(case: Case, result: trimesh.Trimesh, spacing: np.ndarray, image: Any, *, metres: bool) -> Judgement:
    if case.scan:
        return judge(isosurface(image, case.scan.level), result, image.spacing[::-1])
    if case.path.suffix == ".xyz":
        return judge_points(np.loadtxt(case.path)[:, :3] * (1000.0 if metres else 1.0), result, spacing)
    given = _read_mesh(case.path)
    if not len(given.faces):
        raise ValueError("no faces")
    given.apply_scale(1000.0 if metres else 1.0)
    return judge(given, result, spacing)


def _read_mesh(path: Path) -> trimesh.Trimesh:
    """Return a mesh as trimesh reads it; polygons of an OBJ are cut by VTK, since a fan may cover too much."""
    mesh: trimesh.Trimesh = trimesh.load(path, force="mesh")
    text = path.read_text(encoding="utf-8", errors="replace") if path.suffix == ".obj" else ""
    lines = re.sub(r"\\\r?\n", " ", text).splitlines()
    polygons = [[int(word.split("/")[0]) for word in line.split()[1:]] for line in lines if line.startswith("f ")]
    if max(map(len, polygons), default=3) < 4 or min(map(min, polygons)) < 1:
        return mesh
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy

    points, cells = vtk.vtkPoints(), vtk.vtkCellArray()
    for line in lines:
        if line.startswith("v "):
            points.InsertNextPoint(*map(float, line.split()[1:4]))
    for polygon in polygons:
        cells.InsertNextCell(len(polygon), [corner - 1 for corner in polygon])
    data, triangles = vtk.vtkPolyData(), vtk.vtkTriangleFilter()
    data.SetPoints(points)
    data.SetPolys(cells)
    triangles.SetInputData(data)
    triangles.Update()
    cut = triangles.GetOutput()
    faces = vtk_to_numpy(cut.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    return trimesh.Trimesh(vtk_to_numpy(cut.GetPoints().GetData()), faces, process=False)


def unreported(row: dict[str, Any]) -> bool:
    """Tell whether something was lost of which the report says nothing; no verdict counts as kept."""
    return bool(row.get("judged", {}).get("lost")) and (row.get("word") or KEPT) == KEPT


def retied(row: dict[str, Any]) -> bool:
    """Tell whether the result has more or fewer shells or tunnels than the input, where both are known.

    Bodies that overlap become one, as they should.
    """
    judged = row.get("judged", {"hidden": 1.0})
    if judged["hidden"] > LEAST:
        return False
    return any(None not in judged[what] and len(set(judged[what])) > 1 for what in ("shells", "tunnels"))


def section(rows: dict[str, dict[str, Any]], made: str) -> str:
    """Return the head, the table, and the losses one by one."""
    refused = [name for name, row in rows.items() if row["status"]]
    silent = [name for name, row in rows.items() if unreported(row)]
    lost = [name for name, row in rows.items() if row.get("judged", {}).get("lost")]
    deep = sum(rows[name]["judged"]["input_to_result"]["largest"] > CORNER for name in silent)
    mute = sum(not row["status"] and row["word"] is None for row in rows.values())
    units = sum("unit" in row and not row["status"] for row in rows.values())
    found = [row for row in rows.values() if "judged" in row]
    judged = [row["judged"] for row in found]
    knots = [row for row in rows.values() if retied(row)]
    alarms = sum((row.get("word") or KEPT) != KEPT and not row["judged"]["lost"] for row in found)
    groups = dict.fromkeys(name.partition("/")[0] for name in rows)
    spread = ", ".join(f"{sum(name.startswith(each + '/') for name in refused)} in {each}" for each in groups)
    head = [
        f"Made with {made}.\n",
        f"* **Refused: {len(refused)} of {len(rows)}** ({spread})."
        + (f" {units} more asked for the unit first, and got `--units m` as the message advises." if units else ""),
        f"* **Losses that the report does not tell: {len(silent)}**, of {len(lost)} losses in "
        f"{len(judged)} results that could be judged"
        + (
            f"; {deep} of the {len(silent)} reach deeper than {CORNER:g} voxels, which is what smoothing takes from "
            "the corner of a cube."
            if silent
            else "."
        )
        + (f" {mute} reports have no verdict, which counts as “{KEPT}”." if mute else ""),
        f"* Results with more or fewer shells or tunnels than the input: {len(knots)}, of which the report says "
        f"“{KEPT}” of {sum((row['word'] or KEPT) == KEPT for row in knots)}. Verdicts other than “{KEPT}” where "
        f"nothing is lost by this measure: {alarms}.",
        f"* Results that are not closed: {sum(not each['closed'][1] for each in judged)}; "
        f"not manifold: {sum(not each['manifold'][1] for each in judged)}.\n",
    ]
    return "\n".join(head) + "\n" + table(HEAD, [_line(name, row) for name, row in rows.items()]) + _losses(rows)


HEAD = (
    "file", "ended with", "s", "GiB", "triangles in → out", "verdict", "result to input", "input to result",
    "shells in → out", "tunnels in → out", "volume", "loss not told",
)  # fmt: skip


def _line(name: str, row: dict[str, Any]) -> tuple[str, ...]:
    start = (name, _ended(row), f"{row['seconds']:.1f}", f"{row['memory'] / 2**30:.2f}")
    judged = row.get("judged")
    if not judged:
        return (*start, *["-"] * 8)
    notes = [f"{judged['capped']:.1%} over holes"] * (judged["capped"] > LEAST)
    notes += [f"{judged['hidden']:.1%} hidden"] * (judged["hidden"] > LEAST)
    return (
        *start,
        " → ".join(f"{count:,}" for count in judged["triangles"]),
        row["word"] or "-",
        _far(judged["result_to_input"]),
        "; ".join([_far(judged["input_to_result"]), *notes]),
        _change(judged["shells"]),
        _change(judged["tunnels"]),
        "-" if judged["volume"] is None else f"{judged['volume']:+.2%}".replace("-", "−"),
        ("**yes**" if unreported(row) else "told") if judged["lost"] else "no loss",
    )


def _ended(row: dict[str, Any]) -> str:
    if row["status"]:
        text = row["message"].removeprefix("error: ")
        return f"{row['status']}: {text[:TOLD]}{'…' * (len(text) > TOLD)}"
    return "0; not judged" if "unread" in row else "0, with `--units m`" if "unit" in row else "0"


def _far(distances: dict[str, float]) -> str:
    return " / ".join(f"{distances[key]:.2f}" for key in ("mean", "p95", "largest"))


def _change(pair: Sequence[int | None]) -> str:
    return " → ".join("?" if count is None else f"{count:,}" for count in pair)


def _losses(rows: dict[str, dict[str, Any]]) -> str:
    lines = []
    for name, row in rows.items():
        judged = row.get("judged", {})
        if judged.get("lost"):
            patches = judged["patches"]
            longest, deepest = patches[0], max(patches, key=lambda patch: patch["depth"])
            place = ", ".join(f"{x:.4g}" for x in deepest["at"])
            told = "; ".join(row["changes"]) or "nothing"
            share = f"{judged['input_to_result']['p999']:.2f}"
            lines.append((name, share, f"{longest['length']:.1f}", f"{deepest['depth']:.1f}", place, told))
    if not lines:
        return ""
    head = ("file", "99.9 %", "longest piece", "deepest", "there", "the report says")
    return "\nThe losses one by one, in voxels; the place is that of the deepest:\n\n" + table(head, lines)


def main() -> None:
    """Run the cases that are asked for, keep their results, and write the table."""
    words = arguments(__doc__ or "")
    given = words.parse_args()
    command = command_of(given.command)
    stored = read_results(given.results).get(SECTION, {"rows": {}, "made": ""})
    if not given.page:
        todo = [case for case in cases(given.folder) if re.search(given.only, case.name)]
        if not todo:
            words.error(f"no case matches {given.only!r} in the folder given")
        stored["made"] = made_with(command)
        spawned = multiprocessing.get_context("spawn")
        with ProcessPoolExecutor(max_workers=given.jobs, mp_context=spawned) as pool:
            waiting = {pool.submit(run, case, command): case.name for case in todo}
            for future in as_completed(waiting):
                name, row = waiting[future], future.result()
                stored["rows"][name] = row
                keep(given.results, SECTION, stored)
                print(" | ".join(_line(name, row)), flush=True)
    order = {case.name: n for n, case in enumerate(cases(given.folder))}
    rows = dict(sorted(stored["rows"].items(), key=lambda item: order.get(item[0], len(order))))
    put(given.into, SECTION, section(rows, stored["made"]))


if __name__ == "__main__":
    sys.exit(main())
