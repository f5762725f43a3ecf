"""What an atlas says of the distance to a change, held against finer sweeps across that change."""
import unittest

import h5py
import numpy as np

from job import JobTest

NEAR_GRAZING = ["poincare", "max_displacement", "nearest_miss", "lightest_touch", "grazing_side"]
RECEDING = 3


def rotor(speeds, **changes):
    """The default rotor with the full protocol."""
    return {"title": "margins", "reference": "none", "grid": {"speed_ratio": speeds, "damping_ratio": 0.1},
            "observables": NEAR_GRAZING, **changes}


class Margins(JobTest):
    def maps(self, atlas, name):
        path = self.directory / name
        job = self.execute(None, "analyse", atlas, "-o", path)
        self.assertEqual((job.returncode, job.stderr), (0, ""))
        return path, job.stdout

    def period_one(self, name, speeds, sweep):
        """The speeds of a fine sweep at which the motion repeats after one revolution."""
        path, _ = self.maps(self.fill(2, rotor(speeds, sweep=sweep), f"{name}.h5"), f"{name}_maps.h5")
        with h5py.File(path, "r") as file:
            return file["speed_ratio"][...][file["class"][...].ravel() == 1]

    def test_both_ends_of_region_2_are_foretold_from_steps_of_a_thousandth(self):
        coarse = self.fill(2, rotor({"from": 0.42, "to": 0.62, "count": 201}), "coarse.h5")
        path, text = self.maps(coarse, "coarse_maps.h5")
        with h5py.File(path, "r") as file:
            found = {name: file["grazings"][name][...] for name in file["grazings"]}
            self.assertFalse(set(found) & set(file), "xarray takes a name of an axis for the axis itself")
        begins = found["region_begins"] == 2
        ends = found["region_ends"] == 2
        self.assertEqual((begins.sum(), ends.sum()), (1, 1))
        self.assertTrue((found["side"][begins | ends] == RECEDING).all())
        below = self.period_one("below", {"from": 0.4388, "to": 0.4398, "count": 41}, "up")
        above = self.period_one("above", {"from": 0.595, "to": 0.596, "count": 41}, "down")
        self.assertLess(abs(found["at_speed_ratio"][begins] - below.max()), 1e-4)
        self.assertLess(abs(found["at_speed_ratio"][ends] - above.min()), 1e-4)
        self.assertIn("region 2 begins by grazing on the receding side at Ω = 0.439338(", " ".join(text.split()))

    def test_maps_have_a_distance_for_every_parameter_that_is_swept(self):
        grid = {"speed_ratio": {"from": 0.42, "to": 0.45, "count": 7}, "damping_ratio": [0.1, 0.2]}
        atlas = self.fill(2, rotor(None, grid=grid))
        path, _ = self.maps(atlas, "maps.h5")
        with h5py.File(path, "r") as file:
            shape = file["class"].shape
            self.assertEqual({name for name in file["margins"] if not name.endswith("_to_grazing")},
                             {"along_speed_ratio", "along_damping_ratio"})
            classes = file["class"][...].ravel().reshape(2, 7)
            distance = file["margins/along_speed_ratio"]
            self.assertEqual(distance.shape, shape)
            self.assertEqual(distance.attrs["units"], "1")
            for line, values in zip(classes, distance[...].reshape(2, 7)):
                changes = np.flatnonzero(np.diff(line.astype(int)) != 0)
                self.assertEqual(np.isnan(values).all(), len(changes) == 0)


if __name__ == "__main__":
    unittest.main()
