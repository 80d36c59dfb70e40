"""The script for Cura, which runs ``infill refill`` from Cura's own Python: its place and its text.

The script is `examples/cura/InfillRefill.py`; a wheel has a copy of it. The copy that goes to Cura has the path of the
program as the default of its setting, so that nothing is left to be typed.
"""

from __future__ import annotations

from pathlib import Path

from infill.errors import OutputError
from infill.files.whole_files import wrap_os_errors
from infill.slicer_profiles.desktops import ConfigFolder
from infill.slicer_profiles.profile_files import BACKUP, FileChange

NAME = "InfillRefill"
PLACES = (
    Path(__file__).parent / "cura" / f"{NAME}.py",  # in a wheel
    Path(__file__).parents[2] / "examples" / "cura" / f"{NAME}.py",  # in the sources
)
_DEFAULT = '"default_value": "infill",'
_OURS = (b"class InfillRefill(Script)", b"phasefill")


def write_script(program: str) -> bytes:
    """Write the script for a program.

    Parameters
    ----------
    program : str
        Its absolute path.

    Raises
    ------
    OutputError
        If this installation lacks the script.
    """
    source = next((path for path in PLACES if path.is_file()), None)
    if source is None:
        raise OutputError("this installation lacks Cura's script; install phasefill again")
    text = source.read_text(encoding="utf-8")
    return text.replace(_DEFAULT, f'"default_value": {program!a},', 1).encode()


def script_path(folder: ConfigFolder) -> Path:
    """Return the place of the script in a data folder of Cura."""
    return folder.path / "scripts" / f"{NAME}.py"


def read_script(folder: ConfigFolder) -> bytes | None:
    """Read the file at the place of the script; None without one."""
    path = script_path(folder)
    with wrap_os_errors(path):
        return path.read_bytes() if path.is_file() else None


def plan_script(folder: ConfigFolder, program: str) -> list[FileChange]:
    """Plan the changes that put the script into a data folder; none if it is there.

    Another file of its name is kept as a backup.
    """
    path, script, current = script_path(folder), write_script(program), read_script(folder)
    if current == script:
        return []
    backup = [] if current is None or is_own_script(current) else [_back_up(path, current)]
    return [*backup, FileChange(path=path, data=script)]


def plan_script_removal(folder: ConfigFolder) -> list[FileChange]:
    """Plan the changes that remove the script from a data folder, or put back the file that it replaced."""
    path, current = script_path(folder), read_script(folder)
    if current is None or not is_own_script(current):
        return []
    backup = path.with_name(path.name + BACKUP)
    if not backup.is_file():
        return [FileChange(path=path, data=None)]
    with wrap_os_errors(backup):
        return [FileChange(path=path, data=backup.read_bytes()), FileChange(path=backup, data=None)]


def is_own_script(data: bytes) -> bool:
    """Tell whether a file is this script, of any version."""
    return all(words in data for words in _OURS)


def _back_up(path: Path, data: bytes) -> FileChange:
    """Plan the backup of a file."""
    return FileChange(path=path.with_name(path.name + BACKUP), data=data, like=path)
