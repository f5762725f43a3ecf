"""What a job says while it runs: a bar on a terminal, lines elsewhere, or nothing."""
import fcntl
import os
import pty
import struct
import subprocess
import termios
import unittest

from job import ENVIRONMENT, JobTest, command, long_scene, scene


class Progress(JobTest):
    def say(self, style, ranks=None, content=None):
        job = self.execute(ranks, "run", self.write_scene(content or scene()), "-o", "atlas.h5", "--overwrite",
                           "--progress", style)
        self.assertEqual(job.stdout, "")
        return job.stderr

    def on_a_terminal(self, columns, *options):
        """Everything that the program writes to a terminal of that width."""
        master, terminal = pty.openpty()
        fcntl.ioctl(terminal, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
        job = subprocess.Popen(command(None, "run", self.write_scene(long_scene()), "-o", "atlas.h5", *options),
                               env=ENVIRONMENT, cwd=self.directory, stdin=subprocess.DEVNULL, stderr=terminal)
        os.close(terminal)
        text = b""
        while True:
            try:
                part = os.read(master, 4096)
            except OSError:  # the other end is closed
                break
            if not part:
                break
            text += part
        os.close(master)
        self.assertEqual(job.wait(timeout=60), 0)
        return text.decode()

    def test_off_says_nothing(self):
        self.assertEqual(self.say("off"), "")

    def test_the_last_line_is_a_summary(self):
        for ranks in (None, 2):
            last = self.say("plain", ranks).splitlines()[-1]
            self.assertRegex(last,
                             r"^rubatlas: 36 of 36 points: 36 done, 0 outside the model, 0 failed; "
                             r"36 computed in [\d.]+ s, [\d.]+ points/s$")

    def test_a_pipe_gets_lines_without_carriage_returns(self):
        self.assertNotIn("\r", self.say("auto"))

    def test_a_bar_is_redrawn_in_place_under_mpirun(self):
        text = self.say("bar", 2, long_scene())
        drawn = text.split("\r")
        self.assertGreater(len(drawn), 2)
        self.assertRegex(drawn[-1], r"^\[#{40}\]  180/180 points  [\d.]+/s  ETA 0\.0 s *\n")
        for bar in drawn[1:-1]:  # a rate is told once a point is there
            self.assertRegex(bar, r"^\[#*\.*\]  ((0|180)/180 points|\d+/180 points  [\d.]+/s  ETA )")

    def test_a_terminal_gets_a_bar_that_fits_its_width(self):
        for columns in (60, 100, 20):
            text = self.on_a_terminal(columns, "--overwrite")
            bars = [part for part in text.split("\r") if "/180" in part or part.startswith("[")]
            self.assertGreater(len(bars), 2, text)
            for bar in bars:
                self.assertLess(len(bar.split("\n")[0]), columns)


if __name__ == "__main__":
    unittest.main()
