// The program's solver as a WebAssembly module: a scene of one point in, an orbit out.
// Runs in a worker of the page, and in node for tests.

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

/// The orbit with times in which all revolutions are equally long, as charts and the moving rotor need them: samples
/// are equal parts of a revolution, also where a ramp makes one shorter than the other. Its own times are `tau`.
function inEqualRevolutions(orbit, period) {
  const {time, samples, contact} = orbit;
  const place = (at) => {
    let low = 0, high = time.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (time[middle] > at) high = middle;
      else low = middle;
    }
    return low + (at - time[low]) / (time[high] - time[low]);
  };
  const equal = (at) => place(at) * period / samples;
  return {...orbit, tau: time, time: time.map((_, i) => i * period / samples),
    contact: {...contact, tau: contact.time, time: contact.time.map(equal)}};
}

async function makeSolver(bytes) {
  const compiled = await WebAssembly.compile(bytes);
  let calls = null;
  async function start() {
    const instance = await WebAssembly.instantiate(compiled, {wasi_snapshot_preview1: systemInterface()});
    calls = instance.exports;
    module = {view: () => new DataView(calls.memory.buffer)};
    calls._initialize();
  }
  await start();

  const doubles = (address, count) => new Float64Array(calls.memory.buffer, address, count).slice();
  const integers = (address, count) => new Int32Array(calls.memory.buffer, address, count).slice();

  const text = (address, size) => new TextDecoder().decode(new Uint8Array(calls.memory.buffer, address, size));

  /// The orbit of the one point of a scene, from its initial state and what effects remember.
  async function compute({scene, memory}) {
    const bytes = new TextEncoder().encode(JSON.stringify(scene));
    const place = calls.scene_of_size(bytes.length);
    new Uint8Array(calls.memory.buffer, place, bytes.length).set(bytes);
    new Float64Array(calls.memory.buffer, calls.memory_of_effects(), memory.length).set(memory);
    let status;
    try {
      status = calls.compute(memory.length);
    } catch (error) {
      const refusal = text(calls.refusal_text(), calls.refusal_size());
      await start();  // a module that has trapped is not used again
      throw refusal ? new Error(refusal) : error;
    }
    return orbitOf(status, scene);
  }
  function orbitOf(status, scene) {
    const blades = scene.blades.count;
    const times = calls.time_count();
    const samples = calls.contact_sample_count();
    const orbit = {
      status,
      ending: status === DONE ? '' : text(calls.ending(), calls.ending_size()),
      failedRevolution: calls.failed_revolution(),
      blades,
      samples: scene.protocol.samples_per_revolution,
      sections: doubles(calls.sections(), 4 * calls.section_count()),
      memory: doubles(calls.final_memory(), calls.final_memory_size()),
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
    return scene.speed_ramp ? inEqualRevolutions(orbit, 2 * Math.PI / scene.grid.speed_ratio[0]) : orbit;
  }
  return {compute};
}
