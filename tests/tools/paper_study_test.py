"""benchmarks/paper_study: what it keeps, and what it computes of results; no run is made."""
import json
import math
import os
import pathlib
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAMS = tempfile.TemporaryDirectory()
os.environ["TETHER_PROGRAMS"] = PROGRAMS.name
sys.path.insert(0, str(ROOT / "benchmarks/paper_study"))

import distances
import lumens
import models
import numpy
import page
import workshop

# Writes what a verb would, and counts its calls.
FAKE = """#!/bin/sh
verb=$1 case=$2 folder=$4
mkdir -p $folder && echo '{}' > $folder/summary.json && echo $verb >> $folder/calls
"""


class KeptSteps(unittest.TestCase):
    def setUp(self):
        tether = pathlib.Path(PROGRAMS.name) / "tether"
        tether.write_text(FAKE)
        tether.chmod(0o755)
        self.folder = tempfile.TemporaryDirectory()

    def tearDown(self):
        self.folder.cleanup()

    def run_of(self, stiffness, step):
        shop = workshop.Workshop(pathlib.Path(self.folder.name), quiet=True)
        (shop.folder / "base.yaml").write_text(f"name: base\ntime: {{step: {step}}}\n")
        case = shop.case("a", shop.folder / "base.yaml", {"solid.support.k": stiffness, "solid.rho": 1})
        return (shop.make("simulate", case) / "calls").read_text().count("simulate"), case.read_text()

    def test_a_step_is_made_once_and_again_if_its_case_or_base_changed(self):
        calls, text = self.run_of(1, 2)
        self.assertEqual(text, 'base: base.yaml\nname: a\nsolid: {"support": {"k": 1}, "rho": 1}\n')
        self.assertEqual(calls, 1)
        self.assertEqual(self.run_of(1, 2)[0], 1)
        self.assertEqual(self.run_of(3, 2)[0], 2)
        self.assertEqual(self.run_of(3, 4)[0], 3)

    def test_a_step_that_breaks_off_ends_no_other_and_is_told(self):
        shop = workshop.Workshop(pathlib.Path(self.folder.name), quiet=True)
        (pathlib.Path(PROGRAMS.name) / "tether").write_text("#!/bin/sh\necho 'step 3'; echo 'the wall folds' >&2; exit 1\n")
        (shop.folder / "base.yaml").write_text("name: base\n")
        made = shop.those_made({"folds": lambda: shop.make("simulate", shop.case("a", shop.folder / "base.yaml", {})), "is there": lambda: 3})
        self.assertEqual(made, {"is there": 3})
        self.assertEqual(shop.broken, {"a": "the wall folds"})
        self.assertIn("- `a`: the wall folds", page.broken(shop.broken))
        self.assertEqual(page.broken({}), "")


class Computed(unittest.TestCase):
    def test_distances_are_in_mm_and_absent_where_nothing_was_measured(self):
        seen = lambda l2: {"samples": 5, "l2": l2, "linf": 2 * l2}
        group = lambda region, l2, apparent: {"region": region, **seen(l2), "apparent": seen(apparent)}
        groups = [group(None, 9, 9), group("spine", 0.1, 0.3), *(group(r, 0.2, 0.4) for r in distances.ERROR_REGIONS if r not in ("spine", "arch")),
                  {"region": "arch", "samples": 0, "apparent": {"samples": 0}}]
        with tempfile.TemporaryDirectory() as folder:
            record = {"sources": [{"name": "twin", "moments": [{"time": 0.1, "groups": groups}]}]}
            (pathlib.Path(folder) / "comparison.json").write_text(json.dumps(record))
            (found,), (apparent,) = distances.moments(pathlib.Path(folder)), distances.moments(pathlib.Path(folder), apparent=True)
        self.assertEqual((found.time, found.l2["spine"], found.linf["spine"], apparent.l2["spine"]), (0.1, 1, 2, 3))
        self.assertTrue(math.isnan(found.l2["arch"]) and math.isnan(apparent.linf["arch"]))

    def test_a_plane_cuts_a_tube_in_a_circle(self):
        angles = numpy.linspace(0, 2 * math.pi, 48, endpoint=False)
        points = numpy.array([[math.cos(a), math.sin(a), z] for z in (-1, 1) for a in angles])
        triangles = numpy.array([t for i in range(48) for j in [(i + 1) % 48] for t in ([i, j, 48 + i], [j, 48 + j, 48 + i])])
        segments = lumens.cut(points, triangles, numpy.zeros(3), numpy.array([0, 0, 1.0]), 5)
        self.assertEqual(len(segments), 96)
        for end in numpy.array(segments).reshape(-1, 2):
            self.assertAlmostEqual(numpy.linalg.norm(end), 10, delta=0.03)

    def test_every_part_has_a_mother_among_the_four(self):
        numbers = lambda of: sorted(n for targets in of for n in targets)
        self.assertEqual(numbers(models.FOUR.values()), numbers(t for t, _ in models.ELEVEN.values()))
        self.assertEqual(len(models.ELEVEN), 11)
        for name, (targets, mother) in models.ELEVEN.items():
            self.assertLessEqual(set(targets), set(models.FOUR[mother or name]))

    def test_tables_say_whether_the_truth_is_inside(self):
        row = {"truth": 1e6, "value": 9e5, "lower": 7e5, "upper": 1.2e6, "deviations": -0.5, "after_before": 0.1, "retained": 0.8}
        self.assertIn("| spine 1 | 1e+06 | 9e+05 | 7e+05 .. 1.2e+06 | yes | -0.50 | 0.10 | 0.80 |", page.found_table({"spine_1": row}))
        self.assertEqual(page.inside({"a": row, "b": {**row, "upper": 9.5e5}}), "1 of 2")


if __name__ == "__main__":
    unittest.main()
