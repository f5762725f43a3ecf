// --- The shape of a blade: the elastica between hub and tip, from a table that the report brings along. ---
//
// All blades are parts of one family of curves. `angles` is a table of a curve's angle to the force that the ring
// exerts: a row for each angle at the tip, a column for each length from the tip in units of √(EI / force), `step`
// apart. In these units the angle's second derivative is −sin of it, which goes into the interpolation.

const SEGMENTS = 24;

/// Points (along the undeformed blade, across it) of a blade of length 1 under the load f = F L²/EI with friction μ.
function bladeShape({step, angles}, load, friction) {
  const lean = Math.atan(friction);  // of the force against the undeformed blade
  const length = Math.sqrt(load / Math.cos(lean));
  const angle = (row, share) => {
    const at = share * length / step, low = Math.min(Math.floor(at), row.length - 2), part = at - low;
    const straight = row[low] + part * (row[low + 1] - row[low]);
    return straight + part * (1 - part) / 2 * step ** 2 * Math.sin(straight);
  };
  // At the hub the blade is not bent: its angle there, the force's lean, is between those of two rows.
  const above = angles.findIndex((row) => angle(row, 1) > lean);
  const next = above < 0 ? angles.length - 1 : Math.max(above, 1);
  const [one, other] = [angles[next - 1], angles[next]];
  const share = (lean - angle(one, 1)) / (angle(other, 1) - angle(one, 1));
  const points = [[0, 0]];
  for (let i = 0; i < SEGMENTS; ++i) {
    const place = 1 - (i + 0.5) / SEGMENTS;
    const slope = (1 - share) * angle(one, place) + share * angle(other, place) - lean;
    const [along, across] = points[i];
    points.push([along + Math.cos(slope) / SEGMENTS, across + Math.sin(slope) / SEGMENTS]);
  }
  return points;
}
/// The blade in contact: bent to that side, by that share of the friction, with which its tip is nearest to where
/// `miss` of a point is zero. An orbit keeps the normal force alone; `shares` are the candidates, 1 and −1 where a tip
/// slips.
function bentBlade(table, load, friction, shares, miss) {
  const shapes = shares.map((share) => bladeShape(table, load, Math.abs(share) * friction)
    .map(([along, across]) => [along, share < 0 ? -across : across]));
  const off = shapes.map((points) => Math.abs(miss(points[SEGMENTS])));
  return shapes[off.indexOf(Math.min(...off))];
}
