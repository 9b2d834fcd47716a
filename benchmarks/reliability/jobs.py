"""Jobs of the real programs on small cases, their processes, and whether they left what an undisturbed job leaves."""
import filecmp
import json
import os
import pathlib
import shutil
import signal
import subprocess
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAMS = pathlib.Path(os.environ.get("TETHER_PROGRAMS", ROOT / "build/bin"))
PRELOAD = PROGRAMS.parent / "tests/libtether_faults.so"
TETHER = PROGRAMS / "tether"

MODEL = """base: {root}/configs/tube/case.yaml
name: model
time: {{step: 4e-3, end: 0.12}}
mesh: {{swept: {{around: 12, along: 8}}}}
solid: {{support: {{regions: {{spine: {{stiffness: 0}}}}}}}}
output: {{write_every: 5, checkpoint_every: 5, points: {{spine: [-2, 0, 5]}}}}
identification:
  parameters:
    spine: {{of: [solid.support.regions.spine.stiffness], transform: log2, mean: 2e5, deviation: 2}}
diagnosis:
  candidates: [tissue_mass]
  exclude: [vicinity_left, vicinity_right, opposite, fluid.density, solid.density, fluid.rheology.viscosity]
twin:
  truth: held.yaml
  frames: 8
  image: {{voxel: [0, 0, 0]}}
  noise: {{deviation: 0.03 mm, correlation_length: 5 mm}}
  held_out: [3, 6]
  hidden: {{effects: {{visco_elastic: {{where: spine, amplitude: 4e5, unit: g/(cm2 s2)}}}}}}
"""
LONG = "base: model.yaml\nname: long\ntwin: ~\ntime: {step: 4e-3, end: 0.6}\n"
SEVERAL = "base: long.yaml\nname: several\ncoupling: {ranks: {fluid: 2, solid: 2}}\n"
FOREIGN = """base: {root}/docs/examples/ring_tube.yaml
name: foreign
time: {{step: 4e-3, end: 0.6}}
mesh: {{swept: {{around: 12, along: 8}}}}
output: {{write_every: 5, checkpoint_every: 5}}
coupling: {{ranks: {{solid: 2}}, programs: {{solid: ./foreign_wall.py}}}}
"""
FOREIGN_WALL = """#!/usr/bin/python3
import runpy, tether
plain = tether.serve
def shared(wall, own):
    answer = wall.evaluate
    wall.evaluate = lambda load: answer(own.allreduce(load) / 2)  # each waits for the other
    return wall
tether.serve = lambda role, make: plain(role, lambda own: shared(make(), own), together=True)
runpy.run_path("{root}/docs/examples/ring_solid.py")
"""
VERBS = {"several": "simulate", "foreign": "simulate"}  # jobs that are not called as their verb
TRUTH = "base: model.yaml\nname: held\ntwin: ~\nsolid: {support: {regions: {spine: {stiffness: 4e5}}}}\n"


def make_cases(folder):
    """The model, and the twin that the others are asked about."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "model.yaml").write_text(MODEL.format(root=ROOT))
    (folder / "held.yaml").write_text(TRUTH)
    (folder / "long.yaml").write_text(LONG)
    (folder / "several.yaml").write_text(SEVERAL)
    (folder / "foreign.yaml").write_text(FOREIGN.format(root=ROOT))
    wall = folder / "foreign_wall.py"
    wall.write_text(FOREIGN_WALL.format(root=ROOT))
    wall.chmod(0o755)
    if not (folder / "twin/case.yaml").exists():
        subprocess.run([TETHER, "twin", folder / "model.yaml", "--output", folder / "twin", "--quiet", "--overwrite"], env=environment(), check=True)


def environment(**more):
    return dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", PYTHONPATH=str(ROOT / "tools/python"), **more)


class Job:
    """One call of `tether VERB CASE --output FOLDER`, marked so that all its processes are found."""

    count = 0

    def __init__(self, verb, case, output, options=(), fault=None, name=None, on=None, **more):
        """`on`: the host, of a group that tests/hosts makes, on which it is called; otherwise this one."""
        Job.count += 1
        self.output, self.mark = output, f"reliability-{os.getpid()}-{Job.count}"
        self.flag = output.parent / f"{output.name}.flag"
        self.over = pathlib.Path(f"{self.flag}.over")
        for file in (self.flag, self.over):
            file.unlink(missing_ok=True)
        if fault:
            more |= {"LD_PRELOAD": str(PRELOAD), "TETHER_FAULT_ROOT": str(output), "TETHER_FAULT": fault, "TETHER_FAULT_FLAG": str(self.flag)}
        self.errors = open(output.parent / f"{name or output.name}.err", "w+")
        words, variables = [TETHER, VERBS.get(verb, verb), case, "--output", output, "--quiet", *options], environment(TETHER_TEST_JOB=self.mark, **more)
        pipes = {"stdout": subprocess.DEVNULL, "stderr": self.errors, "stdin": subprocess.DEVNULL}
        if on:
            self.process = on.group.start(on, words, output.parent, variables, **pipes)
        else:
            self.process = subprocess.Popen(words, start_new_session=True, preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL), env=variables, **pipes)

    def processes(self):
        """Of each that lives: its number and the name of its program."""
        mark, found = f"TETHER_TEST_JOB={self.mark}\0".encode(), []
        for place in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                if mark in (place / "environ").read_bytes() and "\nState:\tZ" not in (place / "status").read_text():
                    found.append((int(place.name), (place / "comm").read_text().strip()))
            except OSError:
                continue
        return sorted(found)

    def process_of(self, program):
        """The first process of a program, of "fluid+" the last of several; none yet: None."""
        numbers = [number for number, name in self.processes() if name == program.rstrip("+")[:15]]
        if program.endswith("+"):
            return numbers[-1] if len(numbers) > 1 else None
        return numbers[0] if numbers else None

    def let_go(self):
        """A program that waits goes on, and those that come after it."""
        self.over.touch()
        self.flag.unlink(missing_ok=True)

    def is_running(self):
        return self.process.poll() is None

    def end(self, limit):
        """Its exit code; None, and the end of all its processes, if it takes longer [s]."""
        try:
            return self.process.wait(limit)
        except subprocess.TimeoutExpired:
            self.kill_all()
            self.process.wait()
            return None

    def orphans(self, patience=10):
        """Processes that are left so long [s] after the end; ended here."""
        begin = time.time()
        while (left := [p for p in self.processes() if p[1] not in ("orted", "tether-reaper")]) and time.time() - begin < patience:
            time.sleep(0.05)
        self.kill_all()
        return [name for _, name in left]

    def kill_all(self):
        """Until none is left: one that dies may just have started another."""
        while left := self.processes():
            for number, _ in left:
                try:
                    os.kill(number, 9)
                except ProcessLookupError:
                    pass
            time.sleep(0.02)

    def message(self):
        self.errors.seek(0)
        return self.errors.read()


def without(value, names):
    """JSON without what differs from run to run."""
    if isinstance(value, dict):
        return {key: without(one, names) for key, one in value.items() if key not in names}
    return [without(one, names) for one in value] if isinstance(value, list) else value


def record(file):
    return without(json.loads(file.read_text()), {"cost", "seconds", "cpu_seconds", "wall_seconds", "date", "host", "notices", "versions", "folder"})


# Files that must be the same to the bit, and records that must be but for their cost.
LEFT = {
    "simulate": (("timeseries.csv", "lumen.motion", "fluid.pvd", "solid.pvd", "vtk/fluid_000150.vtu", "vtk/solid_000150.vtu"), ()),
    "several": (("timeseries.csv", "lumen.motion", "fluid.pvd", "solid.pvd", "vtk/fluid_000150.vtu", "vtk/solid_000150.vtu"), ()),
    "foreign": (("timeseries.csv", "lumen.motion", "fluid.pvd", "vtk/fluid_000150.vtu"), ()),
    "identify": (("estimate.csv",), ("estimate.json",)),
    "explain": ((), ("explain.json",)),
}


def differences(verb, one, other):
    """Names of what two folders of results have not alike."""
    files, records = LEFT[verb]
    absent = [name for name in files + records if not (one / name).exists() or not (other / name).exists()]
    return absent + [name for name in files if name not in absent and not filecmp.cmp(one / name, other / name, shallow=False)] + \
        [name for name in records if name not in absent and record(one / name) != record(other / name)]


def clean(output):
    shutil.rmtree(output, ignore_errors=True)
