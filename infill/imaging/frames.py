"""Choice of one of the volumes in a file: frames of a time series, components, or layers of segments."""

from __future__ import annotations

from pathlib import Path

from infill.errors import FormatError, ParameterError


def choose_frame(path: Path, frame: int | None, frames: int, *, what: str) -> int:
    """Check the requested frame index, counted from 0, and return it; a single frame needs no choice.

    Parameters
    ----------
    path : Path
    frame : int, optional
        The requested frame.
    frames : int
        Number of frames.
    what : str
        Content of the file, for the message, such as "has 4 axes, 5 x 6 x 7 x 2 cells".

    Raises
    ------
    FormatError
        If there are several and none is requested.
    ParameterError
        If the requested frame does not exist.

    >>> choose_frame(Path("a.nii"), None, 1, what="")
    0
    """
    if frame is None:
        if frames > 1:
            raise FormatError(f"{path} {what}; choose one of its {frames} frames: --frame 0 to --frame {frames - 1}")
        return 0
    if isinstance(frame, bool) or frame != int(frame) or not 0 <= frame < frames:
        available = "one frame, number 0" if frames == 1 else f"{frames} frames, 0 to {frames - 1}"
        raise ParameterError.about("frame", f"is {frame!r} and {path} holds {available}; give one that is there")
    return int(frame)
