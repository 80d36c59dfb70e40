"""The plan for a large DICOM folder is an estimate from a sample of its slices, close to the plan from all of them."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from handmade_dicom import save_all, slices
from typer.testing import CliRunner

from infill.cli.app import build_app
from infill.imaging.dicom import sampling
from infill.imaging.dicom.sampling import FEWEST, RUN, RUNS, sample_folder

pytestmark = pytest.mark.usefixtures("compiled")
pytest.importorskip("pydicom")

COUNT = 150


def scan(count: int = COUNT) -> np.ndarray:
    """An egg along z: values [z, y, x], 1000 inside."""
    z, y, x = np.ogrid[:count, :60, :50]
    radius = ((x - 25) / 20) ** 2 + ((y - 30) / 20) ** 2 + ((z - count / 2) / (0.4 * count)) ** 2
    grey = np.clip(1000 - 2000 * (np.sqrt(radius) - 1) * 10, -1000, 1000)
    return grey.astype(np.int16)


def folder(path: Path, *, step: float = 1.2, order: list[int] | None = None, count: int = COUNT) -> Path:
    places = [(0.0, 0.0, step * k) for k in range(count)]
    return save_all(slices(scan(count), places, pixel=(0.8, 0.8)), path, order)


def output(*words: object) -> str:
    done = CliRunner().invoke(build_app(), ["smooth", *map(str, words), "--threshold", "0", "--dry-run"])
    assert done.exit_code == 0, done.stderr
    return done.stdout


def plan(path: Path, *more: Any) -> dict[str, Any]:
    return json.loads(output(path, "--json", *more))  # type: ignore[no-any-return]


@pytest.mark.parametrize("step", [1.2, -1.2, 3.0])
def test_the_estimate_is_close_to_the_plan_from_all_slices(step: float, tmp_path: Path) -> None:
    """Also where slices are written downwards, and where thick ones are interpolated."""
    dicom = folder(tmp_path / "scan", step=step)
    estimate, exact = plan(dicom), plan(dicom, "--spacing", f"0.8,0.8,{abs(step)}")
    assert (estimate["input"]["sampled"], estimate["input"]["of"]) == (RUNS * RUN, COUNT)
    assert "sampled" not in exact["input"]
    assert estimate["ways"] == exact["ways"]
    assert estimate["grid"]["shape"] == exact["grid"]["shape"]
    assert estimate["grid"]["spacing"] == pytest.approx(exact["grid"]["spacing"])
    assert estimate["grid"]["origin"] == pytest.approx(exact["grid"]["origin"])
    assert estimate["solid"]["data"] == pytest.approx(exact["solid"]["data"], rel=0.03)
    assert estimate["triangles_before"] == pytest.approx(exact["triangles_before"], rel=0.05)


def test_few_slices_are_read_and_the_table_says_so(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    dicom, read = folder(tmp_path / "scan"), []
    read_image = sampling.read_image
    monkeypatch.setattr(sampling, "read_image", lambda path: read.append(path) or read_image(path))
    text = output(dicom)
    assert len(read) == RUNS * RUN
    assert f"estimate from {RUNS * RUN} of {COUNT} slices, as if the others were like them" in " ".join(text.split())
    assert "solid about" in " ".join(text.split())


def test_what_a_sample_does_not_stand_for_is_read_whole(tmp_path: Path) -> None:
    """Names in another order than the places, few slices, a region, and a sample with nothing solid in it."""
    shuffled = np.random.default_rng(0).permutation(COUNT).tolist()
    assert sample_folder(folder(tmp_path / "shuffled", order=shuffled)) is None
    assert "sampled" not in plan(tmp_path / "shuffled")["input"]
    assert sample_folder(folder(tmp_path / "few", count=FEWEST - 1)) is None
    dicom = folder(tmp_path / "scan")
    assert "sampled" not in plan(dicom, "--roi", "0,40,0,48,20,90")["input"]
    lonely = np.full((COUNT, 60, 50), -1000, dtype=np.int16)
    lonely[:4, 20:40, 20:40] = 1000  # between the runs
    save_all(slices(lonely, [(0, 0, 1.2 * k) for k in range(COUNT)]), tmp_path / "lonely")
    assert plan(tmp_path / "lonely")["solid"]["data"] > 0
