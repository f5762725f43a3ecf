"""Conditions on the points of an atlas, as text: what `Atlas.where` and the search field of a report's page understand.

    condition   comparison | condition and condition | condition or condition | not condition | ( condition )
    comparison  value < value (also <= > >= == !=), chained as in 0.3 < speed_ratio < 0.5
    value       number | number unit | name of a map or an axis | word of a flag | value + value (also - * / **)
                | - value | + value

A number without a unit is in the atlas' own, which is SI; units are m, mm, N, g mm, %, and those of this rotor:
clearances, and rpm, Hz, rad/s for the speed ratio and distances in it. Values that are compared or added have one unit.
A word is compared by == (=) and != with a map of flags: class == 'aperiodic', direction = up; alone it means that its
map has it: aperiodic and speed > 9 Hz. A name may have spaces for underscores, and some names and words have synonyms:
damping, Ω, chaotic. A comparison with what is not there (NaN; a class that is none, as a number) is false, != true.
`Atlas.where` chooses points that are done alone. The text is never executed.

The grammar is data: tokens, units, synonyms, operators and sentences stand in query_grammar.json, and this file and the
page's query.js read them by the same rule. An operator joins operands whose operators have a higher level. One that
joins from the left takes all operands at its level, `chain` compares each operand with the next, and `right` joins from
the right.

>>> import numpy as np
>>> names = {"speed_ratio": Name(np.array([0.3, 0.4, 0.5])),
...          "max_displacement": Name(np.array([1e-3, 4e-3, 9e-3]), "m"),
...          "class": Name(np.array([1, 255, 2]), flags={1: "period 1", 2: "period 2", 255: "aperiodic"})}
>>> evaluate("class != 'aperiodic' and 0.2 < speed_ratio < 0.45", names)
array([ True, False, False])
>>> evaluate("chaotic or max displacement > 5 mm", names)
array([False,  True,  True])
>>> evaluate("speed < 10 rpm", names, {"radian_per_second": 0.4})  # natural frequency: 2.5 rad/s
array([ True,  True, False])
>>> evaluate("max_displacement > 5 N", names)
Traceback (most recent call last):
    ...
rubatlas.query.QueryError: max_displacement > 5 N: what stands before > is a length, what stands after it is a force
"""
from __future__ import annotations

import contextlib
import dataclasses
import functools
import json
import operator
import pathlib
import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from typing import Any

import numpy as np

from rubatlas.atlas_file import AtlasError

Array = np.ndarray[Any, np.dtype[Any]]
# ["number", 0.3], ["number", 4.0, "mm"], ["name", "class"], ["word", "aperiodic"], ["before", "-", tree], or
# ["between", tree, ["<", tree], ["<", tree]] with all operands that operators of one level join.
Tree = list[Any]
# What units are multiples of, by the grammar's names, each a number or an array: "clearance" [m], and
# "radian_per_second", the speed ratio of 1 rad/s.
Sizes = Mapping[str, Any]

GRAMMAR: dict[str, Any] = json.loads(pathlib.Path(__file__).with_name("query_grammar.json").read_text(encoding="utf-8"))

# What the operators do, by the names that the grammar gives it.
_DOES: dict[str, Callable[..., Any]] = {
    "or": operator.or_, "and": operator.and_, "not": operator.invert, "negate": operator.neg, "keep": operator.pos,
    "less": operator.lt, "at_most": operator.le, "greater": operator.gt, "at_least": operator.ge,
    "equal": operator.eq, "differ": operator.ne,
    "add": operator.add, "subtract": operator.sub, "multiply": operator.mul, "divide": operator.truediv,
    "power": operator.pow}


class QueryError(AtlasError):
    """The text is no condition of the grammar; the message says what is wrong, and what is allowed."""


@dataclasses.dataclass(frozen=True)
class Name:
    """What a name of a condition stands for: its numbers, their unit (any, if none is said), and their words where they
    are flags."""

    values: Array
    units: str | None = None
    flags: Mapping[int, str] | None = None


@dataclasses.dataclass(frozen=True)
class _Value:
    """What a tree stands for. `kind`: number, flag (numbers with words), word or condition. `units`: of a number; none
    where it may have any."""

    kind: str
    values: Any = None
    flags: Mapping[int, str] = dataclasses.field(default_factory=dict)
    text: str = ""
    units: str | None = None


def nearest(word: str, known: Iterable[str]) -> str:
    """The known word that has most pairs of letters in common with another one.

    >>> nearest("max_displacment", ["max_contact_force", "max_displacement"])
    'max_displacement'
    """
    def pairs(text: str) -> set[str]:
        return {f" {text} "[i:i + 2].lower() for i in range(len(text) + 1)}

    return max(known, key=lambda one: len(pairs(word) & pairs(one)) / (len(pairs(word)) + len(pairs(one))))


def _refusal(grammar: dict[str, Any], sentence: str, **facts: Any) -> QueryError:
    return QueryError(grammar["sentences"][sentence].format(**facts))


def _unit(text: str, at: int, grammar: dict[str, Any]) -> str:
    """The unit that stands at a place of the text; empty where none does."""
    here = [unit for unit in grammar["units"] if text.startswith(unit, at)
            and not re.match("[A-Za-z0-9_]", text[at + len(unit):])]
    return max(here, key=len, default="")


def _tokens(text: str, grammar: dict[str, Any]) -> list[tuple[str, str]]:
    """The text as (kind of token, its text), ending with the kind "end". After a number a unit may stand."""
    result: list[tuple[str, str]] = []
    at = 0
    while at < len(text):
        matches = ((kind, re.compile(pattern).match(text, at)) for kind, pattern in grammar["tokens"].items())
        kind, found = next(((kind, found[0]) for kind, found in matches if found), ("", ""))
        if kind != "space" and result and result[-1][0] == "number" and (unit := _unit(text, at, grammar)):
            kind, found = "unit", unit
        if not found:
            raise _refusal(grammar, "unknown_sign", rest=(text[at:].split() or [text[at:]])[0])
        if kind != "space":
            result.append((kind, grammar["synonyms"].get(found, found) if kind == "sign" else found))
        at += len(found)
    if len(result) > grammar["longest"]:
        raise _refusal(grammar, "too_long", longest=grammar["longest"])
    return [*result, ("end", grammar["sentences"]["the_end"])]


class _Parser:
    """Makes the tree of a condition; names and kinds are not looked at yet."""

    def __init__(self, text: str, grammar: dict[str, Any]):
        self.grammar, self.tokens, self.at = grammar, _tokens(text, grammar), 0

    @property
    def found(self) -> str:
        return self.tokens[self.at][1]

    def take(self) -> str:
        self.at += 1
        return self.tokens[self.at - 1][1]

    def rule(self, table: str) -> Any:
        """What a table of the grammar says of the next token; none of a word in quotes, and of what is not in it."""
        return None if self.tokens[self.at][0] == "word" else self.grammar[table].get(self.found)

    @property
    def on_operator(self) -> bool:
        return bool(self.rule("between") or self.rule("before"))

    def whole(self) -> Tree:
        if self.tokens[0][0] == "end":
            raise _refusal(self.grammar, "empty")
        tree = self.expression(0, 0)
        if self.tokens[self.at][0] != "end":
            before = self.tokens[self.at - 1][1]
            raise _refusal(self.grammar, "after_the_end", found=self.found, before=before)
        return tree

    def expression(self, level: int, depth: int) -> Tree:
        """An operand, and what operators of this level and of higher ones join to it."""
        if depth > self.grammar["deepest"]:
            raise _refusal(self.grammar, "too_deep")
        tree = self.operand(depth + 1)
        while (rule := self.rule("between")) and rule["level"] >= level:
            tree = ["between", tree]
            least = rule["level"] + (0 if rule["joins"] == "right" else 1)
            while (self.rule("between") or {}).get("level") == rule["level"]:
                tree.append([self.take(), self.expression(least, depth + 1)])
        return tree

    def operand(self, depth: int) -> Tree:
        kind = self.tokens[self.at][0]
        if rule := self.rule("before"):
            return ["before", self.take(), self.expression(rule["level"], depth)]
        if bracket := self.rule("brackets"):
            self.take()
            inner = self.expression(0, depth)
            if self.found != bracket:
                raise _refusal(self.grammar, "unclosed", bracket=bracket, found=self.found)
            self.take()
            return inner
        if kind in ("sign", "end") or self.rule("between"):
            raise _refusal(self.grammar, "missing", found=self.found)
        return self.number() if kind == "number" else self.phrase(kind)

    def number(self) -> Tree:
        number = ["number", float(self.take())]
        kind = self.tokens[self.at][0]
        if kind == "name" and not self.on_operator:
            raise _refusal(self.grammar, "unknown_unit", found=self.found, units=", ".join(self.grammar["units"]))
        return [*number, self.take()] if kind == "unit" else number

    def phrase(self, kind: str) -> Tree:
        """A word in quotes; or a name, or a word, which may be several tokens, as in: period 2."""
        words = [self.take()]
        while kind == "name" and self.tokens[self.at][0] in ("name", "number") and not self.on_operator:
            words.append(self.take())
        phrase = words[0][1:-1] if kind == "word" else " ".join(words)
        return [kind, self.grammar["synonyms"].get(phrase, phrase)]


def parse(text: str, grammar: dict[str, Any] = GRAMMAR) -> Tree:
    """The tree of a condition."""
    return _Parser(text, grammar).whole()


class _Evaluation:
    """Walks a tree. Conditions become arrays of bool, numbers arrays of float. `sizes`: of the units that depend on the
    rotor."""

    def __init__(self, names: Mapping[str, Name], sizes: Sizes, grammar: dict[str, Any]):
        self.names, self.sizes, self.grammar = names, sizes, grammar

    def value(self, tree: Tree) -> _Value:
        match tree:
            case ["number", number]:
                return _Value("number", np.float64(number))
            case ["number", number, unit]:
                return _Value("number", self.converted(number, unit), units=self.grammar["units"][unit]["of"])
            case ["word", word]:
                return _Value("word", text=word)
            case ["name", name]:
                return self.named(name)
            case ["before", sign, operand]:
                rule, inner = self.grammar["before"][sign], self.value(operand)
                values = self.operand(rule, sign, "after", inner)
                return _Value(rule["gives"], _DOES[rule["does"]](values), units=inner.units)
        _, first, *rest = tree
        left, compared = self.value(first), []
        for sign, operand in rest:
            rule, right = self.grammar["between"][sign], self.value(operand)
            units = None if "mixes_units" in rule else self.common_units(sign, left, right)
            result = _Value(rule["gives"], self.joined(rule, sign, left, right), units=units)
            chain = rule["joins"] == "chain"
            compared += [result.values] if chain else []
            left = right if chain else result
        return _Value("condition", functools.reduce(operator.and_, compared)) if compared else left

    def converted(self, number: float, unit: str) -> Any:
        """A number with a unit in that of the atlas."""
        rule = self.grammar["units"][unit]
        if "times" in rule and rule["times"] not in self.sizes:
            raise _refusal(self.grammar, "unknown_unit", found=unit, units=", ".join(self.grammar["units"]))
        # Divided, a decimal stays the nearest number to it: 0.9 / 1000 is 0.0009, 0.9 * 0.001 is not.
        plain = number * rule.get("factor", 1.0) / rule.get("over", 1.0)
        return plain * self.sizes[rule["times"]] if "times" in rule else np.float64(plain)

    def common_units(self, sign: str, left: _Value, right: _Value) -> str | None:
        """Those of two values that are compared or added."""
        if left.units is None or right.units is None:
            return left.units or right.units
        if left.units != right.units:
            before, after = (self.grammar["measures"].get(one.units, one.units) for one in (left, right))
            raise _refusal(self.grammar, "other_units", sign=sign, before=before, after=after)
        return left.units

    def named(self, phrase: str) -> _Value:
        name = phrase.replace(" ", "_")
        if name in self.names:
            known = self.names[name]
            values = np.asarray(known.values, dtype=float)
            if known.flags is not None:
                return _Value("flag", values, known.flags, name)
            return _Value("number", values, units=units_of(name, known.units, self.grammar))
        if not self.names:
            raise _refusal(self.grammar, "no_number", name=phrase)
        words = [word for known in self.names.values() for word in (known.flags or {}).values()]
        if phrase in words:
            return _Value("word", text=phrase)
        if name in self.grammar["names_of_maps"]:
            raise _refusal(self.grammar, "without_maps", name=name)
        if name in self.grammar["names_of_rows"]:
            raise _refusal(self.grammar, "has_rows", name=name)
        raise _refusal(self.grammar, "unknown_name", name=phrase, nearest=nearest(phrase, [*self.names, *words]))

    def holding(self, value: _Value) -> _Value:
        """A word alone as the condition that its map has it."""
        has = (known for known in self.names.values() if value.text in (known.flags or {}).values())
        flag = next(has, None) if value.kind == "word" else None
        return value if flag is None else _Value("condition", flag.values == _code(flag.flags or {}, value.text))

    def operand(self, rule: dict[str, Any], sign: str, place: str, value: _Value) -> Any:
        """The numbers or the condition that an operator takes; a map of flags is numbers, too, but for a word that says
        that there is none."""
        if rule["takes"] == "condition":
            value = self.holding(value)
        if rule["takes"] != ("number" if value.kind == "flag" else value.kind):
            kind, wanted = (self.grammar["kinds"][one] for one in (value.kind, rule["takes"]))
            raise _refusal(self.grammar, f"operand_{place}", sign=sign, kind=kind, wanted=wanted)
        none = _code(value.flags, self.grammar["no_number"].get(value.text, ""))
        return value.values if none is None else np.where(value.values == none, np.nan, value.values)

    def joined(self, rule: dict[str, Any], sign: str, left: _Value, right: _Value) -> Any:
        if "words" in rule and "word" in (left.kind, right.kind):
            flag, word = (right, left.text) if left.kind == "word" else (left, right.text)
            if flag.kind != "flag" or not rule["words"]:
                raise _refusal(self.grammar, "words_are_compared", word=word)
            code = _code(flag.flags, word)
            if code is None:
                likely = nearest(word, flag.flags.values())
                raise _refusal(self.grammar, "unknown_word", word=word, name=flag.text, nearest=likely)
            return _DOES[rule["does"]](flag.values, code)
        operands = self.operand(rule, sign, "before", left), self.operand(rule, sign, "after", right)
        with np.errstate(all="ignore"):
            return _DOES[rule["does"]](*operands)

    def condition(self, tree: Tree) -> Array:
        whole = self.holding(self.value(tree))
        if whole.kind != "condition":
            raise _refusal(self.grammar, "no_condition", kind=self.grammar["kinds"][whole.kind])
        return np.asarray(whole.values)


def _code(flags: Mapping[int, str], word: str) -> int | None:
    return next((code for code, meaning in flags.items() if meaning == word), None)


@contextlib.contextmanager
def _reading(text: str) -> Iterator[None]:
    """A refusal within the block begins with the text that is refused."""
    try:
        yield
    except QueryError as error:
        shown = " ".join(text.split())
        raise QueryError(f"{shown if len(shown) < 300 else f'{shown[:60]} …'}: {error}".removeprefix(": ")) from None


def evaluate(text: str, names: Mapping[str, Name], sizes: Sizes | None = None,
             grammar: dict[str, Any] = GRAMMAR) -> Array:
    """Where a condition holds: an array of bool, in the shape to which the arrays of its names broadcast."""
    with _reading(text):
        return _Evaluation(names, sizes or {}, grammar).condition(parse(text, grammar))


# --- limits: a name, a sign and a number ---

def units_of(name: str, units: str | None, grammar: dict[str, Any] = GRAMMAR) -> str | None:
    """The unit of what a name stands for: that of the file, or "speed" for speed ratios, which have units of their
    own."""
    return "speed" if name in grammar["speeds"] else units


@dataclasses.dataclass(frozen=True)
class Limit:
    """A quantity compared with one number.

    >>> Limit.read("max displacement ≤ 12 mm")
    Limit(text='max displacement ≤ 12 mm', name='max_displacement', sign='<=', tree=['number', 12.0, 'mm'])
    >>> Limit.read("max displacement ≤ 12 mm").bound("m")
    0.012
    """

    text: str
    name: str
    sign: str
    tree: Tree

    @staticmethod
    def read(text: str, signs: Collection[str] = ("<=", ">=")) -> Limit:
        with _reading(text):
            joined, quantity, *rest = parse(text)
            if joined == "between" and quantity[0] == "name" and len(rest) == 1 and rest[0][0] in signs:
                return Limit(text, quantity[1].replace(" ", "_"), *rest[0])
            raise _refusal(GRAMMAR, "no_limit", forms=" or ".join(f"NAME {one} NUMBER" for one in signs))

    def bound(self, units: str | None, sizes: Sizes | None = None) -> float:
        """The number in a unit. `sizes`: as of conditions; of several values each."""
        with _reading(self.text):
            evaluation = _Evaluation({}, sizes or {}, GRAMMAR)
            value = evaluation.value(self.tree)
            values = np.unique(evaluation.operand({"takes": "number"}, self.sign, "after", value))
            evaluation.common_units(self.sign, _Value("number", units=units_of(self.name, units)), value)
            if values.size != 1:
                raise _refusal(GRAMMAR, "several_sizes")
            return float(values[0])


def expressed(value: float, unit: str | None, sizes: Sizes) -> float | None:
    """A value of the atlas in a unit; none where the unit's size is not one number."""
    rule = GRAMMAR["units"].get(unit, {})
    size = np.unique(sizes.get(rule["times"], [])) if "times" in rule else np.ones(1)
    return float(value * rule.get("over", 1.0) / rule.get("factor", 1.0) / size[0]) \
        if size.size == 1 and size[0] > 0.0 else None


def shown(value: float, units: str | None, sizes: Sizes) -> str:
    """A value in the units in which a reader has it.

    >>> shown(0.25, "m", {"clearance": 0.0005})
    '250 mm, 500 clearances'
    """
    found = ((expressed(value, unit, sizes), unit) for unit in GRAMMAR["shown"].get(units, [units]))
    return ", ".join(f"{number:g} {unit}".strip() for number, unit in found if number is not None)
