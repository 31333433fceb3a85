#!/usr/bin/env python3
"""Writes a .vm model turned about x, then about y, to standard output:

    bench/tilt_model.py menger4_tree.vm 30 20 > menger4_tilted.vm

Turned faces lie along no axis of space, so that pruning by boxes finds no face it can skip at once. The file's
coordinates (var-x, var-y, var-z) become sums of the new ones; all other lines stay as they are.
"""
import math
import sys

path, about_x, about_y = sys.argv[1], math.radians(float(sys.argv[2])), math.radians(float(sys.argv[3]))
cx, sx, cy, sy = math.cos(about_x), math.sin(about_x), math.cos(about_y), math.sin(about_y)
rows = {
    "var-x": (cy, 0.0, sy),
    "var-y": (sx * sy, cx, -sx * cy),
    "var-z": (-cx * sy, sx, cx * cy),
}
print(f"# {path} turned by {sys.argv[2]} degrees about x and {sys.argv[3]} about y")
for axis in "xyz":
    print(f"_tilt_{axis} var-{axis}")
for line in open(path, encoding="utf-8"):
    words = line.split()
    if len(words) != 2 or words[1] not in rows:
        print(line, end="")
        continue
    name = words[0]
    for axis, factor in zip("xyz", rows[words[1]]):
        print(f"{name}_f{axis} const {factor:.9g}")
        print(f"{name}_{axis} mul {name}_f{axis} _tilt_{axis}")
    print(f"{name}_xy add {name}_x {name}_y")
    print(f"{name} add {name}_xy {name}_z")
