"""Printrun's printcore, a host that knows nothing of lamina, for scripts that let it print.

Without printrun the importing script ends with exit code 77: skipped.
"""

import logging
import sys
import time

try:
    from printrun import gcoder
    from printrun.printcore import printcore
except ImportError:
    print("printrun is not installed: skipped", file=sys.stderr)
    sys.exit(77)


def wait_until(condition, limit, what, pause=0.02):
    """Ends the script where `condition` does not come true within `limit` seconds."""
    deadline = time.monotonic() + limit
    while not condition():
        if time.monotonic() > deadline:
            sys.exit(f"timed out: {what}")
        time.sleep(pause)


def connect(port, baud, limit):
    """A host that is online."""
    logging.disable(logging.CRITICAL)
    host = printcore()
    host.connect(port, baud)
    wait_until(lambda: host.online, limit, "printcore does not come online")
    return host


def start_print(host, lines):
    host.startprint(gcoder.LightGCode(lines))


def print_to_end(host, lines, limit):
    """printcore calls a print over when the last line is sent; an answer after M400 means that it has run."""
    start_print(host, lines)
    wait_until(lambda: not host.printing, limit, "the print does not end")
    answers = []
    host.recvcb = answers.append
    host.send("M400")
    host.send("M114")
    wait_until(lambda: any(line.startswith("X:") for line in answers), limit, "no position at the end")
