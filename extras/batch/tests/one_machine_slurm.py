"""Slurm on this machine alone, as long as a test runs: without systemd, with ports, sockets and folders of its own."""
import ctypes
import os
import pathlib
import re
import secrets
import shutil
import signal
import socket
import subprocess
import sys
import time

CORES, MEMORY = 2, 1100  # of its only node; MB
SUBREAPER = 36  # of prctl
CONFIGURATION = """ClusterName=test
SlurmctldHost={node}(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket={folder}/munge.socket,cred_expire=5
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
SlurmdParameters=config_overrides
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
MailProg=/bin/true
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
SchedulerParameters=sched_interval=1,sched_min_interval=0,batch_sched_delay=0,bf_interval=1
ReturnToService=1
KillWait=5
NodeName={node} NodeAddr=127.0.0.1 CPUs={cores} RealMemory={memory}
PartitionName=main Nodes=ALL Default=YES State=UP
"""


def why_not():
    """What is missing here; nothing if it can be started."""
    missing = [name for name in ("munged", "slurmctld", "slurmd", "sbatch") if not shutil.which(name)]
    if missing:
        return f"no {', '.join(missing)} (Debian packages slurm-wlm, munge)"
    return "" if os.geteuid() == 0 else "only the superuser may start Slurm's daemons"


def free_ports(count):
    sockets = [socket.create_server(("127.0.0.1", 0)) for _ in range(count)]
    ports = [s.getsockname()[1] for s in sockets]
    for s in sockets:
        s.close()
    return ports


def children(pid):
    try:
        threads = [task.read_text().split() for task in pathlib.Path(f"/proc/{pid}/task").glob("*/children")]
    except (FileNotFoundError, ProcessLookupError):
        return []
    return [int(child) for those in threads for child in those]


class Slurm:
    """Ends with everything that it has started, also what has left its parent."""

    def __init__(self, folder):
        self.folder, self.daemons = folder, []
        ctypes.CDLL(None).prctl(SUBREAPER, 1, 0, 0, 0)  # orphans come to this process
        for name in ("state", "spool"):
            (folder / name).mkdir()
        (folder / "key").touch(mode=0o600)
        (folder / "key").write_bytes(secrets.token_bytes(128))
        node = os.uname().nodename.split(".")[0]
        self.node, self.conf = node, folder / "slurm.conf"
        self.conf.write_text(CONFIGURATION.format(node=node, folder=folder, ports=free_ports(2), cores=CORES,
                                                  memory=MEMORY))
        self.environment = {**os.environ, "SLURM_CONF": str(self.conf), "PATH": f"/usr/sbin:{os.environ['PATH']}"}

    def __enter__(self):
        try:
            self.start("munged", "--force", "--foreground", f"--key-file={self.folder}/key", "--num-threads=2",
                       f"--socket={self.folder}/munge.socket", f"--pid-file={self.folder}/munge.pid",
                       f"--log-file={self.folder}/munge.log", f"--seed-file={self.folder}/munge.seed")
            self.until((self.folder / "munge.socket").exists)
            self.start("slurmctld", "-D", "-f", self.conf)
            self.start("slurmd", "-D", "-f", self.conf)
            self.until(lambda: self.ask("sinfo", "--noheader", "--format=%T", check=False).strip() == "idle")
        except BaseException:
            self.__exit__()
            raise
        return self

    def start(self, *words):
        with open(self.folder / f"{words[0]}.log", "wb") as log:
            self.daemons.append(subprocess.Popen(["setpriv", "--pdeathsig", "KILL", *map(str, words)],
                                                 stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT,
                                                 env=self.environment, cwd=self.folder))

    def until(self, condition, seconds=20):
        end = time.monotonic() + seconds
        while not condition():
            ended = [d.args[3] for d in self.daemons if d.poll() is not None]
            if ended or time.monotonic() > end:
                raise RuntimeError(f"Slurm did not start, {ended}: {self.logs()}")
            time.sleep(0.05)

    def logs(self):
        return "\n".join(f"{log.name}: {log.read_text()[-2000:]}" for log in self.folder.glob("*.log"))

    def __exit__(self, *_):
        for daemon in self.daemons[1:]:  # no job is started any more
            daemon.kill()
        end = time.monotonic() + 10
        while (left := children(os.getpid())) and time.monotonic() < end:
            for pid in left:  # what they leave comes here
                os.kill(pid, signal.SIGKILL)
                os.waitpid(pid, 0)
        for daemon in self.daemons:
            daemon.poll()

    def ask(self, *words, check=True):
        done = subprocess.run(list(map(str, words)), env=self.environment, cwd=self.folder, capture_output=True,
                              text=True, timeout=20)
        if check and done.returncode != 0:
            raise RuntimeError(f"{words}: {done.stderr}\n{self.logs()}")
        return done.stdout

    def submit(self, script):
        """The number of its array."""
        (self.folder / "job.sbatch").write_text(script)
        return int(self.ask("sbatch", "--parsable", "job.sbatch"))

    def tasks(self, array):
        """Number in the array -> its state, how often it began again, exit code."""
        found = {}
        for line in self.ask("scontrol", "--oneliner", "show", "job", array).splitlines():
            fields = dict(re.findall(r"(\w+)=(\S+)", line))
            code, killed_by = map(int, fields["ExitCode"].split(":"))
            if fields["ArrayTaskId"].isdigit():  # not those that wait still
                found[int(fields["ArrayTaskId"])] = {"state": fields["JobState"], "again": int(fields["Restarts"]),
                                                     "code": code or 128 * bool(killed_by) + killed_by,
                                                     "job": int(fields["JobId"])}
        return found

    def state(self, array, task):
        return self.tasks(array).get(task, {}).get("state")

    def begin_now(self, array, task):
        """Who is requeued waits otherwise until the credentials of before have expired."""
        self.ask("scontrol", "update", f"JobId={array}_{task}", "StartTime=now")


if __name__ == "__main__":
    sys.exit(why_not() or None)
