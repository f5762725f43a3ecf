"""The package's pictures of an atlas and of its parts."""
import unittest

import matplotlib
import matplotlib.pyplot as plt
import numpy as np

from package_test import TINY, WithFolder

import rubatlas


class AtlasPlots(WithFolder):
    def setUp(self):
        super().setUp()
        self.atlas = rubatlas.open(TINY / "atlas.h5", maps=TINY / "maps.h5")

    def test_every_picture_is_drawn_into_the_axes_that_are_given_and_into_its_own(self):
        plots = {"bifurcation": {}, "waterfall": {}, "displacement": {}, "map": {}, "margin": {},
                 "spectrum": {"speed_ratio": 0.6},
                 "blade": {}, "orbit": {"speed_ratio": 0.3}}
        for name, arguments in plots.items():
            with self.subTest(name=name):
                figure, own = plt.subplots()
                drawn = getattr(self.atlas.plot, name)(ax=own, **arguments)
                self.assertIs(drawn, own)
                self.assertTrue(drawn.lines or drawn.images or drawn.collections)
                self.assertRegex(f"{drawn.get_xlabel()} {drawn.get_ylabel()}", r"\[.+\]")
                self.assertIsNot(getattr(self.atlas.plot, name)(**arguments).figure, figure)

    def test_a_picture_of_a_selection_is_that_of_its_line(self):
        drawn = self.atlas.sel(damping_ratio=0.2).plot.bifurcation(component="y").lines[0].get_ydata()
        np.testing.assert_array_equal(drawn,
                                      1e3 * self.atlas.sel(damping_ratio=0.2)["poincare"].values[:, :, 1].ravel())

    def test_points_that_are_not_chosen_stay_blank(self):
        chosen = self.atlas.sel(damping_ratio=0.1, speed_ratio=slice(0.3, 0.6)).where("max_displacement > 2e-3")
        panel = chosen.plot.displacement()
        speed, shown = panel.lines[0].get_data()
        expected = np.isin(speed, [point["speed_ratio"] for point in chosen.points()])
        self.assertTrue(0 < expected.sum() < len(speed))
        np.testing.assert_array_equal(np.isfinite(shown), expected)
        np.testing.assert_allclose(panel.get_xlim(), [0.3, 0.6], atol=0.02)
        for quantity in ("max_displacement", "class"):
            rows = self.atlas.sel(damping_ratio=[0.05, 0.2]).plot.map(quantity=quantity)
            self.assertEqual([tick.get_text() for tick in rows.get_yticklabels()], ["0.05", "0.2"])

    def test_a_line_that_is_not_selected_is_refused_rather_than_drawn_blank(self):
        with self.assertRaisesRegex(rubatlas.AtlasError, "damping_ratio 0.1: this selection has 0.2 alone"):
            self.atlas.sel(damping_ratio=0.2).plot.bifurcation(damping_ratio=0.1)

    def test_classes_are_drawn_as_a_map_too(self):
        self.assertEqual(self.atlas.plot.map(quantity="class").get_title(loc="left"), "Class of motion, in revolutions")
        with self.assertRaisesRegex(rubatlas.AtlasError, "needs the atlas' maps"):
            rubatlas.open(TINY / "atlas.h5").plot.margin()

    def test_what_a_map_cannot_draw_is_refused_for_what_it_is(self):
        for atlas, quantity in ((self.atlas, "margin"), (self.atlas, "margin_damping_ratio"), (self.atlas, "contact"),
                                (rubatlas.open(TINY / "atlas.h5"), "margin")):
            with self.assertRaisesRegex(rubatlas.AtlasError, f"{quantity}: of the maps .* plot.margin the margins"):
                atlas.plot.map(quantity=quantity)
        with self.assertRaisesRegex(rubatlas.AtlasError, "name it among the scene's observables"):
            self.atlas.plot.map(quantity="lyapunov")
        with self.assertRaisesRegex(rubatlas.AtlasError, "'max_displacement': no axes of matplotlib"):
            self.atlas.plot.map("max_displacement")

    def test_an_axis_in_rpm_is_in_pictures_of_our_own_alone(self):
        self.assertEqual(len(self.atlas.plot.displacement().child_axes), 1)
        own = plt.subplots()[1]
        self.assertEqual(len(self.atlas.plot.displacement(ax=own).child_axes), 0)

    def test_pictures_leave_the_callers_settings_alone(self):
        before = dict(matplotlib.rcParams)
        self.atlas.plot.displacement()
        self.assertEqual(dict(matplotlib.rcParams), before)


if __name__ == "__main__":
    unittest.main()
