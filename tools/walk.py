"""Write docs/design/walks.md: the way of each product through the rooms, as it runs: `python tools/walk.py`.

A move is a call from a function of one room to a function of another. Each called function counts once, where it is
called first. Kernels, the hall and the declarations of reports are left out: they are leaves. So is what modules do
while they are imported.
"""

from __future__ import annotations

import inspect
import sys
import tempfile
from collections.abc import Callable
from concurrent.futures import Executor, Future
from pathlib import Path
from types import FrameType
from typing import Any

import numpy as np
import trimesh

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "design" / "walks.md"
LEAVES = ("hall", "kernels", "reports")
HEAD = """# Walks

The way of each product through [the rooms](../architecture.md), as it runs with default options, for a reader who wants
to follow it. A move is a call from a function of one room to a function of another; each called function counts once,
where it is called first. Kernels, the hall and the declarations of reports are left out, because they are leaves.
`python tools/walk.py` writes this page.
"""


class Inline(Executor):
    """Do work as it is handed in, so that the trace sees it, in one order."""

    def __init__(self, *_: object, **__: object) -> None:
        """Take the arguments of a pool of threads."""

    def submit(self, work: Callable[..., Any], /, *arguments: Any, **named: Any) -> Future[Any]:  # noqa: ANN401
        """Do the work; return it as done."""
        done: Future[Any] = Future()
        done.set_result(work(*arguments, **named))
        return done


def room_of(path: str) -> str | None:
    """Return the room of a source file, or None outside the packages."""
    if not path.startswith(f"{ROOT}/infill/") and not path.startswith(f"{ROOT}/patterns/"):
        return None
    parts = Path(path).relative_to(ROOT).parts
    return parts[0] if parts[0] == "patterns" else parts[1] if len(parts) > 2 else "hall"


def qualified_name(frame: FrameType) -> str:
    """Return the name of the running function, with its class or the function around it."""
    return frame.f_code.co_qualname.replace(".<locals>", "")


def trace(call: Callable[[], object]) -> list[tuple[str, str]]:
    """Return the moves of a call, in order: the calling and the called function, each with its file."""
    moves: dict[tuple[str, str], str] = {}

    def note(frame: FrameType, event: str, argument: Any) -> None:  # noqa: ARG001, ANN401 - the signature of a profiler
        name = frame.f_code.co_name
        if event != "call" or name.startswith(("<", "__")) or not is_function(frame):
            return
        room = room_of(frame.f_code.co_filename)
        if room is None or room in LEAVES:
            return
        caller = frame.f_back
        while caller is not None and (
            room_of(caller.f_code.co_filename) is None or caller.f_code.co_name.startswith("<")
        ):
            caller = caller.f_back
        if caller is None or not is_function(caller) or room_of(caller.f_code.co_filename) in (room, *LEAVES):
            return
        moves.setdefault((frame.f_code.co_filename, qualified_name(frame)), place(caller))

    sys.setprofile(note)
    try:
        call()
    finally:
        sys.setprofile(None)
    return [
        (caller, f"{Path(path).relative_to(ROOT).with_suffix('')}.{name}") for (path, name), caller in moves.items()
    ]


def is_function(frame: FrameType) -> bool:
    """Tell whether a frame is of a function: not of a module, or of the body of a class."""
    return bool(frame.f_code.co_flags & inspect.CO_OPTIMIZED)


def place(frame: FrameType) -> str:
    """Return the file and name of the function of a frame."""
    return f"{Path(frame.f_code.co_filename).relative_to(ROOT).with_suffix('')}.{qualified_name(frame)}"


def calls() -> dict[str, Callable[[], object]]:
    """Return a call of each product."""
    sys.path.insert(0, str(ROOT / "tests"))
    from handmade_prints import Dialect, written

    import infill.kernels.threads
    from infill import fill, make, motion, refill, smooth_mesh, smooth_volume, verify

    vars(infill.kernels.threads)["ThreadPoolExecutor"] = Inline
    sliced = Path(tempfile.mkdtemp()) / "box.gcode"
    sliced.write_bytes(written(Dialect()))
    ball = np.sum((np.indices((24, 24, 24)) - 11.5) ** 2, axis=0) < 64
    return {
        'make("honeycomb")': lambda: make("honeycomb", size=20, height=3),
        "smooth_volume": lambda: smooth_volume(ball),
        "smooth_mesh": lambda: smooth_mesh(trimesh.creation.icosphere(radius=10), resolution=24),
        'fill(part, "gyroid")': lambda: fill(trimesh.creation.box((20, 20, 20))),
        "refill(print)": lambda: refill(sliced, output=sliced.with_name("keep.gcode")),
        'refill(print, pattern="honeycomb")': lambda: refill(
            sliced, output=sliced.with_name("new.gcode"), pattern="honeycomb"
        ),
        "motion(print)": lambda: motion(sliced),
        "verify(print, keep)": lambda: verify(sliced, sliced.with_name("keep.gcode")),
    }


def section(title: str, call: Callable[[], object]) -> str:
    """Return the section of the page for a product."""
    moves = trace(call)
    rows = "\n".join(f"| {number} | `{caller}` | `{called}` |" for number, (caller, called) in enumerate(moves, 1))
    return f"## {title}: {len(moves)} moves\n\n| | from | to |\n|---|---|---|\n{rows}\n"


def page() -> str:
    """Return the page."""
    return "\n".join([HEAD, *(section(title, call) for title, call in calls().items())])


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
