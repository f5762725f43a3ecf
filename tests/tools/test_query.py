"""Conditions as text: what holds, what is refused, and with which words."""
import json
import os
import pathlib
import random
import sys
import unittest

import numpy as np

ROOT = pathlib.Path(os.environ["RUBATLAS_SOURCE_DIR"])
sys.path.insert(0, str(ROOT / "tools"))
from rubatlas.query import GRAMMAR, Limit, Name, QueryError, evaluate, parse, shown  # noqa: E402

CASES = json.loads((ROOT / "tests/explorer/query_cases.json").read_text(encoding="utf-8"))
SPEED = np.array([0.2, 0.3, 0.4, 0.5])
NAMES = {"speed_ratio": Name(SPEED), "max_displacement": Name(np.array([1e-3, np.nan, 6e-3, 9e-3])),
         "class": Name(np.array([1, 0, 255, 2]), flags={0: "none", 1: "period 1", 2: "period 2", 255: "aperiodic"})}


class Query(unittest.TestCase):
    def expect(self, condition, wanted):
        np.testing.assert_array_equal(evaluate(condition, NAMES), np.array(wanted, dtype=bool), condition)

    def test_comparisons_are_those_of_the_numbers(self):
        self.expect("max_displacement > 5e-3", [0, 0, 1, 1])
        self.expect("0.25 < speed_ratio <= 0.4", [0, 1, 1, 0])
        self.expect("2 * speed_ratio - 0.1 >= 1 - speed_ratio ** 2 / 1", SPEED * 2 - 0.1 >= 1 - SPEED**2)
        self.expect("-speed_ratio < -(0.3)", [0, 0, 1, 1])

    def test_words_are_compared_with_flags(self):
        self.expect("class == 'aperiodic'", [0, 0, 1, 0])
        self.expect('"period 2" != class', [1, 1, 1, 0])

    def test_a_motion_without_a_class_has_none_that_is_small(self):
        self.expect("class <= 2", [1, 0, 0, 1])
        self.expect("class == none", [0, 1, 0, 0])

    def test_conditions_are_joined_with_the_usual_precedence(self):
        self.expect("class == 'aperiodic' or class == 'period 2' and speed_ratio < 0.1", [0, 0, 1, 0])
        self.expect("not (class == 'aperiodic' or speed_ratio < 0.25)", [0, 1, 0, 1])

    def test_a_comparison_with_what_is_not_there_is_false_and_unequal_is_true(self):
        self.expect("max_displacement < 1", [1, 0, 1, 1])
        self.expect("max_displacement == max_displacement", [1, 0, 1, 1])
        self.expect("max_displacement != max_displacement", [0, 1, 0, 0])

    def test_it_is_the_grammar_of_the_explorer(self):
        names = {name: Name(np.array([np.nan if value is None else value for value in given["values"]]),
                            given.get("units"),
                            {int(number): word for number, word in given.get("flags", {}).items()} or None)
                 for name, given in CASES["names"].items()}
        sizes = {name: np.array(values) for name, values in CASES["sizes"].items()}
        units = GRAMMAR["sentences"]["unknown_unit"].format(found="", units=", ".join(GRAMMAR["units"]))
        for case in CASES["cases"]:
            query = case["query"]
            with self.subTest(query):
                if "holds" in case:
                    holds = np.broadcast_to(evaluate(query, names, sizes), len(case["holds"]))
                    np.testing.assert_array_equal(holds, np.array(case["holds"], dtype=bool))
                else:
                    with self.assertRaises(QueryError) as caught:
                        evaluate(query, names, sizes)
                    wanted = case["error"].replace(" is no unit; UNITS", units)
                    self.assertEqual(str(caught.exception), f"{query.strip()}: {wanted}" if query else wanted)
        for case in CASES["trees"]:
            self.assertEqual(parse(case["query"]), case["tree"])

    def test_every_unit_of_an_atlas_is_a_unit_of_the_grammar_and_has_a_name_in_refusals(self):
        for unit, rule in GRAMMAR["units"].items():
            self.assertIn(rule["of"], GRAMMAR["measures"], unit)
            self.assertTrue(rule["of"] == "speed" or rule["of"] == "-" or rule["of"] in GRAMMAR["units"], unit)

    def test_a_decimal_with_a_unit_is_the_number_that_a_scene_writes_without(self):
        for thickness in (0.9, 1.1, 0.7, 2.3):
            names = {"thickness": Name(np.array([float(f"{thickness}e-3")]), "m")}
            self.assertTrue(evaluate(f"thickness = {thickness} mm", names).all(), thickness)

    def test_a_limit_is_a_name_a_sign_and_a_number_in_a_unit(self):
        sizes = {"clearance": np.array([5e-4]), "radian_per_second": np.array([0.01])}
        for text, name, units, bound in (("max_displacement<=0.25 mm", "max_displacement", "m", 0.25e-3),
                                         ("max displacement ≤ 0.5 clearances", "max_displacement", "m", 0.25e-3),
                                         ("margin >= 3 rpm", "margin", "-", 0.01 * np.pi / 10),
                                         ("max_contact_force <= 2*3 kN", "max_contact_force", "N", 6000.0),
                                         ("max_displacement<=0.25", "max_displacement", "m", 0.25)):
            limit = Limit.read(text)
            self.assertEqual(limit.name, name)
            self.assertAlmostEqual(limit.bound(units, sizes), bound, delta=1e-15 * bound)
        for text, words in (("max_displacement<0.25", "not of the form NAME <= NUMBER or NAME >= NUMBER"),
                            ("0.25 >= max_displacement", "not of the form"), ("max_displacement", "not of the form"),
                            ("max_displacement<=2 N", "what stands after it is a force"),
                            ("max_displacement<=wide", "wide stands where a number is wanted"),
                            ("max_displacement<='wide'", "what stands after <= is a word, not a number")):
            with self.assertRaisesRegex(QueryError, f"^{text}: .*{words}"):
                Limit.read(text).bound("m", sizes)
        with self.assertRaisesRegex(QueryError, "differs between the lines"):
            Limit.read("max_displacement<=1 clearance").bound("m", {"clearance": np.array([1e-3, 2e-3])})

    def test_a_value_is_shown_in_the_units_of_its_reader(self):
        sizes = {"clearance": np.array([5e-4]), "radian_per_second": np.array([0.1])}
        self.assertEqual(shown(0.25, "m", sizes), "250 mm, 500 clearances")
        self.assertEqual(shown(0.25, "m", {"clearance": np.array([1e-3, 2e-3])}), "250 mm")
        self.assertEqual(shown(0.25, "m", {"clearance": np.array([0.0])}), "250 mm")
        self.assertEqual(shown(0.2 * np.pi, "speed", sizes), "0.628319, 60 rpm, 1 Hz")
        self.assertEqual((shown(200.0, "N", sizes), shown(2e-3, "-", sizes)), ("200 N", "0.002"))

    def test_precedence_and_chains_are_those_of_python(self):
        chance = random.Random(1)

        def value(depth):
            if depth == 0 or chance.random() < 0.2:
                return chance.choice(["1", "2", "3", "0.5", "speed_ratio"])
            inner = value(depth - 1)
            return chance.choice([f"{inner} {chance.choice('+-*/')} {value(depth - 1)}", f"-{inner}", f"+{inner}",
                                  f"({inner})", f"2 ** {inner}", f"-2 ** {inner}"])

        def condition(depth):
            if depth == 0 or chance.random() < 0.3:
                signs = chance.choices(["<", "<=", ">", ">=", "==", "!="], k=chance.randint(1, 3))
                return value(2) + "".join(f" {sign} {value(2)}" for sign in signs)
            inner = condition(depth - 1)
            return chance.choice([f"{inner} and {condition(depth - 1)}", f"{inner} or {condition(depth - 1)}",
                                  f"not {inner}", f"({inner})"])

        for _ in range(300):
            query = condition(3)
            with np.errstate(all="ignore"):
                wanted = [bool(eval(query, {"speed_ratio": speed})) for speed in SPEED]  # a query is Python, too
            np.testing.assert_array_equal(np.broadcast_to(evaluate(query, NAMES), len(SPEED)), wanted, query)

    def test_the_word_class_may_stand_in_quotes(self):
        with self.assertRaisesRegex(QueryError, "'class' is no value of class; the nearest is"):
            evaluate("class == 'class'", NAMES)

    def test_an_unknown_name_is_answered_with_the_nearest(self):
        with self.assertRaisesRegex(QueryError, "^max_displacment > 1: max_displacment is not in this atlas; "
                                    "the nearest name is max_displacement$"):
            evaluate("max_displacment > 1", NAMES)
        with self.assertRaisesRegex(QueryError, "'aperiodc' is no value of class; the nearest is 'aperiodic'$"):
            evaluate("class == 'aperiodc'", NAMES)

    def test_whatever_is_not_in_the_grammar_is_refused_and_not_executed(self):
        for text in (
                "", "speed_ratio", "speed_ratio >", "1 + 1", "'other'", "class < 'aperiodic'",
                "speed_ratio == 'aperiodic'", "__import__('os').system('true') == 0", "speed_ratio.real > 0",
                "[1][0] > 0", "(lambda: 1)() > 0", "speed_ratio in (1, 2)", "speed_ratio is 1", "speed_ratio > True",
                "speed_ratio & 1 > 0", "(x := 1) > 0", "f'{1}' == class", "speed_ratio > 1; 2", "('a' + 1) > 2",
                "speed_ratio > 1j", "(" * 300 + "1" + ")" * 300 + " > 0", "not " * 500 + "1 > 0",
                "not " * 5000 + "1 > 0", "class_ == 1 or speed > 0"):
            with self.subTest(text=text[:60]), self.assertRaises(QueryError) as caught:
                evaluate(text, NAMES)
            self.assertNotIn("\n", str(caught.exception))


if __name__ == "__main__":
    unittest.main()
