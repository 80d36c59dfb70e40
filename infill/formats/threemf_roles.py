"""Roles of volumes in a 3MF by object types and the settings of slicers: which are parts and which are not.

PrusaSlicer, SuperSlicer     ranges of triangles in Metadata/Slic3r_PE_model.config, by object
Bambu Studio, OrcaSlicer     components of the build, in Metadata/model_settings.config
Slic3r                       ranges of triangles beside the mesh
Cura                         settings of objects
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from xml.etree import ElementTree

from infill.formats.volume_settings import VolumeSettings, read_settings

PART, NEGATIVE, MODIFIER = "part", "negative", "modifier"
PRUSA_CONFIG, BAMBU_CONFIG = "Metadata/Slic3r_PE_model.config", "Metadata/model_settings.config"
PRUSA_ROLES = {
    "ModelPart": PART,
    "ParameterModifier": MODIFIER,
    "NegativeVolume": NEGATIVE,
    "SupportEnforcer": "support enforcer",
    "SupportBlocker": "support blocker",
}
BAMBU_ROLES = {
    "normal_part": PART,
    "modifier_part": MODIFIER,
    "negative_part": NEGATIVE,
    "support_enforcer": "support enforcer",
    "support_blocker": "support blocker",
}
CURA_ROLES = {
    "infill_mesh": MODIFIER,
    "cutting_mesh": "cutting mesh",
    "support_mesh": "support",
    "anti_overhang_mesh": "support blocker",
}
CURA_NAMESPACE = "http://software.ultimaker.com/xml/cura/3mf/2015/10"
NONE = VolumeSettings()
LONGEST_ID = 18  # digits of a number of an object


@dataclass(frozen=True, kw_only=True)
class TriangleRange:
    """A range of triangles of a mesh with a role.

    Parameters
    ----------
    first, last : str
        As in the file: counted from 0, both inclusive.
    role : str
    name : str
    settings : VolumeSettings
        Of its own.
    """

    first: str
    last: str
    role: str
    name: str
    settings: VolumeSettings = NONE

    def span(self, count: int) -> tuple[int, int] | None:
        """Return the first triangle and the one behind the last; None if a mesh with `count` triangles lacks them.

        >>> TriangleRange(first="0", last="11", role="part", name="").span(12)
        (0, 12)
        """
        first_index, last_index = whole_number(self.first), whole_number(self.last)
        return (first_index, last_index + 1) if 0 <= first_index <= last_index < count else None


def whole_number(text: str | None) -> int:
    """Convert a text of digits to a number; return -1 for other texts.

    >>> whole_number("12"), whole_number("-3"), whole_number("9" * 5000)
    (12, -1, -1)
    """
    fits = text is not None and text.isascii() and text.isdigit() and len(text) <= LONGEST_ID
    return int(text) if fits and text is not None else -1


def object_key(text: str | None) -> str:
    """Return the normalised number of an object: 01 becomes 1.

    >>> object_key(" 01"), object_key("a")
    ('1', 'a')
    """
    stripped = (text or "").strip()
    number = whole_number(stripped)
    return stripped if number < 0 else str(number)


def metadata_of(element: ElementTree.Element) -> dict[str, str]:
    """Return the metadata of an element of a settings file: values by key."""
    return {entry.get("key", ""): entry.get("value", "") for entry in element.findall("metadata")}


def prusa_role(volume: ElementTree.Element) -> str:
    """Return this package's role of a PrusaSlicer volume: the last row with a role counts; otherwise a part.

    >>> prusa_role(ElementTree.fromstring('<volume><metadata key="modifier" value="1"/></volume>'))
    'modifier'
    """
    role = PART
    for row in volume.findall("metadata"):
        key, value = row.get("key"), row.get("value", "")
        if key == "modifier" and value == "1":
            role = PRUSA_ROLES["ParameterModifier"]
        elif key == "volume_type":  # first versions wrote "1"; an unknown value is a part
            role = PRUSA_ROLES["ParameterModifier"] if value == "1" else PRUSA_ROLES.get(value, PART)
    return role


def prusa_volumes(config: ElementTree.Element, project: Mapping[str, str]) -> dict[str, list[TriangleRange]]:
    """Return the volumes of objects by object number; raise ValueError if an object occurs twice.

    Parameters
    ----------
    config : Element
    project : mapping
        The settings of the whole project, by key.
    """
    volumes_of: dict[str, list[TriangleRange]] = {}
    for item in config.findall("object"):
        key = object_key(item.get("id"))
        if key in volumes_of:
            raise ValueError(f"it describes object {key} twice")
        volumes_of[key] = [
            TriangleRange(
                first=volume.get("firstid", ""),
                last=volume.get("lastid", ""),
                role=prusa_role(volume),
                name=metadata_of(volume).get("name", ""),
                settings=read_settings(metadata_of(volume), project),
            )
            for volume in item.findall("volume")
        ]
    return volumes_of


def slic3r_volumes(mesh: ElementTree.Element) -> list[TriangleRange]:
    """Return the volumes that Slic3r added to a mesh."""
    return [
        TriangleRange(
            first=volume.get("ts", ""),
            last=volume.get("te", ""),
            role=PRUSA_ROLES["ParameterModifier"] if volume.get("modifier") == "1" else PART,
            name="",
        )
        for volumes in mesh
        if volumes.tag.endswith("}volumes") and "slic3r.org" in volumes.tag
        for volume in volumes
        if volume.tag.endswith("}volume")
    ]


def bambu_parts(
    config: ElementTree.Element, project: Mapping[str, str]
) -> dict[str, dict[str, tuple[str, str, VolumeSettings]]]:
    """Return role, name and settings of the parts of the build, by object and part number."""
    return {
        object_key(item.get("id")): {
            object_key(part.get("id")): (
                BAMBU_ROLES.get(part.get("subtype", "normal_part"), PART),
                metadata_of(part).get("name", ""),
                read_settings(metadata_of(part), project),
            )
            for part in item.findall("part")
        }
        for item in config.findall("object")
    }


def cura_role(settings: Mapping[str, str]) -> str:
    """Return the role of an object by its settings, whose names are {namespace}key or prefix:key."""
    own = cura_settings(settings)
    return next((role for key, role in CURA_ROLES.items() if own.get(key) == "True"), PART)


def cura_settings(settings: Mapping[str, str]) -> dict[str, str]:
    """Return the settings of Cura among those of an object, by key."""
    own = {name.removeprefix("cura:"): value for name, value in settings.items() if name.startswith("cura:")}
    namespace = f"{{{CURA_NAMESPACE}}}"
    return {
        **own,
        **{name.removeprefix(namespace): value for name, value in settings.items() if name.startswith(namespace)},
    }


def settings_of(element: ElementTree.Element, core: str, spaces: Mapping[str, str]) -> dict[str, str]:
    """Return the settings of an object by ``{namespace}key``, or ``prefix:key`` for an undeclared prefix."""
    settings = {}
    for name, value in _named_values(element, core):
        prefix, _, key = name.rpartition(":")
        settings[f"{{{spaces[prefix]}}}{key}" if prefix and prefix in spaces else name] = value
    return settings


def _named_values(element: ElementTree.Element, core: str) -> Iterator[tuple[str, str]]:
    """Yield the names and values of the settings of an object."""
    for entry in element.iterfind(f"{core}metadatagroup/{core}metadata"):
        yield entry.get("name", ""), entry.text or ""
    namespace = f"{{{CURA_NAMESPACE}}}"
    for entry in element.iterfind(f"{namespace}settings/{namespace}setting"):  # of the first versions
        yield f"cura:{entry.get('key', '')}", entry.text or ""


def is_part_type(kind: str | None) -> bool:
    """Tell whether an object type is a part: "model" or missing; others are supports, surfaces and aids."""
    return (kind or "model").strip().lower() == "model"


def is_unprinted(printable: str | None) -> bool:
    """Tell whether slicers exclude an item of the build from printing."""
    return (printable or "").strip().lower() in ("0", "false")
