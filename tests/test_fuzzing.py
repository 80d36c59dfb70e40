"""Some dozen mutated files of every kind, the same in every run, and the judge itself: it sees what is planted."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from random import Random

import pytest
import trimesh

from infill.errors import FormatError
from tests.fuzzing.campaign import ROOT, run_cases
from tests.fuzzing.commands import Answer, faults_of
from tests.fuzzing.mutations import mutate
from tests.fuzzing.targets import TARGETS
from tests.fuzzing.worker import make_case, run_case, seeds_of

CASES = {
    "meshes": 200,
    "volumes": 60,
    "points": 30,
    "drawings": 20,
    "prints": 50,
    "fields": 40,
    "printers": 50,
    "settings": 30,
}


@pytest.mark.longest
@pytest.mark.parametrize("name", CASES)
def test_no_mutated_file_does_what_none_may(name: str, compiled: None) -> None:
    """No traceback, no hang, no gigabytes, no half-written file, nothing that every other reader contradicts."""
    found = run_cases(name, seed="suite", count=CASES[name])
    assert found.cases == CASES[name]
    assert found.faults == {}


SEEDS = """
import json, sys
from pathlib import Path
from random import Random
from tests.fuzzing.targets import TARGETS
from tests.fuzzing.worker import run_case
target = TARGETS[sys.argv[1]]
seeds = target.make_seeds().items()
found = {name: run_case(target, name, data, Random(1), Path(sys.argv[2]) / "case") for name, data in seeds}
(Path(sys.argv[2]) / "found.json").write_text(json.dumps(found))
"""


@pytest.mark.longest
@pytest.mark.parametrize("name", CASES)
def test_whole_seeds_are_read(name: str, compiled: None, tmp_path: Path) -> None:
    """Each is a file that its command takes, and reads as others do: mutations begin from what works."""
    subprocess.run([sys.executable, "-c", SEEDS, name, str(tmp_path)], cwd=ROOT, check=True, capture_output=True)
    found = json.loads((tmp_path / "found.json").read_text())
    assert len(found) > 1
    assert not any(found.values()), found


DIGESTS = """
import hashlib, json
from tests.fuzzing.targets import TARGETS
seeds = {name: repr(sorted(target.make_seeds().items())).encode() for name, target in TARGETS.items()}
print(json.dumps({name: hashlib.md5(text).hexdigest() for name, text in seeds.items()}))
"""


@pytest.mark.longest
def test_seeds_are_the_same_in_every_run() -> None:
    """Whatever the time of day, and whatever the order of sets: a finding can be made again by its numbers."""
    answers = []
    for seed in ("1", "2"):
        words = [sys.executable, "-c", DIGESTS]
        environment = {**os.environ, "PYTHONHASHSEED": seed}
        answers.append(subprocess.run(words, cwd=ROOT, check=True, capture_output=True, env=environment).stdout)
        time.sleep(2)  # the clock of a ZIP file
    assert answers[0] == answers[1]
    assert set(json.loads(answers[0])) == set(TARGETS)


def test_a_case_is_the_same_for_the_same_numbers() -> None:
    files = seeds_of(TARGETS["meshes"])
    cases = [make_case("meshes", "a", 5, files)[:2] for _ in range(2)]
    assert cases[0] == cases[1]
    others = {make_case("meshes", "a", number, files)[1] for number in range(40)}
    assert len(others) > 30


@pytest.mark.slow
@pytest.mark.parametrize("name", TARGETS)
def test_mutations_break_files(name: str) -> None:
    """Most are unlike their seed, and none takes a generator elsewhere."""
    for chosen, data in TARGETS[name].make_seeds().items():
        broken = [mutate(chosen, data, Random(k)) for k in range(20)]
        assert broken == [mutate(chosen, data, Random(k)) for k in range(20)]
        assert sum(each != data for each in broken) >= 12, chosen


# --- the judge sees what is planted ----------------------------------------------------------------------


BOX = trimesh.creation.box((9, 9, 9)).export(file_type="stl")


def judged(folder: Path, data: bytes = BOX, seed: int = 1) -> list[str]:
    """Judge a box; the generator is one whose case is only checked."""
    return run_case(TARGETS["meshes"], "box.stl", data, Random(seed), folder)


def planted(monkeypatch: pytest.MonkeyPatch, act: Callable[[Path], object]) -> None:
    """Have the reader of STL do something."""
    from infill.formats import mesh_files

    monkeypatch.setitem(mesh_files.READERS, ".stl", act)


def test_a_whole_box_has_no_fault(tmp_path: Path) -> None:
    assert judged(tmp_path) == []


LIE = """
import sys
from pathlib import Path
from random import Random
import numpy as np
from infill.formats import mesh_files
from tests.fuzzing.targets import TARGETS
from tests.fuzzing.worker import run_case
read = mesh_files.READERS[".stl"]
def add_a_fifth(path):
    vertices, *others = read(path)
    return np.asarray(vertices) * 1.2, *others
mesh_files.READERS[".stl"] = add_a_fifth
print(run_case(TARGETS["meshes"], "box.stl", sys.stdin.buffer.read(), Random(1), Path(sys.argv[1])))
"""


@pytest.mark.longest
def test_a_size_that_every_other_reader_contradicts_is_a_fault(tmp_path: Path) -> None:
    words = [sys.executable, "-c", LIE, str(tmp_path / "case")]
    answer = subprocess.run(words, cwd=ROOT, check=True, capture_output=True, input=BOX, timeout=100)
    assert b"extents, which trimesh and meshio contradict" in answer.stdout, answer.stdout


def test_an_exception_is_a_fault(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(path: Path) -> None:
        raise RecursionError("planted")

    from infill.inspection import printability

    monkeypatch.setattr(printability, "read_mesh", fail)
    (fault,) = judged(tmp_path)
    assert fault.startswith("escaped: RecursionError")


def test_a_control_character_is_a_fault() -> None:
    faults = list(faults_of(Answer(status=1, out="", err="error: \x1b[31m is no number\n", seconds=0, peak=0)))
    assert faults == ["control character '\\x1b'"]


@pytest.mark.parametrize(
    ("answer", "fault"),
    [
        (Answer(status=1, out="", err="", seconds=0, peak=0), "0 lines of error with exit status 1"),
        (
            Answer(status=1, out="", err="error: a\nerror: b\n", seconds=0, peak=0),
            "2 lines of error with exit status 1",
        ),
        (Answer(status=3, out="", err="", seconds=0, peak=0), "exit status 3"),
        (Answer(status=0, out="", err="", seconds=21, peak=0), "took over 20 s"),
        (Answer(status=0, out="", err="", seconds=0, peak=5 * 2**30), "took over 4 GiB"),
    ],
)
def test_what_no_answer_may_be_is_a_fault(answer: Answer, fault: str) -> None:
    assert list(faults_of(answer)) == [fault]
    good = Answer(status=1, out=json.dumps({}), err="error: there is no file; check the name\n", seconds=1, peak=10**9)
    assert list(faults_of(good)) == []


def test_a_process_that_dies_or_hangs_is_a_fault_and_the_next_goes_on(monkeypatch: pytest.MonkeyPatch) -> None:
    """Workers that are scripts: the first dies in its second case, the next hangs, the last ends."""
    from tests.fuzzing import campaign

    say = "import json,os,time,signal; p=lambda **w: print(json.dumps(w), flush=True); "
    scripts = iter(
        [
            say + "p(begins=0); p(ends=0, faults=[]); p(begins=1); os.kill(os.getpid(), signal.SIGSEGV)",
            say + "p(begins=2); time.sleep(60)",
            say + "p(begins=3); p(ends=3, faults=['planted'])",
        ]
    )
    real = campaign.subprocess.Popen

    def start(words: list[str], **options: object) -> object:
        return real([words[0], "-c", next(scripts)], **options)

    monkeypatch.setattr(campaign.subprocess, "Popen", start)
    monkeypatch.setattr(campaign, "HANGS", 3.0)
    begin = time.monotonic()
    found = campaign.run_cases("meshes", seed="1", count=4)
    assert time.monotonic() - begin < 40
    assert found.cases == 4
    assert found.faults == {1: ["the process died (SIGSEGV)"], 2: ["hung for 3 s"], 3: ["planted"]}


def test_our_errors_are_no_faults(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(path: Path) -> None:
        raise FormatError(f"{path} is broken; export it again")

    planted(monkeypatch, refuse)
    assert judged(tmp_path) == []
