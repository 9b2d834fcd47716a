"""tether.case: a case merged with those it builds on, as Tether itself reads it."""

import math
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools/python"))
import tether  # noqa: E402

CONFIGS = pathlib.Path(__file__).resolve().parents[2] / "configs"


class Case(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.scratch.name)
        self.addCleanup(self.scratch.cleanup)

    def write(self, name, text):
        (self.folder / name).write_text(text)
        return self.folder / name

    def test_merges_entry_by_entry_over_several_bases(self):
        (self.folder / "below").mkdir()
        self.write("below/first.yaml", "name: first\nsolid: {density: 1.2, material: {young: 4e6, poisson: 0.45}}\nlist: [1, 2]\nobserver: {gain: 3}\n")
        self.write("second.yaml", "base: below/first.yaml\nname: second\nsolid: {material: {young: 5e6}}\nobserver:\n")
        case = tether.case(self.write("third.yaml", "base: second.yaml\nsolid: {density: 400 kPa}\nlist: [3]\n"))
        self.assertEqual(case, {"name": "second", "solid": {"density": "400 kPa", "material": {"young": 5e6, "poisson": 0.45}}, "list": [3]})

    def test_a_file_is_where_the_case_that_names_it_says(self):
        (self.folder / "below").mkdir()
        self.write("below/first.yaml", "fluid: {inlet: {file: flow.csv, scale: 2}, tables: [{file: ../a.csv}, {file: /b.csv}]}\n")
        case = tether.case(self.write("second.yaml", "base: below/first.yaml\nsolid: {file: wall.msh}\n"))
        self.assertEqual(case["fluid"], {"inlet": {"file": f"{self.folder}/below/flow.csv", "scale": 2},
                                         "tables": [{"file": f"{self.folder}/below/../a.csv"}, {"file": "/b.csv"}]})
        self.assertEqual(case["solid"]["file"], f"{self.folder}/wall.msh")

    def test_reads_a_case_that_builds_on_the_tube(self):
        case = tether.case(CONFIGS / "hidden_effect/case.yaml")
        self.assertEqual(case["mesh"]["swept"]["around"], 16, "its own")
        self.assertEqual(case["mesh"]["swept"]["radius"], 2.0, "the tube's")
        self.assertEqual(case["solid"]["support"]["regions"]["spine"], {"stiffness": 0, "damping": 2e3})

    def test_a_curve_is_read_as_tether_reads_it(self):
        table = self.write("flow.csv", "# of a pump\ntime [s], pressure [mmHg], flow [ml/s]\n0.1, 70, 10\n0.3, 80, 30\n0.5, 75, 20\n")
        curve = tether.Curve(table, period=0.8, time="time", value="flow", scale=2)
        self.assertAlmostEqual(curve(0.2), 40)
        self.assertAlmostEqual(curve(0.5), 40)
        self.assertAlmostEqual(curve(0.7), 30, msg="back to the first value at the period's end")
        self.assertAlmostEqual(curve(0.2 + 3 * 0.8), 40)
        self.assertAlmostEqual(curve(0.05), 2 * (20 - 10 * 0.35 / 0.4), msg="before its first time: the end of a period")
        risen = tether.Curve(table, period=0.8, value="flow", ramp=0.4)
        self.assertAlmostEqual(risen(0.2), 10)
        self.assertAlmostEqual(risen(0.5), 20)

    def test_a_curve_names_the_column_that_is_not_there(self):
        table = self.write("flow.csv", "time [s], flow [ml/s]\n0, 10\n1, 10\n")
        with self.assertRaisesRegex(ValueError, "no column volume"):
            tether.Curve(table, period=1, value="volume")

    def test_a_windkessel_fills_as_its_equation_says_to_first_order(self):
        proximal, distal, compliance, below, flow, end = 100.0, 1500.0, 1e-3, 2e4, 50.0, 1.2

        def wrong_by(steps):
            stored, dt = 3e4, end / steps
            for _ in range(steps):
                windkessel = tether.Windkessel(proximal, distal, compliance, below, stored, dt)
                stored = windkessel.stored(flow)
            self.assertAlmostEqual(windkessel.offset + windkessel.slope * flow, stored + proximal * flow, places=7)
            settled = below + distal * flow
            return stored - (settled + (3e4 - settled) * math.exp(-end / (distal * compliance)))

        coarse, fine = wrong_by(40), wrong_by(80)
        self.assertLess(abs(fine), 0.01 * 6.5e4)
        self.assertAlmostEqual(coarse / fine, 2, delta=0.05)


if __name__ == "__main__":
    unittest.main()
