"""A Slurm of its own for a test: controller, one node and munge on the loopback, all their files in one directory."""
import os
import pwd
import shutil
import socket
import subprocess
import time
import unittest

CONFIGURATION = """
ClusterName=rubatlas
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller_port}
SlurmdPort={node_port}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={directory}/munge.socket,cred_expire=5
CryptoType=cred/munge
StateSaveLocation={directory}/state
SlurmdSpoolDir={directory}/spool
SlurmctldPidFile={directory}/slurmctld.pid
SlurmdPidFile={directory}/slurmd.pid
SlurmctldLogFile={directory}/slurmctld.log
SlurmdLogFile={directory}/slurmd.log
MailProg=/bin/true
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
MpiDefault=none
SwitchType=switch/none
SlurmdParameters=config_overrides
SchedulerParameters=sched_interval=1,sched_min_interval=0,batch_sched_delay=0
NodeName={host} NodeAddr=127.0.0.1 CPUs=4 State=UNKNOWN
PartitionName=all Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""
# The node has four processors whatever the machine has. A job that is requeued waits until its credential has expired,
# which takes 5 s at least.
PATIENCE = 30  # s


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


class Slurm:
    """Started when made. Raises SkipTest with the reason where this machine has no Slurm or cannot run it."""

    def __init__(self, directory):
        self.directory = directory
        self.user = pwd.getpwuid(os.getuid()).pw_name
        self.daemons = []
        for program in ("munged", "slurmctld", "slurmd", "sbatch"):
            if shutil.which(program, path=self.path()) is None:
                raise unittest.SkipTest(f"this machine has no {program} (Debian's package slurm-wlm)")
        for folder in ("state", "spool"):
            (directory / folder).mkdir()
        controller_port, node_port = free_ports(2)
        (directory / "slurm.conf").write_text(CONFIGURATION.format(
            host=socket.gethostname().split(".")[0], user=self.user, directory=directory,
            controller_port=controller_port, node_port=node_port))
        self.environment = {**os.environ, "PATH": self.path(), "SLURM_CONF": str(directory / "slurm.conf")}
        self.start_daemons()

    @staticmethod
    def path():
        return os.environ["PATH"] + ":/usr/sbin:/sbin"

    def start_daemons(self):
        key = self.directory / "munge.key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o400)
        self.start("munged", "--foreground", "--force", "--num-threads=2", *(
            f"--{what}-file={self.directory}/munge.{what}" for what in ("key", "pid", "log", "seed")),
            f"--socket={self.directory}/munge.socket")
        self.wait_until(lambda: (self.directory / "munge.socket").exists(), "munged opens no socket")
        self.start("slurmctld", "-D")
        self.start("slurmd", "-D")
        self.wait_until(lambda: "idle" in self.call("sinfo", "-h", "-o", "%T").stdout,
                        "Slurm's node does not become idle")

    def start(self, *command):
        log = open(self.directory / f"{command[0]}.out", "wb")
        with log:
            self.daemons.append(subprocess.Popen(command, env=self.environment, stdin=subprocess.DEVNULL, stdout=log,
                                                 stderr=subprocess.STDOUT))

    def wait_until(self, condition, otherwise):
        """A daemon that gives up finds that it cannot run on this machine; daemons that run must work."""
        end = time.monotonic() + PATIENCE
        while not condition():
            ended = [daemon.args[0] for daemon in self.daemons if daemon.poll() is not None]
            if ended or time.monotonic() > end:
                said = "".join(f"\n{path.name}: {path.read_text(errors='replace')[-1000:]}"
                               for path in sorted(self.directory.glob("*.out")))
                self.close()
                if ended:
                    raise unittest.SkipTest(f"{ended[0]} does not run on this machine{said}")
                raise AssertionError(otherwise + said)
            time.sleep(0.1)

    def call(self, *command, **more):
        """A command of Slurm to its end, in the directory `cwd` of the caller's choice."""
        return subprocess.run([*map(str, command)], capture_output=True, text=True, stdin=subprocess.DEVNULL,
                              check=False,
                              timeout=120, **{"env": self.environment, **more})

    def state(self, job):
        """RUNNING, COMPLETED ..., one word for each task of an array."""
        return set(self.call("squeue", "-h", "-t", "all", "-o", "%T", "-j", job).stdout.split())

    def close(self):
        if len(self.daemons) == 3 and all(daemon.poll() is None for daemon in self.daemons):
            self.call("scancel", "--user", self.user, "--signal=KILL", "--full")
            self.call("scancel", "--user", self.user)
            # Without its daemons a job would go on.
            end = time.monotonic() + PATIENCE
            while self.call("squeue", "-h").stdout.strip() and time.monotonic() < end:
                time.sleep(0.2)
        for daemon in reversed(self.daemons):
            daemon.terminate()
            try:
                daemon.wait(timeout=10)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()
