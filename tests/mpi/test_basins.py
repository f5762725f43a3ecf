"""A basin of attraction is an atlas: the initial state is an axis, and `analyse` finds what it leads to.

The default rotor has two motions just below its region 2, at speed ratio 0.438: one of period 1, which a shaft at rest
comes to, and one of period 11.
"""
import unittest

import h5py
import numpy as np

from atlas_contract import departures
from job import JobTest, scene

SPEED = 0.438
STARTS = [-0.005, 0.0, 0.005]  # m
PROTOCOL = {"transient_revolutions": 300, "sampled_revolutions": 60, "samples_per_revolution": 32}
OBSERVABLES = ["poincare", "max_displacement"]


def basin_scene(**grid):
    return scene(sweep="independent", protocol=PROTOCOL, observables=OBSERVABLES,
                 grid={"speed_ratio": [SPEED], "/initial/x": STARTS, **grid})


class BasinsOfAttraction(JobTest):
    def analysed(self, atlas):
        maps = self.directory / "maps.h5"
        ended = self.execute(None, "analyse", atlas, "-o", maps, "--overwrite")
        self.assertEqual(ended.returncode, 0, ended.stderr)
        return maps, " ".join(ended.stdout.split())

    def test_each_point_is_that_of_a_scene_that_starts_there(self):
        atlas = self.fill(2, basin_scene(**{"/initial/vy": [-0.002, 0.001]}))
        self.assertEqual(departures(atlas), [])
        with h5py.File(atlas) as file:
            self.assertEqual(file["status"].shape, (2, 3, 1, 1, 1, 1, 1))
            self.assertEqual(list(file["initial_x"]), STARTS)
            self.assertEqual(file["initial_x"].attrs["units"], "m")
            self.assertTrue((file["restarted"][...] == 1).all())
            for i, vy in enumerate((-0.002, 0.001)):
                for j, x in enumerate(STARTS):
                    content = basin_scene()
                    del content["grid"]["/initial/x"]
                    own = self.fill(None, {**content, "initial": {"x": x, "vy": vy}}, f"own{i}{j}.h5")
                    with h5py.File(own) as single:
                        for name in ("poincare", "max_displacement", "final_state"):
                            self.assertEqual(file[name][i, j].tobytes(), single[name][()].tobytes(), (name, i, j))

    def test_ranks_and_interruptions_leave_the_bytes_as_they_are(self):
        content = basin_scene(speed_ratio=[0.3, SPEED])
        alone = self.fill(None, content, "alone.h5")
        whole = alone.read_bytes()
        for ranks in (2, 3):
            self.assert_same_bytes(alone, self.fill(ranks, content, f"ranks{ranks}.h5"))
        with h5py.File(alone, "r+") as file:
            file["status"][1:] = 0
        again = self.execute(2, "run", self.directory / "scene.json", "-o", alone, "--resume", "--progress", "off")
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertEqual(alone.read_bytes(), whole)
        verified = self.execute(None, "verify", alone, "--recompute", "6")
        self.assertEqual(verified.returncode, 0, verified.stderr)

    def test_two_attractors_that_are_known_are_found_with_their_shares(self):
        maps, text = self.analysed(self.fill(2, basin_scene()))
        with h5py.File(maps) as file:
            classes, attractor = file["class"][...].ravel(), file["attractor"][...].ravel()
            self.assertEqual(list(classes), [11, 1, 1])
            self.assertEqual(list(attractor), [1, 2, 2])
            np.testing.assert_allclose(file["basins/share"], [1 / 3, 2 / 3], rtol=1e-15)
            np.testing.assert_allclose(file["basins/standard_error"], np.sqrt(2.0 / 27.0), rtol=1e-15)
            np.testing.assert_allclose(file["basins/max_displacement"], [11.4334e-3, 11.2410e-3], atol=5e-8)
        self.assertIn("attractor 1, period 11, from 33.3 % ± 27.2 %, up to 11.4 mm", text)

    def test_a_sweep_both_ways_says_where_the_two_differ(self):
        # Both begin at this start: upwards at a speed that has period 1 alone, downwards at the one where it leads to
        # period 11. From region 2 above, which is chaotic, rounding would decide to which motion the sweep comes.
        maps, text = self.analysed(self.fill(2, scene(
            sweep="both", protocol=PROTOCOL, observables=OBSERVABLES, initial={"x": STARTS[0]},
            grid={"speed_ratio": {"from": 0.434, "to": SPEED, "count": 3}})))
        with h5py.File(maps) as file:
            self.assertEqual(list(file["class"][0].ravel()), [1, 1, 1])
            self.assertEqual(list(file["hysteresis/from"]), [SPEED])
            self.assertEqual(list(file["hysteresis/up"]), [1])
            self.assertEqual(list(file["hysteresis/down"]), [11])
        self.assertIn("Ω = 0.438: up period 1, down period 11.", text)

    def test_explain_and_orbit_know_the_axis(self):
        path = self.write_scene(basin_scene())
        self.assertRegex(self.execute(None, "explain", path).stdout, r"initial_x +3  -0.005, 0, 0.005 m")
        orbit = self.directory / "orbit.h5"
        ended = self.execute(None, "orbit", path, "--at", f"speed_ratio={SPEED},initial_x=0.005", "-o", orbit)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        with h5py.File(orbit) as file:
            self.assertEqual(list(file.attrs["start"]), [0.005, 0.0, 0.0, 0.0])

    def test_a_sweep_whose_points_go_on_from_each_other_refuses_the_axis(self):
        path = self.write_scene({**basin_scene(), "sweep": "up"})
        self.assert_refused(self.execute(2, "run", path, "-o", self.directory / "none.h5"), 2, "/grid/~1initial~1x: ",
                            'needs the sweep "independent"')


if __name__ == "__main__":
    unittest.main()
