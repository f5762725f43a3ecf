#!/usr/bin/python3
"""The test rig, explained: which rigs do what the paper says of its own, and what the probes of one would show.

    ./jobs/rig.py unknowns [--ranks N] [--publish]   # every rig of rig_unknowns.json, judged: table and picture
    ./jobs/rig.py measured [--ranks N] [--publish]   # rig_measured.json beside the rig at constant speed

Atlases and tables go to atlases/, pictures to pictures/; --publish renews the pictures of tools/pictures. Called again,
it goes on where it was stopped. What it has found is in rig.md.
"""
import argparse
import itertools
import json
import os
import pathlib
import subprocess
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "tools"), str(ROOT / "analysis")]

from paper import rig, spectra  # noqa: E402
from paper.atlas_lines import AtlasLines  # noqa: E402
from rubatlas import command_line, style  # noqa: E402
from rubatlas.atlas_file import AtlasFile  # noqa: E402
from rubatlas.plots.waterfall import by_frequency, mark_orders  # noqa: E402
from rubatlas.program import find_program  # noqa: E402

# --- the rigs ---

STATEMENTS = {"P10": "four orbits", "P11a": "3× peak", "P11b": "band of region 2", "P11c": "band of region 4",
              "P14a": "regions", "P14b": "step at 1/3", "P14c": "region 2 falls", "P14d": "region 4 grows"}
FEW = 0.01  # of the rigs: a statement that holds on fewer is counted finding by finding
# [Pa] The atlas has a rotor of 1 kg, and E: a rotor of m kg with blades of steel moves as it does with STEEL/m.
STEEL = 206e9
# Axis of the atlas → what it stands for, and its values as they are shown.
UNKNOWNS = {
    "blades_youngs_modulus": ("modal mass [kg]", lambda value: STEEL / value),
    "friction": ("friction μ", lambda value: value),
    "unbalance": ("eccentricity [mm]", lambda value: 1e3 * value),
    "unbalance_phase": ("phase [°]", np.degrees),
    "blades_length": ("worn [mm]", lambda value: 1e3 * (0.04 - value)),
    "unequal_blades_length_spread": ("uneven [mm]", lambda value: 1e3 * value),
}


def rigs(path):
    """What holds of each rig of an atlas: its unknowns, the statements, and their findings."""
    found = []
    with AtlasLines(path) as atlas:
        first_phase = atlas.values["unbalance_phase"][0]
        for line in atlas.lines:
            unknowns = {name: float(show(line.parameters[name])) for name, (_, show) in UNKNOWNS.items()}
            if line.parameters["unbalance"] == 0.0 and line.parameters["unbalance_phase"] != first_phase:
                continue  # the same rig again: nothing has a phase
            findings = {**rig.judge_line(line), **spectra.judge_line(line, atlas.orders())}
            findings = {name: findings[name] for name in STATEMENTS}
            # What an atlas does not cover does not hold here.
            holds = {name: all(part.holds is True for part in parts) for name, parts in findings.items()}
            found.append((unknowns, holds, findings))
    return found


def parts_of(judged):
    """What is counted: on which rigs each statement holds, or, where it holds on few, each of its findings."""
    parts = {}
    for name, words in STATEMENTS.items():
        whole = [holds[name] for _, holds, _ in judged]
        if np.mean(whole) >= FEW:
            parts[f"{name} {words}"] = whole
            continue
        for at, finding in enumerate(judged[0][2][name]):
            parts[f"{name} {finding.claim}"] = [findings[name][at].holds is True for _, _, findings in judged]
    return {words: np.array(holds, dtype=int) for words, holds in parts.items()}


def together(parts):
    """On how many rigs two parts hold, for each pair; on the diagonal each one alone."""
    holds = np.array([*parts.values()])
    return holds @ holds.T


def table(judged):
    """What holds on how many rigs, which pairs exclude each other, and the rigs on which most holds: as Markdown."""
    count = len(judged)
    rows = ["| statement | finding | rigs | % |", "|---|---|--:|--:|"]
    for name, words in STATEMENTS.items():
        whole = sum(holds[name] for _, holds, _ in judged)
        rows.append(f"| {name} {words} | **all of it** | {whole} | {100 * whole / count:.1f} |")
        for at, finding in enumerate(judged[0][2][name]):
            holding = sum(findings[name][at].holds is True for _, _, findings in judged)
            rows.append(f"| | {finding.claim} | {holding} | {100 * holding / count:.1f} |")
    parts = parts_of(judged)
    pairs, words = together(parts), list(parts)
    apart = [f"{words[one]} and {words[other]}" for one, other in itertools.combinations(range(len(words)), 2)
             if pairs[one, one] and pairs[other, other] and not pairs[one, other]]
    ranked = sorted(judged, key=lambda one: (-sum(one[1].values()), -findings_of(one)))
    rare = [name for name in STATEMENTS if 0 < sum(holds[name] for _, holds, _ in judged) < FEW * count]
    shown = ranked[:8] + [one for one in ranked[8:] if any(one[1][name] for name in rare)]
    rows += ["", f"{count} rigs. On none of them: "
             f"{listed(name for name in STATEMENTS if not any(holds[name] for _, holds, _ in judged))}.",
             f"Each on some rig and never both on one: {listed(apart, '; ')}.", "",
             f"On {sum(all(holds.values()) for _, holds, _ in judged)} rigs all {len(STATEMENTS)} statements hold. "
             f"Those on which most hold{''.join(f', and all with {name}' for name in rare)}:", "",
             "| " + " | ".join([*(heading for heading, _ in UNKNOWNS.values()), "holds", "findings"]) + " |",
             "|" + len(UNKNOWNS) * "--:|" + "---|--:|"]
    for one in shown:
        unknowns, holds, _ = one
        rows.append("| " + " | ".join([*(f"{value:.3g}" for value in unknowns.values()),
                                       listed(name for name, true in holds.items() if true),
                                       str(findings_of(one))]) + " |")
    return "\n".join(rows) + "\n"


def findings_of(one):
    """How many findings hold of a rig."""
    return sum(finding.holds is True for findings in one[2].values() for finding in findings)


def listed(words, between=", "):
    return between.join(words) or "none"


def draw_rigs(judged, options):
    """Pairs of what is counted, and each of it over each unknown."""
    parts = parts_of(judged)
    figure, ((pairs, shares),) = style.subplots(options, 1, 2, (15.0, 0.36 * len(parts) + 1.9), widths=[1.0, 1.15])
    numbers = together(parts)
    cells_into(pairs, numbers, np.sqrt(numbers / max(numbers.max(), 1)), [words.split()[0] for words in parts], parts)
    pairs.set_title(f"rigs of {len(judged)} on which both hold (on the diagonal: on which one holds)")
    pairs.tick_params(axis="x", rotation=90)
    columns = [(name, value) for name in UNKNOWNS for value in sorted({unknowns[name] for unknowns, _, _ in judged})]
    having = np.array([[unknowns[name] == value for unknowns, _, _ in judged] for name, value in columns])
    share = np.array([[holds[rigs_with].mean() for rigs_with in having] for holds in parts.values()])
    cells_into(shares, np.rint(100 * share).astype(int), share, [f"{value:.3g}" for _, value in columns],
               [words.split()[0] for words in parts])
    shares.set_title("% of the rigs with this value on which each holds")
    start = -0.5
    for name, (words, _) in UNKNOWNS.items():
        width = sum(one == name for one, _ in columns)
        shares.axvline(start, color="white", lw=3)
        shares.annotate(words.replace(" [", "\n["), (start + 0.5 * width, len(parts) - 0.5), xytext=(0, -26),
                        textcoords="offset points", ha="center", va="top", fontsize=8, annotation_clip=False)
        start += width
    style.headline(figure, "Which test rigs do what the paper says of its own")
    style.save(figure, options)


def cells_into(panel, numbers, shade, columns, rows):
    """A table of numbers, shaded from 0 to 1."""
    panel.imshow(shade, cmap=style.SEQUENTIAL, vmin=0.0, vmax=1.0, aspect="auto")
    for (row, column), number in np.ndenumerate(numbers):
        panel.text(column, row, number, ha="center", va="center", fontsize=8,
                   color="white" if shade[row, column] < 0.6 else style.INK)
    panel.set_xticks(range(len(columns)), columns, fontsize=8)
    panel.set_yticks(range(len(rows)), list(rows), fontsize=8)
    panel.grid(False)


# --- what the probes would show ---

SPEEDS = (0.13, 0.83)  # Ω of 250 and 1500 rpm, and a little around
REPEATS = 0.01  # a motion repeats itself where its sections do, within this share of the orbit: the blades are worn on
PERIODS = range(1, 9)


def probe(displacement):
    """Reading of a probe [m] for a displacement of the hub [m]."""
    return np.clip(np.asarray(displacement) / rig.LEVER, -rig.PROBE_LIMIT, rig.PROBE_LIMIT)


def repeats(sections):
    """Whether sections (…, 4), without their first half, which may approach a motion, repeat themselves."""
    last = sections[len(sections) // 2:]
    size = np.linalg.norm(last, axis=1).max()
    return any(np.linalg.norm(last[period:] - last[:-period], axis=1).max() <= REPEATS * size for period in PERIODS)


def held(speed):
    """Slices of points that stand for one held speed: such points are apart by a hundred-millionth of it."""
    first = [0, *(np.flatnonzero(np.diff(speed) > 1e-6 * speed[1:]) + 1), len(speed)]
    return [slice(*ends) for ends in itertools.pairwise(first)]


class Record:
    """One line of an open atlas, speed by speed as it was held."""

    def __init__(self, line):
        atlas, speed = line.atlas, line.atlas.axis("speed_ratio")
        parts = held(speed)
        sections, largest, spectrum = (line.rows(name) for name in ("poincare", "max_displacement", "spectrum"))
        self.order, self.sizes, self.blades = atlas.axis("order"), atlas.sizes(), atlas.scene["blades"]["count"]
        worn = line.rows("final_state_wear").max(axis=-1) if "final_state_wear" in atlas else np.zeros(len(speed))
        self.speed = np.array([speed[part][0] for part in parts])
        self.sections = [sections[part].reshape(-1, 4) for part in parts]
        self.largest = np.array([largest[part].max() for part in parts])
        self.spectrum = np.array([np.sqrt((spectrum[part]**2).mean(axis=0)) for part in parts])
        self.worn = np.array([worn[part][-1] for part in parts])
        self.periodic = np.array([repeats(one) for one in self.sections])

    def within(self, low, high):
        """Which held speeds are in a range, and have a motion."""
        return (self.speed >= low) & (self.speed <= high) & np.isfinite(self.largest)


# Ranges of the measured regions, P14a.
RANGES = {"region 1": rig.REGION_1, "region 2": rig.REGION_2, "chaos in region 3": rig.CHAOS_IN_REGION_3,
          "rest of region 3": rig.REST_OF_REGION_3, "region 4": rig.REGION_4}


def ranges_table(records):
    """Per measured range: how many of the held speeds do not repeat themselves, and the displacement at its ends."""
    rows = ["| Ω | " + " | ".join(f"{name}: aperiodic, displacement [mm], largest at" for name in records) + " |",
            "|---|" + len(records) * "---|"]
    for words, (low, high) in RANGES.items():
        cells = []
        for record in records.values():
            inside = record.within(low, high)
            if not inside.any():
                cells.append("no speed")
                continue
            largest = 1e3 * record.largest[inside]
            peak = record.speed[inside][largest.argmax()]
            cells.append(f"{100 * np.mean(~record.periodic[inside]):.0f} %, {largest[0]:.3f} to {largest[-1]:.3f}, "
                         f"{largest.max():.3f} at {peak:.3f}")
        rows.append(f"| {words}, {low:g}-{high:g} | " + " | ".join(cells) + " |")
    return "\n".join(rows) + "\n"


def repetitions_table(repetitions):
    """Per repetition of the measurement: how many of the held speeds in each range do not repeat themselves."""
    rows = ["| me [kg m] | phase [°] | " + " | ".join(f"{low:g}-{high:g}" for low, high in RANGES.values()) +
            " | worn [mm] |", "|--:|--:|" + len(RANGES) * "--:|" + "--:|"]
    for (unbalance, phase), record in repetitions.items():
        shares = [np.mean(~record.periodic[inside]) if (inside := record.within(*ends)).any() else np.nan
                  for ends in RANGES.values()]
        rows.append(f"| {unbalance:g} | {np.degrees(phase):.0f} | " +
                    " | ".join(f"{100 * share:.0f} %" for share in shares) + f" | {1e3 * record.worn[-1]:.2f} |")
    return "\n".join(rows) + "\n"


def draw_records(records, options):
    """A column for each record: sections and largest displacement at the probes, and the waterfall."""
    figure, grid = style.subplots(options, 3, len(records), (12.0, 9.0), heights=[2.2, 1.6, 3.0])
    spectra_shown = {name: 1e3 * record.spectrum / rig.LEVER for name, record in records.items()}
    top = max(one[:, 1:].max() for one in spectra_shown.values())
    for (name, record), (sections, largest, waterfall) in zip(records.items(), grid.T):
        for periodic, colour in ((True, style.BLUE), (False, style.VERMILION)):
            chosen = [at for at, one in enumerate(record.periodic) if one == periodic]
            if not chosen:
                continue
            where = np.concatenate([np.full(len(record.sections[at]), record.speed[at]) for at in chosen])
            x = np.concatenate([1e3 * probe(record.sections[at][:, 0]) for at in chosen])
            sections.plot(where, x, ".", color=colour, ms=1.6, mew=0, alpha=0.6, rasterized=True,
                          label="repeats itself" if periodic else "does not")
        sections.set_title(f"{name} (grey: ranges of the measured regions)")
        style.rpm_axis(sections, record.sizes)
        largest.plot(record.speed, 1e3 * probe(record.largest), color=style.INK, lw=1.0, label="largest displacement")
        if record.worn.any():
            largest.plot(record.speed, 1e3 * record.worn, color=style.GREEN, lw=1.0, label="worn off a blade")
        largest.legend(loc="upper left")
        for at, (low, high) in enumerate(RANGES.values()):
            for panel in (sections, largest):
                panel.axvspan(low, high, color=style.GREY, alpha=0.06 + 0.10 * (at % 2), lw=0, zorder=0)
        frequency = np.linspace(0.0, 3.0, 361)
        shown = by_frequency(record.speed, record.order, spectra_shown[name], frequency)
        image = waterfall.pcolormesh(
            frequency, style.edges_of(record.speed), np.maximum(shown, 1e-4 * top), cmap="magma", rasterized=True,
            norm=style.matplotlib.colors.LogNorm(1e-4 * top, top))
        waterfall.grid(False)
        waterfall.set_ylim(*SPEEDS)
        mark_orders(waterfall, frequency[-1], record.blades)
        waterfall.set_xlabel("frequency / natural frequency [-]")
        largest.set_xlabel("speed ratio Ω [-]")
    for row, words in zip(grid, ("x at the section, probe [mm]", "at the probe [mm]", "speed ratio Ω [-]")):
        style.label_row(options, row, words)
    for row in grid[:2]:
        low, high = min(panel.get_ylim()[0] for panel in row), max(panel.get_ylim()[1] for panel in row)
        for panel in row:
            panel.set(xlim=SPEEDS, ylim=(low, high))
    grid[0][0].legend(loc="lower left", markerscale=6)
    figure.colorbar(image, ax=grid[2].tolist(), label="spectrum of x, probe [mm]")
    style.headline(figure, "The test rig at constant speed, and as its probes would show it")
    style.save(figure, options)


# --- run, analyse ---

def computed(scene, options):
    """The atlas of a scene, complete; its maps beside it."""
    atlas = options.into / f"{scene.stem}.h5"
    options.into.mkdir(parents=True, exist_ok=True)
    program = find_program()
    launcher = ["mpirun", "--oversubscribe", "--bind-to", "none", "-n", str(options.ranks)] if options.ranks > 1 else []
    ended = subprocess.run([*launcher, program, "run", scene, "-o", atlas, "--resume"], check=False)
    # 10: some points could not be integrated; the others are judged.
    if ended.returncode not in (0, 10):
        sys.exit(f"rig.py: {atlas} is not complete; the same command goes on")
    subprocess.run([program, "analyse", atlas, "-o", atlas.with_name(f"{scene.stem}_maps.h5"), "--overwrite"],
                   check=True, stdout=subprocess.DEVNULL)
    return str(atlas)


def unknowns(options):
    judged = rigs(computed(options.scene or ROOT / "jobs/rig_unknowns.json", options))
    return table(judged), lambda picture: draw_rigs(judged, picture)


def measured(options):
    beside, scene = computed(options.beside, options), options.scene or ROOT / "jobs/rig_measured.json"
    with AtlasFile(beside) as constant, AtlasFile(computed(scene, options)) as raised:
        records = {"constant speed, balanced, no wear": Record(constant.line(friction=0.2)),
                   "as measured": Record(raised.line())}
        repetitions = {(unbalance, phase): Record(raised.line(unbalance=unbalance, unbalance_phase=phase))
                       for unbalance in raised.axis("unbalance") for phase in raised.axis("unbalance_phase")}
    return ranges_table(records) + "\n" + repetitions_table(repetitions), lambda picture: draw_records(records, picture)


def main():
    command_line.end_with_the_reader()
    arguments = command_line.Arguments(__doc__)
    arguments.add_argument("what", choices=("unknowns", "measured"))
    arguments.add_argument("--scene", type=pathlib.Path, help="in place of rig_unknowns.json, rig_measured.json")
    arguments.add_argument("--beside", type=pathlib.Path, default=ROOT / "jobs/rig.json",
                           help="what stands beside rig_measured.json: a scene with the friction 0.2")
    arguments.add_argument("--ranks", type=int, default=os.cpu_count())
    arguments.add_argument("--into", type=pathlib.Path, default=ROOT / "atlases", help="where atlases go")
    arguments.add_argument("--pictures", type=pathlib.Path, default=ROOT / "pictures", help="where pictures go")
    arguments.add_argument("--publish", action="store_true", help="into tools/pictures, too")
    options = arguments.parse_args()
    command_line.end_on_mistakes(lambda: carry_out(options))


def carry_out(options):
    words, draw = {"unknowns": unknowns, "measured": measured}[options.what](options)
    print(words, end="")
    (options.into / f"rig_{options.what}.md").write_text(words)
    for folder in (options.pictures, *([ROOT / "tools/pictures"] if options.publish else [])):
        folder.mkdir(parents=True, exist_ok=True)
        draw(argparse.Namespace(output=folder / f"rig_{options.what}.png", dpi=65.0, width=None))


if __name__ == "__main__":
    main()
