// --- Charts: axes, scales and zoom by uPlot; layers of lines, dots and images drawn by a pen, on canvas or as SVG. ---

const fontOf = (size) => `${size}px system-ui, sans-serif`;

// A browser clips to more boxes slowly: what is drawn is masked then.
const MOST_CLIPPED = 200;

class CanvasPen {
  constructor(context, scale = 1) { this.context = context; this.scale = scale; }
  begin({colour, width = 1, dash = []}) {
    const {context, scale} = this;
    context.strokeStyle = colour;
    context.lineWidth = width * scale;
    context.setLineDash(dash.map((length) => length * scale));
    context.lineJoin = 'round';
    context.beginPath();
  }
  line(points, style) {
    this.begin(style);
    let open = false;
    for (const [x, y] of points) {
      if (!Number.isFinite(x + y)) { open = false; continue; }
      if (open) this.context.lineTo(x, y); else this.context.moveTo(x, y);
      open = true;
    }
    if (style.fill) { this.context.fillStyle = style.fill; this.context.fill(); }
    this.context.stroke();
  }
  dots(points, {colour, size = 2}) {
    this.context.fillStyle = colour;
    const side = size * this.scale;
    if (size < 3) {
      for (const [x, y] of points) this.context.fillRect(x - side / 2, y - side / 2, side, side);
      return;
    }
    for (const [x, y] of points) {
      this.context.beginPath();
      this.context.arc(x, y, side / 2, 0, 2 * Math.PI);
      this.context.fill();
    }
  }
  circle(x, y, radius, style) {
    this.begin(style);
    this.context.arc(x, y, radius, 0, 2 * Math.PI);
    if (style.fill) { this.context.fillStyle = style.fill; this.context.fill(); }
    this.context.stroke();
  }
  image(source, x, y, width, height) {
    this.context.imageSmoothingEnabled = false;
    this.context.drawImage(source, x, y, width, height);
  }
  text(words, x, y, {colour, size = 11, align = 'left', turned = false}) {
    const {context} = this;
    context.save();
    context.translate(x, y);
    if (turned) context.rotate(-Math.PI / 2);
    context.fillStyle = colour;
    context.textAlign = align;
    context.textBaseline = 'middle';
    context.font = fontOf(size * this.scale);
    context.fillText(words, 0, 0);
    context.restore();
  }
  /// Draws within boxes [left, top, right, bottom] alone.
  clipped(boxes, draw) {
    if (boxes.length > MOST_CLIPPED) { this.masked(boxes, draw); return; }
    this.context.save();
    this.context.beginPath();
    for (const [left, top, right, bottom] of boxes) this.context.rect(left, top, right - left, bottom - top);
    this.context.clip();
    draw();
    this.context.restore();
  }
  masked(boxes, draw) {
    const {context} = this;
    const [mask, drawing] = [0, 1].map(() => {
      const canvas = element('canvas');
      [canvas.width, canvas.height] = [context.canvas.width, context.canvas.height];
      const made = canvas.getContext('2d');
      made.setTransform(context.getTransform());
      return made;
    });
    for (const [left, top, right, bottom] of boxes) mask.fillRect(left, top, right - left, bottom - top);
    this.context = drawing;
    draw();
    this.context = context;
    drawing.resetTransform();
    drawing.globalCompositeOperation = 'destination-in';
    drawing.drawImage(mask.canvas, 0, 0);
    context.save();
    context.resetTransform();
    context.drawImage(drawing.canvas, 0, 0);
    context.restore();
  }
  moved(right, down, draw) {
    this.context.save();
    this.context.translate(right, down);
    draw();
    this.context.restore();
  }
}

class SvgPen {
  constructor() {
    this.parts = [];
    this.scale = 1;
    this.clips = 0;
  }
  static number(value) { return value.toFixed(2).replace(/\.?0+$/, ''); }
  static escaped(text) {
    return String(text)
      .replace(/[&<>"]/g, (letter) => ({'&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;'})[letter]);
  }
  stroke({colour, width = 1, dash = [], fill = 'none'}) {
    const dashes = dash.length ? ` stroke-dasharray="${dash.join(' ')}"` : '';
    return `fill="${fill}" stroke="${colour}" stroke-width="${width}"${dashes} stroke-linejoin="round"`;
  }
  line(points, style) {
    let path = '', open = false;
    for (const [x, y] of points) {
      if (!Number.isFinite(x + y)) { open = false; continue; }
      path += `${open ? 'L' : 'M'}${SvgPen.number(x)} ${SvgPen.number(y)}`;
      open = true;
    }
    this.parts.push(`<path d="${path}" ${this.stroke(style)}/>`);
  }
  dots(points, {colour, size = 2}) {
    let path = '';
    for (const [x, y] of points) path += `M${SvgPen.number(x)} ${SvgPen.number(y)}h0`;
    this.parts.push(`<path d="${path}" stroke="${colour}" stroke-width="${size}" stroke-linecap="round" fill="none"/>`);
  }
  circle(x, y, radius, style) {
    const [cx, cy, r] = [x, y, radius].map(SvgPen.number);
    this.parts.push(`<circle cx="${cx}" cy="${cy}" r="${r}" ${this.stroke(style)}/>`);
  }
  image(source, x, y, width, height) {
    const place = `x="${x}" y="${y}" width="${width}" height="${height}" preserveAspectRatio="none"`;
    this.parts.push(`<image href="${source.toDataURL('image/png')}" ${place} style="image-rendering:pixelated"/>`);
  }
  text(words, x, y, {colour, size = 11, align = 'left', turned = false}) {
    const anchor = {left: 'start', center: 'middle', right: 'end'}[align];
    const place = turned ? `transform="translate(${SvgPen.number(x)} ${SvgPen.number(y)}) rotate(-90)"`
      : `x="${SvgPen.number(x)}" y="${SvgPen.number(y)}"`;
    const look = `fill="${colour}" font-size="${size}" text-anchor="${anchor}" dominant-baseline="middle"`;
    this.parts.push(`<text ${place} ${look}>${SvgPen.escaped(words)}</text>`);
  }
  clipped(boxes, draw) {
    const name = `clip${++this.clips}`;
    const [left, top, right, bottom] = [0, 1, 2, 3].map((side) => (box) => SvgPen.number(box[side]));
    const path = boxes.map((box) => `M${left(box)} ${top(box)}H${right(box)}V${bottom(box)}H${left(box)}z`).join('');
    this.parts.push(`<clipPath id="${name}"><path d="${path}"/></clipPath><g clip-path="url(#${name})">`);
    draw();
    this.parts.push('</g>');
  }
  moved(right, down, draw) {
    this.parts.push(`<g transform="translate(${SvgPen.number(right)} ${SvgPen.number(down)})">`);
    draw();
    this.parts.push('</g>');
  }
  finish(width, height, background) {
    return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" ` +
      `viewBox="0 0 ${width} ${height}" font-family="system-ui, sans-serif">` +
      `<rect width="100%" height="100%" fill="${background}"/>${this.parts.join('')}</svg>`;
  }
}

/// Hatches boxes with the signs of matplotlib: lines for / \ x -, dots for a full stop.
const HATCH_SPACING = 6;
function drawHatch(pen, boxes, sign, colour) {
  if (!boxes.length) return;
  const step = HATCH_SPACING * pen.scale;
  const [left, top] = [0, 1].map((side) => boxes.reduce((least, box) => Math.min(least, box[side]), Infinity));
  const [right, bottom] = [2, 3].map((side) => boxes.reduce((most, box) => Math.max(most, box[side]), -Infinity));
  /// Multiples of the step, so that all boxes of a picture have one pattern.
  const from = (low, high) => {
    const first = Math.ceil(low / step);
    return Array.from({length: Math.max(0, Math.ceil(high / step) - first)}, (_, i) => (first + i) * step);
  };
  const rising = () => from(left + top, right + bottom)
    .flatMap((at) => [[at - top, top], [at - bottom, bottom], [NaN, NaN]]);
  const falling = () => from(left - bottom, right - top)
    .flatMap((at) => [[at + top, top], [at + bottom, bottom], [NaN, NaN]]);
  const level = () => from(top, bottom).flatMap((at) => [[left, at], [right, at], [NaN, NaN]]);
  const lines = {'/': rising, '\\': falling, x: () => [...rising(), ...falling()], '-': level}[sign];
  pen.clipped(boxes, () => {
    if (lines) pen.line(lines(), {colour, width: 0.9});
    else pen.dots(from(top, bottom).flatMap((y) => from(left, right).map((x) => [x, y])), {colour, size: 1.5});
  });
}
/// Hatches are seen on every colour of the palette.
const hatchInk = (colour) => (rgb(colour).reduce((sum, part) => sum + part, 0) > 300 ? '#1a1a2e' : '#ffffff');

/// Draws a layer with a pen. `to` places values of both axes.
function drawLayer(pen, layer, to, box) {
  const points = function* () { for (let i = 0; i < layer.x.length; ++i) yield [to.x(layer.x[i]), to.y(layer.y[i])]; };
  if (layer.kind === 'line') pen.line(points(), layer);
  else if (layer.kind === 'dots') pen.dots(points(), layer);
  else if (layer.kind === 'bars') {
    const bars = function* () { for (const [x, y] of points()) yield* [[x, box.bottom], [x, y], [NaN, NaN]]; };
    pen.line(bars(), layer);
  } else if (layer.kind === 'vertical') pen.line([[to.x(layer.x), box.top], [to.x(layer.x), box.bottom]], layer);
  else if (layer.kind === 'circle') {
    pen.circle(to.x(layer.x), to.y(layer.y), Math.abs(to.x(layer.x + layer.radius) - to.x(layer.x)), layer);
  }
  else if (layer.kind === 'box') {
    const [left, right] = layer.x.map(to.x), [bottom, top] = layer.y.map(to.y);
    pen.line([[left, top], [right, top], [right, bottom], [left, bottom], [left, top]], layer);
  } else if (layer.kind === 'image') {
    const [left, right] = layer.x.map(to.x), [bottom, top] = layer.y.map(to.y);
    pen.image(layer.source, left, top, right - left, bottom - top);
  } else if (layer.kind === 'hatch') {
    const within = (side, least, most) => Math.min(Math.max(side, least), most);
    const boxes = layer.boxes.map(([left, right, bottom, top]) =>
      [within(to.x(left), box.left, box.right), within(to.y(top), box.top, box.bottom),
        within(to.x(right), box.left, box.right), within(to.y(bottom), box.top, box.bottom)])
      .filter(([left, top, right, bottom]) => right > left && bottom > top);
    drawHatch(pen, boxes, layer.sign, layer.colour);
  }
}

// --- Legends: marks with words, on the page and in exported pictures. ---

// An entry has a `word` and one of these marks; their widths in pixels.
const MARKS = {patch: 13, line: 18, dots: 8, strip: 80};
function drawMark(pen, {mark, colour, hatch, dash}) {
  if (mark === 'line') pen.line([[0, 6.5], [MARKS.line, 6.5]], {colour, width: 2, dash});
  else if (mark === 'dots') pen.dots([[4, 6.5]], {colour, size: 6});
  else if (mark === 'strip') pen.image(viridisStrip(), 0, 1, MARKS.strip, 11);
  else {
    const border = [[0.5, 0.5], [12.5, 0.5], [12.5, 12.5], [0.5, 12.5], [0.5, 0.5]];
    pen.line(border, {colour: '#88888866', fill: colour});
    if (hatch) drawHatch(pen, [[0, 0, 13, 13]], hatch, hatchInk(colour));
  }
}
function viridisStrip() {
  const canvas = element('canvas');
  canvas.width = MARKS.strip;
  canvas.height = 1;
  const context = canvas.getContext('2d');
  for (let i = 0; i < MARKS.strip; ++i) {
    context.fillStyle = `rgb(${viridis(i / (MARKS.strip - 1))})`;
    context.fillRect(i, 0, 1, 1);
  }
  return canvas;
}
/// A legend as elements of the page.
function legendChips(entries) {
  return entries.map((entry) => {
    const canvas = element('canvas', {'aria-hidden': 'true'});
    const width = MARKS[entry.mark];
    [canvas.width, canvas.height] = [2 * width, 26];
    canvas.style.width = `${width}px`;
    const context = canvas.getContext('2d');
    context.scale(2, 2);
    drawMark(new CanvasPen(context), entry);
    const parts = [entry.before, canvas, entry.word].filter(Boolean);
    return element('span', {class: entry.before ? 'chip range' : 'chip'}, ...parts);
  });
}

const ruler = element('canvas').getContext('2d');
const widthOf = (text, size) => { ruler.font = fontOf(size); return ruler.measureText(text).width; };
/// A text as lines of at most so many pixels; a word that is longer is broken.
function linesOf(text, width, size) {
  const lines = [''];
  for (const word of text.split(/(?<= )/)) {
    for (const piece of widthOf(word, size) > width ? word : [word]) {
      const last = lines[lines.length - 1];
      if (last && widthOf((last + piece).trimEnd(), size) > width) lines.push(piece);
      else lines[lines.length - 1] += piece;
    }
  }
  return lines.map((line) => line.trimEnd()).filter(Boolean);
}

// Pixels of an exported picture for each of the screen.
const EXPORT_SCALE = 3;
const MARGIN = 8;
/// A picture that stands by itself: title above, legend, note and credit below what `body` draws with a pen on
/// width × height. `kind`: PNG, a canvas; or SVG, a text.
function picture(kind, {width, height, title, legend, note}, body) {
  const inner = width - 2 * MARGIN;
  const words = (text, size, colour) => linesOf(text, inner, size).map((line) => ({line, size, colour}));
  const heading = words(title, 13, ink());
  const below = [...words(note, 11, quiet()), ...words(credit(), 9, quiet())];
  const places = [];
  let across = 0, row = 0;
  for (const entry of legend) {
    const before = entry.before ? widthOf(entry.before, 11) + 5 : 0;
    const wide = before + MARKS[entry.mark] + 5 + widthOf(entry.word, 11);
    if (across > 0 && across + wide > inner) { across = 0; ++row; }
    places.push({entry, before, across, row});
    across += wide + 14;
  }
  const top = MARGIN + 18 * heading.length;
  const rows = top + height + 4, notes = rows + (legend.length ? 18 * (row + 1) : 0) + 2;
  const high = notes + 15 * below.length + MARGIN;
  const draw = (pen) => {
    const lines = (texts, from, step) => texts.forEach(({line, size, colour}, i) =>
      pen.text(line, MARGIN, from + (i + 0.5) * step, {colour, size}));
    lines(heading, MARGIN / 2, 18);
    pen.moved(0, top, () => body(pen));
    for (const {entry, before, across: right, row: down} of places) {
      pen.moved(MARGIN + right, rows + 18 * down, () => {
        if (before) pen.text(entry.before, 0, 7.5, {colour: quiet()});
        pen.moved(before, 1, () => drawMark(pen, entry));
        pen.text(entry.word, before + MARKS[entry.mark] + 5, 7.5, {colour: quiet()});
      });
    }
    lines(below, notes, 15);
  };
  if (kind === 'SVG') {
    const pen = new SvgPen();
    draw(pen);
    return pen.finish(width, high, ground());
  }
  const canvas = element('canvas');
  [canvas.width, canvas.height] = [width, high].map((side) => Math.round(side * EXPORT_SCALE));
  const context = canvas.getContext('2d');
  context.fillStyle = ground();
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.scale(EXPORT_SCALE, EXPORT_SCALE);
  draw(new CanvasPen(context));
  return canvas;
}

function rangeOf(arrays, share = 0.05) {
  let low = Infinity, high = -Infinity;
  for (const array of arrays) for (const value of array) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
  if (!(low <= high)) return [0, 1];
  if (low === high) { const size = Math.abs(low) || 1; return [low - 0.1 * size, high + 0.1 * size]; }
  return [low - share * (high - low), high + share * (high - low)];
}

const superscript = (digit) => (digit === '-' ? '⁻' : '⁰¹²³⁴⁵⁶⁷⁸⁹'[digit]);
const powerOfTen = (exponent) =>
  (Number.isInteger(exponent) ? `10${[...String(exponent)].map(superscript).join('')}` : '');

/// What a picture or a table is of: in words, and as names with their units and values.
const nothing = {words: '', values: []};

class Chart {
  /// `name` of the exported files; `height` in pixels; `equal`: one scale for both axes; `decades`: y as powers of ten;
  /// `legendHolder`: where legend and note stand; `hover`: what is said of the place under the pointer.
  constructor(holder,
    {name, heading, xLabel = '', yLabel = '', height = 250, equal = false, decades = false, legendHolder, click = null,
      hover = null}) {
    Object.assign(this, {holder, name, heading, xLabel, yLabel, height, equal, decades, legendHolder, click, hover,
      xTicks: null, yTicks: null, layers: [], legend: [], note: '', about: nothing});
    this.tip = element('div', {class: 'tip', 'aria-hidden': 'true', hidden: true});
    this.view = {x: [0, 1], y: [0, 1]};
    this.zoomed = null;
    this.build();
    new ResizeObserver(() => this.fit()).observe(holder);
  }
  get shownRange() { return this.zoomed || this.view; }
  axis(side, label, ticks) {
    return {
      scale: side, stroke: () => quiet(), label, labelSize: 20, labelFont: '12px system-ui, sans-serif',
      font: '11px system-ui, sans-serif', size: side === 'x' ? 34 : 52,
      grid: {stroke: () => rule(), width: 1}, ticks: {stroke: () => rule(), width: 1, size: 4},
      space: side === 'x' ? 60 : 32,
      splits: ticks ? () => ticks.places : undefined,
      values: ticks ? (chart, splits) => splits.map((at) => ticks.words[ticks.places.indexOf(at)])
        : (chart, splits) => splits.map(side === 'y' && this.decades ? powerOfTen : (value) => shown(value, 6)),
    };
  }
  build() {
    this.plot?.destroy();
    const width = Math.max(this.holder.clientWidth, 200);
    this.plot = new uPlot({
      width, height: this.height, legend: {show: false}, padding: [8, 12, 0, 0],
      cursor: {drag: {x: true, y: true, uni: 20, setScale: false}, points: {show: false}},
      scales: {x: {time: false, range: () => this.fitted.x}, y: {range: () => this.fitted.y}},
      axes: [this.axis('x', this.xLabel, this.xTicks), this.axis('y', this.yLabel, this.yTicks)],
      series: [{}, {show: false}],
      hooks: {
        draw: [(plot) => this.draw(plot)],
        setSelect: [(plot) => this.zoom(plot)],
        ready: [(plot) => {
          plot.over.addEventListener('dblclick', () => { this.zoomed = null; this.refresh(); });
          if (this.hover) {
            plot.over.addEventListener('mousemove', (event) => this.showTip(plot, event));
            plot.over.addEventListener('mouseleave', () => { this.tip.hidden = true; });
          }
          if (this.click) {
            let from = null;
            plot.over.addEventListener('mousedown', (event) => { from = [event.clientX, event.clientY]; });
            plot.over.addEventListener('click', (event) => {
              if (from && Math.hypot(event.clientX - from[0], event.clientY - from[1]) > 4) return;
              const box = plot.over.getBoundingClientRect();
              this.click(plot.posToVal(event.clientX - box.left, 'x'), plot.posToVal(event.clientY - box.top, 'y'));
            });
          }
        }],
      },
    }, [[0, 1], [null, null]], this.holder);
    this.holder.append(this.tip);
    this.nameCanvas();
  }
  /// For those who do not see the canvas.
  nameCanvas() {
    const {canvas} = this.plot.ctx;
    canvas.setAttribute('role', 'img');
    canvas.setAttribute('aria-label', this.title);
    const marks = this.legend.map(({before, word}) => [before, word].filter(Boolean).join(' to '));
    canvas.textContent = [...marks, this.note].filter(Boolean).join('; ');
  }
  showTip(plot, {clientX, clientY}) {
    const box = plot.over.getBoundingClientRect(), outside = this.holder.getBoundingClientRect();
    this.tip.textContent =
      this.hover(plot.posToVal(clientX - box.left, 'x'), plot.posToVal(clientY - box.top, 'y'));
    this.tip.hidden = false;
    const right = outside.width - this.tip.offsetWidth;
    const above = clientY - outside.top - this.tip.offsetHeight - 12;
    this.tip.style.left = `${Math.max(0, Math.min(clientX - outside.left + 12, right))}px`;
    this.tip.style.top = `${above >= 0 ? above : clientY - outside.top + 18}px`;
  }
  get title() { return [this.heading, this.about.words].filter(Boolean).join(' · '); }
  /// The range that is drawn: as asked for, or widened in one direction so that both axes have one scale.
  get fitted() {
    const {x, y} = this.shownRange;
    if (!this.equal || !this.plot?.bbox?.width) return {x, y};
    const perPixel = Math.max((x[1] - x[0]) / this.plot.bbox.width, (y[1] - y[0]) / this.plot.bbox.height);
    const around = (range, pixels) => {
      const middle = (range[0] + range[1]) / 2;
      return [middle - perPixel * pixels / 2, middle + perPixel * pixels / 2];
    };
    return {x: around(x, this.plot.bbox.width), y: around(y, this.plot.bbox.height)};
  }
  zoom(plot) {
    const {left, top, width, height} = plot.select;
    if (width < 5 && height < 5) return;
    const {x, y} = this.shownRange;
    this.zoomed = {x: width > 5 ? [plot.posToVal(left, 'x'), plot.posToVal(left + width, 'x')] : x,
      y: height > 5 ? [plot.posToVal(top + height, 'y'), plot.posToVal(top, 'y')] : y};
    plot.setSelect({left: 0, top: 0, width: 0, height: 0}, false);
    this.refresh();
  }
  refresh() { this.plot.setData([[0, 1], [null, null]], true); }
  fit() {
    const width = Math.max(this.holder.clientWidth, 200);
    if (width === this.plot.width) return;
    this.plot.setSize({width, height: this.height});
    if (this.equal) this.refresh();
  }
  /// What the chart shows from now on. `csv`: columns by name, which are exported; `about`: what all of it is of.
  show({layers, x, y, csv, about, legend = [], note = '', keepZoom = false, ...labels}) {
    const relabelled = Object.keys(labels).some((name) => labels[name] !== this[name]);
    Object.assign(this, {layers, csv, about, legend, note, ...labels});
    this.legendHolder.replaceChildren(...legendChips(legend),
      ...(note ? [element('span', {class: 'quiet long', text: note})] : []));
    this.view = {x, y};
    if (!keepZoom) this.zoomed = null;
    if (relabelled) this.build(); else this.nameCanvas();
    this.refresh();
    if (this.equal) this.refresh();  // the first time, the box was not known yet
  }
  draw(plot) {
    const box = {left: plot.bbox.left, top: plot.bbox.top, right: plot.bbox.left + plot.bbox.width,
      bottom: plot.bbox.top + plot.bbox.height};
    const to = {x: (value) => plot.valToPos(value, 'x', true), y: (value) => plot.valToPos(value, 'y', true)};
    const pen = new CanvasPen(plot.ctx, uPlot.pxRatio);
    pen.clipped([[box.left, box.top, box.right, box.bottom]],
      () => this.layers.forEach((layer) => drawLayer(pen, layer, to, box)));
  }
  /// The chart as it is on the screen.
  picture(kind) {
    const {plot, title, legend, note} = this;
    const ratio = uPlot.pxRatio;
    const [left, top, wide, high] = [plot.bbox.left, plot.bbox.top, plot.bbox.width, plot.bbox.height]
      .map((size) => size / ratio);
    const box = {left, top, right: left + wide, bottom: top + high};
    const to = {x: (value) => plot.valToPos(value, 'x', true) / ratio,
      y: (value) => plot.valToPos(value, 'y', true) / ratio};
    return picture(kind, {width: plot.width, height: plot.height, title, legend, note}, (pen) => {
      const [across, upward] = plot.axes;
      for (const [i, at] of (across._splits || []).entries()) {
        if (at === null || to.x(at) < box.left - 1 || to.x(at) > box.right + 1) continue;
        pen.line([[to.x(at), box.top], [to.x(at), box.bottom]], {colour: rule()});
        pen.text(across._values[i] ?? '', to.x(at), box.bottom + 12, {colour: quiet(), align: 'center'});
      }
      for (const [i, at] of (upward._splits || []).entries()) {
        if (at === null || to.y(at) < box.top - 1 || to.y(at) > box.bottom + 1) continue;
        pen.line([[box.left, to.y(at)], [box.right, to.y(at)]], {colour: rule()});
        pen.text(upward._values[i] ?? '', box.left - 8, to.y(at), {colour: quiet(), align: 'right'});
      }
      pen.text(this.xLabel, (box.left + box.right) / 2, box.bottom + 32, {colour: quiet(), size: 12, align: 'center'});
      pen.text(this.yLabel, 10, (box.top + box.bottom) / 2, {colour: quiet(), size: 12, align: 'center', turned: true});
      pen.clipped([[box.left, box.top, box.right, box.bottom]],
        () => this.layers.forEach((layer) => drawLayer(pen, layer, to, box)));
    });
  }
}
