"""A foreign host, Debian's printcore, prints what lamina sliced on `lamina emulate`, to the end and bead for bead.

Usage: printcore_prints.py LAMINA MODEL. Exit code 77: printrun is not installed.
"""

import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools" / "bench"))
from printcore_host import connect, print_to_end  # noqa: E402

LIMIT = 90  # s


def main():
    lamina, model = sys.argv[1:3]
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "print.gcode")
        planned = json.loads(subprocess.run(
            [lamina, "slice", model, "-q", "draft", "-o", path, "--json", "--quiet"],
            check=True, stdout=subprocess.PIPE).stdout)
        emulator = subprocess.Popen([lamina, "emulate", "--json", "--time-scale", "1000"],
                                    stdout=subprocess.PIPE, text=True)
        try:
            port = emulator.stdout.readline().strip()
            host = connect(port, 115200, LIMIT)
            with open(path, encoding="ascii") as file:
                print_to_end(host, file.readlines(), LIMIT)
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
