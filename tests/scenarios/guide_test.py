"""The case files of docs/guide.md, "Your own data" and "An effect of your own", are valid: guide_test.py TETHER GUIDE."""

import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

TETHER, GUIDE = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2])
AS_ROOT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


def case_named(name):
    """The text of the guide's case of that name."""
    blocks = re.findall(r"^```yaml\n(.*?)^```$", GUIDE.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)
    (text,) = [block for block in blocks if re.search(rf"^name: {name}$", block, re.MULTILINE)]
    return text


def write_tube(path, radius, length, around=24, along=20):
    """An open tube about z as STL."""
    def corner(i, j):
        angle = 2 * math.pi * i / around
        return f"vertex {radius * math.cos(angle):.6f} {radius * math.sin(angle):.6f} {length * j / along:.6f}"

    with open(path, "w", encoding="utf-8") as file:
        print("solid tube", file=file)
        for i in range(around):
            for j in range(along):
                for triangle in (((i, j), (i + 1, j), (i + 1, j + 1)), ((i, j), (i + 1, j + 1), (i, j + 1))):
                    print("facet normal 0 0 0\nouter loop", *(corner(*at) for at in triangle), "endloop\nendfacet", sep="\n", file=file)
        print("endsolid tube", file=file)


class Guide(unittest.TestCase):
    def test_its_cases_are_valid(self):
        holder = tempfile.TemporaryDirectory(prefix="tether_guide_")
        self.addCleanup(holder.cleanup)
        folder = pathlib.Path(holder.name)
        (folder / "case.yaml").write_text(case_named("my_vessel"))
        (folder / "formula.yaml").write_text(case_named("my_vessel_cushion"))
        (folder / "flow.csv").write_text("time [s], flow [ml/s]\n0, 0\n0.1, 300\n0.3, 100\n0.5, 0\n")
        (folder / "surfaces").mkdir()
        rows = ["file, time [ms]"]
        for frame in range(6):
            write_tube(folder / f"surfaces/frame_{frame}.stl", 20 + 0.2 * frame, 100)  # [mm]
            rows.append(f"frame_{frame}.stl, {82.5 * (frame + 1)}")
        (folder / "surfaces/surfaces.csv").write_text("\n".join(rows) + "\n")
        for name in ("case.yaml", "formula.yaml"):
            told = subprocess.run([TETHER, "validate", name], cwd=folder, env=os.environ | AS_ROOT, capture_output=True, text=True)
            self.assertEqual((told.returncode, told.stderr), (0, ""), f"{name}: {told.stdout}")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
