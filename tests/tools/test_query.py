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
from rubatlas.query import GRAMMAR, Name, QueryError, evaluate, parse  # noqa: E402

CASES = json.loads((ROOT / "tests/explorer/query_cases.json").read_text(encoding="utf-8"))
SPEED = np.array([0.2, 0.3, 0.4, 0.5])
NAMES = {"speed_ratio": Name(SPEED), "max_displacement": Name(np.array([1e-3, np.nan, 6e-3, 9e-3])),
         "class": Name(np.array([1, 0, 255, 2]), {0: "none", 1: "period 1", 2: "period 2", 255: "aperiodic"})}


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
        self.expect("class <= 2", [1, 1, 0, 1])

    def test_conditions_are_joined_with_the_usual_precedence(self):
        self.expect("class == 'aperiodic' or class == 'period 2' and speed_ratio < 0.1", [0, 0, 1, 0])
        self.expect("not (class == 'aperiodic' or speed_ratio < 0.25)", [0, 1, 0, 1])

    def test_a_comparison_with_what_is_not_there_is_false_and_unequal_is_true(self):
        self.expect("max_displacement < 1", [1, 0, 1, 1])
        self.expect("max_displacement == max_displacement", [1, 0, 1, 1])
        self.expect("max_displacement != max_displacement", [0, 1, 0, 0])

    def expect_cases(self, cases, grammar):
        names = {name: Name(np.array([np.nan if value is None else value for value in given["values"]]),
                            {int(number): word for number, word in given.get("flags", {}).items()} or None)
                 for name, given in CASES["names"].items()}
        for case in cases:
            query = case["query"]
            with self.subTest(query):
                if "holds" in case:
                    holds = np.broadcast_to(evaluate(query, names, grammar), len(case["holds"]))
                    np.testing.assert_array_equal(holds, np.array(case["holds"], dtype=bool))
                else:
                    with self.assertRaises(QueryError) as caught:
                        evaluate(query, names, grammar)
                    wanted = f"{query.strip()}: {case['error']}" if query else case["error"]
                    self.assertEqual(str(caught.exception), wanted)

    def test_it_is_the_grammar_of_the_explorer(self):
        self.expect_cases(CASES["cases"], GRAMMAR)
        for case in CASES["trees"]:
            self.assertEqual(parse(case["query"]), case["tree"])

    def test_units_and_synonyms_are_data_of_the_grammar(self):
        extension = CASES["extension"]
        grammar = {**GRAMMAR, **extension, "tokens": {**GRAMMAR["tokens"], **extension["tokens"]}}
        self.expect_cases(CASES["cases_of_the_extension"], grammar)

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
                "", "speed_ratio", "speed_ratio >", "1 + 1", "'aperiodic'", "class < 'aperiodic'",
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
