"""Every statement on one atlas: the lines that it is about, at each setting of what its rotor leaves open."""
from collections.abc import Callable, Iterable, Mapping
from typing import Any, NamedTuple

from rubatlas.atlas_file import AtlasError

from paper import blade, default_rotor, parameters, rig, rig_parameters, spectra, whole_picture
from paper.atlas_lines import AtlasLines, axis_of
from paper.line import Line
from paper.rotors import ANY_COUNT, DEFAULT, RIG, Evidence, Rotor, settings
from paper.statements import STATEMENTS
from paper.verdict import NOT_COVERED, Finding, not_covered, verdict_of

Judged = dict[str, list[Finding]]


class Verdict(NamedTuple):
    """A statement at one setting."""

    name: str
    setting: str
    findings: list[Finding]

    @property
    def verdict(self) -> str:
        return verdict_of(self.findings)

    def as_json(self) -> dict[str, Any]:
        return {"name": self.name, "claim": STATEMENTS[self.name].claim, "setting": self.setting,
                "verdict": self.verdict, "findings": [finding._asdict() for finding in self.findings]}


def own_line(judge: Callable[[Line], Judged], names: Iterable[str]) -> Callable[[Evidence], Judged]:
    """A judgement of one line as one of the evidence."""
    def judged(evidence: Evidence) -> Judged:
        line = evidence.own_line
        return {name: [not_covered(evidence.no_own_line())] for name in names} if line is None else judge(line)
    return judged


def _spectra(evidence: Evidence) -> Judged:
    line, atlas = evidence.own_line, evidence.atlas
    if line is None or not atlas.has_spectra:
        reason = evidence.no_own_line() if line is None else "the atlas keeps no spectra"
        return {name: [not_covered(reason)] for name in ("P11a", "P11b", "P11c", "P11d")}
    lines = evidence.lines_over("unbalance")
    return {**spectra.judge_line(line, atlas.orders()), "P11d": spectra.line_at_1(lines, atlas.orders())}


def _blade(evidence: Evidence) -> Judged:
    if evidence.other_rotor or evidence.law != "elastica":
        return {"P16": [not_covered(evidence.other_rotor or "rigid blades have no curve, and others small slopes")]}
    axes = {key: axis_of(f"/blades/{key}") for key in evidence.scene["blades"]}
    own = {key: RIG.usual_value(axes[key]) if axes[key] in evidence.atlas.names else value
           for key, value in evidence.scene["blades"].items()}  # what is swept has the rig's own value
    friction = evidence.setting.values.get("friction", evidence.rotor.usual["friction"])
    return {"P16": blade.curve(own, friction)}


class _Judge(NamedTuple):
    rotor: Rotor
    judged: Callable[[Evidence], Judged]
    without: tuple[str, ...] = ()  # open axes that it judges along


JUDGES = (
    _Judge(DEFAULT, own_line(default_rotor.judge_line, ("P1a", "P1b", "P2a", "P2b", "P3", "P4"))),
    _Judge(RIG, own_line(lambda line: {"P2b": default_rotor.sudden_jumps(line)}, ("P2b",))),
    _Judge(DEFAULT, parameters.damping), _Judge(DEFAULT, parameters.friction), _Judge(DEFAULT, parameters.unbalance),
    _Judge(RIG, rig_parameters.thin_blades),
    _Judge(RIG, own_line(rig.judge_line, ("P10", "P14a", "P14a1", "P14a2", "P14b", "P14c", "P14d"))),
    _Judge(RIG, _spectra), _Judge(RIG, own_line(lambda line: {"P11e": spectra.announced(line)}, ("P11e",))),
    _Judge(ANY_COUNT, whole_picture.blade_count),
    _Judge(DEFAULT, whole_picture.ring_stiffness, ("ring_stiffness",)),
    _Judge(RIG, rig_parameters.what_matters), _Judge(RIG, _blade), _Judge(RIG, rig_parameters.chaos_by_unbalance),
    _Judge(RIG, rig_parameters.repeated), _Judge(RIG, rig_parameters.contact_of_worn_blades),
    _Judge(RIG, rig_parameters.strength),
    _Judge(DEFAULT, whole_picture.small_changes), _Judge(RIG, whole_picture.small_changes),
    _Judge(RIG, whole_picture.ranges, ("friction",)), _Judge(RIG, rig_parameters.wandering),
    _Judge(DEFAULT, own_line(whole_picture.where_to_operate, ("P24",))),
    _Judge(RIG, own_line(whole_picture.where_to_operate, ("P24",))))


def why_none_applies(atlas: AtlasLines) -> str:
    """Why no statement is about an atlas; empty where some are."""
    if atlas.starts:
        return "statements are about lines from one initial state, which is an axis here"
    different = ANY_COUNT.difference(atlas)
    return f"{different}; nor is it the paper's test rig" if different and RIG.difference(atlas) else ""


def judge(atlas: AtlasLines) -> list[Verdict]:
    """Verdicts in the order of the statements, and of the settings; one that no setting covers is there once."""
    reason = why_none_applies(atlas)
    if reason:
        raise AtlasError(f"{atlas.path}: {reason}")
    found: dict[str, list[Verdict]] = {name: [] for name in STATEMENTS}
    for rotor, judged, without in JUDGES:
        for setting in settings(rotor, atlas, without):
            for name, findings in judged(Evidence(atlas, rotor, setting)).items():
                plain = [one._replace(holds=None if one.holds is None else bool(one.holds)) for one in findings]
                found[name].append(Verdict(name, setting.text, plain))  # numpy's bools are not JSON's
    result = []
    for name, verdicts in found.items():
        covered = [one for one in verdicts if one.verdict != NOT_COVERED]
        result += covered or [one._replace(setting="") for one in verdicts[:1]]
    return result


def best_known(judged: Mapping[str, list[Verdict]]) -> dict[str, list[tuple[str, Verdict]]]:
    """Of several atlases, by their names: for each statement those that cover it; else one that says why not."""
    result: dict[str, list[tuple[str, Verdict]]] = {}
    for name in STATEMENTS:
        own = [(atlas, one) for atlas, verdicts in judged.items() for one in verdicts if one.name == name]
        covered = [one for one in own if one[1].verdict != NOT_COVERED]
        if own:
            # Else the atlas of the statement's own rotor says what is missing.
            result[name] = covered or sorted(own, key=lambda one: one[1].findings[0].evidence.startswith("this is"))[:1]
    return result
