// The program's solver as a WebAssembly module: a request of numbers in, an orbit out.
// Runs in a worker of the page, and in node for tests.

// In the order of `Request` in tools/explorer_solver/solver.cpp; SI units.
const REQUEST = [
  'speed_ratio', 'damping_ratio', 'friction', 'unbalance', 'unbalance_phase', 'thickness', 'misalignment', 'mass',
  'natural_frequency', 'blade_count', 'blade_length', 'blade_width', 'youngs_modulus', 'hub_radius', 'ring_radius',
  'ring_stiffness', 'contact_law', 'max_shortening', 'tolerance', 'x', 'y', 'vx', 'vy', 'transient_revolutions',
  'sampled_revolutions', 'samples_per_revolution', 'stop_when_periodic'];

const DONE = 1;

// The module prints nothing and reads no environment: these answer the C library's start and stop.
function systemInterface() {
  const refuse = () => 8;  // WASI: bad file descriptor
  return {
    environ_get: () => 0,
    environ_sizes_get: (count, size) => {
      module.view().setUint32(count, 0, true);
      module.view().setUint32(size, 0, true);
      return 0;
    },
    fd_close: refuse, fd_seek: refuse, fd_write: refuse,
    proc_exit: (code) => { throw new Error(`the solver ended with code ${code}`); },
  };
}
let module = null;

async function makeSolver(bytes) {
  const compiled = await WebAssembly.compile(bytes);
  let calls = null;
  async function start() {
    const instance = await WebAssembly.instantiate(compiled, {wasi_snapshot_preview1: systemInterface()});
    calls = instance.exports;
    module = {view: () => new DataView(calls.memory.buffer)};
    calls._initialize();
    if (calls.request_size() !== REQUEST.length) throw new Error('the solver expects another request');
  }
  await start();

  const doubles = (address, count) => new Float64Array(calls.memory.buffer, address, count).slice();
  const integers = (address, count) => new Int32Array(calls.memory.buffer, address, count).slice();

  /// The orbit of `wanted`, an object with a number for each name of REQUEST.
  async function compute(wanted) {
    const request = new Float64Array(calls.memory.buffer, calls.request_numbers(), REQUEST.length);
    for (const [place, name] of REQUEST.entries()) {
      if (!Number.isFinite(wanted[name])) throw new Error(`${name} is no number`);
      request[place] = wanted[name];
    }
    let status;
    try {
      status = calls.compute();
    } catch (error) {
      await start();  // a module that has trapped is not used again
      throw error;
    }
    if (status < 0) throw new Error('a value is outside the range of the solver');
    const blades = wanted.blade_count;
    const times = calls.time_count();
    const samples = calls.contact_sample_count();
    return {
      status,
      ending: status === DONE ? ''
        : new TextDecoder().decode(new Uint8Array(calls.memory.buffer, calls.ending(), calls.ending_size())),
      failedRevolution: calls.failed_revolution(),
      blades,
      samples: wanted.samples_per_revolution,
      sections: doubles(calls.sections(), 4 * calls.section_count()),
      time: doubles(calls.times(), times),
      state: doubles(calls.states(), 4 * times),
      force: doubles(calls.forces(), blades * times),
      contact: {
        number: integers(calls.contact_numbers(), samples),
        blade: integers(calls.contact_blades(), samples),
        time: doubles(calls.contact_times(), samples),
        force: doubles(calls.contact_forces(), samples),
      },
    };
  }
  return {compute};
}
