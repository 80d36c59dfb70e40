"""What a script gives: rows of the paper's value beside ours and a peer's, a sentence, a picture, numbers."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, field
from pathlib import Path

from examples.paper.models import MissingModels
from infill import InfillError
from infill.files.whole_files import atomic_file

PICTURE_ONLY = "picture only"
NOT_GIVEN = "–"
LEFT_OUT, STOPPED = 3, 130  # exit statuses: models are missing, Ctrl-C


@dataclass(frozen=True, kw_only=True)
class Row:
    """One line of a table.

    Parameters
    ----------
    what : str
        The quantity, with its unit.
    ours : str
        As measured.
    paper, peer : str
        As printed; of another method, with its name.
    """

    what: str
    ours: str
    paper: str = NOT_GIVEN
    peer: str = NOT_GIVEN


@dataclass(frozen=True, kw_only=True)
class Entry:
    """A figure or a table of the paper, reproduced.

    Parameters
    ----------
    name : str
        Of its files: name.png and name.json.
    title : str
        What it shows.
    setting : str
        Grid and parameters, and how what the paper leaves open was read.
    rows : tuple of Row
    sentence : str
        What came out, told honestly.
    numbers : mapping of str to float
        What the rows say, unrounded; tests hold one of them.
    """

    name: str
    title: str
    setting: str
    rows: tuple[Row, ...]
    sentence: str
    numbers: Mapping[str, float] = field(default_factory=dict)

    def save(self, folder: Path) -> Entry:
        """Write name.json."""
        with atomic_file(folder / f"{self.name}.json") as file:
            file.write((json.dumps(asdict(self), indent=1) + "\n").encode())
        return self


def load(folder: Path, name: str) -> Entry:
    """Return what `Entry.save` wrote."""
    told = json.loads((folder / f"{name}.json").read_text(encoding="utf-8"))
    return Entry(**{**told, "rows": tuple(Row(**row) for row in told["rows"])})


def run(main: Callable[..., Entry]) -> None:
    """Run a script from the command line."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("folder", type=Path, nargs="?", default=Path("paper"), help="where to write (default: paper)")
    parser.add_argument("--small", action="store_true", help="coarser grids, as the tests take them")
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    try:
        entry = main(options.folder, small=options.small)
    except MissingModels as error:
        print(f"error: {error}", file=sys.stderr)
        sys.exit(LEFT_OUT)
    except InfillError as error:
        sys.exit(f"error: {error}")
    except KeyboardInterrupt:
        sys.exit(STOPPED)
    print(entry.title)
    for row in entry.rows:
        print(f"  {row.what}: {row.ours}   (paper: {row.paper}; peer: {row.peer})")
    print(entry.sentence)
