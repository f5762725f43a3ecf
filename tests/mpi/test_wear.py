"""What blades have lost goes from point to point like the state: by message, by file, and after a kill."""
import unittest

import h5py
import numpy as np

from atlas_contract import departures
from job import JobTest, long_scene, scene


def wearing(make, **changes):
    return make(wear={"rate": 1e-6, "carries_over": True}, observables=["poincare", "clearance_growth"], **changes)


class Wear(JobTest):
    def test_blades_get_shorter_along_each_line_by_what_its_points_say(self):
        content = wearing(scene)
        atlas = self.fill(2, content)
        self.assertEqual(departures(atlas), [])
        with h5py.File(atlas, "r") as file:
            self.assertEqual([scale.name for scale in file["final_state_wear"].dims[5].values()], ["/blade"])
            lost = file["final_state_wear"][...].reshape(3, 12, 3)
            growth = file["clearance_growth"][...].reshape(3, 12)
        self.assertTrue((np.diff(lost, axis=1) >= 0).all(), "a blade has grown")
        self.assertGreater(lost[:, -1].min(), 0.0)
        before = np.concatenate([np.zeros((3, 1, 3)), lost[:, :-1]], axis=1)
        np.testing.assert_array_equal(growth, (lost - before).max(axis=2))

    def test_each_point_has_new_blades_unless_wear_carries_over(self):
        content = wearing(scene)
        content["wear"]["carries_over"] = False
        with h5py.File(self.fill(2, content), "r") as file:
            np.testing.assert_array_equal(file["clearance_growth"][...], file["final_state_wear"][...].max(axis=-1))

    def test_without_wear_an_atlas_says_nothing_of_it(self):
        self.assert_says_nothing_of(wear={"rate": 0.0})

    def test_any_number_of_ranks_and_a_swept_rate_give_the_same_bytes(self):
        content = wearing(scene)
        del content["wear"]["rate"]
        content["grid"]["/wear/rate"] = [0.0, 1e-6, 1e-5]
        content["grid"]["damping_ratio"] = 0.1
        whole = self.fill(None, content, "whole.h5")
        self.assertEqual(departures(whole), [])
        self.assert_same_bytes(whole, self.fill(3, content, "three.h5"))
        with h5py.File(whole, "r") as file:
            lost = file["final_state_wear"][...].reshape(3, -1)
        self.assertEqual(lost[0].max(), 0.0)
        self.assertGreater(lost[2].max(), lost[1].max())

    def test_a_killed_job_goes_on_with_worn_blades_to_the_same_bytes(self):
        self.assert_survives_a_kill(wearing(long_scene, transient_revolutions=60))


if __name__ == "__main__":
    unittest.main()
