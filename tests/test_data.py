"""`make data` fetches the right files, whole or not at all."""

from __future__ import annotations

import hashlib
import subprocess
import sys
import threading
from collections.abc import Iterator
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path, PurePosixPath

import pytest
from conftest import Data, known_data

pooch = pytest.importorskip("pooch")
ROOT = Path(__file__).resolve().parents[1]
SCRIPT = ROOT / "tools" / "fetch_data.py"
CONTENT = b"solid cube\nendsolid cube\n"


class Quiet(SimpleHTTPRequestHandler):
    def log_message(self, *_: object) -> None: ...


@pytest.fixture
def server(tmp_path: Path) -> Iterator[str]:
    """A server on this machine that has one file, /models/cube.stl."""
    (tmp_path / "served" / "models").mkdir(parents=True)
    (tmp_path / "served" / "models" / "cube.stl").write_bytes(CONTENT)
    with ThreadingHTTPServer(("127.0.0.1", 0), partial(Quiet, directory=tmp_path / "served")) as httpd:
        thread = threading.Thread(target=httpd.serve_forever)
        thread.start()
        yield f"http://127.0.0.1:{httpd.server_port}"
        httpd.shutdown()
        thread.join()


def fetch(tmp_path: Path, *files: tuple[str, str, bytes]) -> subprocess.CompletedProcess[str]:
    """Run the script on a table of files: path, address, content expected."""
    table = tmp_path / "data.toml"
    entries = [
        f'[[public]]\npath = "{path}"\nurl = "{url}"\nsha256 = "{hashlib.sha256(content).hexdigest()}"\n'
        f'bytes = {len(content)}\nlicence = "MIT"\n'
        for path, url, content in files
    ]
    other = '[[other]]\npath = "models/ours.stl"\nhow = "by hand"\nsha256 = "0"\nlicence = "MIT"\n'
    table.write_text("\n".join([*entries, other]))
    command = [sys.executable, SCRIPT, tmp_path / "here", "--table", table]
    return subprocess.run(command, capture_output=True, encoding="utf-8", timeout=60)


def left(tmp_path: Path) -> list[str]:
    return sorted(path.name for path in (tmp_path / "here").rglob("*") if path.is_file())


@pytest.mark.slow
def test_a_file_comes_once(server: str, tmp_path: Path) -> None:
    cube = ("models/cube.stl", f"{server}/models/cube.stl", CONTENT)
    first = fetch(tmp_path, cube)
    assert (first.returncode, first.stdout.strip()) == (0, str(tmp_path / "here")), first.stderr
    assert (tmp_path / "here" / "models" / "cube.stl").read_bytes() == CONTENT
    assert left(tmp_path) == ["cube.stl"]
    assert "[1/1] models/cube.stl" in first.stderr
    assert "1 more files are served by no address" in first.stderr

    (tmp_path / "served" / "models" / "cube.stl").unlink()
    again = fetch(tmp_path, cube)
    assert again.returncode == 0
    assert "1 of 1 files are in" in again.stderr
    assert "[1/1]" not in again.stderr


@pytest.mark.slow
def test_another_file_under_the_name_is_fetched_anew(server: str, tmp_path: Path) -> None:
    (tmp_path / "here" / "models").mkdir(parents=True)
    (tmp_path / "here" / "models" / "cube.stl").write_bytes(b"of old")
    assert fetch(tmp_path, ("models/cube.stl", f"{server}/models/cube.stl", CONTENT)).returncode == 0
    assert (tmp_path / "here" / "models" / "cube.stl").read_bytes() == CONTENT


@pytest.mark.slow
def test_another_hash_is_refused_and_the_rest_is_fetched(server: str, tmp_path: Path) -> None:
    url = f"{server}/models/cube.stl"
    done = fetch(tmp_path, ("models/changed.stl", url, b"as it was"), ("models/cube.stl", url, CONTENT))
    assert done.returncode == 1
    errors = [line for line in done.stderr.splitlines() if "error" in line]
    assert errors == [f"error: {url} is another file than it was (sha256 differs); models/changed.stl is left out"]
    assert left(tmp_path) == ["cube.stl"]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("address", "reason"), [("{}/gone.stl", "answers 404"), ("http://127.0.0.1:9/a", "be reached")]
)
def test_what_cannot_be_had_is_one_line(server: str, tmp_path: Path, address: str, reason: str) -> None:
    done = fetch(tmp_path, ("models/gone.stl", address.format(server), CONTENT))
    assert done.returncode == 1
    assert "Traceback" not in done.stderr
    assert [line for line in done.stderr.splitlines() if line.startswith("error") and reason in line]
    assert left(tmp_path) == []


def test_the_table_is_sound() -> None:
    import tomllib

    table = tomllib.loads((ROOT / "tools" / "data.toml").read_text(encoding="utf-8"))
    entries = [*table["public"], *table["other"]]
    paths = [entry["path"] for entry in entries]
    assert len(set(paths)) == len(paths) > 50
    for entry in entries:
        assert entry["licence"]
        assert len(bytes.fromhex(entry["sha256"])) == 32
        assert not PurePosixPath(entry["path"]).is_absolute()
        assert ".." not in PurePosixPath(entry["path"]).parts
    for entry in table["public"]:
        assert entry["url"].startswith("https://")
        assert entry["bytes"] >= 0
    for entry in table["other"]:
        assert entry["how"]


def test_the_data_are_those_of_the_table(data: Path) -> None:
    import tomllib

    table = tomllib.loads((ROOT / "tools" / "data.toml").read_text(encoding="utf-8"))
    for entry in [*table["public"], *table["other"]]:
        path = Path(data, entry["path"])
        if path.exists():
            assert hashlib.sha256(path.read_bytes()).hexdigest() == entry["sha256"], path


def test_a_test_whose_file_was_not_fetched_skips(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("INFILL_DATA", str(tmp_path))
    (tmp_path / "nasty").mkdir()
    for name in ("empty_0bytes.stl", "misspelt.stl"):
        assert (f"nasty/{name}" in known_data()) is (name == "empty_0bytes.stl")
    with pytest.raises(pytest.skip.Exception, match="make data"):
        Data(tmp_path) / "nasty" / "empty_0bytes.stl"
    with pytest.raises(pytest.skip.Exception, match="make data"):
        Data(tmp_path) / "models"
    assert not (Data(tmp_path) / "nasty" / "misspelt.stl").exists()  # fails where it is read, as it should
