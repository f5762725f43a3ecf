"""The signs of rubbing blades in a spectrum, on spectra whose answers are known beforehand."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np
import xarray

ROOT = pathlib.Path(os.environ["RUBATLAS_SOURCE_DIR"])
sys.path.insert(0, str(ROOT / "tools"))
import rubatlas  # noqa: E402

TINY = pathlib.Path(os.environ["RUBATLAS_PROGRAM"]).parent / "tests/tiny_atlas"

SAMPLES = 64  # per revolution
REVOLUTIONS = 50


def spectrum(signal, window=None):
    """0-peak amplitudes of a record of whole revolutions over the order, as an atlas has them; with a window those that
    keep the height of a line."""
    window = np.ones(len(signal)) if window is None else window
    return np.arange(len(signal) // 2) / (len(signal) / SAMPLES), (
        2.0 * np.abs(np.fft.rfft(signal * window))[:len(signal) // 2] / window.sum())


def turns(revolutions=REVOLUTIONS):
    """Angles of the shaft [rad] of a record."""
    return 2.0 * np.pi * np.arange(int(SAMPLES * revolutions)) / SAMPLES


class SignatureOfASpectrum(unittest.TestCase):
    def test_a_pure_tone_at_the_blade_passing_is_a_line_with_nothing_between(self):
        found = rubatlas.signature(*spectrum(5.0 + 2.0 * np.cos(3.0 * turns())))
        self.assertAlmostEqual(found.passing, 2.0, delta=1e-12)
        self.assertLess(found.rotation, 1e-12)
        self.assertLess(found.between_share, 1e-24)

    def test_a_motion_of_period_two_lies_between_the_lines_without_being_broad(self):
        found = rubatlas.signature(*spectrum(np.cos(turns()) + 0.5 * np.cos(0.5 * turns()) + 0.1 * np.cos(
            1.5 * turns())))
        self.assertAlmostEqual(found.rotation, 1.0, delta=1e-12)
        self.assertAlmostEqual(found.subharmonic, 0.5, delta=1e-12)
        self.assertAlmostEqual(found.subharmonic_order, 0.5)
        self.assertAlmostEqual(found.between, np.hypot(0.5, 0.1), delta=1e-12)
        self.assertAlmostEqual(found.between_share, 0.26 / 1.26, delta=1e-12)
        self.assertAlmostEqual(found.centroid, (0.25 * 0.5 + 0.01 * 1.5) / 0.26, delta=1e-12)
        self.assertAlmostEqual(found.width, np.sqrt(0.25 * 0.01) / 0.26, delta=1e-12)
        self.assertLess(found.breadth, 0.01)
        self.assertLess(found.broad, 1e-12)

    def test_a_motion_of_period_sixteen_is_seen_in_a_record_that_resolves_it(self):
        found = rubatlas.signature(*spectrum(np.cos(3.0 * turns(160)) + 0.1 * np.cos(47.0 / 16.0 * turns(160))))
        self.assertAlmostEqual(found.subharmonic, 0.1, delta=1e-12)
        self.assertAlmostEqual(found.subharmonic_order, 47.0 / 16.0)

    def test_white_noise_fills_half_of_the_bins_and_lies_in_the_middle(self):
        noise = np.random.default_rng(20161).normal(size=(200, SAMPLES * REVOLUTIONS))
        orders = spectrum(noise[0])[0]
        found = rubatlas.signature(orders, [spectrum(row)[1] for row in noise])
        self.assertEqual(found.breadth.shape, (200,))
        # Of 200 spectra of 245 bins: what is expected, within some standard errors of the mean.
        inside = (orders > 0.05) & (orders <= 6.05) & (np.abs(orders - np.rint(orders)) > 0.0501)
        self.assertAlmostEqual(found.breadth.mean(), 0.5, delta=0.01)
        self.assertAlmostEqual(found.centroid.mean(), orders[inside].mean(), delta=0.03)
        self.assertAlmostEqual(found.width.mean(), orders[inside].std(), delta=0.03)
        self.assertAlmostEqual(found.between_share.mean(), inside.sum() / ((orders > 0.05) & (orders <= 6.05)).sum(),
                               delta=0.005)
        self.assertAlmostEqual((found.broad / found.between).mean(), 1.0, delta=0.01)

    def test_no_vibration_has_no_power_and_no_place(self):
        orders = spectrum(turns())[0]
        found = rubatlas.signature(orders, np.where(orders == 0.0, 3.0, 0.0))
        for values in (found.passing, found.rotation, found.subharmonic, found.between, found.between_share,
                       found.broad):
            self.assertEqual(values, 0.0)
        self.assertTrue(np.isnan([found.subharmonic_order, found.centroid, found.width, found.breadth]).all())

    def test_a_measured_record_with_a_window_and_no_whole_number_of_revolutions_has_the_same_lines(self):
        turned = turns(50.37)
        noise = 1e-3 * np.random.default_rng(7).normal(size=len(turned))
        orders, amplitudes = spectrum(2.0 * np.cos(3.0 * turned) + 0.4 * np.cos(0.5 * turned) + noise,
                                      np.hanning(len(turned)))
        found = rubatlas.signature(orders, amplitudes)
        # Hann's window loses at most 15 % of a line that stands in the middle between two bins.
        self.assertAlmostEqual(found.passing, 2.0, delta=0.3)
        self.assertAlmostEqual(found.subharmonic, 0.4, delta=0.06)
        self.assertAlmostEqual(found.subharmonic_order, 0.5, delta=orders[1])
        # The window widens every line to 1.5 bins of power, so that shares stay as they are.
        self.assertAlmostEqual(found.between_share, 0.04 / 1.04, delta=0.002)
        self.assertLess(found.breadth, 0.02)
        # Of the noise, 1e-3 √(2 · 3200/64 bins a revolution … ) is left: far below the lines.
        self.assertLess(found.broad, 2e-3)

    def test_what_leaks_from_a_line_through_the_window_is_no_broad_band(self):
        turned = turns(20.5)
        found = rubatlas.signature(*spectrum(np.cos(3.0 * turned), np.hanning(len(turned))))
        self.assertLess(found.between_share, 1e-3)

    def test_a_spectrum_that_is_not_known_has_no_signature_and_its_neighbour_keeps_its_own(self):
        orders, known = spectrum(np.cos(3.0 * turns()))
        found = rubatlas.signature(orders, [[np.full_like(known, np.nan), known]])
        for values in found:
            self.assertEqual(values.shape, (1, 2))
            self.assertTrue(np.isnan(values[0, 0]))
        self.assertAlmostEqual(found.passing[0, 1], 1.0, delta=1e-12)

    def test_other_numbers_of_blades_have_their_own_line(self):
        found = rubatlas.signature(*spectrum(np.cos(5.0 * turns()) + 0.5 * np.cos(3.0 * turns())), blades=5)
        self.assertAlmostEqual(found.passing, 1.0, delta=1e-12)

    def test_orders_that_cannot_be_read_are_refused_with_what_is_allowed(self):
        for orders, blades, words in (([0.0, 0.5, 1.0], 1, "in steps of at most 0.125"),
                                      (np.arange(100) / 10.0 * np.linspace(1.0, 2.0, 100), 3, "they ascend evenly"),
                                      (np.arange(20) / 10.0, 3, "not between the number of blades, 3, and"),
                                      ([[0.0, 0.1]], 3, "the orders are one row")):
            with self.subTest(words=words), self.assertRaisesRegex(ValueError, words):
                rubatlas.signature(orders, np.ones(np.shape(orders)[-1]), blades)


class SignatureOfAnAtlas(unittest.TestCase):
    def test_the_program_and_the_package_measure_the_same_heights(self):
        with h5py.File(TINY / "atlas.h5") as atlas, h5py.File(TINY / "maps.h5") as maps:
            done = atlas["status"][...] == 1
            self.assertGreater(done.sum(), 50)
            self.assertFalse(done.all())
            found = rubatlas.signature(atlas["order"][...], atlas["spectrum"][...][done])
            self.assertGreater(np.count_nonzero(found.broad > 1e-5), 5)  # some motions are aperiodic, others are not
            for name, values in (("passing_line", found.passing), ("broad_band", found.broad),
                                 ("subharmonic", found.subharmonic)):
                with self.subTest(name):
                    heights = maps["signs"][name][...]
                    np.testing.assert_allclose(heights[done], values, rtol=1e-12)
                    self.assertTrue(np.isnan(heights[~done]).all())

    def test_the_limit_is_passed_where_the_displacement_first_exceeds_it(self):
        table = xarray.open_dataset(TINY / "maps.h5", engine="h5netcdf", group="signature")
        with h5py.File(TINY / "atlas.h5") as atlas:
            np.testing.assert_array_equal(table["at_damping_ratio"], atlas["damping_ratio"][...])
            np.testing.assert_allclose(table["limit"], 0.5 * 0.01, rtol=1e-12)  # of the clearance
            beyond = (atlas["max_displacement"][0, 0, 0] > 0.005) | (atlas["status"][0, 0, 0] == 2)
            first = [atlas["speed_ratio"][line.argmax()] if line.any() else np.nan for line in beyond]
        np.testing.assert_array_equal(table["limit_speed_ratio"], first)

    def test_the_limit_has_a_unit_and_any_other_word_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            for limit, metres in (("2 mm", 2e-3), ("300 µm", 3e-4), ("0.25 clearances", 2.5e-3)):
                maps = pathlib.Path(folder) / "maps.h5"
                rubatlas.command("analyse", TINY / "atlas.h5", output=maps, limit=limit, overwrite=True)
                with h5py.File(maps) as file:
                    np.testing.assert_allclose(file["signature/limit"], metres, rtol=1e-12)
            allowed = "not a number above zero with its unit, m, mm, um, µm or clearances, such as \"0.5 mm\""
            with self.assertRaisesRegex(rubatlas.AtlasError, f"rubatlas: --limit 1 inch: {allowed}"):
                rubatlas.command("analyse", TINY / "atlas.h5", output=maps, limit="1 inch", overwrite=True)
        told = subprocess.run([os.environ["RUBATLAS_PROGRAM"], "analyse", "--help"], capture_output=True, text=True,
                              check=True).stdout
        self.assertRegex(told, "--limit .*a number with its unit, m, mm, um, µm or clearances, such as \"2 mm\"")


if __name__ == "__main__":
    unittest.main()
