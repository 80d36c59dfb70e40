"""What a mutated file is given to, and who else judges the answer."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from random import Random

import numpy as np

from tests.fuzzing import seeds
from tests.fuzzing.commands import Answer, faults_of, run_command
from tests.fuzzing.opinions import mesh_opinions, volume_opinions

# What the judge counts from strokes that a mutation left retracted: these get shorter as all strokes do.
RETRACTIONS = ("doubled retract", "retraction")
PROGRESS = re.compile(rb"M73( [PRQSCD]\d+(\.\d+)?)+ *(;.*)?")
NEAR = 1e-3  # of a size or an area: text of few digits, merged corners


@dataclass(frozen=True, kw_only=True)
class Target:
    """Files of one kind: how they are made, and `judge(path, folder, rng)`, which names the faults it finds.

    `judge` puts its output below `folder`, whose files it may not leave half-written.
    """

    make_seeds: Callable[[], dict[str, bytes]]
    judge: Callable[[Path, Path, Random], Iterator[str]]
    corpus: tuple[str, ...] = ()  # suffixes of real files that are seeds too


def judge_mesh(path: Path, folder: Path, rng: Random) -> Iterator[str]:
    """Check a mesh; now and then smooth or fill it."""
    answer = run_command("check", path, "--json")
    yield from faults_of(answer, may_fail_silently=True)
    if answer.out and not answer.escaped:
        told = json.loads(answer.out)
        yield from _contradictions(told, path)
    draw = rng.random()
    if draw < 0.02:
        yield from _made(folder, "smooth", path, "--resolution", "24", "-o", "OUT.stl")
    elif draw < 0.03:
        yield from _made(folder, "fill", path, "--density", "30%", "-o", "OUT.stl")


def _contradictions(told: dict[str, object], path: Path) -> Iterator[str]:
    """Compare what is told of a mesh with other readers; a fault is what all that read it contradict."""
    opinions = mesh_opinions(path)
    if not opinions:
        return
    if told["closed"] and not any(each.closed for each in opinions):
        yield f"closed, which {' and '.join(each.reader for each in opinions)} contradict"
    extents = np.sort(np.array(told["extents"], dtype=float))
    if told["printable"] and not any(
        np.allclose(extents, np.sort(each.extents), rtol=NEAR, atol=NEAR * max(extents.max(), 1e-30))
        for each in opinions
    ):
        yield f"extents, which {' and '.join(each.reader for each in opinions)} contradict"
    area = float(told["area"])  # type: ignore[arg-type]
    measured = [each for each in opinions if each.area is not None]
    if (
        told["printable"]
        and measured
        and not any(abs(area - each.area) <= 10 * NEAR * max(area, each.area) for each in measured)
    ):
        yield f"printable, with an area that {' and '.join(each.reader for each in opinions)} contradict"


def judge_volume(path: Path, folder: Path, rng: Random) -> Iterator[str]:
    """Smooth a volume, and compare its cells and its place with other readers."""
    yield from _made(
        folder, "smooth", path, "--threshold", "600", "--json", "-o", "OUT.stl", then=lambda answer: _misread(path)
    )


def _misread(path: Path) -> Iterator[str]:
    from infill import read_volume

    volume = read_volume(path)
    opinions = volume_opinions(path)
    values = np.sort(np.asarray(volume.values, dtype=float).ravel())
    sizes = np.sort(volume.cell_size)
    if opinions and not any(each.shape == sorted(volume.values.shape) for each in opinions):
        yield f"a shape that {' and '.join(each.reader for each in opinions)} contradict"
    elif opinions and not any(np.allclose(values, np.sort(each.values, axis=None)) for each in opinions):
        yield f"cells that {' and '.join(each.reader for each in opinions)} contradict"
    placed = [each for each in opinions if each.sizes is not None]
    if placed and not any(np.allclose(sizes, np.sort(each.sizes), rtol=NEAR) for each in placed):
        yield f"sizes of cells that {' and '.join(each.reader for each in placed)} contradict"


def judge_points(path: Path, folder: Path, rng: Random) -> Iterator[str]:
    """Make a solid of points."""
    yield from _made(
        folder, "smooth", path, "--voxel", "0.8", "-o", "OUT.stl", "--shell", "2" if rng.random() < 0.3 else "0.9"
    )


def judge_drawing(path: Path, folder: Path, rng: Random) -> Iterator[str]:
    """Repeat a drawing as the infill of a small print; now and then, of a part."""
    if rng.random() < 0.05:
        yield from _made(folder, "fill", _part(folder), "--pattern", path, "-o", "OUT.stl")
        return
    sliced = folder.parent / "plain.gcode"
    if not sliced.exists():
        sliced.write_bytes(seeds.print_seeds()["prusa.gcode"])
    yield from _made(folder, "refill", sliced, "--pattern", path, "-o", "OUT.gcode")


def judge_print(path: Path, folder: Path, rng: Random) -> Iterator[str]:
    """Time a print and refill it; nothing but its infill may change."""
    from tests.gcode_judge import judge

    yield from faults_of(run_command("motion", path, "--json"))

    def compare(answer: Answer) -> Iterator[str]:
        out = folder / "OUT.gcode"
        if path.suffix == ".gcode" and out.exists() and rng.random() < 0.3 and _is_unambiguous(path, answer):
            for fault in judge(path.read_bytes(), out.read_bytes()):
                if not fault.startswith(RETRACTIONS):
                    yield f"refilled: {fault}"

    yield from _made(folder, "refill", path, "--json", "-o", "OUT.gcode", then=compare)


def _is_unambiguous(path: Path, answer: Answer) -> bool:
    """Tell whether every reader must read a print alike.

    Refill warns of no line, M73 is written as slicers write it, and all lines end alike.
    """
    text = path.read_bytes()
    progress = [line for line in text.splitlines() if b"M73" in line]
    unread = json.loads(answer.out)["print"]["unread_lines"]
    one_ending = text.count(b"\r\n") in (0, text.count(b"\n")) and b"\r\r" not in text
    return unread == 0 and all(map(PROGRESS.fullmatch, progress)) and one_ending


def judge_field(path: Path, folder: Path, rng: Random) -> Iterator[str]:
    """Refill a small print with a density that follows a field."""
    sliced = folder.parent / "plain.gcode"
    if not sliced.exists():
        sliced.write_bytes(seeds.print_seeds()["prusa.gcode"])
    yield from _made(
        folder, "refill", sliced, "--pattern", "grid", "--density", "20%:40%", "--by", path, "-o", "OUT.gcode"
    )


def judge_printer(path: Path, folder: Path, rng: Random) -> Iterator[str]:
    """Plan a print within the limits of a printer, and write its time into it."""
    sliced = folder.parent / "timed.gcode"
    if not sliced.exists():
        sliced.write_bytes(seeds.print_seeds()["prusa.gcode"].replace(b"\n", b"\nSTART_PRINT\n", 1))
    yield from _made(folder, "motion", sliced, "--printer", path, "--json", "--write", "OUT.gcode")


def judge_settings(path: Path, folder: Path, rng: Random) -> Iterator[str]:
    """Take options from a file."""
    if path.name.startswith("make"):
        yield from faults_of(run_command("make", "--config", path, "--dry-run", "-o", folder / "OUT.stl"))
    else:
        yield from faults_of(
            run_command("fill", _part(folder), "--config", path, "--dry-run", "-o", folder / "OUT.stl")
        )


def _made(
    folder: Path, *words: str | Path, then: Callable[[Answer], Iterator[str]] = lambda answer: iter(())
) -> Iterator[str]:
    """Run a command whose output is OUT.*, and judge what lies in the folder afterwards."""
    placed = [folder / word if isinstance(word, str) and word.startswith("OUT.") else word for word in words]
    before = {path.name for path in folder.iterdir()}
    answer = run_command(*placed)
    yield from faults_of(answer)
    new = {path.name for path in folder.iterdir()} - before
    if answer.done:
        wanted = {word for word in words if isinstance(word, str) and word.startswith("OUT.")}
        if new != wanted:
            yield f"exit status 0 left {sorted(new)}"
        yield from then(answer)
    elif new:
        yield f"exit status {answer.status} left {sorted(new)}"
    for name in new:
        (folder / name).unlink()


@cache
def _box() -> bytes:
    import trimesh

    return bytes(trimesh.creation.box((16, 14, 12)).export(file_type="stl"))


def _part(folder: Path) -> Path:
    part = folder.parent / "part.stl"
    if not part.exists():
        part.write_bytes(_box())
    return part


TARGETS: dict[str, Target] = {
    "meshes": Target(make_seeds=seeds.mesh_seeds, judge=judge_mesh, corpus=(".stl", ".obj", ".ply", ".off")),
    "volumes": Target(make_seeds=seeds.volume_seeds, judge=judge_volume),
    "points": Target(make_seeds=seeds.point_seeds, judge=judge_points),
    "drawings": Target(make_seeds=seeds.drawing_seeds, judge=judge_drawing, corpus=(".png",)),
    "prints": Target(make_seeds=seeds.print_seeds, judge=judge_print),
    "fields": Target(make_seeds=seeds.field_seeds, judge=judge_field),
    "printers": Target(make_seeds=seeds.printer_seeds, judge=judge_printer),
    "settings": Target(make_seeds=seeds.settings_seeds, judge=judge_settings),
}
