"""An identification over several hosts, and one of them lost: hosts_test.py TETHER CONFIGS. Where hosts cannot be made, exit code 77."""

import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import host_group  # which leads to tests/batch
import cases
from waiting import wait

TETHER, CONFIGS = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2]).absolute()
OURS = {"tether", "mpirun", "ssh", "orted", "identification_", "fsi_master", "fluid", "solid", "observation_man"}
KERNELS = {"OPENBLAS_CORETYPE": "Nehalem"}  # other last digits than those of the kernels that a host would choose by itself
NOTICED = 60  # [s]: half a minute without a word, and what programs then have to say to each other
IN_TWO = "base: springs.yaml\nname: in_two\ncoupling: {ranks: {fluid: 2, solid: 2}}\n"  # processes of each code


class Hosts(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="tether_hosts_"))
        cls.addClassCleanup(shutil.rmtree, cls.folder, True)
        cls.group = host_group.HostGroup(cls.folder / "hosts", 3)
        cls.addClassCleanup(cls.group.stop)
        cases.write_tube(cls.folder, CONFIGS, end=0.4)
        cases.write_twin(cls.folder, TETHER)
        (cls.folder / "twin/in_two.yaml").write_text(IN_TWO)
        cls.tether("identify", "twin/springs.yaml", "--processes", "3", "--output", "here", "--quiet")

    def setUp(self):
        self.group.mend()

    @classmethod
    def tether(cls, *words):
        subprocess.run([TETHER, *words], cwd=cls.folder, env=os.environ | cases.AS_ROOT | KERNELS, check=True, capture_output=True)

    def identify(self, name, *words, nodes="h0,h1,h2", case="springs", **more):
        line = [TETHER, "identify", f"twin/{case}.yaml", "--processes", "3", "--output", name, "--quiet", *words]
        return self.group.start(self.group.hosts[0], line, self.folder, cases.AS_ROOT | KERNELS | {"TETHER_NODES": nodes} | more,
                                stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

    def ours(self, host):
        return sorted(OURS & host.processes().keys())

    def wait_for_state(self, run, name):
        """Until something is saved. A run that ends before has said why."""
        saved = self.folder / name / "checkpoint/identification.bin"
        wait(lambda: saved.exists() or run.poll() is not None, 60, "a saved state")
        self.assertIsNone(run.poll(), run.poll() and run.stderr.read())

    def assert_told(self, run, host, name, case="springs"):
        told = host_group.told_by(run, NOTICED)
        self.assertEqual(run.returncode, 1, told)
        self.assertIn(f"tether: mpirun ended the run: no answer from {host}\n", told)
        self.assertIn(f"To continue: tether identify twin/{case}.yaml --output {name} --processes 3 --resume\n", told)
        ours = [line for line in told.splitlines() if not line.startswith("[")]  # not what mpirun's own servers log of each other
        self.assertLessEqual(len(ours), 4, told)

    def assert_nothing_left(self, seconds, *hosts):
        wait(lambda: not any(map(self.ours, hosts)), seconds, "the end of all processes")

    def assert_goes_on(self, name, nodes, case="springs", undisturbed="here"):
        run = self.identify(name, "--resume", nodes=nodes, case=case)
        self.assertEqual(host_group.told_by(run, 120), "")
        self.assertEqual(run.returncode, 0)
        self.assertEqual(cases.estimates(self.folder / name), cases.estimates(self.folder / undisturbed))

    def test_each_model_is_on_a_host_of_its_own_and_the_estimate_is_that_of_one_host(self):
        run = self.identify("over")
        wait(lambda: all({"fsi_master", "observation_man"} <= set(self.ours(host)) for host in self.group.hosts), 60,
                        "a model on each host")
        self.assertEqual((host_group.told_by(run, 120), run.returncode), ("", 0))
        self.assertEqual(cases.estimates(self.folder / "over"), cases.estimates(self.folder / "here"))

    def test_a_host_that_is_lost_is_named_and_the_others_go_on_to_the_same_bits(self):
        first, second, third = self.group.hosts
        run = self.identify("lost")
        self.wait_for_state(run, "lost")
        second.lose()
        self.assert_told(run, "h1", "lost")
        self.assert_nothing_left(10, first, third)
        self.assert_goes_on("lost", "h0,h2")

    def test_a_host_that_is_lost_with_a_model_in_several_processes_is_named_and_the_others_go_on(self):
        self.tether("identify", "twin/in_two.yaml", "--processes", "3", "--output", "in_two", "--quiet")
        first, second, third = self.group.hosts
        run = self.identify("lost_in_two", case="in_two")
        self.wait_for_state(run, "lost_in_two")
        self.assertEqual([len(second.processes()[code]) for code in ("fluid", "solid")], [2, 2])
        second.lose()
        self.assert_told(run, "h1", "lost_in_two", case="in_two")
        self.assert_nothing_left(10, first, third)
        self.assert_goes_on("lost_in_two", "h0,h2", case="in_two", undisturbed="in_two")

    def test_a_host_that_is_lost_while_it_starts_is_named(self):
        """Before its orted has called, only ssh knows of it."""
        run = self.identify("start")
        host = self.group.hosts[1]
        wait(lambda: "orted" in host.processes(), 30, "orted")
        host.lose()
        told = host_group.told_by(run, NOTICED)
        self.assertEqual(run.returncode, 1, told)
        self.assertIn("tether: mpirun ended the run: no answer from h1\n", told)
        self.assert_nothing_left(10, self.group.hosts[0], self.group.hosts[2])

    def test_the_first_host_is_this_one(self):
        run = self.identify("elsewhere", nodes="h1,h0")
        self.assertEqual(host_group.told_by(run, 30), "TETHER_NODES: h1 is not this machine (h0), which must be the first\n")
        self.assertEqual(run.returncode, 2)

    def test_a_host_that_is_cut_off_ends_its_processes(self):
        run = self.identify("cut")
        self.wait_for_state(run, "cut")
        cut = self.group.hosts[2]
        cut.cut()
        self.assert_told(run, "h2", "cut")
        self.assert_nothing_left(NOTICED, *self.group.hosts)
        self.group.mend()
        self.assert_goes_on("cut", "h0,h1,h2")

    def test_if_the_first_host_is_lost_nothing_stays_on_the_others(self):
        first, *others = self.group.hosts
        run = self.identify("first")
        self.wait_for_state(run, "first")
        first.lose()
        run.wait(10)
        run.stderr.close()
        self.assert_nothing_left(NOTICED, *others)
        self.group.mend()
        self.assert_goes_on("first", "h0,h1,h2")

    def test_a_process_that_dies_on_another_host_is_told(self):
        for program, told_as in (("fsi_master", "the master"), ("observation_man", "observation_manager")):
            with self.subTest(program):
                name = f"died_{program}"
                run = self.identify(name)
                self.wait_for_state(run, name)
                os.kill(self.group.hosts[1].processes()[program][0], signal.SIGKILL)
                told = host_group.told_by(run, 40)
                self.assertEqual(run.returncode, 1, told)
                self.assertRegex(told, rf"{told_as} \(pid \d+ on h1\) died while .*")
                self.assert_nothing_left(10, *self.group.hosts)

    def test_a_process_that_is_stopped_on_another_host_is_told(self):
        run = self.identify("stopped", TETHER_STOPPED_LIMIT="5")
        self.wait_for_state(run, "stopped")
        os.kill(self.group.hosts[1].processes()["fsi_master"][0], signal.SIGSTOP)
        began = time.monotonic()
        told = host_group.told_by(run, 40)
        self.assertLess(time.monotonic() - began, 20 * host_group.PATIENCE)
        self.assertEqual(run.returncode, 1, told)
        self.assertRegex(told, r"\(pid \d+ on h1\) was stopped while .*, and still is 5 s later")
        self.assert_nothing_left(10, *self.group.hosts)


if __name__ == "__main__":
    if not host_group.can_be_made():
        print("no rights to make hosts: namespaces, a bridge")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
