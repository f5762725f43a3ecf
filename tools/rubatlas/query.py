"""Conditions on the points of an atlas, as text: what `Atlas.where` and the search field of a report's page understand.

    condition   comparison | condition and condition | condition or condition | not condition | ( condition )
    comparison  value < value (also <= > >= == !=), chained as in 0.3 < speed_ratio < 0.5
    value       number | name of a map or an axis | 'word of a flag' | value + value (also - * / **) | - value | + value

Numbers are in SI units. A word in quotes is compared by == and != with a map of flags: class == 'aperiodic',
status == 'done', direction == 'up'. A comparison with what is not there (NaN) is false, != true. `Atlas.where`
chooses points that are done alone. The text is never executed.

The grammar is data: tokens, operators and sentences stand in query_grammar.json, and this file and the page's query.js
read them by the same rule. An operator joins operands whose operators have a higher level. One that joins from the left
takes all operands at its level, `chain` compares each operand with the next, and `right` joins from the right.

>>> import numpy as np
>>> names = {"speed_ratio": Name(np.array([0.3, 0.4, 0.5])),
...          "class": Name(np.array([1, 255, 2]), {1: "period 1", 2: "period 2", 255: "aperiodic"})}
>>> evaluate("class != 'aperiodic' and 0.2 < speed_ratio < 0.45", names)
array([ True, False, False])
>>> evaluate("speed > 0.4", names)
Traceback (most recent call last):
    ...
rubatlas.query.QueryError: speed > 0.4: speed is not in this atlas; the nearest name is speed_ratio
"""
from __future__ import annotations

import dataclasses
import functools
import json
import operator
import pathlib
import re
from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np

from rubatlas.atlas_file import AtlasError

Array = np.ndarray[Any, np.dtype[Any]]
# ["number", 0.3], ["name", "class"], ["word", "aperiodic"], ["before", "-", tree], or
# ["between", tree, ["<", tree], ["<", tree]] with all operands that operators of one level join.
Tree = list[Any]

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
    """What a name of a condition stands for: its numbers, and their words where they are flags."""

    values: Array
    flags: Mapping[int, str] | None = None


@dataclasses.dataclass(frozen=True)
class _Value:
    """What a tree stands for. `kind`: number, flag (numbers with words), word or condition."""

    kind: str
    values: Any = None
    flags: Mapping[int, str] = dataclasses.field(default_factory=dict)
    text: str = ""


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


def _tokens(text: str, grammar: dict[str, Any]) -> list[tuple[str, str]]:
    """The text as (kind of token, its text), ending with the kind "end"."""
    result, at = [], 0
    while at < len(text):
        matches = ((kind, re.compile(pattern).match(text, at)) for kind, pattern in grammar["tokens"].items())
        kind, found = next(((kind, found[0]) for kind, found in matches if found), ("", ""))
        if not found:
            raise _refusal(grammar, "unknown_sign", rest=text[at:].split()[0])
        if kind != "space":
            result.append((kind, found if kind == "word" else grammar["synonyms"].get(found, found)))
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
        token = self.take()
        if kind != "number":
            return [kind, token[1:-1] if kind == "word" else token]
        factor = self.rule("units")
        if factor:
            self.take()
        return [kind, float(token) * (factor or 1.0)]


def parse(text: str, grammar: dict[str, Any] = GRAMMAR) -> Tree:
    """The tree of a condition."""
    return _Parser(text, grammar).whole()


class _Evaluation:
    """Walks a tree. Conditions become arrays of bool, numbers arrays of float."""

    def __init__(self, names: Mapping[str, Name], grammar: dict[str, Any]):
        self.names, self.grammar = names, grammar

    def value(self, tree: Tree) -> _Value:
        match tree:
            case ["number", number]:
                return _Value("number", np.float64(number))
            case ["word", word]:
                return _Value("word", text=word)
            case ["name", name]:
                return self.named(name)
            case ["before", sign, operand]:
                rule = self.grammar["before"][sign]
                inner = self.operand(rule, sign, "after", self.value(operand))
                return _Value(rule["gives"], _DOES[rule["does"]](inner))
        _, first, *rest = tree
        left, compared = self.value(first), []
        for sign, operand in rest:
            rule, right = self.grammar["between"][sign], self.value(operand)
            result = _Value(rule["gives"], self.joined(rule, sign, left, right))
            chain = rule["joins"] == "chain"
            compared += [result.values] if chain else []
            left = right if chain else result
        return _Value("condition", functools.reduce(operator.and_, compared)) if compared else left

    def named(self, name: str) -> _Value:
        if name in self.names:
            known = self.names[name]
            values = np.asarray(known.values, dtype=float)
            return _Value("number", values) if known.flags is None else _Value("flag", values, known.flags, name)
        flag = next((one for one, known in self.names.items() if name in (known.flags or {}).values()), None)
        if flag is not None:
            raise _refusal(self.grammar, "without_quotes", name=name, flag=flag)
        if name in self.grammar["names_of_maps"]:
            raise _refusal(self.grammar, "without_maps", name=name)
        raise _refusal(self.grammar, "unknown_name", name=name, nearest=nearest(name, self.names))

    def operand(self, rule: dict[str, Any], sign: str, place: str, value: _Value) -> Any:
        """The numbers or the condition that an operator takes; a map of flags is numbers, too."""
        if rule["takes"] != ("number" if value.kind == "flag" else value.kind):
            kind, wanted = (self.grammar["kinds"][one] for one in (value.kind, rule["takes"]))
            raise _refusal(self.grammar, f"operand_{place}", sign=sign, kind=kind, wanted=wanted)
        return value.values

    def joined(self, rule: dict[str, Any], sign: str, left: _Value, right: _Value) -> Any:
        if "words" in rule and "word" in (left.kind, right.kind):
            flag, word = (right, left.text) if left.kind == "word" else (left, right.text)
            if flag.kind != "flag" or not rule["words"]:
                raise _refusal(self.grammar, "words_are_compared", word=word)
            code = next((code for code, meaning in flag.flags.items() if meaning == word), None)
            if code is None:
                likely = nearest(word, flag.flags.values())
                raise _refusal(self.grammar, "unknown_word", word=word, name=flag.text, nearest=likely)
            return _DOES[rule["does"]](flag.values, code)
        operands = self.operand(rule, sign, "before", left), self.operand(rule, sign, "after", right)
        with np.errstate(all="ignore"):
            return _DOES[rule["does"]](*operands)

    def condition(self, tree: Tree) -> Array:
        whole = self.value(tree)
        if whole.kind != "condition":
            raise _refusal(self.grammar, "no_condition", kind=self.grammar["kinds"][whole.kind])
        return np.asarray(whole.values)


def evaluate(text: str, names: Mapping[str, Name], grammar: dict[str, Any] = GRAMMAR) -> Array:
    """Where a condition holds: an array of bool, in the shape to which the arrays of its names broadcast."""
    try:
        return _Evaluation(names, grammar).condition(parse(text, grammar))
    except QueryError as error:
        shown = " ".join(text.split())
        raise QueryError(f"{shown if len(shown) < 300 else f'{shown[:60]} …'}: {error}".removeprefix(": ")) from None
