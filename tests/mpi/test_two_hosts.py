"""Ranks on two hosts that share a directory: network namespaces, each with a host name and an address of its own."""
import json
import shutil
import subprocess
import unittest

from job import AT_ITS_END, ENVIRONMENT, JobTest, PROGRAM, TIME_LIMIT, scene

NAMES = ["rubatlas-left", "rubatlas-right"]
ADDRESSES = ["10.213.7.1", "10.213.7.2"]

# mpirun calls it as it would call ssh, with the address of a host and a command for its shell.
AGENT = """#!/bin/sh
host=$1
shift
case $host in
{cases}
esac
echo "no such host: $host" >&2
exit 1
"""


class Hosts:
    """Two hosts, which are gone when their processes end."""

    def __init__(self, directory):
        self.processes = []
        for program in ("ip", "unshare", "nsenter"):
            if shutil.which(program) is None:
                raise unittest.SkipTest(f"this machine has no {program} in the path of its user")
        try:
            for name in NAMES:
                # The shell reports when it is in its namespaces, and holds them until its input ends.
                holder = subprocess.Popen(["unshare", "--net", "--uts", "sh", "-c",
                                           f"hostname {name} && echo ready; read end"],
                                          stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                          text=True)
                self.processes.append(holder)
                if holder.stdout.readline() != "ready\n":
                    reason = holder.stderr.readline().strip()
                    raise unittest.SkipTest(f"this machine makes no network namespaces: {reason}")
            left, right = (holder.pid for holder in self.processes)
            self.configure("ip", "link", "add", "cable", "netns", str(left), "type", "veth", "peer", "name", "cable",
                           "netns", str(right))
            for host, address in enumerate(ADDRESSES):
                for arguments in (("addr", "add", address + "/24", "dev", "cable"), ("link", "set", "cable", "up"),
                                  ("link", "set", "lo", "up")):
                    self.configure(*self.enter(host), "ip", *arguments)
        except BaseException:
            self.close()
            raise
        self.agent = directory / "agent.sh"
        self.agent.write_text(AGENT.format(cases="\n".join(
            f"  {address}) exec {' '.join(self.enter(host))} sh -c \"$*\" ;;"
            for host, address in enumerate(ADDRESSES))))
        self.agent.chmod(0o755)

    def enter(self, host):
        return ["nsenter", "--net", "--uts", "--target", str(self.processes[host].pid)]

    @staticmethod
    def configure(*command):
        ended = subprocess.run(command, capture_output=True, text=True, check=False)
        if ended.returncode != 0:
            raise unittest.SkipTest("this machine connects no network namespaces: "
                                    f"{' '.join(command)}: {ended.stderr.strip()}")

    def close(self):
        for process in self.processes:
            process.communicate()


class TwoHosts(JobTest):
    def test_ranks_on_two_hosts_write_the_same_bytes_into_a_shared_directory(self):
        hosts = Hosts(self.directory)
        self.addCleanup(hosts.close)
        whole = self.fill(None, scene(), "whole.h5")
        # Each host runs two ranks (Open MPI 5 does not count what --host allows), and takes part with its only
        # interface to the other.
        launcher = [*hosts.enter(0), "mpirun", "-n", "4", "--host", ",".join(address + ":2" for address in ADDRESSES),
                    "--map-by", "ppr:2:node:oversubscribe", "--bind-to", "none",
                    "--mca", "plm_rsh_agent", str(hosts.agent), "--mca", "oob_tcp_if_include", "cable",
                    "--mca", "btl_tcp_if_include", "cable", "--mca", "btl", "tcp,self,vader"]
        job = subprocess.run([*launcher, PROGRAM, "run", "scene.json", "-o", "shared.h5", "--progress", "off"],
                             cwd=self.directory, env={**ENVIRONMENT, **AT_ITS_END}, capture_output=True, text=True,
                             timeout=TIME_LIMIT, check=False)
        self.assertEqual(job.returncode, 0, job.stderr)
        run, = json.loads((self.directory / "shared.h5.run.json").read_text())["runs"]
        self.assertEqual(run["host_of_rank"], [NAMES[0], NAMES[0], NAMES[1], NAMES[1]])
        self.assertTrue(any(run["points_of_rank"][2:]), "the second host has computed points")
        self.assert_same_bytes(whole, self.directory / "shared.h5")


if __name__ == "__main__":
    unittest.main()
