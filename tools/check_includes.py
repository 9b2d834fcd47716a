#!/usr/bin/env python3
"""Checks the layering of the sources: each room includes only the rooms below it, programs never include each other, headers
include each other without a cycle, heavy third-party headers stay in .cpp files, and only common/protocol speaks MPI.

Usage: check_includes.py [ROOT]. Prints one line per violation and returns 1 if there is any."""

import pathlib
import re
import sys

COMMON = {
    "common/base": [],
    "common/config": ["base"],
    "common/linalg": ["base"],
    "common/mesh": ["base"],
    "common/fem": ["base", "linalg", "mesh"],
    "common/io": ["base", "config", "linalg", "mesh"],
    "common/case": ["base", "config", "io", "linalg", "mesh"],
    "common/observation": ["base", "case", "config", "io", "mesh"],
    "common/protocol": ["base", "config"],
}
PROGRAMS = ["fluid", "solid", "fsi_master", "identification_master", "observation_manager", "diagnosis", "twin", "report", "pictures", "tether"]
HEAVY = re.compile(r"(yaml-cpp/.*|CGAL/.*|vtk.*\.h|spdlog/.*|CLI/.*|nlohmann/.*|muParser.*|cholmod\.h)")
BUILT_ON = {"tether": ["diagnosis", "twin", "report"], "report": ["diagnosis"]}  # rooms that are libraries of a program
INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]')


def room_of(path):
    """The room that a source belongs to: "common/mesh", "fluid"; None for tests and other places that may include anything."""
    parts = pathlib.PurePosixPath(path).parts
    if parts[0] == "common" and len(parts) > 2:
        return "/".join(parts[:2])
    return parts[0] if parts[0] in PROGRAMS else None


def may_include(room, other):
    if room is None or other is None or room == other:
        return True
    if room in PROGRAMS:
        return other in COMMON or other in BUILT_ON.get(room, [])
    return other in ["common/" + name for name in COMMON.get(room, [])]


def includes_of(root):
    """{source: [(line, quoted, included)]} for all C and C++ sources below the rooms and tests."""
    found = {}
    for folder in ["common", "tests", "benchmarks", *PROGRAMS]:
        for file in sorted((root / folder).rglob("*.[ch]*")):
            if file.suffix in (".c", ".h", ".cpp", ".hpp"):
                lines = file.read_text(encoding="utf-8").splitlines()
                matches = ((n, INCLUDE.match(line)) for n, line in enumerate(lines, 1))
                found[file.relative_to(root).as_posix()] = [(n, m[1] == '"', m[2]) for n, m in matches if m]
    return found


def forbidden(includes):
    for source, lines in includes.items():
        room = room_of(source)
        if room and room not in COMMON and room not in PROGRAMS:
            yield f"{source}:1: {room} is not a known room; add it to tools/check_includes.py"
        for line, quoted, target in lines:
            if quoted and not may_include(room, room_of(target)):
                yield f"{source}:{line}: {room} must not include {room_of(target)} ({target})"
            if not quoted and room and source.endswith(".hpp") and HEAVY.fullmatch(target):
                yield f"{source}:{line}: <{target}> belongs in a .cpp file"
            if target == "mpi.h" and room and room != "common/protocol":
                yield f"{source}:{line}: only common/protocol speaks MPI"


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
    includes = includes_of(root)
    violations = [*forbidden(includes), *cycles(includes)]
    print("\n".join(violations) if violations else f"{len(includes)} sources, layering as it should be")
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(main())
