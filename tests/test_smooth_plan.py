"""`infill smooth --dry-run`: what it says is what a run does; nothing is written."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from test_command_line import one_line_error, run

from infill import Volume
from infill.smoothing.plan import count_solid_cells, plan_smoothing

pytestmark = pytest.mark.usefixtures("compiled", "silent_compiler")

FAR = 8 - np.sqrt(np.sum((np.indices((24, 26, 24)) - 11.5) ** 2, axis=0))


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("infill.smoothing.plan.BALL_RADIUS", 5.0)  # cells: how long it takes is not looked at here
    np.save("ball.npy", FAR > 0)
    np.save("thick.npy", (FAR > 0)[:, :, ::4])
    np.save("ct.npy", (100 * FAR).astype(np.int16))
    trimesh.util.concatenate(
        [trimesh.creation.box((10, 20, 30)), trimesh.creation.icosphere(radius=8).apply_translation((30, 0, 0))]
    ).export("two.stl")
    np.savetxt("p.xyz", trimesh.creation.icosphere(4, radius=10.0).vertices)
    return tmp_path


def printed(*words: str) -> dict[str, Any]:
    result = run("smooth", *words, "--json")
    assert result.exit_code == 0, result.output
    return dict(json.loads(result.stdout))


@pytest.mark.long
@pytest.mark.parametrize(
    "words",
    [
        ["thick.npy", "--spacing", "1,1,4"],
        ["ct.npy", "--otsu", "--voxel", "1.5", "--smooth", "plain", "--tolerance", "0"],
        ["two.stl", "--resolution", "30", "--max-triangles", "3000"],
        ["p.xyz", "--resolution", "24"],
        ["p.xyz", "--voxel", "0.8", "--shell", "3"],
    ],
    ids=" ".join,
)
def test_a_run_does_what_was_foreseen(words: list[str], folder: Path) -> None:
    before = sorted(folder.iterdir())
    plan = printed(*words, "--dry-run", "-o", "a.stl", "--preview", "a.png")
    assert sorted(folder.iterdir()) == before
    assert plan["files"] == ["a.stl", "a.png"]
    report = printed(*words, "--allow-broken")
    assert plan["request"] == report["request"]
    for name, value in report["grid"].items():
        assert plan["grid"][name] == (value if name in ("shape", "space") else pytest.approx(value))
    assert plan["ways"][0] == report["verdict"]["tried"][0]
    full = report["mesh"].get("simplified", {}).get("triangles_before", report["triangles"])
    # Points are looked at with larger voxels; a shell as wide as four of them has rounder rims than one of many.
    assert plan["triangles_before"] == pytest.approx(full, rel=0.1)
    assert plan["solid"]["data"] == pytest.approx(report["solid"]["data"], rel=0.1)
    assert plan["seconds"]["total"] > 0
    assert plan["memory"] > 10**8
    if report["input"]["source"] == "volume":
        assert plan["input"] == {name: report["input"][name] for name in plan["input"]}
        assert plan["input"]["segmentation"]


@pytest.mark.slow
def test_it_is_told_in_words(folder: Path) -> None:
    result = run("smooth", "ct.npy", "--threshold", "0", "--dry-run", "-o", "a.stl")
    assert result.exit_code == 0, result.output
    assert result.stderr == ""
    for words in (
        "ct.npy: nothing is written (--dry-run)",
        "solid by range from 0",
        "24 x 26 x 24 voxels of 1 x 1 x 1 mm",
        "grey: 20 steps",
        "it tries in turn: grey, 10 steps; ",
        "would write",
    ):
        assert words in result.stdout


@pytest.mark.slow
@pytest.mark.parametrize(
    ("words", "says"),
    [
        ("ct.npy", "do not say what is solid; give --threshold"),
        ("gone.stl", "there is no file gone.stl"),
        ("two.stl --threshold 3", "threshold is for"),
        ("two.stl --voxel 100", "voxel is 100 mm and the part"),
        ("p.xyz --voxel 1 --shell 0.5", "shell is 0.5 mm and voxel 1 mm"),
        ("ball.npy --max-memory 1M", "is allowed; give larger voxels"),
        ("ball.npy -o old.stl", "old.stl exists"),
        ("ball.npy --each-label --label 9 -o a.3mf", "label is 9, and the volume holds 1"),
        ("p.xyz --each-label -o a.3mf", "are those of a volume"),
    ],
)
def test_what_would_fail_fails_beforehand(words: str, says: str, folder: Path) -> None:
    (folder / "old.stl").write_text("precious")
    one_line_error(run("smooth", *words.split(), "--dry-run"), says)


def test_the_program_is_loaded_with_a_small_ball(monkeypatch: pytest.MonkeyPatch) -> None:
    """One tenth of the ball that is timed: it is smoothed for what it loads, and nobody reads its time."""
    balls = []

    def smooth_nothing(ways: Any, request: Any) -> None:
        balls.append(int(np.count_nonzero(ways[0].data.data.values)))

    monkeypatch.setattr("infill.smoothing.plan.first_sound", smooth_nothing)
    values = np.zeros((12, 12, 12), dtype=bool)
    values[3:9, 3:9, 3:9] = True
    plan_smoothing(Volume(values=values), begin=0.0)
    loading, timed = balls
    assert loading < timed / 10


@given(arrays(bool, st.tuples(*3 * [st.integers(1, 5)])))
def test_crossings_are_the_sign_changes_of_the_padded_grid(solid: np.ndarray) -> None:
    padded = np.pad(solid, 1)
    changes = sum(int((np.diff(padded.astype(int), axis=axis) != 0).sum()) for axis in range(3))
    assert count_solid_cells(solid) == (int(solid.sum()), changes)


@pytest.mark.parametrize("words", ["--threshold 0", "--threshold 0 --smooth refine", "--threshold 0 --smooth plain"])
def test_the_steps_are_told_in_the_same_words(words: str, folder: Path) -> None:
    plan = run("smooth", "ct.npy", *words.split(), "--dry-run")
    summary = run("smooth", "ct.npy", *words.split(), "-o", "a.stl")
    planned = re.search(r"^  method +\w+: (\d+ steps(?:, refined)?)", plan.stdout, re.M)
    taken = re.search(r"^  smoothing +(\d+ steps(?:, refined)?), ", summary.stderr, re.M)
    assert planned, plan.stdout
    assert taken, summary.stderr
    assert planned[1] == taken[1]
    assert ("refined" in planned[1]) == ("plain" not in words)


def test_steps_taken_instead_of_a_radius_are_told_beside_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A wall of two voxels does not bear a radius of four."""
    monkeypatch.chdir(tmp_path)
    solid = np.zeros((60, 60, 60), bool)
    solid[10:50, 10:50, 10:20] = True
    solid[29:31, 10:50, 10:50] = True
    np.save("plate.npy", solid)
    done = run("smooth", "plate.npy", "--spacing", "1", "--smooth-radius", "4", "-o", "a.stl", "--json")
    report = json.loads(done.stdout)
    assert report["verdict"]["instead_of"] == {"steps": 56, "radius": 4}
    steps = report["request"]["steps"]
    assert steps < 56
    assert f"{steps} steps, refined, instead of the 56 of --smooth-radius 4, with which more changed" in done.stderr
    gentle = json.loads(run("smooth", "plate.npy", "--spacing", "1", "--steps", str(steps), "--json").stdout)
    assert gentle["verdict"]["instead_of"] is None
