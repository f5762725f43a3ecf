"""Verdicts on P10 and P14: the test rig as computed and as measured."""
import unittest

from synthetic_lines import CHAOS, NOTHING_HAPPENS, Piece, line_of, unknown_line

from paper import rig
from paper.verdict import verdict_of


def as_measured(**changes):
    """What the rig showed; a name of a piece with another one in its place."""
    pieces = {"low": Piece(0.17, (1,), 1e-5, 1), "burst": Piece(0.192, (CHAOS,), 2e-5, 1),
              "region_1": Piece(0.343, (1,), 3e-5, 1), "region_2": Piece(0.55, (CHAOS,), (9e-4, 3e-4), 2),
              "chaos_in_3": Piece(0.58, (CHAOS,), 4e-4, 3), "region_3": Piece(0.65, (1,), 4e-4, 3),
              "region_4": Piece(0.80, (CHAOS,), (8e-4, 3e-3), 4), "end": Piece(0.95, (CHAOS,), 3e-3)}
    return line_of([changes.get(name, piece) for name, piece in pieces.items()], (0.345, 0.65))


class RigStatements(unittest.TestCase):
    def expect(self, line, **verdicts):
        judged = rig.judge_line(line)
        for name, verdict in verdicts.items():
            self.assertEqual(verdict_of(judged[name]), verdict, (name, judged[name]))

    def holds(self, line, name, claim):
        found = [finding.holds for finding in rig.judge_line(line)[name] if finding.claim == claim]
        self.assertEqual(len(found), 1, claim)
        return found[0]

    def test_what_the_rig_showed_agrees_in_every_letter_but_one_of_two_that_contradict_each_other(self):
        self.expect(as_measured(), P10="agrees", P14a="agrees", P14b="agrees", P14c="agrees", P14d="agrees",
                    P14a1="disagrees")
        self.assertEqual(len(rig.judge_line(as_measured())["P14a"]), 9)

    def test_a_rotor_on_which_nothing_happens_shows_none_of_it(self):
        self.expect(line_of(NOTHING_HAPPENS), P14b="disagrees", P14c="disagrees", P14d="disagrees", P14a1="agrees",
                    P14a2="disagrees")

    def test_nothing_is_covered_where_no_point_is_done(self):
        judged = rig.judge_line(unknown_line())
        self.assertEqual({verdict_of(findings) for findings in judged.values()}, {"not covered"}, judged)

    def test_ten_disagrees_where_period_and_chaos_are_exchanged(self):
        self.expect(line_of([Piece(0.35, (CHAOS,), 1e-5), Piece(0.55, (1,), 1e-4), Piece(0.65, (CHAOS,), 1e-4),
                             Piece(0.95, (1,), 1e-4)]), P10="disagrees")

    def test_ten_is_judged_on_the_motions_around_a_speed_and_not_on_one_point(self):
        line = as_measured()
        line.motion[abs(line.speed - 0.4).argmin()] = 2
        self.expect(line, P10="agrees")

    def test_fourteen_says_which_border_lies_elsewhere(self):
        late = as_measured(region_1=Piece(0.42, (1,), 3e-5, 1))
        self.assertIs(self.holds(late, "P14a", "region 2 begins at 0.350"), False)
        self.assertIs(self.holds(late, "P14a", "region 2 ends at 0.550"), True)
        self.expect(late, P14a="partly")

    def test_a_gradual_growth_is_no_instantaneous_step(self):
        gradual = as_measured(region_1=Piece(0.315, (1,), 3e-5, 1), region_2=Piece(0.55, (CHAOS,), 9e-4, 2))
        ramp = (gradual.speed > 0.315) & (gradual.speed < 0.375)
        gradual.displacement[ramp] = 3e-5 * 30.0 ** ((gradual.speed[ramp] - 0.315) / 0.06)
        self.assertIs(self.holds(gradual, "P14b", "the step there is instantaneous"), False)
        self.assertIs(self.holds(gradual, "P14b", "trigger 1 at 0.34-0.35"), True)

    def test_a_step_between_speeds_that_lie_far_apart_is_not_called_instantaneous(self):
        coarse = line_of([Piece(0.343, (1,), 3e-5, 1), Piece(0.95, (CHAOS,), 9e-4, 2)], (0.345, None), count=71)
        self.assertIsNone(self.holds(coarse, "P14b", "the step there is instantaneous"))

    def test_displacement_that_grows_along_region_2_and_falls_along_region_4_disagrees(self):
        other = as_measured(region_2=Piece(0.55, (CHAOS,), (3e-4, 9e-4), 2),
                            region_4=Piece(0.80, (CHAOS,), (3e-3, 8e-4), 4))
        self.expect(other, P14c="disagrees", P14d="partly")

    def test_the_probes_saturate_at_a_displacement_of_the_hub_that_is_twice_and_a_fifth_theirs(self):
        self.expect(as_measured(region_4=Piece(0.80, (CHAOS,), 1.59e-3, 4)), P14a2="agrees")
        self.expect(as_measured(region_4=Piece(0.80, (CHAOS,), 1.58e-3, 4)), P14a2="disagrees")


if __name__ == "__main__":
    unittest.main()
