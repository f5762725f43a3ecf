// --- The map: any quantity over any two axes. ---

/// An axis as the map draws it: by value where values are evenly spaced, else cell by cell with a word for each.
function spacing(axis) {
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
const axisWord = (axis, index) =>
  (axis.name === 'direction' ? ['up', 'down'][axis.values[index]]
    : shown(axis.values[index] * drawn(axis.units)[1], 5));
/// The same with its unit, to stand by itself.
const placeWord = (axis, index, digits = 5) =>
  (axis.name === 'direction' ? axisWord(axis, index) : withUnits(axis.values[index], axis.units, digits));

class AtlasMap {
  constructor(state, changed) {
    this.state = state;
    this.changed = changed;
    this.name = 'map';
    this.marks = null;
    this.chart = new Chart(byId('map'),
      {name: 'map', xLabel: '', yLabel: '', height: 330, click: (x, y) => this.pick(x, y)});
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
  pick(x, y) {
    const near = (places, value) =>
      places.reduce((best, at, i) => (Math.abs(at - value) < Math.abs(places[best] - value) ? i : best), 0);
    const place = [...this.state.place];
    place[this.state.y] = near(spacing(this.axisY).places, y);
    place[this.state.x] = near(spacing(this.axisX).places, x);
    this.changed(place);
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
    const colours = map.flags ? flagColours(map) : null;
    const drawnValues = colours ? [] : cells.map((point) => all[point]).filter((value) => Number.isFinite(value));
    const [low, high, logarithmic] = this.scaleOf(drawnValues);
    const seen = new Set(), missing = new Set();
    cells.forEach((point, at) => {
      let colour = null;
      const own = map.name === 'status' ? null : MISSING[status[point]];
      if (own) { colour = rgb(own[0]); missing.add(status[point]); }
      else if (colours) {
        const entry = colours.find(([first, last]) => all[point] >= first && all[point] <= last);
        if (entry) { colour = rgb(entry[3]); seen.add(entry); }
      } else if (Number.isFinite(all[point])) {
        const value = logarithmic ? Math.log10(all[point]) : all[point];
        colour = viridis(high > low ? (value - low) / (high - low) : 0.5);
      }
      const target = 4 * ((ny - 1 - Math.floor(at / nx)) * nx + at % nx);
      const faded = this.marks && !this.marks[point] ? 0.22 : 1;
      if (colour) { image.data.set(colour, target); image.data[target + 3] = 255 * faded; }
    });
    context.putImageData(image, 0, 0);
    const layers = [{kind: 'image', source: canvas, x: across.edges, y: upward.edges}];
    const place = this.state.place;
    const half = (spaced, count) => (spaced.edges[1] - spaced.edges[0]) / count / 2;
    const sx = across.places[place[this.state.x]], sy = upward.places[place[this.state.y]];
    const wide = Math.max(half(across, nx), (across.edges[1] - across.edges[0]) / 260);
    const tall = Math.max(half(upward, ny), (upward.edges[1] - upward.edges[0]) / 60);
    layers.push({kind: 'box', x: [sx - wide, sx + wide], y: [sy - tall, sy + tall], colour: ground(), width: 4});
    layers.push({kind: 'box', x: [sx - wide, sx + wide], y: [sy - tall, sy + tall], colour: VERMILION, width: 2});
    this.chart.show({layers, x: across.edges, y: upward.edges, keepZoom: true, xLabel: labelOf(this.axisX),
      yLabel: labelOf(this.axisY),
      xTicks: across.ticks, yTicks: upward.ticks});
    this.legend(map, colours ? [...colours].filter((entry) => seen.has(entry)) : null, low, high, logarithmic, missing);
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
  legend(map, entries, low, high, logarithmic, missing) {
    const holder = byId('map-legend');
    holder.replaceChildren();
    const chip = (colour, word) => {
      const patch = element('i');
      patch.style.background = colour;
      return element('span', {class: 'chip'}, patch, word);
    };
    if (entries) entries.forEach(([, , word, colour]) => holder.append(chip(colour, word)));
    else {
      const scale = (value) => withUnits(logarithmic ? 10 ** value : value, map.units, 3);
      const strip = element('i', {class: 'strip'});
      strip.style.background = `linear-gradient(90deg, ${VIRIDIS.map((colour) => `rgb(${colour})`).join(',')})`;
      holder.append(element('span', {text: scale(low)}), strip, element('span', {text: scale(high)}),
        ...(logarithmic ? [element('span', {class: 'quiet', text: '(logarithmic)'})] : []));
    }
    missing.forEach((status) => holder.append(chip(...MISSING[status])));
    if (this.marks) holder.append(element('span', {class: 'quiet', text: 'pale: not marked'}));
    holder.append(element('span', {class: 'quiet long', text: map.long_name}));
  }
  csv() {
    const map = mapNamed(this.state.quantity);
    const columns = Object.fromEntries(axes.map((axis) => [axis.name, []]));
    columns[map.name] = [];
    if (this.marks) columns.marked = [];
    for (let j = 0; j < this.axisY.values.length; ++j) {
      for (let i = 0; i < this.axisX.values.length; ++i) {
        const point = this.cell(i, j);
        placeOf(point).forEach((index, axis) => columns[axes[axis].name].push(axes[axis].values[index]));
        columns[map.name].push(map.flags ? map.flags[values[map.name][point]] ?? '' : values[map.name][point]);
        if (this.marks) columns.marked.push(this.marks[point]);
      }
    }
    return columns;
  }
  svg(title) { return this.chart.svg(title); }
  png(title) { return this.chart.png(title); }
}
