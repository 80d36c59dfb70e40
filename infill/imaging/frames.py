"""One of the volumes that a file may hold: frames of a series in time, components, or layers of segments."""

from __future__ import annotations

from pathlib import Path

from infill.errors import FormatError, ParameterError


def chosen(path: Path, frame: int | None, frames: int, *, what: str) -> int:
    """Return which of the frames of a file to read, counted from 0; the only one needs no choice.

    Parameters
    ----------
    path : Path
    frame : int, optional
        The frame that was asked for.
    frames : int
        How many there are.
    what : str
        What the file has or holds, for the message, such as "has 4 axes, 5 x 6 x 7 x 2 cells".

    Raises
    ------
    FormatError
        If there are several and none was asked for.
    ParameterError
        If there is no such frame.

    >>> chosen(Path("a.nii"), None, 1, what="")
    0
    """
    if frame is None:
        if frames > 1:
            raise FormatError(f"{path} {what}; choose one of its {frames} frames: --frame 0 to --frame {frames - 1}")
        return 0
    if isinstance(frame, bool) or frame != int(frame) or not 0 <= frame < frames:
        held = "one frame, number 0" if frames == 1 else f"{frames} frames, 0 to {frames - 1}"
        raise ParameterError(f"frame is {frame!r} and {path} holds {held}; give one that is there")
    return int(frame)
