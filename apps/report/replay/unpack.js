// What packed_picture.cpp packed: {bodies: [{x, cells}], frames: [{time, poses, pressures, shapes}], water(f): {x, p, cells}}. Places in m, three
// coordinates a point, pressures 0 to 255; `shapes`: places of a body's points before its pose, x where it does not bend. Water is unpacked when it is asked for.
function splashdown_unpack(info, buffer) {
  'use strict';
  const bytes = new Uint8Array(buffer), arrays = {};
  let at = 0;
  for (const { name, size, count } of info.arrays) {
    const numbers = new (size === 1 ? Uint8Array : Uint32Array)(count);
    for (let byte = 0; byte < size; ++byte) for (let i = 0; i < count; ++i) numbers[i] |= bytes[at++] << (8 * byte);
    arrays[name] = numbers;
  }
  if (at !== bytes.length) throw new Error('the replay is cut short');
  const { steps, references, segments, water, hulls } = arrays, places = [arrays.x, arrays.y, arrays.z];
  const bends = [arrays.bends_x, arrays.bends_y, arrays.bends_z];
  const plane = info.dimension === 2;
  const unfolded = (v) => (v >>> 1) ^ -(v & 1);  // the lowest bit is the sign
  const metres = (q) => {
    const x = new Float32Array(3 * q[0].length);
    for (let k = 0; k < 3; ++k) for (let i = 0; i < q[k].length; ++i) x[3 * i + k] = info.low[k] + info.step * q[k][i];
    return x;
  };

  // mesh_code.hpp says how. `from`: where each array is read next.
  function triangles(points, cells, from, with_pressure) {
    const q = [0, 1, 2].map(() => new Int32Array(points)), p = new Uint8Array(points), corners = new Uint32Array(cells);
    const after = new Int32Array(points).fill(-1), before = new Int32Array(points).fill(-1), open = new Int32Array(3 * cells);
    let n = 0, told = 0, first = 0, end = 0;
    const fresh = (u, w, o) => {
      for (let k = 0; k < 3; ++k) q[k][n] = (u < 0 ? 0 : q[k][u] + q[k][w] - q[k][o]) + unfolded(places[k][from.places]);
      ++from.places;
      if (with_pressure) p[n] = Math.min(255, Math.max(0, u < 0 ? 0 : p[u] + p[w] - p[o])) + water[from.water++];
      return n++;
    };
    const named = () => n - 1 - references[from.references++];
    const edge = (a, b, o) => {
      if (after[b] === a) {
        after[b] = -1;
        if (before[a] === b) before[a] = -1;
        return;
      }
      after[a] = b; before[b] = a;
      open[end++] = a; open[end++] = b; open[end++] = o;
    };
    const add = (a, b, c) => {
      corners[told++] = a; corners[told++] = b; corners[told++] = c;
      edge(a, b, c); edge(b, c, a); edge(c, a, b);
    };
    while (told < cells) {
      if (first === end) {
        first = end = 0;
        const patch = [0, 1, 2].map(() => (steps[from.steps++] === 1 ? fresh(n - 1, n - 1, n - 1) : named()));
        add(...patch);
        continue;
      }
      const u = open[first++], w = open[first++], o = open[first++];
      if (after[u] !== w) continue;
      const step = steps[from.steps++];
      if (step !== 0) add(w, u, step === 1 ? fresh(u, w, o) : step === 2 ? after[w] : step === 3 ? before[u] : named());
    }
    return { x: metres(q), p, cells: corners };
  }
  function outline(points, cells, from) {
    const q = [0, 1, 2].map(() => new Int32Array(points)), corners = new Uint32Array(cells);
    for (let i = 0; i < points; ++i, ++from.places) for (let k = 0; k < 3; ++k) q[k][i] = (i ? q[k][i - 1] : 0) + unfolded(places[k][from.places]);
    for (let i = 0; i < cells; ++i) corners[i] = (i ? corners[i - 1] : 0) + unfolded(segments[from.segments++]);
    return { x: metres(q), cells: corners };
  }

  const from = { steps: 0, references: 0, places: 0, segments: 0, water: 0 };
  const bodies = info.bodies.map(({ points, cells }) => (plane ? outline(points, cells, from) : triangles(points, cells, from, false)));
  const begins = [];
  let felt = info.bodies.map(({ points }) => new Uint8Array(points)), hull = 0, bend = 0;
  const ways = info.bodies.map(({ points, bends: bent }) => (bent ? new Int32Array(3 * points) : null));
  const shape = ({ x }, way) => {
    if (!way) return x;
    for (let i = 0; i < way.length; i += 3, ++bend) for (let k = 0; k < 3; ++k) way[i + k] += unfolded(bends[k][bend]);
    return x.map((at, i) => at + info.step * way[i]);
  };
  const frames = info.frames.map((frame) => {
    begins.push({ ...from });
    from.steps += frame.steps; from.references += frame.references; from.places += frame.points;
    if (plane) from.water += frame.points;
    felt = felt.map((last) => last.map((v) => v + hulls[hull++]));
    return { time: frame.time, poses: frame.poses, pressures: felt, shapes: bodies.map((body, b) => shape(body, ways[b])) };
  });
  begins.push(from);
  const known = [];
  function unpacked_water(f) {
    const at = { ...begins[f] }, part = triangles(info.frames[f].points, info.frames[f].cells, at, plane);
    if (Object.keys(at).some((array) => at[array] !== begins[f + 1][array])) throw new Error('frame ' + f + ' of the replay is damaged');
    return part;
  }
  return { bodies, frames, water: (f) => (known[f] = known[f] || unpacked_water(f)) };
}
