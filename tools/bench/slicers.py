"""Contours of sphere and torus against the true circles: lamina from a file of a few kilobytes, the other slicers from meshes.

Usage: slicers.py LAMINA CORPUS [--chord MM ...] [--quick]

The measure is the same for all: points every 0.02 mm along the outer walls, moved out by half of the bead, their
distance from the circle of the exact solid at the layer's mid height, on layers whose surface is steeper than 45
degrees. lamina's contours are measured as they are, too. Meshes are regular grids whose chords are off by at most the
given distance. Prints averages and maxima in micrometres, wall-clock seconds and file sizes. Exit code 1: the contour
is not 20 times closer than the best of the others, or slower. Exit code 77: no other slicer is installed.
"""

import argparse
import array
import math
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import time

STEP = 0.02
WIDTH = 0.45
LAYER = 0.2
STEEP = 0.7
CENTRE = 100.0
GOAL = 20.0


def sphere_point(u, v):
    return (10 * math.cos(u) * math.sin(v), 10 * math.sin(u) * math.sin(v), 10 - 10 * math.cos(v))


def torus_point(u, v):
    r = 15 + 5 * math.cos(v)
    return (r * math.cos(u), r * math.sin(u), 5 + 5 * math.sin(v))


def sphere_radii(z):
    h = z - 10
    return [(math.sqrt(100 - h * h), 1)] if abs(h) < 10 * STEEP else []


def torus_radii(z):
    h = z - 5
    if abs(h) >= 5 * STEEP:
        return []
    w = math.sqrt(25 - h * h)
    return [(15 + w, 1), (15 - w, -1)]


def steps(radius, angle, chord):
    """Intervals of an arc whose chords are off by half of the distance: the other half is for the other direction."""
    return max(8, math.ceil(angle / (2 * math.acos(1 - 0.5 * chord / radius))))


SOLIDS = {
    "sphere": ("analytic/sphere_r10.igs", sphere_point, math.pi, 10, 10, sphere_radii),
    "torus": ("analytic/torus_flat.igs", torus_point, 2 * math.pi, 20, 5, torus_radii),
}


def write_mesh(path, solid, chord):
    _, point, v_range, u_radius, v_radius, _ = SOLIDS[solid]
    nu, nv = steps(u_radius, 2 * math.pi, chord), steps(v_radius, v_range, chord)
    rows = [[point(2 * math.pi * i / nu, v_range * j / nv) for i in range(nu)] for j in range(nv + 1)]
    facets = array.array("B")
    count = 0
    for j in range(nv):
        poles = (solid == "sphere" and j == 0, solid == "sphere" and j == nv - 1)
        for i in range(nu):
            a, b = rows[j][i], rows[j][(i + 1) % nu]
            c, d = rows[(j + 1) % (nv + 1)][i], rows[(j + 1) % (nv + 1)][(i + 1) % nu]
            for skip, triangle in ((poles[0], (a, b, d)), (poles[1], (a, d, c))):
                if skip:
                    continue
                # The sphere runs from the south pole up, the torus from outside up: outward to the right hand.
                facets.frombytes(struct.pack("<12fH", 0, 0, 0, *triangle[0], *triangle[1], *triangle[2], 0))
                count += 1
    with open(path, "wb") as file:
        file.write(bytes(80) + struct.pack("<I", count))
        facets.tofile(file)
    return count


class Tally:
    def __init__(self):
        self.sum, self.most, self.count = 0.0, 0.0, 0

    def add(self, distance):
        self.sum += distance
        self.most = max(self.most, distance)
        self.count += 1

    def text(self):
        return f"{1000 * self.sum / max(self.count, 1):9.4f} {1000 * self.most:9.4f}"

    def average(self):
        return self.sum / self.count if self.count else math.inf


def measure_point(tally, radii, x, y, out):
    """`out`: how far the wall was moved inwards."""
    distance = math.hypot(x, y)
    if radii:
        tally.add(min(abs(distance + side * out - radius) for radius, side in radii))


def measure_gcode(path, solid, walls, first_centre):
    radii_at = SOLIDS[solid][5]
    tally = Tally()
    x = y = z = 0.0
    wall = False
    word = re.compile(r"([XYZEIJ])(-?[0-9.]+)")
    relative_e = False
    e = 0.0
    with open(path, encoding="latin-1") as file:
        for line in file:
            if line.startswith(";TYPE:"):
                wall = line[6:].strip() in walls
                continue
            if line.startswith("M83"):
                relative_e = True
            if line.startswith("G92"):
                e = 0.0
            if not line.startswith(("G0 ", "G1 ", "G2 ", "G3 ")):
                continue
            words = dict(word.findall(line.split(";")[0]))
            nx, ny = float(words.get("X", x)), float(words.get("Y", y))
            z = float(words.get("Z", z))
            extruded = "E" in words and (relative_e and float(words["E"]) > 0 or float(words["E"]) > e)
            if "E" in words:
                e = float(words["E"])
            if wall and extruded and (nx != x or ny != y):
                radii = radii_at(round((z - 0.5 * LAYER) / (0.5 * LAYER)) * 0.5 * LAYER)
                for px, py in along(line[1], x, y, nx, ny, words):
                    measure_point(tally, radii, px - first_centre, py - first_centre, 0.5 * WIDTH)
            x, y = nx, ny
    return tally


def along(kind, x, y, nx, ny, words):
    """Points every STEP along a move, a straight one or an arc."""
    if kind in "01":
        count = max(1, math.ceil(math.hypot(nx - x, ny - y) / STEP))
        return [(x + (nx - x) * k / count, y + (ny - y) * k / count) for k in range(count)]
    cx, cy = x + float(words.get("I", 0)), y + float(words.get("J", 0))
    radius = math.hypot(x - cx, y - cy)
    start = math.atan2(y - cy, x - cx)
    sweep = math.atan2(ny - cy, nx - cx) - start
    turn = 2 * math.pi
    sweep = sweep % turn if kind == "3" else -(-sweep % turn)
    sweep = sweep or (turn if kind == "3" else -turn)
    count = max(1, math.ceil(abs(sweep) * radius / STEP))
    return [(cx + radius * math.cos(start + sweep * k / count), cy + radius * math.sin(start + sweep * k / count))
            for k in range(count)]


def measure_csv(path, solid):
    tally = Tally()
    with open(path, encoding="ascii") as file:
        next(file)
        for line in file:
            x, y, z = map(float, line.split(",")[:3])
            measure_point(tally, SOLIDS[solid][5](z), x, y, 0.0)
    return tally


def timed(command):
    started = time.monotonic()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return time.monotonic() - started


def prusa(mesh, out, fine):
    options = ["--layer-height", LAYER, "--first-layer-height", LAYER, "--perimeters", 2, "--top-solid-layers", 3,
               "--bottom-solid-layers", 3, "--fill-density", "20%", "--fill-pattern", "rectilinear", "--skirts", 0,
               "--brim-width", 0, "--perimeter-generator", "classic", "--seam-position", "aligned",
               "--center", f"{CENTRE:g},{CENTRE:g}", "--elefant-foot-compensation", 0]
    for width in ("", "perimeter-", "external-perimeter-", "infill-", "solid-infill-", "top-infill-",
                  "first-layer-"):
        options += [f"--{width}extrusion-width", WIDTH]
    if fine:
        options += ["--gcode-resolution", "0.00001"]
    return ["prusa-slicer", "-g", *map(str, options), "-o", out, mesh]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("lamina")
    parser.add_argument("corpus")
    parser.add_argument("--chord", type=float, action="append", help="of the meshes, mm [0.01, 0.001, 0.0001]")
    parser.add_argument("--epsilon", type=float, default=0.01, help="of lamina, mm")
    parser.add_argument("--quick", action="store_true", help="chord 0.01 only")
    arguments = parser.parse_args()
    chords = arguments.chord or ([0.01] if arguments.quick else [0.01, 0.001, 0.0001])
    if not os.path.isdir(arguments.corpus) or not shutil.which("prusa-slicer"):
        print("the corpus and prusa-slicer are needed: skipped")
        sys.exit(77)
    holds = True
    print(f"{'':44} {'avg um':>9} {'max um':>9} {'seconds':>9} {'file kB':>9}")
    with tempfile.TemporaryDirectory() as folder:
        for solid, (model, *_rest) in SOLIDS.items():
            file = os.path.join(arguments.corpus, model)
            out = os.path.join(folder, "out")
            common = ["--layer-height", str(LAYER), "--tolerance", str(arguments.epsilon), "--force", "--quiet"]
            contours = [arguments.lamina, "contours", file, *common]
            seconds = timed(contours)
            timed([*contours, "--csv", out, "--step", str(STEP)])
            ours = measure_csv(out, solid)
            size = os.path.getsize(file) / 1e3
            print(f"{solid + ', lamina, contours':44} {ours.text()} {seconds:9.2f} {size:9.1f}")
            whole = timed([arguments.lamina, "slice", file, *common, "--center", f"{CENTRE:g},{CENTRE:g}",
                           "-s", "layer.first_height=0.2", "-o", out])
            walls = measure_gcode(out, solid, {"External perimeter", "Outer wall"}, CENTRE)
            print(f"{solid + ', lamina, walls in G-code':44} {walls.text()} {whole:9.2f} {size:9.1f}")
            best, best_seconds = math.inf, math.inf
            for chord in chords:
                mesh = os.path.join(folder, "mesh.stl")
                facets = write_mesh(mesh, solid, chord)
                for fine in (False, True):
                    seconds = timed(prusa(mesh, out, fine))
                    theirs = measure_gcode(out, solid, {"External perimeter"}, CENTRE)
                    name = f"{solid}, PrusaSlicer{', unsimplified' if fine else ''}, {chord:g} ({facets} facets)"
                    print(f"{name:44} {theirs.text()} {seconds:9.2f} {os.path.getsize(mesh) / 1e3:9.1f}")
                    sys.stdout.flush()
                    if not fine and theirs.average() < best:
                        best, best_seconds = theirs.average(), seconds
            print(f"{solid}: contour {best / max(ours.average(), 1e-9):.0f} times closer than the best default, "
                  f"{best_seconds / whole:.1f} times faster to G-code")
            holds = holds and ours.average() * GOAL <= best and whole < best_seconds
    sys.exit(0 if holds else 1)


if __name__ == "__main__":
    main()
