"""Ctrl-C takes effect while compiled code runs, and long stages say how far they are."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest
import trimesh

from infill import smooth_mesh
from infill.kernels.threads import run_interruptibly, run_together

# Like a compiled loop, this holds its thread for long without a step of Python, and lets other threads run.
LOOP = "import hashlib; loop = lambda: hashlib.pbkdf2_hmac('sha256', b'a', b'b', 10**9)"
SCRIPT = """
import os, signal
signal.signal(signal.SIGINT, signal.default_int_handler)  # which a shell's background jobs ignore
from infill.kernels.threads import run_interruptibly, run_together
{loop}
print("ready", flush=True)
try:
    {call}
except KeyboardInterrupt:
    os._exit(130)
"""


@pytest.mark.skipif(os.name == "nt", reason="signals are sent in another way")
@pytest.mark.parametrize(
    "call",
    ["run_interruptibly(loop)", "run_together(loop, threads=1)", "run_together(loop, loop, threads=2)"],
)
def test_an_interrupt_does_not_wait_for_a_compiled_loop(call: str) -> None:
    script = SCRIPT.format(loop=LOOP, call=call)
    with subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "ready\n"
        time.sleep(0.5)
        begin = time.monotonic()
        process.send_signal(signal.SIGINT)
        try:
            assert process.wait(timeout=20) == 130
        finally:
            process.kill()
        assert time.monotonic() - begin < 5  # a fraction of a second on an idle machine; the loop takes minutes


def test_results_and_errors_come_back() -> None:
    assert run_interruptibly(lambda: 3) == 3
    assert run_together(lambda: 1, threads=1) == [1]
    with pytest.raises(ZeroDivisionError):
        run_interruptibly(lambda: 1 / 0)
    names: list[str] = []
    inner = threading.Thread(target=lambda: names.append(run_interruptibly(lambda: threading.current_thread().name)))
    inner.start()
    inner.join()
    assert names == [inner.name]  # no thread more than there are


@pytest.mark.usefixtures("compiled")
def test_voxelising_and_simplifying_are_told() -> None:
    told: list[tuple[str, float]] = []
    ball = trimesh.creation.icosphere(4, 10)
    smooth_mesh(ball, resolution=100, progress=lambda stage, share: told.append((stage, share)))
    stages = list(dict.fromkeys(stage for stage, _ in told))
    assert stages[:3] == ["voxels", "smooth", "surface"]
    assert "simplify" in stages
    shares = np.array([share for _, share in told])
    assert (np.diff(shares) >= 0).all()
    assert shares[-1] <= 1
    assert sum(stage == "simplify" for stage, _ in told) >= 3
