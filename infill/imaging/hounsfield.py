"""Hounsfield units: whether the values of a scan are some, and the thresholds of what is made from a CT.

In Hounsfield units, air is −1000 and water 0, by definition; fat lies from −190 to −30.

* `BONE`, 226: the lower end of bone of Ghosh and Pal, International Journal of Vehicle Safety 3 (2008), 165-181,
  doi:10.1504/IJVS.2008.022216, who take a femur from a CT by it. Spongy and very young bone may lie below.
* `SKIN`, −300: between air and fat, nearer to fat, so that a voxel that is mostly air, as of hair, is none. It is a
  round number without a source.
"""

from __future__ import annotations

from infill.plain_numbers import plain_argument

BONE = 226.0
SKIN = -300.0
AIR = -1000.0
LEAST_RANGE = 1500.0  # a CT reaches from air into bone
STORED = (-32768.0, 32767.0)  # values of a CT are stored in 16 bits


def seem_hounsfield(lowest: float, highest: float) -> bool:
    """Tell by the extremes of values whether they seem to be Hounsfield units.

    >>> seem_hounsfield(-1024, 3071), seem_hounsfield(0, 4095), seem_hounsfield(-1000, 400)
    (True, False, False)
    """
    return STORED[0] <= lowest <= AIR and lowest + LEAST_RANGE < highest <= STORED[1]


def describe_bone(lowest: float, highest: float) -> str:
    """Return advice on the threshold of bone, to end a sentence with; empty if the values seem to be no CT.

    >>> describe_bone(-1024, 3071), describe_bone(0, 255)
    ('; in a CT, bone is from about --threshold 226', '')
    """
    return (
        f"; in a CT, bone is from about --threshold {plain_argument(BONE)}" if seem_hounsfield(lowest, highest) else ""
    )


def name_thresholds(lowest: float, highest: float, otsu: float | None) -> list[dict[str, str | float]]:
    """List thresholds of a CT by name, those within the values, with Otsu's; none if the values seem to be no CT.

    >>> name_thresholds(-1024, 3071, -412.0)[0]
    {'name': 'Bone', 'value': 226.0}
    >>> name_thresholds(0, 255, 100.0)
    []
    """
    if not seem_hounsfield(lowest, highest):
        return []
    named = {"Bone": BONE, "Skin": SKIN, "Otsu": otsu}
    return [{"name": name, "value": value} for name, value in named.items() if value is not None and value < highest]
