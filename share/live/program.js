'use strict';
// What a program asks for by LiveView: sliders, buttons and plots of its own.
const rexProgram = (function () {
  const { element, slider, plot } = rexControls;
  const panel = document.getElementById('program'), asked = document.getElementById('asked');
  const goOn = document.getElementById('goOn'), pause = document.getElementById('pause');
  const plots = document.getElementById('plots');
  const known = new Map();
  let send = () => {};

  function make({ kind, name, low, high, xLabel }) {
    if (kind === 'slider') {
      const changed = value => send({ do: 'slider', name, value }, 'slider ' + name);
      const made = slider({ name, low, high, unit: '' }, changed);
      return { box: made.box, show: one => made.set(one.value) };
    }
    if (kind === 'button') {
      const button = element('button', '', name);
      button.type = 'button';
      button.addEventListener('click', () => send({ do: 'button', name }));
      return { box: button, show: () => {} };
    }
    const box = element('div'), canvas = element('canvas', 'own'),
      curve = plot(canvas, ['#1f5fa8'], xLabel === 'time [s]' ? 10 : Infinity, xLabel);
    box.append(element('p', 'legend', name), canvas);
    let last = null;
    return {
      box, show: ({ points }) => {
        const end = points.length > 0 ? points[points.length - 1][0] : last;
        if (last === end) return;
        for (const [x, y] of points) if (last === null || end < last || x > last) curve.add(x, [y]);
        last = end;
        curve.draw();
      }
    };
  }

  goOn.addEventListener('click', () => send({ do: 'go on' }));
  pause.addEventListener('click', () => send({ do: 'pause' }));

  function show(frame, sender) {
    send = sender;
    if (!frame.asked) return;
    panel.hidden = false;
    goOn.hidden = !frame.paused, pause.hidden = frame.paused;
    for (const one of frame.asked.filter(({ kind }) => kind !== 'handle')) {
      const key = one.kind + ' ' + one.name;
      if (!known.has(key)) {
        known.set(key, make(one));
        (one.kind === 'plot' ? plots : asked).append(known.get(key).box);
        plots.hidden = plots.children.length === 0;
      }
      known.get(key).show(one);
    }
  }
  return { show };
})();
