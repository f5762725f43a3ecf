// --- The rotor, moving: shaft, blades, ring and contact forces, seen along the shaft. ---

class Rotor {
  constructor(canvas, status) {
    this.canvas = canvas;
    this.status = status;
    this.name = 'rotor';
    this.about = nothing;
    this.orbit = null;
    this.time = 0;
    this.playing = false;
    this.secondsPerRevolution = 4;
    this.zoom = 0;
    this.trail = true;
    this.frames = 0;
    this.missing = '';
    this.moved = () => {};
    new ResizeObserver(() => this.fit()).observe(canvas.parentElement);
  }
  fit() {
    const side = Math.min(this.canvas.parentElement.clientWidth, 430);
    this.canvas.style.width = this.canvas.style.height = `${side}px`;
    this.canvas.width = this.canvas.height = Math.round(side * devicePixelRatio);
    this.draw();
  }
  /// `request` is what the orbit was computed from; `missing`: what is said where there is none; `about`: what the
  /// orbit is of.
  show(orbit, request, missing, about) {
    this.orbit = orbit;
    this.about = about;
    this.canvas.setAttribute('aria-label', `The rotor in its ring, seen along the shaft · ${about.words}`);
    this.missing = missing;
    this.request = request;
    this.time = 0;
    if (!orbit) { this.pause(); this.draw(); return; }
    this.period = 2 * Math.PI / request.speed_ratio;
    this.duration = orbit.time.length * (orbit.time[1] - orbit.time[0]);
    this.largestForce = orbit.force.reduce((most, force) => Math.max(most, force), 0);
    const {number, blade, time, force} = orbit.contact;
    const contacts = new Map();
    number.forEach((contact, i) => {
      if (!contacts.has(contact)) contacts.set(contact, {blade: blade[i], times: [], forces: []});
      contacts.get(contact).times.push(time[i]);
      contacts.get(contact).forces.push(force[i]);
    });
    this.contacts = [...contacts.values()];
    // A contact that is open when the orbit begins has touched down before.
    this.touchDowns = this.contacts.map(({times}) => times[0]).filter((first) => first > 0).sort((a, b) => a - b);
    this.draw();
  }
  play() {
    if (this.playing || !this.orbit) return;
    this.playing = true;
    this.last = performance.now();
    requestAnimationFrame((now) => this.tick(now));
  }
  pause() { this.playing = false; }
  tick(now) {
    if (!this.playing || !this.orbit) return;
    this.time = (this.time + (now - this.last) / 1000 / this.secondsPerRevolution * this.period) % this.duration;
    this.last = now;
    this.draw();
    requestAnimationFrame((later) => this.tick(later));
  }
  step() {
    if (!this.orbit || !this.touchDowns.length) return;
    this.pause();
    // Just after the touch-down, where the force is there.
    const later = this.touchDowns.find((time) => time > this.time + 1e-9 * this.duration);
    this.time = (later ?? this.touchDowns[0]) + 1e-6 * this.period;
    this.draw();
  }
  /// The angle of rotation φ; a speed ripple makes it run ahead and fall behind (model, section 7.5).
  angle(time) {
    const turned = this.request.speed_ratio * time;
    const {amplitude = 0, order = 1, phase = 0} = this.request.scene.speed_ripple ?? {};
    return turned + amplitude / order * (Math.sin(order * turned + phase) - Math.sin(phase));
  }
  /// The force on a blade at the present time, from the samples of its contacts, which are closer together than those
  /// of the orbit.
  force(blade) {
    const open = this.contacts.find((one) =>
      one.blade === blade && one.times[0] <= this.time && this.time <= one.times[one.times.length - 1]);
    if (!open) return 0;
    const {times, forces} = open;
    const later = Math.max(1, times.findIndex((time) => time >= this.time));
    if (times.length === 1) return forces[0];
    return forces[later - 1]
      + (this.time - times[later - 1]) / (times[later] - times[later - 1] || 1) * (forces[later] - forces[later - 1]);
  }
  /// State and forces at the present time, between the samples of the orbit.
  present() {
    const {orbit} = this;
    const count = orbit.time.length;
    const at = Math.min(this.time / this.duration * count, count - 1);
    const low = Math.min(Math.floor(at), count - 2), share = at - low;
    const mix = (array, width, i) => array[width * low + i]
      + share * (array[width * (low + 1) + i] - array[width * low + i]);
    const blades = Array.from({length: orbit.blades},
      (_, i) => ({force: this.force(i), angle: this.angle(this.time) + 2 * Math.PI * i / orbit.blades}));
    return {x: mix(orbit.state, 4, 0), y: mix(orbit.state, 4, 1), low, blades};
  }
  draw() {
    const context = this.canvas.getContext('2d');
    context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    this.paint(new CanvasPen(context, devicePixelRatio), this.canvas.width / devicePixelRatio);
    ++this.frames;
    this.canvas.dataset.frames = this.frames;
    this.canvas.dataset.time = this.orbit ? this.time : '';
    if (this.orbit) {
      const revolution = this.time / this.period;
      const loads = this.now.blades.map((blade, i) => [i, blade.force]).filter(([, force]) => force > 0);
      const touching = loads.map(([i, force]) => `blade ${i + 1} ${withUnits(force, 'N', 3)}`).join(', ');
      const turned = `${shown(1 + Math.floor(revolution), 4)}, ${shown(Math.floor(360 * (revolution % 1)), 3)}°`;
      this.status.textContent = `revolution ${turned} · ${touching ? `in contact: ${touching}` : 'no contact'}`;
      this.moved(this.now);
    } else this.status.textContent = this.missing || (this.request ? 'no motion to show' : '');
  }
  paint(pen, side) {
    const unit = pen.scale;
    if (!this.orbit) return;
    const {request} = this;
    const now = this.now = this.present();
    const radius = request.ring_radius;
    const shapes = now.blades.map(({angle, force}) => {
      const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
      const place = ([along, across]) => {
        const outward = request.hub_radius + request.blade_length * along, aside = -request.blade_length * across;
        return [now.x + outward * cos - aside * sin, now.y + outward * sin + aside * cos];
      };
      return this.shape(force, place).map(place);
    });
    now.tips = shapes.map((points) => points[points.length - 1]);
    // The view closes in on the ring where a tip is nearest to it, or furthest beyond it.
    const nearest = now.tips.map(([x, y]) => [x, y + request.misalignment])
      .reduce((best, tip) => (Math.hypot(...tip) > Math.hypot(...best) ? tip : best));
    const toward = Math.atan2(nearest[1], nearest[0]);
    const near = Math.min(this.zoom, 1);
    const focus = [near * radius * Math.cos(toward), near * radius * Math.sin(toward) - request.misalignment];
    const scale = side * unit / (2.3 * radius) * 10 ** this.zoom;
    const middle = side * unit / 2;
    const to = (x, y) => [middle + (x - focus[0]) * scale, middle - (y - focus[1]) * scale];
    const ring = to(0, -request.misalignment);
    const grey = quiet();
    pen.clipped([[0, 0, side * unit, side * unit]], () => {
      // A circle that is far larger than the picture is drawn as the arc that can be seen.
      const arc = [];
      const spread = Math.min(Math.PI, 4 * side * unit / (radius * scale));
      for (let i = -120; i <= 120; ++i) {
        const angle = toward + spread * i / 120;
        arc.push([ring[0] + radius * scale * Math.cos(angle), ring[1] - radius * scale * Math.sin(angle)]);
      }
      pen.line(arc, {colour: ink(), width: 3});
      const cross = 5 * unit;
      pen.line([[ring[0] - cross, ring[1]], [ring[0] + cross, ring[1]], [NaN, NaN], [ring[0], ring[1] - cross],
        [ring[0], ring[1] + cross]], {colour: grey});
      if (this.trail) {
        const path = [];
        const samples = Math.round(this.orbit.time.length * this.period / this.duration);
        for (let i = Math.max(0, now.low - 2 * samples); i <= now.low; ++i) {
          path.push(to(this.orbit.state[4 * i], this.orbit.state[4 * i + 1]));
        }
        pen.line(path, {colour: strong(), width: 1.5});
      }
      now.blades.forEach((blade, i) => {
        pen.line(shapes[i].map(([x, y]) => to(x, y)), {colour: cycle()[i % 6], width: 3});
        const tip = now.tips[i];
        if (blade.force > 0 && this.largestForce > 0) this.arrow(pen, to(...tip), tip, blade.force, side * unit);
      });
      const hub = Math.max(request.hub_radius * scale, 7 * unit);
      pen.circle(...to(now.x, now.y), hub, {colour: ink(), width: 1.5, fill: ground()});
      pen.dots([to(now.x, now.y)], {colour: ink(), size: 4});
      // A mark between blade 1 and the hub's centre shows how the rotor turns.
      const turn = now.blades[0].angle;
      const centre = to(now.x, now.y);
      pen.line([centre, [centre[0] + hub * Math.cos(turn), centre[1] - hub * Math.sin(turn)]],
        {colour: cycle()[0], width: 2});
    });
    pen.text(this.zoom > 0 ? `×${shown(10 ** this.zoom, 3)}` : '', 8 * unit, 14 * unit, {colour: grey});
  }
  /// A blade that bears a force; `place` says where a point of it is.
  shape(force, place) {
    const {request} = this;
    const {contact, yielding_ring: yielding, regularised_friction: turning, stribeck, stick} = request.scene;
    if (!(force > 0) || contact.law === 'elastic_ring') return [[0, 0], [1, 0]];  // rigid blades stay straight
    const stiffness = request.youngs_modulus * request.blade_width * request.thickness ** 3 / 12;
    const radius = request.ring_radius + (yielding?.compliance ?? 0) * force;
    const miss = (tip) => { const [x, y] = place(tip); return Math.hypot(x, y + request.misalignment) - radius; };
    const shares = turning || stribeck || stick ? Array.from({length: 17}, (_, i) => 1 - i / 8) : [1, -1];
    const load = force * request.blade_length ** 2 / stiffness;
    return bentBlade(atlas.elastica, load, request.friction, shares, miss);
  }
  /// The force of the ring on a tip, −F n − s μ F t.
  arrow(pen, [x, y], tip, force, side) {
    const outward = Math.atan2(tip[1] + this.request.misalignment, tip[0]);
    const length = 0.22 * side * force / this.largestForce;
    const direction = [-Math.cos(outward), Math.sin(outward)];
    const head = [x + length * direction[0], y + length * direction[1]];
    const wing = 5 * pen.scale;
    const colour = VERMILION;
    pen.line([[x, y], head], {colour, width: 2});
    const across = [-direction[1], direction[0]];
    const barb = (side) => [0, 1].map((i) => head[i] - wing * (direction[i] + side * across[i]));
    pen.line([barb(-0.6), head, barb(0.6)], {colour, width: 2});
  }
  csv() {
    const {orbit} = this;
    if (!orbit) return {};
    const columns = {tau: Array.from(orbit.tau ?? orbit.time)};
    ['x', 'y', 'vx', 'vy'].forEach((name, part) => {
      columns[column(name, part < 2 ? 'm' : 'm per unit of tau')] =
        componentOf(orbit.state, part);
    });
    for (let blade = 0; blade < orbit.blades; ++blade) {
      columns[column(`force_of_blade_${blade + 1}`, 'N')] =
        Array.from(orbit.time, (_, i) => orbit.force[orbit.blades * i + blade]);
    }
    return columns;
  }
  get title() { return `The rotor in its ring · ${this.about.words}`; }
  picture(kind) {
    const side = 430;
    const legend = this.orbit ? [{mark: 'line', colour: strong(), word: 'path of the shaft’s centre'},
      {mark: 'line', colour: VERMILION, word: 'force of the ring on a blade'}] : [];
    return picture(kind, {width: side, height: side, title: this.title, legend, note: this.status.textContent},
      (pen) => this.paint(pen, side));
  }
}
