"""A command in a process of its own: its report, its messages and its progress; ended if nobody waits for it."""

from __future__ import annotations

import contextlib
import json
import os
import signal
import subprocess
import sys
from collections.abc import AsyncIterator, Awaitable, Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import anyio
from anyio.abc import ByteReceiveStream, Process
from anyio.streams.text import TextReceiveStream

PROGRESS = "progress: "  # begins a line of progress
ERROR = "error: "
PATIENCE = 3.0  # s, in which a command that is not wanted any more removes what it has begun
ReportProgress = Callable[[float, str], Awaitable[None]]


@dataclass(frozen=True, kw_only=True)
class CommandOutcome:
    """What a command left.

    Parameters
    ----------
    status : int
        Exit status; below 0, the signal that ended it.
    report : any
        The JSON that it printed; None if it printed none.
    messages : str
        Summary and warnings, without the lines of progress.
    error : str
        The message of an error; empty if there was none.
    """

    status: int
    report: Any
    messages: str
    error: str


async def run_command(words: Sequence[str], folder: Path, report_progress: ReportProgress) -> CommandOutcome:
    """Run a command in a process and return its outcome; end the process if this is cancelled.

    Parameters
    ----------
    words : sequence of str
        After ``infill``.
    folder : Path
        Where it runs.
    report_progress : async callable
        Of the share that is done, 0 to 1, and the name of the stage.
    """
    # Modules in the folder, where files of others lie, must not be imported.
    environment = {**os.environ, "PYTHONSAFEPATH": "1", "PYTHONUTF8": "1", "INFILL_PROGRESS": "lines"}
    process = await anyio.open_process(
        [sys.executable, "-m", "infill.cli", *words],
        stdin=subprocess.DEVNULL,
        cwd=folder,
        env=environment,
        start_new_session=True,
    )
    assert process.stdout is not None
    assert process.stderr is not None
    printed: list[bytes] = []
    lines: list[str] = []
    try:
        async with anyio.create_task_group() as group:
            group.start_soon(_collect, process.stdout, printed)
            async for line in _read_lines(process.stderr):
                if line.startswith(PROGRESS):
                    share, _, stage = line.removeprefix(PROGRESS).partition(" ")
                    await report_progress(float(share), stage)
                else:
                    lines.append(line)
        status = await process.wait()
    finally:
        with anyio.CancelScope(shield=True):
            await _end(process)
            await process.aclose()
    return read_outcome(status, b"".join(printed), lines)


def read_outcome(status: int, printed: bytes, lines: Sequence[str]) -> CommandOutcome:
    """Return the outcome of a command from its exit status, its output and the lines of stderr.

    >>> read_outcome(1, b"", ["Usage: infill fill", "error: --wall is -1 mm"]).error
    '--wall is -1 mm'
    """
    report = None
    with contextlib.suppress(ValueError):
        report = json.loads(printed)
    errors = [line.removeprefix(ERROR) for line in lines if line.startswith(ERROR)]
    if status and report is None and not errors:
        ending = f"signal {-status}" if status < 0 else f"exit status {status}"
        errors = [f"the command ended with {ending} and no message; perhaps this needs more memory than there is"]
    return CommandOutcome(
        status=status, report=report, messages="\n".join(lines).strip("\n"), error=errors[-1] if errors else ""
    )


async def _collect(stream: ByteReceiveStream, chunks: list[bytes]) -> None:
    """Append all that a stream has to a list."""
    chunks.extend([chunk async for chunk in stream])


async def _read_lines(stream: ByteReceiveStream) -> AsyncIterator[str]:
    """Yield the lines of a stream of text."""
    rest = ""
    async for text in TextReceiveStream(stream, errors="replace"):
        *lines, rest = (rest + text).split("\n")
        for line in lines:
            yield line.rstrip("\r")
    if rest:
        yield rest


async def _end(process: Process) -> None:
    """End a process that still runs, and those that it started: first by asking, so that no half file stays."""
    if process.returncode is not None:
        return
    with contextlib.suppress(ProcessLookupError):
        process.terminate()
    with anyio.move_on_after(PATIENCE):
        await process.wait()
    if process.returncode is None:
        with contextlib.suppress(ProcessLookupError):
            if hasattr(os, "killpg"):
                os.killpg(process.pid, signal.SIGKILL)
            else:
                process.kill()
        await process.wait()
