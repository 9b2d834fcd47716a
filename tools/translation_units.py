"""Lists the translation units of a compilation database that compile given sources: what has changed since a commit, or all.

Usage: translation_units.py compile_commands.json [COMMIT | --all]. Without COMMIT: since the branch left main. A changed header counts
with the source beside it of the same name."""

import json
import pathlib
import re
import subprocess
import sys

INCLUDED = re.compile(r'#include "(/[^"]+)"')


def sources_of(unit):
    """The unit itself; of one that CMake wrote of several sources, these."""
    if "/Unity/" not in unit or not pathlib.Path(unit).exists():
        return {unit}
    return set(INCLUDED.findall(pathlib.Path(unit).read_text()))


def git(*words):
    return subprocess.run(["git", *words], capture_output=True, text=True, check=True).stdout.splitlines()


def start_of_branch():
    """Where it left main; the last commit in a clone without main."""
    names = git("branch", "--all", "--list", "main", "origin/main", "--format=%(refname:short)")
    return git("merge-base", "HEAD", names[0])[0] if names else "HEAD"


def changed_since(commit):
    """Absolute paths of sources, those of changed headers beside them too."""
    names = git("diff", "--name-only", "--diff-filter=d", commit or start_of_branch()) + git("ls-files", "--others", "--exclude-standard")
    return {str(pathlib.Path(name).resolve().with_suffix(".cpp")) for name in names if name.endswith((".cpp", ".hpp"))}


def units(database, wanted):
    """Sorted; wanted: sources, or None for all."""
    all_units = {entry["file"] for entry in database if entry["file"].endswith((".cpp", ".cxx"))}
    return sorted(unit for unit in all_units if wanted is None or sources_of(unit) & wanted)


def main(database, choice=None):
    wanted = None if choice == "--all" else changed_since(choice)
    print("\n".join(units(json.loads(pathlib.Path(database).read_text()), wanted)))


if __name__ == "__main__":
    main(*sys.argv[1:])
