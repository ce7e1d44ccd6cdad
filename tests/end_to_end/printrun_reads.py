"""A foreign parser reads what lamina writes: Debian's printrun must find the same layers, box and filament.

Usage: printrun_reads.py LAMINA MODEL. Exit code 77: printrun is not installed.
"""

import contextlib
import io
import json
import logging
import os
import subprocess
import sys
import tempfile

try:
    from printrun import gcoder
except ImportError:
    print("printrun is not installed: skipped")
    sys.exit(77)


def close(name, ours, theirs, tolerance):
    print(f"{name}: lamina {ours}, printrun {theirs}")
    if abs(ours - theirs) > tolerance:
        sys.exit(f"{name} differs by more than {tolerance}")


def main():
    lamina, model = sys.argv[1:3]
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "print.gcode")
        report = json.loads(subprocess.run(
            [lamina, "slice", model, "-o", path, "--json", "--quiet"],
            check=True, stdout=subprocess.PIPE).stdout)

        complaints = io.StringIO()
        logging.basicConfig(stream=complaints, level=logging.WARNING)
        with contextlib.redirect_stderr(complaints), open(path, encoding="ascii") as file:
            print_file = gcoder.GCode(file)
        if complaints.getvalue():
            sys.exit("printrun complains: " + complaints.getvalue())

        close("layers", report["layers"], print_file.layers_count, 0)
        close("filament mm", report["filament_mm"], print_file.filament_length, 1e-3)
        box = report["nozzle_box_mm"]
        theirs = {"min": (print_file.xmin, print_file.ymin, print_file.zmin),
                  "max": (print_file.xmax, print_file.ymax, print_file.zmax)}
        for end in ("min", "max"):
            for axis in range(2):
                close(f"box {end} {'xy'[axis]}", box[end][axis], theirs[end][axis], 1e-3)
        close("height", box["max"][2], theirs["max"][2], 1e-3)


if __name__ == "__main__":
    main()
