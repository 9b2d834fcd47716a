"""docs/reliability.md from the outcomes of faults."""
import collections
import json
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/reliability.md"
OF_VERB = {"several": "simulate, two processes of each code", "foreign": "simulate, a foreign wall of two processes"}
SIGNALS = ("KILL", "TERM", "INT", "STOP")
MOST_LINES = 4
OF_MPIRUN = re.compile(r"^\[[\w.-]+(:\d+\] |\]\[\[).*\n?", re.MULTILINE)  # [host:process], [host][[job,of],rank]: what Open MPI tells for itself
OF_CASE = re.compile(r"^.*: this case runs .*\n?", re.MULTILINE)  # told when it begins
LONG_NAMES = ("identification_master", "observation_manager")  # /proc/N/comm has fifteen letters


def parts_of(key):
    """Verb, kind, program, phase or call, fault."""
    verb, kind, program, rest = key.split("/", 3)
    return verb, kind, program, *rest.rsplit("/", 1)


def faults_of(key, result):
    """What is wrong with an outcome."""
    _, kind, program, _, fault = parts_of(key)
    wrong, code, message = [], result["code"], OF_CASE.sub("", OF_MPIRUN.sub("", result["message"]))
    itself = (kind == "signal" and program == "tether" and fault == "KILL") or fault == "the first host is lost"  # it can tell nothing
    if code is None:
        wrong.append("does not end")
    elif code not in ((0, 1, 2) if fault == "EACCES" or kind == "damage" else (0, 1)) and not itself:  # 2: what the person may not do, or has to decide
        wrong.append(f"ends with {code}")
    if code in (1, 2) and not message.strip():
        wrong.append("no message")
    if len(message.splitlines()) > MOST_LINES or "terminate called" in message or "Traceback" in message:
        wrong.append("no clear message")
    if result["orphans"]:
        wrong.append("leaves " + ", ".join(result["orphans"]))
    if result.get("again", 0) != 0:
        wrong.append(f"the same command then ends with {result['again']}")
    if "second" in result and (result["second"]["code"] != 2 or not result["second"]["message"].strip()):
        wrong.append(f"the second ends with {result['second']['code']}")
    if result["differs"]:
        wrong.append("leaves other results: " + ", ".join(result["differs"]))
    return wrong


def cell(key, result):
    wrong = faults_of(key, result)
    if wrong:
        return "**" + "; ".join(wrong) + "**"
    if result["code"] == 0:
        return "goes on" + (", told" if result["message"].strip() else "")
    if result["code"] == 2 and parts_of(key)[1] == "damage":
        return "refused, told; then anew (`--overwrite`)"
    told = "told" if result["message"].strip() else "ended"
    return f"{told}, {result['seconds']:.1f} s" + (", resumed" if result.get("resumed") else "")


def said(result):
    """The first line of what was said: the cause. Of a second job: what it was told."""
    message = OF_MPIRUN.sub("", result.get("second", result)["message"])
    return message.split("\n", 1)[0].replace("|", "\\|")


def signals_table(known):
    rows = collections.defaultdict(dict)
    for key, result in known.items():
        verb, kind, program, phase, fault = parts_of(key)
        if kind == "signal":
            rows[verb, phase, program][fault] = cell(key, result)
    lines = ["| job | phase | process | KILL | TERM | INT | STOP |", "|---|---|---|---|---|---|---|"]
    for (verb, phase, program), cells in rows.items():
        lines.append(f"| {OF_VERB.get(verb, verb)} | {phase} | {program.replace('+', ', its last')} | " + " | ".join(cells.get(name, "") for name in SIGNALS) + " |")
    return lines


def table(known, kind, headings, columns):
    """All faults of a kind, one a row: columns of their keys, the outcome, and what was said."""
    lines = [f"| {headings} | outcome | said |", "|---" * (len(columns) + 2) + "|"]
    for key, result in known.items():
        parts = dict(zip(("verb", "kind", "program", "phase", "fault"), parts_of(key)))
        if parts["kind"] == kind:
            lines.append("| " + " | ".join([*(parts[name] for name in columns), cell(key, result), said(result)]) + " |")
    return lines


def rows_before(title):
    """The lines of a section of the page as it stands, for figures that were not measured anew."""
    text = PAGE.read_text() if PAGE.exists() else ""
    return text.partition(f"## {title}\n")[2].partition("\n## ")[0].splitlines()


def as_before(title):
    """A section whose figures were not measured anew."""
    lines = rows_before(title)
    return [f"## {title}", *lines, *([] if lines[-1] == "" else [""])] if lines else []


def of_chaos(folder):
    """What benchmarks/reliability/chaos found."""
    if not (folder / "chaos.json").exists():
        return as_before("Killed again and again")
    found = json.loads((folder / "chaos.json").read_text())
    other = sum("differs" in one for one in found["wrong"])
    left = collections.Counter(name for one in found["wrong"] for name in one.get("orphans", []))
    remain = "; ".join(f"{name} was left {count} times" for name, count in left.items())
    of = ", ".join(f"{name} {count}" for name, count in sorted(found["of"].items(), key=lambda one: -one[1]))
    return ["## Killed again and again", "",
            f"`benchmarks/reliability/chaos --kills {found['kills']} --seed {found['seed']}`: `tether explain` on the small case, {found['kills']} kills at random times ({of}), "
            f"{found['explanations']} explanations brought to their end by the same command, {found['minutes']} minutes. "
            f"Another explain.json: {other}. Processes left after ten seconds: {remain or 'none'}.", ""]


def of_haul(folder):
    """What benchmarks/reliability/haul found."""
    if not (folder / "haul.json").exists():
        return as_before("A long identification")
    found = json.loads((folder / "haul.json").read_text())
    lines = ["## A long identification", "", f"`benchmarks/reliability/haul{' --leaks' if found['leaks'] else ''} --hours {found['hours']}`: {found['steps']} steps{' of programs with the address sanitizer, whose memory it is' if found['leaks'] else ''}, sums over the processes of a program, slopes over the last nine tenths.", "",
             "| program | memory [MB] | growth [kB/h] | descriptors | growth [1/h] | processes |", "|---|---|---|---|---|---|"]
    for short, one in found["programs"].items():
        name = next((program for program in LONG_NAMES if program.startswith(short)), short)
        memory, descriptors = one["kilobytes"], one["descriptors"]
        lines.append(f"| {name} | {memory['last'] / 1024:.0f} | {memory['per_hour']:.0f} | {descriptors['last']} | {descriptors['per_hour']:.2f} | {one['processes']['last']} |")
    return [*lines, "", *of_leaks(found["leaks"])]


def of_leaks(found):
    if not found:
        return []
    lines = ["Asked at the end what nobody can reach any more:", "",
             "| program | leaked [bytes] | by Open MPI and VTK [bytes] |", "|---|---|---|"]
    for one in found:
        name = next((program for program in LONG_NAMES if program.startswith(one["program"])), one["program"])
        lines.append(f"| {name} | {one['bytes']} | {one['of_libraries']} |")
    return [*lines, ""]


def of_fuzz():
    """What tests/fuzz/run found, and how many findings of before are kept as tests. Readers that it did not run keep their rows."""
    file, kept, title = ROOT / "build-fuzz/fuzz.json", ROOT / "tests/fuzz/findings", "Files and messages that a fuzzer makes"
    rows = {line.split("|")[1].strip(): line for line in rows_before(title) if line.startswith("| ") and not line.startswith("| reader")}
    for reader, one in (json.loads(file.read_text()) if file.exists() else {}).items():
        of_before = len(list((kept / reader).iterdir())) if (kept / reader).exists() else 0
        rows[reader] = f"| {reader} | {one['executions']:,} | {one['seconds'] / 60:.1f} | {one['edges']:,} | {'**1**' if one['found'] else 'none'} | {of_before or ''} |"
    lines = [f"## {title}", "",
             "`tests/fuzz/run`: each reader under libFuzzer with the address and undefined-behaviour sanitizers, for ten minutes or a million executions, whichever is first; "
             "a file is read or refused within 10 s and 1 GB. *Kept*: earlier findings, mended and read by `fuzz_tests` "
             "(which: [decision 117](decisions/0117-fuzzers.md)).", "",
             "| reader | executions | minutes | edges | findings | kept |", "|---|---|---|---|---|---|"]
    return [*lines, *(rows[reader] for reader in sorted(rows)), ""]


def write_page(known, folder):
    wrong = {key: faults_of(key, result) for key, result in known.items() if faults_of(key, result)}
    text = ["# Faults and what they lead to", "",
            "Written by `benchmarks/reliability/run`: do not edit. The real programs on a small case (`configs/tube` with 12 x 8 nodes): each fault made once in a job of its own, "
            "then the same command again, and what it leaves held against an undisturbed job's: files of a simulation and an identification's table to the bit, records but for cost.", "",
            f"{len(known)} faults, {len(known) - len(wrong)} of them green: exit code 1 (or the job goes on to the same results), one message of at most {MOST_LINES} lines (beside what Open MPI tells for itself, `[host:process] ...`), no process left after ten seconds, "
            "the same command then ends with 0 and with the same results.", "",
            "## Signals", "",
            "*told*: it said why within the time given, from the signal to the end; *resumed*: from the last checkpoint; *goes on*: to its end, as if nothing had been. "
            "A process that is stopped (SIGSTOP) is waited for 5 s here (`TETHER_STOPPED_LIMIT`, a minute otherwise); the front-end and mpirun are let go on after three. SIGKILL of the front-end itself can be told by nobody.", "",
            *signals_table(known), "", "## Files that cannot be written", "",
            "By a library between program and kernel (`tests/faults/faults.c`): the call named fails on that file, and all matching ones after it (number: which of them is the first to fail).", "",
            *table(known, "write", "job | program | call | error", ("verb", "program", "phase", "fault")), "", "## Damaged files", "",
            "In the output folder of a simulation and an identification that were killed in a step, and of an explanation that was killed in its diagnosis; the same command, with `--resume` where it has that.", "",
            *table(known, "damage", "job | file | damage", ("verb", "phase", "fault")), "", "## Other circumstances", "",
            "*No more memory*: a process may not have a megabyte more (`RLIMIT_AS`). The clock jumps in all processes, two seconds after their start. The disk is a tmpfs that is made larger afterwards; one that vanishes is a mount that is taken away and given back. "
            "Of a second job: what it is told.", "",
            *table(known, "other", "job | program | phase | what happens", ("verb", "program", "phase", "fault")), "",
            "## Several hosts", "",
            "An identification with a model on each of two hosts, which are namespaces of one machine with an sshd each (`tests/hosts`): processes, network, shared memory and temporary files of their own. "
            "*Lost*: without power; *cut off*: without a network. Open MPI is told by `tether` that a host of which nothing is heard for 30 s is gone. After that the same command goes on, on one machine.", "",
            *table(known, "hosts", "job | what happens", ("verb", "fault")), "", *of_chaos(folder), *of_haul(folder), *of_fuzz()]
    PAGE.write_text("\n".join(text))
    for key, what in wrong.items():
        print("not green:", key, "; ".join(what))
