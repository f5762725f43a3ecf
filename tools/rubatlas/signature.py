"""The signs of rubbing blades in a spectrum: of an atlas, or of a measurement.

    found = rubatlas.signature(orders, amplitudes, blades=3)
    found.passing, found.between_share, found.centroid

Orders are multiples of the speed of rotation (1× is 1), amplitudes 0-peak in any unit. The rule:

- A **line** stands at every whole order, 0 (the mean position) included, and owns what lies within its half width of
  it: 0.05 orders, or two bins where these are wider. A window such as Hann's spreads a line over two bins on either
  side, and a wandering speed over its own share of the order; a motion of period p has its next lines 1/p away, so
  that up to period 16 they are told from the whole orders.
- **Between** the lines is the rest, up to the order 2n and half a line above it (or up to `highest`): the n× line, its
  double, and the natural frequency from the speed ratio 1/(2n) on lie below.
- Power is amplitude²: that of a bin, since Parseval's sum over a record has one term for each.

A spectrum must have bins of at most 1/8 order, that is eight revolutions: else nothing is left between the lines.
"""
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

HALF_WIDTH = 0.05  # [orders] of a line
BINS = 2  # of a line on either side, at least
COARSEST = 0.125  # [orders] from bin to bin

Numbers = npt.NDArray[np.float64]


class Signature(NamedTuple):
    """What `signature` measures; a number for each spectrum, NaN for one that holds NaN."""

    passing: Numbers  #: height of the n× line, in the unit of the amplitudes
    rotation: Numbers  #: height of the 1× line
    subharmonic: Numbers  #: largest amplitude between the lines: of a motion of period p at an order k/p
    subharmonic_order: Numbers  #: its order; NaN where nothing is between the lines
    between: Numbers  #: √(power between the lines): the height of a single line with that power
    between_share: Numbers  #: power between the lines over all power but that of order 0; 0 for no vibration
    centroid: Numbers  #: mean order of the power between the lines; NaN where there is none
    width: Numbers  #: its standard deviation [orders]
    #: (ΣP)²/ΣP² over the number of bins between the lines: about 1/2 for white noise, 1/bins for a single line. It
    #: tells a broad band from the lines of a motion of period p.
    breadth: Numbers
    #: √(bins between the lines · median of their power / ln 2): `between` for white noise, whose bins have powers with
    #: a median of ln 2 times the mean, and 0 for lines, which never stand in half of the bins. A broad band's height.
    broad: Numbers


def half_width(step: float) -> float:
    """Of a line [orders] in a spectrum with such steps; an order that it ends at counts as within."""
    return max(HALF_WIDTH, BINS * step) * (1.0 + 1e-9)


def signature(orders: Any, amplitudes: Any, blades: int = 3, highest: float | None = None) -> Signature:
    """Measures a spectrum, or each of several with the orders along the last axis.

    `orders` ascend evenly; `highest` is the greatest order that is looked at (default: 2 `blades` and half a line).

    >>> found = signature([i / 10 for i in range(70)], [3.0 if i == 30 else 0.1 if i == 5 else 0.0 for i in range(70)])
    >>> float(found.passing), float(found.subharmonic), float(found.subharmonic_order)
    (3.0, 0.1, 0.5)
    >>> round(float(found.between_share), 5)
    0.00111
    """
    order, amplitude = np.asarray(orders, dtype=float), np.asarray(amplitudes, dtype=float)
    if order.ndim != 1 or order.size < 2 or amplitude.shape[-1:] != order.shape:
        raise ValueError(f"orders of shape {order.shape} and amplitudes of shape {amplitude.shape}: the orders are one "
                         "row, the amplitudes have one number for each along their last axis")
    step = float(order[-1] - order[0]) / (order.size - 1)
    if not 0.0 < step <= COARSEST or np.abs(np.diff(order) - step).max() > 0.01 * step:
        raise ValueError(f"orders from {order[0]:g} to {order[-1]:g} in steps of about {step:.3g}: they ascend evenly, "
                         f"in steps of at most {COARSEST:g}")
    half = half_width(step)
    highest = 2 * blades + half if highest is None else highest
    if not blades <= highest <= order[-1] + half:
        raise ValueError(f"highest order {highest:g}: not between the number of blades, {blades}, and the last order "
                         f"of the spectrum, {order[-1]:g}")
    known = np.isfinite(amplitude).all(axis=-1)

    def line(at: int) -> Numbers:
        return np.where(known, amplitude[..., np.abs(order - at) <= half].max(axis=-1, initial=0.0), np.nan)

    vibration = (order > half) & (order <= highest)
    apart = vibration & (np.abs(order - np.rint(order)) > half)
    place, beside = order[apart], amplitude[..., apart]
    largest = beside.max(axis=-1)
    power = beside**2
    total, everything = power.sum(axis=-1), (amplitude[..., vibration] ** 2).sum(axis=-1)
    median = np.median(power, axis=-1)
    with np.errstate(invalid="ignore", divide="ignore"):  # 0/0 where there is nothing
        centroid = power @ place / total
        width = np.sqrt((power * (place - centroid[..., np.newaxis]) ** 2).sum(axis=-1) / total)
        breadth = total**2 / (power**2).sum(axis=-1) / place.size
        share = np.where(everything == 0.0, 0.0, total / everything)
    return Signature(passing=line(blades), rotation=line(1), subharmonic=largest,
                     subharmonic_order=np.where(largest > 0.0, place[beside.argmax(axis=-1)], np.nan),
                     between=np.sqrt(total), between_share=share, centroid=centroid, width=width, breadth=breadth,
                     broad=np.sqrt(place.size * median / np.log(2.0)))
