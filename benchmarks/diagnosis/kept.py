"""What the scenarios of benchmarks/diagnosis/run said, in results.json: made over several days, by whoever has the time."""
import functools
import json
import os
import pathlib
import subprocess

HERE = pathlib.Path(__file__).resolve().parent
OF_EFFECT = ("name", "where", "kind", "parameter", "accepted", "rival", "group")  # what is judged
OF_COST = ("cpu_seconds", "runs", "sensitivity_runs")
RESTS_ON = ("common", "vessel", "fluid", "solid", "fsi_master", "identification_master", "observation_manager", "diagnosis", "twin")


@functools.cache
def revision():
    """That of the last change of what a diagnosis rests on; when it was asked first."""
    git = lambda *words: subprocess.run(["git", *words], cwd=HERE.parents[1], capture_output=True, text=True, check=True).stdout.strip()
    return git("log", "-1", "--format=%h", "--", *RESTS_ON) + ("+" if git("status", "--porcelain", "--", *RESTS_ON) else "")


def brief(result, is_hidden):
    """Without what nobody asks a result for: effects that were neither named, nor a rival, nor hidden, nor in a group with one of these."""
    found = result["found"]
    asked = lambda e: e["accepted"] or e["rival"] or is_hidden(e)
    groups = {e["group"] for e in found["effects"] if e["group"] and asked(e)}
    effects = [e for e in found["effects"] if asked(e) or e["group"] in groups]
    return result | {"found": {
        "verdict": found["verdict"], "held_out": found["held_out"], "cost": {k: found["cost"][k] for k in OF_COST if k in found["cost"]},
        "effects": [{k: e[k] for k in OF_EFFECT if k in e} | {"parameters": [{"parameter": p["parameter"]} for p in e["parameters"]]} for e in effects]}}


class Kept:
    def __init__(self, file):
        self.file = file
        told = json.loads(file.read_text()) if file.exists() else {}
        self.detectable, self.results = told.get("detectable"), told.get("results", {})

    def put(self, name, result, is_hidden):
        self.results[name] = brief(result, is_hidden) | {"revision": revision()}
        lines = lambda pairs: "{\n" + ",\n".join(f"{json.dumps(k)}: {json.dumps(v)}" for k, v in pairs) + "\n}"
        new = self.file.with_suffix(".new")
        new.write_text(lines([("detectable", self.detectable)])[:-2] + ",\n\"results\": " + lines(sorted(self.results.items())) + "\n}\n")
        os.replace(new, self.file)
