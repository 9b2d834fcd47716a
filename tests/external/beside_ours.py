"""A code of somebody else's held against ours on the straight tube."""

import csv
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

COARSE = """base: {base}
name: {name}
time: {{step: 4e-3}}
mesh: {{swept: {{around: 16, along: 12}}}}
solid:
  support: {{regions: {{spine: {{stiffness: {spring}}}}}}}
"""
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
HIDDEN = 1e6  # g/(cm2 s2), the spring's


def columns(folder):
    with open(folder / "timeseries.csv", encoding="utf-8") as table:
        rows = list(csv.reader(table))
    return {name: [float(row[k]) for row in rows[1:]] for k, name in enumerate(rows[0])}


def largest_difference(one, other, name):
    """In shares of the range of `other`."""
    column = next(key for key in other if key.startswith(name))
    span = max(other[column]) - min(other[column])
    return max(abs(a - b) for a, b in zip(one[column], other[column], strict=True)) / span


class BesideOurs(unittest.TestCase):
    """tether, sources: set by run_with."""

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="tether_external_"))
        cls.addClassCleanup(shutil.rmtree, cls.folder, True)

    def call(self, *words):
        environment = os.environ | {"PYTHONPATH": str(self.sources / "tools/python"), "TETHER_PICTURES": "0"}
        done = subprocess.run([self.program, *map(str, words)], cwd=self.folder, env=environment, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, f"tether {' '.join(map(str, words))}\n{done.stdout}{done.stderr}")
        return done.stdout

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return path

    def assert_keeps_the_contract(self, program, case, other):
        told = self.call("conform", "--dt", "2e-3", "--with", other, program, case)
        self.assertNotIn("FAIL", told)
        self.assertIn("PASS", told)

    def assert_moves_as_ours(self, case, told):
        """`told`: largest differences over a beat that the README tells, in shares of the range, to a tenth of a per cent."""
        self.call("simulate", self.sources / "configs/tube/case.yaml", "--output", "ours", "--quiet")
        self.call("simulate", case, "--output", "theirs", "--quiet")
        ours, theirs = columns(self.folder / "ours"), columns(self.folder / "theirs")
        for name, difference in told.items():
            self.assertLess(largest_difference(theirs, ours, name), difference + 0.001, name)

    def assert_moves_as_one_process(self, one, several):
        """To the coupling's tolerance, as rounding in another order may take an iteration more or less."""
        for name, case in (("one", one), ("several", several)):
            self.call("simulate", case, "--steps", 20, "--output", name, "--quiet")
        alone, together = columns(self.folder / "one"), columns(self.folder / "several")
        for name in ("fluid.outlet.pressure", "fluid.outlet.flow", "interface.max_displacement"):
            self.assertLess(largest_difference(together, alone, name), 1e-6, name)

    def assert_goes_on_to_the_same_bits(self, case):
        self.call("simulate", case, "--steps", 40, "--output", "whole", "--quiet")
        self.call("simulate", case, "--steps", 20, "--output", "parts", "--quiet")
        self.call("simulate", case, "--steps", 40, "--output", "parts", "--resume", "--quiet")
        for name in ("timeseries.csv", "lumen.motion"):
            self.assertEqual((self.folder / "parts" / name).read_bytes(), (self.folder / "whole" / name).read_bytes(), name)

    def assert_identifies_the_spring(self, case, more=""):
        """Of data of ours, which hide it: its interval holds the truth. `more`: lines that the coarser case says below these."""
        tube = self.sources / "configs/tube/case.yaml"
        self.write("truth.yaml", COARSE.format(base=tube, name="truth", spring=HIDDEN))
        self.write("ours.yaml", COARSE.format(base=tube, name="ours", spring=0))
        self.call("twin", self.write("twin.yaml", TWIN), "--output", "twin", "--quiet")
        data = (self.folder / "twin/case.yaml").read_text()
        observations = data[data.index("observations:"):]
        self.write("twin/theirs.yaml", COARSE.format(base=case, name="theirs", spring=HIDDEN) + more + observations + IDENTIFICATION)
        self.call("identify", "twin/theirs.yaml", "--processes", 2, "--output", "identified", "--quiet")
        spring = json.loads((self.folder / "identified/estimate.json").read_text())["parameters"][0]["estimate"]
        self.assertLess(spring["lower_95"], HIDDEN)
        self.assertGreater(spring["upper_95"], HIDDEN)
        self.assertLess(spring["upper_95"] / spring["lower_95"], 4, "the data tell")


def run_with(arguments):
    """PROGRAM TETHER SOURCES, and what unittest takes."""
    BesideOurs.program, BesideOurs.sources = os.path.abspath(arguments[1]), pathlib.Path(arguments[2]).absolute()
    unittest.main(module="__main__", argv=[arguments[0], "--verbose", *arguments[3:]])
