"""What several test files share."""

from __future__ import annotations

import logging
import os
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, settings

from infill import smooth_volume

settings.register_profile(
    "suite", deadline=None, max_examples=25, derandomize=True, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("suite")


@pytest.fixture(scope="session")
def data() -> Path:
    """The folder of real meshes and scans; tests that need it skip where it is absent."""
    default = Path(__file__).resolve().parents[2] / "shared" / "data"
    folder = Path(os.environ.get("INFILL_DATA", default))
    if not folder.is_dir():
        pytest.skip(f"no test data at {folder}; set INFILL_DATA to the folder that holds it")
    return folder


@pytest.fixture
def rng() -> np.random.Generator:
    return np.random.default_rng(20201)


@pytest.fixture(scope="session")
def compiled() -> None:
    """Compile what smoothing takes, so that nothing is said of it later, by other processes neither."""
    ball = np.sum((np.indices((20, 20, 20)) - 9.5) ** 2, axis=0) < 40
    for refine in (False, True):
        smooth_volume(ball, refine=refine)


@pytest.fixture
def silent_compiler(monkeypatch: pytest.MonkeyPatch) -> None:
    """Say nothing of what is compiled in this process: which test is first to need it depends on their order."""
    monkeypatch.setattr(logging.getLogger("infill"), "disabled", True)
