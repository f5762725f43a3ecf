"""Verdicts on P11: the n× line, and what lies between the lines, on spectra that are prescribed."""
import unittest

import numpy as np
from synthetic_lines import CHAOS, Piece, four_regions, line_of

from paper import spectra
from paper.line import Line
from paper.verdict import verdict_of

ORDERS = np.arange(1201) / 100  # of a hundred revolutions up to order 12


def spectrum(passing=1.0, rotation=0.0, band=(), height=0.0):
    """Lines at orders 0, 1 and 3, and a band of one height from one order to another."""
    row = np.zeros(ORDERS.size)
    row[[0, 100, 300]] = 5.0, rotation, passing
    if band:
        row[(ORDERS >= band[0]) & (ORDERS <= band[1])] += height
    return row


def with_spectra(line, of_speed):
    rows = np.array([of_speed(speed) for speed in line.speed])
    return Line(**{**vars(line), "rows": {"spectrum": rows}.get})


def as_in_the_paper(speed):
    """A peak on the 3× line at 0.34, a band around 1.5× in region 2, one around the natural frequency in region 4."""
    passing = 1e-4 if speed <= 1 / 3 else 1e-2 * np.exp(-10.0 * (speed - 1 / 3))
    if 1 / 3 < speed <= 0.55:
        return spectrum(passing, band=(1.1, 1.9), height=1e-3)
    if speed > 2 / 3:
        return spectrum(passing, band=(1 / speed - 0.2, 1 / speed + 0.2), height=1e-3)
    return spectrum(passing)


class SpectraStatements(unittest.TestCase):
    def judged(self, of_speed, pieces=None):
        line = with_spectra(line_of(pieces or four_regions(), (1 / 3, 2 / 3)), of_speed)
        return {name: verdict_of(findings) for name, findings in spectra.judge_line(line, ORDERS).items()}

    def test_eleven_agrees_with_spectra_as_the_paper_has_them(self):
        self.assertEqual(self.judged(as_in_the_paper), {"P11a": "agrees", "P11b": "agrees", "P11c": "agrees"})

    def test_eleven_disagrees_where_the_spectrum_is_that_of_a_periodic_motion_at_every_speed(self):
        self.assertEqual(self.judged(lambda speed: spectrum(1e-3 * speed, rotation=1.0)),
                         {"P11a": "disagrees", "P11b": "disagrees", "P11c": "disagrees"})

    def test_white_noise_is_broad_and_has_its_centre_at_no_place_of_the_papers(self):
        noise = np.random.default_rng(1)
        verdicts = self.judged(lambda _: noise.rayleigh(1.0, ORDERS.size))
        self.assertEqual((verdicts["P11b"], verdicts["P11c"]), ("partly", "partly"))

    def test_a_doubled_period_is_not_broad_and_a_band_of_a_fifth_of_an_order_is(self):
        doubled = spectrum(band=(1.5, 1.5), height=1.0)
        band = spectrum(band=(1.4, 1.6), height=1.0)
        line = with_spectra(line_of([Piece(0.95, (2,), 1e-3)], count=2),
                            lambda speed: doubled if speed < 0.5 else band)
        signs, _ = spectra.signature_of(line, ORDERS)
        self.assertEqual(list(spectra.is_broad(signs)), [False, True])

    def test_regions_that_are_not_there_have_no_peak_and_nothing_broad(self):
        self.assertEqual(set(self.judged(as_in_the_paper, [Piece(0.95, (1,), 1e-4)]).values()), {"disagrees"})

    def test_an_atlas_without_spectra_covers_nothing(self):
        judged = spectra.judge_line(line_of(four_regions()), ORDERS)
        self.assertEqual({verdict_of(findings) for findings in judged.values()}, {"not covered"})
        short = spectra.judge_line(with_spectra(line_of(four_regions()), as_in_the_paper), ORDERS[:301])
        self.assertIn("no spectrum", short["P11a"][0].evidence)

    def test_the_1x_line_belongs_to_the_unbalance_where_it_is_there_with_it_alone(self):
        def line(unbalance, of_speed):
            return with_spectra(line_of(four_regions(), count=91, parameters={"unbalance": unbalance}), of_speed)
        without, with_line = spectrum(band=(0.6, 1.4), height=1e-3), spectrum(1.0, 0.1, (0.6, 1.4), 1e-3)
        balanced, unbalanced = line(0.0, lambda _: without), line(1e-5, lambda _: with_line)
        self.assertEqual(verdict_of(spectra.line_at_1([balanced, unbalanced], ORDERS)), "agrees")
        weak = line(1e-7, lambda _: without)
        self.assertEqual(verdict_of(spectra.line_at_1([balanced, weak, unbalanced], ORDERS)), "agrees")
        exchanged = [line(0.0, lambda _: with_line), line(1e-5, lambda _: without)]
        self.assertEqual(verdict_of(spectra.line_at_1(exchanged, ORDERS)), "disagrees")
        self.assertIsNone(spectra.line_at_1([balanced], ORDERS)[1].holds)

    def test_a_sign_that_stands_before_the_limit_is_passed_is_found_and_so_are_false_ones(self):
        def judged(announced, false=0.0, limit=0.44):
            signs = {"limit": 5e-4, "limit_speed_ratio": limit, "announced_speed_ratio": announced,
                     "passing_line_false": false, "broad_band_false": 0.0, "displacement_false": 3.0}
            return spectra.announced(line_of(four_regions(), signs=signs))
        self.assertEqual(verdict_of(judged(0.33)), "agrees")
        self.assertIn("25.0% of the speed earlier", judged(0.33)[0].evidence)
        self.assertEqual(verdict_of(judged(0.33, false=2.0)), "partly")
        self.assertEqual(verdict_of(judged(0.44, false=1.0)), "disagrees")
        self.assertIs(judged(np.nan)[0].holds, False)
        self.assertIsNone(judged(0.33, limit=np.nan)[0].holds)
        self.assertIsNone(spectra.announced(line_of(four_regions()))[0].holds)

    def test_a_broad_band_over_the_order_1_is_no_line(self):
        line = with_spectra(line_of([Piece(0.95, (CHAOS,), 1e-3)], count=2),
                            lambda _: spectrum(band=(0.6, 1.4), height=1.0))
        signs, rows = spectra.signature_of(line, ORDERS)
        self.assertFalse(spectra.has_line_at_1(ORDERS, rows, signs).any())

    def test_a_line_that_a_window_spreads_over_two_coarse_bins_still_stands(self):
        orders = np.arange(193) / 16  # of sixteen revolutions: two bins are 1/8 order
        row = np.where(np.abs(orders - 1.0) <= 0.125, 0.6, 0.0) + 0.4 * (orders == 1.0)
        line = with_spectra(line_of([Piece(0.95, (1,), 1e-3)], count=2), lambda _: row)
        signs, rows = spectra.signature_of(line, orders)
        self.assertTrue(spectra.has_line_at_1(orders, rows, signs).all())


if __name__ == "__main__":
    unittest.main()
