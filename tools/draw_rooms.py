#!/usr/bin/env python3
"""Draws docs/figures/rooms.svg from tools/rooms.txt: each room stands above those that it includes. With --check: only says whether the
drawing is up to date.

Usage: draw_rooms.py [--check] [ROOT]"""

import pathlib
import sys

from rooms import read_rooms

WIDE, TALL, GAP, ROW, SHIFT = 232, 30, 16, 84, 60
STYLE = """text{font:12px sans-serif;fill:#1a2027;text-anchor:middle}rect{fill:#fff;stroke:#6b7785}
.program rect{fill:#e3f0ef;stroke:#0b6b70}path{fill:none;stroke:#9aa5b1}.ground{fill:#f3f4f6;stroke:none}"""
PROGRAMS = {"fluid", "solid", "fsi_master", "identification_master", "observation_manager", "tether", "pictures", "tether/conform"}


def needed(rooms):
    """Of what each room includes, what no other room that it includes brings along."""
    reach = {}
    for room, below in rooms.items():
        reach[room] = set(below).union(*(reach[other] for other in below))
    return {room: [b for b in below if not any(b in reach[other] for other in below)] for room, below in rooms.items()}


def layers_of(rooms):
    """From the ground up: a room is one layer above the highest that it includes."""
    height = {}
    for room, below in rooms.items():
        height[room] = 1 + max((height[other] for other in below), default=-1)
    return [[room for room in rooms if height[room] == h] for h in range(max(height.values()) + 1)]


def places_of(layers, edges):
    """{room: (x, y) of its box}; within a layer in the order of what lies below, so that few lines cross."""
    width = max(len(layer) for layer in layers) * (WIDE + GAP) + 2 * SHIFT
    place = {}
    for h, layer in enumerate(layers):
        def middle(room):
            below = [place[other][0] for other in edges[room]]
            return sum(below) / len(below) if below else 0
        gap, shift = (width - 2 * SHIFT) / len(layer), SHIFT * ((h + 1) % 3)  # or a line hides behind the box between its ends
        for i, room in enumerate(sorted(layer, key=middle)):
            place[room] = (gap * (i + 0.5) - WIDE / 2 + shift, ROW * (len(layers) - 1 - h) + GAP)
    return place, width


def line(upper, lower):
    (x, y), (u, v) = (upper[0] + WIDE / 2, upper[1] + TALL), (lower[0] + WIDE / 2, lower[1])
    half = (y + v) / 2
    return f'<path d="M{x:.0f} {y:.0f}C{x:.0f} {half:.0f} {u:.0f} {half:.0f} {u:.0f} {v:.0f}"/>'


def box(room, place):
    x, y = place
    kind = ' class="program"' if room in PROGRAMS else ""
    return (f'<g{kind}><rect x="{x:.0f}" y="{y:.0f}" width="{WIDE}" height="{TALL}" rx="5"/>'
            f'<text x="{x + WIDE / 2:.0f}" y="{y + 19:.0f}">{room}</text></g>')


def drawing(rooms):
    edges, layers = needed(rooms), layers_of(rooms)
    place, width = places_of(layers, edges)
    height = ROW * (len(layers) - 1) + TALL + 2 * GAP
    lines = [line(place[room], place[other]) for room, below in edges.items() for other in below]
    return "\n".join([f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" role="img" aria-label="rooms">',
                      f"<style>{STYLE}</style>", f'<rect class="ground" width="{width}" height="{height}" rx="8"/>',
                      *lines, *(box(room, place[room]) for room in rooms), "</svg>"]) + "\n"


def main(*words):
    root = pathlib.Path(next((word for word in words if word != "--check"), pathlib.Path(__file__).resolve().parents[1]))
    picture, text = root / "docs/figures/rooms.svg", drawing(read_rooms(root))
    if "--check" not in words:
        picture.write_text(text, encoding="utf-8")
    elif not picture.is_file() or picture.read_text(encoding="utf-8") != text:
        sys.exit("docs/figures/rooms.svg is not of tools/rooms.txt: run tools/draw_rooms.py and commit it")


if __name__ == "__main__":
    main(*sys.argv[1:])
