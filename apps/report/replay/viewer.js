// Plays what moving_picture.cpp packed. Expects three.js (global THREE, r111) and its OrbitControls.
(async function () {
  'use strict';
  const holder = document.getElementById('replay');
  const note = holder.querySelector('.state');
  const fail = (why) => { note.textContent = why; note.hidden = false; };
  if (typeof DecompressionStream === 'undefined') return fail('This browser is too old to unpack the replay: it needs Compression Streams (2023).');
  const info = JSON.parse(document.getElementById('replay-info').textContent);
  const packed = Uint8Array.from(atob(document.getElementById('replay-bytes').textContent.trim()), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  const bytes = new DataView(await new Response(stream).arrayBuffer());

  // Parts of a frame: places [m], pressures 0 to 1, cells.
  let at = 0;
  const step = info.low.map((low, k) => (info.high[k] - low) / 65535);
  // Differences, byte by byte.
  function numbers(Kind, n) {
    const out = new Kind(n), size = Kind.BYTES_PER_ELEMENT;
    for (let b = 0; b < size; ++b) for (let i = 0; i < n; ++i) out[i] += bytes.getUint8(at++) * 2 ** (8 * b);
    for (let i = 1; i < n; ++i) out[i] += out[i - 1];
    return out;
  }
  function part(entry) {
    const n = entry.points, x = new Float32Array(3 * n);
    for (let k = 0; k < 3; ++k) numbers(Uint16Array, n).forEach((v, i) => { x[3 * i + k] = info.low[k] + step[k] * v; });
    const p = Float32Array.from(numbers(Uint8Array, n), (v) => v / 255);
    return { x, p, cells: numbers(Uint32Array, entry.cells) };
  }
  const frames = info.frames.map((f) => ({ time: f.time, water: part(f.water), bodies: f.bodies.map(part) }));
  const plane = info.dimension === 2;

  // Viridis, nine colours (van der Walt and Smith 2015).
  const viridis = [[68, 1, 84], [71, 44, 122], [59, 81, 139], [44, 113, 142], [33, 144, 141], [39, 173, 129], [92, 200, 99], [170, 220, 50], [253, 231, 37]];
  // As a texture that pressures look up: colours that are mixed between the corners of large triangles are none of the scale's.
  const texels = new Uint8Array(3 * 256);
  for (let i = 0; i < 256; ++i) {
    const s = 8 * i / 255, k = Math.min(7, Math.floor(s));
    for (let c = 0; c < 3; ++c) texels[3 * i + c] = Math.round((1 - s + k) * viridis[k][c] + (s - k) * viridis[k + 1][c]);
  }
  const scale = new THREE.DataTexture(texels, 256, 1, THREE.RGBFormat);
  scale.magFilter = scale.minFilter = THREE.LinearFilter;
  scale.needsUpdate = true;
  function lookUp(geometry, p) {
    const uv = new Float32Array(2 * p.length).fill(0.5);
    p.forEach((v, i) => { uv[2 * i] = (0.5 + 255 * v) / 256; });
    geometry.setAttribute('uv', new THREE.BufferAttribute(uv, 2));
  }
  // What each point of a hull has felt so far.
  const most = info.names.map((_, b) => frames.map((frame) => frame.bodies[b].p));
  for (const of of most) for (let f = 1; f < of.length; ++f) of[f] = of[f].map((v, i) => Math.max(v, of[f - 1][i] || 0));

  const view = holder.querySelector('.view');
  let renderer;
  try { renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true }); } catch (e) { return fail('This browser shows no WebGL: ' + e.message); }
  view.appendChild(renderer.domElement);
  const scene = new THREE.Scene();
  const dark = window.matchMedia('(prefers-color-scheme: dark)');
  const paint = () => { scene.background = new THREE.Color(dark.matches ? 0x18222c : 0xf6f9fb); draw(); };
  scene.add(new THREE.HemisphereLight(0xffffff, 0x8899aa, 0.9));
  const sun = new THREE.DirectionalLight(0xffffff, 0.5);
  sun.position.set(1, -1, 2);
  scene.add(sun);

  // The bodies on their way, with room around them: a tank is larger than what happens in it.
  const box = new THREE.Box3(), all = new THREE.Box3(new THREE.Vector3(...info.low), new THREE.Vector3(...info.high));
  const point = new THREE.Vector3();
  for (const f of frames) for (const b of f.bodies) for (let i = 0; i < b.x.length; i += 3) box.expandByPoint(point.set(b.x[i], b.x[i + 1], b.x[i + 2]));
  if (box.isEmpty()) box.copy(all);
  const size = box.getSize(new THREE.Vector3()), middle = box.getCenter(new THREE.Vector3());
  const reach = Math.max(size.x, size.y, size.z);
  const up = plane ? new THREE.Vector3(0, 1, 0) : new THREE.Vector3(0, 0, 1);
  const camera = plane ? new THREE.OrthographicCamera(-1, 1, 1, -1, -10 * reach, 10 * reach) : new THREE.PerspectiveCamera(35, 1, 0.01 * reach, 100 * reach);
  camera.up.copy(up);
  camera.position.copy(middle).add(plane ? new THREE.Vector3(0, 0, reach) : new THREE.Vector3(-1, -1.7, 0.55).multiplyScalar(1.2 * reach));
  const controls = new THREE.OrbitControls(camera, renderer.domElement);
  controls.target.copy(middle);
  controls.enableRotate = !plane;
  if (plane) controls.mouseButtons = { LEFT: THREE.MOUSE.PAN, MIDDLE: THREE.MOUSE.DOLLY, RIGHT: THREE.MOUSE.PAN };

  const water = new THREE.Mesh(new THREE.BufferGeometry(), plane ? new THREE.MeshBasicMaterial({ map: scale, side: THREE.DoubleSide })
    : new THREE.MeshPhongMaterial({ color: 0x3f8fd0, transparent: true, opacity: 0.45, side: THREE.DoubleSide, shininess: 60, depthWrite: false }));
  const mesh = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color: 0x000000, transparent: true, opacity: 0.16 }));
  scene.add(water, mesh);
  mesh.visible = false;
  const bodies = info.names.map((_, b) => {
    const geometry = new THREE.BufferGeometry(), first = frames[0].bodies[b];
    geometry.setIndex(new THREE.BufferAttribute(first.cells, 1));
    const body = plane ? new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ color: dark.matches ? 0xffffff : 0x17222d }))
      : new THREE.Mesh(geometry, new THREE.MeshLambertMaterial({ map: scale, side: THREE.DoubleSide }));
    scene.add(body);
    return body;
  });

  const clock = holder.querySelector('.clock'), slider = holder.querySelector('input[type=range]'), button = holder.querySelector('button');
  const so_far = holder.querySelector('.so-far'), lines = holder.querySelector('.mesh');
  slider.max = frames.length - 1;
  let now = 0;
  const milli = frames[frames.length - 1].time < 1;
  function set(geometry, name, values) { geometry.setAttribute(name, new THREE.BufferAttribute(values, 3)); }
  // Curves point at the same time: they follow the replay, and it follows them.
  function show(f, told) {
    now = f;
    const frame = frames[f];
    water.geometry.dispose();
    water.geometry = new THREE.BufferGeometry();
    set(water.geometry, 'position', frame.water.x);
    water.geometry.setIndex(new THREE.BufferAttribute(frame.water.cells, 1));
    if (plane) lookUp(water.geometry, frame.water.p); else water.geometry.computeVertexNormals();
    if (mesh.visible) { mesh.geometry.dispose(); mesh.geometry = new THREE.WireframeGeometry(water.geometry); }
    bodies.forEach((body, b) => {
      set(body.geometry, 'position', frame.bodies[b].x);
      if (!plane) { lookUp(body.geometry, so_far.checked ? most[b][f] : frame.bodies[b].p); body.geometry.computeVertexNormals(); }
      body.geometry.computeBoundingSphere();
    });
    clock.textContent = milli ? (1e3 * frame.time).toFixed(1) + ' ms' : frame.time.toFixed(2) + ' s';
    slider.value = f;
    holder.dataset.frame = f;
    if (!told) document.dispatchEvent(new CustomEvent('splashdown:time', { detail: { time: frame.time, from: 'replay' } }));
    draw();
  }
  function draw() { renderer.render(scene, camera); }
  function resize() {
    const width = view.clientWidth, height = Math.round(Math.min(0.62 * width, 560));
    renderer.setPixelRatio(Math.min(2, window.devicePixelRatio || 1));
    renderer.setSize(width, height);
    if (plane) {
      const half = 0.75 * Math.max(size.y + 0.4 * reach, (size.x + 0.8 * reach) * height / width);
      camera.top = half; camera.bottom = -half; camera.right = half * width / height; camera.left = -camera.right;
    } else camera.aspect = width / height;
    camera.updateProjectionMatrix();
    draw();
  }
  let timer = 0;
  const seconds = 5;  // for all
  function play() {
    if (timer) { clearInterval(timer); timer = 0; button.textContent = 'Play'; return; }
    if (now === frames.length - 1) show(0);
    button.textContent = 'Pause';
    timer = setInterval(() => { if (now === frames.length - 1) play(); else show(now + 1); }, 1e3 * seconds / frames.length);
  }
  button.addEventListener('click', play);
  slider.addEventListener('input', () => show(+slider.value));
  so_far.addEventListener('change', () => show(now));
  lines.addEventListener('change', () => { mesh.visible = lines.checked; show(now); });
  document.addEventListener('splashdown:time', ({ detail }) => {
    if (detail.from === 'replay') return;
    let nearest = 0;
    frames.forEach((frame, f) => { if (Math.abs(frame.time - detail.time) < Math.abs(frames[nearest].time - detail.time)) nearest = f; });
    if (nearest !== now) show(nearest, true);
  });
  controls.addEventListener('change', draw);
  window.addEventListener('resize', resize);
  dark.addListener(paint);
  resize();
  controls.update();
  paint();
  show(Math.floor((frames.length - 1) / 2));
  holder.dataset.ready = 'yes';
})();
