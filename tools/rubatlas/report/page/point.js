// --- A point: its facts, its charts, and what the page computes of it. ---

const LAWS = {elastica: 0, elastic_ring: 1};
// Sections of one answer; more are computed on request, from where the last answer ended.
const REVOLUTIONS = 64;
const SAMPLES = 128;
// Tighter than the program's usual 1e-9: the atlas and the page use different methods, and are to agree within 1e-9 of
// the clearance.
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
/// The numbers that the solver asks for, of a place of the atlas.
function requestAt(place) {
  const scene = sceneAt(place);
  const {rotor, blades, ring, contact, unbalance, initial} = scene;
  return {
    speed_ratio: axes[SPEED].values[place[SPEED]], damping_ratio: rotor.damping_ratio, friction: contact.friction,
    unbalance: unbalance?.moment ?? 0, unbalance_phase: unbalance?.phase ?? 0, thickness: blades.thickness,
    misalignment: rotor.misalignment, mass: rotor.mass, natural_frequency: rotor.natural_frequency,
    blade_count: blades.count, blade_length: blades.length, blade_width: blades.width,
    youngs_modulus: blades.youngs_modulus, hub_radius: blades.hub_radius,
    ring_radius: ring.radius, ring_stiffness: ring.stiffness ?? 1, contact_law: LAWS[contact.law],
    max_shortening: scene.validity?.max_shortening ?? 0.5,
    tolerance: Math.min(scene.accuracy?.tolerance ?? TOLERANCE, TOLERANCE),
    x: initial?.x ?? 0, y: initial?.y ?? 0, vx: initial?.vx ?? 0, vy: initial?.vy ?? 0,
    transient_revolutions: 0, sampled_revolutions: REVOLUTIONS, samples_per_revolution: SAMPLES, stop_when_periodic: 0};
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
      await this.ask({wanted: {...near, transient_revolutions: 0, sampled_revolutions: 30}, maxOrder: 1});
    } catch (error) {
      this.why = `The page cannot compute points of its own (${error.message}).`;
      this.worker = null;
    }
  }
  /// What a page that computes nothing shows instead.
  get instead() {
    const count = atlas.orbits.length;
    const undrawn = {ring_body: 'the ring at rest', wear: 'blades without their wear',
      unequal_blades: 'blades without their errors'};
    const drawn = Object.keys(undrawn).filter((effect) => effect in atlas.scene).map((effect) => undrawn[effect]);
    return (count && drawn.length ? `The moving rotor is drawn with ${drawn.join(' and ')}. ` : '')
      + (count
        ? `What is shown comes from the atlas, and orbits from the program, which computed those of ${count} points ` +
          "from the atlas' states when this page was made."
      : 'Everything shown comes from the atlas.');
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

/// What single precision keeps of a number.
const eightDigits = (value) => Number(value.toPrecision(8));

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
      const chart = new Chart(box, {name: key, ...options});
      exportButtons(buttons, chart, () => `${heading} · ${this.describe()}`);
      this.charts[key] = {chart, card, note, badge};
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
    exportButtons(document.querySelector('[data-export=rotor]'), this.rotor, () => this.describe());
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
  /// The point in words; `place`: a cell, the selected point by default.
  describe(place) {
    const {own} = this.state;
    const at = place ?? this.state.place;
    const parts = own && !place ? OWN.map(({name, symbol, units}) => `${symbol} ${withUnits(own[name], units, 5)}`)
      : axes.map((axis, i) => `${axis.symbol || words(axis.name)} ${placeWord(axis, at[i])}`);
    return parts.join(', ');
  }
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
        if (map.flags) pairs.push([capital(words(map.name)), map.flags[value] ?? 'none']);
        else if (Number.isFinite(value)) pairs.push([capital(words(map.name)), withUnits(value, map.units)]);
      }
    }
    const list = (items, kind) =>
      element('dl', {class: kind},
        ...items.map(([name, value]) => element('div', {}, element('dt', {text: name}), element('dd', {text: value}))));
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
      this.charts.bifurcation.chart.show({layers: [{kind: 'dots', ...this.dots, colour: strong(), size}, cursor],
        x: across, y: rangeOf([this.dots.y]), keepZoom: true, yLabel: `${component} at the sections [mm]`,
        csv: () => ({speed_ratio: this.dots.x, [`${component}_mm`]: this.dots.y.map(eightDigits)})});
    }
    if (this.charts.waterfall && this.opened.spectrum) this.drawWaterfall(across, cursor);
  }
  drawWaterfall(across, cursor) {
    const {orders, width} = atlas.lines.spectrum;
    const speeds = axes[SPEED].values;
    const codes = this.opened.spectrum;
    const top = Math.min(orders[orders.length - 1] * speeds[speeds.length - 1], 4);
    if (this.waterfallOf !== this.opened.number) {
      const rows = 260;
      const canvas = element('canvas');
      canvas.width = speeds.length;
      canvas.height = rows;
      const context = canvas.getContext('2d');
      const image = context.createImageData(speeds.length, rows);
      const bins = orders.length;
      for (let i = 0; i < speeds.length; ++i) {
        if (values.status[lineOf(this.point) * sizes[SPEED] + i] !== 1) continue;
        for (let row = 0; row < rows; ++row) {
          // The largest bin that falls into the cell: an average would hide the sharp lines of periodic motion.
          const low = Math.max(0, Math.round(top * row / rows / speeds[i] / width));
          const high = Math.max(low, Math.round(top * (row + 1) / rows / speeds[i] / width) - 1);
          if (low >= bins) continue;
          let code = 0;
          for (let bin = low; bin <= Math.min(high, bins - 1); ++bin) code = Math.max(code, codes[i * bins + bin]);
          const share = (code / 65535 * 8 - 3) / 5;  // five decades
          const at = 4 * ((rows - 1 - row) * speeds.length + i);
          image.data.set(viridis(share), at);
          image.data[at + 3] = 255;
        }
      }
      context.putImageData(image, 0, 0);
      this.waterfall = canvas;
      this.waterfallOf = this.opened.number;
    }
    const step = speeds.length > 1 ? (speeds[speeds.length - 1] - speeds[0]) / (speeds.length - 1) / 2 : 0.01;
    const from = speeds[0] - step, to = speeds[speeds.length - 1] + step;
    const count = atlas.scene.blades.count;
    const marks = [...new Set([1, 2, 3, count])].map((order) =>
      ({kind: 'line', x: [from, to], y: [order * from, order * to], colour: '#ffffff88', width: 1, dash: [4, 4]}));
    this.charts.waterfall.chart.show({layers: [{kind: 'image', source: this.waterfall, x: [from, to], y: [0, top]},
      ...marks, cursor], x: across, y: [0, top], keepZoom: true,
      csv: () => this.waterfallColumns()});
    const highest = withUnits(atlas.lines.spectrum.largest, 'm', 3);
    this.charts.waterfall.note.textContent =
      `Five decades below ${highest}; dashed: orders 1, 2, 3${count > 3 ? ` and ${count}` : ''}.`;
  }
  amplitude(code) {
    const {largest, decades} = atlas.lines.spectrum;
    return code === 0 ? 0 : largest * 10 ** (code / 65535 * decades - decades);
  }
  waterfallColumns() {
    const {orders} = atlas.lines.spectrum;
    const columns = {order: orders.map((order) => Number(order.toPrecision(8)))};
    axes[SPEED].values.forEach((speed, i) => {
      columns[`amplitude_m_at_${speed}`] =
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
    const computed = this.result?.sections ? {x: [], y: []} : null;
    for (let i = 0; computed && i < this.result.sections.length; i += 4) {
      computed.x.push(1e3 * this.result.sections[i]);
      computed.y.push(1e3 * this.result.sections[i + 1]);
    }
    const layers = [];
    if (own) layers.push({kind: 'dots', ...own, colour: strong(), size: 5});
    if (computed) layers.push({kind: 'dots', ...computed, colour: VERMILION, size: 3});
    const {chart, note, badge} = this.charts.poincare;
    const x = layers.flatMap((layer) => [layer.x]), y = layers.flatMap((layer) => [layer.y]);
    // Sections of a periodic motion are one dot: the width of the picture is a share of their distance from rest, not
    // of rounding.
    const size = [...x, ...y].reduce((most, all) => all.reduce((a, b) => Math.max(a, Math.abs(b)), most), 0);
    const least = Math.max(1e-2 * size, 1e-9);
    const around = (all) => {
      const [low, high] = rangeOf(all, 0.15);
      return high - low < least ? [(low + high) / 2 - least, (low + high) / 2 + least] : [low, high];
    };
    const csv = () => ({
      ...(own ? {atlas_x_mm: own.x.map(eightDigits), atlas_y_mm: own.y.map(eightDigits)} : {}),
      ...(computed ? {computed_x_mm: computed.x, computed_y_mm: computed.y} : {})});
    chart.show({layers, x: around(x), y: around(y), csv});
    badge.textContent = own && computed ? 'atlas and page' : own ? FROM_ATLAS : COMPUTED;
    badge.classList.toggle('computed', !own);
    const said = [own ? `blue: ${own.x.length} sections of the atlas` : '',
      computed ? `vermilion: ${computed.x.length} computed here` : ''];
    note.textContent = said.filter(Boolean).join('; ') || 'no motion to show';
  }
  drawSpectrum() {
    const layers = [], csv = {};
    let highest = 0;
    const floor = (value) => Math.log10(Math.max(1e3 * value, 1e-12));
    if (!this.state.own && this.opened?.spectrum && values.status[this.point] === 1) {
      const {orders} = atlas.lines.spectrum;
      const at = this.state.place[SPEED] * orders.length;
      const all = orders.map((_, bin) => this.amplitude(this.opened.spectrum[at + bin]));
      csv.atlas_order = orders.map((order) => Number(order.toPrecision(8)));
      csv.atlas_amplitude_m = all.map((value) => Number(value.toPrecision(5)));
      highest = Math.max(highest, ...all);
      layers.push({kind: 'bars', x: orders, y: all.map(floor), colour: strong(), width: 1});
    }
    if (this.result?.spectrum) {
      const {amplitude, revolutions} = this.result.spectrum;
      const orders = Array.from(amplitude, (_, k) => k / revolutions);
      csv.computed_order = orders;
      csv.computed_amplitude_m = Array.from(amplitude);
      highest = Math.max(highest, ...amplitude);
      if (this.state.own || !layers.length) {
        layers.push({kind: 'bars', x: orders, y: Array.from(amplitude, floor), colour: VERMILION, width: 1});
      }
    }
    const top = Math.ceil(floor(highest || 1));
    const {chart, badge} = this.charts.spectrum;
    chart.show({layers, x: [0, atlas.scene.spectrum?.max_order ?? 12], y: [top - 6, top + 0.2], keepZoom: true, csv});
    const computed = this.state.own || (layers.length && layers[0].colour === VERMILION);
    badge.textContent = computed ? COMPUTED : FROM_ATLAS;
    badge.classList.toggle('computed', Boolean(computed));
  }

  // --- computed ---

  /// Shows an answer of the solver, or an orbit of the program; null while there is none, and `missing` says why.
  showComputed(result, missing = '') {
    this.result = result;
    const orbit = result?.orbit?.status === 1 ? result.orbit : null;
    this.rotor.show(orbit, result?.wanted, missing);
    this.drawOrbit(orbit);
    this.drawForces(orbit, result?.wanted);
    if (this.opened) this.drawPoint();
    this.showFacts();
  }
  drawOrbit(orbit) {
    const {chart, note} = this.charts.orbit;
    const x = [], y = [];
    for (let i = 0; orbit && i < orbit.time.length; ++i) {
      x.push(1e3 * orbit.state[4 * i]);
      y.push(1e3 * orbit.state[4 * i + 1]);
    }
    const wanted = this.result?.wanted;
    const layers = [];
    if (orbit) {
      const clearance = 1e3 * (wanted.ring_radius - wanted.hub_radius - wanted.blade_length);
      layers.push({kind: 'line', x, y, colour: strong(), width: 1});
      if (clearance > 0) {
        layers.push({kind: 'circle', x: 0, y: -1e3 * wanted.misalignment, radius: clearance, colour: ink(), width: 1.2,
          dash: [5, 4]});
      }
    }
    this.orbitLayers = layers;
    const [rangeX, rangeY] = [rangeOf([x], 0.12), rangeOf([y], 0.12)];
    this.orbitView = {x: rangeX, y: rangeY, csv: () => ({x_mm: x, y_mm: y})};
    chart.show({layers, ...this.orbitView});
    const {ending} = this.result?.orbit ?? {};
    note.textContent = !orbit ? (ending ? `no motion: ${ending}` : 'no motion to show')
      : `${orbit.time.length / orbit.samples} revolutions; ` +
        'dashed: the circle at which a blade that points outwards touches';
  }
  /// Where the animation is, on the orbit.
  markOrbit(now) {
    if (!this.orbitView) return;
    const {chart} = this.charts.orbit;
    chart.layers = [...this.orbitLayers,
      {kind: 'dots', x: [1e3 * now.x], y: [1e3 * now.y], colour: VERMILION, size: 8}];
    chart.plot.redraw(false);
  }
  drawForces(orbit, wanted) {
    const {chart, note} = this.charts.forces;
    const layers = [];
    const period = orbit ? 2 * Math.PI / wanted.speed_ratio : 1;
    const total = orbit ? orbit.time.length / orbit.samples : 4;
    const from = Math.max(0, total - 4);
    const csv = {blade: [], tau: [], force_N: []};
    if (orbit) {
      const {number, blade, time, force} = orbit.contact;
      const lines = new Map();
      number.forEach((contact, i) => {
        csv.blade.push(blade[i] + 1); csv.tau.push(time[i]); csv.force_N.push(force[i]);
        if (time[i] < (from - 1) * period) return;
        if (!lines.has(contact)) {
          lines.set(contact, {kind: 'line', x: [time[i] / period], y: [0], colour: cycle()[blade[i] % 6], width: 1.5});
        }
        lines.get(contact).x.push(time[i] / period);
        lines.get(contact).y.push(force[i]);
      });
      for (const one of lines.values()) { one.x.push(one.x[one.x.length - 1]); one.y.push(0); }
      layers.push(...lines.values());
    }
    chart.show({layers, x: [from, total], y: [0, rangeOf(layers.map((layer) => layer.y), 0.08)[1] || 1],
      csv: () => csv});
    note.replaceChildren();
    if (!layers.length) note.textContent = orbit ? 'no contact' : 'no motion to show';
    else for (let i = 0; i < Math.min(orbit.blades, 6); ++i) {
      const patch = element('i');
      patch.style.background = cycle()[i];
      note.append(element('span', {class: 'chip'}, patch, `blade ${i + 1}`));
    }
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
