"""Jobs of Slurm over several hosts, one of them lost, and programs that srun starts: slurm_hosts_test.py TETHER CONFIGS. Where hosts
cannot be made, exit code 77."""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import host_group  # which leads to tests/batch
import cases
import slurm_on_hosts

TETHER, CONFIGS = pathlib.Path(sys.argv[1]).absolute(), pathlib.Path(sys.argv[2]).absolute()
HOSTS = 3


class SlurmOverHosts(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="tether_slurm_hosts_"))
        cls.addClassCleanup(shutil.rmtree, cls.folder, True)
        cls.group = host_group.HostGroup(cls.folder / "hosts", HOSTS)
        cls.addClassCleanup(cls.group.stop)
        cls.cluster = slurm_on_hosts.ClusterOnHosts(cls.folder / "slurm", cls.group)
        cls.addClassCleanup(cls.cluster.stop)
        cases.write_tube(cls.folder, CONFIGS, end=0.4)
        cls.identification = cases.write_twin(cls.folder, TETHER)
        cls.call(TETHER, "identify", cls.identification, "--processes", HOSTS, "--output", cls.folder / "here", "--quiet")
        cls.call(TETHER, "simulate", cls.folder / "tube.yaml", "--steps", "20", "--output", cls.folder / "run_here", "--quiet")

    @classmethod
    def call(cls, *words):
        subprocess.run(list(map(str, words)), env=os.environ | cases.AS_ROOT, check=True, capture_output=True)

    def on_first(self, *words):
        done = self.cluster.call(*map(str, words))
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def srun(self, tasks, hosts, *options):
        """Starts programs, a task each, on the hosts that are named for them."""
        (self.folder / "programs").write_text("".join(f"{k} {TETHER.parent / words}\n" for k, words in enumerate(tasks)))
        (self.folder / "places").write_text("\n".join(hosts) + "\n")
        words = [f"--ntasks={len(tasks)}", "--distribution=arbitrary", *options, "--multi-prog", f"{self.folder}/programs"]
        variables = [f"SLURM_HOSTFILE={self.folder}/places", "SLURM_PMIX_FENCE=ring"]
        return self.cluster.call("env", *variables, "timeout", str(120 * host_group.PATIENCE), "srun", "--mpi=pmix", "--kill-on-bad-exit=1", *words)

    def test_srun_starts_the_programs_of_a_run_on_three_hosts(self):
        case, output = self.folder / "tube.yaml", self.folder / "run_srun"
        done = self.srun([f"fsi_master {case} --steps 20 --output {output}", f"fluid {case}", f"solid {case}"], ["h0", "h1", "h2"])
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((output / "timeseries.csv").read_bytes(), (self.folder / "run_here/timeseries.csv").read_bytes())

    def test_srun_starts_several_processes_of_each_code_on_three_hosts(self):
        """To the bits of as many on one host."""
        case, here, output = self.folder / "ranks.yaml", self.folder / "ranks_here", self.folder / "ranks_srun"
        case.write_text("base: tube.yaml\nname: ranks\ncoupling: {ranks: {fluid: 2, solid: 2}}\n")
        self.call(TETHER, "simulate", case, "--steps", "20", "--output", here, "--quiet")
        done = self.srun([f"fsi_master {case} --steps 20 --output {output}", *[f"fluid {case}"] * 2, *[f"solid {case}"] * 2],
                         ["h0", "h0", "h1", "h1", "h2"], "--overcommit")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((output / "timeseries.csv").read_bytes(), (here / "timeseries.csv").read_bytes())

    def test_srun_starts_an_identification_with_a_model_on_each_host(self):
        case, output, hosts = self.identification, self.folder / "srun", ["h0", "h1", "h2"]
        programs = [f"identification_master {case} --output {output}"]
        for name in ("fsi_master", "observation_manager"):
            programs += [f"{name} {case}"] * HOSTS
        done = self.srun(programs, ["h0"] + hosts * 2, "--overcommit")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(cases.estimates(output), cases.estimates(self.folder / "here"))

    def test_a_program_that_srun_does_not_start_is_named_and_all_end(self):
        case = self.folder / "tube.yaml"
        done = self.srun([f"fsi_master {case} --output {self.folder}/alone", f"fluid {case}"], ["h0", "h1"])
        self.assertNotIn(done.returncode, (0, 124), "ended by itself")
        self.assertIn("the mpirun line has no solid for this fsi_master", done.stderr)

    def state_of(self, name):
        return self.on_first(TETHER, "status", self.folder / name).splitlines()[1].split()[1]

    def submit(self, name, nodes):
        self.on_first(TETHER, "submit", "identify", self.identification, "--processes", HOSTS, "--nodes", nodes, "--output", self.folder / name,
                      "--time", "20", "--memory", "1G")
        return json.loads((self.folder / name / "job/job.json").read_text())["number"]

    def models_on(self, host):
        return len(host.processes().get("fsi_master", []))

    def test_a_job_has_a_model_on_each_host_and_the_estimate_of_one(self):
        self.submit("over", HOSTS)
        self.cluster.wait(lambda: all(self.models_on(host) == 1 for host in self.group.hosts), 60, "a model on each host")
        self.cluster.wait(lambda: self.state_of("over") == "done", 120, "done")
        self.assertEqual(cases.estimates(self.folder / "over/springs"), cases.estimates(self.folder / "here"))

    def test_after_a_lost_host_the_job_goes_on_where_others_are(self):
        """The programs end before Slurm notices; then it starts the job again on the two that are left."""
        number = self.submit("lost", HOSTS - 1)
        saved = self.folder / "lost/springs/checkpoint/identification.bin"
        self.cluster.wait(saved.exists, 60, "a saved state")
        lost = next(host for host in self.group.hosts[1:] if self.models_on(host))
        lost.lose()
        try:
            self.cluster.wait(lambda: self.state_of("lost") == "done", 400, "done")
            self.assertIn("a node does not answer", (self.folder / f"lost/job/slurm-{number}.txt").read_text())
            self.assertIn("Restarts=1", self.on_first("scontrol", "show", "job", number))
            self.assertEqual(cases.estimates(self.folder / "lost/springs"), cases.estimates(self.folder / "here"))
        finally:
            self.cluster.mend()


if __name__ == "__main__":
    if not host_group.can_be_made():
        print("no rights to make hosts: namespaces, a bridge")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
