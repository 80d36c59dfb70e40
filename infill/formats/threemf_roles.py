"""What is a part in a 3MF and what is not: types of objects, and the settings in which slicers say it.

PrusaSlicer, SuperSlicer     ranges of triangles in Metadata/Slic3r_PE_model.config, by object
Bambu Studio, OrcaSlicer     components of what is built, in Metadata/model_settings.config
Slic3r                       ranges of triangles beside the mesh
Cura                         settings of objects
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from xml.etree import ElementTree

PART, NEGATIVE = "part", "negative"
PRUSA_CONFIG, BAMBU_CONFIG = "Metadata/Slic3r_PE_model.config", "Metadata/model_settings.config"
PRUSA_ROLES = {
    "ModelPart": PART,
    "ParameterModifier": "modifier",
    "NegativeVolume": NEGATIVE,
    "SupportEnforcer": "support enforcer",
    "SupportBlocker": "support blocker",
}
BAMBU_ROLES = {
    "normal_part": PART,
    "modifier_part": "modifier",
    "negative_part": NEGATIVE,
    "support_enforcer": "support enforcer",
    "support_blocker": "support blocker",
}
CURA_ROLES = {
    "infill_mesh": "modifier",
    "cutting_mesh": "cutting mesh",
    "support_mesh": "support",
    "anti_overhang_mesh": "support blocker",
}
CURA_NAMESPACE = "http://software.ultimaker.com/xml/cura/3mf/2015/10"
LONGEST_ID = 18  # digits of a number of an object


@dataclass(frozen=True, kw_only=True)
class Volume:
    """Triangles of a mesh that have a role.

    Parameters
    ----------
    first, last : str
        As the file has them: from 0 on, both included.
    role : str
    name : str
    """

    first: str
    last: str
    role: str
    name: str

    def span(self, count: int) -> tuple[int, int] | None:
        """Return the first triangle and that behind the last; None if a mesh of so many has no such triangles.

        >>> Volume(first="0", last="11", role="part", name="").span(12)
        (0, 12)
        """
        first, last = whole_number(self.first), whole_number(self.last)
        return (first, last + 1) if 0 <= first <= last < count else None


def whole_number(text: str | None) -> int:
    """Return the number of a text of digits, or -1.

    >>> whole_number("12"), whole_number("-3"), whole_number("9" * 5000)
    (12, -1, -1)
    """
    fits = text is not None and text.isascii() and text.isdigit() and len(text) <= LONGEST_ID
    return int(text) if fits and text is not None else -1


def object_key(text: str | None) -> str:
    """Return by what number an object is known: 01 is 1.

    >>> object_key(" 01"), object_key("a")
    ('1', 'a')
    """
    plain = (text or "").strip()
    number = whole_number(plain)
    return plain if number < 0 else str(number)


def rows_of(element: ElementTree.Element) -> dict[str, str]:
    """Return the rows of a file of settings, by key."""
    return {each.get("key", ""): each.get("value", "") for each in element.findall("metadata")}


def prusa_role(volume: ElementTree.Element) -> str:
    """Return the role of a volume as PrusaSlicer reads it: the last row that says one counts.

    >>> prusa_role(ElementTree.fromstring('<volume><metadata key="modifier" value="1"/></volume>'))
    'modifier'
    """
    role = PART
    for row in volume.findall("metadata"):
        key, value = row.get("key"), row.get("value", "")
        if key == "modifier" and value == "1":
            role = PRUSA_ROLES["ParameterModifier"]
        elif key == "volume_type":  # "1" is how the first versions said it; what is unknown is a part
            role = PRUSA_ROLES["ParameterModifier"] if value == "1" else PRUSA_ROLES.get(value, PART)
    return role


def prusa_volumes(config: ElementTree.Element) -> dict[str, list[Volume]]:
    """Return the volumes of objects by their numbers; raise ValueError if it tells of one object twice."""
    found: dict[str, list[Volume]] = {}
    for each in config.findall("object"):
        key = object_key(each.get("id"))
        if key in found:
            raise ValueError(f"it tells of object {key} twice")
        found[key] = [
            Volume(
                first=volume.get("firstid", ""),
                last=volume.get("lastid", ""),
                role=prusa_role(volume),
                name=rows_of(volume).get("name", ""),
            )
            for volume in each.findall("volume")
        ]
    return found


def slic3r_volumes(mesh: ElementTree.Element) -> list[Volume]:
    """Return the volumes of a mesh that Slic3r wrote."""
    return [
        Volume(
            first=each.get("ts", ""),
            last=each.get("te", ""),
            role=PRUSA_ROLES["ParameterModifier"] if each.get("modifier") == "1" else PART,
            name="",
        )
        for volumes in mesh
        if volumes.tag.endswith("}volumes") and "slic3r.org" in volumes.tag
        for each in volumes
        if each.tag.endswith("}volume")
    ]


def bambu_parts(config: ElementTree.Element) -> dict[str, dict[str, tuple[str, str]]]:
    """Return role and name of the parts of what is built, by the numbers of both."""
    return {
        object_key(each.get("id")): {
            object_key(part.get("id")): (
                BAMBU_ROLES.get(part.get("subtype", "normal_part"), PART),
                rows_of(part).get("name", ""),
            )
            for part in each.findall("part")
        }
        for each in config.findall("object")
    }


def cura_role(settings: Mapping[str, str]) -> str:
    """Return the role of an object by its settings, whose names are {namespace}key or prefix:key."""
    for key, role in CURA_ROLES.items():
        if settings.get(f"{{{CURA_NAMESPACE}}}{key}", settings.get(f"cura:{key}")) == "True":
            return role
    return PART


def settings_of(element: ElementTree.Element, core: str, spaces: Mapping[str, str]) -> dict[str, str]:
    """Return the settings of an object by full name: ``{namespace}key``, or ``prefix:key`` if nobody declares it."""
    found = {}
    for name, value in _named_values(element, core):
        prefix, _, key = name.rpartition(":")
        found[f"{{{spaces[prefix]}}}{key}" if prefix and prefix in spaces else name] = value
    return found


def _named_values(element: ElementTree.Element, core: str) -> Iterator[tuple[str, str]]:
    for each in element.iterfind(f"{core}metadatagroup/{core}metadata"):
        yield each.get("name", ""), each.text or ""
    inside = f"{{{CURA_NAMESPACE}}}"
    for each in element.iterfind(f"{inside}settings/{inside}setting"):  # as the first versions had it
        yield f"cura:{each.get('key', '')}", each.text or ""


def is_part_type(kind: str | None) -> bool:
    """Return whether objects of a type are parts: "model" and none; the others are supports, surfaces and aids."""
    return (kind or "model").strip().lower() == "model"


def is_unprinted(printable: str | None) -> bool:
    """Return whether an item of the build is not to be printed, as slicers say it."""
    return (printable or "").strip().lower() in ("0", "false")
