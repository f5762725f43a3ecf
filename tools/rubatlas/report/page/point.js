// --- A point: its facts, its charts, and what the page computes of it. ---

// Sections of one answer; more are computed on request, from where the last answer ended.
const REVOLUTIONS = 64;
const SAMPLES = 128;
// Tighter than the program's usual 1e-9: what the atlas and the page have is to agree within 1e-9 of the clearance.
const TOLERANCE = 1e-11;
// A page does not wait for longer transients.
const LONGEST_TRANSIENT = 2000;

/// The scene with the values of a place on the axes.
function sceneAt(place) {
  const scene = structuredClone(atlas.scene);
  axes.forEach((axis, number) => {
    if (!axis.pointer) return;
    const [section, key] = axis.pointer;
    scene[section] = {...scene[section], [key]: axis.values[place[number]]};
  });
  return scene;
}
/// What a place of the atlas asks of the solver, as numbers in SI units; `sceneOf` puts them into the scene.
function requestAt(place) {
  const scene = sceneAt(place);
  const {rotor, blades, ring, contact, unbalance, initial} = scene;
  return {
    speed_ratio: axes[SPEED].values[place[SPEED]], damping_ratio: rotor.damping_ratio, friction: contact.friction,
    unbalance: unbalance?.moment ?? 0, thickness: blades.thickness,
    misalignment: rotor.misalignment, blade_length: blades.length, blade_width: blades.width,
    youngs_modulus: blades.youngs_modulus, hub_radius: blades.hub_radius, ring_radius: ring.radius,
    tolerance: Math.min(scene.accuracy?.tolerance ?? TOLERANCE, TOLERANCE),
    x: initial?.x ?? 0, y: initial?.y ?? 0, vx: initial?.vx ?? 0, vy: initial?.vy ?? 0,
    transient_revolutions: 0, sampled_revolutions: REVOLUTIONS, samples_per_revolution: SAMPLES, settle: 'never',
    memory: [], scene};
}
/// The scene of one point that the solver is given: that of `wanted` with its numbers, computed by collocation.
function sceneOf(wanted) {
  const {grid: _grid, sweep: _sweep, pieces: _pieces, observables: _observables, spectrum: _spectrum, unbalance,
    ...scene} = wanted.scene;
  return {...scene,
    rotor: {...scene.rotor, damping_ratio: wanted.damping_ratio, misalignment: wanted.misalignment},
    blades: {...scene.blades, thickness: wanted.thickness},
    contact: {...scene.contact, friction: wanted.friction},
    // An unbalance of zero is the absent effect, as in a line of an atlas.
    ...(wanted.unbalance === 0 ? {} : {unbalance: {...unbalance, moment: wanted.unbalance}}),
    initial: {x: wanted.x, y: wanted.y, vx: wanted.vx, vy: wanted.vy},
    protocol: {transient_revolutions: wanted.transient_revolutions, sampled_revolutions: wanted.sampled_revolutions,
      samples_per_revolution: wanted.samples_per_revolution, settle: wanted.settle},
    accuracy: {method: 'collocation', tolerance: wanted.tolerance},
    grid: {speed_ratio: [wanted.speed_ratio]}};
}

/// The worker with the solver; none where the page cannot have one, and `why` says so.
class Computer {
  constructor() {
    this.why = atlas.not_computed;
    this.waiting = new Map();
    this.number = 0;
  }
  /// `near`: a request like the first that will be asked.
  async start(near) {
    if (this.why) return;
    try {
      const able = typeof WebAssembly === 'object' && typeof Worker === 'function';
      if (!able) throw new Error('this browser runs no WebAssembly');
      const source = JSON.parse(byId('worker-source').textContent);
      this.worker = new Worker(URL.createObjectURL(new Blob([source], {type: 'text/javascript'})));
      this.worker.onmessage = ({data}) => {
        const {resolve, reject} = this.waiting.get(data.id);
        this.waiting.delete(data.id);
        if (data.error) reject(new Error(data.error));
        else resolve(data);
      };
      this.worker.onerror = (event) => {
        event.preventDefault();
        for (const {reject} of this.waiting.values()) reject(new Error(event.message || 'the worker does not start'));
        this.waiting.clear();
      };
      await this.ask({module: await unpacked('solver')});
      // The browser translates the module in full when it runs first: a point that nobody waits for.
      await this.compute({...near, transient_revolutions: 0, sampled_revolutions: 30}, 1);
    } catch (error) {
      this.why = `The page cannot compute points of its own (${error.message}).`;
      this.worker = null;
    }
  }
  /// What the reader has to know of what is computed and drawn; empty where nothing is missing.
  get notice() {
    const count = atlas.orbits.length;
    const undrawn = {ring_body: 'the ring at rest', wear: 'blades without their wear',
      unequal_blades: 'blades without their errors'};
    const drawn = Object.keys(undrawn).filter((effect) => effect in atlas.scene).map((effect) => undrawn[effect]);
    const moves = !this.why || count > 0;
    return [this.why,
      moves && drawn.length && `The moving rotor is drawn with ${drawn.join(' and ')}.`,
      this.why && (count
        ? 'What is shown comes from the atlas, and orbits from the program, which computed those of ' +
          `${counted(count, 'points')} from the atlas' states when this page was made.`
        : 'Everything shown comes from the atlas.')].filter(Boolean).join(' ');
  }
  /// The orbit of a point, and its spectrum up to an order.
  compute(wanted, maxOrder) {
    return this.ask({request: {scene: sceneOf(wanted), memory: wanted.memory}, maxOrder});
  }
  ask(message) {
    return new Promise((resolve, reject) => {
      const id = ++this.number;
      this.waiting.set(id, {resolve, reject});
      this.worker.postMessage({id, ...message});
    });
  }
}

/// The smallest p up to 16 after which all sections repeat, within 1e-6 of the orbit's size; 0 where there is none.
function periodOf(sections) {
  const count = sections.length / 4;
  let size = 0;
  for (let i = 0; i < count; ++i) size = Math.max(size, Math.hypot(...sections.subarray(4 * i, 4 * i + 4)));
  for (let period = 1; period <= Math.min(16, count / 2); ++period) {
    let repeats = true;
    for (let i = 0; repeats && i + period < count; ++i) {
      let square = 0;
      for (let part = 0; part < 4; ++part) square += (sections[4 * (i + period) + part] - sections[4 * i + part]) ** 2;
      repeats = Math.sqrt(square) <= 1e-6 * size;
    }
    if (repeats) return period;
  }
  return 0;
}

const FROM_ATLAS = 'from the atlas', COMPUTED = 'computed in this page', FROM_PROGRAM = 'computed by the program';

/// x, y, dx/dτ or dy/dτ of all states.
const componentOf = (states, part) => Array.from({length: states.length / 4}, (_, i) => states[4 * i + part]);
const inMillimetres = (all) => all.map((value) => 1e3 * value);
/// Millimetres of single precision in metres.
const inMetres = (value) => Number((value / 1e3).toPrecision(8));

class PointView {
  constructor(state) {
    this.state = state;
    this.charts = {};
    const add = (key, heading, origin, options, holder = byId('charts')) => {
      const box = element('div', {class: 'plot'});
      const buttons = element('span', {class: 'export'});
      const badge = element('span', {class: `badge ${origin === COMPUTED ? 'computed' : ''}`, text: origin});
      const note = element('p', {class: 'quiet small note'});
      const card = element('section', {class: 'card chart', id: `chart-${key}`, 'aria-label': heading},
        element('div', {class: 'bar'}, element('h2', {text: heading}), badge, buttons), box, note);
      holder.append(card);
      const chart = new Chart(box, {name: key, heading, legendHolder: note, ...options});
      exportButtons(buttons, chart);
      this.charts[key] = {chart, card, badge};
    };
    const speed = labelOf(axes[SPEED]);
    if (atlas.lines.poincare) {
      add('bifurcation', 'Sections over the speed', FROM_ATLAS,
        {xLabel: speed, yLabel: 'x at the sections [mm]', click: (x) => this.walkTo?.(x)}, byId('line-charts'));
      const choose = element('select', {'aria-label': 'component of the sections', onchange: (event) => {
        this.component = Number(event.target.value);
        this.drawLine();
      }},
        element('option', {value: 0, text: 'x'}), element('option', {value: 1, text: 'y'}));
      this.charts.bifurcation.card.querySelector('.bar').insertBefore(choose, this.charts.bifurcation.badge);
    }
    add('poincare', 'Poincaré section', FROM_ATLAS, {xLabel: 'x [mm]', yLabel: 'y [mm]', equal: true});
    add('orbit', 'Orbit of the shaft', COMPUTED, {xLabel: 'x [mm]', yLabel: 'y [mm]', equal: true});
    add('forces', 'Forces on the blades', COMPUTED, {xLabel: 'Revolutions', yLabel: 'Normal force [N]'});
    add('spectrum', 'Spectrum of x', FROM_ATLAS,
      {xLabel: 'Order: multiple of the speed of rotation', yLabel: 'Amplitude [mm]', decades: true});
    if (atlas.lines.spectrum) {
      add('waterfall', 'Waterfall: spectrum over the speed', FROM_ATLAS,
        {xLabel: speed, yLabel: 'Frequency over natural frequency', click: (x) => this.walkTo?.(x)});
    }
    this.component = 0;
    this.result = null;
    this.rotor = new Rotor(byId('rotor'), byId('rotor-status'));
    exportButtons(document.querySelector('[data-export=rotor]'), this.rotor);
  }
  /// Orbit, forces and the moving rotor are there where the page computes them, or the program has.
  showMotion(computer) {
    const there = !computer.why || atlas.orbits.length > 0;
    byId('charts').classList.toggle('atlas-only', !there);
    for (const {card, badge} of [this.charts.orbit, this.charts.forces]) {
      card.hidden = !there;
      badge.textContent = computer.why ? FROM_PROGRAM : COMPUTED;
    }
    this.charts.spectrum.card.hidden = Boolean(computer.why) && !atlas.lines.spectrum;
    const parts = [byId('rotor'), byId('rotor-controls'), document.querySelector('[data-export=rotor]')];
    for (const one of parts) one.hidden = !there;
    this.rotor.fit();
  }
  get point() { return pointAt(this.state.place); }
  /// What is selected: a cell, or a point off the grid.
  get about() { return this.state.own ? aboutOwn(this.state.own) : aboutCell(this.state.place); }
  showFacts() {
    const {own} = this.state;
    const badge = byId('origin');
    const holder = byId('facts');
    byId('point-heading').textContent = own ? 'Own point' : 'Point';
    badge.textContent = own ? COMPUTED : FROM_ATLAS;
    badge.classList.toggle('computed', Boolean(own));
    const pairs = [];
    const coordinates = own
      ? OWN.map(({name, symbol, units, long}) => [`${long} ${symbol}`, withUnits(own[name], units, 6)])
      : axes.map((axis, i) =>
        [`${capital(words(axis.name))} ${axis.symbol}`.trim(), placeWord(axis, this.state.place[i], 6)]).reverse();
    if (own) {
      const result = this.result;
      if (result && !result.orbit) pairs.push(['Status', result.error]);
      else if (result?.orbit.status === 1) {
        const {orbit} = result;
        const period = periodOf(result.sections);
        let largest = 0;
        for (let i = 0; i < orbit.time.length; ++i) {
          largest = Math.max(largest, Math.hypot(orbit.state[4 * i], orbit.state[4 * i + 1]));
        }
        const touches = this.rotor.touchDowns?.length ?? 0;
        pairs.push(['Sections',
          period ? `repeat every ${period === 1 ? 'revolution' : `${period} revolutions`}` : 'no period up to 16'],
          ['Largest displacement, sampled', withUnits(largest, 'm')],
          ['Largest force, sampled', withUnits(orbit.force.reduce((a, b) => Math.max(a, b), 0), 'N')],
          ['Touch-downs per revolution', shown(touches / (orbit.time.length / orbit.samples))]);
      } else if (result) {
        pairs.push(['Status', `left off in revolution ${result.orbit.failedRevolution + 1}: ${result.orbit.ending}`]);
      }
    } else {
      for (const map of atlas.maps) {
        const value = values[map.name][this.point];
        if (map.name === 'restarted' || (map.name === 'status_detail' && values.status[this.point] === 1)) continue;
        if (map.flags || Number.isFinite(value)) pairs.push([capital(words(map.name)), mapWord(map, this.point)]);
      }
    }
    const list = (items, kind) =>
      element('dl', {class: kind},
        ...items.map(([name, value]) => element('div', {class: value.length > 30 && 'long'},
          element('dt', {text: name}), element('dd', {text: value}))));
    holder.replaceChildren(list(coordinates, 'coordinates'), list(pairs, 'results'));
  }

  // --- from the atlas ---

  async line() {
    const number = lineOf(this.point);
    const {poincare, spectrum} = atlas.lines;
    return {poincare: poincare ? await numbers(poincare.lines[number]) : null,
      spectrum: spectrum ? await numbers(spectrum.lines[number]) : null, number};
  }
  async showAtlas() {
    const opened = await this.line();
    if (opened.number !== lineOf(this.point)) return;  // another line has been chosen while this one was unpacked
    this.opened = opened;
    this.drawLine();
    this.drawPoint();
  }
  get speed() { return this.state.own ? this.state.own.speed_ratio : axes[SPEED].values[this.state.place[SPEED]]; }
  drawLine() {
    const speeds = axes[SPEED].values;
    const margin = 0.02 * (speeds[speeds.length - 1] - speeds[0] || 1);
    const across = [speeds[0] - margin, speeds[speeds.length - 1] + margin];
    const cursor = {kind: 'vertical', x: this.speed, colour: VERMILION, width: 1.5};
    const cursorEntry = {mark: 'line', colour: VERMILION, word: 'selected speed'};
    // The line that has been unpacked, whatever point of its own the page shows beside it.
    const line = aboutCell(placeOf(this.opened.number * sizes[SPEED]), [SPEED]);
    if (this.charts.bifurcation && this.opened.poincare) {
      const kept = atlas.lines.poincare.sections;
      if (this.dotsOf !== `${this.opened.number}/${this.component}`) {
        const x = [], y = [];
        for (let i = 0; i < speeds.length; ++i) {
          for (let section = 0; section < kept; ++section) {
            const value = this.opened.poincare[2 * (i * kept + section) + this.component];
            if (!Number.isNaN(value)) { x.push(speeds[i]); y.push(1e3 * value); }
          }
        }
        this.dots = {x, y};
        this.dotsOf = `${this.opened.number}/${this.component}`;
      }
      const size = this.dots.x.length > 20000 ? 1 : this.dots.x.length > 3000 ? 1.5 : 2.5;
      const component = 'xy'[this.component];
      const {x, y} = this.dots;
      this.charts.bifurcation.chart.show({layers: [{kind: 'dots', x, y, colour: strong(), size}, cursor],
        x: across, y: rangeOf([y]), keepZoom: true, yLabel: `${component} at the sections [mm]`,
        about: line, legend: [{mark: 'dots', colour: strong(), word: 'sections of the atlas'}, cursorEntry],
        csv: () => ({speed_ratio: x, [column(component, 'm')]: y.map(inMetres)})});
    }
    if (this.charts.waterfall && this.opened.spectrum) this.drawWaterfall(across, cursor, line, cursorEntry);
  }
  drawWaterfall(across, cursor, line, cursorEntry) {
    const {orders} = atlas.lines.spectrum;
    const speeds = axes[SPEED].values;
    const codes = this.opened.spectrum;
    const top = Math.min(orders[orders.length - 1] * speeds[speeds.length - 1], 4);
    // Cells reach half way to the next speed.
    const end = speeds.length - 1;
    const from = speeds[0] - (end ? (speeds[1] - speeds[0]) / 2 : 0.01);
    const to = speeds[end] + (end ? (speeds[end] - speeds[end - 1]) / 2 : 0.01);
    if (this.waterfallOf !== this.opened.number) {
      const rows = 260;
      const MOST_COLUMNS = 4096;
      const least = speeds.reduce((gap, speed, i) => (i ? Math.min(gap, speed - speeds[i - 1]) : gap), to - from);
      const columns = Math.min(MOST_COLUMNS, Math.round((to - from) / least));
      const canvas = element('canvas');
      canvas.width = columns;
      canvas.height = rows;
      const context = canvas.getContext('2d');
      const image = context.createImageData(columns, rows);
      for (let at = 0, i = 0; at < columns; ++at) {
        const speed = from + (at + 0.5) * (to - from) / columns;
        while (i < end && speeds[i + 1] - speed < speed - speeds[i]) ++i;
        if (values.status[lineOf(this.point) * sizes[SPEED] + i] !== 1) continue;
        for (let row = 0, first = 0; row < rows; ++row) {
          const [low, high] = [row, row + 1].map((edge) => top * edge / rows / speeds[i]);
          while (first + 1 < orders.length && orders[first + 1] - low <= low - orders[first]) ++first;
          if (low > orders[orders.length - 1]) break;
          // The largest line that falls into the cell: an average would hide the sharp ones of periodic motion. Where
          // none does, the nearest.
          let code = codes[i * orders.length + first];
          for (let k = first + 1; k < orders.length && orders[k] < high; ++k) {
            code = Math.max(code, codes[i * orders.length + k]);
          }
          const share = (code / 65535 * 8 - 3) / 5;  // five decades
          const pixel = 4 * ((rows - 1 - row) * columns + at);
          image.data.set(viridis(share), pixel);
          image.data[pixel + 3] = 255;
        }
      }
      context.putImageData(image, 0, 0);
      this.waterfall = canvas;
      this.waterfallOf = this.opened.number;
    }
    const count = atlas.scene.blades.count;
    const {largest} = atlas.lines.spectrum;
    const marked = [...new Set([1, 2, 3, count])];
    const marks = marked.map((order) =>
      ({kind: 'line', x: [from, to], y: [order * from, order * to], colour: '#ffffff88', width: 1, dash: [4, 4]}));
    this.charts.waterfall.chart.show({layers: [{kind: 'image', source: this.waterfall, x: [from, to], y: [0, top]},
      ...marks, cursor], x: across, y: [0, top], keepZoom: true, about: line,
      legend: [{mark: 'strip', before: withUnits(1e-5 * largest, 'm', 3),
        word: `${withUnits(largest, 'm', 3)} (logarithmic)`},
      {mark: 'line', colour: quiet(), dash: [4, 4], word: `orders ${marked.join(', ')}`}, cursorEntry],
      csv: () => this.waterfallColumns()});
  }
  amplitude(code) {
    const {largest, decades} = atlas.lines.spectrum;
    return code === 0 ? 0 : largest * 10 ** (code / 65535 * decades - decades);
  }
  waterfallColumns() {
    const {orders} = atlas.lines.spectrum;
    const columns = {order: orders.map((order) => Number(order.toPrecision(8)))};
    axes[SPEED].values.forEach((speed, i) => {
      columns[column(`amplitude_at_${speed}`, 'm')] =
        orders.map((_, bin) => Number(this.amplitude(this.opened.spectrum[i * orders.length + bin]).toPrecision(5)));
    });
    return columns;
  }
  drawPoint() {
    this.drawSections();
    this.drawSpectrum();
  }
  atlasSections() {
    if (!this.opened?.poincare || this.state.own) return null;
    const kept = atlas.lines.poincare.sections;
    const at = this.state.place[SPEED] * 2 * kept;
    const x = [], y = [];
    for (let i = 0; i < kept; ++i) {
      x.push(1e3 * this.opened.poincare[at + 2 * i]);
      y.push(1e3 * this.opened.poincare[at + 2 * i + 1]);
    }
    return Number.isNaN(x[0]) ? null : {x, y};
  }
  drawSections() {
    const own = this.atlasSections();
    const [exactX, exactY] = [0, 1].map((part) => componentOf(this.result?.sections ?? [], part));
    const computed = exactX.length > 0 && {x: inMillimetres(exactX), y: inMillimetres(exactY)};
    const layers = [], legend = [];
    const add = (dots, colour, size, word) => {
      layers.push({kind: 'dots', ...dots, colour, size});
      legend.push({mark: 'dots', colour, word});
    };
    if (own) add(own, strong(), 5, `${counted(own.x.length, 'sections')} of the atlas`);
    if (computed) add(computed, VERMILION, 3, `${computed.x.length} computed here`);
    const {chart, badge} = this.charts.poincare;
    const x = layers.flatMap((layer) => [layer.x]), y = layers.flatMap((layer) => [layer.y]);
    // Sections of a periodic motion are one dot: the width of the picture is a share of their distance from rest, not
    // of rounding.
    const size = [...x, ...y].reduce((most, all) => all.reduce((a, b) => Math.max(a, Math.abs(b)), most), 0);
    const least = Math.max(1e-2 * size, 1e-9);
    const around = (all) => {
      const [low, high] = rangeOf(all, 0.15);
      return high - low < least ? [(low + high) / 2 - least, (low + high) / 2 + least] : [low, high];
    };
    const columnsOf = (from, x, y) => ({[column(`${from}_x`, 'm')]: x, [column(`${from}_y`, 'm')]: y});
    chart.show({layers, x: around(x), y: around(y), about: this.shownAbout, legend,
      note: layers.length ? '' : 'no motion to show',
      csv: () => ({...(own ? columnsOf('atlas', own.x.map(inMetres), own.y.map(inMetres)) : {}),
        ...(computed ? columnsOf('computed', exactX, exactY) : {})})});
    badge.textContent = own && computed ? 'atlas and page' : own ? FROM_ATLAS : COMPUTED;
    badge.classList.toggle('computed', !own);
  }
  drawSpectrum() {
    const layers = [], columns = {}, legend = [];
    let highest = 0;
    const floor = (value) => Math.log10(Math.max(1e3 * value, 1e-12));
    const add = (orders, amplitudes, colour, word) => {
      layers.push({kind: 'bars', x: orders, y: Array.from(amplitudes, floor), colour, width: 1});
      legend.push({mark: 'line', colour, word});
    };
    if (!this.state.own && this.opened?.spectrum && values.status[this.point] === 1) {
      const {orders} = atlas.lines.spectrum;
      const at = this.state.place[SPEED] * orders.length;
      const all = orders.map((_, bin) => this.amplitude(this.opened.spectrum[at + bin]));
      columns.atlas_order = orders.map((order) => Number(order.toPrecision(8)));
      columns[column('atlas_amplitude', 'm')] = all.map((value) => Number(value.toPrecision(5)));
      highest = Math.max(highest, ...all);
      add(orders, all, strong(), 'of the atlas');
    }
    if (this.result?.spectrum) {
      const {amplitude, revolutions} = this.result.spectrum;
      const orders = Array.from(amplitude, (_, k) => k / revolutions);
      columns.computed_order = orders;
      columns[column('computed_amplitude', 'm')] = Array.from(amplitude);
      highest = Math.max(highest, ...amplitude);
      if (!layers.length) add(orders, amplitude, VERMILION, 'computed here');
    }
    const top = Math.ceil(floor(highest || 1));
    const {chart, badge} = this.charts.spectrum;
    chart.show({layers, x: [0, atlas.scene.spectrum?.max_order ?? 12], y: [top - 6, top + 0.2], keepZoom: true, legend,
      about: this.shownAbout, note: layers.length ? '' : 'no motion to show', csv: () => columns});
    const computed = this.state.own || (layers.length && layers[0].colour === VERMILION);
    badge.textContent = computed ? COMPUTED : FROM_ATLAS;
    badge.classList.toggle('computed', Boolean(computed));
  }

  // --- computed ---

  /// Shows an answer of the solver, or an orbit of the program; null while there is none, and `missing` says why.
  showComputed(result, missing = '') {
    this.result = result;
    const orbit = result?.orbit?.status === 1 ? result.orbit : null;
    this.rotor.show(orbit, result?.wanted, missing, this.shownAbout);
    this.drawOrbit(orbit);
    this.drawForces(orbit, result?.wanted);
    if (this.opened) this.drawPoint();
    this.showFacts();
  }
  /// What the panels of the point are of: an answer may be there for a point that is no longer the selected one.
  get shownAbout() { return this.result?.about ?? this.about; }
  drawOrbit(orbit) {
    const {chart} = this.charts.orbit;
    const [exactX, exactY] = [0, 1].map((part) => (orbit ? componentOf(orbit.state, part) : []));
    const [x, y] = [exactX, exactY].map(inMillimetres);
    const wanted = this.result?.wanted;
    const layers = [], legend = [];
    if (orbit) {
      const clearance = 1e3 * (wanted.ring_radius - wanted.hub_radius - wanted.blade_length);
      layers.push({kind: 'line', x, y, colour: strong(), width: 1});
      const revolutions = counted(orbit.time.length / orbit.samples, 'revolutions');
      legend.push({mark: 'line', colour: strong(), word: `shaft, ${revolutions}`});
      if (clearance > 0) {
        const dash = [5, 4];
        layers.push({kind: 'circle', x: 0, y: -1e3 * wanted.misalignment, radius: clearance, colour: ink(), width: 1.2,
          dash});
        legend.push({mark: 'line', colour: ink(), dash, word: 'a blade that points outwards touches'});
      }
    }
    this.orbitLayers = layers;
    const {ending} = this.result?.orbit ?? {};
    chart.show({layers, x: rangeOf([x], 0.12), y: rangeOf([y], 0.12), about: this.shownAbout, legend,
      note: orbit ? '' : ending ? `no motion: ${ending}` : 'no motion to show',
      csv: () => ({[column('x', 'm')]: exactX, [column('y', 'm')]: exactY})});
  }
  /// Where the animation is, on the orbit.
  markOrbit(now) {
    if (!this.orbitLayers) return;
    const {chart} = this.charts.orbit;
    chart.layers = [...this.orbitLayers,
      {kind: 'dots', x: [1e3 * now.x], y: [1e3 * now.y], colour: VERMILION, size: 8}];
    chart.plot.redraw(false);
  }
  drawForces(orbit, wanted) {
    const {chart} = this.charts.forces;
    const layers = [], legend = [];
    const period = orbit ? 2 * Math.PI / wanted.speed_ratio : 1;
    const total = orbit ? orbit.time.length / orbit.samples : 4;
    const from = Math.max(0, total - 4);
    const columns = {blade: [], tau: [], [column('force', 'N')]: []};
    if (orbit) {
      const {number, blade, time, force, tau = time} = orbit.contact;
      const lines = new Map();
      number.forEach((contact, i) => {
        [blade[i] + 1, tau[i], force[i]].forEach((value, place) => Object.values(columns)[place].push(value));
        if (time[i] < (from - 1) * period) return;
        if (!lines.has(contact)) {
          lines.set(contact, {kind: 'line', x: [time[i] / period], y: [0], colour: cycle()[blade[i] % 6], width: 1.5});
        }
        lines.get(contact).x.push(time[i] / period);
        lines.get(contact).y.push(force[i]);
      });
      for (const one of lines.values()) { one.x.push(one.x[one.x.length - 1]); one.y.push(0); }
      layers.push(...lines.values());
      for (let i = 0; layers.length && i < Math.min(orbit.blades, 6); ++i) {
        legend.push({mark: 'line', colour: cycle()[i], word: `blade ${i + 1}`});
      }
    }
    chart.show({layers, x: [from, total], y: [0, rangeOf(layers.map((layer) => layer.y), 0.08)[1] || 1],
      about: this.shownAbout, legend, note: layers.length ? '' : orbit ? 'no contact' : 'no motion to show',
      csv: () => columns});
  }
}

// Quantities of a point off the grid, and how far their sliders reach around the scene's values.
const OWN = [
  {name: 'speed_ratio', symbol: 'Ω', long: 'Speed ratio', units: '-', axis: 'speed_ratio', low: () => 0.05,
    high: (value) => Math.max(1, 1.2 * value), limit: [1e-4, 1e3]},
  {name: 'damping_ratio', symbol: 'ζ', long: 'Damping ratio', units: '-', axis: 'damping_ratio', low: () => 0,
    high: (value) => Math.max(0.4, 2 * value), limit: [0, 1e3]},
  {name: 'friction', symbol: 'μ', long: 'Friction', units: '-', axis: 'friction', low: () => 0, high: () => 1,
    limit: [0, 2]},
  {name: 'unbalance', symbol: 'me', long: 'Unbalance', units: 'kg m', axis: 'unbalance', low: () => 0,
    high: (value) => Math.max(1e-4, 2 * value), limit: [0, 1e6]},
  {name: 'thickness', symbol: 'h', long: 'Thickness', units: 'm', axis: 'thickness', low: (value) => value / 4,
    high: (value) => 3 * value, limit: [1e-9, 1e3]},
  {name: 'misalignment', symbol: 'y0', long: 'Misalignment', units: 'm', axis: 'rotor_misalignment',
    low: (value) => 0.95 * value, high: (value) => 1.05 * value, limit: [-1e3, 1e3]},
];
const aboutOwn = (own) => ({
  words: listed(OWN.map(({name, symbol, units}) => [symbol, withUnits(own[name], units, 5)])),
  values: OWN.map(({name, units}) => [column(name, units), own[name]])});
/// How far a blade that points to where the shaft is would reach beyond the ring [m].
const beyondRing = ({x, y, misalignment, hub_radius: hub, blade_length: length, ring_radius: radius}) =>
  Math.hypot(x, y + misalignment) + hub + length - radius;
/// What ended a motion, and that its start lies beyond the ring where the ring is no longer where it was for `before`.
function endingOf(orbit, wanted, before) {
  const beyond = beyondRing(wanted);
  if (orbit.status === 1 || beyond <= Math.max(0, beyondRing({...wanted, misalignment: before.misalignment}))) {
    return orbit.ending;
  }
  return `the start lies ${withUnits(beyond, 'm')} beyond the ring; ${orbit.ending}`;
}
