// Two runs of a study side by side, from what pairs.cpp packed. Curves are drawn by charts.js (event 'splashdown:draw').
(async function () {
  'use strict';
  if (typeof DecompressionStream === 'undefined') return;
  const bytes = document.getElementById('pairs-bytes'), section = document.getElementById('pairs');
  const packed = Uint8Array.from(atob(bytes.textContent.trim()), (c) => c.charCodeAt(0));
  const data = JSON.parse(await new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'))).text());
  const colours = ['--c-blue', '--c-red'], selects = [...section.querySelectorAll('select')], grid = section.querySelector('.grid');
  const boxes = [...document.querySelectorAll('.pick input')], by_name = new Map(data.runs.map((run) => [run.name, run]));
  const number = (value) => (value === null || value === undefined ? '–' : String(+value.toPrecision(4)).replace('-', '−'));
  function cell(row, tag, text) { const e = document.createElement(tag); e.textContent = text; row.appendChild(e); return e; }

  selects.forEach((select, k) => {
    for (const run of data.runs) select.add(new Option(run.name, run.name));
    select.previousElementSibling.style.background = 'var(' + colours[k] + ')';
    select.addEventListener('change', show);
  });
  const with_curves = data.runs.filter((run) => Object.keys(run.curves).length), first = with_curves.length > 1 ? with_curves : data.runs;
  selects[0].value = first[0].name;
  selects[1].value = first[first.length - 1].name;

  // Boxes in the table of runs: the one ticked last goes to the second place, the one before to the first.
  let picked = [];
  for (const box of boxes) {
    box.parentElement.hidden = false;
    box.addEventListener('change', () => {
      picked = picked.filter((other) => other !== box);
      if (box.checked) picked.push(box);
      while (picked.length > 2) picked.shift().checked = false;
      if (picked.length < 2) return;
      selects.forEach((select, k) => { select.value = picked[k].dataset.run; });
      show();
      section.scrollIntoView({ behavior: 'smooth' });
    });
  }

  function row_of(body, label, values, difference) {
    const row = body.insertRow();
    cell(row, 'td', label);
    values.forEach((value) => cell(row, 'td', value));
    cell(row, 'td', difference);
  }
  function table(a, b) {
    const head = section.querySelector('thead'), body = section.querySelector('tbody');
    head.textContent = body.textContent = '';
    const row = head.insertRow();
    cell(row, 'th', '');
    for (const run of [a, b]) {
      const name = cell(row, 'th', run.link ? '' : run.name);
      if (run.link) { const link = cell(name, 'a', run.name); link.href = run.link; }
    }
    cell(row, 'th', 'second to first');
    data.axes.forEach((label, k) => { if (a.axes[k] !== b.axes[k]) row_of(body, label, [a.axes[k], b.axes[k]], ''); });
    row_of(body, 'status', [a.status, b.status], '');
    row_of(body, 'verdict', [a.verdict || '–', b.verdict || '–'], '');
    for (const [name, label] of data.columns) {
      const x = a.numbers[name], y = b.numbers[name], both = typeof x === 'number' && typeof y === 'number';
      if (x === undefined && y === undefined) continue;
      row_of(body, label, [number(x), number(y)], both && x !== 0 ? (y >= x ? '+' : '−') + Math.abs(100 * (y - x) / x).toPrecision(3) + ' %' : '');
    }
  }

  // An axis with a margin around all values of both.
  function range_of(curves) {
    const values = curves.flatMap((curve) => curve.y).filter((v) => v !== null), low = Math.min(...values), high = Math.max(...values);
    const margin = high > low ? 0.07 * (high - low) : Math.abs(low) || 1;
    return [low - margin, high + margin];
  }
  function charts(a, b) {
    grid.textContent = '';
    data.curves.forEach(({ x, y }, k) => {
      const curves = [a, b].map((run, i) => run.curves[k] && { label: run.name, colour: colours[i], width: i ? 1.4 : 2.2, x: run.curves[k][0], y: run.curves[k][1] }).filter(Boolean);
      if (!curves.some((curve) => curve.y.some((v) => v !== null))) return;
      const figure = document.createElement('figure');
      figure.className = 'chart';
      cell(figure, 'div', '').className = 'live';
      cell(figure, 'figcaption', y.split(' / ')[0]);
      grid.appendChild(figure);
      document.dispatchEvent(new CustomEvent('splashdown:draw', { detail: { figure, chart: { name: 'pair_' + k, x, y, y2: '', time: false, range: range_of(curves), range2: null, curves } } }));
    });
  }
  function show() {
    const [a, b] = selects.map((select) => by_name.get(select.value));
    for (const box of boxes) box.checked = box.dataset.run === a.name || box.dataset.run === b.name;
    picked = [a, b].map((run) => boxes.find((box) => box.dataset.run === run.name)).filter((box, k, all) => box && all.indexOf(box) === k);
    table(a, b);
    if (bytes.dataset.charts === 'yes') charts(a, b);
    section.dataset.pair = a.name + ' ' + b.name;
  }
  section.hidden = false;
  while (bytes.dataset.charts === 'yes' && document.documentElement.dataset.charts !== 'ready') await new Promise((done) => setTimeout(done, 30));
  show();
})();
