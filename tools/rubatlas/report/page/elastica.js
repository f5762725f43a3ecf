// --- The shape of a blade: the elastica between hub and tip. ---

const SEGMENTS = 24;

/// The slope of the tip under the load f = F L²/EI and a friction of μ: the one with which the curve ends upright at the hub; 0 where f is below Euler's
/// load and there is no friction.
function tipSlope(load, friction) {
  let low = 0, high = 3;
  for (let i = 0; i < 40; ++i) {
    const middle = (low + high) / 2;
    if (slopesFromTip(load, friction, middle)[SEGMENTS] < 0) low = middle; else high = middle;
  }
  return low;
}
/// The blade in contact: bent to that side, by that share of the friction, with which its tip is nearest to where `miss` of a shape is zero. An orbit keeps the
/// normal force alone; `shares` are the candidates, 1 and −1 where a tip slips.
function bentBlade(load, friction, shares, miss) {
  let best = null;
  for (const share of shares) {
    const shape = bladeShape(load, Math.abs(share) * friction, (share < 0 ? -1 : 1) * tipSlope(load, Math.abs(share) * friction));
    const distance = Math.abs(miss(shape[SEGMENTS]));
    if (!best || distance < best.distance) best = {shape, distance};
  }
  return best.shape;
}

/// Points (along the undeformed blade, across it) of a blade of length 1 with the load f = F L²/EI and the slope θ(L) at its tip:
/// θ'' = −f (sin θ + μ cos θ) from the tip, where θ' = 0, back to the hub, where the slope is zero (model, section 3.1).
function bladeShape(load, friction, slope) {
  const side = Math.sign(slope);
  const slopes = slopesFromTip(load, friction, Math.abs(slope)).reverse();
  const step = 1 / SEGMENTS;
  let along = 0, across = 0;
  const points = [[0, 0]];
  for (let i = 0; i < SEGMENTS; ++i) {
    const middle = (slopes[i] + slopes[i + 1]) / 2;
    along += step * Math.cos(middle);
    across += step * Math.sin(middle);
    points.push([along, side * across]);
  }
  return points;
}
/// Slopes of the curve at the ends of its segments, from the tip to the hub.
function slopesFromTip(load, friction, slope) {
  const slopes = [slope];
  const step = 1 / SEGMENTS;
  const bend = (theta) => -load * (Math.sin(theta) + friction * Math.cos(theta));
  let theta = slope, rate = 0;
  for (let i = 0; i < SEGMENTS; ++i) {
    const k1 = bend(theta), k2 = bend(theta + step / 2 * rate), k3 = bend(theta + step / 2 * rate + step * step / 4 * k1);
    const k4 = bend(theta + step * rate + step * step / 2 * k2);
    theta += step * rate + step * step / 6 * (k1 + k2 + k3);
    rate += step / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    slopes.push(theta);
  }
  return slopes;
}
