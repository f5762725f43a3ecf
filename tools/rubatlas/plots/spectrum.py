"""Spectrum of x of one point.

  rubatlas-plot spectrum ATLAS.h5 --speed_ratio 0.62 -o PICTURE.png [--damping_ratio 0.1 ...]

Amplitudes over the order, the multiple of the speed of rotation. A motion of period k has lines at multiples of 1/k.
"""
import numpy as np

from rubatlas import command_line
from rubatlas import style
from rubatlas.atlas_file import AtlasError, AtlasFile


def place_of(atlas, speed_ratio):
    """Number of the speed that is nearest to the one that is asked for."""
    speed = atlas.axis("speed_ratio")
    if not speed[0] <= speed_ratio <= speed[-1]:
        raise AtlasError(f"speed ratio {speed_ratio:g}: outside the atlas, which has {speed[0]:g} to {speed[-1]:g}")
    return int(np.argmin(abs(speed - speed_ratio)))


def into(panel, line, speed_ratio):
    """The amplitudes at the grid's nearest speed; returns that speed."""
    atlas = line.atlas
    place = place_of(atlas, speed_ratio)
    units, factor = style.drawn(atlas.units("spectrum"))
    order, amplitude = atlas.axis("order"), factor * line.rows("spectrum")[place]
    if not np.isfinite(amplitude).all():
        raise AtlasError(f"{atlas.path}: the point at speed ratio {atlas.axis('speed_ratio')[place]:g} is not done, "
                         "and has no spectrum")
    # The mean position is no vibration.
    largest = amplitude[1:].max() or 1.0
    panel.vlines(order[1:], 1e-8 * largest, np.maximum(amplitude[1:], 1e-8 * largest), color=style.BLUE, lw=0.9)
    panel.set_yscale("log")
    panel.set_ylim(1e-7 * largest, 2.0 * largest)
    panel.set_xlim(0.0, order[-1])
    panel.set_xlabel("Order: multiple of the speed of rotation [-]")
    panel.set_ylabel(f"{atlas.long_name('spectrum')} [{units}]")
    return atlas.axis("speed_ratio")[place]


def draw(options):
    with AtlasFile(options.source) as atlas:
        line = atlas.line(**command_line.wanted(options, atlas.axes))
        figure, ((panel,),) = style.subplots(options, 1, 1, (8.5, 4.2))
        speed = into(panel, line, options.speed_ratio)
        style.title(figure, atlas, f"speed ratio {speed:g}, {line.describe()}")
        style.save(figure, options)


def main(arguments_given):
    arguments = command_line.parser(__doc__)
    arguments.add_argument("--speed_ratio", type=float, required=True,
                           help="the point's speed; the nearest of the grid is taken")
    command_line.run(draw, arguments.parse_args(arguments_given))
