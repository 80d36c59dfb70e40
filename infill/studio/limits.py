"""Limits of the studio, for one page, one upload and one request."""

from __future__ import annotations

from dataclasses import asdict, dataclass

from infill.machine import GIB, available_memory

MOST_MEMORY = 8 * GIB
MEMORY_SHARE = 0.7  # of the free memory


@dataclass(frozen=True, kw_only=True)
class StudioLimits:
    """Limits of pages, uploads and requests.

    Parameters
    ----------
    upload_bytes : int
        Of one file.
    page_bytes : int
        Of all files of a page.
    files : int
        Of a page.
    seconds : float
        Of one request.
    memory_bytes : int
        Of one worker, beside its libraries.
    pages : int
        Open at the same time.
    request_bytes : int
        Of the options of one request.
    silent_seconds : float
        After which a page is gone that never opened its stream of life.
    cancel_seconds : float
        In which a cancelled request ends by itself; then its process is killed.
    """

    upload_bytes: int = GIB
    page_bytes: int = 4 * GIB
    files: int = 100
    seconds: float = 1800.0
    memory_bytes: int = 4 * GIB
    pages: int = 8
    request_bytes: int = 2**20
    silent_seconds: float = 60.0
    cancel_seconds: float = 1.0

    @classmethod
    def of_machine(cls) -> StudioLimits:
        """Return the limits that suit this machine."""
        free = available_memory()
        return cls() if free is None else cls(memory_bytes=int(min(MOST_MEMORY, max(GIB, MEMORY_SHARE * free))))

    def facts(self) -> dict[str, float]:
        """Return the limits as plain numbers."""
        return asdict(self)
