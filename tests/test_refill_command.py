"""`infill refill` as a slicer or a user calls it: in place or beside, reports, one line for every mistake, and a log."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any, BinaryIO

import pytest
from slicers import missing_prusa
from test_architecture import modules_after
from test_binary_gcode import made, parts
from test_command_line import one_line_error, refused, run, usage_error

from infill.gcode.binary import Block, Kind, decode_block, encode_block, pack_block, read_blocks
from infill.gcode.meatpack import normalise_text
from tests.gcode_judge import changed, judge
from tests.handmade_prints import Dialect, written
from tests.prints import PRINT as SETTINGS
from tests.prints import box

RUN = [sys.executable, "-m", "infill.cli"]
PRINT = written(Dialect(layers=5))
PICTURE = b"\x89PNG\r\n\x1a\n" + bytes(2000)
STAMP = b"; refilled by phasefill"

LAYER = re.compile(rb"^;LAYER_CHANGE$", re.MULTILINE)


@pytest.fixture
def gcode(tmp_path: Path) -> Path:
    """A small print, alone in a folder."""
    path = tmp_path / "my print.gcode"
    path.write_bytes(PRINT)
    return path


def log_of(path: Path) -> Path:
    return path.with_name(f"{path.name}.refill.log")


def logged(result: Any, log: Path) -> None:
    """The log holds the line that the command said, which names the log."""
    assert result.stderr.endswith(f" (log: {log})\n")
    line = result.stderr.splitlines(keepends=True)[-1]
    assert log.read_text(encoding="utf-8") == line.replace(f" (log: {log})", "")


def names(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


def layers_of(data: bytes) -> list[bytes]:
    """Return the head of a print, then its layers."""
    return LAYER.split(data)


# --- where it writes -------------------------------------------------------------------------------------


@pytest.mark.slow
def test_without_an_output_the_print_itself_is_replaced(gcode: Path) -> None:
    result = run("refill", gcode)
    assert result.exit_code == 0
    assert result.stdout == ""
    new = gcode.read_bytes()
    assert new.count(STAMP) == 1
    assert judge(PRINT, new, filament=(0.85, 1.003)) == []
    assert changed(PRINT, new) == 3
    assert names(gcode.parent) == [gcode.name]
    assert "3 of 3 sections in 5 layers" in result.stderr


@pytest.mark.slow
def test_an_output_leaves_the_print_as_it_was(gcode: Path, tmp_path: Path) -> None:
    """And has the bytes that the print has when it is replaced in place."""
    output = tmp_path / "new" / "smooth.gcode"
    output.parent.mkdir()
    assert run("refill", gcode, "-o", output).exit_code == 0
    assert gcode.read_bytes() == PRINT
    assert names(output.parent) == [output.name]
    assert run("refill", gcode).exit_code == 0
    assert gcode.read_bytes() == output.read_bytes()


@pytest.mark.slow
def test_an_existing_output_is_kept_without_force(gcode: Path, tmp_path: Path) -> None:
    output = tmp_path / "old.gcode"
    output.write_bytes(b"precious")
    one_line_error(run("refill", gcode, "-o", output), "old.gcode exists; give another name, or --force")
    for name in ("new.stl", "new.bgcode", "new.3mf"):  # names that promise another form, which a printer may refuse
        one_line_error(
            run("refill", gcode, "-o", tmp_path / name),
            f"{name} is not a name for G-code as text, which a refilled {gcode.name} is; give new.gcode",
        )
        assert not (tmp_path / name).exists()
    assert output.read_bytes() == b"precious"
    assert names(tmp_path) == [gcode.name, output.name]  # a log is for slicers, which replace in place
    assert run("refill", gcode, "-o", output, "--force").exit_code == 0
    assert STAMP in output.read_bytes()


@pytest.mark.slow
def test_a_dry_run_writes_nothing(gcode: Path) -> None:
    result = run("refill", gcode, "--dry-run")
    assert result.exit_code == 0
    assert "3 of 3 sections" in result.stderr
    assert "wrote" not in result.stderr
    assert gcode.read_bytes() == PRINT
    assert names(gcode.parent) == [gcode.name]


@pytest.mark.slow
def test_a_second_run_says_that_there_is_nothing_to_do(gcode: Path) -> None:
    assert run("refill", gcode).exit_code == 0
    once = gcode.read_bytes()
    result = run("refill", gcode)
    assert result.exit_code == 0
    assert "it was refilled before" in result.stderr
    assert gcode.read_bytes() == once


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="permissions as POSIX has them")
@pytest.mark.parametrize("mode", [0o600, 0o755])
def test_permissions_are_kept(mode: int, gcode: Path) -> None:
    gcode.chmod(mode)
    assert run("refill", gcode).exit_code == 0
    assert STAMP in gcode.read_bytes()
    assert gcode.stat().st_mode & 0o7777 == mode


@pytest.mark.skipif(sys.platform == "win32", reason="links need a privilege there")
def test_a_link_is_followed(gcode: Path, tmp_path: Path) -> None:
    """The link stays a link, and what it leads to is refilled, where it lies."""
    folder = tmp_path / "elsewhere"
    folder.mkdir()
    target = gcode.rename(folder / "part.gcode")
    gcode.symlink_to(target)
    assert run("refill", gcode).exit_code == 0
    assert gcode.is_symlink()
    assert STAMP in target.read_bytes()
    assert names(folder) == [target.name]


@pytest.mark.slow
@pytest.mark.parametrize("name", ["1234.gcode.pp", ".PrusaSlicer.upload.1a2b-3c4d", "größe (2).gcode"])
def test_names_as_slicers_give_them(name: str, gcode: Path) -> None:
    """A file that is exported ends in .pp, one that is uploaded in anything."""
    path = gcode.rename(gcode.with_name(name))
    assert run("refill", path).exit_code == 0
    assert STAMP in path.read_bytes()


@pytest.mark.slow
def test_binary_gcode_stays_binary(tmp_path: Path) -> None:
    """Under a name that says nothing of it, as PrusaSlicer hands it to a script: as MeatPack within Heatshrink."""
    text = normalise_text(PRINT, comments=True)
    path = tmp_path / "1234.gcode.pp"
    path.write_bytes(b"".join(parts([pack_block(encode_block(text, like=made(compression=3, encoding=2)))])))
    pictures = [block.data for block in blocks_of(path) if block.kind == Kind.THUMBNAIL]
    result = run("refill", path)
    assert result.exit_code == 0, result.stderr
    assert "3 of 3 sections" in result.stderr
    new = b"".join(decode_block(block) for block in blocks_of(path) if block.kind == Kind.GCODE)
    assert new.count(STAMP) == 1
    assert judge(text, new, filament=(0.85, 1.003)) == []
    assert [block.data for block in blocks_of(path) if block.kind == Kind.THUMBNAIL] == pictures
    once = path.read_bytes()
    assert "it was refilled before" in run("refill", path).stderr
    assert path.read_bytes() == once


def blocks_of(path: Path) -> list[Block]:
    with path.open("rb") as file:
        return list(read_blocks(file))


# --- what it says ----------------------------------------------------------------------------------------


@pytest.mark.slow
def test_json_is_alone_on_stdout(gcode: Path, tmp_path: Path) -> None:
    output = tmp_path / "new.gcode"
    result = run("refill", gcode, "-o", output, "--json", "-q")
    assert result.stderr == ""
    report = json.loads(result.stdout)
    assert report["files"] == [str(output)]
    assert report["sections"] == {"all": 3, "replaced": 3, "kept": {}}
    before, after = report["filament"]["infill_before_mm"], report["filament"]["infill_after_mm"]
    density = report["filament"]["density_for_the_same_percent"]
    assert density == pytest.approx(15 * before / after, abs=0.006)  # of the slicer's 15 %, in hundredths
    assert report["time"]["infill_after_s"] < report["time"]["infill_before_s"]
    assert report["problems"] == []


@pytest.mark.slow
def test_the_summary_names_the_density_to_set(gcode: Path) -> None:
    report = json.loads(run("refill", gcode, "--dry-run", "--json", "-q").stdout)
    density = report["filament"]["density_for_the_same_percent"]
    assert f"set {density:g} % in the slicer" in run("refill", gcode, "--dry-run").stderr


@pytest.mark.slow
def test_nothing_is_said_when_asked_to_be_quiet(gcode: Path) -> None:
    result = run("refill", gcode, "-q")
    assert (result.stdout, result.stderr) == ("", "")
    assert STAMP in gcode.read_bytes()


@pytest.mark.slow
@pytest.mark.parametrize(("words", "layers"), [("2-3", {2, 3}), ("4-", {4}), ("3", {3}), ("1-1", set())])
def test_only_the_layers_that_are_asked_for_change(words: str, layers: set[int], gcode: Path, tmp_path: Path) -> None:
    """Of five layers, the first and the last are solid."""
    output = tmp_path / "some.gcode"
    assert run("refill", gcode, "-o", output, "--layers", words).exit_code == 0
    old, new = layers_of(PRINT), layers_of(output.read_bytes())
    assert len(old) == len(new) == 6
    # What tells the time left changes in every layer.
    told = re.compile(rb"^M73.*$", re.MULTILINE)
    different = {number for number in range(1, 6) if told.sub(b"", old[number]) != told.sub(b"", new[number])}
    assert different - {5} == layers  # after the last layer, the print tells its time and its filament


@pytest.mark.slow
@pytest.mark.parametrize(("words", "layer"), [([], 2), (["--layers", "3-4"], 3), (["--layers", "1-1"], 1)])
def test_the_preview_shows_a_layer_that_is_asked_for(
    words: list[str], layer: int, gcode: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The middle one, or of those asked for the one that is nearest to it."""
    shown: list[str] = []

    def write(layers: Mapping[str, object], file: BinaryIO) -> None:
        shown.extend(layers)
        file.write(PICTURE)

    monkeypatch.setattr("infill.pictures.speeds.write_speeds", write)
    result = run("refill", gcode, "--preview", tmp_path / "layer.png", *words)
    assert result.exit_code == 0
    assert re.search(rf"^  wrote .*{re.escape(str(tmp_path / 'layer.png'))}$", result.stderr, re.MULTILINE)
    assert shown == [f"layer {layer}, before", f"layer {layer}, refilled"]


@pytest.mark.slow
def test_a_picture_that_is_in_the_way_leaves_the_print_alone(gcode: Path, tmp_path: Path) -> None:
    picture = tmp_path / "layer.png"
    picture.write_bytes(PICTURE)
    result = run("refill", gcode, "--preview", picture)
    assert result.exit_code == 1
    logged(result, log_of(gcode))
    assert picture.read_bytes() == PICTURE
    assert gcode.read_bytes() == PRINT


# --- mistakes --------------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["--smooth-radius", "wide"], "--smooth-radius is 'wide'; give auto, or a number in mm"),
        (["--smooth-radius", "-1"], "--smooth-radius is -1"),
        (["--max-deviation", "1000"], "--max-deviation is 1000"),
        (["--density", "150%"], "--density is '150%'; give same, or a share such as 20%"),
        (["--density", "20%"], "--density only works with --pattern NAME; to change the slicer's own infill"),
        (["--layers", "ten"], "--layers is 'ten'; give a range such as 5-20"),
        (["--layers", "9-2"], "--layers is 9 to 2; count from 1, the lower one first"),
        (["--pattern", "honycomb"], "there is no pattern 'honycomb'; did you mean 'honeycomb'"),
    ],
)
def test_a_mistake_is_one_line_and_a_log(words: list[str], says: str, gcode: Path) -> None:
    result = run("refill", gcode, *words)
    refused(result, re.escape(says))
    assert gcode.read_bytes() == PRINT
    logged(result, log_of(gcode))
    assert names(gcode.parent) == sorted([gcode.name, log_of(gcode).name])


def test_what_is_no_print_is_one_line_and_a_log(gcode: Path) -> None:
    gcode.write_bytes(PICTURE)
    result = run("refill", gcode)
    one_line_error(result, "the file is a picture; give the G-code that a slicer wrote, as text")
    assert gcode.read_bytes() == PICTURE
    logged(result, log_of(gcode))


@pytest.mark.slow
def test_the_log_lies_beside_what_the_slicer_is_about_to_write(
    gcode: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where the user looks, not among the temporary files; a run that succeeds removes it there."""
    target = tmp_path / "exported" / "part.gcode"
    target.parent.mkdir()
    monkeypatch.setenv("SLIC3R_PP_OUTPUT_NAME", str(target))
    result = run("refill", gcode, "--layers", "ten")
    usage_error(result, "error: --layers is 'ten'")
    logged(result, log_of(target))
    assert names(gcode.parent) == ["exported", gcode.name]
    assert run("refill", gcode).exit_code == 0
    assert names(target.parent) == []


@pytest.mark.slow
@pytest.mark.parametrize("name", ["part.gcode", "{0}/no such folder/part.gcode", "/", ""])
def test_the_log_lies_beside_the_file_where_the_slicer_names_no_folder(
    name: str, gcode: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A name on a printer that is uploaded to says nothing of a folder here."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("SLIC3R_PP_OUTPUT_NAME", name.format(tmp_path))
    logged(run("refill", gcode, "--layers", "ten"), log_of(gcode))
    assert names(tmp_path) == sorted([gcode.name, log_of(gcode).name])


def test_the_log_lies_beside_the_file_where_it_cannot_lie_beside_the_other(
    gcode: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    target = tmp_path / "part.gcode"
    log_of(target).mkdir()
    monkeypatch.setenv("SLIC3R_PP_OUTPUT_NAME", str(target))
    logged(run("refill", gcode, "--layers", "ten"), log_of(gcode))


@pytest.mark.slow
def test_a_run_that_succeeds_removes_the_log_of_one_that_failed(gcode: Path) -> None:
    run("refill", gcode, "--layers", "ten")
    assert log_of(gcode).exists()
    assert run("refill", gcode).exit_code == 0
    assert names(gcode.parent) == [gcode.name]


def test_no_log_where_nothing_is_replaced_in_place(gcode: Path, tmp_path: Path) -> None:
    for words in (["--dry-run"], ["-o", tmp_path / "new.gcode"]):
        usage_error(run("refill", gcode, "--layers", "ten", *words), "--layers")
        assert names(tmp_path) == [gcode.name]


def test_a_print_that_is_not_there_leaves_nothing(tmp_path: Path) -> None:
    one_line_error(run("refill", tmp_path / "none.gcode"), "there is no file .*none.gcode; check the name")
    assert names(tmp_path) == []


@pytest.mark.slow
@pytest.mark.parametrize("words", [[], ["one.gcode", "two.gcode", "-o", "x.gcode"], ["one.gcode", "--sharp"]])
def test_wrong_usage_exits_2(words: list[str]) -> None:
    assert run("refill", *words).exit_code == 2


# --- how it starts ---------------------------------------------------------------------------------------


@pytest.mark.longest
def test_keeping_paths_needs_no_library_of_geometry_or_pictures(gcode: Path) -> None:
    """They take longer to load than a small print. Compiled loops are loaded: they save more than that on any print."""
    code = f"import sys; sys.argv = ['infill', 'refill', {str(gcode)!r}, '-q']; import infill.cli; infill.cli.main()"
    loaded = modules_after(code)
    assert STAMP in gcode.read_bytes()
    assert "infill.refilling.job" in loaded
    assert not {"skimage", "trimesh", "manifold3d", "shapely", "PIL", "scipy.spatial", "scipy.ndimage"} & loaded


def test_a_command_builds_no_other() -> None:
    from infill.cli.app import COMMANDS, build_app

    for name in COMMANDS:
        assert [command.name for command in build_app(name).registered_commands] == [name]
    for name in ("", "nonsense", "--help"):
        assert [command.name for command in build_app(name).registered_commands] == list(COMMANDS)


@pytest.mark.longest
@pytest.mark.skipif(sys.platform == "win32", reason="times of the processor as POSIX has them")
def test_it_starts_fast(tmp_path: Path) -> None:
    """Little more until it reads than what any program with typer, pydantic and NumPy takes to begin.

    Seconds of the processor, not of the clock, the best of three; the margin is for a machine that is busy.
    """
    import resource

    def seconds(*words: str) -> float:
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run([sys.executable, *words], stderr=subprocess.DEVNULL, check=False)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime

    nothing = str(tmp_path / "none.gcode")  # where it would read, it ends
    runs = [
        (seconds("-m", "infill.cli", "refill", nothing), seconds("-c", "import typer._adapters, numpy"))
        for _ in range(3)
    ]
    ours, begin = map(min, zip(*runs, strict=True))
    assert ours < 1.4 * begin


# --- as a slicer calls it --------------------------------------------------------------------------------

SMALL: Mapping[str, object] = {**SETTINGS, "top_solid_layers": 2, "bottom_solid_layers": 2}


def sliced(folder: Path, *, script: str, **settings: str) -> subprocess.CompletedProcess[str]:
    """Slice a box with PrusaSlicer, which runs a script of ours on what it wrote."""
    ini = folder / "print.ini"
    ini.write_text("".join(f"{name} = {value}\n" for name, value in {**SMALL, **settings}.items()))
    command = ["prusa-slicer", "--datadir", str(folder / "settings"), "--load", str(ini), "--export-gcode"]
    command += ["--post-process", script] if script else []
    command += ["-o", str(folder / "out.gcode"), str(box(folder, (20, 20, 4)))]
    return subprocess.run(command, capture_output=True, encoding="utf-8", errors="replace", timeout=120, check=False)


@pytest.fixture(scope="module")
def program(tmp_path_factory: pytest.TempPathFactory) -> str:
    """What to paste: a path with a blank in it, quoted, then the command.

    In settings and on its command line PrusaSlicer takes double quotes for its own; the shell that it runs takes both.
    """
    folder = tmp_path_factory.mktemp("a folder")
    path = folder / "infill"
    path.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m infill.cli "$@"\n')
    path.chmod(0o755)
    return f"'{path}' refill"


@pytest.mark.longest
@pytest.mark.skipif(bool(missing_prusa()), reason=missing_prusa())
def test_prusaslicer_runs_it(program: str, tmp_path: Path) -> None:
    done = sliced(tmp_path, script=program)
    assert done.returncode == 0, done.stdout + done.stderr
    new = (tmp_path / "out.gcode").read_bytes()
    assert new.count(STAMP) == 1
    assert not log_of(tmp_path / "out.gcode").exists()
    replaced, sections = map(
        int, re.search(STAMP + rb" \S+: (\d+) of (\d+) sections, keep [0-9a-f]{8}\n", new).groups()
    )
    assert replaced == sections == 16  # of 20 layers, four are solid


@pytest.mark.longest
@pytest.mark.skipif(bool(missing_prusa()), reason=missing_prusa())
def test_a_settings_file_has_quotes_within_quotes(program: str, tmp_path: Path) -> None:
    """As on Windows, where only double quotes keep a path with blanks together."""
    path = program.removesuffix(" refill").strip("'")
    done = sliced(tmp_path, script="", post_process=rf'"\"{path}\" refill"')
    assert done.returncode == 0, done.stdout + done.stderr
    assert (tmp_path / "out.gcode").read_bytes().count(STAMP) == 1


@pytest.mark.longest
@pytest.mark.skipif(bool(missing_prusa()), reason=missing_prusa())
def test_prusaslicer_tells_what_went_wrong(program: str, tmp_path: Path) -> None:
    done = sliced(tmp_path, script=program + " --layers ten")
    said = done.stdout + done.stderr
    assert done.returncode != 0, said
    assert "--layers is 'ten'; give a range such as 5-20" in said
    assert "give a range" in log_of(tmp_path / "out.gcode").read_text(encoding="utf-8")
