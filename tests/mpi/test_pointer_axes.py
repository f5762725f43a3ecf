"""An axis that names a quantity by its JSON pointer is the same as an atlas for each of its values."""
import unittest

import h5py
import numpy as np
import xarray

from atlas_contract import departures
from job import JobTest, scene

RIGID = {"law": "elastic_ring"}
SPEEDS = {"from": 0.2, "to": 0.9, "count": 12}


class PointerAxes(JobTest):
    def assert_rows_of(self, atlas, line, other):
        """The rows of `atlas` at one index of its first axis are those of `other`, bit by bit."""
        with h5py.File(atlas) as one, h5py.File(other) as single:
            rows = [name for name in single if isinstance(single[name], h5py.Dataset) and single[name].ndim >= 5]
            self.assertLessEqual({"status", "restarted", "failed_revolution", "final_state", "poincare", "spectrum",
                                  "max_displacement"}, set(rows))
            for name in rows:
                self.assertEqual(one[name][line].tobytes(), single[name][()].tobytes(), name)

    def test_each_value_gives_the_rows_of_a_scene_that_has_it(self):
        swept = self.fill(2, scene(contact=RIGID, sweep="up", grid={
            "speed_ratio": SPEEDS, "damping_ratio": [0.1, 0.2], "/ring/stiffness": [1e3, 1e4]}))
        self.assertEqual(departures(swept), [])
        with h5py.File(swept) as file:
            self.assertEqual(list(file["ring_stiffness"]), [1e3, 1e4])
            self.assertEqual(file["ring_stiffness"].attrs["units"], "N/m")
            self.assertIn("stiffness of the massless ring", file["ring_stiffness"].attrs["long_name"])
            self.assertFalse(np.array_equal(file["final_state"][0], file["final_state"][1]))
        for line, stiffness in enumerate((1e3, 1e4)):
            own = self.fill(None, scene(contact=RIGID, ring={"stiffness": stiffness},
                                        grid={"speed_ratio": SPEEDS, "damping_ratio": [0.1, 0.2]}), f"{stiffness:g}.h5")
            self.assert_rows_of(swept, line, own)

    def test_lengths_and_effects_are_swept_too_by_any_number_of_ranks(self):
        content = scene(sweep="both", grid={"speed_ratio": {"from": 0.3, "to": 0.8, "count": 5}, "unbalance": [0, 1e-4],
                                            "/blades/length": [0.099, 0.1], "/unbalance/phase": [0, 1]})
        alone, together = self.fill(None, content, "alone.h5"), self.fill(3, content, "together.h5")
        self.assert_same_bytes(alone, together)
        self.assertEqual(departures(alone), [])
        with xarray.open_dataset(alone, engine="h5netcdf") as atlas:
            self.assertEqual(atlas["status"].dims[:4], ("direction", "blades_length", "unbalance_phase", "thickness"))
            states = atlas["final_state"].sel(direction=0)
            without, with_it = states.sel(unbalance=0), states.sel(unbalance=1e-4)
            # Nothing that is absent has a phase.
            np.testing.assert_array_equal(without.sel(unbalance_phase=0), without.sel(unbalance_phase=1))
            self.assertFalse(np.array_equal(with_it.sel(unbalance_phase=0), with_it.sel(unbalance_phase=1)))
            self.assertFalse(np.array_equal(without.sel(blades_length=0.099), without.sel(blades_length=0.1)))

    def test_an_interrupted_job_goes_on_and_the_dry_run_lists_the_axis(self):
        content = scene(contact=RIGID, grid={"speed_ratio": SPEEDS, "/ring/stiffness": [1e3, 1e4]})
        atlas = self.fill(None, content)
        whole = atlas.read_bytes()
        with h5py.File(atlas, "r+") as file:
            file["status"][1, ..., 5:] = 0
        again = self.execute(2, "run", self.directory / "scene.json", "-o", atlas, "--resume", "--progress", "off")
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertEqual(atlas.read_bytes(), whole)
        dry = self.execute(None, "run", self.directory / "scene.json", "-o", self.directory / "dry.h5", "--dry-run")
        self.assertRegex(dry.stdout, r"ring_stiffness +2  1000, 10000 N/m")

    def test_blades_that_do_not_fit_somewhere_are_found_before_anything_runs(self):
        path = self.write_scene(scene(grid={"speed_ratio": SPEEDS, "/ring/radius": [0.105, 0.12],
                                            "/blades/length": [0.09, 0.108]}))
        atlas = self.directory / "atlas.h5"
        self.assert_refused(self.execute(2, "run", path, "-o", atlas), 2, "/grid/~1ring~1radius: ",
                            "must fit into the ring")
        self.assertFalse(atlas.exists())


if __name__ == "__main__":
    unittest.main()
