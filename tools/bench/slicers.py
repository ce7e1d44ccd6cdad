"""Contours of sphere and torus against the true circles: lamina from a file of a few kilobytes, the other slicers from meshes.

Usage: slicers.py LAMINA CORPUS [--chord MM ...] [--quick] [--cura-definitions FOLDER]

The measure is the same for all: points every 0.02 mm along the outer walls, moved out by half of the bead, their
distance from the circle of the exact solid at the layer's mid height, on layers whose surface is steeper than 45
degrees. lamina's contours are measured as they are, too. Meshes are regular grids whose chords are off by at most the
given distance. Prints averages and maxima in micrometres, wall-clock seconds, peak memory and file sizes, of the fastest of
three runs. lamina cuts the finest mesh as well, beside the others.

Exit code 1: the contour is not 20 times closer than the best of the others with their own settings, or not made in less
time; or lamina's contours of the finest mesh take longer than CuraEngine's whole run, or more memory than three times
the file. Exit code 77: no other slicer is installed.

CuraEngine runs where its printer definitions are found, which Debian has in the package cura.
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
RUNS = 3
GOAL = 20.0
MEMORY_GOAL = 3.0
CURA_DEFINITIONS = "/usr/share/cura/resources/definitions"


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


def make_mesh(path, solid, chord):
    """Number of facets. A process of its own does it: what this one holds would count as its children's memory."""
    child = os.fork()
    if child == 0:
        write_mesh(path, solid, chord)
        os._exit(0)
    os.waitpid(child, 0)
    return (os.path.getsize(path) - 84) // 50


def write_mesh(path, solid, chord):
    _, point, v_range, u_radius, v_radius, _ = SOLIDS[solid]
    nu, nv = steps(u_radius, 2 * math.pi, chord), steps(v_radius, v_range, chord)
    rows = [[point(2 * math.pi * i / nu, v_range * j / nv) for i in range(nu)] for j in range(nv + 1)]
    facets = array.array("B")
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
    with open(path, "wb") as file:
        file.write(bytes(80) + struct.pack("<I", len(facets) // 50))
        facets.tofile(file)


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


def timed(command, runs=1, environment=None):
    """Seconds and peak megabytes of the fastest run."""
    best = (math.inf, math.inf)
    for _ in range(runs):
        started = time.monotonic()
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=environment)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode != 0:
            raise subprocess.CalledProcessError(process.returncode, command)
        best = min(best, (time.monotonic() - started, usage.ru_maxrss / 1024))
    return best


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


def cura(mesh, out, definitions):
    """CuraEngine does not evaluate the formulas of its settings file, so what depends on others is set as well."""
    settings = {"layer_height": LAYER, "layer_height_0": LAYER, "initial_layer_line_width_factor": 100,
                "wall_line_count": 2, "top_layers": 3, "bottom_layers": 3, "initial_bottom_layers": 3,
                "roofing_layer_count": 0, "infill_sparse_density": 20, "infill_line_distance": 5 * WIDTH,
                "infill_pattern": "lines", "adhesion_type": "none", "support_enable": "false",
                "machine_width": 2 * CENTRE, "machine_depth": 2 * CENTRE, "machine_height": 200,
                "machine_center_is_zero": "false", "center_object": "true"}
    for width in ("line_width", "wall_line_width", "wall_line_width_0", "wall_line_width_x", "skin_line_width",
                  "infill_line_width"):
        settings[width] = WIDTH
    options = [text for key, value in settings.items() for text in ("-s", f"{key}={value}")]
    return ["CuraEngine", "slice", "-j", os.path.join(definitions, "fdmprinter.def.json"), "-o", out, *options,
            "-e0", "-s", "extruder_nr=0", "-l", mesh]


def cura_environment(definitions):
    extruders = os.path.join(os.path.dirname(definitions), "extruders")
    return dict(os.environ, CURA_ENGINE_SEARCH_PATH=f"{definitions}:{extruders}")


def row(name, tally, cost, file):
    print(f"{name:52} {tally.text() if tally else '':19} {cost[0]:9.2f} {cost[1]:9.0f} {os.path.getsize(file) / 1e3:9.1f}")
    sys.stdout.flush()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("lamina")
    parser.add_argument("corpus")
    parser.add_argument("--chord", type=float, action="append", help="of the meshes, mm [0.01, 0.001, 0.0001]")
    parser.add_argument("--epsilon", type=float, default=0.01, help="of lamina, mm")
    parser.add_argument("--quick", action="store_true", help="chord 0.01 only")
    parser.add_argument("--cura-definitions", default=CURA_DEFINITIONS, help="folder with fdmprinter.def.json")
    arguments = parser.parse_args()
    chords = arguments.chord or ([0.01] if arguments.quick else [0.01, 0.001, 0.0001])
    definitions = arguments.cura_definitions
    has_prusa = shutil.which("prusa-slicer")
    has_cura = shutil.which("CuraEngine") and os.path.isfile(os.path.join(definitions, "fdmprinter.def.json"))
    if not os.path.isdir(arguments.corpus) or not (has_prusa or has_cura):
        print("the corpus and another slicer are needed: skipped")
        sys.exit(77)
    holds = True
    print(f"{'':52} {'avg um':>9} {'max um':>9} {'seconds':>9} {'MB':>9} {'file kB':>9}")
    with tempfile.TemporaryDirectory() as folder:
        for solid, (model, *_rest) in SOLIDS.items():
            file = os.path.join(arguments.corpus, model)
            out = os.path.join(folder, "out")
            common = ["--layer-height", str(LAYER), "--tolerance", str(arguments.epsilon), "--force", "--quiet"]
            cost = timed([arguments.lamina, "contours", file, *common], RUNS)
            timed([arguments.lamina, "contours", file, *common, "--csv", out, "--step", str(STEP)])
            ours = measure_csv(out, solid)
            row(solid + ", lamina, contours", ours, cost, file)
            whole = timed([arguments.lamina, "slice", file, *common, "--center", f"{CENTRE:g},{CENTRE:g}",
                           "-s", "layer.first_height=0.2", "-o", out], RUNS)
            row(solid + ", lamina, walls in G-code",
                measure_gcode(out, solid, {"External perimeter", "Outer wall"}, CENTRE), whole, file)
            best, best_seconds = math.inf, math.inf
            for chord in chords:
                mesh = os.path.join(folder, "mesh.stl")
                facets = make_mesh(mesh, solid, chord)
                rivals = []
                if has_prusa:
                    rivals += [("PrusaSlicer", prusa(mesh, out, False), None, True),
                               ("PrusaSlicer unsimplified", prusa(mesh, out, True), None, False)]
                if has_cura:
                    rivals += [("CuraEngine", cura(mesh, out, definitions), cura_environment(definitions), True)]
                for name, command, environment, by_default in rivals:
                    theirs_cost = timed(command, RUNS, environment)
                    theirs = measure_gcode(out, solid, {"External perimeter", "WALL-OUTER"}, CENTRE)
                    row(f"{solid}, {name}, {chord:g} ({facets} facets)", theirs, theirs_cost, mesh)
                    if by_default and theirs.average() < best:
                        best, best_seconds = theirs.average(), theirs_cost[0]
            cut = timed([arguments.lamina, "contours", mesh, "--layer-height", str(LAYER), "--quiet"], RUNS)
            row(f"{solid}, lamina, contours of {facets} facets", None, cut, mesh)
            print(f"{solid}: contour {best / max(ours.average(), 1e-9):.0f} times closer than the best default, "
                  f"{best_seconds / whole[0]:.1f} times faster to G-code")
            holds = holds and ours.average() * GOAL <= best and whole[0] < best_seconds
            if has_cura:
                size = os.path.getsize(mesh) / 2**20
                print(f"{solid}: contours of the mesh {theirs_cost[0] / cut[0]:.1f} times faster than CuraEngine's run, "
                      f"in {cut[1] / size:.1f} times the memory of the file")
                # A program that has done nothing yet has a few megabytes as well.
                holds = holds and cut[0] <= theirs_cost[0] and (arguments.quick or cut[1] <= MEMORY_GOAL * size)
    sys.exit(0 if holds else 1)


if __name__ == "__main__":
    main()
