"""Printrun's printcore, a host that knows nothing of lamina, prints on the emulated printer to the end.

usage: printcore_prints.py [--hangs] EMULATOR [FAULT...]    (EMULATOR serves an emulated printer on a pty)
With --hangs it must not come to the end: printcore waits for a lost ok for ever, on a real Marlin as here.
exit codes: 0 as expected, 1 not so, 77 printrun is not installed (skipped)
"""

import math
import pathlib
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools" / "bench"))
from printcore_host import connect, print_to_end, start_print  # noqa: E402

CHORDS = 300
EXTRUSION = 0.03125
LIMIT = 60  # s
HANGS_FOR = 5  # s without a line sent


def sample():
    lines = ["; sample", "G21", "G90", "M83", "M140 S50", "M104 S200", "G28", "M190 S50", "M109 S200", "G1 Z0.2 F600",
             "G1 X60 Y50 F6000"]
    for i in range(1, CHORDS + 1):
        angle = i * 2 * math.pi / 60
        lines.append(f"G1 X{50 + 10 * math.cos(angle):.3f} Y{50 + 10 * math.sin(angle):.3f} E{EXTRUSION:.5f} F1800")
    return lines + ["M104 S0", "M140 S0", "M84", "M400"]


def wait_until_it_hangs(host):
    sent, since = host.queueindex, time.monotonic()
    while time.monotonic() - since < HANGS_FOR:
        if not host.printing:
            sys.exit("the print came to its end although an ok was lost")
        if host.queueindex != sent:
            sent, since = host.queueindex, time.monotonic()
        time.sleep(0.05)
    print(f"printcore hangs at line {sent} of {CHORDS}")


def main():
    hangs = sys.argv[1] == "--hangs"
    command = sys.argv[2:] if hangs else sys.argv[1:]
    emulator = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    try:
        path = emulator.stdout.readline().strip()
        host = connect(path, 115200, LIMIT)
        if hangs:
            start_print(host, sample())
            wait_until_it_hangs(host)
            host.cancelprint()
            host.disconnect()
            return
        print_to_end(host, sample(), LIMIT)
        host.disconnect()
    finally:
        report, _ = emulator.communicate(timeout=LIMIT)
    print(report.strip())
    words = report.split()
    figures = dict(zip(words[::2], words[1::2]))
    # A host that sends on while an error is being told lets the firmware run line tails; without faults it must be exact.
    clean = len(command) == 1
    if clean and (int(figures["beads"]) != CHORDS or int(figures["refused"]) != 0):
        sys.exit(f"{CHORDS} beads and no refused line were to be expected")
    if clean and abs(float(figures["filament"]) - CHORDS * EXTRUSION) > 1e-3:
        sys.exit(f"{CHORDS * EXTRUSION} mm of filament were to be expected")
    if not clean and int(figures["refused"]) == 0:
        sys.exit("no line was damaged: the faults were not there")
    if int(figures["beads"]) < CHORDS:
        sys.exit("beads are missing")


main()
