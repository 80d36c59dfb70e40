"""Volumes by URL, from a server on this machine: the bits of the file, and one line for whatever goes wrong."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import zarr

from infill.errors import FormatError
from infill.lazy.opening import open_volume
from tests.test_command_line import one_line_error, run

pytestmark = [pytest.mark.usefixtures("silent_compiler")]
pytest.importorskip("aiohttp", reason="URLs need aiohttp")

PLAIN = ("--threshold", "120", "--smooth", "plain", "--steps", "5", "--workers", "2", "-q")


class Quiet(SimpleHTTPRequestHandler):
    """A server of files that logs nothing, and breaks down for paths that hold a marked name."""

    broken: tuple[str, ...] = ()

    def log_message(self, *_: object) -> None:
        pass

    def do_GET(self) -> None:
        if any(mark in self.path for mark in self.broken):
            self.send_error(503)
            return
        super().do_GET()


@pytest.fixture
def served(tmp_path: Path) -> Iterator[str]:
    # A gyroid of 40 cells a side, in chunks of 16.
    cells = np.arange(40) * (2 * np.pi / 20)
    x, y, z = np.meshgrid(cells, cells, cells, indexing="ij")
    values = (128 + 80 * (np.sin(x) * np.cos(y) + np.sin(y) * np.cos(z) + np.sin(z) * np.cos(x))).astype(np.uint8)
    zarr.create_array(tmp_path / "g.zarr", shape=values.shape, chunks=(16, 16, 16), dtype="u1")[:] = values
    np.save(tmp_path / "g.npy", values)
    Quiet.broken = ()
    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(Quiet, directory=str(tmp_path)))
    thread = threading.Thread(target=server.serve_forever, daemon=True)
    thread.start()
    try:
        yield f"http://127.0.0.1:{server.server_port}"
    finally:
        server.shutdown()
        server.server_close()
        thread.join()


def test_a_volume_by_url_has_the_bits_of_the_file(served: str, tmp_path: Path) -> None:
    volume = open_volume(f"{served}/g.zarr")
    np.testing.assert_array_equal(volume.load().values, np.load(tmp_path / "g.npy"))


@pytest.mark.longest
def test_the_command_smooths_a_url(served: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    hashes = [run("smooth", name, *PLAIN, "--hash").stdout for name in (f"{served}/g.zarr", "g.zarr")]
    assert hashes[0] == hashes[1] != ""
    assert run("smooth", f"{served}/g.zarr", *PLAIN, "-o", "by_url.stl").exit_code == 0
    assert run("smooth", "g.zarr", *PLAIN, "-o", "by_path.stl").exit_code == 0
    assert (tmp_path / "by_url.stl").read_bytes() == (tmp_path / "by_path.stl").read_bytes()


@pytest.mark.parametrize("name", ["missing.zarr", "g.npy"])
def test_what_is_no_zarr_is_one_line(served: str, name: str) -> None:
    one_line_error(run("smooth", f"{served}/{name}", *PLAIN, "--hash"), name)


def test_a_server_that_is_not_there(served: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    result = run("smooth", "http://127.0.0.1:9/g.zarr", *PLAIN, "-o", "out.stl")  # the port that discards
    one_line_error(result, "http://127.0.0.1:9/g.zarr")
    assert not Path("out.stl").exists()


def test_a_chunk_that_the_server_cannot_send(served: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Quiet.broken = ("c/1/1/1",)
    result = run("smooth", f"{served}/g.zarr", *PLAIN, "-o", "out.stl")
    one_line_error(result, "g.zarr")
    assert not Path("out.stl").exists()
    with pytest.raises(FormatError):
        open_volume(f"{served}/g.zarr").load()


def test_urls_that_no_package_reads() -> None:
    result: Any = run("smooth", "nosuchscheme://bucket/g.zarr", *PLAIN, "--hash")
    one_line_error(result, "nosuchscheme://bucket/g.zarr")
