"""The rotors of the paper's statements, and the lines of an atlas that belong to one of them.

A scene is that of a rotor where its quantities agree with the paper's within their digits, and it has no effect that
the paper has not. What the paper does not give is not compared: the ring's stiffness, the phase of an unbalance, the
direction of the sweep; of the rig also its modal mass and friction. Where the grid sweeps one of these, a statement is
judged at each of its values.
"""
import itertools
import math
from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

from rubatlas.atlas_file import same_value
from rubatlas.same_scene import MACHINE, POINTS, WORDS

from paper.atlas_lines import OWN_AXES, AtlasLines, axis_of
from paper.line import Line
from paper.verdict import Finding, not_covered

# Sections of a scene that are no effects, or, as the unbalance, an axis of every atlas.
KNOWN = {*MACHINE, *POINTS, *WORDS, "unbalance", "pieces"}
# What the numbers of a section are besides its strength: a section of which only these are swept is there at every
# line.
NO_STRENGTH = ("phase", "order", "seed", "direction", "regularising_velocity")
OPEN = ("direction", "ring_stiffness", "unbalance_phase")
TURN = 2.0 * math.pi


class Rotor(NamedTuple):
    name: str  #: "the paper's default rotor"
    quantities: dict[str, float]  #: those that an atlas has to share, by their JSON pointers, unless it sweeps them
    usual: dict[str, float]  #: the rotor's own values of what the axes of every atlas sweep
    open: tuple[str, ...] = OPEN  #: axes whose value the paper does not give
    half_digit: dict[str, float] = {}  #: quantities that it gives rounded: half a unit of the last digit
    allowed: tuple[str, ...] = ()  #: effects that do not make it another rotor

    def agrees(self, pointer: str, value: float, own: float) -> bool:
        return same_value(value, own) or abs(value - own) <= self.half_digit.get(pointer, 0.0)

    def usual_value(self, axis: str) -> float:
        """Value of an axis; 0 for an absent effect and for the upward direction."""
        values = {axis_of(pointer): value for pointer, value in self.quantities.items()}
        return {**values, **self.usual}.get(axis, 0.0)

    def difference(self, atlas: AtlasLines) -> str:
        """The reason why an atlas is of another rotor; empty where it is of this one."""
        for pointer, own in self.quantities.items():
            if atlas.swept_values(pointer) is not None:
                continue  # the value on the axis distinguishes the lines
            section, key = pointer.strip("/").split("/")
            value = atlas.scene[section][key]
            if not self.agrees(pointer, value, own):
                return f"this is not {self.name}: {pointer} is {value:g}, not {own:g}"
        for section, part in atlas.scene.items():
            if section in KNOWN or section in self.allowed:
                continue
            if not any(atlas.swept_values(f"/{section}/{key}") is not None for key in part if key not in NO_STRENGTH):
                return f"this is not {self.name}, which is without /{section}"
        return ""


def _quantities(**sections: dict[str, float]) -> dict[str, float]:
    return {f"/{section}/{key}": value for section, part in sections.items() for key, value in part.items()}


DEFAULT = Rotor(
    "the paper's default rotor",
    _quantities(rotor={"mass": 1.0, "natural_frequency": 10.0, "misalignment": 0.01001},
                blades={"count": 3, "length": 0.1, "width": 0.01, "youngs_modulus": 206e9, "hub_radius": 0.0},
                ring={"radius": 0.11}),
    {"damping_ratio": 0.1, "friction": 0.1, "unbalance": 0.0, "thickness": 1e-3})
ANY_COUNT = DEFAULT._replace(quantities={pointer: value for pointer, value in DEFAULT.quantities.items()
                                         if pointer != "/blades/count"})
# 30.23 Hz or 1814 rpm, 12.7 mm, 206 GPa. Lengths agree as decimals: the blades reach into the ring by a hundredth of a
# millimetre.
RIG = Rotor(
    "the paper's test rig",
    _quantities(rotor={"natural_frequency": TURN * 30.23, "misalignment": 0.36e-3},
                blades={"count": 3, "length": 40e-3, "width": 12.7e-3, "youngs_modulus": 206e9,
                        "hub_radius": 22.15e-3},
                ring={"radius": 62.5e-3}),
    {"damping_ratio": 0.05, "friction": 0.1, "unbalance": 0.0, "thickness": 0.5e-3},
    (*OPEN, "friction", "rotor_mass"),
    {"/rotor/natural_frequency": TURN * 0.005, "/blades/width": 0.05e-3, "/blades/youngs_modulus": 0.5e9})
RIG_CLEARANCE = 62.5e-3 - 22.15e-3 - 40e-3  # [m]


class Setting(NamedTuple):
    """One value for each open axis that an atlas has."""

    values: dict[str, float] = {}
    text: str = ""  #: "kr = 1000 N/m, direction = up"


def settings(rotor: Rotor, atlas: AtlasLines, without: Iterable[str] = ()) -> list[Setting]:
    """Every combination of the values of the open axes except `without`; one empty setting where there is none."""
    open_axes = [name for name in atlas.names if name in rotor.open and name not in without]
    if rotor.difference(atlas):
        return [Setting()]
    return [Setting(dict(zip(open_axes, values)), ", ".join(map(atlas.text, open_axes, values)))
            for values in itertools.product(*(map(float, atlas.values[name]) for name in open_axes))]


class Evidence:
    """The lines of an atlas that belong to one rotor at one setting of its open axes."""

    def __init__(self, atlas: AtlasLines, rotor: Rotor, setting: Setting = Setting()) -> None:
        self.atlas, self.rotor, self.setting = atlas, rotor, setting
        self.other_rotor = rotor.difference(atlas)  #: the reason why the atlas does not cover the rotor

    @property
    def scene(self) -> dict[str, Any]:
        return self.atlas.scene

    @property
    def law(self) -> str:
        return str(self.scene["contact"]["law"])

    def _fits(self, axis: str, value: float) -> bool:
        if axis in self.setting.values:
            return value == self.setting.values[axis]
        values = self.atlas.values[axis]
        # One value of an optional axis is the scene's own, which has been compared with the rotor; one of an axis that
        # the paper leaves open is as good as another.
        if values.size == 1 and (axis not in OWN_AXES.values() or axis in self.rotor.open) and axis != "direction":
            return True
        pointer = next((one for one in self.rotor.quantities if axis_of(one) == axis), "")
        return self.rotor.agrees(pointer, value, self.rotor.usual_value(axis))

    def lines_over(self, *names: str) -> list[Line]:
        """The lines whose parameters, but for the named ones, are those of the rotor and the setting, ascending in the
        named ones, of which the first is the slowest."""
        if self.other_rotor:
            return []
        lines = [line for line in self.atlas.lines
                 if all(axis in names or self._fits(axis, value) for axis, value in line.parameters.items())]
        return sorted(lines, key=lambda line: [self.value(line, name) for name in names])

    @property
    def own_line(self) -> Line | None:
        """The line with the rotor's own parameters."""
        lines = self.lines_over()
        return lines[0] if lines else None

    def value(self, line: Line, name: str) -> float:
        """The line's value on an axis, or, where the atlas has no such axis, the rotor's."""
        return line.parameters.get(name, self.rotor.usual_value(name))

    def text(self, line: Line, name: str) -> str:
        """"ζ = 0.1"."""
        return self.atlas.text(name, line.parameters[name])

    def range_text(self, lines: Sequence[Line], name: str) -> str:
        if len(lines) == 1:
            return f"at {self.text(lines[0], name)}"
        return f"from {self.text(lines[0], name)} to {self.text(lines[-1], name)}"

    def lines_along(self, name: str, statements: Sequence[str]) -> tuple[list[Line], dict[str, list[Finding]]]:
        """The lines along an axis; where there are no two of them, what is said of each statement instead."""
        lines = self.lines_over(name)
        if len(lines) >= 2 and not self.other_rotor:
            return lines, {}
        reason = (self.other_rotor
                  or f"the grid has {'only one' if lines else 'no'} line of {self.rotor.name} along {name}")
        return lines, {statement: [not_covered(reason)] for statement in statements}

    def no_own_line(self) -> str:
        return self.other_rotor or f"the grid has no line of {self.rotor.name}"

    def within(self, lines: Sequence[Line], name: str, low: float, high: float) -> list[Line]:
        """The lines whose value is in [low, high], to within the rounding of decimals."""
        rounding = 1.0 + 1e-9
        return [line for line in lines if self.value(line, name) * rounding >= low
                and self.value(line, name) <= high * rounding]
