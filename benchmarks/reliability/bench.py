"""Faults of processes and files in jobs of the real programs, and what they lead to."""
import json
import os
import signal
import time

from circumstances import circumstances
from hosts import hosts_faults
from jobs import Job, TETHER, clean, differences

STOPPED_LIMIT = 5  # [s], for what takes a minute otherwise
SIGNALS = {"KILL": signal.SIGKILL, "TERM": signal.SIGTERM, "INT": signal.SIGINT, "STOP": signal.SIGSTOP}
# Programs that live in a phase, and what makes it begin: a file of the output that has so many lines, or a call of a program on a file.
PHASES = {
    "simulate": {
        "start": ("tether", "mpirun", "fsi_master", "fluid", "solid"),
        "step": ("tether", "mpirun", "fsi_master", "fluid", "solid"),
        "checkpoint": ("tether", "mpirun", "fsi_master", "fluid", "solid"),
        "report": ("tether", "tether_picture", "gnuplot"),
    },
    "several": {  # simulate, with two processes of fluid and of solid
        "start": ("fluid+", "solid+"),
        "step": ("fluid", "fluid+", "solid", "solid+"),
        "checkpoint": ("fluid+", "solid+"),
    },
    "foreign": {  # simulate, with a foreign wall of two processes
        "start": ("foreign_wall.py", "foreign_wall.py+"),
        "step": ("foreign_wall.py", "foreign_wall.py+"),
        "checkpoint": ("foreign_wall.py", "foreign_wall.py+"),
    },
    "identify": {
        "start": ("identification_master", "fsi_master"),
        "step": ("tether", "mpirun", "identification_master", "fsi_master", "observation_manager"),
        "checkpoint": ("tether", "identification_master", "fsi_master", "observation_manager"),
        "report": ("tether", "gnuplot"),
    },
    "explain": {
        "first run": ("tether", "fsi_master", "solid"),
        "diagnosis": ("tether", "mpirun", "identification_master", "fsi_master"),
        "report": ("tether",),
    },
}
PAUSES = {  # where a program waits until the fault was made
    ("simulate", "checkpoint"): "fsi_master:rename:checkpoint:5:PAUSE",
    ("several", "checkpoint"): "fsi_master:rename:checkpoint:5:PAUSE",
    ("foreign", "checkpoint"): "fsi_master:rename:checkpoint:5:PAUSE",
    ("simulate", "report"): "{}:open:plots/:1:PAUSE",
    ("identify", "checkpoint"): "identification_master:rename:identification.bin:2:PAUSE",
    ("identify", "report"): "{}:open:plots/:1:PAUSE",
    ("explain", "report"): "tether:open:explain.json:1:PAUSE",
}
LINES = {("several", "step"): ("timeseries.csv", 8), ("foreign", "step"): ("timeseries.csv", 8), ("simulate", "step"): ("timeseries.csv", 8), ("simulate", "later"): ("timeseries.csv", 14), ("identify", "step"): ("estimate.csv", 8), ("identify", "later"): ("estimate.csv", 14), ("explain", "first run"): ("model_0/timeseries.csv", 8),
         ("explain", "diagnosis"): ("diagnosis_1/coarse/runs/solid.material.young/timeseries.csv", 4)}
WRITES = {  # program, call, part of the path, which of them
    "simulate": [("tether", "mkdir", "", 1), ("tether", "open", ".lock", 1), ("fsi_master", "open", "case_as_run.yaml", 1), ("fsi_master", "open", "timeseries.csv", 1),
                 ("fsi_master", "open", "lumen.motion", 1), ("fsi_master", "write", "case_as_run.yaml", 1), ("fsi_master", "write", "timeseries.csv", 1),
                 ("fsi_master", "write", "timeseries.csv", 12), ("fsi_master", "write", "lumen.motion", 1), ("fsi_master", "write", "lumen.motion", 12),
                 ("fsi_master", "mkdir", "checkpoint.new", 2), ("fsi_master", "open", "checkpoint.new/solid.bin", 2), ("fsi_master", "write", "checkpoint.new/master.bin", 1),
                 ("fsi_master", "write", "checkpoint.new/fluid.bin", 2), ("fsi_master", "sync", "checkpoint.new", 2), ("fsi_master", "rename", "checkpoint.previous", 1),
                 ("fsi_master", "rename", "checkpoint", 3), ("fsi_master", "open", "summary.json", 1), ("fsi_master", "write", "summary.json", 1),
                 ("fluid", "open", "vtk/fluid", 1), ("fluid", "write", "vtk/fluid", 3), ("fluid", "write", "fluid.pvd", 2), ("fluid", "rename", "fluid.pvd", 2),
                 ("solid", "mkdir", "vtk", 1), ("solid", "open", "vtk/solid", 2), ("solid", "write", "vtk/solid", 5), ("solid", "write", "solid.pvd", 3), ("solid", "write", "rest.json", 1),
                 ("tether", "mkdir", "plots", 1), ("tether", "write", "plots", 1), ("tether_picture", "open", "wall.png", 1), ("tether_picture", "write", "blood.png", 20),
                 ("gnuplot", "open", "plots/flows.png", 1), ("gnuplot", "write", "plots/flows.png", 3)],
    "identify": [("identification_master", "open", "estimate.csv", 1), ("identification_master", "write", "estimate.csv", 9), ("identification_master", "write", "identification.new", 2),
                 ("identification_master", "rename", "identification.bin", 1), ("identification_master", "write", "estimate.json", 1), ("identification_master", "write", "identified.yaml", 1),
                 ("tether", "write", "estimate.gnuplot", 1)],
    "explain": [("tether", "open", "steps.json", 1), ("tether", "write", "diagnosis.json", 1), ("tether", "write", "explain.json", 1), ("tether", "open", "report.html", 1),
                ("tether", "write", "report.html", 2), ("identification_master", "write", "run.json", 3), ("fsi_master", "write", "lumen.motion", 9), ("tether", "write", "candidates.yaml", 1)],
}
ERRORS = ("ENOSPC", "EDQUOT", "EIO", "EACCES")


class Bench:
    def __init__(self, folder):
        self.folder, self.known = folder, {}
        self.file = folder / "results.json"
        if self.file.exists():
            self.known = json.loads(self.file.read_text())

    def case(self, verb):
        """What the verb is given."""
        return self.folder / "cases" / {"simulate": "long.yaml", "several": "several.yaml", "foreign": "foreign.yaml"}.get(verb, "twin/case.yaml")

    def whole(self, verb):
        """The folder of an undisturbed job of these programs: explain.json names the commit that they were built from."""
        output = self.folder / f"{verb}_whole"
        done = output / ".done"
        if not done.exists() or done.stat().st_mtime < TETHER.stat().st_mtime:
            clean(output)
            job = Job(verb, self.case(verb), output)
            if (code := job.end(600)) != 0:
                raise SystemExit(f"tether {verb} without a fault ended with {code}: {job.message()}")
            done.touch()
        return output

    def output(self, verb):
        return self.folder / f"{verb}_job"

    def told(self, job):
        return job.message().replace(f"{self.folder}/", "").replace(f"{TETHER.parent}/", "")

    def judge(self, verb, job, code, end, **more):
        """What a fault led to, and what the same command finds after it."""
        result = {"code": code, "seconds": round(end, 1), "message": self.told(job), "orphans": job.orphans(), **more}
        output = self.output(verb)
        is_saved = any(file.suffix != ".new" for name in ("checkpoint", "checkpoint.previous") for file in output.glob(f"{name}/*"))
        options = [] if verb == "explain" or code == 0 else ["--resume"] if is_saved else ["--overwrite"]
        if code != 0 or verb == "explain":
            again = Job(verb, self.case(verb), output, options)
            result["again"] = again.end(600)
            result["again_message"] = self.told(again)
            result["resumed"] = "--resume" in options
        result["differs"] = differences(verb, self.whole(verb), output)
        return result

    def again(self, verb, job):
        """What a command leads to that finds a fault; where it refuses to go on from there: what it does anew."""
        begin = time.time()
        result = {"code": job.end(300), "seconds": round(time.time() - begin, 1), "message": self.told(job), "orphans": job.orphans()}
        if result["code"] == 2 and verb != "explain":
            result["again"] = Job(verb, self.case(verb), self.output(verb), ["--overwrite"]).end(300)
        result["differs"] = differences(verb, self.whole(verb), self.output(verb))
        return result

    @staticmethod
    def absent(job):
        return {"code": job.end(100), "seconds": 0, "message": "", "orphans": job.orphans(), "differs": ["no such process in this phase"]}

    def keep(self, key, result):
        self.known[key] = result
        self.file.write_text(json.dumps(self.known, indent=1))
        print(key, {k: v for k, v in result.items() if v not in ("", [], None)}, flush=True)

    def begun(self, verb, phase, program, is_clean=True):
        """A job whose phase has begun, and the process of a program in it; None: there was none."""
        output = self.output(verb)
        if is_clean:
            clean(output)
        pause = PAUSES.get((verb, phase))
        job = Job(verb, self.case(verb), output, fault=pause.format(program if program != "tether" else "gnuplot") if pause else None, TETHER_STOPPED_LIMIT=str(STOPPED_LIMIT))
        begin = time.time()
        while job.is_running() and time.time() - begin < 120:
            if self.has_begun(verb, phase, program, job) and (target := job.process_of(program)):
                return job, target
            time.sleep(0.01)
        return job, None

    def signalled(self, verb, phase, program, name):
        """A process of a program gets a signal in a phase."""
        job, target = self.begun(verb, phase, program)
        if target is None:
            return self.absent(job)
        os.kill(target, SIGNALS[name])
        job.let_go()
        begin = time.time()
        if name == "STOP" and program in ("tether", "mpirun"):  # the user's own: goes on when it is let go
            time.sleep(3)
            os.kill(target, signal.SIGCONT)
        return self.judge(verb, job, job.end(120), time.time() - begin)

    @staticmethod
    def has_begun(verb, phase, program, job):
        """Whether a program may get its signal; of the front-end that starts, when it runs another."""
        if phase == "start":
            return program != "tether" or len(job.processes()) > 1
        if (verb, phase) in PAUSES:
            return job.flag.exists()
        name, count = LINES[verb, phase]
        try:
            return len((job.output / name).read_text().splitlines()) >= count
        except OSError:
            return False

    def unwritable(self, verb, program, call, part, n, error):
        """A call that writes fails, and all after it."""
        clean(self.output(verb))
        begin = time.time()
        job = Job(verb, self.case(verb), self.output(verb), fault=f"{program}:{call}:{part or '-'}:{n}:{error}")
        return self.judge(verb, job, job.end(300), time.time() - begin)


def faults(bench):
    for verb, phases in PHASES.items():
        for phase, programs in phases.items():
            for program in programs:
                for name in SIGNALS:
                    yield f"{verb}/signal/{program}/{phase}/{name}", lambda a=(verb, phase, program, name): bench.signalled(*a)
    for verb, writes in WRITES.items():
        for k, (program, call, part, n) in enumerate(writes):
            error = ERRORS[k % len(ERRORS)]
            yield f"{verb}/write/{program}/{call} {part or 'folder'} {n}/{error}", lambda a=(verb, program, call, part, n, error): bench.unwritable(*a)
    yield from circumstances(bench)
    yield from hosts_faults(bench)
