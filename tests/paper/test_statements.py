"""Verdicts on P1 to P8, P12, P13, P21 and P24, on atlases that show what the paper says, and on such that do not."""
import unittest

from synthetic_lines import (AT_THIRDS, CHAOS, NOTHING_HAPPENS, ROOT, SCENE, JudgementTest, Piece, SyntheticAtlas,
                             four_regions, line_of, on_default, on_rig, unknown_line)

from paper import statements  # noqa: E402
from paper.judgement import judge  # noqa: E402
from paper.line import MERGED, Line, Region  # noqa: E402
from paper.rotors import DEFAULT, RIG  # noqa: E402
from paper.verdict import Finding, verdict_of  # noqa: E402
from rubatlas.atlas_file import AtlasError  # noqa: E402


def papers(end_of_2=0.55, end_of_3=0.66, region_1=(1, 2, 2, 1), **fields):
    """The paper's picture in the sense of P2b, with a doubling right at 2/3."""
    pieces = [Piece(1 / 3, region_1, 1e-4, 1), Piece(end_of_2, (CHAOS,) * 4 + (3,), 1e-2, 2),
              Piece(end_of_3, (1,), 5e-3, 3), Piece(0.67, (2,), 5e-3, 3), Piece(0.95, (CHAOS,), 2e-2, 4)]
    return line_of(pieces, AT_THIRDS, doublings=[(2 / 3, 1)], **fields)


def with_a_stretch(force=None, displacement=(1e-3, 9e-3)):
    """The paper's picture in the sense of P2a: periodic motion beyond 1/3, until region 2."""
    pieces = four_regions()
    pieces.insert(1, Piece(0.44, (1,), displacement))
    line = line_of(pieces, AT_THIRDS)
    return line if force is None else Line(**{**vars(line), "rows": {"max_contact_force": force * line.speed}.get})


def merged(line):
    """The line with its region 4 as a part of region 2."""
    return Line(**{**vars(line), "regions": [*line.regions[:3], Region(MERGED)]})


def joined():
    """Chaos from 1/3 on."""
    return merged(line_of([Piece(1 / 3, (1,), 1e-4, 1), Piece(0.95, (CHAOS,), 1e-2, 2)], (1 / 3, None)))


def calm():
    return line_of([Piece(1 / 3, (1,), 1e-4, 1), Piece(0.95, (1,), 1e-3, 3)], (1 / 3, None))


class OneLine(JudgementTest):
    def test_one_to_four_agree_with_the_papers_picture(self):
        self.expect(on_default().add(papers()), P1a="agrees", P1b="agrees", P2b="agrees", P3="agrees", P4="agrees")
        self.expect(on_default().add(papers(region_1=(1,))), P1b="partly")

    def test_one_to_four_disagree_where_nothing_happens(self):
        self.expect(on_default().add(line_of(NOTHING_HAPPENS)), P1a="disagrees", P1b="disagrees", P2a="disagrees",
                    P2b="disagrees", P3="disagrees", P4="disagrees")

    def test_they_are_not_covered_where_no_point_is_done(self):
        self.expect(on_default().add(unknown_line()), P1a="not covered", P2a="not covered", P2b="not covered",
                    P3="not covered", P4="not covered")

    def test_a_region_1_that_is_chaotic_or_large_is_found(self):
        self.expect(on_default().add(papers(region_1=(1, 1, CHAOS))), P1a="partly")
        pieces = four_regions(region_1=Piece(1 / 3, (1,), 5e-3, 1))
        self.expect(on_default().add(line_of(pieces, AT_THIRDS)), P1b="disagrees")

    def test_periodic_motion_that_goes_on_agrees_with_2a_and_not_with_2b(self):
        atlas = on_default().add(with_a_stretch(force=10.0))
        self.expect(atlas, P2a="agrees", P2b="partly")
        self.assertIs(self.holds(atlas, "P2b", "chaos begins at 1/3"), False)
        self.assertIs(self.holds(atlas, "P2b", "the jump into region 2 is sudden"), True)

    def test_chaos_right_at_a_third_agrees_with_2b_and_not_with_2a(self):
        atlas = on_default().add(papers())
        self.assertIs(self.holds(atlas, "P2a", "periodic motion goes on beyond 1/3"), False)
        self.expect(atlas, P2b="agrees")

    def test_force_and_displacement_that_fall_up_to_region_2_are_found(self):
        atlas = on_default().add(with_a_stretch(force=-1.0, displacement=(9e-3, 1e-3)))
        self.assertIs(self.holds(atlas, "P2a", "displacement grows up to region 2"), False)
        self.assertIs(self.holds(atlas, "P2a", "force grows up to region 2"), False)
        self.assertIsNone(self.holds(on_default().add(with_a_stretch()), "P2a", "force grows up to region 2"))

    def test_motions_that_alternate_below_chaos_are_no_sudden_jump(self):
        pieces = four_regions()
        pieces.insert(1, Piece(0.36, (1, CHAOS), 5e-3))
        atlas = on_default().add(line_of(pieces, AT_THIRDS))
        self.assertIs(self.holds(atlas, "P2b", "the jump into region 2 is sudden"), False)

    def test_a_doubling_a_little_beyond_two_thirds_is_at_it_and_not_exactly_at_it(self):
        line = papers()
        atlas = on_default().add(Line(**{**vars(line), "doublings": [(0.684, 1)]}))
        self.assertIs(self.holds(atlas, "P4", "a period doubles at 2/3"), True)
        self.assertIs(self.holds(atlas, "P4", "it does so at exactly 2/3"), False)
        self.expect(on_default().add(Line(**{**vars(line), "doublings": []})), P4="partly")

    def test_periodic_regions_are_where_to_operate_where_they_move_less(self):
        self.expect(on_default().add(papers()), P24="agrees")
        pieces = four_regions(region_2=Piece(0.55, (CHAOS,), 1e-5, 2), region_4=Piece(0.95, (CHAOS,), 1e-5, 4))
        self.expect(on_default().add(line_of(pieces, AT_THIRDS)), P24="disagrees")


class AlongParameters(JudgementTest):
    def test_five_agrees_when_low_damping_widens_two_shortens_three_and_stirs_one(self):
        atlas = on_default().add(papers(0.60, 0.67, (1, 1, 1, CHAOS)), damping_ratio=0.05).add(papers(0.5, 0.67))
        self.expect(atlas, P5a="agrees", P5b="agrees", P5c="agrees", P6="not covered")

    def test_five_disagrees_when_low_damping_does_the_opposite_without_region_2(self):
        without = [Piece(1 / 3, (1,), 1e-4, 1), Piece(0.67, (1,), 5e-3, 3), Piece(0.95, (CHAOS,), 2e-2, 4)]
        atlas = on_default().add(line_of(without, AT_THIRDS), damping_ratio=0.05).add(papers(0.5, 0.67))
        self.expect(atlas, P5a="disagrees", P5b="disagrees", P5c="disagrees")

    def test_six_agrees_when_high_damping_ends_the_chaos_that_was_there(self):
        self.expect(on_default().add(papers()).add(calm(), damping_ratio=0.3), P6="agrees")
        self.expect(on_default().add(papers()).add(papers(), damping_ratio=0.3), P6="disagrees")
        self.expect(on_default().add(calm()).add(calm(), damping_ratio=0.3), P6="disagrees")

    def test_seven_agrees_when_chaos_is_in_region_1_for_moderate_friction_only(self):
        atlas = on_default().add(papers(region_1=(1,)), friction=0.0)
        atlas.add(papers(region_1=(1, 1, 1, CHAOS))).add(papers(region_1=(1,)), friction=0.5)
        self.expect(atlas, P7="agrees")

    def test_seven_disagrees_when_friction_turns_the_picture_over(self):
        stirred = line_of([Piece(1 / 3, (1, CHAOS), 1e-4, 1), Piece(0.95, (1,), 1e-3, 3)], (1 / 3, None))
        self.expect(on_default().add(stirred, friction=0.0).add(papers(region_1=(1,))), P7="disagrees")

    def test_eight_agrees_when_unbalance_joins_the_regions(self):
        atlas = on_default().add(papers()).add(papers(), unbalance=1e-5).add(joined(), unbalance=1e-4)
        self.expect(atlas, P8a="agrees", P8b="agrees", P8c="agrees", P8d="agrees")

    def test_eight_disagrees_where_nothing_changes_and_no_trigger_is_there(self):
        atlas = on_default().add(line_of(NOTHING_HAPPENS)).add(line_of(NOTHING_HAPPENS), unbalance=1e-5)
        self.expect(atlas, P8a="disagrees", P8b="disagrees", P8c="disagrees", P8d="disagrees")

    def test_eight_says_when_the_regions_join_only_beyond_the_papers_range(self):
        atlas = on_default().add(papers()).add(papers(), unbalance=1e-4).add(joined(), unbalance=1e-3)
        self.expect(atlas, P8b="disagrees", P8c="disagrees")
        self.assertEqual(self.judged(atlas, "P8c")[0].findings[1].evidence,
                         "regions 2, 3 and 4 merged: from me = 0.001 kg m")

    def test_they_are_not_covered_by_a_single_line(self):
        self.expect(on_default().add(papers()), P5a="not covered", P6="not covered", P7="not covered",
                    P8a="not covered", P13="not covered", P21="not covered")

    def test_twelve_is_about_another_number_of_blades_at_a_scaled_speed(self):
        five = {**SCENE, "blades": {**SCENE["blades"], "count": 5}}
        pieces = [piece._replace(to=piece.to * 3 / 5) for piece in four_regions()]
        line = line_of(pieces, (1 / 5, 2 / 5), start=0.03, blades=5)
        atlas = SyntheticAtlas(five, ()).add(line)
        self.expect(atlas, P12="agrees", P1a="not covered")
        self.expect(SyntheticAtlas(five, ()).add(line_of(NOTHING_HAPPENS, blades=5)), P12="disagrees")
        self.expect(on_default().add(papers()), P12="not covered")

    def test_thirteen_is_about_every_stiffness_of_an_elastic_ring(self):
        ring = {"contact": {"law": "elastic_ring", "friction": 0.1}}

        def rings(soft):
            return on_default("ring_stiffness", **ring).add(soft, ring_stiffness=1e3).add(papers(), ring_stiffness=1e4)
        self.expect(rings(papers()), P13="agrees")
        self.expect(rings(calm()), P13="partly")
        self.expect(on_default("ring_stiffness", **ring).add(calm(), ring_stiffness=1e3)
                    .add(line_of(NOTHING_HAPPENS), ring_stiffness=1e4), P13="disagrees")

    def test_a_small_change_keeps_the_picture_and_changes_some_motion_or_the_paper_is_wrong(self):
        near = {"damping_ratio": 0.12}
        self.expect(on_default().add(papers()).add(papers(0.56), **near), P21="agrees")
        self.expect(on_default().add(papers()).add(calm(), **near), P21="partly")
        self.expect(on_default().add(papers()).add(papers(0.56), damping_ratio=0.2), P21="not covered")


class Rotors(JudgementTest):
    def test_a_rotor_that_is_none_of_the_papers_is_not_judged(self):
        other = on_default(rotor={**SCENE["rotor"], "misalignment": 0.02}).add(papers())
        with self.assertRaisesRegex(AtlasError, r"this is not the paper's default rotor: /rotor/misalignment is 0.02, "
                                                "not 0.01001; nor is it the paper's test rig"):
            self.judged(other, "P1a")
        loaded = on_default(side_load={"force": 1.0, "direction": 0.0}).add(papers())
        with self.assertRaisesRegex(AtlasError, "default rotor, which is without /side_load"):
            self.judged(loaded, "P1a")
        self.assertIn("test rig", self.judged(on_default().add(papers()), "P10")[0].findings[0].evidence)

    def test_lines_of_initial_states_are_not_judged(self):
        atlas = on_default("initial_x").add(papers(), initial_x=0.0).add(papers(), initial_x=1e-3)
        with self.assertRaisesRegex(AtlasError, "from one initial state"):
            self.judged(atlas, "P1a")

    def test_the_rotor_is_found_among_lines_of_others(self):
        atlas = on_default("rotor_misalignment")
        atlas.add(papers(), rotor_misalignment=0.01001).add(calm(), rotor_misalignment=0.0102)
        self.expect(atlas, P3="agrees")
        others = on_default("rotor_misalignment")
        others.add(papers(), rotor_misalignment=0.0101).add(papers(), rotor_misalignment=0.0102)
        self.expect(others, P3="not covered")

    def test_the_rig_is_that_of_scenes_that_round_its_numbers_as_the_paper_does(self):
        for frequency, same in ((189.94, True), (189.9616, True), (189.9, False), (190.0, False)):
            atlas = on_rig()
            atlas.scene["rotor"] = {**atlas.scene["rotor"], "natural_frequency": frequency}
            atlas.add(papers())
            self.assertEqual(RIG.difference(atlas) == "", same, frequency)
        self.assertIn("/rotor/mass", DEFAULT.difference(atlas))

    def test_an_effect_that_is_swept_from_nothing_leaves_the_line_without_it_to_the_rotor(self):
        ripple = {"speed_ripple": {"amplitude": 0.0, "order": 1, "phase": 0.0}}
        swept = on_rig("speed_ripple_amplitude", **ripple)
        swept.add(papers(), speed_ripple_amplitude=0.0).add(papers(), speed_ripple_amplitude=0.05)
        self.assertEqual(RIG.difference(swept), "")
        self.assertNotEqual(RIG.difference(on_rig("speed_ripple_phase", **ripple).add(papers())
                                           .add(papers(), speed_ripple_phase=1.0)), "")

    def test_what_the_paper_leaves_open_is_judged_at_each_value(self):
        atlas = on_default("direction", "unbalance_phase")
        for direction in (0.0, 1.0):
            for phase in (0.0, 1.0):
                for unbalance in (0.0, 1e-4):
                    atlas.add(joined() if unbalance and direction else papers(), direction=direction,
                              unbalance_phase=phase, unbalance=unbalance)
        found = self.judged(atlas, "P8c")
        self.assertEqual([one.setting for one in found],
                         ["direction = up, γ = 0", "direction = up, γ = 1", "direction = down, γ = 0",
                          "direction = down, γ = 1"])
        self.assertEqual([one.verdict for one in found], ["disagrees", "disagrees", "agrees", "agrees"])


class Table(unittest.TestCase):
    def test_the_page_shows_the_table_of_the_list(self):
        page = (ROOT / "analysis/paper/statements.md").read_text()
        shown = page.split("<!-- statements: begin -->\n")[1].split("<!-- statements: end -->")[0]
        self.assertEqual(shown, statements.table(), f"\nbetween the marks belongs:\n{statements.table()}")

    def test_every_number_has_its_statements_and_every_statement_is_judged(self):
        numbers = [int("".join(filter(str.isdigit, name.split("a")[0].rstrip("bcde")))) for name in
                   statements.STATEMENTS]
        self.assertEqual(sorted(set(numbers)), list(range(1, 25)))
        judged = {one.name for one in judge(on_default().add(papers()))}
        self.assertEqual(judged, set(statements.STATEMENTS))

    def test_a_verdict_is_what_the_covered_findings_say_together(self):
        yes, no, unknown = Finding(True, ""), Finding(False, ""), Finding(None, "")
        for findings, verdict in (([], "not covered"), ([unknown], "not covered"), ([yes, unknown], "agrees"),
                                  ([no, unknown], "disagrees"), ([yes, no], "partly")):
            self.assertEqual(verdict_of(findings), verdict)


if __name__ == "__main__":
    unittest.main()
