#!/usr/bin/env python3
"""From the contours of all frames of a beat (columns slice, frame, time, x, y, z) those of each slice's smallest area, that is end of
diastole, as `mesh.swept.contours` reads them; and the way in which the lumen moves as it fills, which points away from the spine.

Usage: end_diastolic_contours.py SLICES.csv CONTOURS.csv SLICE..."""

import csv
import math
import sys


def subtract(a, b):
    return [p - q for p, q in zip(a, b)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


def mean(points):
    return [sum(p[i] for p in points) / len(points) for i in range(3)]


def area(points):
    """Of a closed, nearly planar polygon."""
    middle, total = mean(points), [0.0, 0.0, 0.0]
    for p, q in zip(points, points[1:] + points[:1]):
        total = [s + 0.5 * c for s, c in zip(total, cross(subtract(p, middle), subtract(q, middle)))]
    return math.sqrt(dot(total, total))


def read(path, wanted):
    """slice -> frame -> points, in the order of the file."""
    sections = {}
    with open(path, encoding="utf-8") as file:
        for row in csv.DictReader(line for line in file if not line.startswith("#")):
            if row["slice"] in wanted:
                frame = sections.setdefault(row["slice"], {}).setdefault(int(row["frame"]), [])
                frame.append([float(row[f"{axis} [mm]"]) for axis in "xyz"])
    return sections


def main():
    measured, result, *wanted = sys.argv[1:]
    sections = read(measured, wanted)
    smallest = {name: min(frames, key=lambda f, frames=frames: area(frames[f])) for name, frames in sections.items()}
    largest = {name: max(frames, key=lambda f, frames=frames: area(frames[f])) for name, frames in sections.items()}
    with open(result, "w", encoding="utf-8") as file:
        file.write("# End-diastolic contours of the lumen, inlet (cranial) to outlet, mm; made by tools/end_diastolic_contours.py\n")
        file.write("section,point,x,y,z\n")
        for name, frames in sections.items():
            for i, (x, y, z) in enumerate(frames[smallest[name]]):
                file.write(f"{name},{i},{x:.3f},{y:.3f},{z:.3f}\n")

    centres = {name: mean(frames[smallest[name]]) for name, frames in sections.items()}
    first, last = list(centres.values())[0], list(centres.values())[-1]
    axis = subtract(last, first)
    length = math.sqrt(dot(axis, axis))
    axis = [a / length for a in axis]
    for name, frames in sections.items():
        move = subtract(mean(frames[largest[name]]), centres[name])
        across = [m - dot(move, axis) * a for m, a in zip(move, axis)]
        posterior = [(1.0 if i == 1 else 0.0) - axis[1] * a for i, a in enumerate(axis)]
        size = math.sqrt(dot(across, across))
        angle = math.degrees(math.acos(dot(across, posterior) / size / math.sqrt(dot(posterior, posterior))))
        print(f"{name}: frame {smallest[name]}, {area(frames[smallest[name]]):.1f} mm2; fills to {area(frames[largest[name]]):.1f} mm2 in frame "
              f"{largest[name]}, moving {size:.2f} mm across the axis, {angle:.0f} degrees from posterior")


if __name__ == "__main__":
    main()
