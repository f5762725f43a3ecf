// --- PNG, SVG and CSV of what is shown. ---

/// One line under every exported picture: what it was made from.
function credit() {
  const {software, software_version: version, git_commit: commit} = atlas.provenance;
  return [atlas.title, atlas.file, `${software} ${version} (${(commit || '').slice(0, 10)})`].filter(Boolean)
    .join(' · ');
}
function save(name, url) {
  const link = element('a', {href: url, download: name});
  document.body.append(link);
  link.click();
  link.remove();
}
function saveText(name, text, type) {
  const url = URL.createObjectURL(new Blob([text], {type}));
  save(name, url);
  setTimeout(() => URL.revokeObjectURL(url), 60000);
}
/// Columns as text, with a decimal point and all digits whatever the locale; before them, in lines that begin with #,
/// what they are of.
function csvText(columns, title, {values}) {
  const names = Object.keys(columns);
  const quoted = (value) => {
    if (typeof value === 'number') return Number.isNaN(value) ? '' : String(value);
    return /[",\n]/.test(value) ? `"${String(value).replace(/"/g, '""')}"` : String(value);
  };
  const said = [title, credit(), ...values.map(([name, value]) => `${name} = ${value}`)];
  const rows = [...said.map((line) => `# ${line.replace(/\s+/g, ' ')}`), names.map(quoted).join(',')];
  const count = Math.max(0, ...names.map((name) => columns[name].length));
  for (let i = 0; i < count; ++i) {
    rows.push(names.map((name) => (i < columns[name].length ? quoted(columns[name][i]) : '')).join(','));
  }
  return `${rows.join('\n')}\n`;
}
/// Buttons for what `subject` shows: an object with `name`, `title`, `about`, `picture(kind)` and `csv()`. Pictures and
/// numbers are of what it shows, whatever has been chosen since.
function exportButtons(holder, subject) {
  const stem = () => `${atlas.file.replace(/\.h5$/, '')}_${subject.name}`;
  const kinds = {
    // At once: a browser may leave toBlob until the page is idle, for seconds.
    PNG: () => save(`${stem()}.png`, subject.picture('PNG').toDataURL()),
    SVG: () => saveText(`${stem()}.svg`, subject.picture('SVG'), 'image/svg+xml'),
    CSV: () => saveText(`${stem()}.csv`, csvText(subject.csv(), subject.title, subject.about), 'text/csv'),
  };
  for (const [kind, act] of Object.entries(kinds)) {
    holder.append(element('button',
      {type: 'button', class: 'small', 'aria-label': `${kind} of ${subject.name}`, text: kind, onclick: act}));
  }
}
