"""Refill a print and send it to Moonraker, for Mainsail and Fluidd: only if infill verify finds nothing else changed.

python examples/printers/send_to_moonraker.py print.gcode http://printer.local [--print] [--key KEY]
"""

import argparse
import hashlib
import json
import sys
import tempfile
import urllib.error
import urllib.request
import uuid
from pathlib import Path

from infill import InfillError, refill, verify


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("gcode", type=Path)
    parser.add_argument("printer", help="address of Moonraker, such as http://printer.local or http://10.0.0.7:7125")
    parser.add_argument("--print", action="store_true", dest="start", help="start the print, too")
    parser.add_argument("--key", default="", help="API key, where Moonraker wants one")
    options = parser.parse_args()
    try:
        with tempfile.TemporaryDirectory() as folder:
            refilled = Path(folder, options.gcode.name)
            report = refill(options.gcode, output=refilled).report
            if violations := verify(options.gcode, refilled).violations:
                print(f"error: not sent, since more than the infill changed: {violations[0]}", file=sys.stderr)
                return 1
            answer = send(refilled, options.printer, start=options.start, key=options.key)
    except (InfillError, OSError, ValueError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    seconds = report.get("time", {}).get("print_after_s")
    saved = "" if seconds is None else f", {seconds / 60:.0f} minutes"
    print(f"sent {answer['item']['path']}{saved}{', printing' if answer.get('print_started') else ''}")
    return 0


def send(path: Path, printer: str, *, start: bool, key: str) -> dict:
    """Upload a file to the folder of prints; return the answer of Moonraker."""
    data = path.read_bytes()
    fields = {"root": "gcodes", "checksum": hashlib.sha256(data).hexdigest(), "print": "true" if start else "false"}
    border = uuid.uuid4().hex
    name = path.name.replace('"', "_")
    parts = [
        f'--{border}\r\nContent-Disposition: form-data; name="{field}"\r\n\r\n{value}\r\n'
        for field, value in fields.items()
    ]
    parts.append(
        f'--{border}\r\nContent-Disposition: form-data; name="file"; filename="{name}"\r\n'
        "Content-Type: application/octet-stream\r\n\r\n"
    )
    body = "".join(parts).encode() + data + f"\r\n--{border}--\r\n".encode()
    headers = {"Content-Type": f"multipart/form-data; boundary={border}", **({"X-Api-Key": key} if key else {})}
    address = f"{printer.rstrip('/')}/server/files/upload"
    if not address.startswith(("http://", "https://")):
        raise ValueError(f"{printer} is not an address; give one such as http://printer.local")
    request = urllib.request.Request(address, data=body, headers=headers, method="POST")  # noqa: S310 - checked
    try:
        with urllib.request.urlopen(request, timeout=120) as response:  # noqa: S310
            answer: dict = json.loads(response.read())
    except urllib.error.HTTPError as error:
        raise ValueError(f"Moonraker refused the file: {error.code} {error.reason}") from error
    return answer


if __name__ == "__main__":
    sys.exit(main())
