"""What ``--help`` says, in a maker's words: read from the screen, for every command and option."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

import numpy as np
import pytest
import typer
from test_command_line import COMMANDS, SMALL, plain, run
from typer.testing import CliRunner

from infill.cli.app import build_app

GREEK = (
    "alpha|beta|gamma|delta|epsilon|zeta|eta|theta|iota|kappa|lambda|mu|nu|xi|omicron|pi|rho|sigma|tau|upsilon|phi|chi|"
    "psi|omega"
)
MATHEMATICS = re.compile(
    rf"\b({GREEK}|euler\w*|fidelity|interface|equation|paper'?s?|standard deviation)\b|[\u0370-\u03ff]",
    re.IGNORECASE,
)
TYPES = {"FLOAT", "INTEGER", "INT", "TEXT", "STR", "PATH", "BOOL", "BOOLEAN", "LIST"}
DEFAULT = re.compile(r"\(default: [^()]+\)$")
WIDE = {"COLUMNS": "600"}


@cache
def panels(command: str) -> dict[str, list[str]]:
    """Return the rows of the help of a command, by panel, as they stand on a wide screen."""
    text = CliRunner().invoke(build_app(command), [command, "--help"], env=WIDE).stdout
    found: dict[str, list[str]] = {"": []}
    rows = found[""]
    for line in re.sub(r"\x1b\[[0-9;]*m", "", text).splitlines():
        if title := re.match(r"╭─ (.*?) ─+╮", line):
            rows = found.setdefault(title[1], [])
        elif line.startswith("╰"):
            rows = found[""]
        elif words := line.strip(" │"):
            rows.append(words)
    return found


def options(command: str) -> list[list[str]]:
    """Return names, metavar where there is one, and help of every option of a command."""
    rows = [row for title, some in panels(command).items() if title not in ("", "Arguments") for row in some]
    return [re.split(r"\s{2,}", row) for row in rows]


@cache
def flags_of(command: str) -> set[str]:
    """Return the options of a command that take no value, as the parser knows them."""
    found = typer.main.get_command(build_app(command)).commands[command]  # type: ignore[attr-defined]
    params = found.get_params(typer.Context(found))
    return {name for each in params if getattr(each, "is_flag", False) for name in each.opts}


@pytest.mark.slow
@pytest.mark.parametrize("command", COMMANDS)
def test_mathematics_stand_in_advanced_alone(command: str) -> None:
    for title, rows in panels(command).items():
        found = MATHEMATICS.findall(" ".join(rows))
        assert not found or title == "Advanced", (title, found)


def test_mathematics_are_recognised() -> None:
    assert {"Files", "Block", "Run", "Advanced"} <= set(panels("make"))
    for command in ("make", "smooth"):
        assert MATHEMATICS.search(" ".join(panels(command)["Advanced"]))
        assert list(panels(command))[-1] == "Advanced"
    for text in ("at φ = 0.9", "Alpha", "the Euler number", "the paper's surface"):
        assert MATHEMATICS.search(text)
    for text in ("alphabet", "muted", "as fine as paperback"):
        assert not MATHEMATICS.search(text)


@pytest.mark.parametrize("command", COMMANDS)
def test_every_option_has_a_help_text_and_a_word_for_its_value(command: str) -> None:
    rows = options(command)
    assert len(rows) >= 2
    for names, *rest in rows:
        rest = [word for word in rest if not re.match(r"--?\w", word)]  # short names, and --no-frame
        if names in flags_of(command):
            assert len(rest) == 1, rest
        else:
            metavar, _ = rest
            assert metavar.upper().strip("<>") not in TYPES
            assert not re.search(r"[<>]", metavar)
        assert len(rest[-1]) > 5
        assert rest[-1].endswith((".", ")"))


@pytest.mark.parametrize("command", COMMANDS)
def test_defaults_are_told_in_one_way(command: str) -> None:
    for row in options(command):
        text = row[-1]
        assert "[default" not in text
        assert ("default:" in text) == bool(DEFAULT.search(text)), text


@pytest.mark.longest
def test_summaries_keep_mathematics_for_verbose(tmp_path: Path) -> None:
    words = ["make", "honeycomb", *SMALL, "--force", "-o", tmp_path / "a.stl"]
    assert not MATHEMATICS.search(run(*words).stderr)
    told = plain(run(*words, "-v").stderr)
    assert re.search(r"Euler number -?\d+ ", told)
    assert "fidelity 0.01" in told
    np.save(tmp_path / "a.npy", np.pad(np.ones((6, 6, 6), np.uint8), 3))
    words = ["smooth", tmp_path / "a.npy", "--smooth", "plain", "--force", "-o", tmp_path / "b.stl"]
    done = run(*words)
    assert done.exit_code == 0, done.output
    assert not MATHEMATICS.search(done.stderr)
    told = plain(run(*words, "-v").stderr)
    assert all(word in told for word in ("Euler number 2 -> 2", "fidelity 0.01", "level "))


@pytest.mark.parametrize("command", COMMANDS)
def test_arguments_show_their_name_alone(command: str) -> None:
    for row in panels(command).get("Arguments", []):
        assert not re.search(r"<\w+>", row)
