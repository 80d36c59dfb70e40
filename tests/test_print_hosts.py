"""Scripts for OctoPrint, Moonraker and a print farm, against stand-ins that have the names their hosts publish."""

from __future__ import annotations

import hashlib
import importlib.util
import io
import json
import os
import shutil
import subprocess
import sys
import threading
from collections.abc import Iterator
from email.parser import BytesParser
from email.policy import HTTP
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from handmade_prints import Dialect, written

from infill import refill

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"
PRINT = written(Dialect(layers=3))
PROGRAM = Path(sys.executable).with_name("infill")


# --- OctoPrint ------------------------------------------------------------------------------------------


class StreamWrapper:
    """As `octoprint.filemanager.util` has it: a name, and streams that are saved one after another."""

    def __init__(self, filename: str, *streams: Any) -> None:
        self.filename = filename
        self.streams = streams

    def stream(self) -> Any:
        return self.streams[0]


@pytest.fixture
def plugin(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    manager, util = ModuleType("octoprint.filemanager"), ModuleType("octoprint.filemanager.util")
    manager.valid_file_type = lambda path, **kind: path.endswith(f".{kind['type']}")  # type: ignore[attr-defined]
    util.StreamWrapper = StreamWrapper  # type: ignore[attr-defined]
    for name, module in (("octoprint", ModuleType("octoprint")), (manager.__name__, manager), (util.__name__, util)):
        monkeypatch.setitem(sys.modules, name, module)
    spec = importlib.util.spec_from_file_location("octoprint_refill", EXAMPLES / "printers" / "octoprint_refill.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    monkeypatch.setenv("INFILL", str(PROGRAM))
    return module


def uploaded(plugin: ModuleType, name: str, data: bytes) -> bytes:
    hook = plugin.__plugin_hooks__["octoprint.filemanager.preprocessor"]
    wrapper = hook(name, StreamWrapper(name, io.BytesIO(data)), links=None, printer_profile=None, allow_overwrite=True)
    assert wrapper.filename == name
    with wrapper.stream() as stream:
        return stream.read()


@pytest.mark.longest
@pytest.mark.skipif(not PROGRAM.exists(), reason="the command is not beside Python here")
def test_octoprint_gets_a_refilled_print(plugin: ModuleType, real_print: Path, tmp_path: Path) -> None:
    sliced = real_print.read_bytes()
    refill(real_print, output=tmp_path / "refilled.gcode")
    assert uploaded(plugin, "part.gcode", sliced) == (tmp_path / "refilled.gcode").read_bytes() != sliced
    assert uploaded(plugin, "empty.gcode", b"no print\n") == b"no print\n"


def test_octoprint_gets_what_was_uploaded_if_refill_fails(
    plugin: ModuleType, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    assert uploaded(plugin, "part.stl", b"solid") == b"solid"
    for program in (tmp_path / "none", Path(sys.executable)):  # which knows no command refill
        monkeypatch.setenv("INFILL", str(program))
        assert uploaded(plugin, "part.gcode", PRINT) == PRINT


# --- Moonraker ------------------------------------------------------------------------------------------


class Uploads(BaseHTTPRequestHandler):
    """Reads an upload by the names in Moonraker's page on its file manager."""

    forms: list[dict[str, bytes]]
    keys: list[str | None]

    def do_POST(self) -> None:
        body = self.rfile.read(int(self.headers["Content-Length"]))
        head = f"Content-Type: {self.headers['Content-Type']}\r\n\r\n".encode()
        message = BytesParser(policy=HTTP).parsebytes(head + body)
        form, name = {}, ""
        for part in message.iter_parts():
            field = part.get_param("name", header="content-disposition")
            form[field] = part.get_payload(decode=True).removesuffix(b"\r\n") if field != "file" else body
            name = part.get_filename() or name
        self.forms.append({**form, "name": name.encode()})
        self.keys.append(self.headers["X-Api-Key"])
        status = 201 if self.path == "/server/files/upload" and "refuse" not in name else 403
        answer = {"item": {"path": name, "root": "gcodes"}, "print_started": form["print"] == b"true"}
        self.send_response(status)
        self.end_headers()
        self.wfile.write(json.dumps(answer).encode())

    def log_message(self, *args: Any) -> None: ...


@pytest.fixture
def moonraker() -> Iterator[tuple[str, type[Uploads]]]:
    class Handler(Uploads):
        forms: list[dict[str, bytes]] = []  # noqa: RUF012 - of this server
        keys: list[str | None] = []  # noqa: RUF012

    server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    thread = threading.Thread(target=server.serve_forever)
    thread.start()
    yield f"http://127.0.0.1:{server.server_port}", Handler
    server.shutdown()
    thread.join()
    server.server_close()


def send(*words: str | Path) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, EXAMPLES / "printers" / "send_to_moonraker.py", *words]
    return subprocess.run(command, capture_output=True, text=True, check=False)


@pytest.mark.longest
def test_moonraker_gets_a_refilled_print(
    moonraker: tuple[str, type[Uploads]], real_print: Path, tmp_path: Path
) -> None:
    address, handler = moonraker
    sliced, expected = tmp_path / "part.gcode", tmp_path / "expected.gcode"
    sliced.write_bytes(real_print.read_bytes())
    refill(sliced, output=expected)
    done = send(sliced, address, "--print", "--key", "secret")
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("sent part.gcode")
    assert "printing" in done.stdout
    (form,) = handler.forms
    assert form["root"] == b"gcodes"
    assert form["checksum"].decode() == hashlib.sha256(expected.read_bytes()).hexdigest()
    assert expected.read_bytes() in form["file"]
    assert handler.keys == ["secret"]
    assert sliced.read_bytes() == real_print.read_bytes()

    refused = tmp_path / "refuse.gcode"
    refused.write_bytes(PRINT)
    assert "refused the file: 403" in send(refused, address).stderr
    (tmp_path / "bad.gcode").write_bytes(b"no print\n")
    for words in (("bad.gcode", address), ("none.gcode", address), ("part.gcode", "printer")):
        failed = send(tmp_path / words[0], words[1])
        assert failed.returncode == 1
        assert failed.stderr.startswith("error: ")
        assert failed.stderr.count("\n") == 1
    assert len(handler.forms) == 2


# --- a print farm ----------------------------------------------------------------------------------------


@pytest.mark.longest
@pytest.mark.skipif(shutil.which("make") is None or not PROGRAM.exists(), reason="no make here")
def test_the_makefile_refills_what_is_new(tmp_path: Path) -> None:
    shutil.copy(EXAMPLES / "farm" / "Makefile", tmp_path)
    (tmp_path / "sliced").mkdir()
    (tmp_path / "sliced" / "part.gcode").write_bytes(PRINT)

    def make(*words: str) -> subprocess.CompletedProcess[str]:
        command = ["make", f"INFILL={PROGRAM}", *words]
        return subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False, env=os.environ)

    done = make()
    assert done.returncode == 0, done.stderr
    refilled = (tmp_path / "prints" / "part.gcode").read_bytes()
    assert refilled != PRINT
    assert "Nothing to be done" in make("all").stdout
    assert make("check").returncode == 0
    assert "part.gcode" in make("times").stdout
    (tmp_path / "sliced" / "bad.gcode").write_text("no print\n")
    assert make().returncode == 2
    assert [path.name for path in (tmp_path / "prints").iterdir()] == ["part.gcode"]
