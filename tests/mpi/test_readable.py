"""An atlas is read by everybody's tools, also while it is being written."""
import subprocess
import unittest
import uuid

import h5py
import numpy as np
import xarray

from atlas_contract import departures
from job import DONE, FAILING, JobTest, PENDING, long_scene, scene, wait_for_points

ALL_OBSERVABLES = ["poincare", "poincare_blade_passing", "max_displacement", "spectrum", "touchdowns_per_revolution",
                   "max_contact_force", "contact_fraction", "max_root_strain"]


class Readable(JobTest):
    def read_with_everything(self, atlas):
        """Opens the file in the four ways that are promised; returns the number of finished points that h5py saw."""
        with h5py.File(atlas, "r") as file:
            finished = int((file["status"][...] != PENDING).sum())
            texts = [file["scene_resolved"].asstr()[()], file["speed_ratio"].attrs["units"]]
        self.assertTrue(all(texts))
        with xarray.open_dataset(atlas, engine="h5netcdf") as dataset:
            for axis in ("speed_ratio", "damping_ratio", "section", "order", "component"):
                self.assertIn(axis, dataset.coords)
            self.assertEqual(dataset["max_displacement"].sel(damping_ratio=0.1).dims[-1], "speed_ratio")
            self.assertEqual(dataset["max_displacement"].attrs["units"], "m")
            self.assertEqual(list(dataset["component"].values), ["x", "y", "vx", "vy"])
            self.assertNotIn("component", dataset["poincare"].sel(component="x").dims)
        header = subprocess.run(["ncdump", "-h", str(atlas)], text=True, capture_output=True, check=True).stdout
        self.assertIn("double poincare(thickness, unbalance, friction, damping_ratio, speed_ratio, section, component)",
                      header)
        listing = subprocess.run(["h5ls", str(atlas)], text=True, capture_output=True, check=True).stdout
        self.assertIn("max_displacement", listing)
        return finished

    def test_a_finished_atlas_is_read_by_h5py_xarray_ncdump_and_h5ls(self):
        self.assertEqual(self.read_with_everything(self.fill(2, scene())), 36)

    def test_an_atlas_names_its_creator_its_licence_and_the_identifier_of_its_scene(self):
        named = {**scene(), "creator": "Institut für Rotoren", "license": "CC-BY-4.0"}
        atlas = self.fill(2, named)
        with xarray.open_dataset(atlas, engine="h5netcdf") as dataset:
            self.assertEqual([dataset.attrs["creator"], dataset.attrs["license"]], [named["creator"], named["license"]])
            found = dataset.attrs["identifier"]
        with h5py.File(atlas, "r") as file:
            lines = file["scene_resolved"].asstr()[()].splitlines(keepends=True)
        # Of the canonical text without the lines that name the atlas.
        names = ('  "title"', '  "reference"', '  "creator"', '  "license"')
        kept = [line for line in lines if not line.startswith(names)]
        self.assertEqual(len(kept), len(lines) - 4)
        self.assertEqual(found, uuid.uuid5(uuid.UUID("ae902552-a7df-4316-84ce-174aab5fdaec"), "".join(kept)).urn)

    def read_while_it_is_written(self, ranks):
        atlas = self.directory / "atlas.h5"
        job = self.start(ranks, long_scene(), atlas)
        wait_for_points(job, atlas, 10)
        seen = self.read_with_everything(atlas)
        with h5py.File(atlas, "r") as file:
            done = file["status"][...] == DONE
            self.assertTrue(np.isfinite(file["poincare"][...][done]).all(), "status is written behind its row")
        with self.assertRaises(OSError, msg="another writer is kept out"):
            h5py.File(atlas, "r+")
        self.assertIsNone(job.poll(), "the job was still at work when it was looked at")
        self.assertEqual(job.wait(timeout=60), 0)
        self.assertTrue(10 <= seen < 180, f"{seen} points were seen")

    def test_an_atlas_is_read_while_ranks_write_it(self):
        self.read_while_it_is_written(2)

    def test_an_atlas_is_read_while_one_process_writes_it(self):
        self.read_while_it_is_written(None)


class Contract(JobTest):
    def check(self, ranks, content):
        self.assertEqual(departures(self.fill(ranks, content)), [])

    def test_holds_for_the_default_observables(self):
        self.check(2, scene())

    def test_holds_for_every_observable_and_both_directions(self):
        self.check(2, scene(sweep="both", observables=ALL_OBSERVABLES))

    def test_holds_for_a_single_observable(self):
        self.check(None, scene(observables=["max_contact_force"]))

    def test_holds_where_points_fail(self):
        content = scene(observables=ALL_OBSERVABLES)
        content["grid"]["damping_ratio"] = FAILING
        self.check(2, content)

    def test_holds_without_a_transient(self):
        self.check(None, scene(protocol={"transient_revolutions": 0, "sampled_revolutions": 3,
                                         "samples_per_revolution": 32}))

    def test_holds_for_a_grid_of_one_point(self):
        self.check(2, scene(grid={"speed_ratio": 0.5}))

    def test_holds_for_an_atlas_that_was_killed(self):
        atlas = self.directory / "atlas.h5"
        job = self.start(None, long_scene(), atlas)
        wait_for_points(job, atlas, 30)
        job.kill()
        job.wait()
        self.assertEqual(departures(atlas), [])


if __name__ == "__main__":
    unittest.main()
