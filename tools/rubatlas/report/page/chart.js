// --- Charts: axes, scales and zoom by uPlot; layers of lines, dots and images drawn by a pen, on canvas or as SVG. ---

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
  text(words, x, y, {colour, size = 11, align = 'left'}) {
    this.context.fillStyle = colour;
    this.context.textAlign = align;
    this.context.textBaseline = 'middle';
    this.context.font = `${size * this.scale}px system-ui, sans-serif`;
    this.context.fillText(words, x, y);
  }
  clipped(x, y, width, height, draw) {
    this.context.save();
    this.context.beginPath();
    this.context.rect(x, y, width, height);
    this.context.clip();
    draw();
    this.context.restore();
  }
}

class SvgPen {
  constructor(width, height) {
    this.parts = [];
    this.width = width;
    this.height = height;
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
  clipped(x, y, width, height, draw) {
    const name = `clip${++this.clips}`;
    const window = `<rect x="${x}" y="${y}" width="${width}" height="${height}"/>`;
    this.parts.push(`<clipPath id="${name}">${window}</clipPath><g clip-path="url(#${name})">`);
    draw();
    this.parts.push('</g>');
  }
  finish(background) {
    const {width, height} = this;
    return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" ` +
      `viewBox="0 0 ${width} ${height}" font-family="system-ui, sans-serif">` +
      `<rect width="100%" height="100%" fill="${background}"/>${this.parts.join('')}</svg>`;
  }
}

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
  }
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

class Chart {
  /// `name` of the exported files; `height` in pixels; `equal`: one scale for both axes; `decades`: y as powers of ten.
  constructor(holder,
    {name, xLabel, yLabel, height = 250, equal = false, xTicks = null, yTicks = null, decades = false, click = null}) {
    Object.assign(this, {holder, name, xLabel, yLabel, height, equal, xTicks, yTicks, decades, click});
    this.layers = [];
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
  }
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
  /// What the chart shows from now on. `csv`: columns by name, which are exported.
  show({layers, x, y, csv, keepZoom = false, xLabel, yLabel, xTicks, yTicks}) {
    const relabelled = (xLabel && xLabel !== this.xLabel) || (yLabel && yLabel !== this.yLabel) || xTicks !== undefined
      || yTicks !== undefined;
    Object.assign(this, {layers, csv, xLabel: xLabel ?? this.xLabel, yLabel: yLabel ?? this.yLabel});
    if (xTicks !== undefined) this.xTicks = xTicks;
    if (yTicks !== undefined) this.yTicks = yTicks;
    this.view = {x, y};
    if (!keepZoom) this.zoomed = null;
    if (relabelled) this.build();
    this.refresh();
    if (this.equal) this.refresh();  // the first time, the box was not known yet
  }
  draw(plot) {
    const box = {left: plot.bbox.left, top: plot.bbox.top, right: plot.bbox.left + plot.bbox.width,
      bottom: plot.bbox.top + plot.bbox.height};
    const to = {x: (value) => plot.valToPos(value, 'x', true), y: (value) => plot.valToPos(value, 'y', true)};
    const pen = new CanvasPen(plot.ctx, uPlot.pxRatio);
    pen.clipped(box.left, box.top, plot.bbox.width, plot.bbox.height,
      () => this.layers.forEach((layer) => drawLayer(pen, layer, to, box)));
  }
  svg(title) {
    const {plot} = this;
    const ratio = uPlot.pxRatio, above = 26, below = 18;
    const pen = new SvgPen(plot.width, plot.height + above + below);
    const box = {left: plot.bbox.left / ratio, top: plot.bbox.top / ratio + above};
    box.right = box.left + plot.bbox.width / ratio;
    box.bottom = box.top + plot.bbox.height / ratio;
    const to = {x: (value) => plot.valToPos(value, 'x', true) / ratio,
      y: (value) => plot.valToPos(value, 'y', true) / ratio + above};
    pen.text(title, 8, 14, {colour: ink(), size: 13});
    pen.text(credit(), 8, plot.height + above + 8, {colour: quiet(), size: 9});
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
    pen.clipped(box.left, box.top, box.right - box.left, box.bottom - box.top,
      () => this.layers.forEach((layer) => drawLayer(pen, layer, to, box)));
    return pen.finish(ground());
  }
  png(title) {
    const source = this.plot.ctx.canvas;
    const ratio = uPlot.pxRatio, above = 26 * ratio, below = 18 * ratio;
    const canvas = element('canvas');
    canvas.width = source.width;
    canvas.height = source.height + above + below;
    const context = canvas.getContext('2d');
    context.fillStyle = ground();
    context.fillRect(0, 0, canvas.width, canvas.height);
    context.drawImage(source, 0, above);
    const pen = new CanvasPen(context, ratio);
    pen.text(title, 8 * ratio, above / 2, {colour: ink(), size: 13});
    pen.text(credit(), 8 * ratio, canvas.height - below / 2, {colour: quiet(), size: 9});
    return canvas;
  }
}
