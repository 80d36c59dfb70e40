"""What several test files share."""

from __future__ import annotations

import locale
import logging
import os
import tomllib
from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, settings
from hypothesis.internal.conjecture import providers

from infill import smooth_volume
from infill.lattices import sizing
from infill.samples.catalogue import find_sample, write_sample
from tests.cpu_times import is_first_case

settings.register_profile(
    "suite", deadline=None, max_examples=25, derandomize=True, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("suite")
# Newer versions also draw numbers that stand in the modules loaded so far: other examples, then, for every choice of
# tests and every order of them.
LOOKED_FOR, NONE_YET = "_get_local_constants", "_local_constants"
if hasattr(providers, LOOKED_FOR):
    setattr(providers, LOOKED_FOR, lambda: getattr(providers, NONE_YET))


ROOT = Path(__file__).resolve().parents[1]
HOMES = (ROOT / "data", ROOT.parent / "shared" / "data")
ADVICE = "run `make data`, or set INFILL_DATA"


def pytest_configure() -> None:
    """Find the data once, for the tests and for what they run."""
    if "INFILL_DATA" not in os.environ:
        found = next((home for home in HOMES if home.is_dir()), None)
        if found:
            os.environ["INFILL_DATA"] = str(found)


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark what `make quick` and `make test` leave out; tools/mark_slow_tests.py sets the marks in the code."""
    for item in items:
        longest = item.get_closest_marker("longest")
        if longest or item.get_closest_marker("long"):
            item.add_marker("slow")
            if longest or not is_first_case(item):
                item.add_marker("left_out")


def known_data() -> set[str]:
    """Return the names of the real files, with the folders they lie in."""
    table = tomllib.loads((ROOT / "tools" / "data.toml").read_text(encoding="utf-8"))
    files = {Path(entry["path"]) for entry in (*table["public"], *table["other"])}
    return {path.as_posix() for file in files for path in (file, *file.parents)}


class Data(type(Path())):  # type: ignore[misc]
    """A folder of which some files may not have been fetched: the test that asks for one is skipped."""

    def __truediv__(self, name: str | os.PathLike[str]) -> Path:
        path = super().__truediv__(name)
        inside = path.relative_to(os.environ["INFILL_DATA"]).as_posix()
        if not path.exists() and inside in known_data():
            pytest.skip(f"no {path}; {ADVICE}")
        return path if path.is_dir() else Path(path)


@pytest.fixture(scope="session")
def data() -> Path:
    """The folder of real meshes and scans; tests that need what it lacks skip."""
    folder = Path(os.environ.get("INFILL_DATA", HOMES[0]))
    if not folder.is_dir():
        pytest.skip(f"no test data at {folder}; {ADVICE}")
    return Data(folder)


def real_or_sample(name: str, sample: str, folder: Path) -> Path:
    """Return a real file if it was fetched, else the sample that stands in for it."""
    path = Path(os.environ.get("INFILL_DATA", HOMES[0])) / name
    return path if path.is_file() else write_sample(sample, folder / find_sample(sample).file)


@pytest.fixture(scope="session")
def real_mesh(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A femur as STL, closed, in mm; a bracket where that was not fetched."""
    return real_or_sample("medical/femur.stl", "part", tmp_path_factory.mktemp("mesh"))


@pytest.fixture(scope="session")
def real_print(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A print of PrusaSlicer's; one made by code where that was not fetched."""
    return real_or_sample("prints/p29_objects_m486.gcode", "print", tmp_path_factory.mktemp("print"))


@pytest.fixture(autouse=True)
def same_locale() -> Iterator[None]:
    """Restore the locale: what writes a test's DICOM file changes it, and the next test would decode as ASCII."""
    before = locale.setlocale(locale.LC_ALL)
    yield
    locale.setlocale(locale.LC_ALL, before)


@pytest.fixture
def rng() -> np.random.Generator:
    return np.random.default_rng(20201)


@pytest.fixture(scope="session")
def compiled() -> None:
    """Compile what smoothing takes, so that nothing is said of it later, by other processes neither."""
    ball = np.sum((np.indices((20, 20, 20)) - 9.5) ** 2, axis=0) < 40
    for refine in (False, True):
        smooth_volume(ball, refine=refine, tolerance=None)


@pytest.fixture(scope="module")
def coarse_grids() -> Iterator[None]:
    """Let grids that `fill` chooses for small parts have 150 thousand cells at least, not a million.

    Only for speed: laws hold on grids of any size, and tests/test_fill.py fills real parts on those of users.
    """
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sizing, "FEWEST", 1.5e5)
        patch.setattr(sizing, "FEWEST_BARE", 8e4)
        yield


@pytest.fixture
def silent_compiler(monkeypatch: pytest.MonkeyPatch) -> None:
    """Say nothing of what is compiled in this process: which test is first to need it depends on their order."""
    monkeypatch.setattr(logging.getLogger("infill"), "disabled", True)


@pytest.fixture
def log_heard(silent_compiler: None, monkeypatch: pytest.MonkeyPatch) -> None:
    """Say again what `silent_compiler` hides: for tests of warnings, which do not mind other lines."""
    monkeypatch.setattr(logging.getLogger("infill"), "disabled", False)


@pytest.fixture(scope="session")
def prints_of_all_kinds(tmp_path_factory: pytest.TempPathFactory) -> Mapping[str, Path]:
    """Sliced prints by name, as tests/gcode_corpus.py describes them; each is made when it is first asked for."""
    from tests.gcode_corpus import corpus  # which needs the slicers' definitions and more, that few tests do

    return corpus(tmp_path_factory.mktemp("prints"))
