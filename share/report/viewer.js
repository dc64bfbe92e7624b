'use strict';
// Plays the film of the page.
(function () {
  const get = id => document.getElementById(id);
  const stage = get('stage'), notice = get('notice');

  async function start(gltf) {
    let beforeDraw = () => {};  // until everything below is there
    const shown = rexStage.open(stage, now => beforeDraw(now));
    const { parser, nodes } = await shown.load(gltf, 1), draw = shown.draw;

    // A thing whose scale is zero is not there.
    const channels = [];
    const animation = (parser.json.animations || [])[0] || { channels: [] };
    for (const { sampler, target } of animation.channels) {
      const { input, output, interpolation } = animation.samplers[sampler];
      const [keys, values] = await Promise.all([input, output].map(i => parser.getDependency('accessor', i)));
      const kind = interpolation === 'STEP' ? THREE.DiscreteInterpolant :
        target.path === 'rotation' ? THREE.QuaternionLinearInterpolant : THREE.LinearInterpolant;
      const node = nodes[target.node];
      channels.push({
        part: target.path === 'rotation' ? node.quaternion : target.path === 'scale' ? node.scale : node.position,
        curve: new kind(keys.array, values.array, values.itemSize)
      });
    }
    const moments = new Set([0]);
    for (const { curve } of channels) for (const moment of curve.parameterPositions) moments.add(moment);
    const times = Array.from(moments).sort((a, b) => a - b), duration = times[times.length - 1];

    function show(time) {
      for (const { part, curve } of channels) part.fromArray(curve.evaluate(time));
      for (const node of nodes) node.visible = node.scale.x !== 0;
    }

    // Where the curves are at that time.
    const marked = Array.from(document.querySelectorAll('.marked'), box => ({
      line: box.querySelector('i'), numbers: box.dataset.marks.trim().split(' ').map(Number), at: 0
    }));
    function mark(time) {
      for (const one of marked) {
        const { line, numbers } = one;
        if (numbers[one.at] > time) one.at = 0;
        while (one.at + 2 < numbers.length && numbers[one.at + 2] <= time + 1e-6) one.at += 2;
        line.style.left = 100 * numbers[one.at + 1] + '%';
        line.hidden = false;
      }
    }

    // The clock.
    let time = 0, playing = false, last = null, sliderHeld = false;
    const slider = get('time'), clock = get('clock'), speed = get('speed');
    function advance(now) {
      if (playing && last !== null) {
        time += (now - last) / 1000 * Number(speed.value);
        if (time > duration) time = duration > 0 ? time % duration : 0;
      }
      last = playing ? now : null;
      if (playing) draw();
      showClock();
    }
    function showClock() {
      if (!sliderHeld) slider.value = time;
      clock.textContent = time.toFixed(2) + ' / ' + duration.toFixed(2) + ' s';
      slider.setAttribute('aria-valuetext', time.toFixed(2) + ' seconds');
    }
    function setPlaying(on) {
      playing = on && duration > 0;
      last = null;
      document.body.classList.toggle('playing', playing);
      get('play').setAttribute('aria-label', playing ? 'Pause' : 'Play');
      draw();
    }
    function goTo(moment) {
      time = Math.min(Math.max(moment, 0), duration);
      draw();
    }
    function step(direction) {
      setPlaying(false);
      const eps = 1e-6, ahead = times.find(t => t > time + eps);
      const behind = times.filter(t => t < time - eps).pop();
      goTo(direction > 0 ? (ahead === undefined ? duration : ahead) : (behind === undefined ? 0 : behind));
    }

    const whole = () => document.fullscreenElement ? document.exitFullscreen() : document.documentElement.requestFullscreen();
    get('whole').addEventListener('click', whole);
    const keys = {
      ' ': () => setPlaying(!playing), ',': () => step(-1), '.': () => step(1), r: shown.resetView,
      Home: () => goTo(0), End: () => goTo(duration), f: whole
    };
    document.addEventListener('keydown', event => {
      if (event.ctrlKey || event.altKey || event.metaKey) return;
      const onButton = event.target.closest && event.target.closest('button, select');
      const isKey = keys[event.key] && !(onButton && event.key === ' ');
      if (isKey) keys[event.key]();
      if (isKey || shown.obeys(event)) event.preventDefault();
    });

    get('play').addEventListener('click', () => setPlaying(!playing));
    get('back').addEventListener('click', () => step(-1));
    get('forward').addEventListener('click', () => step(1));
    get('reset').addEventListener('click', shown.resetView);
    slider.addEventListener('input', () => { setPlaying(false); goTo(Number(slider.value)); });

    beforeDraw = now => {
      advance(now);
      show(time);
      mark(time);
    };
    slider.max = duration;
    const asks = new URLSearchParams(location.hash.slice(1));
    const calm = window.matchMedia('(prefers-reduced-motion: reduce)').matches;
    get('controls').hidden = duration === 0;
    get('hint').hidden = false;
    document.body.classList.add('running');
    const start = Number(stage.dataset.start);
    goTo(Number(asks.get('t') ?? start) || 0);
    setPlaying(!calm && !asks.has('paused') && start === 0);
  }

  function fail(cause) {
    document.body.classList.remove('running');
    for (const canvas of stage.querySelectorAll('canvas')) canvas.remove();
    notice.textContent = 'Only this picture can be shown, because the browser cannot play the film: ' + cause.message;
  }

  // three.js is packed, or it would be most of the page.
  async function runLibrary() {
    const packed = new Blob([rexStage.bytesOf(get('library').textContent)]);
    const script = document.createElement('script');
    script.textContent = await new Response(packed.stream().pipeThrough(new DecompressionStream('gzip'))).text();
    document.head.appendChild(script);
  }

  runLibrary().then(() => rexStage.parse(rexStage.bytesOf(get('film').textContent))).then(start).catch(fail);
})();
