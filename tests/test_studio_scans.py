"""What the studio says and makes of a scan over HTTP: where something is lost, its components, its labels."""

from __future__ import annotations

import io
import shlex
import subprocess
import sys
import zipfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("httpx")
pytest.importorskip("starlette")
pytest.importorskip("uvicorn")

from studio_client import Page, run_studio

pytestmark = pytest.mark.longest


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Page]:
    with run_studio(tmp_path_factory.mktemp("temporary")) as studio, studio.page() as opened:
        yield opened


@pytest.fixture
def spike(page: Page, tmp_path: Path) -> str:
    """Return a plate with a spike that is two voxels thick, which plain smoothing loses."""
    solid = np.zeros((30, 30, 24), np.int16)
    solid[4:26, 4:26, 4:12] = solid[13:15, 13:15, 12:21] = 100
    np.save(tmp_path / "spike.npy", solid)
    return page.upload(tmp_path / "spike.npy").facts["file"]


def test_a_refusal_says_that_the_result_can_be_had_anyway(page: Page, spike: str) -> None:
    options = {"threshold": 50, "smooth": "plain"}
    refused = page.ask("smooth", spike, options=options).error
    assert refused is not None
    assert refused["refused"]
    anyway = page.ask("smooth", spike, options=options | {"allow_broken": True}).facts
    assert "--allow-broken" in anyway["command"]
    lost = [place for place in anyway["places"] if place["change"] == "lost"]
    assert np.abs(np.array(lost[0]["at"]) - (14, 14, 20.5)).max() < 1.5


def test_a_ct_has_thresholds_by_name(page: Page, tmp_path: Path) -> None:
    values = np.full((16, 16, 16), -1024, np.int16)
    values[3:13, 3:13, 3:13] = 40
    values[6:10, 6:10, 6:10] = 1200
    np.save(tmp_path / "ct.npy", values)
    np.save(tmp_path / "shifted.npy", values + 1024)
    scan = page.upload(tmp_path / "ct.npy").facts["scan"]
    assert scan["thresholds"] == [
        {"name": "Bone", "value": 226},
        {"name": "Skin", "value": -300},
        {"name": "Otsu", "value": scan["otsu"]},
    ]
    assert page.upload(tmp_path / "shifted.npy").facts["scan"]["thresholds"] == []


def test_a_mistake_is_no_refusal(page: Page, spike: str) -> None:
    error = page.ask("smooth", spike, options={"threshold": 1e9}).error
    assert error is not None
    assert "refused" not in error


def balls(values: tuple[int, ...]) -> np.ndarray:
    """Return three balls of different sizes, each of its own value."""
    cells = np.zeros((40, 16, 16), np.uint8)
    for value, middle, radius in zip(values, (8, 21, 32), (6, 5, 4), strict=True):
        away = ((np.indices(cells.shape) - np.reshape((middle, 8, 8), (3, 1, 1, 1))) ** 2).sum(axis=0)
        cells[away < radius**2] = value
    return cells


def by_command(command: str, folder: Path) -> bytes:
    """Run a command that the studio gave; return the file that it writes."""
    words = shlex.split(command)
    subprocess.run([sys.executable, "-m", *words, "--quiet"], cwd=folder, check=True)
    return (folder / words[-1]).read_bytes()


def test_pieces_are_listed_and_dropped_as_the_command_does(page: Page, tmp_path: Path) -> None:
    np.save(tmp_path / "balls.npy", balls((100, 100, 100)).astype(np.int16))
    file = page.upload(tmp_path / "balls.npy").facts["file"]
    options = {"threshold": 50, "smooth": "plain"}
    sizes = [int((balls((1, 2, 3)) == number).sum()) for number in (1, 2, 3)]
    for quality in ("coarse", "exact"):
        kept = page.ask("smooth", file, options=options | {"keep_components": "1,3"}, quality=quality).facts
        assert kept["pieces"]["count"] == 3
        assert kept["pieces"]["volumes"] == sizes
        assert kept["pieces"]["places"][1] == [21.5, 8.5, 8.5]
        counted = {row["name"]: row["about"] for row in kept["numbers"]}
        assert counted["volume"] is (quality == "coarse")
        assert ("components" in counted) is (quality == "exact"), "larger voxels lose and join some"
    assert kept["report"]["components"] == 2
    assert kept["report"]["volume"] == pytest.approx(sizes[0] + sizes[2], rel=1e-3)
    assert "--keep-components 1,3" in kept["command"]
    assert page.download(kept["result"], format="stl").content == by_command(kept["command"], tmp_path)


def test_labels_that_are_not_chosen_are_in_no_file(page: Page, tmp_path: Path) -> None:
    np.save(tmp_path / "labels.npy", balls((1, 2, 3)))
    file = page.upload(tmp_path / "labels.npy").facts["file"]
    answer = page.ask("labels", file, options={"label": [1, 3], "steps": 5}).facts
    assert [label["number"] for label in answer["report"]["labels"]] == [1, 3]
    assert "--label 1 --label 3" in answer["command"]
    archive = zipfile.ZipFile(io.BytesIO(page.download(answer["result"], format="zip").content))
    assert archive.namelist() == ["label_1.stl", "label_3.stl"]
    command = answer["command"].replace(shlex.split(answer["command"])[-1], "'{label}.stl'")
    subprocess.run([sys.executable, "-m", *shlex.split(command), "--quiet"], cwd=tmp_path, check=True)
    for name in archive.namelist():
        assert archive.read(name) == (tmp_path / name).read_bytes()
    assert not (tmp_path / "label_2.stl").exists()
