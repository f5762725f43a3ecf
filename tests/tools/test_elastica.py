"""The elastica of the tools against reference values (60 digits) and against limits known in closed form."""
import json
import os
import pathlib
import sys
import unittest

import numpy as np

ROOT = pathlib.Path(os.environ["RUBATLAS_SOURCE_DIR"])
sys.path.insert(0, str(ROOT / "tools"))
from rubatlas import elastica  # noqa: E402

# A picture needs three digits; that the closed form is free of cancellation shows in nine.
RELATIVE = 1e-9
# rad; what straight lines between 4000 places leave.
ANGLE = 1e-6


def at_load(friction, load):
    """δ/L and Δ/L at one load F L²/EI, by bisection in the logarithm of κ − sin(β/2) along the rising curve."""
    low, high = -80.0, np.log(0.999 - np.sin(0.5 * np.arctan(friction)))
    for _ in range(200):
        middle = 0.5 * (low + high)
        if elastica.curve(friction, np.exp(middle))[0][0] < load:
            low = middle
        else:
            high = middle
    _, shortening, deflection = elastica.curve(friction, np.exp(0.5 * (low + high)))
    return shortening[0], deflection[0]


class ToolsElastica(unittest.TestCase):
    def test_agrees_with_the_reference_at_every_load(self):
        rows = json.loads((ROOT / "tests/reference/elastica.json").read_text())["rows"]
        self.assertGreater(len(rows), 50)
        for row in rows:
            with self.subTest(**row):
                shortening, deflection = at_load(row["mu"], row["f"])
                self.assertAlmostEqual(shortening / row["delta_L"], 1.0, delta=RELATIVE)
                self.assertAlmostEqual(deflection / row["Delta_L"], 1.0, delta=RELATIVE)

    def test_a_curve_from_the_tip_has_the_angle_of_the_force_at_the_hub(self):
        for row in json.loads((ROOT / "tests/reference/elastica.json").read_text())["rows"]:
            with self.subTest(**row):
                lean = np.arctan(row["mu"])
                tip, length = 2.0 * np.arcsin(row["kappa"]), np.sqrt(row["f"] / np.cos(lean))
                self.assertAlmostEqual(elastica.angles_from_tip([tip], [length])[0, 0], lean, delta=ANGLE)

    def test_a_column_without_friction_buckles_at_the_euler_load(self):
        load, shortening, _ = elastica.curve(0.0, [1e-6])
        self.assertAlmostEqual(load[0], np.pi**2 / 4, delta=1e-9)
        self.assertLess(shortening[0], 1e-11)

    def test_a_small_load_bends_like_a_linear_cantilever(self):
        friction, load = 0.2, 1e-6
        shortening, deflection = at_load(friction, load)
        self.assertAlmostEqual(deflection / (friction * load / 3.0), 1.0, delta=1e-5)
        self.assertAlmostEqual(shortening / (0.6 * deflection**2), 1.0, delta=1e-5)

    def test_the_drawn_curve_starts_at_zero_and_ends_at_the_limit(self):
        load, shortening, deflection = elastica.up_to_shortening(0.1, 0.5)
        self.assertEqual((load[0], shortening[0], deflection[0]), (0.0, 0.0, 0.0))
        self.assertTrue(np.all(np.diff(shortening) > 0) and np.all(np.diff(load) > 0))
        self.assertAlmostEqual(shortening[-1], 0.5, delta=0.005)

    def test_small_slopes_are_those_of_the_linear_equation_of_bending(self):
        for friction in (0.05, 0.3):
            load, shortening, deflection = elastica.up_to_shortening_with_small_slopes(friction, 0.5)
            self.assertEqual((load[0], shortening[0], deflection[0]), (0.0, 0.0, 0.0))
            self.assertAlmostEqual(shortening[-1], 0.5, delta=0.01)
            root, tip = np.sqrt(load[1:, np.newaxis]), deflection[1:, np.newaxis]
            x = np.linspace(0.0, 1.0, 2001)
            # w'' = λ² (Δ − w + μ (1 − x)), clamped at the hub, and w(1) = Δ
            bent = tip + friction * (1.0 - x) - (tip + friction) * np.cos(root * x) + friction / root * np.sin(root * x)
            np.testing.assert_allclose(bent[:, -1], deflection[1:], rtol=1e-9)
            slope = np.gradient(bent, x, axis=1, edge_order=2)
            half_square = 0.5 * slope**2
            np.testing.assert_allclose((0.5 * (half_square[:, 1:] + half_square[:, :-1])).mean(axis=1), shortening[1:],
                                       rtol=1e-4, atol=1e-9)

    def test_small_slopes_without_friction_are_those_of_a_column(self):
        load, shortening, deflection = elastica.up_to_shortening_with_small_slopes(0.0, 0.5)
        np.testing.assert_allclose(load[1:], elastica.EULER_LOAD, rtol=1e-12)
        np.testing.assert_allclose(shortening[1:], (np.pi / 4.0 * deflection[1:]) ** 2, rtol=1e-12)


if __name__ == "__main__":
    unittest.main()
