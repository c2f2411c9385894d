// The replay of a page: unpacks three.js and the frames, and lets a reader play, scrub, turn. In a film, `info.film`, a program does.
(async function () {
  'use strict';
  const holder = document.getElementById('replay'), pick = (what) => holder.querySelector(what);
  const note = pick('.state');
  const fail = (why) => { note.textContent = why; note.hidden = false; holder.dataset.ready = 'failed'; };
  if (typeof DecompressionStream === 'undefined') return fail('This browser is too old to unpack the replay: it needs Compression Streams (2023).');
  const unpacked = (id) => {
    const packed = Uint8Array.from(atob(document.getElementById(id).textContent.trim()), (c) => c.charCodeAt(0));
    return new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate')));
  };
  const info = JSON.parse(document.getElementById('replay-info').textContent), film = info.film;
  const library = document.createElement('script');
  library.textContent = await unpacked('replay-library').text();
  document.head.appendChild(library);
  const plane = info.dimension === 2;
  // Hulls in space, over blue water: grey where they are dry, then from pale to dark (after Brewer's YlOrRd). The plane has the colours of the pictures.
  const of_hulls = [[0, 221, 226, 230], [0.03, 246, 232, 200], [0.15, 254, 217, 118], [0.35, 254, 178, 76], [0.55, 253, 141, 60], [0.75, 227, 26, 28], [1, 128, 0, 38]];
  const colours = plane ? info.colours : of_hulls;
  const dark = !film && window.matchMedia('(prefers-color-scheme: dark)').matches;
  let stage, frames;
  try {
    const picture = splashdown_unpack(info, await unpacked('replay-bytes').arrayBuffer());
    frames = picture.frames;
    stage = splashdown_stage(info, picture, colours, dark);
  } catch (error) { return fail('This browser cannot show the replay: ' + error.message); }
  const view = pick('.view'), clock = pick('.clock'), stamp = pick('.stamp'), slider = pick('input[type=range]'), button = pick('button');
  const so_far = pick('.so-far'), mesh = pick('.mesh'), follow = pick('.follow'), views = pick('.from');
  view.prepend(stage.element);

  const end = frames[frames.length - 1].time, scale = end < 1 ? [1e3, 1, 'ms'] : [1, 3, 's'];
  const time_text = (t) => (scale[0] * t).toFixed(scale[1]) + ' ' + scale[2];
  // The key: three or more round pressures, the first zero.
  function key() {
    if (!(info.pressure > 0)) return;
    const [factor, unit] = info.pressure >= 1e6 ? [1e6, 'MPa'] : info.pressure >= 1e3 ? [1e3, 'kPa'] : [1, 'Pa'];
    const most = info.pressure / factor, power = 10 ** Math.floor(Math.log10(most / 2)), step = [5, 2, 1].map((n) => n * power).find((s) => most / s >= 2) || power;
    const bar = colours.map(([at, ...c]) => `rgb(${c}) ${100 * at}%`).join(',');
    pick('.key .bar').style.background = `linear-gradient(to right,${bar})`;
    pick('.key .bar').classList.toggle('open', info.above);
    const ticks = pick('.key .ticks');
    for (let n = 0; n * step <= most; ++n) {
      const tick = document.createElement('span');
      tick.textContent = String(+(n * step).toPrecision(6));
      tick.style.left = 100 * n * step / most + '%';
      ticks.append(tick);
    }
    pick('.key .what').textContent = (so_far.checked ? 'highest pressure so far' : plane ? 'pressure' : 'pressure on the hull') + ' / ' + unit;
    pick('.key').hidden = false;
  }
  let now = 0;
  // Curves point at the same time: they follow the replay, and it follows them.
  function show(f, told) {
    now = f;
    stage.state.so_far = so_far.checked;
    stage.mesh.visible = mesh.checked;
    stage.show(f);
    clock.textContent = time_text(frames[f].time);
    stamp.textContent = 't = ' + time_text(frames[f].time);
    slider.value = f;
    holder.dataset.frame = f;
    if (!told) document.dispatchEvent(new CustomEvent('splashdown:time', { detail: { time: frames[f].time, from: 'replay' } }));
  }
  function resize() {
    if (film) stage.resize(window.innerWidth, window.innerHeight);
    else stage.resize(view.clientWidth, Math.round(Math.min(0.62 * view.clientWidth, 560)));
  }
  let timer = 0;
  const seconds = 5;  // for all
  function play() {
    if (timer) { clearInterval(timer); timer = 0; button.textContent = 'Play'; return; }
    if (now === frames.length - 1) show(0);
    button.textContent = 'Pause';
    timer = setInterval(() => { if (now === frames.length - 1) play(); else show(now + 1); }, 1e3 * seconds / frames.length);
  }
  const look = () => {
    stage.state.view = views.value.split(',').map(Number);
    stage.state.follow = follow.checked;
    stage.aim();
  };
  slider.max = frames.length - 1;
  button.addEventListener('click', play);
  slider.addEventListener('input', () => show(+slider.value));
  so_far.addEventListener('change', () => { pick('.key .ticks').textContent = ''; key(); show(now); });
  mesh.addEventListener('change', () => show(now));
  follow.addEventListener('change', look);
  views.addEventListener('change', look);
  document.addEventListener('splashdown:time', ({ detail }) => {
    if (detail.from === 'replay') return;
    let nearest = 0;
    frames.forEach((frame, f) => { if (Math.abs(frame.time - detail.time) < Math.abs(frames[nearest].time - detail.time)) nearest = f; });
    if (nearest !== now) show(nearest, true);
  });
  window.addEventListener('resize', resize);
  if (film) {
    so_far.checked = film.so_far; mesh.checked = film.mesh; follow.checked = film.follow;
    Object.assign(stage.state, { view: film.view, zoom: film.zoom, follow: film.follow });
  }
  key();
  const length_text = (metres) => +(metres < 0.1 ? 1e3 * metres : metres).toPrecision(3) + (metres < 0.1 ? ' mm' : ' m');
  const ruler = pick('.ruler');
  if (plane) stage.on_drawn((length, pixels) => { ruler.textContent = length_text(length); ruler.style.width = pixels + 'px'; });
  else ruler.textContent = 'grid: ' + length_text(stage.spacing);
  ruler.classList.toggle('bar', plane);
  stage.paint(dark ? 0x18222c : plane ? 0xf6f9fb : 0xeaf1f6);
  resize();
  stage.state.frame = Math.floor((frames.length - 1) / 2);
  if (film) stage.aim(); else look();
  show(stage.state.frame);
  if (film) window.splashdown_show = show;
  holder.dataset.ready = 'yes';
})();
