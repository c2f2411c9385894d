// What is seen of frames: water, hulls and camera in three.js (global THREE, r111). `picture` is of unpack.js, `colours` are stops
// [at, red, green, blue] of the pressure.
function splashdown_stage(info, picture, colours, dark) {
  'use strict';
  const plane = info.dimension === 2, frames = picture.frames;
  const renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
  const scene = new THREE.Scene();
  // From above, and from where the reader stands: colours are to be read from any side.
  scene.add(new THREE.HemisphereLight(0xffffff, 0xc8d0d7, 0.5));
  const sun = new THREE.DirectionalLight(0xffffff, 0.22), lamp = new THREE.DirectionalLight(0xffffff, 0.3);
  sun.position.set(0.4, -0.8, 1.6);
  scene.add(sun);

  // Pressures look their colour up in a texture: colours that are mixed between the corners of large triangles are none of the scale's.
  const texels = new Uint8Array(3 * 256);
  for (let i = 0; i < 256; ++i) {
    const s = i / 255, k = Math.max(1, colours.findIndex(([at]) => at >= s)), [low, ...a] = colours[k - 1], [high, ...b] = colours[k];
    for (let c = 0; c < 3; ++c) texels[3 * i + c] = Math.round(a[c] + (b[c] - a[c]) * (s - low) / (high - low));
  }
  const scale = new THREE.DataTexture(texels, 256, 1, THREE.RGBFormat);
  scale.magFilter = scale.minFilter = THREE.LinearFilter;
  scale.needsUpdate = true;
  const look_up = (geometry, count, pressure) => {
    const uv = new Float32Array(2 * count).fill(0.5);
    for (let i = 0; i < count; ++i) uv[2 * i] = (0.5 + pressure(i)) / 256;
    geometry.setAttribute('uv', new THREE.BufferAttribute(uv, 2));
  };
  const set = (geometry, name, values) => geometry.setAttribute(name, new THREE.BufferAttribute(values, 3));

  // Corners of a hull in space have normals of their own: its edges are sharp where facets meet at more than this, as for separation.
  const sharp = Math.cos(30 * Math.PI / 180);
  function normals(x, cells) {
    const facet = new Float32Array(cells.length), at = Array.from({ length: x.length / 3 }, () => []), out = new Float32Array(3 * cells.length);
    const [a, b, c] = [0, 1, 2].map(() => new THREE.Vector3());
    for (let t = 0; t < cells.length; t += 3) {
      [a, b, c].forEach((v, k) => v.fromArray(x, 3 * cells[t + k]));
      b.sub(a).cross(c.sub(a)).toArray(facet, t);  // as long as the facet is large
      for (let k = 0; k < 3; ++k) at[cells[t + k]].push(t);
    }
    for (let i = 0; i < cells.length; ++i) {
      a.fromArray(facet, i - i % 3);
      const size = a.length();
      c.set(0, 0, 0);
      for (const t of at[cells[i]]) if (a.dot(b.fromArray(facet, t)) >= sharp * size * b.length()) c.add(b);
      c.normalize().toArray(out, 3 * i);
    }
    return out;
  }
  // Outlines in the plane, closed or not: loops of points.
  function loops({ cells }) {
    const after = new Map(), found = [];
    for (let i = 0; i < cells.length; i += 2) after.set(cells[i], cells[i + 1]);
    while (after.size) {
      const loop = [];
      for (let i = after.keys().next().value; after.has(i);) { loop.push(i); const next = after.get(i); after.delete(i); i = next; }
      found.push(loop);
    }
    return found;
  }
  const ink = dark ? 0xe8eef3 : 0x17222d;
  const filled = (body, x) => new THREE.ShapeBufferGeometry(loops(body).filter((loop) => loop.length > 2).map((loop) => new THREE.Shape(loop.map((i) => new THREE.Vector2(x[3 * i], x[3 * i + 1])))));
  const corners = (body, x) => {
    const all = new Float32Array(3 * body.cells.length);
    body.cells.forEach((point, i) => { for (let k = 0; k < 3; ++k) all[3 * i + k] = x[3 * point + k]; });
    return all;
  };
  const bodies = picture.bodies.map((body) => {
    const geometry = new THREE.BufferGeometry();
    if (plane) {
      set(geometry, 'position', body.x);
      geometry.setIndex(new THREE.BufferAttribute(body.cells, 1));
      const lines = new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ color: ink }));
      lines.add(new THREE.Mesh(filled(body, body.x), new THREE.MeshBasicMaterial({ color: dark ? 0x51606e : 0xc3ccd4, side: THREE.DoubleSide })));
      lines.renderOrder = 3;
      return lines;
    }
    set(geometry, 'position', corners(body, body.x));
    set(geometry, 'normal', normals(body.x, body.cells));
    return new THREE.Mesh(geometry, new THREE.MeshPhongMaterial({ map: scale, emissive: 0xffffff, emissiveMap: scale, emissiveIntensity: 0.14, side: THREE.DoubleSide, shininess: 25, specular: 0x1a1a1a }));
  });
  bodies.forEach((body) => scene.add(body));
  function bend(body, told, x) {
    set(body.geometry, 'position', plane ? x : corners(told, x));
    body.geometry.computeBoundingSphere();
    if (!plane) { set(body.geometry, 'normal', normals(x, told.cells)); return; }
    const inside = body.children[0];
    inside.geometry.dispose();
    inside.geometry = filled(told, x);
  }

  // Where bodies are: boxes around them.
  const point = new THREE.Vector3(), turn = new THREE.Quaternion(), matrix = new THREE.Matrix4(), one = new THREE.Vector3(1, 1, 1);
  const pose = (f, b) => { const [x, y, z, ...q] = frames[f].poses[b]; return matrix.compose(point.set(x, y, z), turn.set(...q), one); };
  function box_of(f, b, box) {
    const motion = pose(f, b).clone(), x = frames[f].shapes[b];
    for (let i = 0; i < x.length; i += 3) box.expandByPoint(point.fromArray(x, i).applyMatrix4(motion));
    // The mirror image of a body that stands aside.
    if (info.mirror && box.max.getComponent(info.mirror.axis) > info.mirror.at) {
      const { axis, at } = info.mirror, beyond = box.max.getComponent(axis);
      box.min.setComponent(axis, Math.min(box.min.getComponent(axis), 2 * at - beyond));
    }
    return box;
  }
  const boxes = bodies.length ? frames.map((_, f) => box_of(f, 0, new THREE.Box3())) : [];
  const path = new THREE.Box3();
  frames.forEach((_, f) => bodies.forEach((_, b) => box_of(f, b, path)));
  if (path.isEmpty()) frames.forEach((_, f) => { const { x } = picture.water(f); for (let i = 0; i < x.length; i += 3) path.expandByPoint(point.fromArray(x, i)); });
  const reach = Math.max(...path.getSize(new THREE.Vector3()).toArray());

  // A grid on the water, and what it is worth: how large is it, and how fast? Its lines lie on round coordinates.
  const round = (length) => { const power = 10 ** Math.floor(Math.log10(length)); return [5, 2, 1].map((n) => n * power).find((n) => n <= length * (1 + 1e-9)); };
  const spacing = round(0.3 * reach), squares = document.createElement('canvas'), side = 256;
  squares.width = squares.height = side;
  const ink_of_grid = squares.getContext('2d');
  ink_of_grid.fillStyle = '#fff';
  ink_of_grid.fillRect(0, 0, side, side);
  ink_of_grid.fillStyle = '#c3d3df';
  for (const [w, h] of [[side, 2], [2, side]]) for (const from of [0, side - 2]) ink_of_grid.fillRect(w === 2 ? from : 0, h === 2 ? from : 0, w, h);
  const grid = new THREE.CanvasTexture(squares);
  grid.wrapS = grid.wrapT = THREE.RepeatWrapping;
  grid.anisotropy = renderer.capabilities.getMaxAnisotropy();
  const lie_on_grid = (geometry, x) => geometry.setAttribute('uv', new THREE.BufferAttribute(Float32Array.from({ length: x.length / 3 * 2 }, (_, i) => x[3 * (i >> 1) + i % 2] / spacing), 2));

  // Water in space: the nearest surface alone is blended over the hulls, so that it looks the same whichever triangle comes first.
  const water = new THREE.Group();
  const material = plane ? new THREE.MeshBasicMaterial({ map: scale, side: THREE.DoubleSide })
    : new THREE.MeshPhongMaterial({ vertexColors: THREE.VertexColors, map: grid, transparent: true, opacity: 0.78, side: THREE.DoubleSide, shininess: 30, specular: 0x1c262e });
  const front = new THREE.Mesh(new THREE.BufferGeometry(), new THREE.MeshBasicMaterial({ colorWrite: false, transparent: true, side: THREE.DoubleSide }));
  const surface = new THREE.Mesh(new THREE.BufferGeometry(), material);
  front.renderOrder = 1;
  surface.renderOrder = 2;
  if (!plane) water.add(front);
  water.add(surface);
  const mesh = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color: 0x000000, transparent: true, opacity: 0.16 }));
  const edge = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color: dark ? 0xa9d3ea : 0x32567a }));
  mesh.visible = false;
  mesh.renderOrder = edge.renderOrder = 3;
  scene.add(water, mesh);
  if (plane) scene.add(edge);

  // Of a scene of which one half was simulated the other one is its mirror image. Hulls are whole, with the pressures of one half.
  const twins = [], other = new THREE.Group();
  if (info.mirror) {
    const { axis, at } = info.mirror, normal = new THREE.Vector3().setComponent(axis, 1);
    const sides = [new THREE.Plane(normal, -at), new THREE.Plane(normal.clone().negate(), at)];
    other.scale.setComponent(axis, -1);
    other.position.setComponent(axis, 2 * at);
    renderer.localClippingEnabled = true;
    for (const part of [front, surface, mesh, edge].filter((part) => part.parent).concat(plane ? [] : bodies)) {
      const twin = part.clone();
      if (bodies.includes(part)) {
        twin.material = part.material.clone();
        [part, twin].forEach((half, side) => { half.material.clippingPlanes = [sides[side]]; });
      }
      twins.push([part, twin]);
      other.add(twin);
    }
    scene.add(other);
  }
  function match_twins() {
    for (const [part, twin] of twins) {
      twin.geometry = part.geometry;
      twin.visible = part.visible;
      twin.matrixAutoUpdate = part.matrixAutoUpdate;
      twin.matrix.copy(part.matrix);
    }
  }

  // Height over still water, told by colour: troughs dark, crests pale.
  const heights = (f) => picture.water(f).x.filter((_, i) => i % 3 === 2).sort();
  let level = 0, swell = 1;
  if (!plane) {
    const first = heights(0);
    level = first.length ? first[first.length >> 1] : 0;
    const all = [0, frames.length >> 1, frames.length - 1].flatMap((f) => Array.from(heights(f), (z) => Math.abs(z - level))).sort((a, b) => a - b);
    swell = Math.max(all[Math.floor(0.98 * (all.length - 1))] || 0, 1e-9);
  }
  const trough = [0.02, 0.16, 0.36], still = [0.12, 0.42, 0.66], crest = [0.84, 0.93, 0.98];
  function tint({ x }) {
    const colour = new Float32Array(x.length);
    for (let i = 0; i < x.length; i += 3) {
      const s = Math.max(-1, Math.min(1, (x[i + 2] - level) / swell)), to = s < 0 ? trough : crest;
      for (let c = 0; c < 3; ++c) colour[i + c] = still[c] + Math.abs(s) * (to[c] - still[c]);
    }
    return colour;
  }
  // Edges of one triangle alone.
  function border({ x, cells }) {
    const once = new Map(), count = x.length / 3;
    for (let i = 0; i < cells.length; ++i) {
      const a = cells[i], b = cells[i % 3 === 2 ? i - 2 : i + 1], key = Math.min(a, b) * count + Math.max(a, b);
      if (!once.delete(key)) once.set(key, [a, b]);
    }
    const lines = new Float32Array(6 * once.size);
    let at = 0;
    for (const pair of once.values()) for (const i of pair) for (let k = 0; k < 3; ++k) lines[at++] = x[3 * i + k];
    return lines;
  }

  const camera = plane ? new THREE.OrthographicCamera(-1, 1, 1, -1, -10 * reach, 10 * reach) : new THREE.PerspectiveCamera(30, 1, 0.02 * reach, 60 * reach);
  camera.add(lamp);
  scene.add(camera);
  camera.up.set(0, plane ? 1 : 0, plane ? 0 : 1);
  const controls = new THREE.OrbitControls(camera, renderer.domElement);
  controls.enableRotate = !plane;
  if (plane) controls.mouseButtons = { LEFT: THREE.MOUSE.PAN, MIDDLE: THREE.MOUSE.DOLLY, RIGHT: THREE.MOUSE.PAN };
  const state = { frame: 0, so_far: false, follow: false, view: [-55, 16], zoom: 1, aspect: 1 };
  const followed = () => state.follow && boxes.length > 0;
  const centre = (f) => boxes[f].getCenter(new THREE.Vector3());

  // All of the path, or of the first body's largest box, within the picture, with room around.
  function aim() {
    const box = followed() ? boxes[state.frame].clone() : path.clone();
    if (followed()) {
      const half = new THREE.Vector3();
      boxes.forEach((other) => half.max(other.getSize(new THREE.Vector3())));
      box.setFromCenterAndSize(centre(state.frame), half);
    }
    const middle = box.getCenter(new THREE.Vector3()), room = plane ? 0.5 : 0.72;
    controls.target.copy(middle);
    if (plane) {
      const size = box.getSize(new THREE.Vector3());
      const half = 0.5 * Math.max(size.y, size.x / state.aspect, 0.3 * reach / state.aspect) / room / state.zoom;
      camera.top = half; camera.bottom = -half; camera.right = half * state.aspect; camera.left = -camera.right;
      camera.position.set(middle.x, middle.y, reach);
    } else {
      const [turned, raised] = state.view.map((degrees) => degrees * Math.PI / 180), tall = Math.tan(camera.fov * Math.PI / 360) * room;
      const out = new THREE.Vector3(Math.cos(turned) * Math.cos(raised), Math.sin(turned) * Math.cos(raised), Math.sin(raised));
      const right = new THREE.Vector3(-Math.sin(turned), Math.cos(turned), 0), up = out.clone().cross(right);
      let distance = 0;
      for (let i = 0; i < 8; ++i) {
        point.set(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z).sub(middle);
        distance = Math.max(distance, point.dot(out) + Math.abs(point.dot(right)) / (tall * state.aspect), point.dot(out) + Math.abs(point.dot(up)) / tall);
      }
      camera.position.copy(middle).addScaledVector(out, distance / state.zoom);
      camera.aspect = state.aspect;
    }
    camera.updateProjectionMatrix();
    controls.update();
  }

  // What each point of a hull has felt so far.
  const most = [];
  function felt(f, b) {
    if (!state.so_far) return frames[f].pressures[b];
    for (let k = most.length; k <= f; ++k) most.push(frames[k].pressures.map((p, i) => p.map((v, j) => Math.max(v, k ? most[k - 1][i][j] : 0))));
    return most[f][b];
  }
  function show(f) {
    if (followed()) {
      const moved = centre(f).sub(centre(state.frame));
      controls.target.add(moved);
      camera.position.add(moved);
    }
    state.frame = f;
    const now = picture.water(f), geometry = new THREE.BufferGeometry();
    surface.geometry.dispose();
    set(geometry, 'position', now.x);
    geometry.setIndex(new THREE.BufferAttribute(now.cells, 1));
    if (plane) {
      look_up(geometry, now.p.length, (i) => now.p[i]);
      edge.geometry.dispose();
      edge.geometry = new THREE.BufferGeometry();
      set(edge.geometry, 'position', border(now));
    } else {
      geometry.computeVertexNormals();
      set(geometry, 'color', tint(now));
      lie_on_grid(geometry, now.x);
    }
    surface.geometry = front.geometry = geometry;
    if (mesh.visible) { mesh.geometry.dispose(); mesh.geometry = new THREE.WireframeGeometry(geometry); }
    bodies.forEach((body, b) => {
      const { cells } = picture.bodies[b], p = felt(f, b);
      if (info.bodies[b].bends) bend(body, picture.bodies[b], frames[f].shapes[b]);
      if (!plane) look_up(body.geometry, cells.length, (i) => p[cells[i]]);
      body.matrixAutoUpdate = false;
      body.matrix.copy(pose(f, b));
    });
    match_twins();
    controls.update();
    draw();
  }
  let drawn = () => {};
  function draw() { renderer.render(scene, camera); drawn(); }
  controls.addEventListener('change', draw);
  return {
    element: renderer.domElement,
    state,
    mesh,
    spacing,
    show,
    // A round length and its pixels in the plane, after each drawing.
    on_drawn: (tell) => {
      drawn = () => {
        const metre = renderer.domElement.clientHeight * camera.zoom / (camera.top - camera.bottom), length = round(0.16 * renderer.domElement.clientWidth / metre);
        tell(length, length * metre);
      };
    },
    aim: () => { aim(); draw(); },
    resize: (width, height) => {
      renderer.setPixelRatio(Math.min(2, window.devicePixelRatio || 1));
      renderer.setSize(width, height);
      // A picture that becomes wider shows more to the sides.
      if (plane) { camera.right = camera.top * width / height; camera.left = -camera.right; }
      state.aspect = camera.aspect = width / height;
      camera.updateProjectionMatrix();
      draw();
    },
    paint: (background) => { scene.background = new THREE.Color(background); draw(); },
  };
}
