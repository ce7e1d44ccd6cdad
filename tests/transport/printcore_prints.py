"""Printrun's printcore, a host that knows nothing of lamina, prints on the emulated printer to the end.

usage: printcore_prints.py EMULATOR [--flip RATE]    (EMULATOR: the program that serves an emulated printer on a pty)
exit codes: 0 it did, 1 it did not, 77 printrun is not installed (skipped)
"""

import logging
import math
import subprocess
import sys
import time

try:
    from printrun import gcoder
    from printrun.printcore import printcore
except ImportError:
    print("printrun is not installed: skipped")
    sys.exit(77)

CHORDS = 300
EXTRUSION = 0.03125
LIMIT = 60  # s


def sample():
    lines = ["; sample", "G21", "G90", "M83", "M140 S50", "M104 S200", "G28", "M190 S50", "M109 S200", "G1 Z0.2 F600",
             "G1 X60 Y50 F6000"]
    for i in range(1, CHORDS + 1):
        angle = i * 2 * math.pi / 60
        lines.append(f"G1 X{50 + 10 * math.cos(angle):.3f} Y{50 + 10 * math.sin(angle):.3f} E{EXTRUSION:.5f} F1800")
    return lines + ["M104 S0", "M140 S0", "M84", "M400"]


def wait_until(condition, what):
    deadline = time.monotonic() + LIMIT
    while not condition():
        if time.monotonic() > deadline:
            sys.exit(f"timed out: {what}")
        time.sleep(0.02)


def main():
    logging.disable(logging.CRITICAL)
    emulator = subprocess.Popen(sys.argv[1:], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    try:
        path = emulator.stdout.readline().strip()
        host = printcore()
        host.connect(path, 115200)
        wait_until(lambda: host.online, "printcore does not come online")
        host.startprint(gcoder.LightGCode(sample()))
        wait_until(lambda: not host.printing, "the print does not end")
        # printcore calls a print over when the last line is sent; an answer to M400 means that it has run.
        answers = []
        host.recvcb = answers.append
        host.send("M400")
        host.send("M114")
        wait_until(lambda: any(line.startswith("X:") for line in answers), "no position at the end")
        host.disconnect()
    finally:
        report, _ = emulator.communicate(timeout=LIMIT)
    print(report.strip())
    words = report.split()
    figures = dict(zip(words[::2], words[1::2]))
    # A host that sends on while an error is being told lets the firmware run line tails; without faults it must be exact.
    clean = len(sys.argv) == 2
    if clean and (int(figures["beads"]) != CHORDS or int(figures["refused"]) != 0):
        sys.exit(f"{CHORDS} beads and no refused line were to be expected")
    if clean and abs(float(figures["filament"]) - CHORDS * EXTRUSION) > 1e-3:
        sys.exit(f"{CHORDS * EXTRUSION} mm of filament were to be expected")
    if not clean and int(figures["refused"]) == 0:
        sys.exit("no line was damaged: the faults were not there")
    if int(figures["beads"]) < CHORDS:
        sys.exit("beads are missing")


main()
