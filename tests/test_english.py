"""The check of English finds what it is made for, in pages and in modules, and nothing in the repository."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
CHECK = ROOT / "tools" / "check_english.py"


def run_check(*files: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, CHECK, *files], capture_output=True, encoding="utf-8")


@pytest.mark.longest
def test_the_repository_has_no_such_turn() -> None:
    done = run_check()
    assert done.returncode == 0, done.stderr


@pytest.mark.slow
@pytest.mark.parametrize(
    ("sentence", "found"),
    [
        ("A part is hollow but for its infill.", "'but for'"),
        ("A pattern of ours fills it.", "'ours'"),
        ("The section is drawn\nanew in every layer.", "'anew'"),
        ("Its scene is no list.", "'is no'"),
        ("The angle than\nwhich few are sharper.", "'than which'"),
        ("Every so-many-th layer is measured.", "'Every so-many'"),
        ("The density says what was asked for.", "'what was asked for'"),
    ],
)
def test_a_planted_sentence_is_found(sentence: str, found: str, tmp_path: Path) -> None:
    page, module = tmp_path / "page.md", tmp_path / "module.py"
    page.write_text(f"# A page\n\n{sentence}\n", encoding="utf-8")
    module.write_text(f'MESSAGE = f"""{sentence} {{1}}"""\n', encoding="utf-8")
    for file in (page, module):
        done = run_check(file)
        assert done.returncode == 1
        assert f"{found}; write" in done.stderr


@pytest.mark.slow
@pytest.mark.parametrize(
    ("line", "found"),
    [
        ('f"{area:.3g} mm²"', ".3g"),
        ('f"{x:e}"', "e"),
        ('"up to %.3g mm"', "%.3g"),
        ('"at {:g}".format(1)', "{:g}"),
        ('f"{count} hole(s)"', "e(s)"),
        ('"2 branch(es)"', "h(es)"),
    ],
)
def test_a_number_or_count_for_machines_is_found(line: str, found: str, tmp_path: Path) -> None:
    """1.94e+03 and hole(s) are for no reader."""
    module = tmp_path / "module.py"
    module.write_text(f"area = count = x = 1\ntext = {line}\n", encoding="utf-8")
    done = run_check(module)
    assert done.returncode == 1
    assert f":2: '{found}'; write: infill.plain_numbers." in done.stderr


def test_plain_sentences_and_code_pass(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text("There is no pattern here.\n\n```\nbut for\n```\n\nIt is no longer than 2 mm.\n", encoding="utf-8")
    assert run_check(page).returncode == 0
