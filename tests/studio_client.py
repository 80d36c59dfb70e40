"""A page without a browser: talks to a real server of the studio over HTTP, in a process of its own."""

from __future__ import annotations

import contextlib
import json
import os
import signal
import struct
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import httpx

PROGRESS, ANSWER, MESH, ERROR, LAYER = 1, 2, 3, 4, 5
PATIENCE = 300.0  # s, for compiling on a busy machine


@dataclass(kw_only=True)
class Answer:
    """The frames of an answer."""

    frames: list[tuple[int, bytes]]
    status: int = 200

    def payloads(self, kind: int) -> list[bytes]:
        return [payload for each, payload in self.frames if each == kind]

    @property
    def error(self) -> dict[str, Any] | None:
        return next((json.loads(payload) for payload in self.payloads(ERROR)), None)

    @property
    def facts(self) -> dict[str, Any]:
        assert self.error is None, self.error
        (payload,) = self.payloads(ANSWER)
        return json.loads(payload)

    def number(self, name: str) -> Any:
        return next(each["value"] for each in self.facts["numbers"] if each["name"] == name)


def split_frames(pieces: Iterator[bytes]) -> Iterator[tuple[int, bytes]]:
    buffer = b""
    for piece in pieces:
        buffer += piece
        while len(buffer) >= 5:
            length, kind = struct.unpack("<IB", buffer[:5])
            if len(buffer) < 5 + length:
                break
            yield kind, buffer[5 : 5 + length]
            buffer = buffer[5 + length :]
    assert not buffer


@dataclass(kw_only=True)
class Page:
    """A page, with its stream of life on a thread."""

    client: httpx.Client
    name: str
    _stream: Any = None
    _thread: Any = None
    life: list[bytes] = field(default_factory=list)

    def live(self) -> None:
        ready = threading.Event()

        def listen() -> None:
            gone = contextlib.suppress(httpx.HTTPError, ValueError, AttributeError)
            with gone, httpx.stream("GET", self.url("alive"), timeout=None) as response:
                self._stream = response
                for piece in response.iter_raw():
                    self.life.append(piece)
                    ready.set()

        self._thread = threading.Thread(target=listen, daemon=True)
        self._thread.start()
        assert ready.wait(PATIENCE)

    def leave(self) -> None:
        """Close the stream of life, as a browser does with its tab."""
        connection = self._stream.extensions["network_stream"].get_extra_info("socket")
        connection.shutdown(2)
        self._thread.join(PATIENCE)

    def url(self, path: str) -> str:
        return f"{self.client.base_url}api/pages/{self.name}/{path}"

    def post(self, path: str, **more: Any) -> Answer:
        with self.client.stream("POST", self.url(path), timeout=PATIENCE, **more) as response:
            if response.headers.get("content-type") != "application/octet-stream":
                return Answer(frames=[(ERROR, response.read())], status=response.status_code)
            return Answer(frames=list(split_frames(response.iter_raw())), status=response.status_code)

    def upload(self, path: Path, **query: str) -> Answer:
        return self.post(f"files?{httpx.QueryParams({'name': path.name, **query})}", content=path.read_bytes())

    def ask(self, product: str, file: str | None = None, **more: Any) -> Answer:
        return self.post("requests", json={"product": product, "file": file, "quality": "exact", **more})

    def download(self, result: str, **query: str) -> httpx.Response:
        return self.client.get(self.url(f"results/{result}"), params=query, timeout=PATIENCE)


@dataclass(kw_only=True)
class Studio:
    """A running server."""

    process: subprocess.Popen[str]
    address: str
    seconds: float  # from its start to its address
    folder: Path

    @property
    def port(self) -> int:
        return httpx.URL(self.address).port or 0

    def client(self, **more: Any) -> httpx.Client:
        return httpx.Client(base_url=self.address, timeout=PATIENCE, **more)

    @contextlib.contextmanager
    def page(self) -> Iterator[Page]:
        with self.client() as client:
            page = Page(client=client, name=client.post("api/pages").json()["page"])
            page.live()
            try:
                yield page
            finally:
                with contextlib.suppress(OSError, AttributeError, KeyError):
                    page.leave()

    def temporary(self) -> list[Path]:
        return sorted(path for path in self.folder.rglob("*"))

    def workers(self) -> set[int]:
        """Process numbers of all workers."""
        found = subprocess.run(
            ["ps", "-o", "pid=", "--ppid", str(self.process.pid)], capture_output=True, text=True, check=False
        )
        return {int(word) for word in found.stdout.split()}

    def stop(self) -> int:
        self.process.send_signal(signal.SIGINT)
        return self.process.wait(PATIENCE)


@contextlib.contextmanager
def run_studio(folder: Path, *words: str, code: str = "", cwd: Path | None = None) -> Iterator[Studio]:
    """Run `infill studio`, or code that serves it, with a temporary folder of its own."""
    environment = {**os.environ, "TMPDIR": str(folder), "PYTHONUNBUFFERED": "1"}
    command = [sys.executable, *(["-c", code] if code else ["-m", "infill.cli", "studio", "--no-browser", *words])]
    begin = time.perf_counter()
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment, cwd=cwd)
    assert process.stdout is not None
    try:
        address = process.stdout.readline().strip()
        seconds = time.perf_counter() - begin
        assert address.startswith("http://"), address
        yield Studio(process=process, address=address, seconds=seconds, folder=folder)
    finally:
        process.kill()
        process.wait()
        process.stdout.close()
