'use strict';
// Shows a scene: a GLB whose extras say what glTF has no words for. Replays and the live page stand on it.
const rexStage = (function () {
  function bytesOf(base64) {
    const text = atob(base64), bytes = new Uint8Array(text.length);
    for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
    return bytes.buffer;
  }

  // The screen colours of the film, squared: light is added to these, and the root of the sum is shown.
  const squaredParts = parts => new THREE.Color().fromArray(parts.map(part => part * part));
  const squared = c => { const s = c.clone().convertLinearToSRGB(); return s.multiply(s); };
  const squaredCss = css => { const s = new THREE.Color(css); return s.multiply(s); };

  const lightVertex = `
    #include <common>
    #include <shadowmap_pars_vertex>
    uniform float shadowTexel;
    uniform vec3 toLight;
    varying vec3 worldPoint, worldNormal;
    void main() {
      vec3 transformed = position;
      worldNormal = normalize((vec4(normalMatrix * normal, 0.0) * viewMatrix).xyz);
      worldPoint = (modelMatrix * vec4(transformed, 1.0)).xyz;
      // Off the surface to the side of the light, or it would shade itself.
      float side = sign(dot(worldNormal, toLight));
      vec4 worldPosition = vec4(worldPoint + 1.5 * shadowTexel * side * worldNormal, 1.0);
      #include <shadowmap_vertex>
      gl_Position = projectionMatrix * viewMatrix * vec4(worldPoint, 1.0);
    }`;
  const lightFragment = `
    #include <common>
    #include <packing>
    #include <bsdfs>
    #include <lights_pars_begin>
    #include <shadowmap_pars_fragment>
    #include <shadowmask_pars_fragment>
    uniform vec3 toLight;
    varying vec3 worldPoint, worldNormal;
    vec3 diffuseLight(vec3 n, float sun) {
      return mix(vec3(0.27, 0.26, 0.25), vec3(0.50, 0.52, 0.55), 0.5 + 0.5 * n.y) + vec3(0.66, 0.65, 0.62) * sun;
    }`;
  const solidFragment = lightFragment + `
    uniform vec3 albedo;
    uniform float alpha;
    void main() {
      vec3 n = normalize(gl_FrontFacing ? worldNormal : -worldNormal);
      float facing = dot(n, toLight);
      float sun = facing > 0.0 ? facing * getShadowMask() : 0.0;
      float shine = pow(max(dot(n, normalize(toLight + normalize(cameraPosition - worldPoint))), 0.0), 32.0);
      gl_FragColor = vec4(sqrt(albedo * diffuseLight(n, sun) + 0.12 * shine * sun), alpha);
    }`;
  // The checker is the product of two square waves, each averaged over a pixel.
  const groundFragment = lightFragment + `
    uniform vec3 light, dark, skyTop, skyBottom;
    uniform vec2 middle;
    uniform float cell, radius, height;
    vec2 rise(vec2 x) { return 1.0 - abs(2.0 * fract(0.5 * x) - 1.0); }
    void main() {
      vec2 x = vec2(worldPoint.x, -worldPoint.z) / cell;
      vec2 width = max(abs(dFdx(x)) + abs(dFdy(x)), 0.001);
      vec2 wave = (rise(x + 0.5 * width) - rise(x - 0.5 * width)) / width;
      vec3 albedo = mix(dark, light, 0.5 + 0.5 * wave.x * wave.y);
      vec3 lit = albedo * diffuseLight(vec3(0, 1, 0), max(toLight.y, 0.0) * getShadowMask());
      float far = smoothstep(0.3, 1.0, distance(vec2(worldPoint.x, -worldPoint.z), middle) / radius);
      gl_FragColor = vec4(sqrt(mix(lit, mix(skyBottom, skyTop, gl_FragCoord.y / height), far)), 1);
    }`;
  const discVertex = `
    uniform float size;
    void main() {
      gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
      gl_Position.z -= 0.002 * gl_Position.w;
      gl_PointSize = size + 1.0;
    }`;
  const discFragment = `
    uniform float size, alpha;
    uniform vec3 color;
    void main() {
      float covered = clamp(0.5 * size + 0.5 - (size + 1.0) * distance(gl_PointCoord, vec2(0.5)), 0.0, 1.0);
      gl_FragColor = vec4(color, alpha * covered);
    }`;
  const hiddenOpacity = 0.25;

  // Whether the processor draws in place of a graphics card, at a tenth of its speed.
  function isSoftware() {
    const gl = document.createElement('canvas').getContext('webgl');
    const names = gl && gl.getExtension('WEBGL_debug_renderer_info');
    const name = names ? gl.getParameter(names.UNMASKED_RENDERER_WEBGL) : '';
    return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
  }

  // Shows scenes in `stage`, an element whose data say the background. Calls beforeDraw(now) before each picture.
  // `isPlain`: without shadows and smooth edges, which take longest.
  function open(stage, beforeDraw, isPlain = false) {
    // The background of the picture, which mixes squares of colours, as steps from top to bottom.
    const partsOf = name => stage.dataset[name].split(' ').map(Number);
    const backgroundTop = partsOf('top'), backgroundBottom = partsOf('bottom'), steps = [];
    for (let share = 0; share <= 1; share += 1 / 16) {
      const part = (top, k) => 255 * Math.sqrt(top * top * (1 - share) + backgroundBottom[k] ** 2 * share);
      steps.push('rgb(' + backgroundTop.map(part).map(Math.round) + ')');
    }
    stage.style.background = 'linear-gradient(' + steps + ')';

    const renderer = new THREE.WebGLRenderer({ antialias: !isPlain, alpha: true });
    stage.appendChild(renderer.domElement);
    const view = new THREE.PerspectiveCamera();
    const controls = new THREE.OrbitControls(view, renderer.domElement);
    controls.enableKeys = false;
    renderer.domElement.tabIndex = -1;  // one stop for the tabulator is enough: the stage
    controls.screenSpacePanning = true;
    controls.addEventListener('change', draw);
    let isFirstView = true;  // until the user turns it
    let fitted = null;  // size and direction of the scene that this view was made for
    controls.addEventListener('start', () => { isFirstView = false; });
    renderer.shadowMap.enabled = !isPlain;
    renderer.shadowMap.type = THREE.PCFSoftShadowMap;
    const shared = {
      toLight: { value: null }, shadowTexel: { value: 0 }, height: { value: 1 },
      skyTop: { value: squaredParts(backgroundTop) }, skyBottom: { value: squaredParts(backgroundBottom) },
      resolution: { value: new THREE.Vector2(1, 1) }
    };
    let current = null;  // what load() has put there
    let quality = 1;

    // Shows this scene instead of the one before. `room`: how far things may move, in sizes of the scene.
    async function load(gltf, room) {
      const scene = new THREE.Scene(), world = gltf.scene.getObjectByName('world'), film = world.userData;
      scene.add(gltf.scene);
      scene.updateMatrixWorld(true);
      const inWorld = p => new THREE.Vector3(p[0], p[1], p[2]).applyMatrix4(world.matrixWorld);
      const toLight = inWorld(film.toLight), target = inWorld(film.target);
      const corner = i => inWorld([0, 1, 2].map(k => (i >> k & 1 ? film.high : film.low)[k]));
      const corners = [0, 1, 2, 3, 4, 5, 6, 7].map(corner);
      const center = corners[0].clone().lerp(corners[7], 0.5), radius = Math.max(center.distanceTo(corners[0]), 1e-3);
      shared.toLight.value = toLight;
      const sized = [];  // uniforms of sizes in pixels, with the size at one pixel per point

      function lit(fragmentShader, own, opacity) {
        const material = new THREE.ShaderMaterial({
          uniforms: THREE.UniformsUtils.merge([THREE.UniformsLib.lights, own]), vertexShader: lightVertex,
          fragmentShader, lights: true, transparent: opacity < 1, depthWrite: opacity >= 1
        });
        material.extensions.derivatives = true;
        for (const name of Object.keys(shared)) material.uniforms[name] = shared[name];
        return material;
      }

      const solids = new Map();
      function solidMaterial(from) {
        if (!solids.has(from)) {
          // The far and near side of a translucent thing together have its opacity.
          const opacity = from.side === THREE.DoubleSide ? 1 - Math.sqrt(1 - from.opacity) : from.opacity;
          const own = { albedo: { value: squared(from.color) }, alpha: { value: opacity } };
          const material = lit(solidFragment, own, opacity);
          material.side = from.side;
          solids.set(from, material);
        }
        return solids.get(from);
      }

      function groundMaterial(mesh, data) {
        const at = new THREE.Vector3().setFromMatrixPosition(mesh.matrixWorld);
        mesh.geometry.computeBoundingBox();
        return lit(groundFragment, {
          light: { value: squaredCss(data.light) }, dark: { value: squaredCss(data.dark) }, cell: { value: data.cell },
          middle: { value: new THREE.Vector2(at.x, -at.z) }, radius: { value: mesh.geometry.boundingBox.max.x }
        }, 1);
      }

      // Lines and points are drawn twice: what solids hide of them shows through faintly. Later ones lie on top.
      function addTwice(object, order, build) {
        for (const hidden of [false, true]) {
          const part = build(hidden, object.material.opacity * (hidden ? hiddenOpacity : 1));
          part.renderOrder = hidden ? 1 : 2 + order;
          part.frustumCulled = false;
          part.material.transparent = true;
          part.material.depthWrite = false;
          part.material.depthFunc = hidden ? THREE.GreaterDepth : THREE.LessEqualDepth;
          object.add(part);
        }
        object.material.visible = false;
      }

      function addLine(object, width, order) {
        const from = object.geometry.attributes.position, points = [];
        for (let i = 0; i < from.count; ++i) points.push(from.getX(i), from.getY(i), from.getZ(i));
        const [Geometry, Line] = object.isLineSegments ? [THREE.LineSegmentsGeometry, THREE.LineSegments2] :
          [THREE.LineGeometry, THREE.Line2];
        const geometry = new Geometry().setPositions(points);
        addTwice(object, order, (hidden, opacity) => {
          const material = new THREE.LineMaterial({ opacity });
          material.uniforms.diffuse.value = object.material.color.clone().convertLinearToSRGB();
          material.uniforms.resolution = shared.resolution;
          material.polygonOffset = true, material.polygonOffsetFactor = -2, material.polygonOffsetUnits = -200;
          sized.push({ uniform: material.uniforms.linewidth, size: width });
          return new Line(geometry, material);
        });
      }

      function addDiscs(object, size, order) {
        addTwice(object, order, (hidden, alpha) => {
          const color = object.material.color.clone().convertLinearToSRGB();
          const material = new THREE.ShaderMaterial({
            uniforms: { size: { value: 1 }, alpha: { value: alpha }, color: { value: color } },
            vertexShader: discVertex, fragmentShader: discFragment
          });
          sized.push({ uniform: material.uniforms.size, size });
          return new THREE.Points(object.geometry, material);
        });
      }

      // What glTF cannot say: the look of our pictures, widths of lines, texts.
      const parser = gltf.parser, texts = [];
      const nodes = await Promise.all(parser.json.nodes.map((unused, i) => parser.getDependency('node', i)));
      const isNode = new Set(nodes);
      nodes.forEach((node, order) => {
        const data = node.userData;
        for (const part of [node].concat(node.children.filter(child => !isNode.has(child)))) {
          if (part.isLine) addLine(part, part.userData.width, order);
          else if (part.isPoints) addDiscs(part, part.userData.size, order);
          else if (part.isMesh) {
            part.castShadow = data.cell === undefined && part.material.opacity >= 1;
            part.receiveShadow = true;
            part.material = data.cell === undefined ? solidMaterial(part.material) : groundMaterial(part, data);
          }
        }
        if (data.label !== undefined || data.caption !== undefined) texts.push(textOf(node, data));
      });

      function textOf(object, data) {
        const element = document.createElement('div');
        element.className = 'text';
        element.textContent = data.label !== undefined ? data.label : data.caption;
        element.style.color = data.color || '#1a1a1f';
        element.style.setProperty('--scale', data.textScale || 1);
        if (data.caption === undefined) stage.appendChild(element);
        else captionCorner(data.corner).appendChild(element);
        return { object, element, below: data.below || 0, fixed: data.caption !== undefined };
      }

      function captionCorner(name) {
        const known = stage.querySelector('.corner.' + name.replace(' ', '.'));
        if (known) return known;
        const element = document.createElement('div');
        element.className = 'corner ' + name;
        return stage.appendChild(element);
      }

      const camera = gltf.cameras[0], home = camera.parent.localToWorld(camera.position.clone());
      Object.assign(view, { fov: camera.fov, near: camera.near, far: camera.far * 4 });
      controls.minDistance = 0.05 * radius;
      controls.maxDistance = 20 * radius;
      const sun = new THREE.DirectionalLight(0xffffff, 1), reach = 1.05 * radius * room;
      sun.position.copy(center).addScaledVector(toLight, 3 * reach);
      sun.target.position.copy(center);
      sun.castShadow = !isPlain;
      sun.shadow.mapSize.set(2048 * quality, 2048 * quality);
      const box = { left: -reach, right: reach, bottom: -reach, top: reach, near: reach, far: 20 * reach };
      Object.assign(sun.shadow.camera, box);
      shared.shadowTexel.value = 2 * reach / (2048 * quality);
      scene.add(sun, sun.target);
      clear();
      current = { scene, world, parser, nodes, texts, sized, corners, target, home, radius, sun, reach };
      setSize();
      keepView();
      return current;
    }

    function clear() {
      if (!current) return;
      for (const { element } of current.texts) element.remove();
      current.scene.traverse(object => {
        if (object.geometry) object.geometry.dispose();
        if (object.material && object.material.dispose) object.material.dispose();
        if (object.shadow && object.shadow.map) object.shadow.map.dispose();
      });
    }

    // The film's camera fits a picture of 4 : 3; a narrower one needs more distance.
    function resetView() {
      isFirstView = true;
      fitted = { arm: current.home.clone().sub(current.target), radius: current.radius };
      stepBack(current.target, fitted.arm);
    }

    function stepBack(target, arm) {
      const isSeen = corner => Math.max(...corner.clone().project(view).toArray().slice(0, 2).map(Math.abs)) < 0.99;
      controls.target.copy(target);
      for (let distance = 1; distance < 20; distance *= 1.03) {
        view.position.copy(target).addScaledVector(arm, distance);
        controls.update();
        view.updateMatrixWorld();
        if (current.corners.every(isSeen)) break;
      }
      draw();
    }

    // A scene much like the last one, as of a robot that moves on, only lets the view step back until all is seen: it would
    // sway otherwise, and handles could not be grasped.
    function keepView() {
      const { home, target, radius } = current;
      const isLike = fitted && fitted.arm.angleTo(home.clone().sub(target)) < 1e-3 && Math.abs(Math.log2(radius / fitted.radius)) < 1;
      if (isFirstView && !isLike) resetView();
      else if (isFirstView) stepBack(controls.target.clone(), view.position.clone().sub(controls.target));
      else draw();
    }

    // Looks at the scene from this direction, of three.js, as far away as now.
    function lookFrom(direction) {
      const distance = view.position.distanceTo(controls.target);
      isFirstView = false;
      view.position.copy(controls.target).addScaledVector(direction.clone().normalize(), distance);
      controls.update();
      draw();
    }

    // Moves camera, light and all that the first view aims at by this vector, of three.js.
    function moveBy(way) {
      const { target, home, corners, sun } = current;
      for (const point of [controls.target, view.position, target, home, sun.position, sun.target.position, ...corners])
        point.add(way);
      sun.target.updateMatrixWorld();
      controls.update();
    }

    function placeTexts() {
      const width = stage.clientWidth, height = stage.clientHeight, at = new THREE.Vector3();
      for (const { object, element, below, fixed } of current.texts) {
        let shown = true;
        for (let o = object; o; o = o.parent) shown = shown && o.visible;
        if (!fixed && shown) {
          at.setFromMatrixPosition(object.matrixWorld).project(view);
          shown = at.z < 1 && Math.abs(at.x) < 1 && Math.abs(at.y) < 1;
          const x = (at.x + 1) / 2 * width, y = (1 - at.y) / 2 * height + below;
          const left = x + 8 + element.offsetWidth > width ? x - 8 - element.offsetWidth : x + 8;
          const top = y - element.offsetHeight / 2;
          element.style.transform = 'translate(' + left.toFixed(1) + 'px,' + top.toFixed(1) + 'px)';
        }
        if (fixed) element.hidden = !shown;
        else element.style.visibility = shown ? 'visible' : 'hidden';
      }
    }

    let asked = false;
    function draw() {
      if (!asked) requestAnimationFrame(drawNow);
      asked = true;
    }
    function drawNow(now) {
      asked = false;
      if (!current) return;
      beforeDraw(now);
      renderer.render(current.scene, view);
      placeTexts();
    }

    function setSize() {
      const ratio = quality * Math.min(window.devicePixelRatio || 1, 2), size = new THREE.Vector2();
      renderer.setPixelRatio(ratio);
      renderer.setSize(stage.clientWidth, stage.clientHeight, false);
      renderer.getDrawingBufferSize(size);
      shared.height.value = size.y;
      shared.resolution.value.copy(size);
      for (const { uniform, size: pixels } of current.sized) uniform.value = pixels * ratio;
      view.aspect = stage.clientWidth / stage.clientHeight;
      view.updateProjectionMatrix();
    }
    function resize() {
      if (!current) return;
      setSize();
      if (isFirstView) resetView();
      else draw();
    }

    // 1 is the best; less draws fewer pixels, faster where no graphics card does it.
    function setQuality(next) {
      quality = next;
      const { sun, reach } = current;
      sun.shadow.mapSize.set(2048 * quality, 2048 * quality);
      if (sun.shadow.map) sun.shadow.map.dispose();
      sun.shadow.map = null;
      shared.shadowTexel.value = 2 * reach / (2048 * quality);
      setSize();
      draw();
    }

    // Turns the view as a drag does.
    function orbit(sideways, upwards, nearer) {
      const arm = view.position.clone().sub(controls.target), way = new THREE.Spherical().setFromVector3(arm);
      way.theta += sideways, way.phi += upwards, way.radius *= nearer;
      way.makeSafe();
      isFirstView = false;
      view.position.copy(controls.target).add(arm.setFromSpherical(way));
      controls.update();
      draw();
    }
    const turns = {
      ArrowLeft: [-0.1, 0, 1], ArrowRight: [0.1, 0, 1], ArrowUp: [0, -0.1, 1], ArrowDown: [0, 0.1, 1],
      '+': [0, 0, 0.9], '=': [0, 0, 0.9], '-': [0, 0, 1 / 0.9]
    };
    // Whether this key, pressed in the stage, turned the view.
    function obeys(event) {
      if (!stage.contains(event.target) || !turns[event.key]) return false;
      orbit.apply(null, turns[event.key]);
      return true;
    }

    window.addEventListener('resize', resize);
    renderer.domElement.addEventListener('webglcontextrestored', draw);
    return { renderer, view, controls, load, draw, resize, resetView, lookFrom, moveBy, obeys, setQuality };
  }

  const parse = glb => new Promise((resolve, reject) => new THREE.GLTFLoader().parse(glb, '', resolve, reject));
  return { bytesOf, isSoftware, open, parse };
})();
