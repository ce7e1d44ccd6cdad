"""Prints a G-code file through Printrun's printcore and tells how fast it went.

usage: printcore_rate.py PORT BAUD FILE    prints "LINES SECONDS"; exit code 77: printrun is not installed
"""

import sys
import time

from printcore_host import connect, start_print, wait_until

LIMIT = 300  # s


def main():
    port, baud, path = sys.argv[1], int(sys.argv[2]), sys.argv[3]
    with open(path, encoding="ascii") as file:
        lines = file.read().splitlines()
    host = connect(port, baud, LIMIT)
    # From the first chord on: what comes before waits for the machine.
    chords = [line for line in lines if line.startswith("G1 X") and " E" in line]
    for line in lines[: len(lines) - len(chords)]:
        host.send(line)
    time.sleep(3)
    start = time.monotonic()
    start_print(host, chords)
    wait_until(lambda: not host.printing, LIMIT, "printcore does not come to an end", 0.001)
    print(len(chords), time.monotonic() - start)
    host.disconnect()


main()
