"""A foreign host, Debian's printcore, prints what lamina sliced on `lamina emulate`, to the end and bead for bead.

Usage: printcore_prints.py LAMINA MODEL. Exit code 77: printrun is not installed.
"""

import json
import logging
import os
import signal
import subprocess
import sys
import tempfile
import time

try:
    from printrun import gcoder
    from printrun.printcore import printcore
except ImportError:
    print("printrun is not installed: skipped")
    sys.exit(77)

LIMIT = 90  # s


def wait_until(condition, what):
    deadline = time.monotonic() + LIMIT
    while not condition():
        if time.monotonic() > deadline:
            sys.exit(f"timed out: {what}")
        time.sleep(0.02)


def main():
    lamina, model = sys.argv[1:3]
    logging.disable(logging.CRITICAL)
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "print.gcode")
        planned = json.loads(subprocess.run(
            [lamina, "slice", model, "-q", "draft", "-o", path, "--json", "--quiet"],
            check=True, stdout=subprocess.PIPE).stdout)
        emulator = subprocess.Popen([lamina, "emulate", "--json", "--time-scale", "1000"],
                                    stdout=subprocess.PIPE, text=True)
        try:
            port = emulator.stdout.readline().strip()
            host = printcore()
            host.connect(port, 115200)
            wait_until(lambda: host.online, "printcore does not come online")
            with open(path, encoding="ascii") as file:
                host.startprint(gcoder.LightGCode(file.readlines()))
            wait_until(lambda: not host.printing, "the print does not end")
            # printcore calls a print over when the last line is sent; an answer after M400 means that it has run.
            answers = []
            host.recvcb = answers.append
            host.send("M400")
            host.send("M114")
            wait_until(lambda: any(line.startswith("X:") for line in answers), "no position at the end")
            host.disconnect()
        finally:
            emulator.send_signal(signal.SIGINT)
            report = json.loads(emulator.communicate(timeout=LIMIT)[0])
    print(json.dumps(report))
    deposited = report["filament_mm"]
    if abs(deposited - planned["filament_mm"]) > 0.005 * planned["filament_mm"]:
        sys.exit(f"{planned['filament_mm']} mm of filament planned, {deposited} mm deposited")
    if report["layers"] != planned["layers"]:
        sys.exit(f"{planned['layers']} layers planned, {report['layers']} printed")


if __name__ == "__main__":
    main()
