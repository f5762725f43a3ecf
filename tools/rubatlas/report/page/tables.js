// --- Table 1, what grows with what, provenance and accuracy. ---

function table(heading, rows, kind = '') {
  return element('div', {class: 'scroll', tabindex: 0, role: 'region', 'aria-label': heading.join(', ')},
    element('table', {class: kind},
    element('thead', {}, element('tr', {}, ...heading.map((word) => element('th', {scope: 'col', text: word})))),
    element('tbody', {}, ...rows.map((row) => element('tr', {}, ...row.map(
      (cell) => (cell instanceof Node ? element('td', {}, cell) : element('td', {text: cell}))))))));
}
function part(title, open, ...children) {
  return element('details', open ? {open: true} : {}, element('summary', {}, element('h2', {text: title})),
    ...children);
}

function regionCell(row, name, line) {
  const presence = row[`${name}_presence`][line];
  if (presence !== 'present') return presence;
  const open = row[`${name}_open`][line];
  const edge = (value, isOpen) => (isOpen ? `(${shown(value, 4)})` : shown(value, 4));
  const of = (column) => row[`${name}_${column}`][line];
  const from = edge(of('from'), /begins|both/.test(open));
  const to = edge(of('to'), /ends|both/.test(open));
  const aperiodic = shown(100 * of('aperiodic_share'), 3);
  return `${from} – ${to}\n${aperiodic} % aperiodic, ${withUnits(of('peak_displacement'), 'm', 3)}`;
}
function triggerCell(row, name, line) {
  const presence = row[`${name}_presence`][line];
  if (presence !== 'present') return presence;
  const [speed, rise, ratio] = ['speed_ratio', 'rise', 'ratio'].map((column) => row[`${name}_${column}`][line]);
  return `${shown(speed, 4)}\n+${withUnits(rise, 'm', 3)}, ×${shown(ratio, 3)}`;
}
function table1() {
  const row = atlas.table1;
  if (!row) return [element('p', {class: 'quiet', text: 'The report was made without maps (rubatlas analyse).'})];
  const parts = ['region_1', 'trigger_1', 'region_2', 'region_3', 'trigger_2', 'region_4']
    .filter((name) => row[`${name}_presence`]);
  if (parts.every((name) => row[`${name}_presence`].every((presence) => presence === 'not covered'))) {
    return [element('p', {class: 'quiet', text: 'No line of this atlas covers a region or a trigger.'}),
      ...[...new Set(row.contact)].slice(0, 20).map((text) => element('p', {text: capital(text)}))];
  }
  const swept = axes.slice(0, SPEED).filter((axis) => axis.values.length > 1 && row[`at_${axis.name}`]);
  const cell = (axis, value) => (axis.name === 'direction' ? DIRECTIONS[value] : withUnits(value, axis.units, 4));
  const rows = row.line.map((_, line) => [
    ...swept.map((axis) => cell(axis, row[`at_${axis.name}`][line])),
    capital(row.contact[line]).replace(/[;,] /g, '\n'),
    ...parts.map((name) => (name.startsWith('region') ? regionCell(row, name, line) : triggerCell(row, name, line)))]);
  return [table([...swept.map(labelOf), 'Contact', ...parts.map((name) => capital(words(name)))], rows, 'dense'),
    element('p', {class: 'quiet small', text: 'Regions: first and last speed ratio, share of aperiodic points, ' +
      'largest displacement; beyond a speed in parentheses a region may go on, since points are not done there or ' +
      'the grid ends. Triggers: speed ratio, rise of the displacement.'})];
}
function facts(pairs) {
  return element('dl', {class: 'pairs'},
    ...pairs.filter(([, value]) => value !== '' && value !== undefined && value !== null)
    .flatMap(([name, value]) => [element('dt', {text: name}), element('dd', {text: value})]));
}
function provenance() {
  const {software, software_version: version, git_commit: commit, compiler} = atlas.provenance;
  const run = atlas.runs[atlas.runs.length - 1];
  const computed = run && [run.finished ?? run.started, `${run.ranks} rank${run.ranks === 1 ? '' : 's'}`,
    run.processor ?? '', `${shown(run.wall_seconds, 4)} s`].join(', ');
  return [facts([['Atlas', atlas.file], ['Maps', atlas.maps_file ?? 'none'], ['Program', `${software} ${version}`],
    ['Commit', commit], ['Compiler', compiler], ['Computed', computed],
    ['Reference', atlas.reference]]),
  part('The scene', false, element('pre', {text: JSON.stringify(atlas.scene, null, 1)}))];
}
function accuracy() {
  const {accuracy: how, protocol} = atlas.scene;
  const kept = atlas.lines.poincare;
  const points = Object.entries(atlas.points).filter(([, count]) => count)
    .map(([word, count]) => `${shown(count, 7)} ${word === 'left validity' ? 'left the model’s validity' : word}`);
  const which = kept && (kept.sections === kept.of ? 'all' : `the last ${kept.sections} of`);
  const sections = kept ? `${which} ${kept.of} of each point, in single precision`
    : 'none: the atlas has none, or they do not fit into this file';
  return [facts([
    ['Method', `${how?.method}, local error per step ${shown(how?.tolerance, 3)} of the clearance`],
    ['Protocol', `${counted(protocol.transient_revolutions, 'revolutions')} of transient, ` +
      `${protocol.sampled_revolutions} sampled`],
    ['Points', points.join(', ')], ['Sections here', sections],
    ['Computed here', atlas.not_computed || 'by the program’s own solver, compiled to WebAssembly: method ' +
      'collocation, local error per step 1e-11 of the clearance']])];
}
function showTables() {
  byId('tables').append(part('Table 1', true, ...table1()),
    ...(atlas.effects?.text?.length
      ? [part('What grows with what', false, table(['Parameter', 'At', 'Part', 'What happens'],
      atlas.effects.text.map((text, i) =>
        [words(atlas.effects.parameter[i]), atlas.effects.held[i], atlas.effects.subject[i], text])))] : []),
    part('Accuracy', false, ...accuracy()), part('Provenance', false, ...provenance()));
}
