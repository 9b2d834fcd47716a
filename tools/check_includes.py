#!/usr/bin/env python3
"""Checks the layering of the sources: each room includes only the rooms below it that tools/rooms.txt grants it, and all of those, programs never include each other, headers
include each other without a cycle, heavy third-party headers stay in .cpp files, and only common/protocol speaks MPI.

Usage: check_includes.py [ROOT]. Prints one line per violation and returns 1 if there is any."""

import pathlib
import re
import sys

from rooms import read_rooms, room_of

HEAVY = re.compile(r"(yaml-cpp/.*|CGAL/.*|vtk.*\.h|spdlog/.*|CLI/.*|nlohmann/.*|muParser.*|cholmod\.h|metis\.h|petsc.*\.h)")
INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]')


def may_include(room, other, rooms):
    return room is None or other is None or room == other or other in rooms[room]


def includes_of(root, rooms):
    """{source: [(line, quoted, included)]} for all C and C++ sources below the rooms and tests."""
    found = {}
    for folder in sorted({room.split("/")[0] for room in rooms} | {"tests", "benchmarks"}):
        for file in sorted((root / folder).rglob("*.[ch]*")):
            if file.suffix in (".c", ".h", ".cpp", ".hpp"):
                lines = file.read_text(encoding="utf-8").splitlines()
                matches = ((n, INCLUDE.match(line)) for n, line in enumerate(lines, 1))
                found[file.relative_to(root).as_posix()] = [(n, m[1] == '"', m[2]) for n, m in matches if m]
    return found


def forbidden(includes, rooms):
    tops = {room.split("/")[0] for room in rooms}
    for source, lines in includes.items():
        room = room_of(source, rooms)
        if room is None and source.split("/")[0] in tops:
            yield f"{source}:1: in no room; add its folder to tools/rooms.txt"
        for line, quoted, target in lines:
            if quoted and not may_include(room, room_of(target, rooms), rooms):
                yield f"{source}:{line}: {room} must not include {room_of(target, rooms)} ({target})"
            if not quoted and room and source.endswith(".hpp") and HEAVY.fullmatch(target):
                yield f"{source}:{line}: <{target}> belongs in a .cpp file"
            if target == "mpi.h" and room and room != "common/protocol":
                yield f"{source}:{line}: only common/protocol speaks MPI"


def granted_for_nothing(includes, rooms):
    used = {room: set() for room in rooms}
    for source, lines in includes.items():
        if room := room_of(source, rooms):
            used[room] |= {room_of(target, rooms) for _, quoted, target in lines if quoted}
    for room, below in rooms.items():
        for other in below:
            if other not in used[room]:
                yield f"tools/rooms.txt: {room} does not include {other}"


def cycles(includes):
    """Each cycle of includes once, by depth-first search."""
    state, path = {}, []

    def visit(source):
        state[source] = "open"
        path.append(source)
        for _, quoted, target in includes[source]:
            if quoted and target in includes:
                if state.get(target) == "open":
                    yield "cycle: " + " -> ".join(path[path.index(target):] + [target])
                elif target not in state:
                    yield from visit(target)
        path.pop()
        state[source] = "done"

    for source in includes:
        if source not in state:
            yield from visit(source)


def main():
    root = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parent.parent
    rooms = read_rooms(root)
    includes = includes_of(root, rooms)
    violations = [*forbidden(includes, rooms), *granted_for_nothing(includes, rooms), *cycles(includes)]
    print("\n".join(violations) if violations else f"{len(includes)} sources, layering as it should be")
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(main())
