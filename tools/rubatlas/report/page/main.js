// --- What is selected, how it is changed, and the address that keeps it. ---

const state = {quantity: null, x: SPEED, y: 0, place: [], own: null, start: 'atlas', query: ''};

function firstState() {
  state.quantity = (mapNamed('class') || mapNamed('max_displacement') || atlas.maps[0]).name;
  // Over the speed and the axis with most values, or over the two axes with most values where there are few speeds.
  const bySize = axes.map((_, i) => i).sort((one, other) => sizes[other] - sizes[one] || other - one);
  state.x = sizes[SPEED] >= 6 || sizes[bySize[1]] === 1 ? SPEED : bySize[0];
  state.y = bySize.find((i) => i !== state.x);
  state.place = axes.map((axis, i) => {
    if (i === SPEED) return 0;
    if (!axis.pointer) return 0;
    const [section, key] = axis.pointer;
    return nearestTo(axis.values, atlas.scene[section]?.[key] ?? axis.values[0]);
  });
  // The periodic motion of largest displacement on the scene's own line says more than the corner of the map.
  const size = (index) => {
    const point = pointAt([...state.place.slice(0, SPEED), index]);
    const periodic = !values.class || (values.class[point] >= 1 && values.class[point] <= 16);
    return values.status[point] === 1 && periodic && values.max_displacement ? values.max_displacement[point] : -1;
  };
  let best = Math.floor(sizes[SPEED] / 2);
  for (let i = 0; i < sizes[SPEED]; ++i) if (size(i) > size(best)) best = i;
  state.place[SPEED] = best;
  // A page that shows stored orbits begins at one.
  const here = pointAt(state.place);
  if (atlas.not_computed && atlas.orbits.length && !orbitsByPoint.has(here)) state.place = nearestWithOrbit(here);
}
// --- The address: #map=class&at=speed_ratio=0.6,damping_ratio=0.1. It holds values, so that a link means the same in
// every atlas; what it asks for and is not there is said. ---

/// name=value pairs, separated by commas. `known`: what may be named, by name or symbol.
function pairsOf(text, known, refuse) {
  return text.split(',').flatMap((pair) => {
    const [name, value, ...rest] = pair.split('=').map((part) => part.trim());
    const index = known.findIndex((one) => name && (one.name === name || one.symbol === name));
    if (index >= 0 && value && !rest.length) return [[index, value]];
    refuse(index < 0 && value ? `${name} is none of ${known.map((one) => one.name).join(', ')}`
      : `${pair || 'nothing'} is no name=value`);
    return [];
  });
}
function readPlace(text, refuse) {
  for (const [i, value] of pairsOf(text, axes, refuse)) {
    const axis = axes[i], all = axis.values;
    const wanted = axis.name === 'direction' ? DIRECTIONS.indexOf(value) : Number(value);
    const nearest = nearestTo(all, wanted);
    const close = 1e-9 * Math.max(Math.abs(all[nearest]), Math.abs(wanted));  // as the program tells values apart
    if (axis.name === 'direction' && !all.includes(wanted)) refuse(`direction=${value} is neither up nor down here`);
    else if (!(Number.isFinite(wanted) && wanted >= all[0] - close && wanted <= all[all.length - 1] + close)) {
      refuse(`${axis.name}=${value} is outside ${all[0]} to ${all[all.length - 1]}`);
    } else {
      if (Math.abs(all[nearest] - wanted) > close) {
        refuse(`${axis.name}=${value} is between points; the nearest is ${all[nearest]}`);
      }
      state.place[i] = nearest;
    }
  }
}
function readOwn(text, refuse) {
  const own = ownValues();
  let sound = true;
  const refuseAll = (what) => { sound = false; refuse(what); };
  for (const [i, value] of pairsOf(text, OWN, refuseAll)) {
    const {name, limit} = OWN[i];
    if (Number(value) >= limit[0] && Number(value) <= limit[1]) own[name] = Number(value);
    else refuseAll(`${name}=${value} is outside ${limit[0]} to ${limit[1]}`);
  }
  return sound ? own : null;
}
function readAddress() {
  const given = new URLSearchParams(location.hash.slice(1));
  const refused = [];
  const refuse = (what) => refused.push(what.length > 200 ? `${what.slice(0, 200)}…` : what);
  const known = ['map', 'x', 'y', 'at', 'own', 'from', 'where'];
  for (const key of given.keys()) if (!known.includes(key)) refuse(`${key} is none of ${known.join(', ')}`);
  const quantity = given.get('map');
  if (mapNamed(quantity)) state.quantity = quantity;
  else if (quantity !== null) refuse(`map=${quantity} is no quantity of this atlas`);
  for (const side of ['x', 'y']) {
    const index = axes.findIndex((axis) => axis.name === given.get(side));
    if (index >= 0) state[side] = index;
    else if (given.has(side)) refuse(`${side}=${given.get(side)} is no axis of this atlas`);
  }
  if (state.x === state.y) {
    if (given.has('x') && given.has('y')) refuse(`x and y are both ${axes[state.x].name}`);
    const others = axes.map((_, i) => i).filter((i) => i !== state.x);
    state[given.has('x') ? 'y' : 'x'] = others.sort((one, other) => sizes[other] - sizes[one])[0];
  }
  state.own = null;
  if (given.has('at')) readPlace(given.get('at'), refuse);
  state.query = given.get('where') ?? '';
  state.start = given.get('from') === 'initial' ? 'initial' : 'atlas';
  if (given.has('from') && !['initial', 'atlas'].includes(given.get('from'))) {
    refuse(`from=${given.get('from')} is neither initial nor atlas`);
  }
  if (given.has('own')) state.own = readOwn(given.get('own'), refuse);
  byId('address-notice').hidden = !refused.length;
  byId('address-notice').textContent = `Not all of this link is shown here: ${refused.join('; ')}.`;
}
function addressOf() {
  const pairs = (all) => all.map((pair) => pair.join('=')).join(',');
  const swept = axes.map((axis, i) => [axis.name, valueWord(axis, state.place[i])]).filter((_, i) => sizes[i] > 1);
  const given = new URLSearchParams({map: state.quantity, x: axes[state.x].name, y: axes[state.y].name});
  if (swept.length) given.set('at', pairs(swept));
  if (state.query) given.set('where', state.query);
  if (state.own) given.set('own', pairs(OWN.map(({name}) => [name, state.own[name]])));
  if (state.start !== 'atlas') given.set('from', state.start);
  return `#${given}`.replace(/%2C/g, ',').replace(/%3D/g, '=');
}
let lastAct = '', lastAddress = null;
/// Keeps in the address what is shown. Back leads to where it was before the last act; acts of one kind that follow
/// each other, such as the steps of a walk, are one.
function writeAddress(act = '') {
  const address = addressOf();
  if (address !== lastAddress) {
    byId('address-notice').hidden = true;
    history[act && act === lastAct ? 'replaceState' : 'pushState'](null, '', address);
  }
  lastAct = act;
  lastAddress = address;
}

let map, view;
const computer = new Computer();

const startsFromCell = () => values.status[pointAt(state.place)] === 1 && state.start === 'atlas';
function askedFor() {
  const wanted = requestAt(state.place);
  const fromAtlas = startsFromCell();
  const first = 4 * pointAt(state.place);
  if (fromAtlas) {
    [wanted.x, wanted.y, wanted.vx, wanted.vy] = finalStates.subarray(first, first + 4);
    const {remembered} = atlas;
    wanted.memory = finalMemory.subarray(remembered * pointAt(state.place), remembered * (pointAt(state.place) + 1));
  }
  if (!state.own) return fromAtlas || state.start === 'initial' ? withTransient(wanted, !fromAtlas) : null;
  return withTransient({...wanted, ...state.own}, true);
}
function withTransient(wanted, needed) {
  if (!needed) return wanted;
  const revolutions = Math.min(atlas.scene.protocol.transient_revolutions, LONGEST_TRANSIENT);
  return {...wanted, transient_revolutions: revolutions, settle: 'newton'};
}

let asked = 0, running = false, again = false;
/// What the program has computed of the selected point, in a page that computes nothing.
async function showStored() {
  const wanted = requestAt(state.place);
  const point = pointAt(state.place);
  const orbit = await storedOrbit(point, 2 * Math.PI / wanted.speed_ratio);
  if (point !== pointAt(state.place)) return;
  const missing = atlas.orbits.length
    ? `This report has no orbit of this point; the nearest with one: ${aboutCell(nearestWithOrbit(point)).words}.` : '';
  view.showComputed(orbit && {orbit, wanted, about: aboutCell(state.place)}, missing);
  document.documentElement.dataset.computed = ++asked;
}
function nearestWithOrbit(point) {
  const distance = (other) => Math.abs(other - point) + (lineOf(other) === lineOf(point) ? 0 : pointCount);
  return placeOf(atlas.orbits.map((entry) => entry.point)
    .reduce((best, other) => (distance(other) < distance(best) ? other : best)));
}
/// Computes what is selected; of the questions that are asked while an answer is on its way only the last is answered.
async function compute() {
  if (computer.why) return showStored();
  if (running) { again = true; ++asked; return; }
  running = true;
  do {
    again = false;
    const wanted = askedFor();
    const own = Boolean(state.own);
    const {about} = view;
    byId('from-initial').hidden = true;
    if (!wanted) {
      view.showComputed(null);
      byId('answer-time').textContent = '';
      byId('own-status').textContent =
        'The atlas has no motion in this cell; a start from the initial state shows what ends it.';
      byId('from-initial').hidden = false;
      break;
    }
    try {
      const begin = performance.now();
      const answer = await computer.compute(wanted, atlas.scene.spectrum?.max_order ?? 12);
      if (again) continue;
      answer.orbit.ending = endingOf(answer.orbit, wanted, requestAt(state.place));
      view.showComputed({...answer, wanted, about, sections: answer.orbit.sections});
      byId('from-initial').hidden = answer.orbit.status === 1 || !startsFromCell();
      tell(answer, wanted, own, performance.now() - begin);
    } catch (error) {
      view.showComputed({error: error.message, wanted, about});
      byId('own-status').textContent = `Not computed: ${error.message}.`;
    }
  } while (again);
  running = false;
  document.documentElement.dataset.computed = ++asked;
}
function tell(answer, wanted, own, waited) {
  const {orbit} = answer;
  byId('answer-time').textContent = `answered in ${shown(waited / 1000, 2)} s`;
  const start = !startsFromCell() ? 'from the scene’s initial state' : own ? 'from the motion of the selected cell'
    : 'from the state that the atlas stores';
  const transient = wanted.transient_revolutions
    ? `, after up to ${counted(wanted.transient_revolutions, 'revolutions')} of transient`
    : '';
  byId('own-status').textContent = orbit.status === 1
    ? `Computed in this page ${start}${transient}: ${counted(view.result.sections.length / 4, 'sections')}.`
    : `Computed in this page ${start}: no motion, ${orbit.ending}.`;
}
/// Goes on from where the last answer ended, and adds its sections.
async function more() {
  const before = view.result;
  if (!before?.orbit || before.orbit.status !== 1 || running) return;
  running = true;
  const last = before.sections.length - 4;
  const [x, y, vx, vy] = before.sections.subarray(last, last + 4);
  const {scene, speed_ratio, sampled_revolutions} = before.wanted;
  const wanted = {...before.wanted, x, y, vx, vy, memory: before.orbit.memory, transient_revolutions: 0,
    settle: 'never', speed_ratio: speed_ratio + (scene.speed_ramp?.rate ?? 0) * sampled_revolutions};
  try {
    const answer = await computer.compute(wanted, atlas.scene.spectrum?.max_order ?? 12);
    const sections = new Float64Array(before.sections.length + answer.orbit.sections.length);
    sections.set(before.sections);
    sections.set(answer.orbit.sections, before.sections.length);
    view.showComputed({...answer, wanted, about: before.about, sections});
    byId('own-status').textContent = answer.orbit.status === 1
      ? `Continued: ${counted(sections.length / 4, 'sections')}.`
      : `Continued: ${answer.orbit.ending}.`;
  } catch (error) {
    byId('own-status').textContent = `Not computed: ${error.message}.`;
  }
  running = false;
  document.documentElement.dataset.computed = ++asked;
  if (again) compute();
}

/// Shows a cell that has been chosen; `act`: how, see `writeAddress`.
async function selected(act = '') {
  state.own = null;
  writeAddress(act);
  await showSelected();
}
async function showSelected() {
  showSliders();
  showOwn();
  view.result = null;
  view.showFacts();
  map.draw();
  await view.showAtlas();
  await compute();
}

// --- the map's controls ---

function fillControls() {
  const quantity = byId('map-quantity');
  for (const one of atlas.maps) quantity.append(element('option', {value: one.name, text: mapLabel(one)}));
  for (const [side, other] of [['x', 'y'], ['y', 'x']]) {
    const select = byId(`map-${side}`);
    axes.forEach((axis, i) => select.append(element('option', {value: i, text: labelOf(axis)})));
    select.onchange = () => {
      if (Number(select.value) === state[other]) state[other] = state[side];
      state[side] = Number(select.value);
      showControls();
      map.chart.zoomed = null;
      map.draw();
      writeAddress();
    };
  }
  quantity.onchange = () => { state.quantity = quantity.value; map.draw(); writeAddress(); };
}
function showControls() {
  byId('map-quantity').value = state.quantity;
  byId('map-x').value = state.x;
  byId('map-y').value = state.y;
  showSliders();
}
/// A slider for every axis that is swept and not drawn; the values of the others in words.
function showSliders() {
  const holder = byId('map-sliders');
  holder.replaceChildren();
  axes.forEach((axis, i) => {
    if (i === state.x || i === state.y || sizes[i] === 1) return;
    const value = () => placeWord(axis, state.place[i]);
    const word = element('output', {text: value()});
    const moved = (event) => {
      state.place[i] = Number(event.target.value);
      word.textContent = value();
      event.target.setAttribute('aria-valuetext', value());
      state.own = null;
      writeAddress(axis.name);
      map.draw();
    };
    const range = element('input', {type: 'range', min: 0, max: sizes[i] - 1, value: state.place[i],
      'data-axis': axis.name, 'aria-valuetext': value(), oninput: moved, onchange: () => selected(axis.name)});
    holder.append(element('label', {}, `${capital(words(axis.name))} ${axis.symbol} `, range, word));
  });
}
function mark() {
  const said = byId('query-answer');
  try {
    map.marks = state.query.trim() ? marked(state.query) : null;
    const count = map.marks ? map.marks.reduce((sum, one) => sum + one, 0) : 0;
    const done = values.status.filter((status) => status === 1).length;
    const echo = map.marks ? queryEcho(state.query) : '';
    said.textContent = map.marks
      ? `${shown(count, 9)} of ${shown(done, 9)} points that are done are marked${echo && `: ${echo}`}.` : '';
    said.classList.remove('wrong');
  } catch (error) {
    if (!(error instanceof QueryError)) throw error;
    map.marks = null;
    said.textContent = error.message;
    said.classList.add('wrong');
  }
  map.draw();
}

// --- sliders of a point off the grid ---

function fillOwn() {
  const holder = byId('own-sliders');
  const usual = requestAt(state.place);
  for (const quantity of OWN) {
    const {name, symbol, long, units} = quantity;
    const swept = axes.find((axis) => axis.name === quantity.axis);
    const [unit, factor] = drawn(units);
    const ends = swept && swept.values.length > 1 ? [swept.values[0], swept.values[swept.values.length - 1]]
      : [quantity.low(usual[name]), quantity.high(usual[name])];
    const [low, high] = [Math.min(...ends) * factor, Math.max(...ends) * factor || 1];
    const range = element('input', {type: 'range', min: low, max: high, step: (high - low) / 2000,
      'aria-label': `${long} ${symbol}`, 'data-own': name});
    const field = element('input', {type: 'number', min: quantity.limit[0] * factor, max: quantity.limit[1] * factor,
      step: 'any', 'aria-label': `${long} ${symbol}${isUnit(unit) ? ` in ${unit}` : ''}`,
      'data-own-number': name});
    const change = (text) => {
      const value = Number(text) / factor;
      const ends = quantity.limit.map((end) => Number((end * factor).toPrecision(12)));
      if (text === '' || !(Number(text) >= ends[0] && Number(text) <= ends[1])) {
        byId('own-status').textContent =
          `${long}: ${text || 'nothing'} is outside [${ends.join(', ')}]${isUnit(unit) ? ` ${unit}` : ''}.`;
        return;
      }
      state.own = {...ownValues(), [name]: value};
      writeAddress(`own ${name}`);
      showOwn(name);
      view.showFacts();
      view.drawLine();
      compute();
    };
    range.oninput = () => change(range.value);
    field.onchange = () => change(field.value);
    holder.append(element('label', {class: 'own'},
      element('span', {text: `${long} ${symbol}${isUnit(unit) ? ` [${unit}]` : ''}`}), range, field));
  }
  byId('back').onclick = () => selected();
  byId('more').onclick = () => more();
  const startFrom = (start) => { state.start = start; writeAddress(); showOwn(); compute(); };
  byId('own-start').onchange = (event) => startFrom(event.target.value);
  byId('from-initial').onclick = () => startFrom('initial');
}
function ownValues() {
  if (state.own) return state.own;
  const usual = requestAt(state.place);
  return Object.fromEntries(OWN.map(({name}) => [name, usual[name]]));
}
function showOwn() {
  const now = ownValues();
  for (const {name, units} of OWN) {
    const factor = drawn(units)[1];
    const range = document.querySelector(`[data-own=${name}]`);
    const field = document.querySelector(`[data-own-number=${name}]`);
    if (!range) return;
    if (document.activeElement !== range) range.value = now[name] * factor;
    range.setAttribute('aria-valuetext', withUnits(now[name], units, 6));
    field.value = Number((now[name] * factor).toPrecision(7));
  }
  byId('own-start').value = state.start;
  byId('back').disabled = !state.own;
}

// --- keys ---

function walk(axis, step) {
  const next = Math.min(Math.max(state.place[axis] + step, 0), sizes[axis] - 1);
  if (next === state.place[axis]) return;
  state.place[axis] = next;
  selected('walk');
}
function onKey(event) {
  const {target, key} = event;
  if (key === 'Escape') { target.blur?.(); return; }
  if (target.closest('input, select, textarea, summary, .scroll, pre') || event.ctrlKey || event.metaKey
    || event.altKey || (key === ' ' && target.closest('button'))) return;
  const far = event.shiftKey ? 10 : 1;
  const acts = {
    ArrowLeft: () => walk(state.x, -far), ArrowRight: () => walk(state.x, far),
    ArrowUp: () => walk(state.y, 1), ArrowDown: () => walk(state.y, -1),
    '+': () => map.zoom(2), '-': () => map.zoom(0.5), 0: () => map.zoom(null),
    ' ': () => togglePlay(), t: () => view.rotor.step(), q: () => byId('query').focus(),
  };
  const act = acts[key.length === 1 ? key.toLowerCase() : key];
  if (!act) return;
  event.preventDefault();
  act();
}
function togglePlay() {
  const {rotor} = view;
  if (rotor.playing) rotor.pause(); else rotor.play();
  showPlaying();
}
function showPlaying() {
  byId('play').textContent = view.rotor.playing ? 'Pause' : 'Play';
  byId('play').setAttribute('aria-pressed', view.rotor.playing);
}

function fillRotor() {
  const {rotor} = view;
  rotor.moved = (now) => view.markOrbit(now);
  byId('play').onclick = togglePlay;
  byId('step').onclick = () => { rotor.step(); showPlaying(); };
  byId('trail').onchange = (event) => { rotor.trail = event.target.checked; rotor.draw(); };
  const rate = () => {
    rotor.secondsPerRevolution = 10 ** Number(byId('rate').value);
    byId('rate-shown').textContent = `${shown(rotor.secondsPerRevolution, 2)} s a revolution`;
    byId('rate').setAttribute('aria-valuetext', byId('rate-shown').textContent);
  };
  const zoom = () => {
    rotor.zoom = Number(byId('zoom').value);
    byId('zoom-shown').textContent = `×${shown(10 ** rotor.zoom, 2)}`;
    byId('zoom').setAttribute('aria-valuetext', byId('zoom-shown').textContent);
    rotor.draw();
  };
  byId('rate').oninput = rate;
  byId('zoom').oninput = zoom;
  rate();
  zoom();
}

async function open() {
  document.title = atlas.title;
  byId('title').textContent = atlas.title;
  byId('reference').textContent = atlas.reference;
  const swept = axes.filter((axis) => axis.values.length > 1)
    .map((axis) => `${shown(axis.values.length, 7)} × ${words(axis.name)}${axis.symbol ? ` ${axis.symbol}` : ''}`);
  const {contact, blades} = atlas.scene;
  const grid = pointCount === 1 ? '' : `: ${swept.join(', ')}`;
  byId('summary').textContent =
    `${counted(pointCount, 'points')}${grid} · law ${contact.law}, ${counted(blades.count, 'blades')}`;
  await openMaps();
  firstState();
  readAddress();
  lastAddress = addressOf();
  view = new PointView(state);
  view.walkTo = (speed) => {
    state.place[SPEED] = nearestTo(axes[SPEED].values, speed);
    selected();
  };
  map = new AtlasMap(state, (place) => { state.place = place; selected(); byId('map').focus({preventScroll: true}); });
  exportButtons(document.querySelector('[data-export=map]'), map.chart);
  for (const [id, factor] of [['map-nearer', 2], ['map-farther', 0.5], ['map-whole', null]]) {
    byId(id).onclick = () => map.zoom(factor);
  }
  fillControls();
  showControls();
  fillOwn();
  fillRotor();
  showTables();
  byId('query').value = state.query;
  byId('query-help').append(...queryHelp().map((text) => element('p', {text})));
  byId('query-form').onsubmit = (event) => {
    event.preventDefault();
    state.query = byId('query').value;
    writeAddress();
    mark();
  };
  document.addEventListener('keydown', onKey);
  dark.addEventListener('change', () => {
    map.chart.build();
    map.draw();
    for (const {chart} of Object.values(view.charts)) chart.build();
    view.drawLine();
    view.showComputed(view.result);
  });
  window.addEventListener('hashchange', () => {
    firstState();
    readAddress();
    showControls();
    byId('query').value = state.query;
    [lastAct, lastAddress] = ['', addressOf()];
    mark();
    showSelected();
  });
  if (state.query) mark();
  showOwn();
  view.showFacts();
  map.draw();
  await view.showAtlas();
  view.showComputed(null);
  document.documentElement.dataset.ready = Math.round(performance.now());
  await computer.start(requestAt(state.place));
  byId('own').hidden = Boolean(computer.why);
  document.querySelector('.rotor').classList.toggle('alone', Boolean(computer.why));
  byId('not-computed').hidden = !computer.notice;
  byId('not-computed').textContent = computer.notice;
  view.showMotion(computer);
  await compute();
  document.documentElement.dataset.computer = computer.why ? 'none' : 'there';
}
open();
