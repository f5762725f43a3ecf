"""The commands of `tools/` and scripts that use the package, each in a process of its own that is forked from the test:
python3 and its libraries take longer to start than most of them to run. That the commands start by themselves is seen
by the tests of the package and of the documentation."""
import os
import pathlib
import subprocess
import sys
import tempfile
import traceback

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools"))

from rubatlas import plot_command, style  # noqa: E402, F401  # style: every picture needs matplotlib
from rubatlas.report import command as report_command  # noqa: E402

MAINS = {"rubatlas-plot": plot_command.main, "rubatlas-report": report_command.main}


def forked(words, work, environment=None):
    """What `subprocess.run` would return of a process that does the work: its exit code and what it has said."""
    with tempfile.TemporaryFile("w+") as output, tempfile.TemporaryFile("w+") as errors:
        child = os.fork()
        if child == 0:
            code = 1
            try:
                os.dup2(output.fileno(), 1)
                os.dup2(errors.fileno(), 2)
                sys.stdout, sys.stderr = open(1, "w", closefd=False), open(2, "w", closefd=False)
                sys.argv = words
                if environment is not None:
                    os.environ.clear()
                    os.environ.update(environment)
                work()
                code = 0
            except SystemExit as end:
                code = end.code or 0
            except BaseException:  # pylint: disable=broad-except  # as python3 itself would print it
                traceback.print_exc()
            finally:
                sys.stdout.flush()
                sys.stderr.flush()
                os._exit(code)
        _, status = os.waitpid(child, 0)
        output.seek(0)
        errors.seek(0)
        return subprocess.CompletedProcess(words, os.waitstatus_to_exitcode(status), output.read(), errors.read())


def ended_command(command, *arguments, environment=None):
    """A command with these arguments, ended."""
    return forked([command, *map(str, arguments)], MAINS[command], environment)


def ended_script(text, folder, environment):
    """A script that python3 carries out in a folder, ended."""
    def work():
        os.chdir(folder)
        exec(compile(text, "script", "exec"), {"__name__": "__main__"})  # pylint: disable=exec-used
    return forked(["script"], work, environment)
