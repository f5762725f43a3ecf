// --- The map: any quantity over any two axes. ---

/// An axis as the map draws it: by value where values are evenly spaced, else cell by cell with a word for each.
function spacingOf(axis) {
  const all = axis.values;
  if (all.length === 1) return {places: [0], edges: [-0.5, 0.5], ticks: {places: [0], words: [axisWord(axis, 0)]}};
  const step = (all[all.length - 1] - all[0]) / (all.length - 1);
  const factor = drawn(axis.units)[1];
  const even = axis.name !== 'direction'
    && all.every((value, i) => Math.abs(value - all[0] - i * step) < 1e-6 * Math.abs(step));
  if (even && all.length > 6) {
    return {places: all.map((value) => value * factor), ticks: null,
      edges: [(all[0] - step / 2) * factor, (all[all.length - 1] + step / 2) * factor]};
  }
  const places = all.map((_, i) => i);
  const every = Math.ceil(all.length / 12);
  const kept = places.filter((i) => i % every === 0);
  return {places, edges: [-0.5, all.length - 0.5], ticks: {places: kept, words: kept.map((i) => axisWord(axis, i))}};
}
const spacings = new Map();
function spacing(axis) {
  if (!spacings.has(axis)) spacings.set(axis, spacingOf(axis));
  return spacings.get(axis);
}
const DIRECTIONS = ['up', 'down'];
const axisWord = (axis, index) =>
  (axis.name === 'direction' ? DIRECTIONS[axis.values[index]]
    : shown(axis.values[index] * drawn(axis.units)[1], 5));
/// The same with its unit, to stand by itself.
const placeWord = (axis, index, digits = 5) =>
  (axis.name === 'direction' ? axisWord(axis, index) : withUnits(axis.values[index], axis.units, digits));
/// A value of an axis in a file or an address.
const valueWord = (axis, index) => (axis.name === 'direction' ? axisWord(axis, index) : axis.values[index]);
/// Names and values in a text; no line ends between the two.
const listed = (pairs) => pairs.map((pair) => pair.join(' ').replace(/ /g, '\u00a0')).join(', ');
/// What a cell of the atlas is, or all cells that differ from it on the axes `but` these.
function aboutCell(place, but = []) {
  const kept = axes.map((axis, i) => [axis, place[i]]).filter((_, i) => !but.includes(i));
  return {words: listed(kept.map(([axis, index]) => [axis.symbol || words(axis.name), placeWord(axis, index)])),
    values: kept.map(([axis, index]) => [column(axis.name, axis.units), valueWord(axis, index)])};
}
/// A map's value at a point, in words.
function mapWord(map, point) {
  const value = values[map.name][point];
  return map.flags ? map.flags[value] ?? 'none' : withUnits(value, map.units);
}

// That a zoom leaves along an axis.
const LEAST_CELLS = 4;

class AtlasMap {
  constructor(state, changed) {
    this.state = state;
    this.changed = changed;
    this.marks = null;
    this.chart = new Chart(byId('map'), {name: 'map', height: 330, legendHolder: byId('map-legend'),
      click: (x, y) => this.changed(this.placeAt(x, y)), hover: (x, y) => this.said(x, y)});
  }
  get axisX() { return axes[this.state.x]; }
  get axisY() { return axes[this.state.y]; }
  /// The selected point with other places on the two axes that are drawn.
  cell(i, j) {
    const place = [...this.state.place];
    place[this.state.y] = j;
    place[this.state.x] = i;
    return pointAt(place);
  }
  placeAt(x, y) {
    const place = [...this.state.place];
    place[this.state.y] = nearestTo(spacing(this.axisY).places, y);
    place[this.state.x] = nearestTo(spacing(this.axisX).places, x);
    return place;
  }
  /// How many cells share a pixel, along both axes.
  get cellsInPixel() {
    const {plot, shownRange} = this.chart;
    return [['x', this.axisX, plot.over.clientWidth], ['y', this.axisY, plot.over.clientHeight]]
      .map(([side, axis, pixels]) => {
        const [low, high] = spacing(axis).edges;
        return axis.values.length * (shownRange[side][1] - shownRange[side][0]) / (high - low) / pixels;
      });
  }
  /// The quantity of a cell in words.
  valueAt(place) {
    const map = mapNamed(this.state.quantity), point = pointAt(place);
    return `${words(map.name)}: ${mapWord(values.status[point] === 1 ? map : mapNamed('status'), point)}`
      + (map.name.startsWith('class') && isUntouched(point) ? `, ${NO_CONTACT.word}` : '');
  }
  /// The cell at a place of the map in words.
  said(x, y) {
    const place = this.placeAt(x, y);
    const shares = this.cellsInPixel.reduce((product, share) => product * Math.max(1, share), 1);
    const held = axes.map((_, i) => i).filter((i) => i !== this.state.x && i !== this.state.y);
    const parts = [aboutCell(place, held).words, this.valueAt(place)];
    if (shares >= 1.5) parts.push(`one of ${Math.round(shares)} cells in this pixel; zoom in to tell them apart`);
    return parts.join('\n');
  }
  /// Shows fewer cells around the selected one, or more; by no factor: all of them.
  zoom(factor) {
    const {chart} = this;
    const range = (side, axis, at) => {
      const {edges, places} = spacing(axis);
      const whole = edges[1] - edges[0], cells = axis.values.length;
      const [low, high] = chart.shownRange[side];
      const width = Math.min(whole, Math.max((high - low) / factor, whole * Math.min(1, LEAST_CELLS / cells)));
      const from = Math.min(Math.max(places[at] - width / 2, edges[0]), edges[1] - width);
      return [from, from + width];
    };
    chart.zoomed = factor ? {x: range('x', this.axisX, this.state.place[this.state.x]),
      y: range('y', this.axisY, this.state.place[this.state.y])} : null;
    chart.refresh();
  }
  /// A selected cell that is not in the part that is shown moves this part.
  follow() {
    const {zoomed} = this.chart;
    const outside = (range, axis, at) => spacing(axis).places[at] < range[0] || spacing(axis).places[at] > range[1];
    if (zoomed && (outside(zoomed.x, this.axisX, this.state.place[this.state.x])
      || outside(zoomed.y, this.axisY, this.state.place[this.state.y]))) this.zoom(1);
  }
  draw() {
    const map = mapNamed(this.state.quantity);
    const all = values[map.name], status = values.status;
    const nx = this.axisX.values.length, ny = this.axisY.values.length;
    const [across, upward] = [spacing(this.axisX), spacing(this.axisY)];
    const canvas = element('canvas');
    canvas.width = nx;
    canvas.height = ny;
    const context = canvas.getContext('2d');
    const image = context.createImageData(nx, ny);
    const cells = [];
    for (let j = 0; j < ny; ++j) for (let i = 0; i < nx; ++i) cells.push(this.cell(i, j));
    const flags = map.flags && flagEntries(map);
    const drawnValues = flags ? [] : cells.map((point) => all[point]).filter((value) => Number.isFinite(value));
    const [low, high, logarithmic] = this.scaleOf(drawnValues);
    const within = (entries, value) => entries.find(({first, last}) => value >= first && value <= last);
    const entryAt = (point) => (map.name !== 'status' && within(NO_MOTION, status[point]))
      || (map.name.startsWith('class') && isUntouched(point) && NO_CONTACT) || (flags && within(flags, all[point]));
    const seen = cells.map(entryAt);
    cells.forEach((point, at) => {
      let colour = seen[at] ? rgb(seen[at].colour) : null;
      if (!seen[at] && !flags && Number.isFinite(all[point])) {
        const value = logarithmic ? Math.log10(all[point]) : all[point];
        colour = viridis(high > low ? (value - low) / (high - low) : 0.5);
      }
      const target = 4 * ((ny - 1 - Math.floor(at / nx)) * nx + at % nx);
      const faded = this.marks && !this.marks[point] ? 0.22 : 1;
      if (colour) { image.data.set(colour, target); image.data[target + 3] = 255 * faded; }
    });
    context.putImageData(image, 0, 0);
    const layers = [{kind: 'image', source: canvas, x: across.edges, y: upward.edges},
      ...this.hatches(seen, nx, across.edges, upward.edges)];
    const place = this.state.place;
    const half = (spaced, count) => (spaced.edges[1] - spaced.edges[0]) / count / 2;
    const sx = across.places[place[this.state.x]], sy = upward.places[place[this.state.y]];
    const wide = Math.max(half(across, nx), (across.edges[1] - across.edges[0]) / 260);
    const tall = Math.max(half(upward, ny), (upward.edges[1] - upward.edges[0]) / 60);
    layers.push({kind: 'box', x: [sx - wide, sx + wide], y: [sy - tall, sy + tall], colour: ground(), width: 4});
    layers.push({kind: 'box', x: [sx - wide, sx + wide], y: [sy - tall, sy + tall], colour: VERMILION, width: 2});
    this.follow();
    byId('map-here').textContent = `Selected: ${aboutCell(place).words}; ${this.valueAt(place)}.`;
    this.chart.heading = mapLabel(map);
    this.chart.show({layers, x: across.edges, y: upward.edges, keepZoom: true, xLabel: labelOf(this.axisX),
      yLabel: labelOf(this.axisY), xTicks: across.ticks, yTicks: upward.ticks,
      about: aboutCell(place, [this.state.x, this.state.y]), csv: () => this.columns(), note: map.long_name,
      legend: this.legend(map, flags, [...new Set(seen)], low, high, logarithmic)});
  }
  /// Layers that hatch the cells whose entry of the legend has a hatch: rows of neighbours are one box.
  hatches(seen, nx, [left, right], [bottom, top]) {
    const wide = (right - left) / nx, tall = (top - bottom) / (seen.length / nx);
    const layers = new Map();
    for (let at = 0, from = 0; at < seen.length; ++at) {
      const goesOn = (at + 1) % nx !== 0 && seen[at + 1] === seen[at];
      if (goesOn) continue;
      const entry = seen[at], row = Math.floor(at / nx), first = from % nx;
      from = at + 1;
      if (!entry?.hatch) continue;
      if (!layers.has(entry)) {
        layers.set(entry, {kind: 'hatch', sign: entry.hatch, colour: hatchInk(entry.colour), boxes: []});
      }
      layers.get(entry).boxes.push(
        [left + wide * first, left + wide * (at % nx + 1), bottom + tall * row, bottom + tall * (row + 1)]);
    }
    return layers.values();
  }
  /// Displacements and forces of rest and rub differ by decades: where they do and are positive, logarithms are shown.
  scaleOf(all) {
    if (!all.length) return [0, 1, false];
    const sorted = Float64Array.from(all).sort();
    const [low, high] = [sorted[0], sorted[sorted.length - 1]];
    const median = sorted[Math.floor(sorted.length / 2)];
    if (low > 0 && high / Math.max(sorted[Math.floor(sorted.length / 20)], 1e-300) > 1000 && median < high / 30) {
      return [Math.log10(Math.max(sorted[Math.floor(sorted.length / 50)], high * 1e-8)), Math.log10(high), true];
    }
    return [low, high, false];
  }
  legend(map, flags, seen, low, high, logarithmic) {
    const scale = (value) => withUnits(logarithmic ? 10 ** value : value, map.units, 3);
    const strip = {mark: 'strip', before: scale(low), word: `${scale(high)}${logarithmic ? ' (logarithmic)' : ''}`};
    const shownFlags = [...flags ?? [], NO_CONTACT, ...map.name === 'status' ? [] : NO_MOTION]
      .filter((entry) => seen.includes(entry));
    const pale = this.marks ? [{mark: 'patch', colour: 'transparent', word: 'pale: not marked'}] : [];
    return [...flags ? [] : [strip], ...shownFlags, ...pale];
  }
  columns() {
    const map = mapNamed(this.state.quantity);
    const points = [];
    for (let j = 0; j < this.axisY.values.length; ++j) {
      for (let i = 0; i < this.axisX.values.length; ++i) points.push(this.cell(i, j));
    }
    const columns = {};
    axes.forEach((axis, i) => {
      columns[column(axis.name, axis.units)] = points.map((point) => valueWord(axis, placeOf(point)[i]));
    });
    columns[map.flags ? map.name : column(map.name, map.units)] =
      points.map((point) => (map.flags ? map.flags[values[map.name][point]] ?? '' : values[map.name][point]));
    if (this.marks) columns.marked = points.map((point) => this.marks[point]);
    return columns;
  }
}
