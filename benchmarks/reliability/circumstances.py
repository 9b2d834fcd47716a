"""What happens to a job beside signals and calls that fail: damaged files, memory that ends, a clock that jumps, a disk that fills or is taken away, a second job in its folder."""
import os
import resource
import signal
import subprocess
import time

from jobs import PRELOAD, Job, clean

DAMAGED = {  # of a job that was killed
    "simulate": ("checkpoint/master.bin", "checkpoint/fluid.bin", "checkpoint/solid.bin", "lumen.motion", "timeseries.csv"),
    "identify": ("checkpoint/identification.bin", "estimate.csv"),
    "explain": ("steps.json", "model_0/lumen.motion", "diagnosis_1/coarse/runs/base/run.json", "diagnosis_1/coarse/runs/base/lumen.motion"),
}
AT_WORK = {"simulate": "later", "identify": "later", "explain": "diagnosis"}  # two checkpoints are behind it, or a run
MEMORY = {"simulate": {"start": ("fsi_master", "fluid", "solid"), "step": ("fsi_master", "fluid", "solid"), "report": ("tether_picture",)},
          "identify": {"step": ("identification_master", "fsi_master")}, "explain": {"diagnosis": ("identification_master", "fsi_master")}}
LITTLE = 1 << 20  # bytes that a process may still ask for
HOUR = 3600  # [s]


def halve(file):
    os.truncate(file, file.stat().st_size // 2)


def flip(file):
    content = bytearray(file.read_bytes())
    content[len(content) // 2] ^= 0x10
    file.write_bytes(content)


def empty(file):
    os.truncate(file, 0)


DAMAGES = {"halved": halve, "a bit flipped": flip, "empty": empty}


def stopped(bench, verb, phase, program):
    """A job that was killed in a phase."""
    job, target = bench.begun(verb, phase, program)
    if target is None:
        return job, False
    job.kill_all()
    job.end(10)
    return job, True


def damaged(bench, verb, name, damage):
    """The same command finds a file of its output damaged."""
    job, was_stopped = stopped(bench, verb, AT_WORK[verb], "fsi_master")
    file = bench.output(verb) / name
    if not was_stopped or not file.exists():
        return {"code": 1, "seconds": 0, "message": job.message(), "orphans": job.orphans(), "differs": [f"{name} is not there"]}
    DAMAGES[damage](file)
    return bench.again(verb, Job(verb, bench.case(verb), bench.output(verb), () if verb == "explain" else ("--resume",)))


def short_of_memory(bench, verb, phase, program):
    """A process gets no more memory."""
    job, target = bench.begun(verb, phase, program)
    if target is None:
        return bench.absent(job)
    with open(f"/proc/{target}/statm") as statm:
        used = int(statm.read().split()[0]) * resource.getpagesize()
    resource.prlimit(target, resource.RLIMIT_AS, (used + LITTLE, used + LITTLE))
    job.let_go()
    begin = time.time()
    return bench.judge(verb, job, job.end(300), time.time() - begin)


def clock_jumps(bench, verb, hours):
    output = bench.output(verb)
    clean(output)
    begin = time.time()
    job = Job(verb, bench.case(verb), output, LD_PRELOAD=str(PRELOAD), TETHER_FAULT_CLOCK=str(hours * HOUR))
    return bench.judge(verb, job, job.end(300), time.time() - begin)


def disk_fills(bench, verb, kilobytes):
    """The output is on a disk of its own, which is too small; then it is made larger."""
    output = bench.output(verb)
    clean(output)
    output.mkdir()
    subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={kilobytes}k", "tmpfs", output], check=True)
    try:
        begin = time.time()
        job = Job(verb, bench.case(verb), output)
        code, end = job.end(300), time.time() - begin
        subprocess.run(["mount", "-o", "remount,size=256m", output], check=True)
        return bench.judge(verb, job, code, end)
    finally:
        subprocess.run(["umount", "-l", output], check=True)


def disk_vanishes(bench, verb, phase):
    """The output is on a disk that is taken away; then it is there again."""
    output, disk = bench.output(verb), bench.folder / "disk"
    for folder in (output, disk):
        clean(folder)
        folder.mkdir()
    subprocess.run(["mount", "--bind", disk, output], check=True)
    try:
        job, target = bench.begun(verb, phase, "fsi_master", is_clean=False)
        if target is None:
            return bench.absent(job)
        subprocess.run(["umount", "-l", output], check=True)
        begin = time.time()
        code, end = job.end(300), time.time() - begin
        subprocess.run(["mount", "--bind", disk, output], check=True)
        return bench.judge(verb, job, code, end)
    finally:
        subprocess.run(["umount", "-l", output], check=False)


def folder_removed(bench, verb, phase):
    job, target = bench.begun(verb, phase, "fsi_master")
    if target is None:
        return bench.absent(job)
    gone = bench.folder / "gone"
    bench.output(verb).rename(gone)  # at once: nothing can be made in it while it is emptied
    clean(gone)
    begin = time.time()
    return bench.judge(verb, job, job.end(300), time.time() - begin)


def second_job(bench, verb, phase):
    """Another job of the same folder: it is refused, and the first goes on."""
    first, target = bench.begun(verb, phase, "identification_master" if verb == "identify" else "fsi_master")
    if target is None:
        return bench.absent(first)
    begin = time.time()
    os.kill(target, signal.SIGSTOP)  # a small job may end before the second has waited for it
    second = Job(verb, bench.case(verb), bench.output(verb), name="second")
    code, end = second.end(60), time.time() - begin
    os.kill(target, signal.SIGCONT)
    return bench.judge(verb, first, first.end(300), end, second={"code": code, "message": bench.told(second)})


def circumstances(bench):
    for verb, names in DAMAGED.items():
        for name in names:
            for damage in DAMAGES:
                if damage == "a bit flipped" and name.endswith(".csv"):
                    continue  # text, which anybody may edit, has no checksum
                yield f"{verb}/damage/same command/{name}/{damage}", lambda a=(verb, name, damage): damaged(bench, *a)
    for verb, phases in MEMORY.items():
        for phase, programs in phases.items():
            for program in programs:
                yield f"{verb}/other/{program}/{phase}/no more memory", lambda a=(verb, phase, program): short_of_memory(bench, *a)
    for verb, phase in AT_WORK.items():
        for hours in (-1, 1):
            yield f"{verb}/other/all/all/the clock jumps by {hours:+d} h", lambda a=(verb, hours): clock_jumps(bench, *a)
        yield f"{verb}/other/all/{phase}/the disk vanishes", lambda a=(verb, phase): disk_vanishes(bench, *a)
        yield f"{verb}/other/all/{phase}/the folder is removed", lambda a=(verb, phase): folder_removed(bench, *a)
        early = phase if verb == "explain" else "checkpoint"  # in which the first waits until the second has ended
        yield f"{verb}/other/all/{early}/a second job in the folder", lambda a=(verb, early): second_job(bench, *a)
    for verb, sizes in (("simulate", (8, 100, 400, 1500, 4000)), ("identify", (8, 400, 1600)), ("explain", (100, 1000, 4000))):
        for kilobytes in sizes:
            yield f"{verb}/other/all/all/a disk of {kilobytes} kB", lambda a=(verb, kilobytes): disk_fills(bench, *a)
