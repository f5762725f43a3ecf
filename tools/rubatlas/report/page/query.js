// --- Conditions on points, as rubatlas/query.py reads them: the grammar is in rubatlas/query_grammar.json. ---

class QueryError extends Error {}
const queryRefusal = (grammar, sentence, facts = {}) =>
  new QueryError(grammar.sentences[sentence].replace(/\{(\w+)\}/g, (_, name) => facts[name]));

// What the operators do, by the names that the grammar gives it.
const QUERY_DOES = {
  or: (a, b) => a || b, and: (a, b) => a && b, not: (a) => !a, negate: (a) => -a, keep: (a) => a,
  less: (a, b) => a < b, at_most: (a, b) => a <= b, greater: (a, b) => a > b, at_least: (a, b) => a >= b,
  equal: (a, b) => a === b, differ: (a, b) => a !== b,
  add: (a, b) => a + b, subtract: (a, b) => a - b, multiply: (a, b) => a * b, divide: (a, b) => a / b,
  power: (a, b) => (a === 1 ? 1 : a ** b),  // 1 whatever b is, NaN included, as everywhere else
};

const entryOf = (table, key) => (Object.hasOwn(table, key) ? table[key] : null);

/// The known word that has most pairs of letters in common with another one.
function nearest(word, known) {
  const pairs = (text) => {
    const padded = ` ${text} `.toLowerCase();
    return new Set(Array.from(padded.slice(1), (letter, i) => padded[i] + letter));
  };
  const alike = (one) => {
    const [own, other] = [pairs(word), pairs(one)];
    return [...own].filter((pair) => other.has(pair)).length / (own.size + other.size);
  };
  return known.reduce((best, one) => (alike(one) > alike(best) ? one : best));
}

/// The unit that stands at a place of the text; empty where none does.
function unitAt(text, at, grammar) {
  const here = Object.keys(grammar.units)
    .filter((unit) => text.startsWith(unit, at) && !/[A-Za-z0-9_]/.test(text.charAt(at + unit.length)));
  return here.reduce((longest, unit) => (unit.length > longest.length ? unit : longest), '');
}
const unknownUnit = (grammar, found) =>
  queryRefusal(grammar, 'unknown_unit', {found, units: Object.keys(grammar.units).join(', ')});

/// The text as {kind, text} of its tokens, ending with the kind "end". After a number a unit may stand.
function queryTokens(text, grammar) {
  const patterns = Object.entries(grammar.tokens).map(([kind, pattern]) => [kind, new RegExp(pattern, 'y')]);
  const tokens = [];
  let at = 0;
  while (at < text.length) {
    let found = null;
    for (const [kind, pattern] of patterns) {
      pattern.lastIndex = at;
      found = pattern.exec(text) && {kind, text: text.slice(at, pattern.lastIndex)};
      if (found) break;
    }
    const unit = found?.kind !== 'space' && tokens.at(-1)?.kind === 'number' && unitAt(text, at, grammar);
    if (unit) found = {kind: 'unit', text: unit};
    if (!found) throw queryRefusal(grammar, 'unknown_sign', {rest: text.slice(at).split(/\s/)[0]});
    at += found.text.length;
    if (found.kind === 'sign') found.text = entryOf(grammar.synonyms, found.text) ?? found.text;
    if (found.kind !== 'space') tokens.push(found);
  }
  if (tokens.length > grammar.longest) throw queryRefusal(grammar, 'too_long', {longest: grammar.longest});
  return [...tokens, {kind: 'end', text: grammar.sentences.the_end}];
}

/// The tree of a condition; names and kinds are not looked at yet.
function queryTree(text, grammar) {
  const tokens = queryTokens(text, grammar);
  let at = 0;
  const take = () => tokens[at++].text;
  const rule = (table) => (tokens[at].kind === 'word' ? null : entryOf(grammar[table], tokens[at].text));
  const onOperator = () => Boolean(rule('between') || rule('before'));

  /// An operand, and what operators of this level and of higher ones join to it.
  function expression(level, depth) {
    if (depth > grammar.deepest) throw queryRefusal(grammar, 'too_deep');
    let tree = operand(depth + 1);
    for (let next = rule('between'); next && next.level >= level; next = rule('between')) {
      tree = ['between', tree];
      const least = next.level + (next.joins === 'right' ? 0 : 1);
      while (rule('between')?.level === next.level) tree.push([take(), expression(least, depth + 1)]);
    }
    return tree;
  }
  function operand(depth) {
    const {kind, text: found} = tokens[at];
    const before = rule('before'), bracket = rule('brackets');
    if (before) return ['before', take(), expression(before.level, depth)];
    if (bracket) {
      take();
      const inner = expression(0, depth);
      if (tokens[at].text !== bracket) throw queryRefusal(grammar, 'unclosed', {bracket, found: tokens[at].text});
      take();
      return inner;
    }
    if (kind === 'sign' || kind === 'end' || rule('between')) throw queryRefusal(grammar, 'missing', {found});
    return kind === 'number' ? number() : phrase(kind);
  }
  function number() {
    const made = ['number', Number(take())], next = tokens[at];
    if (next.kind === 'name' && !onOperator()) throw unknownUnit(grammar, next.text);
    return next.kind === 'unit' ? [...made, take()] : made;
  }
  /// A word in quotes; or a name, or a word, which may be several tokens, as in: period 2.
  function phrase(kind) {
    const found = [take()];
    while (kind === 'name' && ['name', 'number'].includes(tokens[at].kind) && !onOperator()) found.push(take());
    const text = kind === 'word' ? found[0].slice(1, -1) : found.join(' ');
    return [kind, entryOf(grammar.synonyms, text) ?? text];
  }

  if (tokens[0].kind === 'end') throw queryRefusal(grammar, 'empty');
  const tree = expression(0, 0);
  if (tokens[at].kind !== 'end') {
    throw queryRefusal(grammar, 'after_the_end', {found: tokens[at].text, before: tokens[at - 1].text});
  }
  return tree;
}

/// The unit of what a name stands for: that of the file, or "speed" for speed ratios, which have units of their own.
const queryUnits = (name, units, grammar) => (grammar.speeds.includes(name) ? 'speed' : units ?? null);
const codeOf = (flags, word) => Object.keys(flags ?? {}).find((code) => flags[code] === word);

/// A number with a unit as a function of the point, in the unit of the atlas.
function convertedQuery(number, unit, grammar, sizes) {
  const {over = 1, factor = 1, times} = grammar.units[unit];
  const plain = number * factor / over;  // divided, a decimal stays the nearest number to it
  if (!times) return () => plain;
  const size = entryOf(sizes, times);
  if (!size) throw unknownUnit(grammar, unit);
  return (point) => plain * size(point);
}

/// A condition as a function of a point's number. `names`: for each name a function of the point, its unit (any, if
/// none is said), and its flags where it has them. `sizes`: functions of the point, of units that depend on the rotor.
function parseQuery(text, names, grammar, sizes = {}) {
  const refuse = (sentence, facts) => { throw queryRefusal(grammar, sentence, facts); };

  /// The unit of two values that are compared or added.
  function commonUnits(sign, left, right) {
    if (left.units && right.units && left.units !== right.units) {
      const [before, after] = [left, right].map(({units}) => entryOf(grammar.measures, units) ?? units);
      refuse('other_units', {sign, before, after});
    }
    return left.units || right.units;
  }
  function named(phrase) {
    const name = phrase.replaceAll(' ', '_'), known = entryOf(names, name);
    if (known) {
      return known.flags ? {kind: 'flag', of: known.of, flags: known.flags, text: name}
        : {kind: 'number', of: known.of, units: queryUnits(name, known.units, grammar)};
    }
    const words = Object.values(names).flatMap(({flags}) => Object.values(flags ?? {}));
    if (words.includes(phrase)) return {kind: 'word', text: phrase};
    if (grammar.names_of_maps.includes(name)) refuse('without_maps', {name});
    if (grammar.names_of_rows.includes(name)) refuse('has_rows', {name});
    return refuse('unknown_name', {name: phrase, nearest: nearest(phrase, [...Object.keys(names), ...words])});
  }
  /// A word alone as the condition that its map has it.
  function holding(value) {
    const has = value.kind === 'word'
      && Object.values(names).find(({flags}) => codeOf(flags, value.text) !== undefined);
    if (!has) return value;
    const code = Number(codeOf(has.flags, value.text));
    return {kind: 'condition', of: (point) => has.of(point) === code};
  }
  /// The numbers or the condition that an operator takes; a map of flags is numbers, too, but for a word that says
  /// that there is none.
  function taken(rule, sign, place, given) {
    const value = rule.takes === 'condition' ? holding(given) : given;
    if (rule.takes !== (value.kind === 'flag' ? 'number' : value.kind)) {
      refuse(`operand_${place}`, {sign, kind: grammar.kinds[value.kind], wanted: grammar.kinds[rule.takes]});
    }
    const none = codeOf(value.flags, entryOf(grammar.no_number, value.text));
    return none === undefined ? value.of : (point) => (value.of(point) === Number(none) ? NaN : value.of(point));
  }
  function joined(rule, sign, left, right) {
    const does = QUERY_DOES[rule.does];
    if ('words' in rule && (left.kind === 'word' || right.kind === 'word')) {
      const [flag, {text: word}] = left.kind === 'word' ? [right, left] : [left, right];
      if (flag.kind !== 'flag' || !rule.words) refuse('words_are_compared', {word});
      const code = codeOf(flag.flags, word);
      if (code === undefined) {
        refuse('unknown_word', {word, name: flag.text, nearest: nearest(word, Object.values(flag.flags))});
      }
      return (point) => does(flag.of(point), Number(code));
    }
    const [a, b] = [taken(rule, sign, 'before', left), taken(rule, sign, 'after', right)];
    return (point) => does(a(point), b(point));
  }
  function valueOf([kind, first, ...rest]) {
    if (kind === 'number' && rest.length) {
      return {kind, of: convertedQuery(first, rest[0], grammar, sizes), units: grammar.units[rest[0]].of};
    }
    if (kind === 'number') return {kind, of: () => first};
    if (kind === 'word') return {kind, text: first};
    if (kind === 'name') return named(first);
    if (kind === 'before') {
      const rule = grammar.before[first], inner = valueOf(rest[0]);
      const of = taken(rule, first, 'after', inner);
      return {kind: rule.gives, of: (point) => QUERY_DOES[rule.does](of(point)), units: inner.units};
    }
    let left = valueOf(first);
    const compared = [];
    for (const [sign, operand] of rest) {
      const rule = grammar.between[sign], right = valueOf(operand);
      const units = rule.mixes_units ? null : commonUnits(sign, left, right);
      const result = {kind: rule.gives, of: joined(rule, sign, left, right), units};
      if (rule.joins === 'chain') compared.push(result.of);
      left = rule.joins === 'chain' ? right : result;
    }
    return compared.length ? {kind: 'condition', of: (point) => compared.every((one) => one(point))} : left;
  }

  const whole = holding(valueOf(queryTree(text, grammar)));
  if (whole.kind !== 'condition') refuse('no_condition', {kind: grammar.kinds[whole.kind]});
  return whole.of;
}

/// The names that a query may use in this atlas.
function queryNames() {
  const names = {};
  for (const [place, axis] of axes.entries()) {
    const flags = axis.name === 'direction' ? {0: 'up', 1: 'down'} : null;
    names[axis.name] = {of: (point) => axis.values[placeOf(point)[place]], units: axis.units, flags};
  }
  for (const {name, units, flags} of atlas.maps) names[name] = {of: (point) => values[name][point], units, flags};
  return names;
}
/// A number of the scene at a point: that of its axis where it has one.
function numberAt(point, section, key) {
  const place = axes.findIndex(({pointer}) => pointer?.[0] === section && pointer[1] === key);
  return place < 0 ? atlas.scene[section][key] : axes[place].values[placeOf(point)[place]];
}
/// Of the units that depend on the rotor.
const querySizes = {
  clearance: (point) => numberAt(point, 'ring', 'radius') - numberAt(point, 'blades', 'hub_radius')
    - numberAt(point, 'blades', 'length'),
  radian_per_second: (point) => 1 / numberAt(point, 'rotor', 'natural_frequency'),
};
/// The comparisons of a condition with the number in the units in which a reader has it, so that a wrong unit shows.
function queryEcho(text) {
  const names = queryNames(), said = [], {between, units} = queryGrammar;
  const sizeOf = (times) => {
    const found = new Set();
    for (let point = 0; point < pointCount; point += sizes[SPEED]) found.add(querySizes[times](point));
    return found.size === 1 ? [...found][0] : NaN;  // not one number: this unit is left out
  };
  function add(name, sign, [, number, unit]) {
    if (!names[name] || names[name].flags) return;
    const value = unit ? convertedQuery(number, unit, queryGrammar, querySizes)(0) : number;
    const own = queryUnits(name, names[name].units, queryGrammar);
    const each = (queryGrammar.shown[own] ?? [own]).map((one) => {
      const {over = 1, factor = 1, times} = units[one] ?? {}, size = times ? sizeOf(times) : 1;
      return size > 0 ? `${shown(value * over / factor / size, 6)} ${one}`.trim() : '';
    });
    said.push(`${name} ${sign} ${each.filter(Boolean).join(', ')}`);
  }
  function walk([kind, first, ...rest]) {
    if (kind === 'before') walk(rest[0]);
    if (kind !== 'between') return;
    walk(first);
    let left = first;
    for (const [sign, right] of rest) {
      const [name, number, side] = left[0] === 'name' ? [left, right, sign]
        : [right, left, sign.replace(/[<>]/, (one) => (one === '<' ? '>' : '<'))];
      if (between[sign].joins === 'chain' && name[0] === 'name' && number[0] === 'number') {
        add(name[1].replaceAll(' ', '_'), side, number);
      }
      walk(right);
      left = right;
    }
  }
  walk(queryTree(text, queryGrammar));
  return said.join('; ');
}
/// What a query may say here: names with their underscores, words of maps, units.
function queryHelp() {
  const names = queryNames();
  const words = [...new Set(Object.values(names).flatMap(({flags}) => Object.values(flags ?? {})))];
  return [`Names: ${Object.keys(names).join(', ')}.`, `Words: ${words.join(', ')}.`,
    `Units: ${Object.keys(queryGrammar.units).join(', ')}; a number without one is in the atlas' own, which is SI.`];
}
/// Whether each point that is done fulfils a condition.
function marked(text) {
  const holds = parseQuery(text, queryNames(), queryGrammar, querySizes);
  const result = new Uint8Array(pointCount);
  for (let point = 0; point < pointCount; ++point) result[point] = values.status[point] === 1 && holds(point) ? 1 : 0;
  return result;
}
