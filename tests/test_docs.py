"""What the documents point to is there, and they name every command."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from infill.cli.app import build_app

ROOT = Path(__file__).resolve().parents[1]
PAGES = sorted([*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md")])


def links(text: str) -> list[str]:
    """Return what a page links to, within the repository.

    >>> links("[a](b.md#c) ![d](e.png) [f](https://g)")
    ['b.md#c', 'e.png']
    """
    return [link for link in re.findall(r"\]\(([^)\s]+)\)", text) if not link.startswith("http")]


def anchors(text: str) -> set[str]:
    """Return the anchors of a page, as a forge makes them of its headings.

    >>> anchors("# When thin walls die")
    {'when-thin-walls-die'}
    """
    headings = re.findall(r"^#+ (.*)$", text, re.M)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_lead_somewhere(page: Path) -> None:
    for link in links(page.read_text(encoding="utf-8")):
        name, _, anchor = link.partition("#")
        target = (page.parent / name).resolve() if name else page
        assert target.exists(), f"{page.name} links to {link}"
        assert target.is_relative_to(ROOT)
        if anchor:
            assert anchor in anchors(target.read_text(encoding="utf-8")), f"{page.name} links to {link}"


def test_the_readme_names_every_command() -> None:
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    names = [command.name or command.callback.__name__ for command in build_app().registered_commands]
    assert len(names) >= 4
    for name in names:
        assert f"infill {name}" in text


def test_every_picture_is_shown() -> None:
    shown = {(page.parent / link).resolve() for page in PAGES for link in links(page.read_text(encoding="utf-8"))}
    pictures = list(ROOT.glob("docs/**/*.png"))
    assert len(pictures) > 10
    for picture in pictures:
        assert picture in shown, f"no page shows {picture.name}"


def test_every_pattern_of_refill_is_on_its_page() -> None:
    from infill.paths.families.catalogue import FAMILIES

    text = (ROOT / "docs" / "refill.md").read_text(encoding="utf-8")
    for name in FAMILIES:
        assert f"`{name}`" in text


@pytest.mark.parametrize("slicer", ["prusaslicer", "superslicer", "orcaslicer", "bambu-studio", "cura"])
def test_every_slicer_has_a_page_for_three_systems(slicer: str) -> None:
    """And it says what was tried, and what was not."""
    text = (ROOT / "docs" / "slicers" / f"{slicer}.md").read_text(encoding="utf-8")
    for system in ("| Linux |", "| macOS |", "| Windows |"):
        assert system in text
    assert "\n## What was tried\n" in text
    assert f"slicers/{slicer}.md" in (ROOT / "docs" / "refill.md").read_text(encoding="utf-8")
