"""Lists the translation units of a compilation database that compile given sources.

Usage: translation_units.py compile_commands.json [SOURCE... | --all]. Without sources: those of the rooms (tools/rooms.txt); --all: those
of tests and benchmarks too."""

import json
import pathlib
import re
import sys

from rooms import read_rooms, room_of

ROOT = pathlib.Path(__file__).resolve().parents[1]
INCLUDED = re.compile(r'#include "(/[^"]+)"')
FOR_GCC_ONLY = re.compile(r"#include <itk")  # Debian's ITK refuses every other compiler


def sources_of(unit):
    """The unit itself; of one that CMake wrote of several sources, these."""
    if "/Unity/" not in unit or not pathlib.Path(unit).exists():
        return {unit}
    return set(INCLUDED.findall(pathlib.Path(unit).read_text()))


def is_for_gcc_only(source):
    path = pathlib.Path(source)
    return path.exists() and FOR_GCC_ONLY.search(path.read_text()) is not None


def units(database, is_wanted):
    """Sorted, without those that clang cannot read; is_wanted: of a source's absolute path."""
    all_units = {entry["file"] for entry in database if entry["file"].endswith((".cpp", ".cxx"))}
    return sorted(
        unit for unit in all_units if any(map(is_wanted, sources_of(unit))) and not any(map(is_for_gcc_only, sources_of(unit)))
    )


def is_of_room(source, rooms, root=ROOT):
    path = pathlib.Path(source)
    return path.is_relative_to(root) and room_of(path.relative_to(root).as_posix(), rooms) is not None


def main(database, *names):
    if names == ("--all",):
        wanted = lambda source: True  # noqa: E731
    elif names:
        wanted = {str(pathlib.Path(name).resolve()) for name in names}.__contains__
    else:
        rooms = read_rooms(ROOT)
        wanted = lambda source: is_of_room(source, rooms)  # noqa: E731
    print("\n".join(units(json.loads(pathlib.Path(database).read_text()), wanted)))


if __name__ == "__main__":
    main(*sys.argv[1:])
