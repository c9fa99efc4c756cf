"""A Slurm of one node, this machine: munged, slurmctld and slurmd, all in one folder and on loopback."""

import os
import re
import secrets
import shutil
import socket
import subprocess
import time

from farm import skip_all

PROGRAMS = ["munged", "slurmctld", "slurmd", "sbatch", "setpriv", "unshare"]

# cred_expire is also how long a requeued job waits. Memory and processors are declared, not looked up: nothing here is
# scheduled by them.
CONFIGURATION = """
ClusterName=raytrace
SlurmctldHost=localhost(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket,cred_expire=5
CredType=cred/munge
SlurmctldPort={controller_port}
SlurmdPort={node_port}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SlurmdParameters=config_overrides
ReturnToService=2
RequeueExit=75
MpiDefault=none
KillWait=15
MinJobAge=600
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
SchedulerParameters=batch_sched_delay=0,sched_interval=1
NodeName=localhost NodeAddr=127.0.0.1 CPUs=2 RealMemory=8000 State=UNKNOWN
PartitionName=main Nodes=localhost Default=YES MaxTime=INFINITE State=UP
"""


class CannotRun(Exception):
    """This machine cannot run a Slurm; says why."""


class SlurmCluster:
    """Runs from start() to stop()."""

    # Generous: a busy machine starts and ends a job in seconds.
    PATIENCE = 120

    def __init__(self, folder):
        self.folder = folder
        self.environment = {**os.environ, "SLURM_CONF": self.path("slurm.conf")}
        self.daemons = []

    def path(self, name):
        return os.path.join(self.folder, name)

    def start(self):
        """Throws CannotRun."""
        if os.geteuid() != 0:
            raise CannotRun("slurmd needs root")
        missing = [program for program in PROGRAMS if not shutil.which(program)]
        if missing:
            raise CannotRun(f"not installed: {', '.join(missing)} (packages slurm-wlm, munge and util-linux)")
        os.chmod(self.folder, 0o755)  # munged wants its socket to be reachable
        os.mkdir(self.path("state"))
        os.mkdir(self.path("spool"))
        with open(os.open(self.path("munge.key"), os.O_CREAT | os.O_WRONLY, 0o400), "wb") as key:
            key.write(secrets.token_bytes(128))
        ports = _free_ports(2)
        self._write("slurm.conf", CONFIGURATION.format(
            folder=self.folder, controller_port=ports[0], node_port=ports[1]))
        if _version() >= (23, 2):  # before, it did without cgroups unasked
            self._write("cgroup.conf", "CgroupPlugin=disabled\n")

        self._launch("munged", "--foreground", f"--socket={self.path('munge.socket')}",
                     f"--key-file={self.path('munge.key')}", f"--pid-file={self.path('munged.pid')}",
                     f"--log-file={self.path('munged.file')}", f"--seed-file={self.path('munge.seed')}")
        self._wait("munged's socket", lambda: os.path.exists(self.path("munge.socket")))
        self._launch("slurmctld", "-D", "-i")
        self._launch("slurmd", "-D", "-N", "localhost")
        self._wait("an idle node", lambda: self.ask("sinfo", "--noheader", "--format=%T", check=False) == "idle")

    def stop(self):
        """Cancels what runs and ends what start() started; then nothing of it is left but the folder's files."""
        if len(self.daemons) == 3:
            self.ask("scancel", "--user=root", check=False)
            self._wait("the end of all jobs", lambda: not self.processes("slurmstepd"))
        for daemon in reversed(self.daemons):
            daemon.terminate()
            try:
                daemon.wait(self.PATIENCE)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()

    def processes(self, name=""):
        """Command lines of the processes that were told of this cluster's folder, those with this name."""
        found = []
        for pid in filter(str.isdigit, os.listdir("/proc")):
            try:
                with open(f"/proc/{pid}/cmdline", "rb") as file:
                    command = file.read()
                with open(f"/proc/{pid}/environ", "rb") as file:
                    told = command + file.read()
            except OSError:
                continue  # it has just ended
            if int(pid) != os.getpid() and self.folder.encode() in told and name.encode() in command:
                found.append(command.replace(b"\0", b" ").decode(errors="replace"))
        return found

    def ask(self, *command, check=True, **variables):
        """Runs one of Slurm's commands, with these environment variables besides; gives what it prints."""
        done = subprocess.run(command, env={**self.environment, **variables}, cwd=self.folder, text=True,
                              stdin=subprocess.DEVNULL, capture_output=True, check=False)
        if check and done.returncode != 0:
            raise AssertionError(f"{command[0]} ended with {done.returncode}: {done.stderr}")
        return done.stdout.strip()

    def submit(self, script, *options, **variables):
        """The number of the new job."""
        return self.ask("sbatch", "--parsable", *options, script, **variables)

    def facts(self, job):
        """What Slurm knows of each task of a job, as texts: JobState, ExitCode, Restarts and so on."""
        tasks = self.ask("scontrol", "--oneliner", "show", "job", job).splitlines()
        return [dict(re.findall(r"(\w+)=(\S*)", task)) for task in tasks]

    def states(self, job):
        return sorted(task["JobState"] for task in self.facts(job))

    def wait_for(self, job, *states):
        """Waits until each task of a job is in one of these states."""
        self._wait(f"job {job} to be {' or '.join(states)}",
                   lambda: all(state in states for state in self.states(job)),
                   lambda: f"{self.facts(job)}")

    def wait_until(self, what, condition):
        self._wait(what, condition)

    def _write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)

    def _launch(self, name, *options):
        """Starts a daemon, which ends when this process does and for which this machine is called localhost: Slurm
        listens on the address of that name, and not each machine's own name has one."""
        command = ["setpriv", "--pdeathsig", "TERM",
                   "unshare", "--uts", "sh", "-c", 'hostname localhost && exec "$@"', "sh"]
        with open(self.path(f"{name}.log"), "wb") as log:
            daemon = subprocess.Popen([*command, name, *options], env=self.environment, cwd=self.folder,
                                      stdin=subprocess.DEVNULL, stdout=log, stderr=log)
        daemon.name = name
        self.daemons.append(daemon)

    def _wait(self, what, condition, state=lambda: ""):
        end = time.monotonic() + self.PATIENCE
        while not condition():
            for daemon in self.daemons:
                if daemon.poll() is not None:
                    raise CannotRun(f"{daemon.name} ended while this waited for {what}:\n{self._logs()}")
            if time.monotonic() > end:
                raise AssertionError(f"waited {self.PATIENCE} s in vain for {what}: {state()}\n{self._logs()}")
            time.sleep(0.1)

    def _logs(self):
        logs = ""
        for name in ["munged", "slurmctld", "slurmd"]:
            if os.path.exists(self.path(f"{name}.log")):
                with open(self.path(f"{name}.log"), encoding="utf-8", errors="replace") as file:
                    logs += f"---- {name}\n" + "".join(file.readlines()[-20:])
        return logs


def start_or_skip(folder):
    """From setUpModule(): a running cluster in a temporary folder; where none can run, the module's tests are skipped."""
    cluster = SlurmCluster(folder.name)
    try:
        cluster.start()
    except CannotRun as problem:
        cluster.stop()
        folder.cleanup()
        skip_all(f"{problem}")
    except BaseException:
        cluster.stop()
        raise
    return cluster


def _free_ports(count):
    """Of loopback, free at the moment."""
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


def _version():
    """(major, minor) of the Slurm that is installed."""
    text = subprocess.run(["slurmd", "-V"], text=True, capture_output=True, check=True).stdout
    return tuple(int(number) for number in re.search(r"(\d+)\.(\d+)", text).groups())
