'use strict';
(() => {
  const $ = id => document.getElementById(id);
  const NS = 'http://www.w3.org/2000/svg';
  const all = (selector, root) => Array.from((root || document).querySelectorAll(selector));

  /* What to change: one text at a time, and a button that copies it. */
  const texts = all('#change .text');
  if (texts.length) {
    const tabs = document.createElement('div');
    tabs.className = 'tabs';
    tabs.setAttribute('role', 'tablist');
    const show = k => texts.forEach((text, i) => {
      text.hidden = i !== k;
      tabs.children[i].setAttribute('aria-selected', i === k);
      tabs.children[i].tabIndex = i === k ? 0 : -1;
    });
    texts.forEach((text, i) => {
      const tab = document.createElement('button'), name = text.querySelector('h3');
      tab.type = 'button';
      tab.id = 'tab-' + i;
      tab.textContent = name.textContent;
      name.hidden = true;
      tab.setAttribute('role', 'tab');
      tab.setAttribute('aria-controls', text.id);
      text.setAttribute('role', 'tabpanel');
      text.setAttribute('aria-labelledby', tab.id);
      tab.onclick = () => show(i);
      tab.onkeydown = e => {
        const step = { ArrowRight: 1, ArrowLeft: -1 }[e.key];
        if (!step) return;
        const next = (i + step + texts.length) % texts.length;
        show(next);
        tabs.children[next].focus();
      };
      tabs.append(tab);
      const copy = document.createElement('button');
      copy.type = 'button';
      copy.className = 'copy';
      copy.textContent = 'copy';
      copy.onclick = () => {
        const range = document.createRange();
        range.selectNodeContents(text.querySelector('pre'));
        getSelection().removeAllRanges();
        getSelection().addRange(range);
        copy.textContent = document.execCommand('copy') ? 'copied' : 'press Ctrl+C';
        setTimeout(() => { copy.textContent = 'copy'; }, 2000);
      };
      text.prepend(copy);
    });
    texts[0].before(tabs);
    show(0);
  }

  /* A link to what is folded unfolds it, and paper shows what is folded nowhere else. */
  const unfold = () => {
    const target = location.hash.length > 1 && $(decodeURIComponent(location.hash.slice(1)));
    for (let e = target; e; e = e.parentElement) if (e.tagName === 'DETAILS') e.open = true;
    if (target) target.scrollIntoView();
  };
  addEventListener('hashchange', unfold);
  unfold();

  /* The map. */
  const block = $('forecasts');
  if (!block) return;
  const numbers = ([low, high, text]) => {
    const bytes = atob(text);
    return Float64Array.from({ length: bytes.length / 2 }, (_, i) =>
      low + (bytes.charCodeAt(2 * i) + 256 * bytes.charCodeAt(2 * i + 1)) / 65535 * (high - low));
  };
  const data = JSON.parse(block.textContent);
  const COLUMNS = ['t', 'x', 'y', 'h', 'before', 'after', 'gx', 'gy'];
  const kinds = data.patched ? ['before', 'after'] : ['before'];
  const runs = data.runs.map(run => Object.assign({}, run, ...COLUMNS.map(c => ({ [c]: numbers(run[c]) }))));
  const map = $('map'), strip = $('strip'), slider = $('cursor'), read = $('read');
  const make = (parent, name, attributes) => {
    const e = document.createElementNS(NS, name);
    for (const key in attributes) e.setAttribute(key, attributes[key]);
    parent.append(e);
    return e;
  };
  const digits = v => v < 100 ? v.toPrecision(2) : String(Number(v.toPrecision(2)));
  const length = m => m < 0.9995 ? digits(1000 * m) + ' mm' : digits(m) + ' m';
  const coarse = t => t.toFixed(1);
  let run = runs[0], which = 'before', view, home, place, at = 0;

  const range = values => values.reduce(([a, b], v) => [Math.min(a, v), Math.max(b, v)], [Infinity, -Infinity]);
  const known = i => run.before[i] > -0.05 * run.top;
  const placing = of => {
    const [x0, x1] = range(of.x), [y0, y1] = range(of.y);
    const wide = Math.max(x1 - x0, 1e-3), high = Math.max(y1 - y0, 1e-3);
    const height = Math.min(Math.max(920 * high / wide + 80, 340), 620);
    const k = Math.min(920 / wide, (height - 80) / high);
    return {
      height, k,
      x: x => 500 + (x - (x0 + x1) / 2) * k,
      y: y => height / 2 - (y - (y0 + y1) / 2) * k
    };
  };
  const line = (points, isThere = () => true) => points.map(([x, y], i) => !isThere(i) ? ''
    : (i && isThere(i - 1) ? 'L' : 'M') + x.toFixed(1) + ' ' + y.toFixed(1)).join('');
  const setView = () => {
    map.setAttribute('viewBox', view.join(' '));
    scaleBar();
  };
  const scaleBar = () => {
    const metres = view[2] / place.k, decade = 10 ** Math.floor(Math.log10(metres / 4));
    const step = [5, 2, 1].map(f => f * decade).find(s => s <= metres / 4);
    $('scale').style.width = 100 * step / metres + '%';
    $('scale').textContent = step < 1 ? Math.round(1000 * step) + ' mm' : step + ' m';
  };
  const paths = () => {
    const g = $('path'), top = run.top;
    g.textContent = '';
    const bins = Array.from({ length: 6 }, () => ''), errors = run[which];
    let whole = '';
    for (let i = 1; i < run.x.length; i += 1) {
      const piece = line([i - 1, i].map(j => [place.x(run.x[j]), place.y(run.y[j])]));
      if (known(i)) bins[Math.min(5, Math.max(0, Math.floor(6 * errors[i] / top)))] += piece;
      whole += piece;
    }
    make(g, 'path', { class: 'casing', d: whole });
    bins.forEach((d, k) => { if (d) make(g, 'path', { class: 'error e' + k, d }); });
    data.disks.forEach(([x, y, r]) =>
      make(g, 'circle', { class: 'scope', cx: place.x(x), cy: place.y(y), r: r * place.k }));
    $('most').textContent = length(top);
  };
  const strips = () => {
    const g = $('strips'), top = run.top, n = run.t.length, y = e => 116 - 108 * e / top;
    const [t0, t1] = [run.t[0], run.t[n - 1]];
    g.textContent = '';
    place.t = t => 1000 * (t - t0) / Math.max(t1 - t0, 1e-9);
    const clip = t => Math.min(1000, Math.max(0, place.t(t)));
    if (run.held !== null) {
      make(g, 'rect', { class: 'held', x: clip(run.held), y: 4, width: 1000 - clip(run.held), height: 112 });
    }
    run.scoped.forEach(([from, until]) => {
      make(g, 'rect', { class: 'scope', x: clip(from), y: 4, width: clip(until) - clip(from), height: 112 });
    });
    if (run.floor !== null) {
      make(g, 'line', { class: 'line floor', x1: 0, x2: 1000, y1: y(run.floor), y2: y(run.floor) });
    }
    kinds.forEach(kind => make(g, 'path', {
      class: 'line ' + kind,
      d: line(Array.from(run[kind], (e, i) => [place.t(run.t[i]), y(e)]), known)
    }));
    $('strip-top').textContent = length(top);
    $('strip-from').textContent = coarse(t0) + ' s';
    $('strip-until').textContent = coarse(t1) + ' s';
  };
  const robot = i => 'translate(' + place.x(run.x[i]).toFixed(1) + ' ' + place.y(run.y[i]).toFixed(1) + ') scale('
    + (view[2] / 1000).toFixed(3) + ') rotate(' + (-run.h[i] * 180 / Math.PI).toFixed(1) + ')';
  const draw = () => {
    const g = $('ghosts'), i = at, m = run.m, measured = [];
    g.textContent = '';
    for (let j = i; j < run.t.length && run.t[j] <= run.t[i] + run.ahead; j += 1) {
      measured.push([place.x(run.x[j]), place.y(run.y[j])]);
    }
    if (measured.length > 1) make(g, 'path', { class: 'line ahead', d: line(measured) });
    if (known(i)) kinds.forEach((kind, k) => {
      const from = (2 * i + k) * m, points = [];
      for (let j = 0; j < m; j += 1) points.push([place.x(run.gx[from + j]), place.y(run.gy[from + j])]);
      make(g, 'path', { class: 'line ' + kind, d: line(points) });
      const [x, y] = points[m - 1];
      make(g, 'circle', { class: 'mark ' + kind, cx: x.toFixed(1), cy: y.toFixed(1), r: (6 * view[2] / 1000).toFixed(2) });
    });
    make(g, 'path', { class: 'robot', d: 'M15 0L-9 9L-4 0L-9 -9Z', transform: robot(i) });
    const x = place.t(run.t[i]).toFixed(1);
    $('now').setAttribute('x1', x);
    $('now').setAttribute('x2', x);
    read.textContent = known(i) ? 'At ' + coarse(run.t[i]) + ' s: ' + Number(run.ahead.toPrecision(3))
      + ' s later the model ' + (data.patched ? 'as given ' : '') + 'is off by ' + length(run.before[i])
      + (data.patched ? ', the patched one by ' + length(run.after[i]) : '') + '.'
      : 'At ' + coarse(run.t[i]) + ' s: too near to an end of the run to look ahead.';
  };
  const go = i => {
    at = Math.min(run.t.length - 1, Math.max(0, Math.round(i)));
    slider.value = at;
    draw();
    slider.setAttribute('aria-valuetext', read.textContent);
  };
  const choose = k => {
    run = runs[k];
    place = placing(run);
    home = [0, 0, 1000, place.height];
    view = home.slice();
    slider.max = run.t.length - 1;
    paths();
    strips();
    setView();
    go(run.before.indexOf(Math.max(...run.before)));
  };
  const zoom = (f, x, y) => {
    const [cx, cy] = x === undefined ? [view[0] + view[2] / 2, view[1] + view[3] / 2] : [x, y];
    const g = Math.min(Math.max(f, home[2] / 200 / view[2]), 2 * home[2] / view[2]);
    view = [cx - (cx - view[0]) * g, cy - (cy - view[1]) * g, view[2] * g, view[3] * g];
    setView();
    draw();
  };
  const whole = () => {
    view = home.slice();
    setView();
    draw();
  };
  const under = e => {
    const r = map.getBoundingClientRect();
    return [view[0] + (e.clientX - r.left) / r.width * view[2], view[1] + (e.clientY - r.top) / r.height * view[3]];
  };
  const nearest = ([x, y]) => {
    let best = -1, least = (24 * view[2] / 1000) ** 2;
    for (let i = 0; i < run.x.length; i += 1) {
      const d = (place.x(run.x[i]) - x) ** 2 + (place.y(run.y[i]) - y) ** 2;
      if (d < least) [best, least] = [i, d];
    }
    return best;
  };

  let timer = 0;
  const play = $('play');
  const stop = () => {
    clearInterval(timer);
    timer = 0;
    play.textContent = 'play';
  };
  play.onclick = () => {
    if (timer) return stop();
    play.textContent = 'pause';
    timer = setInterval(() => go((at + 1) % run.t.length), 60);
  };
  const colour = kind => {
    which = kind;
    $('by-before').setAttribute('aria-pressed', kind === 'before');
    $('by-after').setAttribute('aria-pressed', kind === 'after');
    paths();
  };
  if (data.patched) {
    $('by-before').onclick = () => colour('before');
    $('by-after').onclick = () => colour('after');
  }
  $('closer').onclick = () => zoom(0.7);
  $('farther').onclick = () => zoom(1 / 0.7);
  $('whole').onclick = whole;
  $('run').onchange = e => choose(Number(e.target.value));
  slider.oninput = () => go(Number(slider.value));
  strip.onclick = e => {
    const r = strip.getBoundingClientRect(), share = (e.clientX - r.left) / r.width;
    const t = run.t[0] + share * (run.t[run.t.length - 1] - run.t[0]);
    go(run.t.findIndex(v => v >= t));
  };
  map.addEventListener('wheel', e => {
    if (!e.ctrlKey && !e.metaKey) return;
    e.preventDefault();
    zoom(e.deltaY > 0 ? 1.15 : 0.87, ...under(e));
  }, { passive: false });
  let drag = null;
  map.onpointerdown = e => {
    if (e.pointerType === 'mouse') drag = [e.clientX, e.clientY, ...view];
    else hover(e);
  };
  const hover = e => {
    const i = nearest(under(e));
    if (i >= 0) go(i);
  };
  map.onpointermove = e => {
    if (!drag || !e.buttons) return hover(e);
    const r = map.getBoundingClientRect();
    view[0] = drag[2] - (e.clientX - drag[0]) / r.width * view[2];
    view[1] = drag[3] - (e.clientY - drag[1]) / r.height * view[3];
    setView();
  };
  addEventListener('pointerup', () => { drag = null; });
  map.onkeydown = e => {
    const act = { '+': () => zoom(0.7), '-': () => zoom(1 / 0.7), 0: whole }[e.key];
    if (act) act();
  };
  map.tabIndex = 0;
  all('[data-live]').forEach(e => { e.hidden = false; });
  choose(0);
})();
