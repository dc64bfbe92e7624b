'use strict';
// The parts of the live page that know nothing of robots: sliders with numbers, a plot, messages to the server.
const rexControls = (function () {
  function element(name, className, text) {
    const made = document.createElement(name);
    if (className) made.className = className;
    if (text !== undefined) made.textContent = text;  // never as HTML: names come from files
    return made;
  }

  // Of a plot, in eight characters at most.
  const short = value => Math.abs(value) < 1e-12 ? '0' : (Math.abs(value) < 1e-3 || Math.abs(value) >= 1e5)
    ? value.toExponential(1) : String(Number(value.toPrecision(3)));

  const shown = value => value === null ? '' : String(Math.round(value * 1e4) / 1e4);

  // A slider with a number beside it. Without limits it spans `span` to both sides of 0, and the number any more.
  // `changed(value)` is called for what the user does. set(value) shows a value, unless the user holds the slider.
  function slider({ name, low, high, unit, span = 3.2, labels = true }, changed) {
    const box = element('div', 'joint'), range = element('input'), number = element('input');
    const from = low === null ? -span : low, to = high === null ? span : high;
    const isFree = low === null || high === null;
    const step = 10 ** Math.round(Math.log10((to - from) / 500));
    range.type = 'range';
    Object.assign(range, { min: from, max: to, step: 'any' });
    number.type = 'number';
    number.step = step;
    if (low !== null) number.min = low;
    if (high !== null) number.max = high;
    for (const input of [range, number]) input.setAttribute('aria-label', name);
    const label = element('span', 'name', name);
    label.title = name;
    box.append(label, number, element('span', 'unit', unit), range);
    if (labels && !(low === null && high === null)) {
      const limits = element('span', 'limits');
      limits.append(element('span', '', low === null ? 'no limit' : shown(low)),
        element('span', '', high === null ? 'no limit' : shown(high)));
      box.append(limits);
    }
    let value = null, held = 0;
    const clamped = x => Math.min(Math.max(x, low === null ? -Infinity : low), high === null ? Infinity : high);
    function choose(next) {
      held = performance.now() + 300;
      show(clamped(next));
      changed(value);
    }
    function show(next) {
      if (next === value) return;
      value = next;
      if (isFree && (next < range.min || next > range.max))
        range.min = Math.min(range.min, next), range.max = Math.max(range.max, next);
      range.value = next;
      if (document.activeElement !== number || performance.now() > held) number.value = shown(next);
    }
    range.addEventListener('input', () => choose(Number(range.value)));
    number.addEventListener('change', () => {
      if (number.value.trim() !== '' && Number.isFinite(Number(number.value))) choose(Number(number.value));
      else number.value = shown(value);
    });
    range.addEventListener('keydown', event => {
      const way = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1, PageDown: -10, PageUp: 10 }[event.key];
      if (!way) return;
      event.preventDefault();
      choose(value + way * step * (event.shiftKey ? 10 : 1));
    });
    range.addEventListener('wheel', event => {
      if (document.activeElement !== range) return;  // or scrolling the panel would move the robot
      event.preventDefault();
      choose(value - Math.sign(event.deltaY) * step * (event.shiftKey ? 10 : 1));
    }, { passive: false });
    return { box, range, number, set: next => { if (performance.now() > held) show(next); } };
  }

  // Events for the server, at most one message on its way: what comes meanwhile is sent with the next one, and of
  // events with the same key only the last.
  function messenger(failed) {
    let waiting = [], busy = false;
    async function flush() {
      if (busy || waiting.length === 0) return;
      busy = true;
      const sent = waiting;
      waiting = [];
      try {
        const events = sent.map(({ event }) => event);
        const answer = await fetch('events', { method: 'POST', body: JSON.stringify(events) });
        if (!answer.ok)
          failed(answer.status === 429 ? 'The program has no time for more events.' : 'The program refused an event.');
      } catch (cause) {
        failed('The program does not answer.');
      }
      busy = false;
      flush();
    }
    return function send(event, key) {
      const same = key === undefined ? -1 : waiting.findIndex(one => one.key === key);
      if (same >= 0) waiting[same] = { event, key };
      else if (waiting.length < 200) waiting.push({ event, key });
      flush();
    };
  }

  // Curves over the last `span` (Infinity: all) of what `label` names. `colors`: one per curve.
  function plot(canvas, colors, span, label) {
    const samples = [], most = 2000;
    function add(time, values) {
      if (samples.length > 0 && time < samples[samples.length - 1].time) samples.length = 0;
      if (samples.length > 0 && time === samples[samples.length - 1].time) return;
      samples.push({ time, values });
      while (samples[0].time < time - span) samples.shift();
      if (span === Infinity && samples.length > most)
        samples.splice(0, samples.length, ...samples.filter((_, i) => i % 2 === 0));
    }
    function draw() {
      const ratio = Math.min(window.devicePixelRatio || 1, 2), width = canvas.clientWidth, height = canvas.clientHeight;
      if (width === 0) return;
      canvas.width = width * ratio, canvas.height = height * ratio;
      const pen = canvas.getContext('2d');
      pen.scale(ratio, ratio);
      const size = parseFloat(getComputedStyle(canvas).fontSize) * 0.9, rough = size / 12;
      pen.font = size + 'px system-ui, "DejaVu Sans", sans-serif';
      const all = samples.flatMap(({ values }) => values).concat([0]);
      let low = Math.min(...all), high = Math.max(...all);
      if (high - low < 1e-9) high = low + 1;
      const margin = 60 * rough, axis = 16 * rough;
      const end = samples.length ? samples[samples.length - 1].time : 0, begin = samples.length ? samples[0].time : 0;
      const wide = span === Infinity ? Math.max(end - begin, 1) : span;
      const last = span === Infinity ? begin + wide : Math.max(end, span);
      const x = t => margin + (width - margin - 4) * (1 - (last - t) / wide);
      const y = v => 6 + (height - 12 - axis) * (high - v) / (high - low);
      pen.strokeStyle = '#dde3e9', pen.fillStyle = '#5c6875', pen.textAlign = 'right', pen.textBaseline = 'middle';
      for (const value of [low, 0, high]) {
        if (value === 0 && Math.min(y(low) - y(0), y(0) - y(high)) < 14 * rough && low !== 0 && high !== 0) continue;
        pen.beginPath(), pen.moveTo(margin, y(value)), pen.lineTo(width - 4, y(value)), pen.stroke();
        pen.fillText(short(value), margin - 6, Math.min(Math.max(y(value), 7 * rough), height - axis - 7 * rough));
      }
      pen.textBaseline = 'bottom';
      pen.fillText(short(last), width - 4, height);
      pen.textAlign = 'left';
      pen.fillText(short(last - wide), margin, height);
      pen.textAlign = 'center';
      pen.fillText(label, (margin + width) / 2, height);
      pen.lineWidth = 1.8 * rough, pen.lineJoin = 'round';
      colors.forEach((color, k) => {
        pen.strokeStyle = color;
        pen.beginPath();
        for (const { time, values } of samples) pen.lineTo(x(time), y(values[k]));
        pen.stroke();
        const now = samples[samples.length - 1];
        pen.fillStyle = color;
        if (now) pen.beginPath(), pen.arc(x(now.time), y(now.values[k]), 3 * rough, 0, 7), pen.fill();
      });
    }
    return { add, draw, clear: () => { samples.length = 0; } };
  }

  return { element, slider, messenger, plot, shown };
})();
