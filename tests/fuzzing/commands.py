"""Run a command of infill in this process, and find what no command may do, whatever it is given."""

from __future__ import annotations

import contextlib
import os
import re
import sys
import tempfile
import traceback
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

SLOWEST = 20.0  # s of computing for a file of a few thousand bytes; what waits without computing, the campaign sees
COMPILES = "preparing "  # what a command says before the first use of a kernel, which is not the file's fault
MOST_MEMORY = 4 * 2**30  # bytes
CONTROL = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f\u200e\u200f\u202a-\u202e\u2066-\u2069]")


@dataclass(frozen=True, kw_only=True)
class Answer:
    """What a command answered: its exit status, its text, what it cost, and the exception that escaped, if any.

    `seconds` are those of processors, in this process and in those it started.
    """

    status: int
    out: str
    err: str
    seconds: float
    peak: int  # bytes
    escaped: str = ""

    @property
    def done(self) -> bool:
        return self.status == 0


def run_command(*words: str | Path) -> Answer:
    """Run `infill WORDS` as its console script does, with both streams caught, those of compiled libraries too."""
    from infill.cli import main

    was = sys.argv
    sys.argv = ["infill", *map(str, words)]
    status, escaped = 0, ""
    _forget_peak()
    begin = _computed()
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        with _caught(1, out.fileno()), _caught(2, err.fileno()):
            try:
                main()
            except SystemExit as end:
                status = end.code if isinstance(end.code, int) else int(end.code is not None)
            except BaseException as error:  # noqa: BLE001 - whatever escapes is the finding
                status, escaped = -1, describe(error)
        seconds = _computed() - begin
        texts = []
        for file in (out, err):
            file.seek(0)
            texts.append(file.read().decode("utf-8", "replace"))
    sys.argv = was
    return Answer(status=status, out=texts[0], err=texts[1], seconds=seconds, peak=_peak(), escaped=escaped)


def describe(error: BaseException) -> str:
    """Return an exception's type and where it was raised, in the package's own code if any frame is there."""
    frames = traceback.extract_tb(error.__traceback__)
    ours = [frame for frame in frames if f"{os.sep}infill{os.sep}" in frame.filename] or frames
    last = ours[-1]
    return f"{type(error).__name__} in {Path(last.filename).parent.name}/{Path(last.filename).name}:{last.lineno}"


def faults_of(answer: Answer, *, may_fail_silently: bool = False) -> Iterator[str]:
    """Name what is wrong with an answer, whatever the file was."""
    if answer.escaped:
        yield f"escaped: {answer.escaped}"
    elif answer.status not in (0, 1, 2):
        yield f"exit status {answer.status}"
    if "Traceback (most recent call last)" in answer.err:
        yield f"traceback: {answer.err.strip().splitlines()[-1][:100]}"
    errors = [line for line in answer.err.splitlines() if line.startswith("error:")]
    if answer.status in (1, 2) and not answer.escaped and len(errors) != 1 and not may_fail_silently:
        yield f"{len(errors)} lines of error with exit status {answer.status}"
    if errors and "out of memory" in errors[0]:
        yield "out of memory"
    for stream in (answer.out, answer.err):
        if found := CONTROL.search(stream):
            yield f"control character {found[0]!r}"
    if answer.seconds > SLOWEST and COMPILES not in answer.err:
        yield f"took over {SLOWEST:.0f} s"
    if answer.peak > MOST_MEMORY:
        yield "took over 4 GiB"


@contextlib.contextmanager
def _caught(number: int, into: int) -> Iterator[None]:
    stream = sys.stdout if number == 1 else sys.stderr
    kept = os.dup(number)
    stream.flush()
    os.dup2(into, number)
    try:
        yield
    finally:
        for each in (sys.stdout, sys.stderr):
            with contextlib.suppress(OSError, AttributeError):
                each.flush()
        os.dup2(kept, number)
        os.close(kept)
        if number == 1:
            sys.stdout = stream  # which the command takes away when it cannot be written to


def _computed() -> float:
    return sum(os.times()[:4])


def _forget_peak() -> None:
    with contextlib.suppress(OSError):
        Path("/proc/self/clear_refs").write_text("5")


def _peak() -> int:
    with contextlib.suppress(OSError):
        for line in Path("/proc/self/status").read_text().splitlines():
            if line.startswith("VmHWM:"):
                return int(line.split()[1]) * 1024
    return 0
