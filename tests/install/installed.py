"""Tether in a place of installation, as users call it; run from an empty folder."""

import os
import pathlib
import subprocess
import tempfile
import unittest

BUILD = pathlib.Path(os.environ["TETHER_BUILD"])


def run(words, folder, **environment):
    clean = {name: value for name, value in os.environ.items() if name not in ("TETHER_CLIENT", "PYTHONPATH")}
    done = subprocess.run([str(word) for word in words], cwd=folder, capture_output=True, text=True, env=clean | environment)
    if done.returncode != 0:
        raise AssertionError(f"{words}: {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def state_of(folder):
    """What a run must leave as it is."""
    files = (path for path in folder.rglob("*") if path.is_file())
    return {str(path): (path.stat().st_mtime_ns, path.stat().st_size) for path in files}


COARSE = """base: {}/share/tether/configs/tube/case.yaml
name: small
time: {{step: 4e-3, end: 8e-3}}
mesh: {{swept: {{around: 12, along: 8}}}}
"""


class Installed(unittest.TestCase):
    """A prefix to install into and an empty folder to work in."""

    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.root = pathlib.Path(holder.name)
        self.work = self.root / "work"
        self.work.mkdir()

    def runs_cases(self, prefix):
        """Cases of the place are valid and run; results go to the folder in which one works, and nowhere else."""
        before = state_of(prefix)
        tether = prefix / "bin" / "tether"
        for case in sorted((prefix / "share/tether/configs").glob("*/case.yaml")):
            run([tether, "validate", case], self.work)
        (self.work / "small.yaml").write_text(COARSE.format(prefix))
        run([tether, "simulate", "small.yaml", "--quiet"], self.work)
        self.assertGreater((self.work / "out/small/summary.json").stat().st_size, 0)
        self.assertEqual(len((self.work / "out/small/timeseries.csv").read_text().splitlines()), 3)
        for plot in ("pressures.png", "wall.png"):  # by gnuplot, by tether_picture
            self.assertGreater((self.work / "out/small/plots" / plot).stat().st_size, 0)
        self.assertEqual(state_of(prefix), before)
