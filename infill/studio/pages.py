"""Pages: each has a worker process and a folder of its own, and both go when the page goes."""

from __future__ import annotations

import asyncio
import contextlib
import itertools
import secrets
import shutil
import time
from collections.abc import AsyncGenerator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from infill.errors import InfillError
from infill.plain_numbers import plain_argument
from infill.studio.frames import END, ERROR, AnswerFrame
from infill.studio.limits import StudioLimits
from infill.studio.processes import WorkerProcess

NUMBERS = itertools.count(1)  # of requests
REPLACED = "a newer request took the place of this one"
FULL = "{count} pages of the studio are open, and there may be {limit}; close one"


@dataclass(kw_only=True, eq=False)
class StoredFile:
    """A file of a page: uploaded, and read once by the worker.

    Parameters
    ----------
    name : str
        In the folder of the page.
    kind : str
        "part", "print", "scan", "tile" or "field"; empty until it is read.
    size : int
        Bytes.
    """

    name: str
    size: int
    kind: str = ""

    def facts(self) -> dict[str, str]:
        """Return name and kind, for the worker."""
        return {"name": self.name, "kind": self.kind}


@dataclass(kw_only=True, eq=False)
class Page:
    """A page in a browser, with its files and results.

    Parameters
    ----------
    name : str
        In its addresses.
    folder : Path
    limits : StudioLimits
    """

    name: str
    folder: Path
    limits: StudioLimits
    files: dict[str, StoredFile] = field(default_factory=dict)
    results: dict[str, dict[str, Any]] = field(default_factory=dict)  # the requests that made them
    gone: asyncio.Event = field(default_factory=asyncio.Event)
    living: int = 0  # open streams of life
    seen: float = field(default_factory=time.monotonic)
    _worker: WorkerProcess | None = None
    _starting: asyncio.Lock = field(default_factory=asyncio.Lock)
    _lanes: dict[str, int] = field(default_factory=dict)
    _replaced: set[int] = field(default_factory=set)
    _numbers: itertools.count[int] = field(default_factory=lambda: itertools.count(1))

    @property
    def stored_bytes(self) -> int:
        """Size of all files."""
        return sum(stored.size for stored in self.files.values())

    def new_name(self, prefix: str) -> str:
        """Return a new name for a file or a result, such as "f1"."""
        return f"{prefix}{next(self._numbers)}"

    def hire(self, worker: WorkerProcess) -> None:
        """Take a process that works for no page yet."""
        self._worker = worker

    async def _get_worker(self) -> WorkerProcess:
        """Return the process of the page; start another if it has ended."""
        async with self._starting:
            if self.gone.is_set():
                raise InfillError("this page is gone; load it again")
            if self._worker is None or not self._worker.is_alive:
                self._worker = await WorkerProcess.start(self.folder, self.limits)
            return self._worker

    async def run(self, message: Mapping[str, Any], lane: str | None = None) -> AsyncGenerator[AnswerFrame, None]:
        """Let the worker answer a request; yield its frames without the end.

        A newer request in the same lane cancels it; so does closing this generator.
        """
        number = next(NUMBERS)
        if lane is not None:
            older = self._lanes.get(lane)
            self._lanes[lane] = number
            if older is not None:
                self._replaced.add(older)
                self._cancel(older)
        try:
            async for frame in self._run_again(dict(message), number):
                if frame.kind == ERROR and number in self._replaced:
                    frame = AnswerFrame.of_json(ERROR, {"message": REPLACED, "parameter": None, "cancelled": True})
                yield frame
        finally:
            self._cancel(number)
            self._replaced.discard(number)
            if lane is not None and self._lanes.get(lane) == number:
                del self._lanes[lane]

    async def _run_again(self, message: dict[str, Any], number: int) -> AsyncGenerator[AnswerFrame, None]:
        """Ask the worker; ask the next one too if the first was killed for another request before it answered."""
        for is_last in (False, True):
            worker, has_begun = await self._get_worker(), False
            try:
                async for frame in worker.ask({**message, "id": number}):
                    if frame.kind == END:
                        break
                    is_lost = frame.kind == ERROR and b'"gone":true' in frame.payload
                    if is_lost and not (has_begun or is_last or number in self._replaced):
                        continue
                    has_begun = True
                    yield frame
            except TimeoutError:
                text = f"this takes over {plain_argument(self.limits.seconds)} s; choose larger cells or voxels"
                yield AnswerFrame.of_json(ERROR, {"message": text, "parameter": None})
                return
            if has_begun:
                return

    def _cancel(self, number: int) -> None:
        """Stop a request, if it still runs."""
        if self._worker is not None:
            self._worker.cancel(number)

    async def close(self) -> None:
        """End the worker and remove the folder."""
        self.gone.set()
        if self._worker is not None:
            await self._worker.kill()
        await asyncio.to_thread(shutil.rmtree, self.folder, ignore_errors=True)


class Pages:
    """The open pages, by name.

    Parameters
    ----------
    folder : Path
        Folders of pages are made in it.
    limits : StudioLimits
    """

    def __init__(self, folder: Path, limits: StudioLimits) -> None:
        self.folder = folder
        self.limits = limits
        self._pages: dict[str, Page] = {}
        self._spare: tuple[Path, WorkerProcess] | None = None
        self._closing: set[asyncio.Task[None]] = set()

    def __len__(self) -> int:
        return len(self._pages)

    def find(self, name: str) -> Page | None:
        """Return the page of a name, or None."""
        return self._pages.get(name)

    async def prepare(self) -> None:
        """Start a worker for the first page, which loads its libraries while the browser opens."""
        folder = self._make_folder()
        with contextlib.suppress(InfillError, OSError):
            self._spare = folder, await WorkerProcess.start(folder, self.limits)

    def _make_folder(self) -> Path:
        """Make a new folder for a page."""
        folder = self.folder / secrets.token_hex(8)
        folder.mkdir(mode=0o700)
        return folder

    async def open(self) -> Page:
        """Open a page.

        Raises
        ------
        InfillError
            If there are too many.
        """
        await self.close_silent()
        if len(self._pages) >= self.limits.pages:
            raise InfillError(FULL.format(count=len(self._pages), limit=self.limits.pages))
        (folder, worker), self._spare = self._spare or (self._make_folder(), None), None
        page = Page(name=secrets.token_urlsafe(9), folder=folder, limits=self.limits)
        self._pages[page.name] = page
        if worker is not None:
            page.hire(worker)
        return page

    async def close(self, page: Page) -> None:
        """Close a page: its work stops, its process ends, and its folder is removed."""
        if self._pages.pop(page.name, None) is not None:
            task = asyncio.create_task(page.close())  # goes on, even if the request that closes it is cancelled
            self._closing.add(task)
            task.add_done_callback(self._closing.discard)
            await asyncio.shield(task)

    async def close_silent(self) -> None:
        """Close pages whose browser never opened the stream of life."""
        now = time.monotonic()
        for page in list(self._pages.values()):
            if not page.living and now - page.seen > self.limits.silent_seconds:
                await self.close(page)

    async def close_all(self) -> None:
        """Close all pages, and end the worker that waits for one."""
        for page in list(self._pages.values()):
            await self.close(page)
        await asyncio.gather(*self._closing)
        if self._spare is not None:
            await self._spare[1].kill()
