"""Judge labels that were smoothed together: connections and distances both ways, in the words of a single scan."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from typing import TYPE_CHECKING

from infill.inspection.deviation import Deviation, Word
from infill.partition.volumes import SMALLEST
from infill.plain_numbers import count_noun, list_some
from infill.reports.common import Topology, declare
from infill.reports.smoothing import Distance
from infill.smoothing.comparing import LOST_HOLES, LOST_VOLUME, Differences, describe_counts, describe_thin

if TYPE_CHECKING:
    from infill.inspection.bricks import TopologyCheck
    from infill.inspection.partitions import PartitionCheck
    from infill.reports.smoothing import TogetherLabel

WORDS: tuple[Word, ...] = ("kept", "changed a little", "lost")  # from the best to the worst
PRECISION = 1e-4  # of a label's volume that counts as kept
SMALL_PRECISION, SMALL_LOST = 0.1, 0.5  # the same for labels under SMALLEST cells, and what counts as lost
MOST_NAMED = 3  # labels in the line of the summary


def is_volume_kept(change: float, cells: float) -> bool:
    """Whether the relative change of the volume of a label of some cells counts as none."""
    return abs(change) <= (PRECISION if cells >= SMALLEST else SMALL_PRECISION)


def is_volume_lost(change: float, cells: float) -> bool:
    """Whether the relative change of the volume of a label of some cells makes a loss."""
    return abs(change) >= (LOST_VOLUME if cells >= SMALLEST else SMALL_LOST)


def describe_volume(change: float) -> str:
    """Say by how much the volume of a label changes."""
    return f"its volume changes by {change:+z.2%}"


def find_label_differences(
    topology: TopologyCheck, deviation: Deviation | None, change: float, cells: float
) -> Differences:
    """Judge a label: return the verdict with its losses, problems and remarks.

    Parameters
    ----------
    topology : TopologyCheck
    deviation : Deviation or None
        None if both surfaces are sure to be near everywhere.
    change : float
        Relative change of its volume.
    cells : float
        Its cells in the data.
    """
    losses: list[str] = []
    remarks: list[str] = []
    if deviation:
        (losses if deviation.word == "lost" else remarks).extend(deviation.phrases)
        if deviation.thin_distance:
            phrase, is_lost = describe_thin(deviation, "walls or gaps one voxel thick", "are gone", counts=True)
            (losses if is_lost else remarks).append(phrase)
    new_holes = topology.changes.walls_pierced
    problems: list[str] = []
    if new_holes >= max(LOST_HOLES, topology.data.tunnels):
        losses.append(f"{new_holes:,} pinholes broke through walls")
    else:
        problems += topology.problems
    if not is_volume_kept(change, cells):
        (losses if is_volume_lost(change, cells) else problems).append(describe_volume(change))
    fewer = describe_counts(topology)
    are_counts_off = topology.data.components != topology.result.components
    problems += fewer[:are_counts_off]  # the first is about components
    remarks += fewer[are_counts_off:]
    if (new := topology.result.cavities - topology.data.cavities) > 0:
        remarks.append(f"{count_noun(new, 'cavity is', 'cavities are')} new")
    word: Word = "lost" if losses else "changed a little" if problems or remarks else "kept"
    return Differences(word=word, losses=tuple(losses), problems=tuple(problems), remarks=tuple(remarks))


def label_distance(check: PartitionCheck, number: int) -> Distance:
    """Measure the distances between both surfaces of a label, both ways, for the report."""
    deviation = check.exact_deviation(number)
    return {
        "from": "voxels",
        "result": deviation.there.facts(),
        "input": deviation.back.facts(),
        "thin": deviation.thin_area,
        "sheet": 0.0,
        "hidden": 0.0,
    }


def label_topology(topology: TopologyCheck) -> Topology:
    """Return the connections of a label, for the report."""
    return declare(Topology, {"data": asdict(topology.data), "result": asdict(topology.result)})


def summarise_verdicts(labels: Sequence[TogetherLabel], gone: Sequence[str]) -> str:
    """Say in one line how many labels are kept, and name the others, the worst first.

    Parameters
    ----------
    labels : sequence of TogetherLabel
    gone : sequence of str
        Names of the labels of which nothing is left.
    """
    names: dict[str, list[str]] = {word: [] for word in WORDS}
    names["lost"] += gone
    for label in labels:
        names[label["verdict"]["word"]].append(label["name"])
    phrases = []
    for word in reversed(WORDS):
        if not names[word]:
            continue
        listed = "" if word == "kept" else f" ({list_some(names[word], MOST_NAMED)})"
        phrases.append(f"{len(names[word]):,} {word}{listed}")
    return ", ".join(phrases)
