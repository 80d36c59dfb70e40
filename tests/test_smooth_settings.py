"""`infill smooth --config` and `--save-config`: what is saved gives the same bytes, flags win, mistakes are one line."""

from __future__ import annotations

import dataclasses
import tomllib
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from test_command_line import one_line_error, run, usage_error

from infill import ParameterError, Smoothing, UsageError, smooth_volume
from infill.smoothing.request import SmoothRequest
from infill.smoothing.settings import SmoothSettings, resolve

pytestmark = pytest.mark.usefixtures("compiled", "silent_compiler")

BALL = np.sum((np.indices((24, 24, 24)) - 11.5) ** 2, axis=0)
# What belongs to a run and not to what comes of it.
RUN_ONLY = {"output", "preview", "config", "save_config", "ascii", "force", "threads", "max_memory", "json", "quiet"}
RUN_ONLY |= {"verbose", "help", "dry_run", "trust"}


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    np.save("ct.npy", (100 * (8 - np.sqrt(BALL))).astype(np.int16))
    return tmp_path


@pytest.mark.slow
@pytest.mark.parametrize(
    "words",
    [
        ["--range", "200,900", "--spacing", "0.5,0.5,1", "--smooth", "plain", "--fidelity", "0.05", "--strict"],
        ["--otsu", "--grey", "--smooth-radius", "1.5", "--roi", "2,20,0,24,0,24", "--tolerance", "0", "--allow-broken"],
    ],
)
def test_a_saved_config_gives_the_same_bytes(words: list[str], folder: Path) -> None:
    result = run("smooth", "ct.npy", *words, "--save-config", "a.toml", "-o", "a.stl")
    assert result.exit_code == 0, result.output
    assert "wrote a.toml" in result.stderr
    again = run("smooth", "ct.npy", "--config", "a.toml", "--save-config", "b.toml", "-o", "b.stl")
    assert again.exit_code == 0, again.output
    assert (folder / "a.stl").read_bytes() == (folder / "b.stl").read_bytes()
    assert (folder / "a.toml").read_text() == (folder / "b.toml").read_text()


@pytest.mark.slow
def test_every_label_by_a_saved_config(folder: Path) -> None:
    np.save("labels.npy", ((BALL < 64) * 3).astype(np.uint8))
    (folder / "names.txt").write_text("3 Rib 255 0 0 0\n")
    words = ["--each-label", "--labels", "names.txt", "--label", "3", "--save-config", "a.toml"]
    assert run("smooth", "labels.npy", *words, "-o", "a.glb").exit_code == 0
    assert run("smooth", "labels.npy", "--config", "a.toml", "-o", "b.glb").exit_code == 0
    assert (folder / "a.glb").read_bytes() == (folder / "b.glb").read_bytes()
    assert b"Rib" in (folder / "b.glb").read_bytes()


@pytest.mark.slow
def test_a_config_alone_is_written_and_shown(folder: Path) -> None:
    """Nothing is smoothed for it, but what it says must make sense."""
    shown = run("smooth", "ct.npy", "--threshold", "300", "--save-config", "-", "-q")
    assert run("smooth", "ct.npy", "--threshold", "300", "--save-config", "a.toml").stderr == "wrote a.toml\n"
    assert shown.stdout == (folder / "a.toml").read_text()
    assert tomllib.loads(shown.stdout)["threshold"] == 300
    one_line_error(run("smooth", "ct.npy", "--threshold", "300", "--save-config", "a.toml"), "exists; .* --force")
    one_line_error(run("smooth", "ct.npy", "--level", "5", "--save-config", "b.toml"), "level is 5")
    assert not (folder / "b.toml").exists()
    assert run("smooth", "ct.npy", "--save-config", "-", "--json").exit_code == 2
    made = run("make", "honeycomb", "--cell", "4", "--save-config", "-", "-q")
    assert tomllib.loads(made.stdout)["set"]["cell"] == 4


def test_flags_win_over_the_file(folder: Path) -> None:
    config = folder / "a.toml"
    config.write_text("otsu = true\nsmooth-radius = 1\ngrey = true\nfidelity = 0.1\nvoxel = 2\n")
    assert resolve({}, config) == SmoothSettings(otsu=True, smooth_radius=1, grey=True, fidelity=0.1, voxel=2)
    # What is typed takes the place of what says the same thing in another way.
    assert resolve({"threshold": 3.0}, config) == dataclasses.replace(resolve({}, config), otsu=False, threshold=3)
    assert resolve({"steps": 20}, config) == dataclasses.replace(resolve({}, config), smooth_radius=None, steps=20)
    assert resolve({"refine": True}, config) == dataclasses.replace(resolve({}, config), fidelity=None, refine=True)
    assert resolve({"resolution": 9}, config) == dataclasses.replace(resolve({}, config), voxel=None, resolution=9)
    assert resolve({"otsu": False}, config) == dataclasses.replace(resolve({}, config), otsu=False)
    assert resolve({"threshold": 0.0}, config) == dataclasses.replace(resolve({}, config), otsu=False, threshold=0)
    (folder / "b.toml").write_text("threshold = 3\n")
    assert resolve({"otsu": False}, folder / "b.toml") == SmoothSettings(threshold=3)
    assert resolve({"grey": False}, config) == dataclasses.replace(resolve({}, config), grey=False)


def test_a_flag_that_is_typed_wins_even_if_it_is_the_default(folder: Path) -> None:
    (folder / "a.toml").write_text("threshold = 300\nsteps = 7\ngrey = true\nlevel = 0\n")
    words = ["--steps", "20", "--no-grey", "--level", "volume", "--save-config", "-", "-q"]
    found = tomllib.loads(run("smooth", "ct.npy", "--config", "a.toml", *words).stdout)
    assert (found["steps"], found["grey"], found["level"], found["threshold"]) == (20, False, "volume", 300)
    kept = tomllib.loads(run("smooth", "ct.npy", "--config", "a.toml", *words[-3:]).stdout)
    assert (kept["steps"], kept["grey"], kept["level"], kept["threshold"]) == (7, True, 0, 300)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("treshold = 3", "smooth has no option 'treshold'; did you mean 'threshold'"),
        ("qqq = 3", "smooth has no option 'qqq'; it has as, units"),
        ("threads = 3", "smooth has no option 'threads'"),
        ('threshold = "three"', "threshold is 'three'; it must be a number"),
        ("threshold = true", "threshold is True; it must be a number"),
        ("steps = 2.5", "steps is 2.5; it must be a whole number"),
        ("grey = 1", "grey is 1; it must be true or false"),
        ("units = 3", "units is 3; it must be a word"),
        ("range = [1]", "range is .1.; give 2 number"),
        ("range = [1, true]", "range is .1, True.; give 2 number"),
        ("spacing = [[1], 2, 3]", "spacing is .*; give 1 or 3 number"),
        ("label = []", "label is empty; give a whole number"),
        ('label = ["rib"]', "label is 'rib'; it must be a whole number"),
        ('level = "middle"', "level is 'middle'; give volume, or a number"),
        ("level = [0]", "level is .0.; "),
        ('refine = true\nsmooth = "plain"', "refine is smooth = refine, and smooth is plain; leave one"),
        ('fidelity = 0.1\nsmooth = "grey"', "fidelity is for smooth = plain alone"),
        ("[set]\ncell = 3", "smooth has no option 'set'"),
        ("steps = 12\nsmooth-radius = 1", "steps and smooth_radius are both given, and each decides the other"),
        ("otsu = true\nthreshold = 3", "threshold and otsu exclude each other"),
        ("steps = ", "is not TOML"),
    ],
)
def test_a_bad_config_is_one_clear_line(text: str, says: str, folder: Path) -> None:
    (folder / "a.toml").write_text(text)
    before = sorted(folder.iterdir())
    one_line_error(run("smooth", "ct.npy", "--config", "a.toml", "-o", "a.stl"), says)
    assert sorted(folder.iterdir()) == before


def test_a_missing_config_is_told() -> None:
    one_line_error(run("smooth", "ct.npy", "--config", "no.toml", "-o", "a.stl"), "there is no config file no.toml")


def test_steps_beside_a_radius_are_refused(folder: Path) -> None:
    """One decides the other: typed, in Python, and not in what is saved, which has the radius alone."""
    says = "--steps and --smooth-radius are both given, and each decides the other; give one of them"
    usage_error(run("smooth", "ct.npy", "--steps", "12", "--smooth-radius", "1", "-o", "a.stl"), says)
    with pytest.raises(UsageError, match="smoothing and radius are both given, and a radius decides the steps"):
        smooth_volume(BALL < 64, smoothing=Smoothing(steps=12), radius=1.0)
    assert SmoothRequest(smoothing=Smoothing(steps=20, interface=3.0), radius=1.0).radius == 1
    path = folder / "b.toml"
    path.write_text(SmoothSettings(smooth_radius=1.5).to_toml())
    assert resolve({}, path) == SmoothSettings(smooth_radius=1.5)


VALUES = {
    "array": st.text(min_size=1, max_size=5).filter(str.strip),
    "threshold": st.floats(allow_nan=False, allow_infinity=False),
    "steps": st.integers(-5, 10**6),
    "label": st.lists(st.integers(-9, 9), min_size=1, max_size=3).map(tuple),
    "spacing": st.tuples(*[st.floats(-5, 5)] * 3),
    "grey": st.booleans(),
    "level": st.one_of(st.just("volume"), st.floats(-1, 1)),
}


@given(st.fixed_dictionaries({}, optional=VALUES))
def test_settings_survive_the_file(tmp_path_factory: pytest.TempPathFactory, values: dict[str, object]) -> None:
    """Any text, also what TOML escapes; whether it makes sense is asked later."""
    path = tmp_path_factory.mktemp("settings") / "a.toml"
    settings = SmoothSettings(**values)
    path.write_text(settings.to_toml(), encoding="utf-8")
    assert resolve({}, path) == settings


def test_what_is_not_text_is_told() -> None:
    with pytest.raises(ParameterError, match=r"'a\\udcff' is not text"):
        SmoothSettings(labels=Path("a\udcff")).to_toml()
