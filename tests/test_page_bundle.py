"""The bundles that the package brings are what their sources make, and say which sources these are."""

from __future__ import annotations

import hashlib
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
FOLDERS = sorted(path.parent for path in (ROOT / "infill").glob("*/bundle/sources.sha256"))
SHARED = ("bundle.mjs", "package.json", "package-lock.json")
ADVICE = "run `make page` and commit what changed"


def listed(folder: Path) -> dict[str, str]:
    """Return the hash of every file that a bundle lists, by its path from the root."""
    lines = (folder / "sources.sha256").read_text(encoding="utf-8").splitlines()
    return {path: digest for digest, path in (line.split("  ") for line in lines)}


def hashes(paths: set[str]) -> dict[str, str]:
    return {path: hashlib.sha256((ROOT / path).read_bytes()).hexdigest() for path in paths}


def test_there_are_bundles() -> None:
    assert ROOT / "infill" / "viewer" / "bundle" in FOLDERS


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda folder: folder.parent.name)
def test_a_bundle_is_not_older_than_its_sources(folder: Path) -> None:
    known = listed(folder)
    assert hashes(set(known)) == known, ADVICE


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda folder: folder.parent.name)
def test_a_bundle_lists_all_of_its_sources_and_all_of_itself(folder: Path) -> None:
    folders = {"/".join(path.split("/")[:3]) for path in listed(folder) if path.startswith("page/src/")}
    sources = {path for name in folders for path in (ROOT / name).rglob("*") if path.is_file()}
    made = {path for path in folder.iterdir() if path.name != "sources.sha256"}
    expected = {path.relative_to(ROOT).as_posix() for path in sources | made} | {f"page/{name}" for name in SHARED}
    assert set(listed(folder)) == expected, ADVICE


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda folder: folder.parent.name)
def test_a_bundle_has_the_licences_of_what_is_in_it(folder: Path) -> None:
    text = (folder / "LICENSES.txt").read_text(encoding="utf-8")
    assert "three 0." in text
    assert "Permission is hereby granted, free of charge" in text


def test_a_changed_source_would_be_noticed(tmp_path: Path) -> None:
    known = listed(FOLDERS[0])
    assert hashes(set(known)) != known | {"page/bundle.mjs": hashlib.sha256(b"another").hexdigest()}


def test_no_private_registry_is_named() -> None:
    lock = (ROOT / "page" / "package-lock.json").read_text(encoding="utf-8")
    assert '"resolved"' not in lock


@pytest.mark.long
def test_the_bundles_are_what_the_sources_make(tmp_path: Path) -> None:
    npm = shutil.which("npm")
    if npm is None:
        pytest.skip("no npm here; the hashes were compared")
    page = tmp_path / "page"
    shutil.copytree(ROOT / "page", page, ignore=shutil.ignore_patterns("node_modules"))
    installed = ROOT / "page" / "node_modules"
    if installed.is_dir():
        (page / "node_modules").symlink_to(installed)
    elif subprocess.run([npm, "ci", "--silent"], cwd=page, check=False, timeout=300).returncode:
        pytest.skip("npm ci failed; the hashes were compared")
    subprocess.run([npm, "run", "--silent", "bundle"], cwd=page, check=True, timeout=120)
    for folder in FOLDERS:
        for path in folder.iterdir():
            again = tmp_path / path.relative_to(ROOT)
            assert again.read_bytes() == path.read_bytes(), f"{path.relative_to(ROOT)}: {ADVICE}"
