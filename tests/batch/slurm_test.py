"""Jobs of tether submit on a Slurm that runs on this machine: slurm_test.py TETHER CONFIGS."""

import csv
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import cases
import slurm_cluster

TETHER, CONFIGS = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2]).absolute()


def content(folder):
    return {name: (folder / name).read_bytes() for name in ("timeseries.csv", "lumen.motion")}


class Jobs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="tether_slurm_"))
        cls.cluster = slurm_cluster.Cluster(cls.folder / "slurm")
        cls.addClassCleanup(shutil.rmtree, cls.folder, True)
        cls.addClassCleanup(cls.cluster.stop)
        cases.write_tube(cls.folder, CONFIGS, more="output: {checkpoint_every: 20}\n")
        (cls.folder / "long.yaml").write_text("base: tube.yaml\nname: long\ntime: {end: 6.6}\n")  # eight beats: it still runs when a test disturbs it
        for case, output in (("tube.yaml", "undisturbed"), ("long.yaml", "undisturbed_long")):
            cls.tether("simulate", case, "--output", output, "--quiet")

    @classmethod
    def run_tether(cls, *words):
        return subprocess.run([TETHER, *words], cwd=cls.folder, env=cls.cluster.environment, capture_output=True, text=True)

    @classmethod
    def tether(cls, *words):
        done = cls.run_tether(*words)
        if done.returncode != 0:
            raise AssertionError(f"tether {' '.join(words)}: {done.returncode}\n{done.stdout}{done.stderr}")
        return done.stdout

    def make_twin(self):
        if not (self.folder / "twin/case.yaml").exists():
            cases.write_twin(self.folder, TETHER)

    def submit(self, name, *words):
        self.tether("submit", *words, "--output", name, "--time", "20", "--memory", "1G")
        return json.loads((self.folder / name / "job/job.json").read_text())["number"]

    def states(self, name):
        lines = self.tether("status", name).splitlines()[1:]
        return {line.split()[0]: line.split()[1] for line in lines}

    def wait_for(self, name, state, seconds=120):
        self.cluster.wait(lambda: set(self.states(name).values()) == {state}, seconds, f"{name} {state}")

    def wait_for_state_of(self, folder):
        self.cluster.wait(lambda: (self.folder / folder / "checkpoint").is_dir(), 60, f"a checkpoint in {folder}")

    def test_an_array_has_one_table_of_results(self):
        (self.folder / "walls.csv").write_text("name, solid.material.young [kPa]\n" + "".join(f"wall_{k}, {400 + 100 * k}\n" for k in range(6)))
        self.submit("walls", "simulate", "tube.yaml", "--table", "walls.csv")
        self.wait_for("walls", "done")
        self.tether("results", "walls")
        with open(self.folder / "walls/results.csv", encoding="utf-8") as table:
            rows = list(csv.DictReader(table))
        self.assertEqual([row["case"] for row in rows], [f"wall_{k}" for k in range(6)])
        moved = [float(row["largest displacement [mm]"]) for row in rows]
        self.assertEqual(moved, sorted(moved, reverse=True), "a stiffer wall moves less")
        self.assertEqual(content(self.folder / "walls/wall_0"), content(self.folder / "undisturbed"), "400 kPa is the tube's own")
        (self.folder / "wrong.csv").write_text("name, solid.material.young [kPa]\nwall_0, 400\nwall_1, -1\n")
        refused = self.run_tether("submit", "simulate", "tube.yaml", "--table", "wrong.csv", "--output", "walls", "--overwrite")
        self.assertEqual(refused.returncode, 2, refused.stderr)
        self.assertIn("wrong.csv:3", refused.stderr)
        self.assertEqual(set(self.states("walls").values()), {"done"}, "a job that is not replaced stays")
        self.assertFalse((self.folder / "walls/cases.new").exists())

    def test_at_its_limit_of_time_it_saves_and_goes_on_to_the_same_bits(self):
        number = self.submit("limited", "simulate", "long.yaml")
        self.wait_for_state_of("limited/long")
        self.cluster.ask("scancel", "--signal=USR1", "--batch", number)
        self.wait_for("limited", "done", 300)
        log = (self.folder / "limited/job/long.log").read_text()
        self.assertIn("told to save its state and end in step", log)
        self.assertEqual(content(self.folder / "limited/long"), content(self.folder / "undisturbed_long"))

    def test_a_task_at_its_limit_leaves_the_others_of_its_array_alone(self):
        """The last task of an array has the array's own number."""
        (self.folder / "pair.csv").write_text("name, solid.material.young [kPa]\none, 400\ntwo, 400\n")
        number = self.submit("pair", "simulate", "long.yaml", "--table", "pair.csv")
        self.wait_for_state_of("pair/two")
        self.cluster.ask("scancel", "--signal=USR1", "--batch", f"{number}_1")
        self.wait_for("pair", "done", 300)
        restarts = {k: self.cluster.ask("scontrol", "show", "job", f"{number}_{k}") for k in (0, 1)}
        self.assertIn("Restarts=0", restarts[0])
        self.assertIn("Restarts=1", restarts[1])
        for name in ("one", "two"):
            self.assertEqual(content(self.folder / "pair" / name), content(self.folder / "undisturbed_long"), name)

    def test_preempted_it_goes_on_from_its_latest_state_to_the_same_bits(self):
        self.submit("preempted", "simulate", "long.yaml")
        self.wait_for_state_of("preempted/long")
        self.cluster.ask("sbatch", "--partition=urgent", "--nodes=3", "--exclusive", "--output=/dev/null", "--wrap=sleep 3")
        self.cluster.wait(lambda: self.states("preempted") == {"long": "waiting"}, 60, "preempted")
        self.wait_for("preempted", "done", 300)
        self.assertEqual(content(self.folder / "preempted/long"), content(self.folder / "undisturbed_long"))

    def test_a_diagnosis_which_calls_mpirun_twice_comes_to_its_end(self):
        self.make_twin()
        (self.folder / "twin/lack.yaml").write_text("base: case.yaml\nname: lack\ndiagnosis: {candidates: [visco_elastic], numerics: false}\n")
        self.submit("lack", "diagnose", "twin/lack.yaml", "--processes", "2")
        self.wait_for("lack", "done", 300)
        self.tether("results", "lack")
        with open(self.folder / "lack/results.csv", encoding="utf-8") as table:
            row = next(csv.DictReader(table))
        self.assertEqual(row["verdict"], json.loads((self.folder / "lack/lack/diagnosis.json").read_text())["verdict"])

    def test_a_job_that_runs_is_not_replaced(self):
        number = self.submit("kept", "simulate", "tube.yaml")
        for more in ([], ["--overwrite"], ["--overwrite", "--dry-run"]):
            refused = self.run_tether("submit", "simulate", "tube.yaml", "--output", "kept", "--time", "20", "--memory", "1G", *more)
            self.assertEqual(refused.returncode, 2)
            self.assertIn("holds a job" if not more else f"its job {number} still waits or runs", refused.stderr)
        self.wait_for("kept", "done")
        self.tether("submit", "simulate", "tube.yaml", "--output", "kept", "--time", "20", "--memory", "1G", "--overwrite", "--sbatch", "hold")
        self.assertEqual(self.states("kept"), {"tube": "waiting"}, "what the job before left is not this one's")
        self.tether("results", "kept")
        self.assertEqual((self.folder / "kept/results.csv").read_text(), "case,state\ntube,waiting\n")

    def test_one_that_a_person_gives_to_sbatch_is_told_of(self):
        self.tether("submit", "simulate", "tube.yaml", "--output", "by_hand", "--time", "20", "--memory", "1G", "--dry-run")
        self.assertIn("not submitted", self.tether("status", "by_hand"))
        self.cluster.ask("sbatch", str(self.folder / "by_hand/job/script.sh"))
        self.wait_for("by_hand", "done")

    def test_where_slurm_does_not_answer_that_is_told(self):
        self.submit("silent", "simulate", "tube.yaml")
        self.wait_for("silent", "done")
        for broken in ({"SLURM_CONF": "/nonexistent"}, {"PATH": "/nonexistent"}):
            told = subprocess.run([TETHER, "status", "silent"], cwd=self.folder, env=self.cluster.environment | broken, capture_output=True, text=True)
            self.assertEqual(told.returncode, 0)
            self.assertIn("Slurm does not answer", told.stderr)
            self.assertIn("done", told.stdout)

    def test_what_a_person_cancels_stays_so(self):
        number = self.submit("cancelled", "simulate", "long.yaml")
        self.wait_for_state_of("cancelled/long")
        self.cluster.ask("scancel", number)
        self.cluster.wait(lambda: self.states("cancelled") != {"long": "running"}, 60, "cancelled")
        self.assertIn(self.states("cancelled")["long"], ("gone", "failed"))
        self.assertNotIn("PENDING", self.cluster.ask("squeue", "--noheader", "--jobs", number, "--format=%T"))

    def test_an_identification_has_its_models_on_three_nodes(self):
        self.make_twin()
        self.submit("springs", "identify", "twin/springs.yaml", "--nodes", "3", "--processes", "3")
        self.cluster.wait(lambda: nodes_of("fsi_master", self.folder / "twin/springs.yaml") == {"n0", "n1", "n2"}, 60, "a model on each node")
        self.wait_for("springs", "done")
        self.tether("identify", "twin/springs.yaml", "--processes", "3", "--output", "here", "--quiet")
        self.assertEqual(cases.estimates(self.folder / "springs/springs"), cases.estimates(self.folder / "here"))

    def test_what_is_wrong_is_told_before_it_waits(self):
        refused = self.run_tether("submit", "simulate", "tube.yaml", "--output", "nowhere", "--time", "20", "--memory", "1G", "--partition", "moon")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("invalid partition specified: moon", refused.stderr)
        (self.folder / "wrong.yaml").write_text("base: tube.yaml\nname: wrong\nsolid: {material: {young: -1}}\n")
        refused = self.run_tether("submit", "simulate", "wrong.yaml", "--output", "wrong")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("solid.material.young", refused.stderr)


def nodes_of(program, case_file):
    """TETHER_NODE of the programs of that name that work on a case."""
    nodes = set()
    for process in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            words = (process / "cmdline").read_bytes().decode().split("\0")
            variables = dict(line.split("=", 1) for line in (process / "environ").read_bytes().decode().split("\0") if "=" in line)
        except (OSError, UnicodeDecodeError):
            continue
        if os.path.basename(words[0]) == program and str(case_file) in words and "TETHER_NODE" in variables:
            nodes.add(variables["TETHER_NODE"])
    return nodes


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "--verbose", *sys.argv[3:]])
