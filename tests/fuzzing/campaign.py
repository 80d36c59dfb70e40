"""Cases in worker processes that may crash or hang: what each target's files did, and the files that failed."""

from __future__ import annotations

import json
import os
import selectors
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path

from tests.fuzzing.targets import TARGETS
from tests.fuzzing.worker import make_case, seeds_of

HANGS = 180.0  # s after which a case is given up, and its process with it: a judge's own time included
ROOT = Path(__file__).resolve().parents[2]


@dataclass(kw_only=True)
class Findings:
    """How many cases ran, and the faults of those that failed, by number."""

    target: str
    seed: str
    cases: int = 0
    faults: dict[int, list[str]] = field(default_factory=dict)

    @property
    def kinds(self) -> Counter[str]:
        return Counter(fault for faults in self.faults.values() for fault in faults)


def run_cases(
    target: str, *, seed: str, count: int, start: int = 0, seconds: float | None = None, into: Path | None = None
) -> Findings:
    """Run cases of one target; a process that dies or hangs is a fault of its case, and the next takes over.

    `seconds` is how long to go on at most; `into` is a folder for the files that failed.
    """
    found = Findings(target=target, seed=seed)
    ends = time.monotonic() + seconds if seconds else None
    number, stop = start, start + count
    while number < stop and not (ends and time.monotonic() > ends):
        number = _run_worker(found, number, stop, ends)
    if into and found.faults:
        _keep(found, into)
    return found


def _run_worker(found: Findings, start: int, stop: int, ends: float | None) -> int:
    """Run cases in one process until it stops, and return the number of the next case."""
    with tempfile.TemporaryDirectory(prefix="fuzz-") as folder:
        words = [
            sys.executable,
            "-m",
            "tests.fuzzing.worker",
            found.target,
            "--seed",
            found.seed,
            "--start",
            str(start),
        ]
        process = subprocess.Popen(
            [*words, "--count", str(stop - start), "--folder", folder], cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
            env=os.environ | {"PYTHONPATH": os.pathsep.join([str(ROOT), os.environ.get("PYTHONPATH", "")]), "TMPDIR": folder},
            start_new_session=True,
        )  # fmt: skip
        running, following = None, start
        try:
            for line in _lines(process, ends):
                told = json.loads(line)
                if "begins" in told:
                    running = told["begins"]
                else:
                    found.cases += 1
                    running, following = None, told["ends"] + 1
                    if told["faults"]:
                        found.faults[told["ends"]] = told["faults"]
            fault = None
        except TimeoutError:
            fault = f"hung for {HANGS:.0f} s"
        with_signal = _stop(process)
        late = ends is not None and time.monotonic() > ends
        if running is not None and not (late and fault is None):
            found.cases += 1
            found.faults[running] = [fault or f"the process died ({with_signal})"]
            return running + 1
        if running is None and following == start and not late:
            raise RuntimeError(f"the worker of {found.target} did not begin: {with_signal}")
        return following


def _lines(process: subprocess.Popen[bytes], ends: float | None):
    """Yield the lines that a worker prints; raise TimeoutError where none comes for too long."""
    assert process.stdout
    with selectors.DefaultSelector() as ready:
        ready.register(process.stdout, selectors.EVENT_READ)
        left = b""
        while True:
            if ends and time.monotonic() > ends:
                return
            if not ready.select(HANGS):
                raise TimeoutError
            data = os.read(process.stdout.fileno(), 65536)
            if not data:
                return
            *lines, left = (left + data).split(b"\n")
            yield from lines


def _stop(process: subprocess.Popen[bytes]) -> str:
    """End a worker with all that it started, and say how it ended."""
    try:
        process.wait(timeout=0.5)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
    _, err = process.communicate()
    lines = [line for line in err.decode("utf-8", "replace").strip().splitlines() if "ResourceWarning" not in line]
    last = (lines or [""])[-1]
    code = process.returncode
    return signal.Signals(-code).name if code < 0 else f"exit status {code}, {last[:200]}"


def _keep(found: Findings, into: Path) -> None:
    into.mkdir(parents=True, exist_ok=True)
    files = seeds_of(TARGETS[found.target])
    for number, faults in found.faults.items():
        chosen, data, _ = make_case(found.target, found.seed, number, files)
        stem = f"{found.target}-{found.seed}-{number}"
        (into / f"{stem}-{chosen}").write_bytes(data)
        (into / f"{stem}.txt").write_text("\n".join(faults) + "\n", encoding="utf-8")
