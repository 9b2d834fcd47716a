"""Slurm on this machine: a controller and some nodes, all of them processes in a folder, for tests of jobs."""

import os
import pathlib
import signal
import socket
import subprocess

from waiting import wait

CONFIGURATION = """
ClusterName=test
SlurmctldHost={host}({address})
SlurmctldPort={port}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket,cred_expire=5
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool/%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/none
PreemptType=preempt/partition_prio
PreemptMode=REQUEUE
SchedulerParameters=batch_sched_delay=0,sched_interval=2
KillWait=10
ReturnToService=2
SlurmdParameters=config_overrides
PartitionName=work Nodes=ALL Default=YES MaxTime=INFINITE PriorityTier=1 PreemptMode=REQUEUE GraceTime=10
PartitionName=urgent Nodes=ALL MaxTime=INFINITE PriorityTier=10
"""


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


def user_name():
    return subprocess.run(["id", "-un"], capture_output=True, text=True, check=True).stdout.strip()


class Cluster:
    """Nodes n0, n1, ... of four processors each; partition `urgent` preempts jobs of `work`."""

    def __init__(self, folder, nodes=3):
        self.folder = pathlib.Path(folder)
        for name in ("state", "spool"):
            (self.folder / name).mkdir(parents=True)
        self.names = [f"n{i}" for i in range(nodes)]
        self.environment = os.environ | {"SLURM_CONF": str(self.folder / "slurm.conf")}
        self.processes = []
        self._configure()
        self._start()

    def _configure(self):
        host, ports = socket.gethostname(), free_ports(len(self.names) + 1)
        text = CONFIGURATION.format(host=host, address="127.0.0.1", user=user_name(), port=ports[0], folder=self.folder)
        lines = [f"NodeName={name} NodeHostname={host} NodeAddr=127.0.0.1 Port={port} CPUs=4 RealMemory=8000"
                 for name, port in zip(self.names, ports[1:])]
        self._write("\n".join(lines) + text)

    def _write(self, configuration):
        (self.folder / "slurm.conf").write_text(configuration)
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(1024))
        key.chmod(0o400)

    def _run(self, *words, on=None):
        """`on`: the node, of a cluster whose nodes are hosts."""
        with open(self.folder / f"{pathlib.Path(words[0]).name}.err", "a", encoding="utf-8") as log:
            self.processes.append(self._process(words, on, stdout=log, stderr=log))

    def _process(self, words, on, **pipes):
        del on
        return subprocess.Popen(words, env=self.environment, start_new_session=True, **pipes)

    def _start(self):
        at = self.folder
        self._run("/usr/sbin/munged", "--foreground", "--force", f"--key-file={at}/munge.key", f"--socket={at}/munge.socket",
                  f"--pid-file={at}/munge.pid", f"--log-file={at}/munge.log", f"--seed-file={at}/munge.seed")
        self.wait(lambda: (at / "munge.socket").exists(), 20, "munged")
        self._run("/usr/sbin/slurmctld", "-D")
        for name in self.names:
            self._run("/usr/sbin/slurmd", "-D", "-N", name, on=name)
        self.wait(self._all_idle, 60, "idle nodes")

    def _all_idle(self):
        return self.ask("sinfo", "--noheader", "--states=idle", "--partition=work", "--format=%D").strip() == str(len(self.names))

    def call(self, *words):
        process = self._process(words, None, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        output, errors = process.communicate()
        return subprocess.CompletedProcess(words, process.returncode, output, errors)

    def ask(self, *words):
        return self.call(*words).stdout

    def wait(self, is_so, seconds, what):
        wait(is_so, seconds, what, lambda: self.ask("squeue", "--states=all"))

    def stop(self):
        self.ask("scancel", "--user", str(os.getuid()))
        for process in reversed(self.processes):
            process.send_signal(signal.SIGTERM)
        for process in self.processes:
            try:
                process.wait(10)
            except subprocess.TimeoutExpired:
                process.kill()
