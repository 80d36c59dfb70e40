"""Run cases of one target in this process, which may crash: one line of JSON before and after each."""

from __future__ import annotations

import argparse
import json
import os
import shutil
import sys
from collections import Counter
from pathlib import Path
from random import Random

from tests.fuzzing.commands import describe
from tests.fuzzing.mutations import mutate
from tests.fuzzing.seeds import corpus_seeds
from tests.fuzzing.targets import TARGETS, Target

ADDRESSES = 12 * 2**30  # bytes that may be mapped: what protects the machine; 4 GiB that are used are a fault already


def seeds_of(target: Target) -> dict[str, bytes]:
    """Return the files that a target's cases begin with, those of the test data too where there are any."""
    files = target.make_seeds()
    home = os.environ.get("INFILL_DATA")
    if home and target.corpus:
        files |= {f"data-{name}": data for name, data in corpus_seeds(Path(home), target.corpus).items()}
    return dict(sorted(files.items()))


def make_case(name: str, seed: str, number: int, files: dict[str, bytes]) -> tuple[str, bytes, Random]:
    """Return the name and the bytes of a case, the same for the same numbers, and the generator for what follows."""
    rng = Random(f"{seed}/{name}/{number}")
    chosen = rng.choice(list(files))
    suffix = chosen.rpartition(".")[2]
    others = tuple(data for other, data in files.items() if other.rpartition(".")[2] == suffix)
    return chosen, mutate(chosen, files[chosen], rng, others), rng


def run_case(target: Target, chosen: str, data: bytes, rng: Random, folder: Path) -> list[str]:
    """Write a case and judge it; return its faults."""
    path = folder / "in" / chosen
    out = folder / "out"
    for each in (path.parent, out):
        shutil.rmtree(each, ignore_errors=True)
        each.mkdir(parents=True)
    path.write_bytes(data)
    try:
        return list(target.judge(path, out, rng))
    except BaseException as error:  # noqa: BLE001 - of the library, called by the judge
        return [f"escaped: {describe(error)}"]


def main() -> None:
    """Run the cases from `start` on, until there are `count`."""
    parser = argparse.ArgumentParser()
    parser.add_argument("target", choices=list(TARGETS))
    parser.add_argument("--seed", default="1")
    parser.add_argument("--start", type=int, default=0)
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--folder", type=Path, required=True)
    given = parser.parse_args()
    if sys.platform == "linux":
        import resource

        resource.setrlimit(resource.RLIMIT_AS, (ADDRESSES, ADDRESSES))
    talk = os.fdopen(os.dup(1), "w")
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # what libraries print
    target = TARGETS[given.target]
    files = seeds_of(target)
    for number in range(given.start, given.start + given.count):
        chosen, data, rng = make_case(given.target, given.seed, number, files)
        print(json.dumps({"begins": number}), file=talk, flush=True)
        faults = run_case(target, chosen, data, rng, given.folder)
        counts = dict(Counter(faults))
        print(json.dumps({"ends": number, "faults": sorted(counts)}), file=talk, flush=True)


if __name__ == "__main__":
    main()
