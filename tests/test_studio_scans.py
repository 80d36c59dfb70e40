"""What the studio says of a scan over HTTP: where something is lost, its components, its labels."""

from __future__ import annotations

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


def test_a_mistake_is_no_refusal(page: Page, spike: str) -> None:
    error = page.ask("smooth", spike, options={"threshold": 1e9}).error
    assert error is not None
    assert "refused" not in error
