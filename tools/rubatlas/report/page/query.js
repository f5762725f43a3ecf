// --- Conditions on points, in the grammar of the package's `where`. ---
//
//   condition   comparison | condition and condition | condition or condition | not condition | ( condition )
//   comparison  value < value (also <= > >= == !=), chained as in 0.3 < speed_ratio < 0.5
//   value       number | name of a map or an axis | 'word of a flag' | value + value (also - * / ** and a leading -)
//
// Numbers are in SI units. A word in quotes is compared by == and != with a map of flags: class == 'aperiodic'. A comparison with what is
// not there (NaN) is false, != true.

class QueryError extends Error {}

function distance(one, other) {
  let row = Array.from({length: other.length + 1}, (_, i) => i);
  for (let i = 1; i <= one.length; ++i) {
    const next = [i];
    for (let j = 1; j <= other.length; ++j) next[j] = Math.min(row[j] + 1, next[j - 1] + 1, row[j - 1] + (one[i - 1] === other[j - 1] ? 0 : 1));
    row = next;
  }
  return row[other.length];
}
const nearest = (word, known) => known.reduce((best, one) => (distance(word, one) < distance(word, best) ? one : best), known[0]);

function tokensOf(text) {
  const pattern = /\s*(?:((?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)|([A-Za-z_]\w*)|'([^']*)'|"([^"]*)"|(\*\*|<=|>=|==|!=|[-+*/()<>]))/y;
  const tokens = [];
  let at = 0;
  while (at < text.length) {
    if (/^\s*$/.test(text.slice(at))) break;
    pattern.lastIndex = at;
    const found = pattern.exec(text);
    if (!found) throw new QueryError(`${text.slice(at).trim()}: not a number, a name, a word in quotes or an operator`);
    at = pattern.lastIndex;
    if (found[1] !== undefined) tokens.push({kind: 'number', value: Number(found[1])});
    else if (found[2] !== undefined) tokens.push(['and', 'or', 'not'].includes(found[2]) ? {kind: found[2], text: found[2]} : {kind: 'name', text: found[2]});
    else if (found[3] !== undefined || found[4] !== undefined) tokens.push({kind: 'word', text: found[3] ?? found[4]});
    else tokens.push({kind: found[5], text: found[5]});
  }
  return tokens;
}

const COMPARE = {'<': (a, b) => a < b, '<=': (a, b) => a <= b, '>': (a, b) => a > b, '>=': (a, b) => a >= b, '==': (a, b) => a === b, '!=': (a, b) => a !== b};
const ARITHMETIC = {'+': (a, b) => a + b, '-': (a, b) => a - b, '*': (a, b) => a * b, '/': (a, b) => a / b, '**': (a, b) => a ** b};

// What `rubatlas analyse` adds to an atlas.
const OF_MAPS = ['class', 'class_blade_passing', 'attractor', 'margin'];
function unknownName(name, names) {
  const flag = Object.keys(names).find((one) => Object.values(names[one].flags ?? {}).includes(name));
  if (flag) return `${name} is a word of ${flag}; words stand in quotes, as in ${flag} == '${name}'`;
  if (OF_MAPS.includes(name)) return `${name} is in the maps of an atlas (rubatlas analyse), which are not here`;
  return `${name} is not in this atlas; the nearest name is ${nearest(name, Object.keys(names))}`;
}

/// A condition as a function of a point's number. `names`: for each name a function of the point, and its flags where it has them.
function parseQuery(text, names) {
  const tokens = tokensOf(text);
  let at = 0;
  const next = () => tokens[at];
  const take = (...kinds) => (at < tokens.length && kinds.includes(tokens[at].kind) ? tokens[at++] : null);
  const said = (token) => (token === undefined ? 'the end' : token.text ?? token.value);
  const expect = (type, node, what) => {
    if (node.type !== type) throw new QueryError(`${what} is ${{number: 'a number', condition: 'a condition', word: 'a word', flag: 'a class'}[node.type]}, not ${{number: 'a number', condition: 'a condition'}[type]}`);
    return node;
  };
  const asNumber = (node) => (node.type === 'flag' ? {type: 'number', of: node.of} : node);

  function atom() {
    const token = take('number', 'name', 'word', '(');
    if (!token) throw new QueryError(`a value or a condition is missing before ${said(next())}`);
    if (token.kind === 'number') return {type: 'number', of: () => token.value};
    if (token.kind === 'word') return {type: 'word', word: token.text};
    if (token.kind === 'name') {
      if (!Object.hasOwn(names, token.text)) throw new QueryError(unknownName(token.text, names));
      const known = names[token.text];
      return {type: known.flags ? 'flag' : 'number', of: known.of, flags: known.flags, name: token.text};
    }
    const inner = disjunction();
    if (!take(')')) throw new QueryError('a ) is missing');
    return inner;
  }
  function power() {
    const base = atom();
    if (!take('**')) return base;
    const exponent = unary();
    return arithmetic('**', base, exponent);
  }
  function arithmetic(sign, left, right) {
    const [a, b] = [asNumber(left), asNumber(right)];
    expect('number', a, `what stands before ${sign}`);
    expect('number', b, `what stands after ${sign}`);
    return {type: 'number', of: (point) => ARITHMETIC[sign](a.of(point), b.of(point))};
  }
  function unary() {
    const sign = take('-', '+');
    if (!sign) return power();
    const inner = expect('number', asNumber(unary()), `what stands after ${sign.kind}`);
    return sign.kind === '-' ? {type: 'number', of: (point) => -inner.of(point)} : inner;
  }
  function chain(lower, signs) {
    let left = lower();
    for (let sign = take(...signs); sign; sign = take(...signs)) left = arithmetic(sign.kind, left, lower());
    return left;
  }
  const product = () => chain(unary, ['*', '/']);
  const sum = () => chain(product, ['+', '-']);
  function compared(sign, left, right) {
    const [flag, word] = left.type === 'word' ? [right, left] : [left, right];
    if (word.type === 'word') {
      if (flag.type !== 'flag' || !['==', '!='].includes(sign)) throw new QueryError(`'${word.word}' is compared by == or != with a map of classes`);
      const code = Object.entries(flag.flags).find(([, name]) => name === word.word);
      if (!code) throw new QueryError(`'${word.word}' is no value of ${flag.name}; the nearest is '${nearest(word.word, Object.values(flag.flags))}'`);
      const value = Number(code[0]);
      return (point) => COMPARE[sign](flag.of(point), value);
    }
    const [a, b] = [asNumber(left), asNumber(right)];
    expect('number', a, `what stands before ${sign}`);
    expect('number', b, `what stands after ${sign}`);
    return (point) => COMPARE[sign](a.of(point), b.of(point));
  }
  function comparison() {
    let left = sum();
    const parts = [];
    for (let sign = take(...Object.keys(COMPARE)); sign; sign = take(...Object.keys(COMPARE))) {
      const right = sum();
      parts.push(compared(sign.kind, left, right));
      left = right;
    }
    return parts.length ? {type: 'condition', of: (point) => parts.every((part) => part(point))} : left;
  }
  function negation() {
    if (!take('not')) return comparison();
    const inner = expect('condition', negation(), 'what stands after not');
    return {type: 'condition', of: (point) => !inner.of(point)};
  }
  function joined(lower, word, join) {
    let left = lower();
    while (take(word)) {
      const [a, b] = [expect('condition', left, `what stands before ${word}`), expect('condition', lower(), `what stands after ${word}`)];
      left = {type: 'condition', of: join(a.of, b.of)};
    }
    return left;
  }
  const conjunction = () => joined(negation, 'and', (a, b) => (point) => a(point) && b(point));
  const disjunction = () => joined(conjunction, 'or', (a, b) => (point) => a(point) || b(point));

  if (!tokens.length) throw new QueryError('the condition is empty');
  const result = disjunction();
  if (at < tokens.length) throw new QueryError(`${said(next())} stands where the condition should end`);
  return expect('condition', result, 'the whole').of;
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
  const holds = parseQuery(text, queryNames());
  const result = new Uint8Array(pointCount);
  for (let point = 0; point < pointCount; ++point) result[point] = values.status[point] === 1 && holds(point) ? 1 : 0;
  return result;
}
