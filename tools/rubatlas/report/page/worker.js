// The worker of the page: one request after the other, and the spectrum of each orbit.

/// Amplitudes of x over a whole number of revolutions: 2|X|/N at orders 0, 1/S, …, max_order, |X|/N at 0 and at half
/// the samples per revolution.
function spectrumOf(orbit, samplesPerRevolution, maxOrder) {
  const count = orbit.time.length;
  const revolutions = count / samplesPerRevolution;
  const lines = Math.floor(Math.min(maxOrder, samplesPerRevolution / 2) * revolutions) + 1;
  const amplitude = new Float64Array(lines);
  for (let k = 0; k < lines; ++k) {
    // Goertzel's recurrence with the sample index reduced: one cosine a line.
    const angle = 2 * Math.PI * k / count, twice = 2 * Math.cos(angle);
    let last = 0, before = 0;
    for (let i = 0; i < count; ++i) {
      const now = orbit.state[4 * i] + twice * last - before;
      before = last;
      last = now;
    }
    const real = last - before * Math.cos(angle), imaginary = before * Math.sin(angle);
    amplitude[k] = (k === 0 || 2 * k === count ? 1 : 2) * Math.hypot(real, imaginary) / count;
  }
  return {amplitude, revolutions};
}

let solver = null;
let busy = Promise.resolve();
async function answer({id, request, maxOrder, module: bytes}) {
  try {
    if (bytes) {
      solver = await makeSolver(bytes);
      return postMessage({id, ready: true});
    }
    const begin = performance.now();
    const orbit = await solver.compute(request);
    const milliseconds = performance.now() - begin;
    const spectrum = orbit.status === DONE ? spectrumOf(orbit, orbit.samples, maxOrder) : null;
    return postMessage({id, orbit, spectrum, milliseconds});
  } catch (error) {
    return postMessage({id, error: String(error.message || error)});
  }
}
onmessage = (message) => { busy = busy.then(() => answer(message.data)); };
