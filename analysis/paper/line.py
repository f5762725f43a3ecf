"""One line of an atlas as the statements need it: plain arrays over the speed, and the regions found on them."""
import dataclasses
from collections.abc import Callable, Mapping, Sequence

import numpy as np
import numpy.typing as npt

from paper.verdict import NOTICEABLE, Finding, millimetres, not_covered

NONE, UNRESOLVED, APERIODIC = 0, 254, 255  # classes of motion; 1 to 16 are periods
NOT_COVERED, ABSENT, PRESENT, MERGED = 0, 1, 2, 3  # whether a region or trigger is there, as in MAPS.h5
ABSENCE = {NOT_COVERED: "not covered", ABSENT: "absent", MERGED: "merged with region 2"}
TRIGGER_RISE = 1.5  # a displacement rises steeply where it grows by this factor over STRETCH
STRETCH = 1.0 / 30.0  # scaled width of the stretches below and above a rise

Numbers = npt.NDArray[np.float64]


def _no_rows(_: str) -> Numbers | None:
    return None


@dataclasses.dataclass(frozen=True)
class Region:
    """A region as `rubatlas analyse` has found it; NaN where it is not there."""

    presence: int = NOT_COVERED
    start: float = np.nan  #: first Ω
    end: float = np.nan  #: last Ω
    share: float = np.nan  #: of aperiodic points
    peak: float = np.nan  #: [m]
    median: float = np.nan  #: [m] of the largest displacements
    open_ends: int = 0  #: 1: it may go on below, 2: above, 3: both; at a gap of the line, or where the grid ends
    cut_off: int = 0  #: those of them that lie at the end of the grid

    @property
    def present(self) -> bool:
        return self.presence == PRESENT

    @property
    def width(self) -> float:
        """Extent in Ω; 0 where the region is absent or merged, NaN where it is not known.

        The paper's pictures end where the grid does, and its regions with them.
        """
        if self.presence in (ABSENT, MERGED):
            return 0.0
        return self.end - self.start if self.open_ends == self.cut_off else np.nan

    @property
    def third(self) -> float:
        """A third of the extent in Ω."""
        return (self.end - self.start) / 3.0


@dataclasses.dataclass(frozen=True)
class Trigger:
    """A steep rise of the displacement near Ω = 1/n or 2/n."""

    presence: int = NOT_COVERED
    speed: float = np.nan
    rise: float = np.nan  #: [m]
    ratio: float = np.nan  #: displacement above over displacement below


@dataclasses.dataclass(frozen=True)
class Line:
    """`motion` holds a class for each speed, `displacement` is in m and NaN where a point is not done."""

    speed: Numbers
    motion: npt.NDArray[np.uint8]
    displacement: Numbers
    regions: Sequence[Region] = (Region(),) * 4
    triggers: Sequence[Trigger] = (Trigger(),) * 2
    doublings: Sequence[tuple[float, int]] = ()  #: Ω, and the period that doubles there
    doublings_in: str = "revolutions"  #: or "blade passings": the map on which doublings were looked for
    blades: int = 3
    parameters: Mapping[str, float] = dataclasses.field(default_factory=dict)  #: values on the axes of the atlas
    contact: npt.NDArray[np.uint8] | None = None  #: 0 not known, 1 no contact, 2 contact
    signs: Mapping[str, float] = dataclasses.field(default_factory=dict)  #: its row of /signature of the maps
    rows: Callable[[str], Numbers | None] = _no_rows  #: an observable by its name; None where it is not kept

    def scaled(self, speed: float) -> float:
        """Ω as scaled speed, at which the triggers lie at 1/3 and 2/3."""
        return speed * self.blades / 3.0

    def between(self, low: float, high: float) -> npt.NDArray[np.bool_]:
        """Which points have Ω in [low, high]."""
        return (self.speed >= low) & (self.speed <= high)

    def aperiodic_share(self, low: float, high: float) -> float:
        """Share of aperiodic points among the periodic and aperiodic ones; NaN where there are none."""
        motion = self.motion[self.between(low, high)]
        motion = motion[(motion != NONE) & (motion != UNRESOLVED)]
        return float(np.mean(motion == APERIODIC)) if motion.size else np.nan

    def displacements(self, low: float, high: float) -> Numbers:
        """Of the points that are done with Ω in [low, high], in the order of Ω."""
        values = self.displacement[self.between(low, high)]
        return values[np.isfinite(values)]

    def growth(self, values: Numbers, place: float) -> float:
        """Geometric mean of values over STRETCH above a place over that below; NaN without two points on a side."""
        distance = (self.speed - place) * self.blades / 3.0
        good = np.isfinite(values) & (values > 0.0)
        below = values[good & (distance < 0.0) & (distance >= -STRETCH)]
        above = values[good & (distance >= 0.0) & (distance <= STRETCH)]
        if min(below.size, above.size) < 2:
            return np.nan
        return float(np.exp(np.log(above).mean() - np.log(below).mean()))


def region_text(number: int, region: Region) -> str:
    if not region.present:
        return f"region {number}: {ABSENCE[region.presence]}"
    start, end = (f"({speed:.3f})" if region.open_ends & side else f"{speed:.3f}"
                  for speed, side in ((region.start, 1), (region.end, 2)))
    return (f"region {number}: {start}-{end}, {region.share:.0%} aperiodic, "
            f"peak {millimetres(region.peak)}")


def trigger_text(number: int, trigger: Trigger) -> str:
    if trigger.presence != PRESENT:
        return f"trigger {number}: {ABSENCE[trigger.presence]}"
    return f"trigger {number}: at {trigger.speed:.3f}, {1e3 * trigger.rise:+.3g} mm (×{trigger.ratio:.3g})"


def if_covered(presence: int, holds: bool) -> bool | None:
    return None if presence == NOT_COVERED else bool(holds)


def mostly(line: Line, low: float, high: float, aperiodic: bool, claim: str, majority: float = 0.5) -> Finding:
    """Aperiodic motion, or its absence, in most of a range of speeds."""
    share = line.aperiodic_share(low, high)
    if np.isnan(share):
        return not_covered(f"no point is done in {low:.3f}-{high:.3f}", claim)
    return Finding((share >= majority) == aperiodic, f"{share:.0%} aperiodic in {low:.3f}-{high:.3f}", claim,
                   f"{share:.0%}")


SUDDEN = 0.01  # [Ω] within which a sudden step happens: the paper's own, from 0.34 to 0.35
HALF = 0.5  # ... at least this part of it, in logarithms; steady growth over STRETCH has 0.3 of it there


def sudden_step(line: Line, place: float, claim: str) -> Finding:
    """Whether the displacement rises steeply at a place, and does so within SUDDEN."""
    ratio = line.growth(line.displacement, place)
    done = np.isfinite(line.displacement) & (line.displacement > 0.0)
    near = done & (np.abs((line.speed - place) * line.blades / 3.0) <= STRETCH)
    speed, logarithm = line.speed[near], np.log(line.displacement[near])
    if np.isnan(ratio) or speed.size < 4 or np.diff(speed).max() > SUDDEN * (1.0 + 1e-9):
        return not_covered(f"no points within {SUDDEN:g} of each other around {place:.3f}", claim)
    if ratio < TRIGGER_RISE:
        return Finding(False, f"no steep rise at {place:.3f}: ×{ratio:.3g}", claim, f"×{ratio:.2g}")
    last = np.searchsorted(speed, speed + SUDDEN * (1.0 + 1e-9), side="right") - 1
    steepest = float((logarithm[last] - logarithm).max())
    share = steepest / np.log(ratio)
    return Finding(bool(share >= HALF), f"×{np.exp(steepest):.3g} within {SUDDEN:g} of Ω, of ×{ratio:.3g} in all "
                   f"around {place:.3f}", claim, f"×{np.exp(steepest):.2g}")


def thirds(line: Line, region: Region) -> tuple[float, float] | None:
    """Median displacement in the first and the last third of a region; None where one of them has no points."""
    parts = [line.displacements(region.start, region.start + region.third),
             line.displacements(region.end - region.third, region.end)]
    return None if min(part.size for part in parts) == 0 else (float(np.median(parts[0])), float(np.median(parts[1])))


def course(line: Line, number: int, grows: bool, claim: str) -> Finding:
    """Whether the displacement grows (falls) along a region, from its first to its last third."""
    region = line.regions[number - 1]
    if not region.present:
        return Finding(if_covered(region.presence, False), region_text(number, region), claim)
    ends = thirds(line, region)
    if ends is None:
        return not_covered(f"region {number}: too few points to compare its ends", claim)
    first, last = ends
    holds = last >= (1.0 + NOTICEABLE) * first if grows else last <= (1.0 - NOTICEABLE) * first
    return Finding(bool(holds), f"median displacement {millimetres(first)} in the first third of region {number}, "
                   f"{millimetres(last)} in the last", claim, f"{last / first - 1.0:+.0%}")
