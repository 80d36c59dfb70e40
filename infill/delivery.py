"""Hand a result over: all its files, or none."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from infill.export import writer
from infill.output import told, whole_files
from infill.pipeline import Result
from infill.settings import MakeSettings


def deliver(
    result: Result | None,
    *,
    meshes: Sequence[Path] = (),
    picture: Path | None = None,
    settings: MakeSettings | None = None,
    settings_file: Path | None = None,
    ascii: bool = False,  # noqa: A002 - the word of the command line
) -> list[Path]:
    """Write meshes, picture and settings of one run, and return the paths written.

    Raises
    ------
    OutputError
        If one of the files cannot be written; then none is.
    """
    paths = [*meshes, *([picture] if picture else []), *([settings_file] if settings_file else [])]
    if not paths:
        return paths
    with whole_files(paths) as files:
        for path, file in zip(paths, files, strict=True):
            with told(path):
                if path is settings_file and settings is not None:
                    file.write(settings.to_toml().encode())
                elif path is picture and result is not None:
                    from infill.preview import preview

                    preview(result).save(file, format="PNG")
                elif result is not None:
                    writer(path, ascii=ascii)(result.surface, file)
    return paths
