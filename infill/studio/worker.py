"""The worker of a page, a process of its own: it reads files, calls the library, and answers in frames.

Products are made one after another on the main thread, where they can be interrupted; slices of scans and layers of
prints are read on another one meanwhile.
"""

from __future__ import annotations

import contextlib
import ctypes
import json
import logging
import os
import queue
import shutil
import signal
import sys
import threading
import time
import warnings
from typing import Any, BinaryIO

from infill.errors import GeometryError, InfillError, escape_unprintable
from infill.studio.desk import Desk
from infill.studio.frames import END, ERROR, PROGRESS, READY, AnswerFrame
from patterns.errors import PatternError

VIEWS = ("slice", "layer")  # actions that do not wait for products
PATIENCE = 0.1  # s, in which a cancelled product ends at its next stage; then it is interrupted where it is
BASE_MEMORY = 2**30  # bytes for the interpreter and its libraries
PROGRESS_PAUSE = 0.05  # s between two signs of progress
OUT_OF_MEMORY = "this needs more memory than the studio may take; choose larger cells or voxels, or a smaller input"


class Cancelled(BaseException):
    """The page does not want this answer any more."""


class Outbox:
    """Frames to the server, from several threads.

    Parameters
    ----------
    stream : binary file
    """

    def __init__(self, stream: BinaryIO) -> None:
        self._stream = stream
        self._lock = threading.Lock()

    def send(self, frame: AnswerFrame) -> None:
        """Send a frame; end the process if nobody reads it."""
        try:
            with self._lock:
                self._stream.write(frame.to_server())
                self._stream.flush()
        except OSError:
            os._exit(1)


class CurrentRequest:
    """The request that the main thread works on, and whether it is still wanted."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._number = 0
        self._unwanted: set[int] = set()

    def begin(self, number: int) -> bool:
        """Begin a request; return False if it was cancelled before."""
        with self._lock:
            is_current = number not in self._unwanted
            self._unwanted.discard(number)
            self._number = number if is_current else 0
        return is_current

    def end(self) -> None:
        """End the request: from here on it is not interrupted."""
        with self._lock:
            self._unwanted.discard(self._number)
            self._number = 0

    def check(self) -> None:
        """Raise Cancelled if nobody waits for the answer any more."""
        if self._number in self._unwanted:
            raise Cancelled

    def cancel(self, number: int) -> None:
        """Cancel a request that waits or runs."""
        with self._lock:
            self._unwanted.add(number)
            running = self._number == number
        if running:
            threading.Timer(PATIENCE, self._interrupt, (number,)).start()

    def _interrupt(self, number: int) -> None:
        """Raise Cancelled on the main thread, wherever its Python code is, if it is still at this request."""
        with self._lock:
            main = threading.main_thread().ident
            if self._number == number and number in self._unwanted and main is not None:
                ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(main), ctypes.py_object(Cancelled))


class LogFrames(logging.Handler):
    """Messages of the library as progress, and as warnings of the answer.

    Parameters
    ----------
    outbox : Outbox
    """

    def __init__(self, outbox: Outbox) -> None:
        super().__init__()
        self._outbox = outbox
        self.request = 0
        self.lines: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        """Send a message, and keep it for the answer if it is a warning."""
        text = escape_unprintable(record.getMessage())
        if record.levelno >= logging.WARNING and record.module != "compiling":  # which only says why this takes long
            self.lines.append(text)
        elif self.request:
            self._outbox.send(AnswerFrame.of_json(PROGRESS, {"stage": text, "share": None}, self.request))


def run(boot: dict[str, Any]) -> None:
    """Work until stdin ends."""
    requests, outbox = sys.stdin.buffer, _take_stdout()
    _set_limits(boot)
    folder = boot["folder"]
    os.chdir(folder)
    work, desk = CurrentRequest(), Desk(folder=folder, memory=boot["memory"])
    logs = LogFrames(outbox)
    log = logging.getLogger("infill")
    log.addHandler(logs)
    log.propagate = False
    log.setLevel(logging.INFO)
    warnings.showwarning = lambda message, *rest, **more: logs.lines.append(str(message))  # noqa: ARG005
    products: queue.Queue[dict[str, Any]] = queue.Queue()
    views: queue.Queue[dict[str, Any]] = queue.Queue()
    threading.Thread(target=_listen, args=(requests, products, views, work, folder), daemon=True).start()
    threading.Thread(target=_answer_views, args=(views, desk, outbox), daemon=True).start()
    if boot.get("warm"):
        with contextlib.suppress(Exception):
            desk.warm(lambda: not products.empty())
    outbox.send(AnswerFrame(kind=READY))
    while True:
        message = products.get()
        number = int(message["id"])
        if not work.begin(number):
            outbox.send(_cancelled(number))
        else:
            logs.request, logs.lines = number, []
            _answer(message, desk, outbox, work, logs)
        outbox.send(AnswerFrame(kind=END, request=number))


def _answer(message: dict[str, Any], desk: Desk, outbox: Outbox, work: CurrentRequest, logs: LogFrames) -> None:
    """Answer a request in frames; an error becomes the last of them."""
    number = int(message["id"])
    sent_at = [0.0]

    def progress(stage: str, share: float) -> None:
        """Send a sign of progress now and then; stop if the page does not want the answer any more."""
        work.check()
        if time.monotonic() - sent_at[0] > PROGRESS_PAUSE:
            sent_at[0] = time.monotonic()
            outbox.send(AnswerFrame.of_json(PROGRESS, {"stage": stage, "share": share}, number))

    try:
        try:
            frames = list(desk.answer(message, progress, logs.lines))
        finally:
            work.end()
        for frame in frames:
            outbox.send(AnswerFrame(kind=frame.kind, payload=frame.payload, request=number))
    except Cancelled:
        outbox.send(_cancelled(number))
    except BaseException as error:  # noqa: BLE001 - whatever happens, the page gets one clear message
        outbox.send(_error_frame(error, number))
        if isinstance(error, MemoryError):
            desk.forget()


def _answer_views(views: queue.Queue[dict[str, Any]], desk: Desk, outbox: Outbox) -> None:
    """Answer requests for slices and layers, one after another."""
    while True:
        message = views.get()
        number = int(message["id"])
        try:
            for frame in desk.answer(message, lambda stage, share: None, []):  # noqa: ARG005
                outbox.send(AnswerFrame(kind=frame.kind, payload=frame.payload, request=number))
        except Exception as error:  # noqa: BLE001 - as above
            outbox.send(_error_frame(error, number))
        outbox.send(AnswerFrame(kind=END, request=number))


def _cancelled(number: int) -> AnswerFrame:
    """Return the answer to a request that was cancelled."""
    return AnswerFrame.of_json(ERROR, {"message": "cancelled", "parameter": None, "cancelled": True}, number)


def _error_frame(error: BaseException, number: int) -> AnswerFrame:
    """Return an error as a frame: in its words, or as a fault of the program."""
    parameter = getattr(error, "parameter", None)
    if isinstance(error, (InfillError, PatternError)):
        message = error.spell(lambda name: name.rstrip("_").replace("_", " "))
    elif isinstance(error, MemoryError):
        message = OUT_OF_MEMORY
    else:
        logging.getLogger("infill.studio").debug("a fault", exc_info=error)
        message = f"this is a fault of the program ({type(error).__name__}: {str(error)[:200]}); please report it"
    stated = {"message": escape_unprintable(message), "parameter": parameter}
    if isinstance(error, GeometryError):
        stated["refused"] = True
    return AnswerFrame.of_json(ERROR, stated, number)


def _listen(
    stream: BinaryIO,
    products: queue.Queue[dict[str, Any]],
    views: queue.Queue[dict[str, Any]],
    work: CurrentRequest,
    folder: str,
) -> None:
    """Read requests; at the end of stdin, which ends with the server, remove the folder and end."""
    for line in stream:
        message = json.loads(line)
        if "cancel" in message:
            work.cancel(int(message["cancel"]))
        else:
            (views if message["action"] in VIEWS else products).put(message)
    shutil.rmtree(folder, ignore_errors=True)
    os._exit(0)


def _take_stdout() -> Outbox:
    """Return stdout for frames; libraries print to stderr."""
    frames = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    sys.stdout = sys.stderr
    return Outbox(frames)


def _set_limits(boot: dict[str, Any]) -> None:
    """Set the limits that this system has."""
    with contextlib.suppress(AttributeError, ValueError):
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the server's
    try:
        import resource
    except ImportError:  # Windows
        return
    for name, limit in ((resource.RLIMIT_CORE, 0), (resource.RLIMIT_DATA, boot["memory"] + BASE_MEMORY)):
        hard = resource.getrlimit(name)[1]
        with contextlib.suppress(ValueError, OSError):  # macOS knows some of them by name only
            resource.setrlimit(name, (limit if hard == resource.RLIM_INFINITY else min(limit, hard), hard))
