#!/usr/bin/env python3
"""Checks that every equation label in the sources, such as (S.2), stands in docs/equations.md, and every one there once.

Usage: check_labels.py [ROOT]. Prints one line per violation and returns 1 if there is any."""

import collections
import pathlib
import re
import sys

from rooms import read_rooms

LABEL = re.compile(r"\(([A-Z]\.\d+[a-z]?)\)")
DEFINITION = re.compile(r"\*\*\(([A-Z]\.\d+[a-z]?)\)\*\*")


def used_labels(root):
    """(place, label) for each label in a source."""
    for folder in sorted({room.split("/")[0] for room in read_rooms(root)}):
        for file in sorted((root / folder).rglob("*.[ch]pp")):
            for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
                for label in LABEL.findall(line):
                    yield f"{file.relative_to(root).as_posix()}:{number}", label


def main():
    root = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parent.parent
    defined = collections.Counter(DEFINITION.findall((root / "docs" / "equations.md").read_text(encoding="utf-8")))
    used = list(used_labels(root))
    violations = [f"docs/equations.md: ({label}) is defined {count} times" for label, count in defined.items() if count > 1]
    violations += [f"{place}: ({label}) is not in docs/equations.md" for place, label in used if label not in defined]
    print("\n".join(violations) if violations else f"{len(used)} labels, {len(defined)} equations")
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(main())
