"""Prints a G-code file through Printrun's printcore and tells how fast it went.

usage: printcore_rate.py PORT BAUD FILE    prints "LINES SECONDS"; exit code 77: printrun is not installed
"""

import logging
import sys
import time

try:
    from printrun import gcoder
    from printrun.printcore import printcore
except ImportError:
    sys.exit(77)

LIMIT = 300  # s


def main():
    logging.disable(logging.CRITICAL)
    port, baud, path = sys.argv[1], int(sys.argv[2]), sys.argv[3]
    with open(path, encoding="ascii") as file:
        lines = file.read().splitlines()
    host = printcore()
    host.connect(port, baud)
    deadline = time.monotonic() + LIMIT
    while not host.online and time.monotonic() < deadline:
        time.sleep(0.01)
    # From the first chord on: what comes before waits for the machine.
    chords = [line for line in lines if line.startswith("G1 X") and " E" in line]
    for line in lines[: len(lines) - len(chords)]:
        host.send(line)
    time.sleep(3)
    start = time.monotonic()
    host.startprint(gcoder.LightGCode(chords))
    while host.printing and time.monotonic() < deadline:
        time.sleep(0.001)
    if host.printing:
        sys.exit("printcore does not come to an end")
    print(len(chords), time.monotonic() - start)
    host.disconnect()


main()
