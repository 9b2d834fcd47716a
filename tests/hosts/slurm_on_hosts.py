"""Slurm over hosts: a controller on the first, a slurmd on each."""

import host_group  # noqa: F401  which leads to tests/batch
from slurm_cluster import CONFIGURATION, Cluster, user_name

GIVEN_UP_AFTER = 60  # [s], a node of which the controller hears nothing: later than programs give it up (30 s), as on clusters (300 s)


class ClusterOnHosts(Cluster):
    """`group`: its hosts are the nodes. What is asked of Slurm is asked on the first."""

    def __init__(self, folder, group):
        self.group = group
        super().__init__(folder, len(group.hosts))

    def _configure(self):
        self.names = [host.name for host in self.group.hosts]
        first = self.group.hosts[0]
        text = CONFIGURATION.format(host=first.name, address=first.address, user=user_name(), port=6817, folder=self.folder)
        lines = [f"NodeName={host.name} NodeAddr={host.address} Port=6818 CPUs=4 RealMemory=8000" for host in self.group.hosts]
        self._write("\n".join(lines) + text + f"SlurmdTimeout={GIVEN_UP_AFTER}\n")
        (self.folder / "mpi.conf").write_text(f"PMIxCliTmpDirBase={self.group.folder}/local\n")  # /tmp is all hosts'

    def _process(self, words, on, **pipes):
        host = next((one for one in self.group.hosts if one.name == on), self.group.hosts[0])
        return self.group.start(host, words, self.folder, self.environment, **pipes)

    def mend(self):
        """Starts again what was lost, with its slurmd."""
        lost = [host.name for host in self.group.hosts if host.process.poll() is not None]
        self.group.mend()
        for name in lost:
            self._run("/usr/sbin/slurmd", "-D", "-N", name, on=name)
        self.wait(self._all_idle, 60, "idle nodes")
