"""A worker process: requests go in by its stdin, frames come out of its stdout.

It ends with the server: its stdin is closed then.
"""

from __future__ import annotations

import asyncio
import contextlib
import os
import sys
from collections.abc import AsyncGenerator, Mapping
from pathlib import Path
from typing import Any

from infill.errors import InfillError
from infill.machine import has_interpreter
from infill.studio.frames import END, ERROR, READY, WORKER_HEAD, AnswerFrame, dump_json
from infill.studio.limits import StudioLimits

# `-P` keeps the working directory off the path: a file there must not stand in for a module.
BOOT_CODE = (
    "import json, sys; boot = json.loads(sys.stdin.buffer.readline()); sys.path[:] = boot['path']; "
    "from infill.studio.worker import run; run(boot)"
)
GONE = "the worker of this page ended: it needed more memory than there is, or a library crashed; try a smaller input"


class WorkerProcess:
    """One process that works for a page, one request after another.

    Parameters
    ----------
    process : asyncio.subprocess.Process
    limits : StudioLimits
    """

    def __init__(self, process: asyncio.subprocess.Process, limits: StudioLimits) -> None:
        self.process = process
        self.limits = limits
        self.is_ready = asyncio.Event()
        self._queues: dict[int, asyncio.Queue[AnswerFrame]] = {}
        self._reading = asyncio.create_task(self._read())
        self._killing: set[asyncio.Task[None]] = set()

    @classmethod
    async def start(cls, folder: Path, limits: StudioLimits, *, warm: bool = True) -> WorkerProcess:
        """Start a process that works in a folder; with `warm`, it loads its libraries at once.

        Raises
        ------
        InfillError
            If there is no Python to start.
        """
        if not has_interpreter():
            raise InfillError("the studio starts Python processes, and there is no Python here; install Python")
        process = await asyncio.create_subprocess_exec(
            sys.executable,
            "-P",
            "-c",
            BOOT_CODE,
            stdin=asyncio.subprocess.PIPE,
            stdout=asyncio.subprocess.PIPE,
            stderr=None,
            cwd=folder,
            env={**os.environ, "TMPDIR": str(folder), "TEMP": str(folder), "TMP": str(folder)},
            start_new_session=True,  # Ctrl-C is the server's: it ends its workers
        )
        worker = cls(process, limits)
        boot = {
            "path": sys.path,
            "folder": str(folder),
            "memory": limits.memory_bytes,
            "warm": warm,
        }
        worker._write(boot)
        return worker

    @property
    def is_alive(self) -> bool:
        """True if the process runs."""
        return self.process.returncode is None and not self._reading.done()

    def _write(self, message: Mapping[str, Any]) -> None:
        """Send a message to the process, if it still listens."""
        with contextlib.suppress(OSError, RuntimeError):
            assert self.process.stdin is not None
            self.process.stdin.write(dump_json(message) + b"\n")

    async def ask(self, message: Mapping[str, Any]) -> AsyncGenerator[AnswerFrame, None]:
        """Send a request with its number, "id"; yield its frames, the end among them.

        Raises
        ------
        TimeoutError
            If it takes longer than allowed.
        """
        loop = asyncio.get_running_loop()
        number = message["id"]
        queue: asyncio.Queue[AnswerFrame] = asyncio.Queue()
        self._queues[number] = queue
        if not self.is_alive:
            self._fail(number)
        self._write(message)
        await self._wait_until_ready()  # loading the library is not the request's time
        deadline = loop.time() + self.limits.seconds
        while True:
            frame = await asyncio.wait_for(queue.get(), deadline - loop.time())
            yield frame
            if frame.kind == END:
                return

    async def _wait_until_ready(self) -> None:
        """Wait until the process has loaded its libraries, or has ended."""
        if not self.is_ready.is_set():
            waiting = asyncio.create_task(self.is_ready.wait())
            try:
                await asyncio.wait({waiting, self._reading}, return_when=asyncio.FIRST_COMPLETED)
            finally:
                waiting.cancel()

    def cancel(self, number: int) -> None:
        """Stop a request: the process ends it by itself, or is killed after a while."""
        if number not in self._queues or not self.is_alive:
            return
        self._write({"cancel": number})
        task = asyncio.create_task(self._kill_unless_done(number))
        self._killing.add(task)
        task.add_done_callback(self._killing.discard)

    async def _kill_unless_done(self, number: int) -> None:
        """Kill the process if a request goes on after it was cancelled."""
        await asyncio.sleep(self.limits.cancel_seconds)
        if number in self._queues:
            await self.kill()

    async def kill(self) -> None:
        """End the process, and wait until it has."""
        with contextlib.suppress(ProcessLookupError):
            self.process.kill()
        await self.process.wait()
        with contextlib.suppress(asyncio.CancelledError):
            await self._reading

    async def _read(self) -> None:
        """Read frames, and hand each to its request; at the end of the process, end all requests."""
        assert self.process.stdout is not None
        try:
            while True:
                head = await self.process.stdout.readexactly(WORKER_HEAD.size)
                length, kind, number = WORKER_HEAD.unpack(head)
                payload = await self.process.stdout.readexactly(length)
                if kind == READY:
                    self.is_ready.set()
                    continue
                queue = self._queues.get(number)
                if queue is not None:
                    queue.put_nowait(AnswerFrame(kind=kind, payload=payload, request=number))
                if kind == END:
                    self._queues.pop(number, None)
        except (asyncio.IncompleteReadError, OSError):
            pass
        finally:
            for number in list(self._queues):
                self._fail(number)

    def _fail(self, number: int) -> None:
        """End a request of a process that is gone."""
        queue = self._queues.pop(number)
        message = {"message": GONE, "parameter": None, "gone": True}
        queue.put_nowait(AnswerFrame.of_json(ERROR, message, number))
        queue.put_nowait(AnswerFrame(kind=END, request=number))
