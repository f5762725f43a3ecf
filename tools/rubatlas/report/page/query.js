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

/// The text as {kind, text} of its tokens, ending with the kind "end".
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
    if (!found) throw queryRefusal(grammar, 'unknown_sign', {rest: text.slice(at).split(/\s/)[0]});
    at += found.text.length;
    if (found.kind !== 'word') found.text = entryOf(grammar.synonyms, found.text) ?? found.text;
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
    take();
    if (kind !== 'number') return [kind, kind === 'word' ? found.slice(1, -1) : found];
    const factor = rule('units');
    if (factor) take();
    return [kind, Number(found) * (factor ?? 1)];
  }

  if (tokens[0].kind === 'end') throw queryRefusal(grammar, 'empty');
  const tree = expression(0, 0);
  if (tokens[at].kind !== 'end') {
    throw queryRefusal(grammar, 'after_the_end', {found: tokens[at].text, before: tokens[at - 1].text});
  }
  return tree;
}

/// A condition as a function of a point's number. `names`: for each name a function of the point, and its flags where
/// it has them.
function parseQuery(text, names, grammar) {
  const refuse = (sentence, facts) => { throw queryRefusal(grammar, sentence, facts); };

  function named(name) {
    const known = entryOf(names, name);
    if (known) return {kind: known.flags ? 'flag' : 'number', of: known.of, flags: known.flags, text: name};
    const flag = Object.keys(names).find((one) => Object.values(names[one].flags ?? {}).includes(name));
    if (flag) refuse('without_quotes', {name, flag});
    if (grammar.names_of_maps.includes(name)) refuse('without_maps', {name});
    return refuse('unknown_name', {name, nearest: nearest(name, Object.keys(names))});
  }
  /// The numbers or the condition that an operator takes; a map of flags is numbers, too.
  function taken(rule, sign, place, value) {
    if (rule.takes !== (value.kind === 'flag' ? 'number' : value.kind)) {
      refuse(`operand_${place}`, {sign, kind: grammar.kinds[value.kind], wanted: grammar.kinds[rule.takes]});
    }
    return value.of;
  }
  function joined(rule, sign, left, right) {
    const does = QUERY_DOES[rule.does];
    if ('words' in rule && (left.kind === 'word' || right.kind === 'word')) {
      const [flag, {text: word}] = left.kind === 'word' ? [right, left] : [left, right];
      if (flag.kind !== 'flag' || !rule.words) refuse('words_are_compared', {word});
      const code = Object.keys(flag.flags).find((one) => flag.flags[one] === word);
      if (code === undefined) {
        refuse('unknown_word', {word, name: flag.text, nearest: nearest(word, Object.values(flag.flags))});
      }
      return (point) => does(flag.of(point), Number(code));
    }
    const [a, b] = [taken(rule, sign, 'before', left), taken(rule, sign, 'after', right)];
    return (point) => does(a(point), b(point));
  }
  function valueOf([kind, first, ...rest]) {
    if (kind === 'number') return {kind, of: () => first};
    if (kind === 'word') return {kind, text: first};
    if (kind === 'name') return named(first);
    if (kind === 'before') {
      const rule = grammar.before[first];
      const of = taken(rule, first, 'after', valueOf(rest[0]));
      return {kind: rule.gives, of: (point) => QUERY_DOES[rule.does](of(point))};
    }
    let left = valueOf(first);
    const compared = [];
    for (const [sign, operand] of rest) {
      const rule = grammar.between[sign], right = valueOf(operand);
      const result = {kind: rule.gives, of: joined(rule, sign, left, right)};
      if (rule.joins === 'chain') compared.push(result.of);
      left = rule.joins === 'chain' ? right : result;
    }
    return compared.length ? {kind: 'condition', of: (point) => compared.every((one) => one(point))} : left;
  }

  const whole = valueOf(queryTree(text, grammar));
  if (whole.kind !== 'condition') refuse('no_condition', {kind: grammar.kinds[whole.kind]});
  return whole.of;
}

/// The names that a query may use in this atlas.
function queryNames() {
  const names = {};
  for (const [place, axis] of axes.entries()) {
    const flags = axis.name === 'direction' ? {0: 'up', 1: 'down'} : null;
    names[axis.name] = {of: (point) => axis.values[placeOf(point)[place]], flags};
  }
  for (const map of atlas.maps) names[map.name] = {of: (point) => values[map.name][point], flags: map.flags};
  return names;
}
/// Whether each point that is done fulfils a condition.
function marked(text) {
  const holds = parseQuery(text, queryNames(), queryGrammar);
  const result = new Uint8Array(pointCount);
  for (let point = 0; point < pointCount; ++point) result[point] = values.status[point] === 1 && holds(point) ? 1 : 0;
  return result;
}
