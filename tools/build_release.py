"""Build what a release consists of twice, and compare: `python tools/build_release.py dist`.

The second build is of a copy of the working tree that lies elsewhere, is newer, and may be read by its owner alone. If
a file differs, whoever builds the release again gets other bytes than those that were published: that is an error.
"""

from __future__ import annotations

import hashlib
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def tracked_files() -> list[str]:
    """Return the files of the working tree that git tracks."""
    command = ["git", "ls-files", "-z"]
    listed = subprocess.run(command, cwd=ROOT, capture_output=True, check=True)
    return [name for name in listed.stdout.decode().split("\0") if name and (ROOT / name).is_file()]


def build(source: Path, folder: Path) -> dict[str, str]:
    """Build the wheel and the source archive of a tree, and return their hashes by name."""
    shutil.rmtree(folder, ignore_errors=True)
    subprocess.run([sys.executable, "-m", "build", "--no-isolation", "--outdir", str(folder), str(source)], check=True)
    return {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in sorted(folder.iterdir())}


def main() -> None:
    """Build into the folder that is named."""
    if len(sys.argv) != 2:
        sys.exit("error: a folder is needed: python tools/build_release.py dist")
    first = build(ROOT, Path(sys.argv[1]))
    with tempfile.TemporaryDirectory() as scratch:
        copy = Path(scratch) / "copy"
        for name in tracked_files():
            (copy / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, copy / name)
            (copy / name).chmod((copy / name).stat().st_mode & 0o700)
        second = build(copy, Path(scratch) / "dist")
    differing = [name for name in first if first[name] != second.get(name)]
    if differing or first.keys() != second.keys():
        sys.exit(f"error: built twice, {', '.join(differing) or 'the files'} differ")
    for name, digest in first.items():
        print(f"{digest}  {name}")


if __name__ == "__main__":
    main()
