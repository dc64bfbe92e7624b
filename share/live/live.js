'use strict';
// The live page: shows what the program sends, and sends what the user does. What is worth knowing about events and
// frames is in src/live/live_session.h.
(function () {
  const { element, slider, messenger, plot, shown } = rexControls;
  const get = id => document.getElementById(id);
  const stage = get('stage');
  let about = null;     // scene.json
  let scene = null;     // what the stage shows of it
  let frame = null;     // the last one that came
  let isStale = false;  // whether the scene does not show it yet
  let drawnFrames = 0, firstPicture = null;

  function tell(text) {
    get('notice').textContent = text;
    get('notice').hidden = text === '';
    clearTimeout(tell.timer);
    tell.timer = setTimeout(() => { get('notice').hidden = true; }, 9000);
  }
  const send = messenger(tell);
  const isPlain = rexStage.isSoftware();
  const view = rexStage.open(stage, beforeDraw, isPlain);
  const energies = plot(get('plot'), ['#d55e00', '#0072b2', '#1d2530'], 10, 'time [s]');

  // --- The scene. Bodies are groups in the frame of the world, z up, and have their shapes.

  async function load() {
    const read = async name => {
      const answer = await fetch(name);
      if (!answer.ok) throw new Error(name + ' cannot be had');
      return answer;
    };
    const next = await read('scene.json').then(a => a.json());
    const glb = next.pieces ? await assemble(next, read) : await read('scene.glb').then(a => a.arrayBuffer());
    const current = await view.load(await rexStage.parse(glb), 1.7);
    about = next;
    const bodies = about.bodies.map(() => current.world.add(new THREE.Group()).children.slice(-1)[0]);
    const shapes = about.shapes.map((shape, i) => {
      const node = current.nodes.find(one => one.name === 's' + i);
      if (!node) return null;
      bodies[shape.body].add(node);
      node.position.fromArray(shape.pose), node.quaternion.fromArray(shape.pose, 3), node.scale.set(1, 1, 1);
      node.visible = shape.visible;
      node.traverse(part => { part.userData.shape = i; });
      return node;
    });
    const overlay = new THREE.Group();
    current.world.add(overlay);
    const ground = current.nodes.find(one => one.name === 'ground');
    scene = { current, bodies, shapes, overlay, handles: new Map(), ground: ground ? ground.position.z : 0, groundNode: ground, hidden: new Set() };
    addMarks();
    buildPanels();
    isStale = true;
    view.draw();
  }

  // Programs send their pictures in pieces, of which most are those of the picture before.
  let pieces = new Map();
  async function assemble({ gltf, pieces: wanted }, read) {
    const before = pieces, encoder = new TextEncoder();
    pieces = new Map();
    for (const [, name] of wanted)
      if (name) pieces.set(name, before.get(name) || read(name).then(a => a.arrayBuffer()));
    const all = await Promise.all(wanted.map(async ([at, name, small]) =>
      [at, new Uint8Array(name ? await pieces.get(name) : rexStage.bytesOf(small))]));
    const json = encoder.encode(gltf), binary = Math.max(0, ...all.map(([at, bytes]) => at + bytes.length));
    const padded = Math.ceil(binary / 4) * 4, glb = new Uint8Array(28 + json.length + padded);
    const head = new DataView(glb.buffer), start = 28 + json.length;
    [0x46546c67, 2, glb.length, json.length, 0x4e4f534a].forEach((value, k) => head.setUint32(4 * k, value, true));
    glb.set(json, 20);
    head.setUint32(start - 8, padded, true), head.setUint32(start - 4, 0x4e4942, true);
    for (const [at, bytes] of all) glb.set(bytes, start + at);
    return glb.buffer;
  }

  const flat = (color, opacity = 1) =>
    new THREE.MeshBasicMaterial({ color, opacity, transparent: true, depthTest: false, depthWrite: false });

  function addMarks() {
    const size = 0.1 * scene.current.radius;
    scene.com = new THREE.Mesh(new THREE.SphereGeometry(0.12 * size, 24, 16), flat('#d55e00', 0.9));
    const line = color => new THREE.LineBasicMaterial({ color, depthTest: false });
    const empty = () => new THREE.BufferGeometry();
    scene.contacts = new THREE.LineSegments(empty(), line('#c2185b'));
    const dot = { color: '#c2185b', size: 6, sizeAttenuation: false, depthTest: false };
    scene.points = new THREE.Points(empty(), new THREE.PointsMaterial(dot));
    scene.pull = new THREE.Line(empty(), line('#1f5fa8'));
    scene.arrow = new THREE.ArrowHelper(new THREE.Vector3(0, 0, 1), new THREE.Vector3(), 1, '#d55e00');
    for (const part of scene.arrow.children) part.material.depthTest = false;
    for (const mark of [scene.com, scene.contacts, scene.points, scene.pull, scene.arrow]) {
      mark.visible = false, mark.renderOrder = 1e6, mark.frustumCulled = false;
      scene.overlay.add(mark);
    }
    scene.arrowText = addText(scene.arrow, '', '#b34700');
    scene.axes = scene.bodies.map(body => {
      const axes = new THREE.AxesHelper(size);
      axes.material.depthTest = false, axes.renderOrder = 1e6, axes.visible = false;
      body.add(axes);
      return axes;
    });
    scene.names = about.bodies.map((body, i) => {
      const anchor = new THREE.Object3D();
      anchor.visible = false;
      scene.bodies[i].add(anchor);
      addText(anchor, body.name, '#123f73');
      return anchor;
    });
  }

  function addText(object, text, color) {
    const label = element('div', 'text', text);
    label.style.color = color;
    stage.appendChild(label);
    scene.current.texts.push({ object, element: label, below: 0, fixed: false });
    return label;
  }

  function showPoses() {
    const floats = new Float32Array(rexStage.bytesOf(frame.poses));
    scene.bodies.forEach((body, i) => {
      body.position.fromArray(floats, 7 * i);
      body.quaternion.fromArray(floats, 7 * i + 3);
    });
    scene.poses = floats;
  }

  const setPoints = (object, points) =>
    object.geometry.setAttribute('position', new THREE.Float32BufferAttribute(points.flat(), 3));

  // Once the centre of mass has gone farther than half the size of the scene, the view goes along, and the ground aside.
  function followRobot() {
    if (!frame.com) return;
    const { world, radius } = scene.current, centre = new THREE.Vector3().fromArray(frame.com);
    if (!scene.start) scene.start = centre.clone(), scene.moved = new THREE.Vector3();
    const way = centre.sub(scene.start), far = way.length();
    way.multiplyScalar(Math.max(0, 1 - 0.5 * radius / Math.max(far, 1e-9)));
    if (way.distanceTo(scene.moved) < 1e-3 * radius) return;
    view.moveBy(world.localToWorld(way.clone()).sub(world.localToWorld(scene.moved.clone())));
    const step = way.clone().sub(scene.moved);
    if (scene.groundNode) {
      scene.groundNode.position.add(step.clone().setZ(0));
      scene.groundNode.traverse(({ material }) => {
        if (material && material.uniforms && material.uniforms.middle)
          material.uniforms.middle.value.add(new THREE.Vector2(step.x, step.y));
      });
    }
    scene.moved = way;
  }

  function showMarks() {
    scene.com.visible = get('com').checked && Boolean(frame.com);
    if (frame.com) scene.com.position.fromArray(frame.com);
    scene.axes.forEach((axes, i) => { axes.visible = get('frames').checked && i > 0; });
    scene.names.forEach((name, i) => { name.visible = get('names').checked && i > 0; });
    const near = frame.contacts || [];
    scene.contacts.visible = scene.points.visible = near.length > 0;
    const ends = near.flatMap(contact => [contact[3], contact[4]]);
    for (const object of [scene.contacts, scene.points]) if (ends.length > 0) setPoints(object, ends);
    scene.pull.visible = Boolean(frame.drag);
    if (frame.drag) setPoints(scene.pull, [frame.drag.at, frame.drag.to]);
    scene.arrow.visible = Boolean(frame.push);
    if (frame.push) {
      const force = new THREE.Vector3().fromArray(frame.push.force), length = force.length() / newtonsPerMetre();
      scene.arrow.position.fromArray(frame.push.at);
      scene.arrow.setDirection(force.clone().normalize());
      scene.arrow.setLength(Math.max(length, 1e-3), Math.min(0.3 * length, 0.06 * scene.current.radius) + 1e-4);
      scene.arrowText.textContent = force.length().toPrecision(3) + ' N';
    }
  }

  // Points of the program that the mouse moves: as large as a finger at any distance.
  function showHandles() {
    for (const { kind, name, at } of frame.asked || []) {
      if (kind !== 'handle') continue;
      if (!scene.handles.has(name)) {
        const mark = new THREE.Mesh(new THREE.SphereGeometry(1, 24, 16), flat('#e69f00', 0.7));
        mark.renderOrder = 1e6, mark.frustumCulled = false;
        scene.overlay.add(mark);
        addText(mark, name, '#7a4b00').style.marginLeft = '14px';
        scene.handles.set(name, mark);
      }
      scene.handles.get(name).position.fromArray(grasped && grasped.name === name ? grasped.at : at);
    }
  }
  function sizeHandles() {
    for (const mark of scene.handles.values()) {
      const place = mark.getWorldPosition(new THREE.Vector3());
      mark.scale.setScalar(0.012 * place.distanceTo(view.view.position));
    }
  }

  // Where drawing a picture takes too long, as without a graphics card, fewer pixels are drawn, and the page says so.
  let pictures = 0, slow = 0, fast = 0, quality = 1;
  function watchSpeed() {
    if (++pictures % 8 !== 0 || fast > 10 || quality <= 0.5 || !scene) return;
    const start = performance.now(), gl = view.renderer.getContext();
    view.renderer.render(scene.current.scene, view.view);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));  // waits until it is drawn
    const isSlow = performance.now() - start > 25;
    slow = isSlow ? slow + 1 : 0, fast = isSlow ? 0 : fast + 1;
    if (slow < 2) return;
    slow = 0, quality = Math.max(0.5, quality / 1.4);
    setTimeout(() => view.setQuality(quality));
    setState('live, drawn coarsely: this browser has no fast graphics', false);
  }

  function beforeDraw() {
    watchSpeed();
    if (!frame || !scene) return;
    if (isStale) showFrameInScene();
    sizeHandles();
  }
  function showFrameInScene() {
    isStale = false;
    showPoses();
    followRobot();
    showMarks();
    showHandles();
    followHandle();
    if (++drawnFrames === 1) firstPicture = performance.now();
  }

  // --- The panels.

  let sliders = [];
  const labelOf = i => about.shapes[i].name || about.bodies[about.shapes[i].body].name || 'world';

  function buildPanels() {
    const isRobot = about.kind === 'robot';
    document.title = about.title;
    const facts = about.facts || [];
    get('aboutPanel').hidden = facts.length === 0;
    get('facts').replaceChildren(...facts.flatMap(([name, text]) => [element('dt', '', name), element('dd', '', text)]));
    get('title').textContent = about.title;
    for (const id of ['jointPanel', 'physicsPanel']) get(id).hidden = !isRobot;
    for (const id of ['lookPanel', 'bodyPanel']) get(id).hidden = about.bodies.length === 0;
    for (const id of ['com', 'contacts', 'avoid']) get(id).parentElement.hidden = !isRobot;
    for (const button of [get('run'), get('step'), get('stop'), get('speed'), get('clock')]) button.hidden = !isRobot;
    get('modes').hidden = !isRobot;
    get('joints').textContent = '';
    sliders = !isRobot ? [] : about.coordinates.map((one, i) => {
      const span = one.unit === 'm' ? 2 : one.turns ? 1 : 3.1416;
      const made = slider({ ...one, span }, value => send({ do: 'move', q: { [i]: value } }, 'q' + i));
      get('joints').append(made.box);
      return made;
    });
    if (isRobot && sliders.length === 0) get('joints').append(element('p', 'state', 'No joint of this scene moves.'));
    get('homes').textContent = '';
    const postures = isRobot ? about.postures : [];
    get('homes').hidden = postures.length === 0;
    for (const name of ['', ...postures]) {
      const choice = element('option', '', name || 'as in the file');
      choice.value = name;
      get('homes').append(choice);
    }
    // Where a model of MuJoCo has its joints at 0 is often no posture that it can take.
    get('homes').value = postures.includes('key:home') ? 'key:home' : '';
    get('bodies').textContent = '';
    about.bodies.forEach((body, i) => {
      if (!about.shapes.some(shape => shape.body === i && shape.drawn)) return;
      const label = element('label'), box = element('input');
      box.type = 'checkbox', box.checked = true;
      box.addEventListener('change', () => {
        if (box.checked) scene.hidden.delete(i);
        else scene.hidden.add(i);
        showShapes();
      });
      const name = element('span', 'bodyName', body.name || 'the world');
      name.title = about.shapes.filter(shape => shape.body === i).map(shape => shape.name).filter(Boolean).join(', ');
      label.append(box, name, element('span', 'mass', body.mass > 0 ? shown(body.mass) + ' kg' : ''));
      get('bodies').append(label);
    });
    if (!get('height').dataset.touched) get('height').value = shown(scene.ground);
    showShapes();
  }

  function showShapes() {
    about.shapes.forEach((shape, i) => {
      if (!scene.shapes[i]) return;
      const wanted = get('collision').checked ? shape.contact : shape.visible;
      scene.shapes[i].visible = wanted && !scene.hidden.has(shape.body);
    });
    isStale = true;
    view.draw();
  }

  function showFrame() {
    const settings = frame.settings;
    if (settings) {
      const target = frame.simulates && settings.hold !== 'free' ? frame.target : frame.q;
      sliders.forEach((one, i) => one.set(target[i]));
      for (const id of ['gravity', 'floor', 'contacts', 'avoid']) get(id).checked = settings[id];
      get('hold').value = settings.hold;
      if (document.activeElement !== get('friction')) get('friction').value = settings.friction;
      if (settings.floor && document.activeElement !== get('height')) get('height').value = settings.height;
      get('speed').value = String(settings.speed);
      get('run').textContent = frame.runs ? 'Pause' : frame.simulates ? 'Go on' : 'Simulate';
      get('stop').disabled = !frame.simulates;
      get('clock').textContent = frame.simulates ? frame.time.toFixed(2) + ' s' : '';
      if (scene.groundNode) scene.groundNode.position.z = settings.floor ? settings.height : scene.ground;
      showNear();
      showRecording();
    }
    if (frame.energy) energies.add(frame.time, [frame.energy[0], frame.energy[1], frame.energy[0] + frame.energy[1]]);
    const hasPlot = Boolean(frame.energy);
    if (get('energies').hidden === hasPlot) {
      get('energies').hidden = !hasPlot;
      energies.clear();
      view.resize();
    }
    if (hasPlot) energies.draw();
    if (frame.notice && frame.notice.number !== showFrame.told) {
      if (showFrame.told !== undefined || frame.notice.number > 0) tell(frame.notice.text);
      showFrame.told = frame.notice.number;
    }
    rexProgram.show(frame, send);
  }

  function showNear() {
    const near = frame.contacts || [];
    get('near').hidden = near.length === 0;
    get('near').textContent = '';
    for (const [a, b, distance] of near.slice(0, 12)) {
      const line = element('li', distance <= 0 ? 'touching' : '');
      line.append(element('span', '', labelOf(a) + ' – ' + labelOf(b)),
        element('span', '', (1000 * distance).toFixed(1) + ' mm'));
      get('near').append(line);
    }
  }

  function showRecording() {
    const isOn = frame.recording !== undefined;
    get('record').textContent = isOn ? 'End recording (' + frame.recording.toFixed(1) + ' s)' : 'Record';
    if (isOn) get('recorded').textContent = '', showRecording.wasOn = true;
    else if (showRecording.wasOn) {
      showRecording.wasOn = false;
      addDownload('replay.html', 'Replay');
      addDownload('motion.csv', 'Table of q');
      const film = element('button', '', 'Draw a film');
      film.type = 'button';
      film.addEventListener('click', () => send({ do: 'film' }));
      get('recorded').append(film);
    }
    if (frame.film !== showRecording.film && !isOn) addDownload('film.mp4', 'Film');
    showRecording.film = frame.film;
  }
  function addDownload(name, text) {
    const link = element('a', '', text);
    link.href = name, link.download = name;
    get('recorded').append(link);
  }

  const settings = () => send({
    do: 'settings', gravity: get('gravity').checked, floor: get('floor').checked,
    height: Number(get('height').value) || 0, friction: Math.max(Number(get('friction').value) || 0, 0),
    hold: get('hold').value
  }, 'settings');
  for (const id of ['gravity', 'floor', 'height', 'friction', 'hold']) get(id).addEventListener('change', settings);
  get('height').addEventListener('input', () => { get('height').dataset.touched = 'yes'; });
  for (const id of ['contacts', 'avoid'])
    get(id).addEventListener('change', () =>
      send({ do: 'contacts', show: get('contacts').checked, avoid: get('avoid').checked }));
  const redraw = () => { isStale = true; view.draw(); };
  for (const id of ['names', 'frames', 'com']) get(id).addEventListener('change', redraw);
  get('collision').addEventListener('change', showShapes);
  const goHome = () => send(get('homes').value ? { do: 'home', posture: get('homes').value } : { do: 'home' });
  get('home').addEventListener('click', goHome);
  get('homes').addEventListener('change', goHome);
  const run = () => send({ do: 'run', on: !(frame && frame.runs) });
  get('run').addEventListener('click', run);
  get('step').addEventListener('click', () => send({ do: 'step' }));
  get('stop').addEventListener('click', () => send({ do: 'stop' }));
  get('speed').addEventListener('change', () => send({ do: 'speed', value: Number(get('speed').value) }));
  get('record').addEventListener('click', () => send({ do: 'record', on: frame.recording === undefined }));

  async function copy(text) {
    try {
      await navigator.clipboard.writeText(text);
      tell('Copied: ' + text);
    } catch (cause) {
      tell(text);  // to be marked and copied by hand
    }
  }
  get('copyCode').addEventListener('click', () =>
    copy('Eigen::VectorXd q(' + frame.q.length + ');\nq << ' + frame.q.map(String).join(', ') + ';'));
  get('copyLine').addEventListener('click', () => copy('--q ' + frame.q.map(String).join(',')));

  for (const button of document.querySelectorAll('[data-from]'))
    button.addEventListener('click', () => {
      const [fx, fy] = about && about.front || [1, 0];  // where the robot faces
      const [x, y, z] = { front: [fx, fy, 0], side: [fy, -fx, 0] }[button.dataset.from] || button.dataset.from.split(',').map(Number);
      if (y === undefined) view.resetView();
      else view.lookFrom(new THREE.Vector3(x, z + 1e-6, -y));
    });

  get('shot').addEventListener('click', () => {
    view.renderer.render(scene.current.scene, view.view);
    const from = view.renderer.domElement, picture = element('canvas'), pen = picture.getContext('2d');
    picture.width = from.width, picture.height = from.height;
    pen.fillStyle = '#f6f8fa', pen.fillRect(0, 0, picture.width, picture.height);
    pen.drawImage(from, 0, 0);
    picture.toBlob(blob => {
      const link = element('a');
      link.href = URL.createObjectURL(blob), link.download = about.title + '.png';
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 1000);
    });
  });

  // --- The mouse takes bodies.

  let mode = 'look', held = null;  // held: { body, point, plane, at }, point in the body's frame
  const handle = new THREE.Object3D(), gizmo = new THREE.TransformControls(view.view, view.renderer.domElement);
  let chosen = null;  // { body, point } where the handle is

  function setMode(next) {
    mode = next;
    stage.classList.toggle('drag', mode === 'drag');
    stage.classList.toggle('push', mode === 'push');
    for (const button of get('modes').children)
      button.setAttribute('aria-pressed', String(button.dataset.mode === mode));
    if (mode !== 'drag') choose(null);
  }
  for (const button of get('modes').children) button.addEventListener('click', () => setMode(button.dataset.mode));

  const newtonsPerMetre = () => Math.max(9.81 * (about.mass || 1), 1) / scene.current.radius;

  function rayAt(event) {
    const box = stage.getBoundingClientRect(), ray = new THREE.Raycaster();
    const x = (event.clientX - box.left) / box.width * 2 - 1, y = 1 - (event.clientY - box.top) / box.height * 2;
    ray.setFromCamera(new THREE.Vector2(x, y), view.view);
    return ray;
  }
  function hitAt(event) {
    const visible = scene.shapes.filter(shape => shape && shape.visible);
    const hit = rayAt(event).intersectObjects(visible, true).find(({ object }) => object.isMesh);
    if (!hit) return null;
    const body = about.shapes[hit.object.userData.shape].body;
    return { body, point: scene.bodies[body].worldToLocal(hit.point.clone()), at: hit.point };
  }
  function pixelOf(p) {
    const at = scene.current.world.localToWorld(new THREE.Vector3().fromArray(p)).project(view.view);
    const box = stage.getBoundingClientRect();
    return [box.left + (at.x + 1) / 2 * box.width, box.top + (1 - at.y) / 2 * box.height];
  }
  const inWorld = point => scene.current.world.worldToLocal(point.clone());  // z up

  // The handle of a program under the mouse; grasped: { name, plane, at }, at in the world.
  let grasped = null;
  function handleAt(event) {
    let nearest = null, least = 18;
    for (const one of (scene && frame && frame.asked) || []) {
      if (one.kind !== 'handle') continue;
      const [x, y] = pixelOf(one.at), distance = Math.hypot(event.clientX - x, event.clientY - y);
      if (distance < least) nearest = one, least = distance;
    }
    return nearest;
  }
  function grasp({ name, at, normal }, event) {
    const world = scene.current.world, place = world.localToWorld(new THREE.Vector3().fromArray(at));
    const across = normal.some(Boolean) ? new THREE.Vector3().fromArray(normal).transformDirection(world.matrixWorld)
      : view.view.getWorldDirection(new THREE.Vector3());
    grasped = { name, at, plane: new THREE.Plane().setFromNormalAndCoplanarPoint(across, place) };
    view.controls.enabled = false;
    stage.setPointerCapture(event.pointerId);
  }
  function moveGrasped(event) {
    const to = new THREE.Vector3();
    if (!rayAt(event).ray.intersectPlane(grasped.plane, to)) return;
    grasped.at = inWorld(to).toArray();
    send({ do: 'handle', name: grasped.name, to: grasped.at }, 'handle ' + grasped.name);
    redraw();
  }

  stage.addEventListener('pointerdown', event => {
    const near = event.button === 0 ? handleAt(event) : null;
    if (near) return grasp(near, event);
    if (mode === 'look' || event.button !== 0 || !scene || gizmo.axis !== null) return;
    const hit = hitAt(event);
    if (!hit || hit.body === 0) return;
    if (mode === 'push' && !(frame && frame.simulates)) return tell('Start the simulation to push a body.');
    if (mode === 'drag' && frame && frame.simulates) return tell('End the simulation to drag a body, or push it.');
    const normal = view.view.getWorldDirection(new THREE.Vector3());
    held = { ...hit, plane: new THREE.Plane().setFromNormalAndCoplanarPoint(normal, hit.at), to: hit.at.clone() };
    view.controls.enabled = false;
    stage.setPointerCapture(event.pointerId);
    choose(null);  // the handle would be dragged as well
    pull();
  });
  stage.addEventListener('pointermove', event => {
    if (grasped) return moveGrasped(event);
    stage.classList.toggle('grasp', Boolean(handleAt(event)));
    if (!held) return;
    const to = new THREE.Vector3();
    if (!rayAt(event).ray.intersectPlane(held.plane, to)) return;
    held.to = to;
    pull();
  });
  const release = () => {
    if (grasped) {
      grasped = null;
      view.controls.enabled = true;
    }
    if (!held) return;
    if (mode === 'drag') choose({ body: held.body, point: held.point });
    held = null;
    view.controls.enabled = true;
    send({ do: 'release' });
  };
  for (const name of ['pointerup', 'pointercancel']) stage.addEventListener(name, release);

  // Sends where the mouse pulls to; again and again, or the program lets go.
  function pull() {
    if (!held) return;
    if (mode === 'drag') return sendDrag(held, inWorld(held.to));
    const from = inWorld(scene.bodies[held.body].localToWorld(held.point.clone()));
    const force = inWorld(held.to).sub(from).multiplyScalar(newtonsPerMetre());
    send({ do: 'push', body: held.body, point: held.point.toArray(), force: force.toArray() }, 'pull');
  }
  function sendDrag({ body, point }, to, turn) {
    const event = { do: 'drag', body, point: point.toArray(), to: to.toArray() };
    if (turn) event.turn = turn.toArray();
    send(event, 'pull');
  }
  setInterval(() => {
    if (held) pull();
    else if (gizmo.dragging) pullHandle();
  }, 200);

  // A handle with arrows stays where a body was taken; t changes between moving and turning.
  gizmo.setSize(0.7);
  gizmo.setSpace('local');  // that of the handle, whose z is up
  gizmo.addEventListener('change', view.draw);
  gizmo.addEventListener('dragging-changed', event => {
    view.controls.enabled = !event.value;
    if (!event.value) send({ do: 'release' });
  });
  gizmo.addEventListener('objectChange', pullHandle);
  function pullHandle() {
    if (!chosen) return;
    sendDrag(chosen, handle.position, chosen.turn0.clone().premultiply(handle.quaternion));
  }
  function choose(next) {
    chosen = next;
    if (!next) return gizmo.detach(), gizmo.parent && gizmo.parent.remove(gizmo), view.draw();
    scene.current.world.add(handle);
    scene.current.scene.add(gizmo);
    gizmo.attach(handle);
    followHandle();
  }
  // The handle has the axes of the world whenever it is taken.
  function followHandle() {
    if (!chosen || gizmo.dragging) return;
    const body = scene.bodies[chosen.body];
    handle.position.copy(inWorld(body.localToWorld(chosen.point.clone())));
    handle.quaternion.set(0, 0, 0, 1);
    chosen.turn0 = body.quaternion.clone();
  }

  const keys = {
    1: () => setMode('look'), 2: () => setMode('drag'), 3: () => setMode('push'), Escape: () => choose(null),
    ' ': run, '.': () => send({ do: 'step' }), r: view.resetView,
    t: () => { if (chosen) gizmo.setMode(gizmo.mode === 'translate' ? 'rotate' : 'translate'); }
  };
  const whole = () => document.fullscreenElement ? document.exitFullscreen() : document.documentElement.requestFullscreen();
  get('whole').addEventListener('click', whole);
  document.addEventListener('keydown', event => {
    const isPlainKey = !event.ctrlKey && !event.altKey && !event.metaKey && !event.target.closest?.('input, select');
    if (event.key === 'f' && isPlainKey) return whole();
    if (event.ctrlKey || event.altKey || event.metaKey || !about || about.kind !== 'robot') return view.obeys(event);
    const within = what => event.target.closest && event.target.closest(what);
    const isTyped = within('input[type=number], select, textarea') || (event.key === ' ' && within('input, button'));
    const isKey = keys[event.key] && !isTyped;
    if (isKey) keys[event.key]();
    if (isKey || view.obeys(event)) event.preventDefault();
  });

  // --- The stream of frames. Browsers connect again by themselves.

  const state = get('state');
  function setState(text, isLost) {
    state.textContent = text;
    state.classList.toggle('lost', isLost);
  }
  function listen() {
    const source = new EventSource('frames');
    source.onopen = () => {
      failures = 0;
      setState(isPlain ? 'live, drawn without shadows: this browser has no graphics card' : 'live', false);
    };
    const end = () => {
      source.close();
      setState('The program has ended. Start it again and open its new address.', true);
    };
    source.addEventListener('end', end);
    let failures = 0;  // one after the other
    source.onerror = () => {
      if (source.readyState === EventSource.CLOSED || ++failures > 9) return end();
      setState('The program does not answer; waiting for it.', true);
    };
    let newest = null, isBusy = false;
    async function take() {
      if (isBusy) return;
      isBusy = true;
      while (newest) {
        const next = newest;
        newest = null;
        try {
          if (!scene || next.version !== frame.version) await load();
          frame = next;
          isStale = true;
          showFrame();
          view.draw();
        } catch (cause) {
          pieces.clear();
          if (!newest) tell('The scene cannot be shown: ' + cause.message);
        }
      }
      isBusy = false;
    }
    source.onmessage = ({ data }) => {
      newest = JSON.parse(data);
      take();
    };
  }
  listen();

  // What tests ask.
  window.rexLive = {
    frame: () => frame, frames: () => drawnFrames, firstPicture: () => firstPicture, about: () => about, scene: () => scene, view, send,
    position: i => Array.from(scene.poses.slice(7 * i, 7 * i + 3)),
    pixel: pixelOf
  };
})();
