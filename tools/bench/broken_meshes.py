"""What lamina and other slicers make of broken meshes, each beside the clean mesh of the same solid.

Usage: broken_meshes.py LAMINA CORPUS [--cura-definitions FOLDER]

Areas are lamina's sections, and what the others' outer walls enclose in their G-code, layer by layer. Prints how many
of the clean mesh's layers are there, how far the sum of the areas is off and how far the worst layer, and the first line
that the program says about the mesh. admesh and slic3r, which repair a file as a whole, are asked for the volume.

Exit code 1: lamina is off by more than half a per cent in a layer, or leaves out a layer without a word. Exit code 77:
the corpus is not there.
"""

import argparse
import json
import math
import os
import random
import re
import shutil
import struct
import subprocess
import sys
import tempfile

import slicers

SEED = 7
GOAL = 0.005
PATIENCE = 300  # s


def sphere(radius, rings, sides, first=0.0):
    """Facets about the x axis, from the angle `first` on, so that a cap at +x may be missing."""
    def corner(ring, side):
        a = first + (math.pi - first) * ring / rings
        b = 2 * math.pi * (side % sides) / sides
        return (radius * math.cos(a), radius * math.sin(a) * math.cos(b), radius + radius * math.sin(a) * math.sin(b))
    facets = []
    for ring in range(rings):
        for side in range(sides):
            a, b = corner(ring, side), corner(ring, side + 1)
            c, d = corner(ring + 1, side), corner(ring + 1, side + 1)
            if ring > 0 or first > 0:
                facets.append((a, c, b))
            if ring + 1 < rings:
                facets.append((b, c, d))
    return facets


def write_stl(path, facets):
    with open(path, "wb") as file:
        file.write(bytes(80) + struct.pack("<I", len(facets)))
        for a, b, c in facets:
            file.write(struct.pack("<12fH", 0, 0, 0, *a, *b, *c, 0))


def make_meshes(folder, corpus):
    """Name, broken file, clean file, layer height."""
    chance = random.Random(SEED)
    fine = sphere(2, 160, 320)  # facets 0.04 mm wide: one that is missing is a gap below epsilon
    whole = sphere(10, 120, 240)
    files = {"fine": fine,
             "holed": [facet for facet in fine if chance.random() >= 0.01],
             "flipped": [(a, b, c) if chance.random() < 0.5 else (a, c, b) for a, b, c in fine],
             "whole": whole,
             "capless": sphere(10, 120, 240, math.acos(0.85))}
    paths = {}
    for name, facets in files.items():
        paths[name] = os.path.join(folder, name + ".stl")
        write_stl(paths[name], facets)
    mesh = os.path.join(corpus, "mesh")
    return [("sphere r2, 1 % of the facets missing", paths["holed"], paths["fine"], 0.1),
            ("sphere r2, facets turned at random", paths["flipped"], paths["fine"], 0.1),
            ("bracket_broken.stl", os.path.join(mesh, "bracket_broken.stl"), os.path.join(mesh, "bracket_clean.stl"), 0.2),
            ("sphere r10 without its cap x > 8.5", paths["capless"], paths["whole"], 0.2)]


def inside(point, loop):
    x, y = point
    crossings = 0
    for (x1, y1), (x2, y2) in zip(loop, loop[1:] + loop[:1]):
        if (y1 > y) != (y2 > y) and x < (x2 - x1) * (y - y1) / (y2 - y1) + x1:
            crossings += 1
    return crossings % 2 == 1


def parity_area(loops):
    total = 0.0
    for k, loop in enumerate(loops):
        area = 0.5 * abs(sum(x1 * y2 - x2 * y1 for (x1, y1), (x2, y2) in zip(loop, loop[1:] + loop[:1])))
        depth = sum(inside(loop[0], other) for j, other in enumerate(loops) if j != k)
        total += area if depth % 2 == 0 else -area
    return total


def wall_areas(path, walls):
    """Area that the outer walls enclose, by height."""
    loops = {}
    x = y = z = e = 0.0
    relative = wall = False
    loop = None
    word = re.compile(r"([XYZE])(-?[0-9.]+)")
    with open(path, encoding="latin-1") as file:
        for line in file:
            if line.startswith(";TYPE:"):
                wall = line[6:].strip() in walls
            elif line.startswith("M83"):
                relative = True
            elif line.startswith("G92"):
                e = 0.0
            if not line.startswith(("G0 ", "G1 ")):
                continue
            words = dict(word.findall(line.split(";")[0]))
            nx, ny, z = float(words.get("X", x)), float(words.get("Y", y)), float(words.get("Z", z))
            push = float(words["E"]) - (0.0 if relative else e) if "E" in words else 0.0
            if "E" in words and not relative:
                e = float(words["E"])
            if (nx, ny) != (x, y):
                if wall and push > 0:
                    if loop is None:
                        loop = [(x, y)]
                        loops.setdefault(round(z, 3), []).append(loop)
                    loop.append((nx, ny))
                else:
                    loop = None
            x, y = nx, ny
    return {height: parity_area(found) for height, found in loops.items()}


def run(command, environment=None):
    """Exit code and what the program says."""
    try:
        done = subprocess.run(command, capture_output=True, timeout=PATIENCE, env=environment)
    except subprocess.TimeoutExpired:
        return -1, f"nothing for {PATIENCE} s"
    return done.returncode, (done.stdout + b"\n" + done.stderr).decode("latin-1")


def first_complaint(text):
    for line in text.splitlines():
        if re.search(r"warning|error|invalid|abort|cannot|manifold|empty layer|open", line, re.I) and \
                "JSON setting" not in line and " -s " not in line:
            return line.strip()[:110]
    return ""


class Lamina:
    name = "lamina"

    def __init__(self, program):
        self.program = program

    def areas(self, mesh, layer, _out):
        code, said = run([self.program, "contours", mesh, "--layer-height", str(layer), "--json", "--quiet"])
        start = said.find("{")
        layers = json.loads(said[start:said.rfind("}") + 1])["layers"] if code == 0 else []
        warnings = [line for line in said.splitlines() if line.startswith("warning")]
        closed = [line for line in warnings if "not closed" in line or "open" in line]
        areas = {round(found["z"], 3): found["area"] for found in layers if found["area"] > 0}
        return areas, code, "; ".join((closed or warnings)[:1])


class Prusa:
    name = "PrusaSlicer"

    def areas(self, mesh, layer, out):
        command = [str(word) for word in slicers.prusa(mesh, out, False)]
        for option in ("--layer-height", "--first-layer-height"):
            command[command.index(option) + 1] = str(layer)
        code, said = run(command)
        return (wall_areas(out, {"External perimeter"}) if code == 0 else {}), code, first_complaint(said)


class Slic3r:
    name = "Slic3r"

    def areas(self, mesh, layer, out):
        code, said = run(["slic3r", mesh, "-o", out, "--layer-height", str(layer), "--first-layer-height", str(layer),
                          "--gcode-comments", "--skirts", "0", "--perimeters", "1", "--no-extra-perimeters",
                          "--print-center", "100,100"])
        if code != 0:
            return {}, code, first_complaint(said)
        typed = out + ".typed"
        with open(out, encoding="latin-1") as file, open(typed, "w", encoding="latin-1") as copy:
            for line in file:
                comment = line.partition(";")[2].strip()
                copy.write(f";TYPE:{'perimeter' if comment.startswith('perimeter') else ''}\n{line}")
        # It does not tell inner from outer perimeters: hence one only.
        return wall_areas(typed, {"perimeter"}), code, first_complaint(said)


class Cura:
    name = "CuraEngine"

    def __init__(self, definitions):
        self.definitions = definitions

    def areas(self, mesh, layer, out):
        command = slicers.cura(mesh, out, self.definitions)
        command = [word.replace(f"={slicers.LAYER}", f"={layer}") if word.startswith("layer_height") else word
                   for word in command]
        code, said = run(command, slicers.cura_environment(self.definitions))
        return (wall_areas(out, {"WALL-OUTER"}) if code == 0 else {}), code, first_complaint(said)


def volume_of(command, pattern):
    code, said = run(command)
    found = re.findall(pattern, said)
    return float(found[-1]) if code == 0 and found else None


def compare(clean, broken):
    """Layers found, and by how much sum and worst layer are off; layers of below a hundredth do not count."""
    large = 0.01 * max(clean.values())
    kept = [height for height in clean if broken.get(height, 0.0) > 0]
    total = sum(clean.values())
    worst = max((abs(broken[height] - clean[height]) / clean[height] for height in kept if clean[height] > large),
                default=math.inf)
    return len(kept), abs(sum(broken.values()) - total) / total, worst


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("lamina")
    parser.add_argument("corpus")
    parser.add_argument("--cura-definitions", default=slicers.CURA_DEFINITIONS, help="folder with fdmprinter.def.json")
    arguments = parser.parse_args()
    if not os.path.isdir(arguments.corpus):
        print("the corpus is needed: skipped")
        sys.exit(77)
    programs = [Lamina(arguments.lamina)]
    if shutil.which("prusa-slicer"):
        programs.append(Prusa())
    if shutil.which("CuraEngine") and os.path.isdir(arguments.cura_definitions):
        programs.append(Cura(arguments.cura_definitions))
    if shutil.which("slic3r"):
        programs.append(Slic3r())
    holds = True
    with tempfile.TemporaryDirectory() as folder:
        for name, broken, clean, layer in make_meshes(folder, arguments.corpus):
            print(f"{name}\n  {'':12} {'layers':>9} {'sum off %':>10} {'worst %':>9}  says")
            for program in programs:
                out = os.path.join(folder, "out.gcode")
                good, _, _ = program.areas(clean, layer, out)
                areas, code, said = program.areas(broken, layer, out)
                kept, total, worst = compare(good, areas)
                if code != 0:
                    said = f"exit code {code}: {said}"
                print(f"  {program.name:12} {kept:4}/{len(good):<4} {100 * total:10.3f} {100 * worst:9.3f}  {said}")
                if program.name == "lamina":
                    holds = holds and worst <= GOAL and (kept == len(good) or said != "")
            volumes = []
            for tool, command, pattern in (
                    ("admesh", ["admesh"], r"Volume\s*:\s*(-?[0-9.]+)"),
                    ("slic3r", ["slic3r", "--info"], r"volume:?\s*=?\s*(-?[0-9.]+)"),
                    ("prusa-slicer", ["prusa-slicer", "--info"], r"volume = (-?[0-9.]+)")):
                if shutil.which(tool):
                    told = [volume_of([*command, mesh], pattern) for mesh in (clean, broken)]
                    volumes.append(tool + " " + " / ".join("fails" if v is None else f"{v:.2f}" for v in told))
            print(f"  volumes of the clean and the broken mesh, mm^3: {', '.join(volumes)}")
            sys.stdout.flush()
    sys.exit(0 if holds else 1)


if __name__ == "__main__":
    main()
