"""A plug-in for OctoPrint: every print that is uploaded gets round infill; what cannot be refilled stays as it is.

Copy this file into OctoPrint's folder of plug-ins, ~/.octoprint/plugins on most systems, and start OctoPrint again. It
runs the command `infill`, which may be installed anywhere: set INFILL to its path where OctoPrint does not find it, and
INFILL_REFILL to options, such as "--pattern honeycomb --density same".
"""

import logging
import os
import shlex
import shutil
import subprocess
import tempfile
from pathlib import Path

from octoprint.filemanager import valid_file_type
from octoprint.filemanager.util import StreamWrapper

LONGEST = 1800  # s
LOG = logging.getLogger("octoprint.plugins.refill")


def refill_upload(path, file_object, *args, **kwargs):  # noqa: ARG001 - OctoPrint's signature, which may grow
    """Return the upload with its infill refilled, or the same bytes if that fails."""
    if not valid_file_type(path, type="gcode"):
        return file_object
    with tempfile.TemporaryDirectory(prefix="infill-") as folder:
        sliced, refilled = Path(folder, "sliced.gcode"), Path(folder, "refilled.gcode")
        with open(sliced, "wb") as file:
            shutil.copyfileobj(file_object.stream(), file)
        try:
            words = [os.environ.get("INFILL", "infill"), "refill", str(sliced), "-o", str(refilled)]
            words += shlex.split(os.environ.get("INFILL_REFILL", ""))
            done = subprocess.run(words, capture_output=True, text=True, timeout=LONGEST, check=False)
            problem = done.stderr.strip() if done.returncode else ""
        except (OSError, ValueError, subprocess.TimeoutExpired) as error:
            problem = str(error)
        if problem or not refilled.is_file():
            LOG.warning("%s is uploaded as it was sliced: %s", file_object.filename, problem or "nothing was written")
            refilled = sliced
        else:
            LOG.info("%s: %s", file_object.filename, done.stderr)
        stream = tempfile.TemporaryFile()  # noqa: SIM115 - OctoPrint reads it after this function
        with open(refilled, "rb") as file:
            shutil.copyfileobj(file, stream)
    stream.seek(0)
    return StreamWrapper(file_object.filename, stream)


__plugin_name__ = "Round infill"
__plugin_version__ = "0.1.0"
__plugin_description__ = "Gives the infill of uploaded prints round corners, or another pattern, by infill refill."
__plugin_license__ = "MIT"
__plugin_pythoncompat__ = ">=3.7,<4"
__plugin_hooks__ = {"octoprint.filemanager.preprocessor": refill_upload}
