"""Try the wheel where there is nothing else: `make wheel`.

A fresh environment gets the wheel and what it requires, and every command runs once, in an empty folder.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import venv
from email import message_from_bytes
from pathlib import Path
from zipfile import ZipFile

BALL = "import numpy as np; np.save('ball.npy', ((np.indices((24, 24, 24)) - 11.5) ** 2).sum(0) < 80)"


def described(wheel: Path) -> None:
    """Check what a package index would show: every picture and link stands by itself."""
    with ZipFile(wheel) as archive:
        name = next(name for name in archive.namelist() if name.endswith(".dist-info/METADATA"))
        text = str(message_from_bytes(archive.read(name)).get_payload())
    targets = [part.split(")")[0] for part in text.split("](")[1:]]
    relative = [target for target in targets if not target.startswith(("https://", "http://", "#"))]
    if relative or not any(target.endswith(".png") for target in targets):
        sys.exit(f"error: a package index cannot show {relative or 'any picture'}")


def main() -> None:
    """Try the one wheel in a folder, or the wheel that is named."""
    wheels = [wheel for given in map(Path, sys.argv[1:]) for wheel in ([given] if given.is_file() else given.glob("*"))]
    wheels = [wheel.resolve() for wheel in wheels if wheel.suffix == ".whl"]
    if len(wheels) != 1:
        sys.exit(f"error: one wheel is tried, {len(wheels)} were given: python tools/try_wheel.py dist")
    described(wheels[0])
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        place = Path(folder) / "venv"
        venv.create(place, with_pip=True)
        programs = place / ("Scripts" if os.name == "nt" else "bin")
        empty = Path(folder) / "empty"
        empty.mkdir()
        outside = {key: value for key, value in os.environ.items() if key not in ("PYTHONPATH", "VIRTUAL_ENV")}
        outside["PATH"] = os.pathsep.join([str(programs), outside.get("PATH", "")])

        def run(program: str, *words: str) -> None:
            """Run one of the programs of the environment, or end."""
            print("$", program, *words, flush=True)
            command = [str(programs / program), *words]
            done = subprocess.run(command, cwd=empty, env=outside, capture_output=True, encoding="utf-8", check=False)
            if done.returncode:
                sys.exit(f"{done.stdout}{done.stderr}error: {program} {' '.join(words)} ended with {done.returncode}")

        run("python", "-m", "pip", "install", "--quiet", "--disable-pip-version-check", str(wheels[0]))
        run("python", "-m", "pip", "check")
        run("python", "-c", BALL)
        run("infill", "--version")
        run("infill", "--help")
        run("phasefill", "list")
        run("infill", "make", "honeycomb", "--size", "20", "--height", "3", "-o", "block.stl", "--preview", "block.png")
        run("infill", "check", "block.stl")
        run("infill", "view", "block.stl", "-o", "block.html")
        run("infill", "smooth", "ball.npy", "-o", "ball.3mf", "--json")
        run("infill", "check", "ball.3mf")
        run("python", "-c", "from infill import make; assert make('zigzag', size=20, height=3).mesh.is_volume")
        made = sorted(path.name for path in empty.iterdir())
        if made != ["ball.3mf", "ball.npy", "block.html", "block.png", "block.stl"]:
            sys.exit(f"error: the commands left {made}")
    print(f"{wheels[0].name} works alone")


if __name__ == "__main__":
    main()
