"""Fetch the real meshes and scans that tests and figures take: `make data`.

They are named in tools/data.toml with address, hash and licence, and come to $INFILL_DATA, else to data/ here. What is
there with its right hash is left alone. A file appears whole, with its right hash, or not at all.
"""

from __future__ import annotations

import argparse
import hashlib
import logging
import os
import sys
import tomllib
from dataclasses import dataclass
from pathlib import Path

import pooch
import requests

ROOT = Path(__file__).resolve().parents[1]
TABLE = Path(__file__).with_name("data.toml")


@dataclass(frozen=True, kw_only=True)
class File:
    """One public file: where it goes, where it comes from, and what it is."""

    path: str
    url: str
    sha256: str
    bytes: int
    licence: str

    def is_in(self, folder: Path) -> bool:
        """Return whether the file is there already, and is the right one."""
        path = folder / self.path
        return path.is_file() and hashlib.sha256(path.read_bytes()).hexdigest() == self.sha256


class FetchError(Exception):
    """A file could not be fetched; the message is one line."""


def fetch(file: File, folder: Path) -> None:
    """Fetch one file.

    Raises
    ------
    FetchError
        If the address does not answer with this file, or the file cannot be written.
    """
    target = folder / file.path
    try:
        target.unlink(missing_ok=True)  # what is there has another hash
        pooch.retrieve(file.url, f"sha256:{file.sha256}", fname=target.name, path=target.parent)
    except ValueError:  # pooch's word for another hash
        raise FetchError(f"{file.url} is another file than it was (sha256 differs); {file.path} is left out") from None
    except requests.HTTPError as error:
        raise FetchError(f"{file.url} answers {error.response.status_code}; {file.path} is left out") from None
    except requests.RequestException as error:
        raise FetchError(f"{file.url} cannot be reached ({type(error).__name__}); is there a network?") from None
    except OSError as error:
        raise FetchError(f"{target} cannot be written: {error.strerror or error}") from None


def main(arguments: list[str] | None = None) -> int:
    """Fetch what is missing; progress on stderr, the folder on stdout. Return 1 if a file could not be had."""
    parser = argparse.ArgumentParser(description="Fetch the real meshes and scans that tests and figures take.")
    parser.add_argument("folder", type=Path, nargs="?", default=Path(os.environ.get("INFILL_DATA", ROOT / "data")))
    parser.add_argument("--table", type=Path, default=TABLE, help="names, addresses and hashes (default: %(default)s)")
    given = parser.parse_args(arguments)
    pooch.get_logger().setLevel(logging.ERROR)  # one line a file is said here

    table = tomllib.loads(given.table.read_text(encoding="utf-8"))
    files = [File(**entry) for entry in table["public"]]
    missing = [file for file in files if not file.is_in(given.folder)]
    say(f"{len(files) - len(missing)} of {len(files)} files are in {given.folder} already")
    failed = 0
    for number, file in enumerate(missing, start=1):
        say(f"[{number}/{len(missing)}] {file.path}, {file.bytes / 1e6:.1f} MB, {file.licence}")
        try:
            fetch(file, given.folder)
        except FetchError as error:
            failed += 1
            say(f"error: {error}")
    others = [entry for entry in table["other"] if not (given.folder / entry["path"]).exists()]
    if others:
        say(f"{len(others)} more files are served by no address: {given.table.name} says how to come by them")
    print(given.folder)
    return 1 if failed else 0


def say(line: str) -> None:
    """Tell the user."""
    print(line, file=sys.stderr, flush=True)


if __name__ == "__main__":
    sys.exit(main())
