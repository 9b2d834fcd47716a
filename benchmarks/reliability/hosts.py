"""An identification over two hosts, each with a model of its own, and what may happen to one of them."""
import os
import signal
import sys
import time

from jobs import ROOT, Job, clean

sys.path.insert(0, str(ROOT / "tests/hosts"))
from host_group import HostGroup
from waiting import wait

NODES = ("h0", "h1")


def of(host, program):
    """A process of a program there, as this machine numbers it; none: IndexError."""
    return host.processes()[program[:15]][0]


HAPPENS = {
    "the second host is lost": lambda hosts: hosts[1].lose(),
    "the second host is cut off": lambda hosts: hosts[1].cut(),
    "the first host is lost": lambda hosts: hosts[0].lose(),
} | {
    f"{name} of {program} on the second": lambda hosts, a=(program, name): os.kill(of(hosts[1], a[0]), getattr(signal, f"SIG{a[1]}"))
    for program in ("fsi_master", "observation_manager", "orted") for name in ("KILL", "TERM", "STOP")
}
SLOWLY = {"the first host is lost", "the second host is cut off"}  # there it is found out by silence, half a minute


def over_hosts(bench, what):
    """Then the same command goes on where the hosts are whole again."""
    output = bench.output("identify")
    clean(output)
    folder = bench.folder / "hosts"
    clean(folder)
    group = HostGroup(folder, len(NODES))
    try:
        job = Job("identify", bench.case("identify"), output, ("--processes", str(len(NODES))), on=group.hosts[0], TETHER_NODES=",".join(NODES),
                  TETHER_STOPPED_LIMIT="5")
        saved = output / "checkpoint/identification.bin"
        wait(lambda: saved.exists() or not job.is_running(), 60, "a saved state")
        if not job.is_running():
            return bench.absent(job)
        HAPPENS[what](group.hosts)
        begin = time.time()
        code, end = job.end(120), time.time() - begin
        orphans = job.orphans(60 if what == "the first host is lost" or what == "the second host is cut off" else 10)
        return bench.judge("identify", job, code, end) | ({"orphans": orphans} if orphans else {})
    finally:
        group.stop()


def hosts_faults(bench):
    for what in HAPPENS:
        yield f"identify/hosts/all/step/{what}", lambda a=what: over_hosts(bench, a)
