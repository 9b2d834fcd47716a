"""The wall of configs/external_dolfinx beside ours: dolfinx_test.py TETHER SOURCES."""

import csv
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

TETHER, SOURCES = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2]).absolute()
CASE = SOURCES / "configs/external_dolfinx/case.yaml"

ONE_PROCESS = f"""base: {CASE}
name: one_process
coupling: {{ranks: {{solid: 1}}, programs: {{solid: {CASE.parent}/wall.py}}}}
output: {{checkpoint_every: 10}}
"""
COARSE = """base: {base}
name: {name}
time: {{step: 4e-3}}
mesh: {{swept: {{around: 16, along: 12}}}}
"""
COARSE_WALL = "solid: {mesh: {around: 16, along: 6}}\ncoupling: {ranks: {solid: 1}, programs: {solid: WALL}}\n".replace("WALL", f"{CASE.parent}/wall.py")
TWIN = """base: ours.yaml
name: twin
twin:
  truth: truth.yaml
  seed: 1
  frames: 10
  image: {voxel: [0.6 mm, 0.6 mm, 1 mm], blur: 0.4 mm}
  noise: {deviation: 0.15 mm, correlation_length: 5 mm}
  hidden: {effects: {visco_elastic: {where: spine, amplitude: 1e6, unit: g/(cm2 s2)}}}
"""
IDENTIFICATION = """
identification:
  parameters:
    spine: {of: [solid.support.regions.spine.stiffness], mean: 3e5}
"""


def columns(folder):
    with open(folder / "timeseries.csv", encoding="utf-8") as table:
        rows = list(csv.reader(table))
    return {name: [float(row[k]) for row in rows[1:]] for k, name in enumerate(rows[0])}


def largest_difference(one, other, name):
    """In shares of the range of `other`."""
    column = next(key for key in other if key.startswith(name))
    span = max(other[column]) - min(other[column])
    return max(abs(a - b) for a, b in zip(one[column], other[column], strict=True)) / span


class DolfinxWall(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="tether_dolfinx_"))
        cls.addClassCleanup(shutil.rmtree, cls.folder, True)

    def tether(self, *words):
        environment = os.environ | {"PYTHONPATH": str(SOURCES / "tools/python"), "TETHER_PICTURES": "0"}
        done = subprocess.run([TETHER, *map(str, words)], cwd=self.folder, env=environment, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, f"tether {' '.join(map(str, words))}\n{done.stdout}{done.stderr}")
        return done.stdout

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return path

    def test_keeps_the_contract(self):
        told = self.tether("conform", "--dt", "2e-3", "--with", "fluid", CASE.parent / "wall.py", CASE)
        self.assertNotIn("FAIL", told)
        self.assertIn("PASS", told)

    def test_moves_as_ours_over_a_beat(self):
        """As the README says, to a tenth of a per cent of the range: what is left is the meshes' difference."""
        self.tether("simulate", SOURCES / "configs/tube/case.yaml", "--output", "ours", "--quiet")
        self.tether("simulate", CASE, "--output", "theirs", "--quiet")
        ours, theirs = columns(self.folder / "ours"), columns(self.folder / "theirs")
        for name, told in {"fluid.outlet.pressure": 0.008, "fluid.outlet.flow": 0.007, "interface.max_displacement": 0.009,
                           "point.spine.displacement_length": 0.014}.items():
            self.assertLess(largest_difference(theirs, ours, name), told + 0.001, name)

    def test_goes_on_to_the_same_bits(self):
        case = self.write("one_process.yaml", ONE_PROCESS)
        self.tether("simulate", case, "--steps", 40, "--output", "whole", "--quiet")
        self.tether("simulate", case, "--steps", 20, "--output", "parts", "--quiet")
        self.tether("simulate", case, "--steps", 40, "--output", "parts", "--resume", "--quiet")
        for name in ("timeseries.csv", "lumen.motion"):
            self.assertEqual((self.folder / "parts" / name).read_bytes(), (self.folder / "whole" / name).read_bytes(), name)

    def test_identifies_the_spring_that_data_of_ours_hide(self):
        """The truth is a run of Tether's wall, the model has dolfinx's: the interval holds the hidden spring."""
        self.write("truth.yaml", COARSE.format(base=SOURCES / "configs/tube/case.yaml", name="truth"))
        self.write("ours.yaml", COARSE.format(base=SOURCES / "configs/tube/case.yaml", name="ours") + "solid: {support: {regions: {spine: {stiffness: 0}}}}\n")
        self.tether("twin", self.write("twin.yaml", TWIN), "--output", "twin", "--quiet")
        data = (self.folder / "twin/case.yaml").read_text()
        observations = data[data.index("observations:"):]
        self.write("twin/theirs.yaml", COARSE.format(base=CASE, name="theirs") + COARSE_WALL + observations + IDENTIFICATION)
        self.tether("identify", "twin/theirs.yaml", "--processes", 2, "--output", "identified", "--quiet")
        spring = json.loads((self.folder / "identified/estimate.json").read_text())["parameters"][0]["estimate"]
        self.assertLess(spring["lower_95"], 1e6)
        self.assertGreater(spring["upper_95"], 1e6)
        self.assertLess(spring["upper_95"] / spring["lower_95"], 4, "the data tell")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "--verbose", *sys.argv[3:]])
