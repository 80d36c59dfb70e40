"""What all results have in common: a picture, which notebooks show."""

from __future__ import annotations

import contextlib
import io
from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, BinaryIO

from infill.errors import InfillError

if TYPE_CHECKING:
    from PIL import Image


class Picturable(ABC):
    """A result with a picture, which notebooks show."""

    @abstractmethod
    def picture(self) -> Image.Image:
        """Return the picture."""

    def write_picture(self, file: BinaryIO) -> None:
        """Write `picture` as PNG."""
        self.picture().save(file, format="PNG")

    def _repr_png_(self) -> bytes | None:
        """Return the picture for notebooks; None if it cannot be drawn any more."""
        with io.BytesIO() as file, contextlib.suppress(InfillError):
            self.write_picture(file)
            return file.getvalue()
        return None
