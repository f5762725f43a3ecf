"""How the ring moves goes from point to point like the shaft's state: by message, by file, and after a kill."""
import unittest

import h5py
import numpy as np

from atlas_contract import departures
from job import JobTest, long_scene, scene


def in_ring_body(make, **changes):
    return make(ring_body={"mass": 1.0, "compliance": 1e-4, "damping": 40.0}, **changes)


class RingBody(JobTest):
    def test_the_ring_stands_beside_the_shaft_in_the_atlas(self):
        atlas = self.fill(2, in_ring_body(scene))
        self.assertEqual(departures(atlas), [])
        with h5py.File(atlas, "r") as file:
            self.assertEqual([scale.name for scale in file["final_state_ring_body"].dims[5].values()], ["/component"])
            ring = file["final_state_ring_body"][...].reshape(-1, 4)
            done = file["status"][...].ravel() == 1
        self.assertTrue(np.isfinite(ring[done]).all())
        self.assertGreater(np.abs(ring[done]).max(), 1e-9, "blades push it")

    def test_in_a_fixed_ring_an_atlas_says_nothing_of_it(self):
        self.assert_says_nothing_of(ring_body={"compliance": 0.0})

    def test_any_number_of_ranks_and_a_swept_compliance_give_the_same_bytes(self):
        content = in_ring_body(scene)
        del content["ring_body"]["compliance"]
        content["grid"]["/ring_body/compliance"] = [0.0, 1e-5, 1e-4]
        content["grid"]["damping_ratio"] = 0.1
        whole = self.fill(None, content, "whole.h5")
        self.assertEqual(departures(whole), [])
        self.assert_same_bytes(whole, self.fill(3, content, "three.h5"))
        with h5py.File(whole, "r") as file:
            ring = np.abs(np.nan_to_num(file["final_state_ring_body"][...].reshape(3, -1))).max(axis=1)
        self.assertEqual(ring[0], 0.0)
        self.assertGreater(ring[2], 0.0)

    def test_a_killed_job_goes_on_with_the_ring_moving_to_the_same_bytes(self):
        self.assert_survives_a_kill(in_ring_body(long_scene, transient_revolutions=60))


if __name__ == "__main__":
    unittest.main()
