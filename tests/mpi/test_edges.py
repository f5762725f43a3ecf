"""Borders between motions are narrowed down by new points: where a fine sweep has them, same bytes for any ranks."""
import os
import signal
import subprocess
import unittest

import h5py
import numpy as np

from job import ENVIRONMENT, FAILING, JobTest, command, has_ended, scene, wait_for

SHARP, SLOW, DIVIDED, OVERRUN = 0, 1, 2, 3
PERIODS = range(1, 17)


def rotor(speeds, **changes):
    """The default rotor with the full protocol."""
    return {"title": "edges", "reference": "none", "grid": {"speed_ratio": speeds, "damping_ratio": 0.1},
            "observables": ["poincare", "max_displacement"], **changes}


def short(**changes):
    """Two lines that take a second; classes of short records are often unresolved, which is a result too."""
    return scene(grid={"speed_ratio": {"from": 0.3, "to": 0.7, "count": 17}, "damping_ratio": [0.1, 0.2]},
                 protocol={"transient_revolutions": 60, "sampled_revolutions": 40, "samples_per_revolution": 32},
                 observables=["poincare", "max_displacement"], **changes)


class EdgesTest(JobTest):
    def edges(self, ranks, atlas, output="edges.h5", *options, code=0):
        job = self.execute(ranks, "edges", atlas, "-o", output, "--progress", "off", *options)
        self.assertEqual((job.returncode, job.stderr), (code, ""))
        return self.directory / output

    def rows(self, path):
        """Columns of the table of edges."""
        with h5py.File(path, "r") as file:
            return {name: file["edges"][name][...] for name in file["edges"]}

    def classes(self, atlas):
        """Speeds and classes of an atlas with one line."""
        maps = self.directory / "maps_of_fine.h5"
        job = self.execute(None, "analyse", atlas, "-o", maps, "--overwrite")
        self.assertEqual(job.returncode, 0, job.stderr)
        with h5py.File(maps, "r") as file:
            return file["speed_ratio"][...], file["class"][...].ravel()


class Edges(EdgesTest):
    def test_an_edge_lies_where_a_fine_sweep_has_it(self):
        # Period 1 of the default rotor ends by a grazing, passes through period 2, and region 2 begins.
        atlas = self.fill(2, rotor({"from": 0.437, "to": 0.441, "count": 5}))
        found = self.rows(self.edges(2, atlas))
        self.assertEqual(list(found["class_below"]), [1, 2])
        self.assertEqual(list(found["class_above"]), [2, 255])
        self.assertEqual(list(found["outcome"]), [SHARP, SHARP])
        self.assertTrue((found["upper"] - found["lower"] <= 1e-6).all())
        fine = self.fill(2, rotor({"from": 0.437, "to": 0.441, "count": 161}), "fine.h5")
        speeds, classes = self.classes(fine)
        for motion, lower, upper in zip(found["class_below"], found["lower"], found["upper"]):
            last = speeds[classes == motion].max()
            self.assertLess(last, upper)
            self.assertLess(lower - last, speeds[1] - speeds[0])

    def test_any_number_of_ranks_finds_the_same_bytes(self):
        for name, content in (("up", short()), ("both", short(sweep="both")),
                              ("independent", short(sweep="independent")),
                              ("wear", short(wear={"rate": 1e-6, "carries_over": True}))):
            with self.subTest(scene=name):
                atlas = self.whole(content)
                before = atlas.read_bytes()
                alone = self.edges(None, atlas, f"{name}0.h5", "--to", "1e-4")
                self.assertLessEqual({0, 1}, set(self.rows(alone)["line"]), "lines of both damping ratios have edges")
                for ranks in (1, 3) if name == "up" else (3,):
                    self.assertTrue(alone.read_bytes() == self.edges(ranks, atlas, f"{name}{ranks}.h5", "--to",
                                                                     "1e-4").read_bytes(),
                                    f"{ranks} ranks make other edges")
                self.assertEqual(before, atlas.read_bytes(), "the atlas is only read")

    def test_sweeps_up_and_down_start_from_the_side_they_come_from(self):
        # Both sides of each edge are the classes of its line's own points of the grid.
        atlas = self.whole(short(sweep="both"))
        found = self.rows(self.edges(2, atlas, "edges.h5", "--to", "1e-4"))
        maps = self.directory / "maps.h5"
        self.assertEqual(self.execute(None, "analyse", atlas, "--edges", "edges.h5", "-o", maps).returncode, 0)
        with h5py.File(maps, "r") as file:
            speeds, classes = file["speed_ratio"][...], file["class"][...].reshape(-1, 17)
        self.assertEqual(set(found["at_direction"]), {0.0, 1.0})
        for border in set(found["border"]):
            edges = np.flatnonzero(found["border"] == border)
            first, last = edges[0], edges[-1]
            line = classes[found["line"][first]]
            below = np.flatnonzero((speeds <= found["lower"][first]) & (line != 254))[-1]
            above = np.flatnonzero((speeds >= found["upper"][last]) & (line != 254))[0]
            if found["outcome"][first] != OVERRUN:
                self.assertEqual(line[below], found["class_below"][first])
                self.assertEqual(line[above], found["class_above"][last])

    def test_the_edge_of_the_models_validity_is_an_edge(self):
        content = scene(grid={"speed_ratio": {"from": 0.2, "to": 0.9, "count": 30}, "damping_ratio": FAILING[:1]},
                        protocol={"transient_revolutions": 60, "sampled_revolutions": 40, "samples_per_revolution": 32},
                        observables=["poincare"])
        atlas = self.fill(2, content)
        found = self.rows(self.edges(2, atlas, "edges.h5", "--to", "1e-4"))
        validity = found["kind"] == 4
        self.assertTrue(validity.any())
        self.assertTrue(((found["class_below"] == 253) | (found["class_above"] == 253))[validity].all())

    def test_analyse_quotes_edges_with_their_uncertainty(self):
        atlas = self.fill(2, rotor({"from": 0.30, "to": 0.50, "count": 41}, sweep="both"))
        job = self.execute(2, "edges", atlas, "--to", "1e-4", "--regions", "--progress", "off")
        self.assertEqual((job.returncode, job.stderr), (0, ""))
        found = self.rows(self.directory / "atlas_edges.h5")
        self.assertTrue(((found["region_begins"] > 0) | (found["region_ends"] > 0)).any())
        job = self.execute(None, "analyse", atlas, "--edges", "atlas_edges.h5", "-o", "maps.h5", "--table", "table.md")
        self.assertEqual((job.returncode, job.stderr), (0, ""))
        for text in (job.stdout, (self.directory / "table.md").read_text()):
            self.assertRegex(" ".join(text.split()), r"region 2 begins (at|between) Ω = 0\.\d+")
            self.assertRegex(" ".join(text.split()), r"region 2 begins .* as the speed grows, and .* as it falls")
        self.assertRegex(job.stdout, r"0\.\d+\(\d+\)-\(0\.")
        with h5py.File(self.directory / "maps.h5", "r") as maps:
            self.assertEqual({name: list(maps["edges"][name][...]) for name in maps["edges"]},
                             {name: list(values) for name, values in found.items()})
            self.assertEqual(set(maps["edges/at_damping_ratio"][...]), {0.1})
            self.assertFalse(set(maps["edges"]) & set(maps), "xarray takes a name of an axis for the axis itself")
            up = np.flatnonzero((found["region_begins"] == 2) & (found["line"] == 0))[0]
            self.assertEqual(maps["table1/region_2_from_lower"][0], found["lower"][up])
            self.assertEqual(maps["table1/region_2_from_upper"][0], found["upper"][up])

    def test_a_line_without_borders_has_no_edges(self):
        atlas = self.fill(None, rotor({"from": 0.05, "to": 0.1, "count": 3}))
        self.assertEqual(len(self.rows(self.edges(2, atlas))["line"]), 0)
        ended = self.execute(None, "edges", atlas, "-o", "again.h5")
        self.assertEqual((ended.returncode, ended.stdout, ended.stderr),
                         (0, "  Edges: none; there are no borders.\n", ""))
        self.assertEqual(self.execute(None, "analyse", atlas, "--edges", "edges.h5", "-o", "maps.h5").returncode, 0)

    def test_what_cannot_be_done_is_one_sentence(self):
        atlas = self.fill(None, short())
        other = self.fill(None, short(sweep="down"), "other.h5")
        self.edges(None, atlas)
        bare = self.fill(None, {**short(), "observables": ["max_displacement"]}, "bare.h5")
        before = sorted(os.listdir(self.directory))
        for ranks in (None, 2):
            with self.subTest(ranks=ranks):
                edges = lambda *options: self.execute(ranks, "edges", *options)
                self.assert_refused(edges(atlas, "-o", "edges.h5"), 2, "edges.h5 exists; --overwrite replaces it")
                self.assert_refused(edges(atlas, "-o", atlas, "--overwrite"), 2, "the same file")
                self.assert_refused(edges(atlas, "-o", other, "--overwrite"), 2,
                                    "other.h5 is an atlas, and --overwrite replaces edges by edges only")
                self.assert_refused(edges(atlas, "-o", "new.h5", "--to", "0"), 2, "--to 0: outside [1e-12, 1]")
                self.assert_refused(edges(bare), 2, "bare.h5 has no edges: it keeps no sections", "poincare")
                self.assert_refused(edges("nowhere.h5"), 3, "nowhere.h5", "No such file")
                self.assert_refused(edges("edges.h5"), 2, "edges.h5 holds edges; an atlas is wanted")
        analyse = lambda *options: self.execute(None, "analyse", *options)
        self.assert_refused(analyse(other, "--edges", "edges.h5", "-o", "m.h5"), 2,
                            "edges.h5 was made from another scene", "/sweep")
        self.assert_refused(analyse(atlas, "--edges", other, "-o", "m.h5"), 2, "other.h5 is no file of edges")
        self.assert_refused(analyse(atlas, "--edges", "edges.h5", "-o", "edges.h5", "--overwrite"), 2, "the same file")
        self.assertEqual(sorted(os.listdir(self.directory)), before)

    def test_a_run_that_is_stopped_or_killed_leaves_no_file(self):
        atlas = self.fill(2, rotor({"from": 0.30, "to": 0.60, "count": 121}))
        before = sorted(os.listdir(self.directory))
        for ranks, number, code in ((None, signal.SIGTERM, 75), (2, signal.SIGUSR1, 75), (2, signal.SIGKILL, None)):
            with self.subTest(ranks=ranks, signal=number):
                job = subprocess.Popen(command(ranks, "edges", atlas, "--to", "1e-12", "--progress", "off"),
                                       env=ENVIRONMENT,
                                       cwd=self.directory, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
                processes = self.wait_until_it_computes(job, ranks)
                job.send_signal(number)
                _, said = job.communicate(timeout=60)
                if code is not None:
                    self.assertEqual(job.returncode, code, said)
                    self.assertIn("stopped; ", said)
                self.assertTrue(wait_for(lambda: all(map(has_ended, processes))), "a rank outlives its mpirun")
                self.assertEqual(sorted(os.listdir(self.directory)), before)


if __name__ == "__main__":
    unittest.main()
