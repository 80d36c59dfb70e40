"""Who may talk to the studio: the browser that got its address, and nothing else on the network or in other tabs.

Every address begins with a random token. The name of the host must be this machine's, so that a page elsewhere whose
name suddenly means 127.0.0.1 (DNS rebinding) gets nothing; and a request that another page sends is refused by its
origin.
"""

from __future__ import annotations

import ipaddress
import secrets
from dataclasses import dataclass
from typing import TYPE_CHECKING

from starlette.datastructures import Headers, MutableHeaders
from starlette.responses import PlainTextResponse

if TYPE_CHECKING:
    from starlette.types import ASGIApp, Message, Receive, Scope, Send

SECURITY_HEADERS = {
    "content-security-policy": "default-src 'self'; img-src 'self' data: blob:; style-src 'self'; object-src 'none'; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
    "referrer-policy": "no-referrer",
    "x-content-type-options": "nosniff",
    "cross-origin-opener-policy": "same-origin",
    "cross-origin-resource-policy": "same-origin",
    "cache-control": "no-store",
}
EVERYWHERE = ("0.0.0.0", "::")  # noqa: S104 - compared, not listened at
TOKEN_BYTES = 24
USUAL_PORT = "80"  # of http


def make_token() -> str:
    """Return a new random token, for addresses."""
    return secrets.token_urlsafe(TOKEN_BYTES)


@dataclass(frozen=True, kw_only=True)
class Guard:
    """Middleware: hand on requests to `/{token}/...` of this machine, and refuse all others.

    Parameters
    ----------
    app : ASGI application
        It sees paths without the token.
    token : str
    host : str
        As given to the command.
    port : int
    """

    app: ASGIApp
    token: str
    host: str
    port: int

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer one request."""
        if scope["type"] != "http":
            await self.app(scope, receive, send)
            return

        async def send_guarded(message: Message) -> None:
            """Send a message with the headers of security."""
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                for name, value in SECURITY_HEADERS.items():
                    headers[name] = value
            await send(message)

        headers = Headers(scope=scope)
        if not self._is_ours(headers):
            await PlainTextResponse("forbidden\n", status_code=403)(scope, receive, send_guarded)
            return
        first, _, rest = scope["path"].removeprefix("/").partition("/")
        has_slash = scope["path"].count("/") > 1
        if not has_slash or not secrets.compare_digest(first.encode(), self.token.encode()):
            await PlainTextResponse("not found\n", status_code=404)(scope, receive, send_guarded)
            return
        inner = {**scope, "path": f"/{rest}", "raw_path": f"/{rest}".encode(), "root_path": ""}
        await self.app(inner, receive, send_guarded)

    def _is_ours(self, headers: Headers) -> bool:
        """Tell whether host and origin of a request are those of the studio."""
        hosts, origins = headers.getlist("host"), headers.getlist("origin")
        if len(hosts) != 1 or not self.is_our_host(hosts[0]):
            return False
        return all(origin == f"http://{hosts[0]}" for origin in origins)

    def is_our_host(self, text: str) -> bool:
        """Tell whether a host with its port names this server; numbers of a machine cannot be rebound."""
        name, _, port = text.lower().rpartition(":")
        if not name or text.endswith("]"):  # browsers leave out the usual port
            name, port = text.lower(), USUAL_PORT
        if port != str(self.port):
            return False
        if name in ("127.0.0.1", "localhost", "[::1]") or name.strip("[]") == self.host.lower():
            return True
        if self.host not in EVERYWHERE:
            return False
        try:
            ipaddress.ip_address(name.strip("[]"))
        except ValueError:
            return False
        return True
