"""Makes the study's steps by tether's verbs, each once, in a folder of its own."""
import concurrent.futures
import hashlib
import json
import os
import pathlib
import subprocess
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAMS = pathlib.Path(os.environ.get("TETHER_PROGRAMS", ROOT / "build/bin"))
RESULTS = {"build-model": "model/case.yaml", "fit-outlets": "case.yaml", "simulate": "summary.json", "compare": "comparison.json", "twin": "case.yaml", "identify": "estimate.json", "diagnose": "diagnosis.json", "explain": "explain.json"}
RESUMED = ("simulate", "identify")
GOES_ON_BY_ITSELF = ("explain",)  # and begins anew with --overwrite
OF_CASES = (*RESUMED, "compare", "twin", "diagnose", "explain")


def nested(fields):
    """{"a.b": 1} as {"a": {"b": 1}}."""
    whole = {}
    for path, value in fields.items():
        *above, last = path.split(".")
        section = whole
        for name in above:
            section = section.setdefault(name, {})
        section[last] = value
    return whole


def ended(process):
    """(exit code, CPU seconds of it and of what it started, what it complained of): of one process, for steps run beside each other."""
    said = process.stderr.read()
    _, status, used = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    process.stderr.close()
    return process.returncode, used.ru_utime + used.ru_stime, said


class Failed(RuntimeError):
    """What a verb said as it failed."""

    def __init__(self, step, message):
        super().__init__(message)
        self.step = step

    def cause(self):
        """Its last line that says something."""
        return [line for line in str(self).splitlines() if line.strip()][-1].strip()


class NotMade(RuntimeError):
    """A step that is not there, where none is to be made."""


class Workshop:
    """A step is kept as long as its case, the cases that this builds on, and the steps before it are the same."""

    def __init__(self, folder, quiet=False, makes=True):
        self.folder, self.quiet, self.makes = folder, quiet, makes
        self.ledger = folder / "steps"  # a file for each
        self.ledger.mkdir(parents=True, exist_ok=True)
        self.used = []  # names of this study's steps, kept or made
        self.begun = time.time()
        self.broken = {}  # the last line that a step said which broke off, by its name

    def case(self, name, base, fields):
        """A case that builds on another one; sections as JSON, which YAML reads."""
        path = self.folder / f"{name}.yaml"
        sections = "".join(f"{key}: {json.dumps(value)}\n" for key, value in nested(fields).items())
        text = f"base: {os.path.relpath(base, self.folder)}\nname: {name}\n{sections}"
        if not path.exists() or path.read_text() != text:  # one that is written anew ends a run that reads it
            path.write_text(text)
        return path

    def make(self, verb, case, after=(), name=None):
        """The folder with the results of a verb."""
        name = name or case.stem
        folder = self.folder / name
        name += "_compared" if verb == "compare" else ""  # beside its run
        key = hashlib.sha1((verb + self._text(case) + "".join(self.step(earlier)["key"] for earlier in after)).encode()).hexdigest()
        before = self.step(name)
        self.used.append(name)
        if before.get("key") == key and before.get("cpu_seconds") is not None and (folder / RESULTS[verb]).exists():
            return folder
        if not self.makes:
            raise Failed(name, before["failed"]) if before.get("key") == key and before.get("failed") else NotMade(name)
        goes_on = verb in RESUMED and before.get("key") == key and any((folder / "checkpoint").glob("*"))
        self._note(name, key=key)
        begun = time.time()
        options = [*(["--resume"] if goes_on else []), *(["--quiet"] if verb in OF_CASES else []), *(["--overwrite"] if verb in OF_CASES and verb not in GOES_ON_BY_ITSELF else [])]
        code, cpu, said = ended(subprocess.Popen([PROGRAMS / "tether", verb, case, "--output", folder, *options], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, env={**os.environ, "TETHER_PICTURES": "0"}))
        if code != 0:
            self._note(name, key=key, failed=f"{verb} {case}:\n{said[-4000:]}")
            raise Failed(name, self.step(name)["failed"])
        took = {"cpu_seconds": cpu, "wall_seconds": time.time() - begun}
        if verb in GOES_ON_BY_ITSELF:  # with what it made before it was broken off
            took = {key: read(folder / RESULTS[verb])["cost"][key] for key in took}
        self._note(name, key=key, **took)
        if not self.quiet:
            print(f"{verb} {name}: {self.step(name)['cpu_seconds']:.1f} CPU s", flush=True)
        return folder

    def wall_seconds(self):
        """Of this command and of those before it that made steps in this folder."""
        file = self.folder / "wall_seconds.json"
        before = read(file) if file.exists() else 0.0
        if not self.makes:
            return before
        file.write_text(json.dumps(before + time.time() - self.begun))
        self.begun = time.time()
        return read(file)

    def cpu_seconds(self):
        """Of all steps of this study."""
        return sum(self.step(name).get("cpu_seconds") or 0 for name in set(self.used))

    def step(self, name):
        file = self.ledger / f"{name}.json"
        return read(file) if file.exists() else {}

    def those_made(self, makers, at_once=1):
        """Results of functions by key; without those whose steps are not there, or broke off. at_once: of them; what is to be timed stands alone."""
        with concurrent.futures.ThreadPoolExecutor(at_once) as workers:
            waiting = {key: workers.submit(maker) for key, maker in makers.items()}
        results = {}
        for key, made in waiting.items():
            try:
                results[key] = made.result()
            except NotMade:
                pass
            except Failed as failed:
                self.tell(failed)
        return results

    def tell(self, failed):
        """A step that broke off is a result, too: the page names it."""
        self.broken[failed.step] = failed.cause()
        print(failed, flush=True)

    def _note(self, name, **what):
        (self.ledger / f"{name}.json").write_text(json.dumps(what))

    def _text(self, case):
        text = case.read_text()
        for line in text.splitlines():
            if line.startswith("base: ") and (case.parent / line[6:]).exists():
                text += self._text(case.parent / line[6:])
        return text


def read(file):
    return json.loads(pathlib.Path(file).read_text())
