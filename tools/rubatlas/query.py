"""Conditions on the points of an atlas, as text: the grammar of `Atlas.where` and of the explorer's search field.

    condition   comparison | condition and condition | condition or condition | not condition | ( condition )
    comparison  value < value (also <= > >= == !=), chained as in 0.3 < speed_ratio < 0.5
    value       number | name of a map or an axis | 'word of a flag' | value + value (also - * / ** and a leading - or +)

Numbers are in SI units. A word in quotes is compared by == and != with a map of flags: class == 'aperiodic',
status == 'done', direction == 'up'. A comparison with what is not there (NaN) is false, != true. `Atlas.where` chooses points that are done alone. The text is never
executed: Python's parser makes a tree of it, and only the nodes above are understood.

>>> import numpy as np
>>> names = {"speed_ratio": Name(np.array([0.3, 0.4, 0.5])), "class": Name(np.array([1, 255, 2]), {1: "period 1", 2: "period 2", 255: "aperiodic"})}
>>> evaluate("class != 'aperiodic' and 0.2 < speed_ratio < 0.45", names)
array([ True, False, False])
>>> evaluate("speed > 0.4", names)
Traceback (most recent call last):
    ...
rubatlas.query.QueryError: speed > 0.4: speed is not in this atlas; the nearest name is speed_ratio
"""
import ast
import dataclasses
import difflib
import functools
import operator
from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np

from rubatlas.atlas_file import AtlasError

Array = np.ndarray[Any, np.dtype[Any]]


class QueryError(AtlasError):
    """The text is no condition of the grammar; the message says what is wrong, and what is allowed."""


@dataclasses.dataclass(frozen=True)
class Name:
    """What a name of a condition stands for: its numbers, and their words where they are flags."""

    values: Array
    flags: Mapping[int, str] | None = None


# The word `class` is a name here and a keyword of Python; no name of an atlas ends in an underscore.
_CLASS, _CLASS_IN_PYTHON = "class", "class_"
# What `rubatlas analyse` adds to an atlas.
_OF_MAPS = ("class", "class_blade_passing", "attractor", "margin")

_ARITHMETIC: dict[type[ast.operator], Callable[[Array, Array], Array]] = {
    ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Div: operator.truediv, ast.Pow: operator.pow}
_COMPARE: dict[type[ast.cmpop], Callable[[Any, Any], Any]] = {
    ast.Lt: operator.lt, ast.LtE: operator.le, ast.Gt: operator.gt, ast.GtE: operator.ge, ast.Eq: operator.eq, ast.NotEq: operator.ne}


def nearest(word: str, known: Iterable[str]) -> str:
    """The known word that is most like another one.

    >>> nearest("max_displacment", ["max_contact_force", "max_displacement"])
    'max_displacement'
    """
    return max(known, key=lambda one: (difflib.SequenceMatcher(None, word.lower(), one.lower()).ratio(), one.startswith(word)))


@dataclasses.dataclass(frozen=True)
class _Value:
    """A value of the grammar: numbers, with their name where they are a map of flags, or a word in quotes."""

    numbers: Array | None = None
    flags: Mapping[int, str] | None = None
    name: str = ""
    word: str | None = None


class _Evaluation:
    """Walks the tree of a condition. Conditions become arrays of bool, values become `_Value`s."""

    def __init__(self, names: Mapping[str, Name]):
        self.names = names

    def condition(self, node: ast.expr) -> Array:
        match node:
            case ast.BoolOp(op=op, values=parts):
                join = operator.and_ if isinstance(op, ast.And) else operator.or_
                return functools.reduce(join, (self.condition(part) for part in parts))
            case ast.UnaryOp(op=ast.Not(), operand=operand):
                return ~self.condition(operand)
            case ast.Compare(left=left, ops=signs, comparators=others):
                values = [self.value(part) for part in (left, *others)]
                parts_kept = [self.compared(sign, one, other) for sign, one, other in zip(signs, values, values[1:])]
                return functools.reduce(operator.and_, parts_kept)
        raise QueryError(f"{_shown(node)} is no condition; a condition compares values, as in max_displacement > 5e-3")

    def value(self, node: ast.expr) -> _Value:
        match node:
            case ast.Constant(value=str(word)):
                return _Value(word=word)
            case ast.Constant(value=number) if isinstance(number, (int, float)) and not isinstance(number, bool):
                return _Value(numbers=np.asarray(float(number)))
            case ast.Name(id=name):
                return self.named(_CLASS if name == _CLASS_IN_PYTHON else name)
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                return _Value(numbers=-self.numbers(operand))
            case ast.UnaryOp(op=ast.UAdd(), operand=operand):
                return _Value(numbers=self.numbers(operand))
            case ast.BinOp(left=left, op=sign, right=right) if type(sign) in _ARITHMETIC:
                with np.errstate(all="ignore"):
                    return _Value(numbers=_ARITHMETIC[type(sign)](self.numbers(left), self.numbers(right)))
        raise QueryError(f"{_shown(node)} is no value; allowed: numbers, names, words in quotes, + - * / **")

    def named(self, name: str) -> _Value:
        if name not in self.names:
            flag = next((one for one, known in self.names.items() if name in (known.flags or {}).values()), None)
            if flag is not None:
                raise QueryError(f"{name} is a word of {flag}; words stand in quotes, as in {flag} == '{name}'")
            if name in _OF_MAPS:
                raise QueryError(f"{name} is in the maps of an atlas (rubatlas analyse), which are not here")
            raise QueryError(f"{name} is not in this atlas; the nearest name is {nearest(name, self.names)}")
        known = self.names[name]
        return _Value(numbers=known.values, flags=known.flags, name=name)

    def numbers(self, node: ast.expr) -> Array:
        value = self.value(node)
        if value.numbers is None:
            raise QueryError(f"'{value.word}' is a word, not a number")
        return value.numbers.astype(float)

    def compared(self, sign: ast.cmpop, left: _Value, right: _Value) -> Array:
        if type(sign) not in _COMPARE:
            raise QueryError("values are compared by < <= > >= == !=")
        compare = _COMPARE[type(sign)]
        if left.word is not None or right.word is not None:
            flag, word = (right, left.word) if left.word is not None else (left, right.word)
            if flag.flags is None or flag.numbers is None or not isinstance(sign, (ast.Eq, ast.NotEq)):
                raise QueryError(f"'{word}' is compared by == or != with a map of classes")
            code = next((code for code, meaning in flag.flags.items() if meaning == word), None)
            if code is None:
                raise QueryError(f"'{word}' is no value of {flag.name}; the nearest is '{nearest(str(word), flag.flags.values())}'")
            return np.asarray(compare(flag.numbers, code))
        with np.errstate(invalid="ignore"):
            return np.asarray(compare(left.numbers, right.numbers))


def _shown(node: ast.expr) -> str:
    return ast.unparse(node).replace(_CLASS_IN_PYTHON, _CLASS)


def _python(text: str) -> str:
    """The condition as Python can parse it: outside of words in quotes, `class` becomes a name."""
    parts, quote, word = [], "", ""
    for character in f"{text} ":
        if not quote and (character.isalnum() or character == "_"):
            word += character
            continue
        parts.append(_CLASS_IN_PYTHON if word == _CLASS else word)
        word = ""
        if character in "'\"" and quote in ("", character):
            quote = "" if quote else character
        parts.append(character)
    return "".join(parts).strip()


def evaluate(text: str, names: Mapping[str, Name]) -> Array:
    """Where a condition holds: an array of bool, in the shape to which the arrays of its names broadcast."""
    if not text.strip():
        raise QueryError("the condition is empty; a condition compares values, as in max_displacement > 5e-3")
    try:
        tree = ast.parse(_python(text), mode="eval")
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        raise QueryError(f"{text}: not a condition; as in class == 'aperiodic' and max_displacement > 5e-3") from None
    try:
        return _Evaluation(names).condition(tree.body)
    except QueryError as error:
        raise QueryError(f"{text}: {error}") from None
    except RecursionError:
        raise QueryError(f"{text[:60]} …: the condition is nested too deeply") from None
