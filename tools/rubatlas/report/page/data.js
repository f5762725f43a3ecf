// --- The atlas in this file: metadata at once, blocks of numbers when they are needed. ---

const atlas = JSON.parse(document.getElementById('atlas').textContent);
const queryGrammar = JSON.parse(document.getElementById('query-grammar').textContent);
const palette = JSON.parse(document.getElementById('palette').textContent);
const KINDS = {Float32Array, Float64Array, Uint8Array, Uint16Array};

async function unpacked(name) {
  const element = document.querySelector(`script[data-block="${name}"]`);
  if (!element) throw new Error(`the report has no block ${name}`);
  const letters = atob(element.textContent);
  const packed = new Uint8Array(letters.length);
  for (let i = 0; i < letters.length; ++i) packed[i] = letters.charCodeAt(i);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Response(stream).arrayBuffer();
}
const opened = new Map();
/// The numbers of a block, unpacked once. `place`: the entry that names it.
function numbers(place) {
  if (!opened.has(place.block)) {
    opened.set(place.block, unpacked(place.block).then((buffer) => new KINDS[place.kind](buffer)));
  }
  return opened.get(place.block);
}

// Axes, the last of them the speed ratio; a point is a list of places on them, and a number in C order.
const axes = atlas.axes;
const sizes = axes.map((axis) => axis.values.length);
const SPEED = axes.length - 1;
const pointCount = sizes.reduce((product, size) => product * size, 1);
const placeOf = (point) => {
  const place = new Array(axes.length);
  for (let axis = SPEED; axis >= 0; --axis) {
    place[axis] = point % sizes[axis];
    point = Math.floor(point / sizes[axis]);
  }
  return place;
};
const pointAt = (place) => place.reduce((point, index, axis) => point * sizes[axis] + index, 0);
/// The place of the value that is nearest to a number.
const nearestTo = (all, wanted) =>
  all.reduce((best, value, i) => (Math.abs(value - wanted) < Math.abs(all[best] - wanted) ? i : best), 0);
const lineOf = (point) => Math.floor(point / sizes[SPEED]);
const mapNamed = (name) => atlas.maps.find((map) => map.name === name);

// Values of all maps, by name; filled before anything is shown.
const values = {};
let finalStates = null, finalMemory = null;
async function openMaps() {
  await Promise.all(atlas.maps.map(async (map) => { values[map.name] = await numbers(map); }));
  finalStates = await numbers(atlas.final_state);
  finalMemory = await numbers(atlas.final_memory);
}

/// Whether no blade touches the ring at a point, as the maps say it; false where it is not known.
const isUntouched = (point) => values.contact?.[point] === 1;

// Orbits that the program has computed, by point.
const orbitsByPoint = new Map(atlas.orbits.map((entry) => [entry.point, entry]));
/// The orbit of a point as the solver gives one, from time 0; none where the file has none. `period`: of a revolution,
/// in τ.
async function storedOrbit(point, period) {
  const entry = orbitsByPoint.get(point);
  if (!entry) return null;
  const all = await numbers(entry);
  let taken = 0;
  const next = (count) => all.subarray(taken, taken += count);
  const {samples, times, blades, contact_samples: count} = entry;
  return {status: 1, blades, samples, time: Float64Array.from({length: times}, (_, i) => i * period / samples),
    state: next(4 * times), force: next(blades * times),
    contact: {number: next(count), blade: next(count), time: next(count).map((revolutions) => revolutions * period),
      force: next(count)}};
}

// --- How numbers and names look. The locale is the browser's; lengths are shown in millimetres. ---

const DRAWN = {m: ['mm', 1e3], 'kg m': ['g mm', 1e6]};
const drawn = (units) => DRAWN[units] || [units === '-' ? '' : units, 1];
const digits = new Map();
function shown(value, significant = 4) {
  if (value === null || Number.isNaN(value)) return 'none';
  if (!Number.isFinite(value)) return '∞';
  const size = Math.abs(value);
  const scientific = size !== 0 && (size < 1e-4 || size >= 1e6);
  const key = `${significant}${scientific}`;
  if (!digits.has(key)) {
    digits.set(key,
      new Intl.NumberFormat(undefined, scientific ? {notation: 'scientific', maximumSignificantDigits: significant}
      : {maximumSignificantDigits: significant, useGrouping: false}));
  }
  return digits.get(key).format(value);
}
function withUnits(value, units, significant) {
  const [unit, factor] = drawn(units);
  if (Number.isNaN(value) || value === null) return 'none';
  return isUnit(unit) ? `${shown(value * factor, significant)} ${unit}` : shown(value * factor, significant);
}
const isUnit = (units) => units && units !== '-' && units !== '1';
/// The name of a column or a value in a file: SI units, as in the atlas.
const column = (name, units) => (isUnit(units) ? `${name} [${units}]` : name);
/// A number of things: "1 point", "2 points".
const counted = (number, things) => `${shown(number, 9)} ${number === 1 ? things.replace(/s$/, '') : things}`;
const words = (name) => name.replace(/_/g, ' ');
const capital = (text) => text.charAt(0).toUpperCase() + text.slice(1);
function labelOf(axis) {
  const unit = drawn(axis.units)[0];
  const named = [capital(words(axis.name)), axis.symbol, isUnit(unit) ? `[${unit}]` : ''];
  return named.filter(Boolean).join(' ');
}
function mapLabel(map) {
  const unit = drawn(map.units)[0];
  return `${capital(words(map.name))}${isUnit(unit) && !map.flags ? ` [${unit}]` : ''}`;
}

// --- Colours: Okabe and Ito's, and viridis for what grows. ---

const BLUE = '#0072B2', ORANGE = '#E69F00', GREEN = '#009E73', VERMILION = '#D55E00', PURPLE = '#CC79A7',
  SKY = '#56B4E9', YELLOW = '#F0E442';
const CYCLE = [BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY];
const dark = window.matchMedia('(prefers-color-scheme: dark)');
const ink = () => getComputedStyle(document.documentElement).getPropertyValue('--ink').trim();
const quiet = () => getComputedStyle(document.documentElement).getPropertyValue('--quiet').trim();
const rule = () => getComputedStyle(document.documentElement).getPropertyValue('--rule').trim();
const ground = () => getComputedStyle(document.documentElement).getPropertyValue('--card').trim();
/// Blue is too dark on a dark ground; sky is its sister in the same palette.
const strong = () => (dark.matches ? SKY : BLUE);
const cycle = () => (dark.matches ? [SKY, VERMILION, GREEN, PURPLE, ORANGE, YELLOW] : CYCLE);

// Every sixteenth of viridis.
const VIRIDIS = ['440154', '481a6c', '472f7d', '414487', '39568c', '31688e', '2a788e', '23888e', '1f988b', '22a884',
  '35b779', '54c568',
  '7ad151', 'a5db36', 'd2e21b', 'fde725'].map((hex) => [0, 2, 4].map((at) => parseInt(hex.slice(at, at + 2), 16)));
function viridis(share) {
  const at = Math.min(Math.max(share, 0), 1) * (VIRIDIS.length - 1);
  const low = Math.min(Math.floor(at), VIRIDIS.length - 2);
  return VIRIDIS[low].map((from, channel) => Math.round(from + (at - low) * (VIRIDIS[low + 1][channel] - from)));
}
const rgb = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));

// As pictures have them: rubatlas/palette.json.
const entryOfFlag = ({first, last, status, name, colour, hatch}) =>
  ({first: first ?? status, last: last ?? status, mark: 'patch', word: name, colour, hatch});
const CLASSES = palette.classes.map(entryOfFlag);
const NO_MOTION = palette.no_motion.map(entryOfFlag);
const NO_CONTACT = entryOfFlag(palette.no_contact);
/// What the values of a flag are drawn in: legend entries with the `first` and the `last` value of each.
function flagEntries(map) {
  if (map.name.startsWith('class')) return CLASSES;
  if (map.name === 'status') return [{...CLASSES[0], word: map.flags[1]}, ...NO_MOTION];
  return Object.entries(map.flags).map(([value, word], index) =>
    ({first: Number(value), last: Number(value), mark: 'patch', word, colour: ['#d9dde3', ...CYCLE][index % 7]}));
}

function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key === 'text') made.textContent = value;
    else if (key.startsWith('on')) made.addEventListener(key.slice(2), value);
    else if (value !== null && value !== undefined && value !== false) {
      made.setAttribute(key, value === true ? '' : value);
    }
  }
  made.append(...children);
  return made;
}
const byId = (id) => document.getElementById(id);
