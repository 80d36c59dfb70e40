"""A report whose sections come late is a dict like any other."""

from __future__ import annotations

import copy
import json
import pickle
from collections.abc import Callable
from typing import Any

import pytest

from infill.reports.sections import Sections

WHOLE = {"volume": 2.0, "distance": {"max": 0.5}, "area": 3.0}


def late() -> Sections:
    return Sections({"volume": 2.0, "distance": None, "area": 3.0}, {"distance": lambda: {"max": 0.5}})


READERS: list[Callable[[Sections], Any]] = [
    dict,
    copy.copy,
    copy.deepcopy,
    lambda report: report,
    lambda report: report.copy(),
    lambda report: {**report},
    lambda report: {} | report,
    lambda report: report | {},
    lambda report: dict(report.items()),
    lambda report: dict(zip(report, report.values(), strict=True)),
    lambda report: {name: report.get(name) for name in report},
    lambda report: json.loads(json.dumps(report)),
    lambda report: json.loads(json.dumps(report, indent=2)),
    lambda report: pickle.loads(pickle.dumps(report)),
    lambda report: eval(repr(report)),
]


@pytest.mark.parametrize("read", READERS)
def test_every_reader_sees_every_section(read: Callable[[Sections], Any]) -> None:
    found = read(late())
    assert found == WHOLE
    assert list(found) == list(WHOLE)


def test_a_section_is_computed_once_and_only_if_it_is_asked_for() -> None:
    asked = []
    report = Sections({"a": 1, "b": None}, {"b": lambda: asked.append(1) or 5})
    assert report["a"] == 1
    assert "b" in report
    assert len(report) == 2
    assert asked == []
    assert (report["b"], report["b"], report.get("b")) == (5, 5, 5)
    assert asked == [1]


def test_what_is_set_or_deleted_is_not_computed() -> None:
    report = late()
    report["distance"] = 7
    assert (report.pop("distance"), report.get("distance", 8)) == (7, 8)
    gone = late()
    del gone["distance"]
    assert gone == {"volume": 2.0, "area": 3.0}
    assert late() != gone
    assert late().popitem() == ("area", 3.0)
