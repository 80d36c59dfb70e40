"""The site: every public name, every command, every page; no warning. Skipped where Sphinx is not installed."""

from __future__ import annotations

import re
import subprocess
import sys
import zlib
from pathlib import Path

import pytest

import infill
import patterns
from infill.cli.app import build_app

pytestmark = pytest.mark.longest
pytest.importorskip("sphinx", reason="Sphinx is not here: `make docs` installs it")
ROOT = Path(__file__).resolve().parents[1]
DOCS = ROOT / "docs"


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The site as `make docs` makes it: a warning is an error."""
    target = tmp_path_factory.mktemp("site")
    command = [sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-b", "html", DOCS, target]
    done = subprocess.run(command, capture_output=True, encoding="utf-8", cwd=ROOT)
    assert done.returncode == 0, done.stderr
    assert "WARNING" not in done.stderr
    return target


def described(inventory: Path) -> set[str]:
    """Return the names in an inventory of Sphinx: four lines of text, then the rest compressed."""
    content = inventory.read_bytes().split(b"\n", 4)[4]
    lines = zlib.decompress(content).decode().splitlines()
    return {name for name, kind, *_ in map(str.split, lines) if kind.startswith("py:")}


@pytest.mark.parametrize("package", [infill, patterns], ids=lambda package: package.__name__)
def test_every_public_name_is_described(package: object, site: Path) -> None:
    names = {f"{package.__name__}.{name}" for name in package.__all__}
    assert len(names) > 10
    assert names - described(site / "objects.inv") == set()


def test_nothing_else_is(site: Path) -> None:
    """Sphinx files a name under the module it lives in as well; that module is not said on the page."""
    public = {name for package in (infill, patterns) for name in package.__all__}
    for name in described(site / "objects.inv"):
        assert public & set(name.split(".")), f"{name} is not public"


def test_every_command_is_described(site: Path) -> None:
    page = (site / "commands.html").read_text(encoding="utf-8")
    for command in build_app().registered_commands:
        assert f"infill {command.name}" in page
    assert "--stamp" in page


def test_every_page_is_there_and_in_the_contents(site: Path) -> None:
    index = (site / "index.html").read_text(encoding="utf-8")
    pages = list(DOCS.glob("**/*.md"))
    assert len(pages) > 15
    for page in pages:
        address = page.relative_to(DOCS).with_suffix(".html").as_posix()
        assert (site / address).is_file()
        assert page.stem == "index" or f'href="{address}"' in index


def test_links_out_of_the_pages_lead_to_the_repository(site: Path) -> None:
    page = (site / "paper.html").read_text(encoding="utf-8")
    assert 'href="https://github.com/phasefill/phasefill/blob/main/examples/paper"' in page
    assert re.findall(r'href="\.\./[^"]*"', page) == []
    below = (site / "slicers" / "cura.html").read_text(encoding="utf-8")
    assert 'href="https://github.com/phasefill/phasefill/blob/main/examples/cura/InfillRefill.py"' in below
    assert 'href="program.html' in below


def test_formulas_and_pictures_are_shown(site: Path) -> None:
    page = (site / "design" / "mathematics.html").read_text(encoding="utf-8")
    assert page.count('class="math') >= (DOCS / "design" / "mathematics.md").read_text(encoding="utf-8").count(
        "```math"
    )
    for picture in re.findall(r'<img[^>]* src="([^"]+)"', page):
        assert picture.startswith("http") or (site / "design" / picture).is_file()
