"""The layering check finds each kind of violation, and nothing in a sound tree."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOMS = """
# from the ground up
common/base:
common/mesh: common/base
common/protocol: common/base
fluid: common/base common/mesh
fluid/inner: common/base fluid
solid: common/base
"""
USES = {  # of all that the list grants
    "common/mesh/use.cpp": '#include "common/base/use.hpp"\n',
    "common/protocol/use.cpp": '#include "common/base/use.hpp"\n',
    "fluid/use.cpp": '#include "common/base/use.hpp"\n#include "common/mesh/use.hpp"\n',
    "fluid/inner/use.cpp": '#include "common/base/use.hpp"\n#include "fluid/use.hpp"\n',
    "solid/use.cpp": '#include "common/base/use.hpp"\n',
}
CHECK = pathlib.Path(__file__).resolve().parents[2] / "tools" / "check_includes.py"


def check(files):
    with tempfile.TemporaryDirectory() as folder:
        for name, text in {"tools/rooms.txt": ROOMS, **USES, **files}.items():
            path = pathlib.Path(folder) / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        run = subprocess.run([sys.executable, CHECK, folder], capture_output=True, text=True)
        return run.returncode, run.stdout.strip()


class CheckIncludes(unittest.TestCase):
    def test_sound_tree(self):
        code, _ = check({
            "common/base/a.hpp": "#include <vector>\n",
            "common/mesh/b.cpp": '#include "common/base/a.hpp"\n#include <CGAL/x.h>\n',
            "fluid/c.cpp": '#include "common/mesh/b.hpp"\n#include "fluid/d.hpp"\n',
            "tests/fluid/e.cpp": '#include "fluid/c.hpp"\n#include "solid/f.hpp"\n',
        })
        self.assertEqual(code, 0)

    def test_programs_apart(self):
        self.assertEqual(check({"fluid/a.cpp": '\n#include "solid/b.hpp"\n'}),
                         (1, "fluid/a.cpp:2: fluid must not include solid (solid/b.hpp)"))

    def test_room_above(self):
        self.assertEqual(check({"common/base/a.hpp": '#include "common/mesh/b.hpp"\n'}),
                         (1, "common/base/a.hpp:1: common/base must not include common/mesh (common/mesh/b.hpp)"))

    def test_heavy_header(self):
        self.assertEqual(check({"fluid/a.hpp": "#include <CLI/CLI.hpp>\n"}),
                         (1, "fluid/a.hpp:1: <CLI/CLI.hpp> belongs in a .cpp file"))

    def test_mpi(self):
        self.assertEqual(check({"fluid/a.cpp": "#include <mpi.h>\n", "common/protocol/b.cpp": "#include <mpi.h>\n"}),
                         (1, "fluid/a.cpp:1: only common/protocol speaks MPI"))

    def test_cycle(self):
        self.assertEqual(check({"fluid/a.hpp": '#include "fluid/b.hpp"\n', "fluid/b.hpp": '#include "fluid/a.hpp"\n'}),
                         (1, "cycle: fluid/a.hpp -> fluid/b.hpp -> fluid/a.hpp"))

    def test_unknown_room(self):
        self.assertEqual(check({"common/attic/a.cpp": ""}),
                         (1, "common/attic/a.cpp:1: in no room; add its folder to tools/rooms.txt"))

    def test_inner_room(self):
        self.assertEqual(check({"fluid/inner/a.cpp": '#include "fluid/b.hpp"\n#include "common/mesh/c.hpp"\n'}),
                         (1, "fluid/inner/a.cpp:2: fluid/inner must not include common/mesh (common/mesh/c.hpp)"))

    def test_granted_for_nothing(self):
        self.assertEqual(check({"solid/use.cpp": ""}), (1, "tools/rooms.txt: solid does not include common/base"))

    def test_list_goes_upward(self):
        code, _ = check({"tools/rooms.txt": "a: b\nb:\n"})
        self.assertEqual(code, 1)


if __name__ == "__main__":
    unittest.main()
