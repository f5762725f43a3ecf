// --- The shape of a blade: the elastica between hub and tip. ---

const SEGMENTS = 24;

/// Points (along the undeformed blade, across it) of a blade of length 1 with the load f = F L²/EI and the slope θ(L) at its tip:
/// θ'' = −f (sin θ + μ cos θ) from the tip, where θ' = 0, back to the hub, where the slope is zero (model, section 3.1).
function bladeShape(load, friction, tipSlope) {
  const side = Math.sign(tipSlope);
  const slopes = [Math.abs(tipSlope)];
  const step = 1 / SEGMENTS;
  const bend = (theta) => -load * (Math.sin(theta) + friction * Math.cos(theta));
  let theta = Math.abs(tipSlope), rate = 0;
  for (let i = 0; i < SEGMENTS; ++i) {
    const k1 = bend(theta), k2 = bend(theta + step / 2 * rate), k3 = bend(theta + step / 2 * rate + step * step / 4 * k1);
    const k4 = bend(theta + step * rate + step * step / 2 * k2);
    theta += step * rate + step * step / 6 * (k1 + k2 + k3);
    rate += step / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    slopes.push(theta);
  }
  slopes.reverse();
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
