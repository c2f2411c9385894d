// Draws the curves that charts.cpp packed in place of their pictures. Expects dygraphs (global Dygraph, 2.2).
//
// Figures over time share their range and a cursor. The cursor's time is told to all by the event 'splashdown:time' [s], which the
// replay sends and follows too. The event 'splashdown:draw' {figure, chart} has one more drawn, in the element's .live.
(async function () {
  'use strict';
  if (typeof DecompressionStream === 'undefined') return;  // pictures stay
  const packed = Uint8Array.from(atob(document.getElementById('charts-bytes').textContent.trim()), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  const data = JSON.parse(await new Response(stream).text());
  const dark = window.matchMedia('(prefers-color-scheme: dark)');
  const colour = (name) => (name.startsWith('--') ? getComputedStyle(document.documentElement).getPropertyValue(name).trim() : name);
  const unit = (label) => { const at = label.indexOf(' / '); return at < 0 ? '' : label.slice(at + 3).replace(/^\((.*)\)$/, '$1'); };
  const plain = (label) => label.replace(/[&<>]/g, (c) => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;' }[c]));  // dygraphs takes labels for HTML
  const text = (value) => (value === null ? '–' : String(+value.toPrecision(4)).replace('-', '−'));
  function made(tag, cls, parent) { const e = document.createElement(tag); e.className = cls; parent.appendChild(e); return e; }

  // Whole decades of a logarithmic axis, as many as have room.
  function decades(low, high, pixels) {
    const from = Math.ceil(Math.log10(low) - 1e-9), to = Math.floor(Math.log10(high) + 1e-9), ticks = [];
    const stride = Math.max(1, Math.ceil((to - from) * 34 / pixels));
    for (let k = from; k <= to; k += stride) ticks.push({ v: 10 ** k, label: Math.abs(k) < 4 ? String(+(10 ** k).toPrecision(1)) : '1e' + String(k).replace('-', '−') });
    if (ticks.length < 3) for (let k = from - 1; k <= to; ++k) for (const v of [2 * 10 ** k, 5 * 10 ** k]) if (v >= low && v <= high) ticks.push({ v, label: text(v) });
    return ticks;
  }

  // Of a curve at x, on the straight line between its points; null outside and in gaps.
  function value_at(curve, x) {
    const n = curve.x.length;
    if (curve.points || !n || x < curve.x[0] || x > curve.x[n - 1]) return null;
    let low = 0, high = n - 1;
    while (high - low > 1) { const middle = (low + high) >> 1; if (curve.x[middle] <= x) low = middle; else high = middle; }
    if (curve.x[high] <= x) low = high;
    if (curve.x[low] === x || curve.steps || n === 1) return curve.y[low];
    if (curve.y[low] === null || curve.y[high] === null) return null;
    return curve.y[low] + (curve.y[high] - curve.y[low]) * (x - curve.x[low]) / (curve.x[high] - curve.x[low]);
  }

  // Rows of all points of all curves: null where a curve has none, nan where it has a gap.
  function rows_of(chart) {
    const at = new Map();  // x -> its rows: more than one where a curve has several points there
    chart.curves.forEach((curve, k) => curve.x.forEach((x, i) => {
      if (!at.has(x)) at.set(x, []);
      let row = at.get(x).find((other) => other[k + 1] === null);
      if (!row) at.get(x).push(row = [x, ...chart.curves.map(() => null)]);
      row[k + 1] = curve.y[i] === null ? NaN : curve.y[i];
    }));
    return [...at.values()].flat().sort((a, b) => a[0] - b[0]);
  }

  // As a table with a column a curve, at all points of all curves.
  function csv_of(chart) {
    const quoted = (cell) => (/[",]/.test(cell) ? '"' + cell.replace(/"/g, '""') + '"' : cell);
    const xs = [...new Set(chart.curves.flatMap((curve) => curve.x))].sort((a, b) => a - b);
    const head = [chart.x, ...chart.curves.map((curve) => (curve.label ? curve.label + ': ' : '') + (curve.right ? chart.y2 : chart.y))];
    const cell = (value) => (value === null ? '' : String(+value.toPrecision(7)));
    return [head.map(quoted), ...xs.map((x) => [x, ...chart.curves.map((curve) => cell(value_at(curve, x)))])].map((row) => row.join(',')).join('\n') + '\n';
  }

  let charts = data.charts.map((chart) => new Chart(chart));
  const differs = (range, all) => !!all && range.some((v, k) => Math.abs(v - all[k]) > 1e-6 * (all[1] - all[0]));
  let linking = false, span = null;  // zoom of all figures over time; null: all
  function zoom_all(from) {
    if (linking || !from.chart.time) return;
    linking = true;
    span = differs(from.graph.xAxisRange(), from.graph.xAxisExtremes()) ? from.graph.xAxisRange() : null;
    for (const other of charts) if (other !== from && other.graph && other.chart.time) other.graph.updateOptions({ dateWindow: span });
    linking = false;
  }

  function Chart(chart, figure) {
    this.chart = chart;
    this.figure = figure || document.querySelector('figure[data-chart="' + chart.name + '"]');
  }
  // Shaded pieces, what lies between theories and limits, behind the curves.
  Chart.prototype.behind = function (context, area, graph) {
    const { chart } = this, across = (x) => graph.toDomXCoord(x), down = (y) => graph.toDomYCoord(y, 0);
    context.save();
    context.beginPath(); context.rect(area.x, area.y, area.w, area.h); context.clip();
    context.font = '12px system-ui,sans-serif';
    for (const [from, to, what] of chart.stretches || []) {
      context.fillStyle = colour('--c-pulse');
      context.fillRect(across(from), area.y, across(to) - across(from), area.h);
      context.fillStyle = colour('--soft');
      context.fillText(what, Math.max(area.x, across(from)) + 4, area.y + area.h - 6);
    }
    for (const band of chart.between || []) {
      context.fillStyle = colour('--c-theory');
      context.beginPath();
      band.x.forEach((x, i) => context.lineTo(across(x), down(band.high[i])));
      for (let i = band.x.length; i-- > 0;) context.lineTo(across(band.x[i]), down(band.low[i]));
      context.fill();
    }
    context.strokeStyle = colour('--c-axis');
    if (!chart.log) { context.beginPath(); context.moveTo(area.x, down(0)); context.lineTo(area.x + area.w, down(0)); context.stroke(); }
    for (const [y, what] of chart.levels || []) {
      context.strokeStyle = context.fillStyle = colour('--c-red');
      context.setLineDash([6, 4]);
      context.beginPath(); context.moveTo(area.x, down(y)); context.lineTo(area.x + area.w, down(y)); context.stroke();
      context.setLineDash([]);
      context.fillText(what, area.x + 6, down(y) - 18 < area.y ? down(y) + 14 : down(y) - 5);
    }
    for (const [x, y, what] of chart.marks || []) {
      context.fillStyle = colour('--ink');
      context.beginPath(); context.arc(across(x), down(y), 3, 0, 7); context.fill();
      const wide = context.measureText(what).width, left = across(x) + 8;
      context.fillText(what, left + wide > area.x + area.w ? across(x) - 8 - wide : left, down(y) - 6);
    }
    context.restore();
  };
  Chart.prototype.look = function () {
    const { chart } = this, series = {};
    chart.curves.forEach((curve, k) => {
      series['c' + k] = { color: colour(curve.colour), strokeWidth: curve.points ? 0 : curve.width, stepPlot: !!curve.steps, axis: curve.right ? 'y2' : 'y1',
        drawPoints: !!(curve.points || curve.links), pointSize: curve.links ? 4 : 1.4 };
    });
    return { series, gridLineColor: colour('--line'), axisLineColor: colour('--c-axis') };
  };
  Chart.prototype.build = function () {
    const { chart } = this, live = this.figure.querySelector('.live');
    this.readout = made('div', 'readout', live);
    this.fields = [made('span', '', this.readout), ...chart.curves.map((curve) => {
      if (!curve.label && chart.curves.length > 1) return null;  // one of several that share a name
      const span = made('span', '', this.readout), square = made('i', '', span);
      square.style.background = 'var(' + curve.colour + ')';
      if (!curve.colour.startsWith('--')) square.style.background = curve.colour;
      span.append(curve.label ? curve.label + ' ' : '');
      return made('b', '', span);
    })];
    for (const band of chart.between || []) { const span = made('span', '', this.readout); made('i', '', span).style.background = 'var(--c-theory)'; span.append(band.text); }
    const plot = made('div', 'plot', live), tools = made('div', 'tools', live);
    live.hidden = false;
    this.figure.classList.add('on');
    this.rows = rows_of(chart);
    const right = chart.curves.some((curve) => curve.right);
    this.graph = new Dygraph(plot, this.rows, Object.assign({
      labels: ['x', ...chart.curves.map((_, k) => 'c' + k)], legend: 'never', connectSeparatedPoints: true, highlightCircleSize: 0, xlabel: plain(chart.x), ylabel: plain(chart.y),
      y2label: right ? plain(chart.y2) : undefined, xLabelHeight: 18, yLabelWidth: 18, rightGap: 12, digitsAfterDecimal: 4, maxNumberWidth: 9,
      dateWindow: chart.time ? span : null,
      axes: { x: { axisLabelWidth: 56, pixelsPerLabel: 60 }, y: { axisLabelWidth: 52, valueRange: chart.range, pixelsPerLabel: 34, ...(chart.log ? { logscale: true, ticker: decades } : {}) }, y2: { axisLabelWidth: 48, valueRange: right ? chart.range2 : undefined, drawGrid: false } },
      underlayCallback: (context, area, graph) => this.behind(context, area, graph),
      drawCallback: (graph, first) => { if (!first) { zoom_all(this); this.place(this.at); } this.reset.hidden = !differs(graph.xAxisRange(), graph.xAxisExtremes()) && !differs(graph.yAxisRange(0), chart.range); },
    }, this.look_before(tools)));
    const line = this.line = made('div', 'cursor', plot);
    line.hidden = true;
    plot.addEventListener('mousemove', (event) => this.hover(event.clientX - plot.getBoundingClientRect().left));
    plot.addEventListener('touchmove', (event) => this.hover(event.touches[0].clientX - plot.getBoundingClientRect().left), { passive: true });
    if (chart.curves.some((curve) => curve.links)) plot.addEventListener('click', (event) => this.follow(event));
    this.place(this.at);
  };
  // To the run of the point that was clicked on.
  Chart.prototype.follow = function (event) {
    const at = event.currentTarget.getBoundingClientRect(), near = 14;
    this.chart.curves.forEach((curve, k) => (curve.links || []).forEach((link, i) => {
      const [x, y] = this.graph.toDomCoords(curve.x[i], curve.y[i]);
      if (link && Math.hypot(event.clientX - at.left - x, event.clientY - at.top - y) < near) window.location.href = link;
    }));
  };
  // Links below the plot, which exist before it draws.
  Chart.prototype.look_before = function (tools) {
    for (const [from, to] of (this.chart.time && this.chart.stretches) || []) {
      const pulse = made('a', '', tools);
      pulse.textContent = 'pulse';
      pulse.title = 'all curves from before the pulse to after it';
      pulse.addEventListener('click', () => this.graph.updateOptions({ dateWindow: [Math.max(0, 1.5 * from - 0.5 * to), 2 * to - from] }));
    }
    this.reset = made('a', '', tools);
    this.reset.textContent = 'all';
    this.reset.hidden = true;
    this.reset.addEventListener('click', () => this.graph.resetZoom());
    const csv = made('a', 'csv', tools);
    csv.textContent = 'CSV';
    csv.title = 'what this figure shows, as a table';
    csv.download = this.chart.name + '.csv';
    csv.href = '#';
    csv.addEventListener('click', () => {
      if (csv.href.startsWith('blob:')) return;
      csv.href = URL.createObjectURL(new Blob([csv_of(this.chart)], { type: 'text/csv' }));
    });
    return this.look();
  };
  // The mouse takes the nearest point of any curve.
  Chart.prototype.hover = function (pixels) {
    const x = this.graph.toDataXCoord(pixels), { rows } = this;
    let low = 0, high = rows.length - 1;
    while (high - low > 1) { const middle = (low + high) >> 1; if (rows[middle][0] <= x) low = middle; else high = middle; }
    const nearest = x - rows[low][0] < rows[high][0] - x ? rows[low][0] : rows[high][0];
    if (!this.chart.time) return this.place(nearest);
    document.dispatchEvent(new CustomEvent('splashdown:time', { detail: { time: nearest * data.seconds, x: nearest, from: 'curves' } }));
  };
  Chart.prototype.place = function (x) {
    this.at = x;
    if (!this.graph || x === undefined) return;
    const { chart, graph } = this, area = graph.getArea(), across = graph.toDomXCoord(x);
    this.line.hidden = across < area.x - 0.5 || across > area.x + area.w + 0.5;
    Object.assign(this.line.style, { left: across + 'px', top: area.y + 'px', height: area.h + 'px' });
    const name = chart.x.split(' / ')[0];
    this.readout.dataset.time = chart.time ? x * data.seconds : '';
    this.fields[0].textContent = name + ' = ' + text(x) + ' ' + unit(chart.x);
    chart.curves.forEach((curve, k) => {
      const value = value_at(curve, x), field = this.fields[k + 1];
      if (!field) return;
      field.dataset.value = value === null ? '' : value;
      field.textContent = text(value) + (value === null ? '' : ' ' + unit(curve.right ? chart.y2 : chart.y));
    });
  };

  document.addEventListener('splashdown:time', ({ detail }) => {
    const x = detail.x === undefined ? detail.time / data.seconds : detail.x;
    for (const one of charts) if (one.chart.time) one.place(x);
  });
  document.addEventListener('splashdown:draw', ({ detail }) => {
    charts = charts.filter((one) => !one.figure || one.figure.isConnected);  // without those that were replaced
    const one = new Chart(detail.chart, detail.figure);
    charts.push(one);
    one.build();
  });
  dark.addEventListener('change', () => charts.forEach((one) => one.graph && one.graph.updateOptions(one.look())));
  // One after the other: the page answers meanwhile.
  for (const one of charts) {
    if (!one.figure) continue;
    one.build();
    await new Promise((done) => setTimeout(done));
  }
  document.documentElement.dataset.charts = 'ready';
})();
