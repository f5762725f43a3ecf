"""How hard a grazing contact kicks the rotor, on the three sides of top dead centre, over the depth of the contact.

  rubatlas-plot grazing build/rubatlas -o PICTURE.png [--table]

An experiment: the program computes one revolution of the default rotor with one blade, from initial states that free
motion leads to a contact of a given depth d, on the approaching side (s ct = 1 mm), head-on (ct = 0) and on the
receding side (s ct = -1 mm), for both contact laws. The kick is the velocity by which the end of the revolution differs
from free motion, taken back to the time of the grazing. `--table` prints slopes, d(log kick)/d(log d), as a table.
"""
import json
import os
import pathlib
import subprocess
import tempfile

import h5py
import numpy as np

from rubatlas import command_line
from rubatlas import style
from rubatlas.atlas_file import AtlasError

SPEED_RATIO, DAMPING, NATURAL_FREQUENCY = 0.5, 0.1, 10.0
RING, REACH, MISALIGNMENT = 0.11, 0.1, 0.01001  # R, rh + L, y0 [m]: the default rotor (src/model.md, 6.1)
SIDES = {"approaching": (1e-3, style.BLUE, "o"), "head-on": (0.0, style.GREEN, "s"),
         "receding": (-1e-3, style.VERMILION, "^")}
LAWS = {"elastica": "elastic blades", "elastic_ring": "rigid blades, elastic ring"}
DEPTHS = np.logspace(-6, -12, 13)  # [m]; below it the kicks of a ring that yields are lost in rounding
GRAZING_TIME = 0.5 * np.pi / SPEED_RATIO  # the blade points along y


def free_motion(duration):
    """(place, velocity) after a time [τ] against that before, for the deflection from the equilibrium of the shaft."""
    frequency = np.sqrt(1.0 - DAMPING**2)
    decay, c, s = np.exp(-DAMPING * duration), np.cos(frequency * duration), np.sin(frequency * duration) / frequency
    return decay * np.array([[c + DAMPING * s, s], [-s, c - DAMPING * s]])


def grazing_state(depth, side):
    """Place and velocity z, z' of a free motion in which the tip passes through its greatest radius, R + depth."""
    radial = np.sqrt((RING + depth)**2 - side**2)  # of the tip, along the blade
    across = side
    tangential_velocity = 0.0
    radial_velocity = -across * (tangential_velocity + REACH * SPEED_RATIO) / radial
    along, turned = 1j, -1.0  # er and et of the blade that points along y, as complex numbers
    place = (radial - REACH) * along + across * turned - 1j * MISALIGNMENT
    return np.array([place, radial_velocity * along + tangential_velocity * turned])


def kick(program, folder, law, depth, side):
    """|Δz'| of a grazing [m per unit τ]."""
    at_grazing = grazing_state(depth, side)
    start = np.linalg.solve(free_motion(GRAZING_TIME), at_grazing)
    scene = {"title": "grazing", "rotor": {"damping_ratio": DAMPING, "natural_frequency": NATURAL_FREQUENCY},
             "blades": {"count": 1}, "contact": {"law": law}, "grid": {"speed_ratio": SPEED_RATIO},
             "protocol": {"transient_revolutions": 0, "sampled_revolutions": 1}, "sweep": "independent",
             "accuracy": {"tolerance": 1e-13}, "observables": ["touchdowns_per_revolution", "lightest_touch"],
             "initial": {"x": start[0].real, "y": start[0].imag, "vx": start[1].real, "vy": start[1].imag}}
    path, atlas = folder / "scene.json", folder / "atlas.h5"
    path.write_text(json.dumps(scene))
    ended = subprocess.run([program, "run", path, "-o", atlas, "--overwrite", "--progress", "off"], capture_output=True,
                           text=True, check=False)
    if ended.returncode != 0:
        raise AtlasError(f"{program}: {ended.stderr.strip() or f'exit code {ended.returncode}'}")
    with h5py.File(atlas) as file:
        if file["touchdowns_per_revolution"][...].ravel()[0] != 1.0:
            raise AtlasError(f"a grazing of depth {depth:g} m on the side {side:g} m is not the one contact of its "
                             "revolution")
        x, y, vx, vy = file["final_state"][...].ravel()
    rest = 2.0 * np.pi / SPEED_RATIO - GRAZING_TIME
    difference = np.array([x + 1j * y, vx + 1j * vy]) - free_motion(rest) @ at_grazing
    return abs(np.linalg.solve(free_motion(rest), difference)[1])


def measure(program):
    with tempfile.TemporaryDirectory() as folder:
        return {(law, name): np.array([kick(program, pathlib.Path(folder), law, depth, side) for depth in DEPTHS])
                for law in LAWS for name, (side, *_) in SIDES.items()}


def slopes(kicks):
    """Slope between neighbouring depths of the logarithms."""
    return np.diff(np.log(kicks)) / np.diff(np.log(DEPTHS))


def table(kicks):
    yield "| contact law | approaching | head-on | receding |"
    yield "|---|---|---|---|"
    for law, words in LAWS.items():
        cells = [f"{slopes(kicks[law, side])[-1]:.4f}" for side in SIDES]
        yield f"| `{law}`: {words} | {' | '.join(cells)} |"


def draw(options):
    program = pathlib.Path(options.source)
    if not program.is_file():
        raise AtlasError(f"{program}: no such program; the first argument is the program rubatlas")
    if not os.access(program, os.X_OK):
        raise AtlasError(f"{program}: no program; the first argument is the program rubatlas, not a file of it")
    kicks = measure(program.resolve())
    figure, (panels,) = style.subplots(options, 1, 2, (9.5, 4.2), sharey=True)
    for panel, (law, words) in zip(panels, LAWS.items()):
        for name, (_, colour, marker) in SIDES.items():
            slope = slopes(kicks[law, name])[-1]
            panel.loglog(1e3 * DEPTHS, 1e3 * kicks[law, name], marker, color=colour, ms=4,
                         label=f"{name}: slope {slope:.3f}")
            panel.loglog(1e3 * DEPTHS, 1e3 * kicks[law, name][-1] * (DEPTHS / DEPTHS[-1])**slope, color=colour, lw=0.7)
        panel.set_title(words)
        panel.set_xlabel("Depth of the contact [mm]")
        style.legend(panel, options, place="lower right")
    style.label_row(options, panels, "Kick |Δz'| [mm per unit τ]")
    style.headline(figure, "Kick of a grazing contact")
    style.save(figure, options)
    if options.table:
        print(*table(kicks), sep="\n")


def main(arguments_given):
    arguments = command_line.parser(__doc__, source="RUBATLAS", line=False)
    arguments.add_argument("--table", action="store_true", help="print the slopes as a table")
    command_line.run(draw, arguments.parse_args(arguments_given))
