"""Which speeds are safe: where all lines of an atlas keep limits, and how far a speed is from where they do not.

A limit is a dataset with one number per point, or one of the maps, <= or >=, and a number, with a unit or without
(`rubatlas.query`). A speed is safe if every line keeps every limit there, and no motion is aperiodic. What does not
occur keeps its limit: a miss where no tip passes the ring, a margin where the motion never changes. A point that is not
done keeps none. A run-up, whose speed ramps, is judged by its limits alone: no motion repeats itself in it.
"""
import numpy as np

from rubatlas import query
from rubatlas.atlas_file import DIRECTIONS, DONE, LEFT_VALIDITY, AtlasError, same_value, swept_pointers, words_of

# Datasets in which NaN means that there is nothing to keep away from.
MAY_NOT_OCCUR = ("nearest_miss", "lightest_touch", "margin")
OF_MAPS = {"margin": "margins/along_speed_ratio", "class": "class"}
APERIODIC_CLASS = 255
# Why a speed is in no band, besides the limits. What is not done or not selected is not known to be dangerous, so that
# a band is open there.
LEFT, NOT_DONE, NOT_SELECTED = "the motion leaves the model", "not done", "not selected"
APERIODIC, NARROW = "the motion is aperiodic", "the band is too narrow"
# A limit this many times beyond every value is more likely one in another unit, which differ by 9.8, 25.4, or 1000.
WIDE = 9.0
PER_SPEED = {"rpm": "rpm", "hz": "Hz"}


class JudgedLimit:
    """A limit, and the values that it limits: (lines, speeds), NaN where the point is not done."""

    def __init__(self, text, atlas, maps, chosen, sizes):
        limit = query.Limit.read(text)
        self.given, self.name, self.sign, self.sizes = text, limit.name, limit.sign, sizes
        source, name = atlas, self.name
        if self.name in OF_MAPS:
            source, name = maps, OF_MAPS[self.name]
            if maps is None:
                raise AtlasError(f"limit {text}: this is in the maps of the atlas, "
                                 "which `rubatlas analyse` makes and --maps (maps=) names")
            if name not in maps:
                raise AtlasError(f"limit {text}: {maps.path} has no /{name}")
        dataset = source.dataset(name)
        if dataset.ndim != len(atlas.axes):
            raise AtlasError(f"limit {text}: /{name} has more than one number per point")
        self.units = source.units(name)
        self.bound = limit.bound(self.units, self.sizes)
        self.text = f"{self.name} {'≤' if self.sign == '<=' else '≥'} {self.shown(self.bound)}"
        self.brief = self.text.split(",")[0]
        self.status = atlas.dataset("status")[...][chosen]
        values = np.where(self.status == DONE, dataset[...][chosen].astype(float), np.nan)
        self.flags = bool(words_of(dataset.attrs))
        if self.name == "class":
            values[values == 0] = np.nan  # no class was found, which keeps no limit
        self.values, self.status = (one.reshape(-1, one.shape[-1]) for one in (values, self.status))

    def shown(self, value):
        return query.shown(value, query.units_of(self.name, self.units), self.sizes)

    def kept(self):
        kept = self.values <= self.bound if self.sign == "<=" else self.values >= self.bound
        return kept | np.isnan(self.values) if self.name in MAY_NOT_OCCUR else kept

    def worst(self):
        """The value of the line that is nearest to breaking the limit, speed by speed."""
        with np.errstate(all="ignore"):
            return np.fmax.reduce(self.values, axis=0) if self.sign == "<=" else np.fmin.reduce(self.values, axis=0)

    def idle(self):
        """A sentence where every value keeps the limit by a wide distance, as one in a wrong unit does; else none."""
        found = self.values[np.isfinite(self.values)]
        if not found.size and self.name in MAY_NOT_OCCUR:
            return f"{self.text} limits nothing: no point has a {self.name}"
        if self.flags or not found.size or not self.kept()[np.isfinite(self.values)].all():
            return None
        most, end = (found.max(), "largest") if self.sign == "<=" else (found.min(), "smallest")
        if (WIDE * most > self.bound) if self.sign == "<=" else (WIDE * self.bound > most):
            return None
        return f"{self.text} limits nothing: the {end} value is {self.shown(most)}"


def bands_of(safe):
    """First and last place of each run of safe speeds."""
    steps = np.flatnonzero(np.diff(np.concatenate([[0], safe.astype(int), [0]])))
    return list(zip(steps[::2], steps[1::2] - 1))


def margin_percent(low, high):
    """By how many percent the speed in the middle may be off on either side."""
    return 100.0 * (high - low) / (high + low)


def worded(reasons):
    return " and ".join(reason if reason in (LEFT, NOT_DONE, NOT_SELECTED, APERIODIC, NARROW) else f"not {reason}"
                        for reason in reasons)


class Judgement:
    """Which limits are kept where.

    `chosen`: the lines to judge, as an index of the grid with all speeds. `selected`: the points of the grid to judge;
    a speed at which a line is not selected is in no band. `aperiodic`: aperiodic motions may be safe, too; so may they
    where a limit on the class says which motions are. `least_width`: of a band, in speed ratio or as a text with a
    unit; one speed alone is no band in any case.
    """

    def __init__(self, atlas, maps, texts, chosen, selected=None, *, aperiodic=False, least_width=0.0):
        self.atlas, self.maps, self.chosen = atlas, maps, chosen
        self.speed, self.sizes = atlas.axis("speed_ratio"), atlas.sizes(chosen)
        self.limits = [JudgedLimit(text, atlas, maps, chosen, self.sizes) for text in texts]
        self.status = self.limits[0].status
        self.left = (self.status == LEFT_VALIDITY).any(axis=0)
        self.undone = ((self.status != DONE) & (self.status != LEFT_VALIDITY)).any(axis=0)
        self.broken = np.array([((self.status == DONE) & ~limit.kept()).any(axis=0) for limit in self.limits])
        self.unselected = np.zeros(len(self.speed), dtype=bool)
        if selected is not None:
            self.unselected = ~selected[chosen].reshape(self.status.shape).all(axis=0)
        self.aperiodic = np.zeros(len(self.speed), dtype=bool)
        self.ramps = bool((atlas.scene.get("speed_ramp") or {}).get("rate")) or \
            ("speed_ramp", "rate") in swept_pointers(atlas.scene).values()
        aperiodic = aperiodic or self.ramps
        if maps is not None and not aperiodic and "class" not in [limit.name for limit in self.limits]:
            classes = maps.dataset("class")[...][chosen].reshape(self.status.shape)
            self.aperiodic = ((classes == APERIODIC_CLASS) & (self.status == DONE)).any(axis=0)
        self.aperiodic_may_be_safe = aperiodic
        self.kept = ~(self.broken.any(axis=0) | self.left | self.undone | self.unselected | self.aperiodic)
        self.least_width = self.speed_of(least_width)
        self.safe = np.zeros(len(self.speed), dtype=bool)
        for first, last in bands_of(self.kept):
            wide = last > first and self.speed[last] - self.speed[first] >= self.least_width
            self.safe[first:last + 1] = wide

    # --- speeds in words ---

    def speed_of(self, given):
        """A speed ratio from a number, or from a text such as "540 rpm"."""
        return query.Limit.read(f"speed_ratio == {given}", ("==",)).bound("-", self.sizes)

    def shown(self, speed_ratio):
        plain, *others = query.shown(speed_ratio, "speed", self.sizes).split(", ")
        return f"Ω {plain}" + (f" ({', '.join(others)})" if others else "")

    def shown_range(self, low, high):
        both = [f"{query.expressed(low, unit, self.sizes):.4g} to {query.expressed(high, unit, self.sizes):.4g} {unit}"
                for unit in PER_SPEED.values() if query.expressed(low, unit, self.sizes) is not None]
        return f"Ω {low:g} to {high:g}" + (f" ({', '.join(both)})" if both else "")

    # --- bands ---

    def reasons(self, place):
        """What is not kept at a speed."""
        if self.unselected[place]:
            return [NOT_SELECTED]
        reasons = [limit.brief for limit, broken in zip(self.limits, self.broken[:, place]) if broken]
        others = ((self.aperiodic, APERIODIC), (self.left, LEFT), (self.undone, NOT_DONE),
                  (self.kept & ~self.safe, NARROW))
        return reasons + [reason for where, reason in others if where[place]]

    def beyond(self, place):
        """What ends a band at its neighbour `place`; nothing beyond the grid."""
        if not 0 <= place < len(self.speed):
            return {"open": True, "broken": []}
        reasons = self.reasons(place)
        return {"speed_ratio": float(self.speed[place]), "open": reasons in ([NOT_DONE], [NOT_SELECTED]),
                "broken": reasons}

    def bands(self):
        found = []
        for first, last in bands_of(self.safe):
            low, high = float(self.speed[first]), float(self.speed[last])
            found.append({"from": low, "to": high, "points": int(last - first + 1), "middle": 0.5 * (low + high),
                          "margin_percent": margin_percent(low, high), **self.in_units("from", low),
                          **self.in_units("to", high),
                          "below": self.beyond(first - 1), "above": self.beyond(last + 1)})
        return found

    def in_units(self, name, speed_ratio):
        """A speed in rpm and Hz, where the lines have one natural frequency."""
        found = {f"{name}_{key}": query.expressed(speed_ratio, unit, self.sizes) for key, unit in PER_SPEED.items()}
        return {key: value for key, value in found.items() if value is not None}

    def at(self, operate):
        """How an operating speed stands: in which band, and how far in percent the nearest unsafe speeds are."""
        speed_ratio = self.speed_of(operate)
        nearest = float(self.speed[np.argmin(abs(self.speed - speed_ratio))])
        if same_value(nearest, speed_ratio):
            speed_ratio = nearest
        if not self.speed[0] <= speed_ratio <= self.speed[-1]:
            raise AtlasError(f"operating speed {self.shown(speed_ratio)}: outside the atlas, which has "
                             f"{self.shown_range(self.speed[0], self.speed[-1])}")
        bands = self.bands()
        result = {"speed_ratio": speed_ratio, **self.in_units("speed", speed_ratio)}
        start = f"At {self.shown(speed_ratio)}"
        band = next((band for band in bands if band["from"] <= speed_ratio <= band["to"]), None)
        if band is not None:
            below, above = (100.0 * abs(speed_ratio - band[end]) / speed_ratio for end in ("from", "to"))
            ways = [f"{way} that holds for {percent:.1f} %{' or more' if band[side]['open'] else ''}, to "
                    f"Ω {band[end]:g} ({'beyond it ' if band[side]['broken'] else ''}{end_text(band[side])})"
                    for way, percent, side, end in (("downwards", below, "below", "from"),
                                                    ("upwards", above, "above", "to"))]
            return {**result, "safe": True, "below_percent": below, "above_percent": above,
                    "open_below": band["below"]["open"], "open_above": band["above"]["open"],
                    "text": f"{start} every limit is kept in {self.sweeps()}; {', '.join(ways)}."}
        # Between two speeds of the grid what is not kept at one of them.
        places = {int(np.searchsorted(self.speed, speed_ratio, side="right")) - 1,
                  int(np.searchsorted(self.speed, speed_ratio))}
        broken = list(dict.fromkeys(reason for place in sorted(places) if not self.safe[place]
                                    for reason in self.reasons(place)))
        ends = [end for band in bands for end in (band["from"], band["to"])]
        closest = min(ends, key=lambda end: abs(end - speed_ratio), default=None)
        way = "no band of speeds is" if closest is None else \
            (f"the nearest safe speed is {self.shown(closest)}, {100.0 * abs(closest / speed_ratio - 1.0):.1f} % "
             f"{'lower' if closest < speed_ratio else 'higher'}")
        return {**result, "safe": False, "broken": broken, "nearest_safe": closest,
                "text": f"{start} the rotor is not safe in {self.sweeps()}: {worded(broken)}; {way}."}

    # --- other motions ---

    def directions(self):
        """The sweeps that are judged, of an atlas that has both; none of another one."""
        return [DIRECTIONS[place] for place in self.chosen[0].ravel()] if self.atlas.axes[0] == "direction" else []

    def sweeps(self):
        """The motions that are judged."""
        directions = self.directions()
        if len(directions) == 2:
            return "both sweeps"
        sweep = self.atlas.scene.get("sweep", "up")
        if sweep == "independent":
            return f"the motions from the initial state{'s of the grid' if self.initial_is_swept() else ''}"
        return f"the sweep {directions[0] if directions else sweep}"

    def initial_is_swept(self):
        return any(section == "initial" for section, _ in swept_pointers(self.atlas.scene).values())

    def other_motions(self):
        """Where in the bands the sweeps up and down have not one motion, or one of them does not keep the limits."""
        directions = self.directions()
        if not directions:
            return []
        both = np.arange(2).reshape([2] + [1] * (len(self.atlas.axes) - 1)), *self.chosen[1:]
        differ = np.zeros(len(self.speed), dtype=bool)
        if self.maps is not None and "attractor" in self.maps:
            up, down = self.maps.dataset("attractor")[...][both].reshape(2, -1, len(self.speed))
            differ = ((up != down) & (up > 0) & (down > 0)).any(axis=0)
        if len(directions) == 2:
            return [self.motion(first, last, "two motions are possible, both of which keep every limit", True)
                    for first, last in bands_of(self.safe & differ)]
        other = DIRECTIONS[1 - DIRECTIONS.index(directions[0])]
        judged = Judgement(self.atlas, self.maps, [limit.given for limit in self.limits],
                           (both[0][DIRECTIONS.index(other)][None], *self.chosen[1:]),
                           aperiodic=self.aperiodic_may_be_safe)
        found = [self.motion(first, last, f"the sweep {other} has another motion, which keeps every limit", True)
                 for first, last in bands_of(self.safe & judged.kept & differ)]
        for first, last in bands_of(self.safe & ~judged.kept):
            reasons = list(dict.fromkeys(one for place in range(first, last + 1) for one in judged.reasons(place)))
            found.append(self.motion(first, last, f"the sweep {other} is not safe: {worded(reasons)}", False))
        return sorted(found, key=lambda one: one["from"])

    def motion(self, first, last, what, keeps):
        low, high = float(self.speed[first]), float(self.speed[last])
        return {"from": low, "to": high, "keeps_every_limit": keeps,
                "text": f"at {self.shown_range(low, high) if last > first else self.shown(low)} {what}"}

    # --- all that is to be said ---

    def notes(self):
        found = [note for limit in self.limits if (note := limit.idle())]
        if self.ramps:
            found.append("run-ups are judged by these limits alone: while the speed ramps no motion repeats itself")
        if self.maps is None and not self.aperiodic_may_be_safe:
            found.append("aperiodic motions are not left out, since the maps of `rubatlas analyse` are not here")
        narrow = bands_of(self.kept & ~self.safe)
        if narrow:
            least = f"no wider than one speed or narrower than {self.least_width:g} in Ω" if self.least_width > 0.0 \
                else "of one speed"
            found.append(f"left out are bands {least}: {len(narrow)}")
        directions = self.directions()
        if len(directions) == 1 and not self.other_motions():
            found.append("the other sweep keeps every limit in these bands, too")
        if not directions:
            more = "" if self.initial_is_swept() else ', and "sweep": "both" in the scene looks for it'
            found.append(f"safe is said of {self.sweeps()} alone; "
                         f"another motion may be possible at the same speed{more}")
        return found

    def result(self, operate=None):
        """Bands, what they are said of, what else is possible there; and how an operating speed stands."""
        found = {"limits": [{"text": limit.text, "name": limit.name, "sign": limit.sign, "bound": limit.bound,
                             "units": limit.units} for limit in self.limits],
                 "said_of": self.sweeps(), "bands": self.bands(), "other_motions": self.other_motions(),
                 "notes": self.notes()}
        return found if operate is None else {**found, "operate": self.at(operate)}

    def sentences(self, result):
        """A result, for people."""
        yield f"safe in {result['said_of']}, for {', '.join(limit.text for limit in self.limits)}:"
        for band in result["bands"]:
            yield (f"{self.shown_range(band['from'], band['to'])}: ±{band['margin_percent']:.1f} % about "
                   f"{band['middle']:.4g}; below: {end_text(band['below'])}; above: {end_text(band['above'])}")
        if not result["bands"]:
            yield "no band of speeds keeps these limits"
        yield from (motion["text"] for motion in result["other_motions"])
        yield from (f"note: {note}" for note in result["notes"])
        if "operate" in result:
            yield result["operate"]["text"]


def end_text(end):
    return f"{worded(end['broken'])} at {end['speed_ratio']:g}" if end["broken"] else "the grid ends"
