"""Hosts on this machine, for tests of what runs over several: each has its own processes, network, name, shared memory and folder for
temporary files, and an sshd; the rest of the file system is shared, as on a cluster. Needs root."""

import os
import pathlib
import shutil
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "batch"))
from waiting import PATIENCE, wait

SSHD = """Port 22
ListenAddress {address}
HostKey {folder}/host_key
AuthorizedKeysFile {folder}/key.pub
PidFile none
StrictModes no
UsePAM no
PermitRootLogin yes
PasswordAuthentication no
MaxStartups 100
SetEnv TMPDIR={folder}/{name}/tmp HOME={folder}/{name} {sanitizers}
"""
SANITIZERS = ("ASAN_OPTIONS", "LSAN_OPTIONS", "UBSAN_OPTIONS", "LD_PRELOAD")  # as the preset dev has them
SSH = """Host {names}
  User root
  IdentityFile {folder}/key
  IdentitiesOnly yes
  StrictHostKeyChecking no
  UserKnownHostsFile /dev/null
  GlobalKnownHostsFile /dev/null
  LogLevel ERROR
  ConnectTimeout 5
"""
HOST = """set -e
hostname {name}
mount --make-rprivate /
mount -t tmpfs tmpfs /dev/shm
mount -t tmpfs tmpfs {folder}/local
mount --bind {folder}/hosts /etc/hosts
mkdir -p /run/sshd
until ip addr show dev eth0 2>/dev/null | grep -q {address}; do sleep 0.05; done
exec /usr/sbin/sshd -D -f {folder}/{name}/sshd_config -E {folder}/{name}/sshd.log
"""


def run(*words, **more):
    return subprocess.run(list(map(str, words)), check=True, capture_output=True, text=True, **more)


def sanitizers():
    return " ".join(f"{name}={os.environ[name]}" for name in SANITIZERS if name in os.environ)


def can_be_made():
    """Whether this machine lets this user make hosts: each kind of namespace, mounts in it, and a bridge outside."""
    inside = ["unshare", "--net", "--uts", "--ipc", "--pid", "--mount", "--fork", "--mount-proc", "sh", "-c",
              "mount --make-rprivate / && mount -t tmpfs tmpfs /dev/shm && mount --bind /etc/hosts /etc/hosts && hostname probe"]
    bridge = f"tp{os.getpid() % 10**6}"
    steps = (inside, ["ip", "link", "add", bridge, "type", "bridge"], ["ip", "link", "del", bridge])
    return os.geteuid() == 0 and all(subprocess.run(words, capture_output=True, check=False).returncode == 0 for words in steps)


def told_by(run, seconds):
    """What a program wrote to stderr until its end. Not a line of mpirun's, which tells at times, on a busy machine, that the process group
    of an ssh is set already: by the ssh itself (open-mpi/ompi, pull request 2957)."""
    told = run.communicate(timeout=PATIENCE * seconds)[1]
    return "".join(line for line in told.splitlines(keepends=True) if "plm:rsh: Warning: setpgid(" not in line)


class Host:
    def __init__(self, group, number):
        self.group, self.name = group, f"h{number}"
        self.address, self.link = group.address(number), f"{group.bridge}-{number}"
        self.card = f"02:00:00:00:00:{number:02x}"  # as before after a new start: others remember it
        folder = group.folder / self.name
        shutil.rmtree(folder, ignore_errors=True)  # temporary files do not survive a new start
        (folder / "tmp").mkdir(parents=True)
        (folder / "sshd_config").write_text(SSHD.format(address=self.address, folder=group.folder, name=self.name, sanitizers=sanitizers()))
        script = HOST.format(name=self.name, folder=group.folder, address=self.address)
        words = ["unshare", "--net", "--uts", "--ipc", "--pid", "--mount", "--fork", "--kill-child", "--mount-proc", "sh", "-c", script]
        self.process = subprocess.Popen(words, stdin=subprocess.DEVNULL, start_new_session=True)
        self._connect()

    def _inside(self, *words):
        return run("nsenter", "--target", self.process.pid, "--net", *words)

    def _connect(self):
        own, other = (pathlib.Path(f"/proc/{one}/ns/net") for one in ("self", self.process.pid))
        wait(lambda: own.readlink() != other.readlink(), 10, f"a network of {self.name}'s own")
        run("ip", "link", "add", self.link, "type", "veth", "peer", "name", "eth0", "address", self.card, "netns", self.process.pid)
        run("ip", "link", "set", self.link, "master", self.group.bridge, "up")
        self._inside("ip", "link", "set", "lo", "up")
        self._inside("ip", "addr", "add", f"{self.address}/24", "dev", "eth0")
        self._inside("ip", "link", "set", "eth0", "up")

    def cut(self):
        """The cable is pulled: whoever waits for this host hears nothing, and it nothing of them."""
        run("ip", "link", "set", self.link, "down")

    def join(self):
        run("ip", "link", "set", self.link, "up")

    def lose(self):
        """The power goes: no process of it says a last word."""
        self.cut()
        self.stop()

    def processes(self):
        """Pids, as this machine has them, by the names of their programs; of those that belong to this host."""
        found = {}
        try:
            own = pathlib.Path(f"/proc/{self.process.pid}/ns/net").readlink()
        except OSError:
            return found
        for entry in pathlib.Path("/proc").iterdir():
            try:
                if entry.name.isdigit() and (entry / "ns/net").readlink() == own and (entry / "stat").read_text().rsplit(")", 1)[1].split()[0] != "Z":
                    found.setdefault((entry / "comm").read_text().strip(), []).append(int(entry.name))
            except OSError:
                continue
        return found

    def stop(self):
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait(10)
        subprocess.run(["ip", "link", "del", self.link], capture_output=True, check=False)


class HostGroup:
    """Hosts h0, h1, ... that reach each other by ssh with a key of their own."""

    def __init__(self, folder, count):
        self.folder = pathlib.Path(folder)
        (self.folder / "local").mkdir(parents=True, exist_ok=True)  # its content is each host's own
        self.bridge = f"th{os.getpid() % 10**6}"
        self.network = f"10.{77 + os.getpid() % 100}.{os.getpid() // 100 % 250}"
        self.hosts, names = [], [f"h{i}" for i in range(count)]
        lines = ["127.0.0.1 localhost", *(f"{self.address(i)} {name}" for i, name in enumerate(names))]
        (self.folder / "hosts").write_text("\n".join(lines) + "\n")
        (self.folder / "ssh_config").write_text(SSH.format(names=" ".join(names), folder=self.folder))
        for key in ("key", "host_key"):
            run("ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-f", self.folder / key)
        run("ip", "link", "add", self.bridge, "type", "bridge")
        run("ip", "link", "set", self.bridge, "up")
        try:
            self.hosts = [Host(self, i) for i in range(count)]
            self.mend()
        except BaseException:
            self.stop()
            raise

    def mend(self):
        """Starts again what was lost, and puts the cables back."""
        for number, host in enumerate(self.hosts):
            if host.process.poll() is None:
                host.join()
            else:
                self.hosts[number] = Host(self, number)
        wait(lambda: all(map(self.is_up, self.hosts)), 20, "sshd")

    def address(self, number):
        return f"{self.network}.{number + 1}"

    @property
    def agent(self):
        """What mpirun may take for ssh."""
        return f"ssh -F {self.folder}/ssh_config"

    def start(self, host, words, folder, environment=(), **more):
        """On a host, as if somebody had logged in there."""
        variables = {"TMPDIR": f"{self.folder}/{host.name}/tmp", "OMPI_MCA_plm_rsh_agent": self.agent, **dict(environment)}
        inside = ["nsenter", "--target", str(self.inner(host)), "--net", "--uts", "--ipc", "--pid", "--mount", f"--wd={folder}"]
        return subprocess.Popen(inside + list(map(str, words)), env=os.environ | variables, start_new_session=True, **{"stdin": subprocess.DEVNULL, **more})

    def inner(self, host):
        """The first process of the host, as this machine sees it."""
        children = pathlib.Path(f"/proc/{host.process.pid}/task/{host.process.pid}/children")
        wait(lambda: children.read_text().split(), 5, f"a process of {host.name}")
        return int(children.read_text().split()[0])

    def is_up(self, host):
        words = ["timeout", "10", *self.agent.split(), host.name, "true"]
        return self.start(self.hosts[0], words, self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).wait() == 0

    def stop(self):
        for host in self.hosts:
            host.stop()
        subprocess.run(["ip", "link", "del", self.bridge], capture_output=True, check=False)
