"""Verdicts on P9, P15 to P20, P22 and P23: the test rig along its parameters."""
import unittest

import numpy as np
from synthetic_lines import (AT_THIRDS, CHAOS, NOTHING_HAPPENS, RIG_SCENE, JudgementTest, Piece, four_regions, line_of,
                             on_default, on_rig)

from paper.line import Line

THIN, THICK = 0.3e-3, 0.5e-3


def whole():
    return line_of(four_regions(), AT_THIRDS)


def rises_without_chaos():
    return line_of([Piece(1 / 3, (1,), 1e-5, 1), Piece(2 / 3, (1,), 2e-4, 3), Piece(0.95, (1,), 6e-4)], AT_THIRDS)


def nothing():
    return line_of(NOTHING_HAPPENS)


def with_chaos_in_3():
    """The whole picture, but for chaos at 0.55 to 0.58 within region 3."""
    pieces = four_regions()
    pieces.insert(2, Piece(0.58, (CHAOS,), 5e-3, 3))
    return line_of(pieces, AT_THIRDS)


def with_rows(line, **largest):
    rows = {name: np.full(line.speed.size, value) for name, value in largest.items()}
    return Line(**{**vars(line), "rows": rows.get})


def in_contact(share):
    line = whole()
    return Line(**{**vars(line), "contact": np.where(np.arange(901) < 901 * share, 2, 1).astype("u1")})


class ThinBlades(JudgementTest):
    def test_nine_agrees_when_thin_blades_lose_the_chaos_and_keep_the_rises(self):
        atlas = on_rig().add(rises_without_chaos(), thickness=0.2e-3).add(rises_without_chaos(), thickness=THIN)
        self.expect(atlas.add(whole()), P9a="agrees", P9b="agrees")

    def test_nine_disagrees_when_thin_blades_keep_the_chaos_that_thick_ones_have_not(self):
        chaotic = line_of(four_regions())
        self.expect(on_rig().add(chaotic, thickness=0.2e-3).add(nothing()), P9a="disagrees", P9b="disagrees")

    def test_nine_does_not_count_blades_of_exactly_the_limit_as_thin_nor_rigid_ones(self):
        self.expect(on_rig().add(whole(), thickness=0.4e-3).add(whole()), P9a="not covered", P9b="not covered")
        rigid = on_rig(contact={"law": "elastic_ring", "friction": 0.1})
        self.expect(rigid.add(rises_without_chaos(), thickness=0.2e-3).add(whole()), P9a="not covered")

    @staticmethod
    def clearances(changed):
        """Lines over misalignment, radius and thickness; `changed` says where the picture is another."""
        atlas = on_rig("rotor_misalignment", "ring_radius")
        for misalignment in (0.36e-3, 0.51e-3):
            for radius in (62.5e-3, 62.65e-3):
                for thickness in (THIN, THICK):
                    line = rises_without_chaos() if changed(misalignment, radius, thickness) else whole()
                    atlas.add(line, rotor_misalignment=misalignment, ring_radius=radius, thickness=thickness)
        return atlas

    def test_fifteen_agrees_when_only_thin_blades_feel_clearance_and_misalignment(self):
        atlas = self.clearances(lambda misalignment, radius, thickness: thickness < 0.4e-3 and misalignment > 0.4e-3)
        self.expect(atlas, P15a="agrees", P15b="agrees")

    def test_fifteen_disagrees_when_only_thick_blades_feel_them(self):
        atlas = self.clearances(lambda misalignment, radius, thickness: thickness > 0.4e-3 and misalignment > 0.4e-3)
        self.expect(atlas, P15a="disagrees", P15b="disagrees")

    def test_fifteen_leaves_out_rotors_that_do_not_reach_the_ring(self):
        atlas = on_rig("rotor_misalignment")
        for misalignment in (0.31e-3, 0.36e-3, 0.41e-3):  # the clearance is 0.35 mm
            for thickness in (THIN, THICK):
                line = nothing() if misalignment < 0.35e-3 else whole()
                atlas.add(line, rotor_misalignment=misalignment, thickness=thickness)
        self.assertIs(self.holds(atlas, "P15a", "h = 0.5 mm: misalignment does not matter"), True)
        self.assertIs(self.holds(atlas, "P15b", "h < 0.4 mm: misalignment (first contact) matters"), False)

    def test_fifteen_compares_clearances_at_the_same_reach_into_the_ring(self):
        atlas = self.clearances(lambda misalignment, radius, thickness: misalignment < 0.4e-3 and radius > 62.6e-3)
        self.expect(atlas, P15a="agrees")

    def test_fifteen_asks_whether_damping_matters_to_thin_blades(self):
        def damped(line):
            return on_rig().add(whole(), thickness=THIN).add(line, thickness=THIN, damping_ratio=0.15)
        claim = "h < 0.4 mm: damping matters"
        self.assertIs(self.holds(damped(nothing()), "P15b", claim), True)
        self.assertIs(self.holds(damped(whole()), "P15b", claim), False)

    def test_twenty_is_about_force_and_strain_of_blades_of_1_mm(self):
        def blades(strain, force):
            own = with_rows(whole(), max_root_strain=1e-3, max_contact_force=10.0)
            return on_rig().add(own).add(with_rows(whole(), max_root_strain=strain, max_contact_force=force),
                                         thickness=1e-3)
        self.expect(blades(2.1e-3, 15.0), P20="agrees")
        self.expect(blades(1e-3, 14.0), P20="disagrees")
        self.expect(on_rig().add(whole()).add(whole(), thickness=1e-3), P20="not covered")

    def test_sixteen_needs_the_blade_and_no_motion(self):
        atlas = on_rig().add(nothing(), friction=0.2)
        found = self.judged(atlas, "P16")[0]
        self.assertEqual(found.verdict, "agrees")
        self.assertEqual(found.findings[0].evidence, "Euler load 42.03 N")
        # Δ = μ F L³/3EI (1 + F/Fe), 2.10 N at μ = 0.2 (beam-column to first order): 0.346 mm.
        self.assertIn("0.346 mm (μ = 0.2)", found.findings[2].evidence)
        swept = on_rig("blades_length").add(nothing(), blades_length=0.03).add(nothing(), blades_length=0.04)
        self.assertEqual(self.judged(swept, "P16")[0].findings[0].evidence, "Euler load 42.03 N")
        self.assertIsNone(self.judged(on_rig().add(nothing(), friction=0.0), "P16")[0].findings[-1].holds)
        other = {**RIG_SCENE["blades"], "youngs_modulus": 205.6e9}
        self.assertIn("41.94 N", self.judged(on_rig(blades=other).add(nothing()), "P16")[0].findings[0].evidence)


class Explanations(JudgementTest):
    def test_seventeen_agrees_when_unbalance_alone_makes_chaos_in_region_3(self):
        self.expect(on_rig().add(whole()).add(with_chaos_in_3(), unbalance=1e-5), P17="agrees")

    def test_seventeen_disagrees_when_the_chaos_is_there_without_unbalance_or_never(self):
        self.expect(on_rig().add(with_chaos_in_3()).add(with_chaos_in_3(), unbalance=1e-5), P17="disagrees")
        found = self.judged(on_rig().add(whole()).add(whole(), unbalance=1e-5), "P17")[0]
        self.assertEqual([finding.holds for finding in found.findings], [True, False, False])
        self.expect(on_rig().add(whole()), P17="not covered")

    def test_eighteen_agrees_when_repetitions_differ_in_region_3_alone(self):
        spread = {"unequal_blades": {"length_spread": 0.0, "seed": 1}}

        def repetitions(other):
            return on_rig("unequal_blades_length_spread", **spread).add(whole()).add(
                other, unequal_blades_length_spread=5e-5)
        self.expect(repetitions(with_chaos_in_3()), P18="agrees")
        self.assertIs(self.holds(repetitions(whole()), "P18", "region 3 differs"), False)
        self.assertIs(self.holds(repetitions(nothing()), "P18", "region 2 stays as it is"), False)
        self.expect(on_rig().add(whole()), P18="not covered")
        # Blades that do not reach the ring from rest repeat nothing.
        worn = on_rig("blades_length").add(whole(), blades_length=0.04).add(nothing(), blades_length=0.0399)
        self.expect(worn, P18="not covered", P21="not covered")

    def test_nineteen_agrees_when_worn_blades_touch_with_an_unbalance_alone(self):
        def worn(without, with_unbalance):
            return on_rig("blades_length").add(in_contact(without), blades_length=0.0399).add(
                in_contact(with_unbalance), blades_length=0.0399, unbalance=1e-5)
        self.expect(worn(0.0, 0.3), P19="agrees")
        self.expect(worn(0.1, 0.0), P19="disagrees")
        self.expect(worn(0.1, 0.3), P19="partly")
        self.expect(on_rig("blades_length").add(in_contact(0.1), blades_length=0.0398), P19="not covered")

    def test_the_picture_that_stays_over_friction_and_a_wandering_speed_agrees(self):
        ripple = {"speed_ripple": {"amplitude": 0.0, "order": 1}}

        def rigs(other):
            return on_rig("speed_ripple_amplitude", **ripple).add(whole()).add(other, friction=0.2).add(
                other, speed_ripple_amplitude=0.1)
        self.expect(rigs(whole()), P22="agrees", P23="agrees")
        self.expect(rigs(nothing()), P22="disagrees", P23="disagrees")
        damped = on_rig().add(whole(), friction=0.2).add(nothing(), friction=0.2, damping_ratio=0.1)
        self.assertIs(self.holds(damped, "P22", "one picture for ζ up to 0.15"), False)
        self.expect(on_rig().add(whole()), P22="not covered", P23="not covered")

    def test_the_rig_is_judged_once_for_every_friction_and_mass_that_its_grid_has(self):
        atlas = on_rig("rotor_mass")
        for mass in (0.3, 0.5):
            for friction in (0.1, 0.2):
                atlas.add(whole() if friction > 0.15 else nothing(), rotor_mass=mass, friction=friction)
        found = self.judged(atlas, "P10")
        self.assertEqual([one.setting for one in found], ["m = 0.3, μ = 0.1", "m = 0.3, μ = 0.2", "m = 0.5, μ = 0.1",
                                                          "m = 0.5, μ = 0.2"])
        self.assertEqual([one.verdict for one in found][:2], ["partly", "agrees"])
        self.expect(on_default().add(whole()), P17="not covered")


if __name__ == "__main__":
    unittest.main()
