// The 3D viewer of a report: turns each <figure class="cloud-view" data-view="ID"> into an
// interactive view of the clouds in <script type="application/json" id="ID">. A figure keeps its
// fallback pictures where WebGL is missing, and on paper. Needs the global THREE (r111).
(function () {
  'use strict';

  // Viridis without its darkest quarter, which would vanish on the dark background.
  const RAMP = ['#3b528b', '#277f8e', '#25ac82', '#7ad151', '#fde725'];
  const UNKNOWN = '#55504c';
  const BACKGROUND = '#0f1114';
  const NO_SURFACE = 255;
  const MODES = ['sensor', 'distance', 'height'];
  const CAPS_MM = [20, 50, 100, 200, 500];
  const FIELD_OF_VIEW_RAD = Math.PI / 4;
  const NEAR_RANGE_M = 30;
  const BLINK_MS = 700;

  // Positions are quantised integers in the sensor's frame; the model matrix undoes that.
  const VERTEX_SHADER = `
    attribute float gap;
    uniform float pointSize, low, high, rampLow, rampHigh, cap;
    uniform int mode;
    uniform vec3 tint, unknown, ramp[5];
    varying vec3 colour;
    vec3 rampColour(float t) {
      float s = clamp(t, 0.0, 1.0) * 4.0;
      vec3 c = mix(ramp[0], ramp[1], clamp(s, 0.0, 1.0));
      c = mix(c, ramp[2], clamp(s - 1.0, 0.0, 1.0));
      c = mix(c, ramp[3], clamp(s - 2.0, 0.0, 1.0));
      return mix(c, ramp[4], clamp(s - 3.0, 0.0, 1.0));
    }
    void main() {
      vec4 world = modelMatrix * vec4(position, 1.0);
      gl_Position = projectionMatrix * viewMatrix * world;
      if (world.z < low || world.z > high) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
      gl_PointSize = pointSize;
      colour = tint;
      if (mode == 1) colour = gap > 254.5 ? unknown : rampColour(gap / cap);
      if (mode == 2) colour = rampColour((world.z - rampLow) / (rampHigh - rampLow));
    }`;
  const FRAGMENT_SHADER = `
    varying vec3 colour;
    void main() {
      vec2 offset = gl_PointCoord - 0.5;
      if (dot(offset, offset) > 0.27) discard;
      gl_FragColor = vec4(colour, 1.0);
    }`;

  function make(tag, properties, ...children) {
    const node = Object.assign(document.createElement(tag), properties);
    node.append(...children);
    return node;
  }

  // `data-control` names a control for the style sheet and for the tests.
  function control(name, node) {
    node.dataset.control = name;
    return node;
  }

  function bytesOf(base64) {
    const text = atob(base64);
    const bytes = new Uint8Array(text.length);
    for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
    return bytes;
  }

  const metres = (value) => value.toFixed(1).replace('-', '−') + ' m';
  const limited = (value, low, high) => Math.min(Math.max(value, low), high);
  const colourOf = (css) => new THREE.Color(css);
  const vectorOf = (css) => new THREE.Vector3(...colourOf(css).toArray());

  // The largest of 1, 2 and 5 times a power of ten that does not exceed `length`.
  function roundLength(length) {
    const power = Math.pow(10, Math.floor(Math.log10(length)));
    return power * [5, 2, 1].find((digit) => digit * power <= length);
  }

  // A camera that orbits about a target, and the mouse, touch and keyboard input that moves it.
  // The angles fix the orientation directly, so that the view from straight above is not singular.
  class Orbit {
    constructor(canvas, onChange) {
      this.canvas = canvas;
      this.onChange = onChange;
      this.perspective = new THREE.PerspectiveCamera();
      this.orthographic = new THREE.OrthographicCamera(-1, 1, 1, -1, 0.1, 2000);
      this.target = new THREE.Vector3();
      this.pointers = new Map();
      this.listen();
    }

    // Angles in degrees; `radius` is half the visible length of the canvas's shorter side.
    look(azimuth, elevation, radius, isFlat, target) {
      this.azimuth = azimuth;
      this.elevation = elevation;
      this.radius = radius;
      this.isFlat = isFlat;
      this.target.copy(target);
      this.onChange();
    }

    axes() {
      const azimuth = this.azimuth * Math.PI / 180, elevation = this.elevation * Math.PI / 180;
      const right = new THREE.Vector3(-Math.sin(azimuth), Math.cos(azimuth), 0);
      const back = new THREE.Vector3(Math.cos(elevation) * Math.cos(azimuth),
        Math.cos(elevation) * Math.sin(azimuth), Math.sin(elevation));
      return {right, up: new THREE.Vector3().crossVectors(back, right), back};
    }

    halfHeight() {
      return this.radius / Math.min(1, this.canvas.clientWidth / this.canvas.clientHeight);
    }

    metresPerPixel() { return 2 * this.halfHeight() / this.canvas.clientHeight; }

    camera() {
      const {right, up, back} = this.axes();
      const aspect = this.canvas.clientWidth / this.canvas.clientHeight;
      const half = this.halfHeight();
      let camera, distance;
      if (this.isFlat) {
        camera = this.orthographic;
        distance = 1000;
        Object.assign(camera,
          {left: -half * aspect, right: half * aspect, top: half, bottom: -half});
      } else {
        camera = this.perspective;
        distance = half / Math.tan(FIELD_OF_VIEW_RAD / 2);
        Object.assign(camera, {fov: FIELD_OF_VIEW_RAD * 180 / Math.PI, aspect,
          near: distance / 100, far: distance + 1000});
      }
      camera.updateProjectionMatrix();
      camera.quaternion.setFromRotationMatrix(new THREE.Matrix4().makeBasis(right, up, back));
      camera.position.copy(this.target).addScaledVector(back, distance);
      return camera;
    }

    turn(azimuth, elevation) {
      this.azimuth += azimuth;
      this.elevation = limited(this.elevation + elevation, -90, 90);
      this.onChange();
    }

    pan(right_px, up_px) {
      const {right, up} = this.axes();
      this.target.addScaledVector(right, right_px * this.metresPerPixel())
        .addScaledVector(up, up_px * this.metresPerPixel());
      this.onChange();
    }

    zoom(factor) {
      this.radius = limited(this.radius * factor, 0.1, 300);
      this.onChange();
    }

    listen() {
      const canvas = this.canvas;
      const release = (event) => this.pointers.delete(event.pointerId);
      canvas.addEventListener('pointerdown', (event) => {
        canvas.focus({preventScroll: true});
        canvas.setPointerCapture(event.pointerId);
        this.pointers.set(event.pointerId, {x: event.clientX, y: event.clientY});
      });
      canvas.addEventListener('pointermove', (event) => this.drag(event));
      canvas.addEventListener('pointerup', release);
      canvas.addEventListener('pointercancel', release);
      canvas.addEventListener('contextmenu', (event) => event.preventDefault());
      // The wheel scrolls the page until the view has been clicked.
      canvas.addEventListener('wheel', (event) => {
        if (document.activeElement !== canvas && !event.ctrlKey) return;
        event.preventDefault();
        this.zoom(Math.exp((event.deltaMode === 1 ? 30 : 1) * event.deltaY / 600));
      }, {passive: false});
      canvas.addEventListener('keydown', (event) => {
        if (!event.ctrlKey && !event.altKey && !event.metaKey && this.press(event)) {
          event.preventDefault();
        }
      });
    }

    drag(event) {
      const last = this.pointers.get(event.pointerId);
      if (!last) return;
      const others = [...this.pointers].filter(([id]) => id !== event.pointerId);
      const dx = event.clientX - last.x, dy = event.clientY - last.y;
      if (others.length > 0) {
        const other = others[0][1];
        const before = Math.hypot(last.x - other.x, last.y - other.y);
        const after = Math.hypot(event.clientX - other.x, event.clientY - other.y);
        this.pan(-dx / 2, dy / 2);
        if (after > 0) this.zoom(before / after);
      } else if (event.shiftKey || event.buttons > 1) {
        this.pan(-dx, dy);
      } else {
        this.turn(-0.3 * dx, 0.3 * dy);
      }
      Object.assign(last, {x: event.clientX, y: event.clientY});
    }

    press(event) {
      const arrows = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]};
      const arrow = arrows[event.key];
      if (arrow && event.shiftKey) this.pan(40 * arrow[0], 40 * arrow[1]);
      else if (arrow) this.turn(5 * arrow[0], 5 * arrow[1]);
      else if (event.key === '+' || event.key === '=') this.zoom(1 / 1.15);
      else if (event.key === '-') this.zoom(1.15);
      else return false;
      return true;
    }
  }

  // The drawn objects of one sensor: its cloud, its axes, and its cloud at the rival pose.
  class Layer {
    constructor(sensor, states, common, scene) {
      this.sensor = sensor;
      this.isOn = true;
      this.isRivalOn = false;
      const s = sensor.scale_m, o = sensor.origin_m;
      this.T_sensor_quantised =
        new THREE.Matrix4().set(s, 0, 0, o[0], 0, s, 0, o[1], 0, 0, s, o[2], 0, 0, 0, 1);
      // Typed arrays have the byte order of the machine; all that run browsers are little-endian.
      this.positions = new Int16Array(bytesOf(sensor.points).buffer);
      this.poses = sensor.poses.map((pose) => pose && new THREE.Matrix4().set(...pose));
      this.count = this.positions.length / 3;
      this.gaps = states.map((name, i) => sensor.distances && sensor.distances[i]
        ? new THREE.BufferAttribute(bytesOf(sensor.distances[i]), 1) : null);
      this.noGaps =
        new THREE.BufferAttribute(new Uint8Array(this.count).fill(NO_SURFACE), 1);
      this.cloud = this.cloudOf(colourOf(sensor.colour), common, scene);
      this.axes = this.axesOf(scene);
      this.rival = null;
      if (sensor.rival) {
        this.rivalColour = colourOf(sensor.colour).lerp(colourOf('#ffffff'), 0.6);
        this.rival = this.cloudOf(this.rivalColour, common, scene);
        this.rival.geometry.setAttribute('gap', this.noGaps);
        this.rival.matrix.multiplyMatrices(
          new THREE.Matrix4().set(...sensor.rival), this.T_sensor_quantised);
      }
    }

    cloudOf(colour, common, scene) {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute('position', new THREE.BufferAttribute(this.positions, 3));
      const material = new THREE.ShaderMaterial({
        uniforms: Object.assign({tint: {value: new THREE.Vector3(...colour.toArray())}}, common),
        vertexShader: VERTEX_SHADER, fragmentShader: FRAGMENT_SHADER});
      const cloud = new THREE.Points(geometry, material);
      // Quantised integers would give wrong bounds, and few clouds are ever out of sight.
      cloud.frustumCulled = false;
      cloud.matrixAutoUpdate = false;
      scene.add(cloud);
      return cloud;
    }

    // The axes of the sensor's frame; x, the direction of view, is the longest.
    axesOf(scene) {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute('position', new THREE.BufferAttribute(
        new Float32Array([0, 0, 0, 1.2, 0, 0, 0, -0.4, 0, 0, 0.4, 0, 0, 0, -0.4, 0, 0, 0.4]), 3));
      const axes = new THREE.LineSegments(
        geometry, new THREE.LineBasicMaterial({color: colourOf(this.sensor.colour)}));
      axes.frustumCulled = false;
      axes.matrixAutoUpdate = false;
      scene.add(axes);
      return axes;
    }

    show(state) {
      const pose = this.poses[state];
      this.cloud.visible = this.axes.visible = this.isOn && Boolean(pose);
      if (this.rival) this.rival.visible = this.isRivalOn;
      if (!pose) return;
      this.axes.matrix.copy(pose);
      this.cloud.matrix.multiplyMatrices(pose, this.T_sensor_quantised);
      this.cloud.geometry.setAttribute('gap', this.gaps[state] || this.noGaps);
    }

    // Heights of a sample of the points in the level frame.
    heights(state) {
      const pose = this.poses[state];
      if (!pose) return [];
      const e = new THREE.Matrix4().multiplyMatrices(pose, this.T_sensor_quantised).elements;
      const p = this.positions, step = 3 * Math.ceil(this.count / 4000), heights = [];
      for (let i = 0; i < p.length; i += step) {
        heights.push(e[2] * p[i] + e[6] * p[i + 1] + e[10] * p[i + 2] + e[14]);
      }
      return heights;
    }
  }

  class Viewer {
    constructor(figure, data, canvas, context) {
      this.figure = figure;
      this.data = data;
      this.canvas = canvas;
      this.state = data.states.length - 1;
      this.wantedMode = 'sensor';
      this.cap_mm = CAPS_MM[2];
      this.renderer = new THREE.WebGLRenderer({canvas, context});
      this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
      this.renderer.setClearColor(BACKGROUND);
      this.scene = new THREE.Scene();
      this.common = {pointSize: {value: 1}, low: {value: -1e9}, high: {value: 1e9},
        rampLow: {value: 0}, rampHigh: {value: 1}, cap: {value: 1}, mode: {value: 0},
        unknown: {value: vectorOf(UNKNOWN)}, ramp: {value: RAMP.map(vectorOf)}};
      this.layers =
        data.sensors.map((sensor) => new Layer(sensor, data.states, this.common, this.scene));
      this.measureHeights();
      this.addRings();
      this.orbit = new Orbit(canvas, () => this.redraw());
      this.addControls();
      this.lookAround();
      this.refresh();
      new ResizeObserver(() => this.redraw()).observe(canvas);
      canvas.addEventListener('webglcontextlost', () => figure.classList.remove('live'));
      canvas.addEventListener('webglcontextrestored', () => {
        figure.classList.add('live');
        this.redraw();
      });
    }

    measureHeights() {
      const heights = [].concat(...this.layers.map((layer) => layer.heights(this.state)));
      heights.sort((a, b) => a - b);
      const at = (ratio) => heights.length ? heights[Math.floor(ratio * (heights.length - 1))] : 0;
      this.minHeight = Math.floor(at(0) - 0.5);
      this.maxHeight = Math.ceil(at(1) + 0.5);
      this.ground = at(0.02);
      this.common.rampLow.value = this.ground;
      this.common.rampHigh.value = Math.max(at(0.97), this.ground + 0.1);
    }

    // Rings of 10, 20 and 30 m on the ground, and the x axis of the level frame.
    addRings() {
      const corners = [0, 0, 0, NEAR_RANGE_M, 0, 0];
      const steps = 120;
      for (const radius of [10, 20, 30]) {
        for (let i = 0; i < steps; ++i) {
          for (const k of [i, i + 1]) {
            const angle = 2 * Math.PI * k / steps;
            corners.push(radius * Math.cos(angle), radius * Math.sin(angle), 0);
          }
        }
      }
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(corners), 3));
      this.rings = new THREE.LineSegments(
        geometry, new THREE.LineBasicMaterial({color: colourOf('#353b44')}));
      this.rings.position.z = this.ground;
      this.scene.add(this.rings);
    }

    // Draws at the next frame, once, however many changes there were.
    redraw() {
      if (this.isScheduled) return;
      this.isScheduled = true;
      requestAnimationFrame(() => {
        this.isScheduled = false;
        this.draw();
      });
    }

    draw() {
      const width = this.canvas.clientWidth, height = this.canvas.clientHeight;
      if (width === 0 || height === 0) return;
      const size = this.renderer.getSize(new THREE.Vector2());
      if (size.x !== width || size.y !== height) this.renderer.setSize(width, height, false);
      // Points grow in close-ups, where few remain and the rings would be in the way.
      const growth = limited(Math.pow(0.6 * NEAR_RANGE_M / this.orbit.radius, 0.4), 0.8, 2.5);
      this.common.pointSize.value =
        this.pointSize.valueAsNumber * growth * this.renderer.getPixelRatio();
      this.rings.visible = this.orbit.radius > 8;
      this.renderer.render(this.scene, this.orbit.camera());
      this.drawScale();
      if (!this.hasDrawn) performance.mark('first picture of ' + this.figure.dataset.view);
      this.hasDrawn = true;
    }

    // Lengths on the screen mean something only without perspective.
    drawScale() {
      this.scale.hidden = !this.orbit.isFlat;
      const length = roundLength(this.canvas.clientWidth * this.orbit.metresPerPixel() / 4);
      this.scale.style.width = length / this.orbit.metresPerPixel() + 'px';
      this.scale.textContent = length < 1 ? Math.round(1000 * length) + ' mm' : length + ' m';
    }

    lookAround() {
      this.orbit.look(-155, 38, 0.6 * NEAR_RANGE_M, false,
        new THREE.Vector3(4, 0, this.ground));
    }

    views() {
      const origin = new THREE.Vector3(0, 0, this.ground + 5);
      const flat = (azimuth, elevation, radius, target) =>
        () => this.orbit.look(azimuth, elevation, radius, true, target);
      const closeups = (this.data.closeups || []).map((closeup, i) =>
        [`${i + 1} ${closeup.title}`,
          flat(-90, 90, closeup.half_width_m, new THREE.Vector3(...closeup.centre_m))]);
      return [['3D', () => this.lookAround()], ['above', flat(-90, 90, NEAR_RANGE_M, origin)],
        ['front', flat(0, 0, 10, origin)], ['side', flat(-90, 0, 10, origin)], ...closeups];
    }

    addControls() {
      this.canvas.tabIndex = 0;
      this.canvas.setAttribute('role', 'application');
      this.canvas.setAttribute('aria-label', '3D view of the clouds. Arrow keys turn it, with ' +
        'Shift they move it, plus and minus zoom.');
      this.scale = make('div', {className: 'viewer-scale', hidden: true});
      this.root = make('div', {className: 'viewer'}, this.viewBar(),
        make('div', {className: 'viewer-stage'}, this.canvas, this.scale), this.stepBar(),
        make('div', {className: 'viewer-panel'}, this.sensorControls(), this.colourControls(),
          this.shapeControls(),
          make('p', {className: 'viewer-hint', textContent: 'Drag or arrow keys: turn. Shift or ' +
            'right button: move. Click, then wheel, or + and −: zoom.'})));
      this.figure.querySelector('figcaption').after(this.root);
      this.figure.classList.add('live');
    }

    viewBar() {
      const bar = make('div', {className: 'viewer-bar'});
      for (const [name, look] of this.views()) {
        const button = make('button', {type: 'button', textContent: name, onclick: look});
        bar.append(control('view', button));
      }
      const full = control('full', make('button', {type: 'button', textContent: 'full screen'}));
      full.hidden = !document.fullscreenEnabled;
      full.onclick = () => document.fullscreenElement ? document.exitFullscreen()
        : this.root.requestFullscreen();
      bar.append(full);
      return bar;
    }

    stepBar() {
      const {states} = this.data;
      const last = states.length - 1;
      this.slider = control('state', make('input',
        {type: 'range', min: 0, max: last, step: 1, value: this.state}));
      this.slider.oninput = () => {
        this.blink(false);
        this.go(this.slider.valueAsNumber);
      };
      this.stateName = make('output', {});
      this.blinkButton = control('blink', make('button', {type: 'button', textContent: 'blink',
        title: `Alternates between “${states[0]}” and “${states[last]}”`}));
      this.blinkButton.setAttribute('aria-pressed', 'false');
      this.blinkButton.onclick = () => {
        const isStill = window.matchMedia('(prefers-reduced-motion: reduce)').matches;
        if (isStill) this.go(this.state === last ? 0 : last);
        else this.blink(!this.timer);
      };
      const bar = make('div', {className: 'viewer-steps'},
        make('label', {}, 'step', this.slider), this.stateName, this.blinkButton);
      bar.hidden = last === 0;
      return bar;
    }

    blink(isOn) {
      clearInterval(this.timer);
      const last = this.data.states.length - 1;
      const flip = () => this.go(this.state === last ? 0 : last);
      this.timer = isOn ? setInterval(flip, BLINK_MS) : null;
      this.blinkButton.setAttribute('aria-pressed', String(isOn));
      if (isOn) flip();
    }

    go(state) {
      this.state = state;
      this.refresh();
    }

    group(title, ...children) {
      return make('fieldset', {}, make('legend', {textContent: title}), ...children);
    }

    sensorControls() {
      const group = this.group('sensors');
      const add = (name, label, colour, isOn, change) => {
        const box = control(name, make('input', {type: 'checkbox', checked: isOn}));
        box.onchange = () => {
          change(box.checked);
          this.refresh();
        };
        const swatch = make('span', {className: 'swatch'});
        swatch.style.backgroundColor = colour;
        const note = make('small', {});
        group.append(make('label', {className: name}, box, swatch, label, note));
        return note;
      };
      for (const layer of this.layers) {
        const {name, colour} = layer.sensor;
        layer.note = add('sensor', name, colour, true, (isOn) => { layer.isOn = isOn; });
        if (!layer.rival) continue;
        add('rival', 'its rival', layer.rivalColour.getStyle(), false,
          (isOn) => { layer.isRivalOn = isOn; });
      }
      return group;
    }

    colourControls() {
      this.modeButtons = MODES.map((mode) => {
        const radio = control('colour', make('input',
          {type: 'radio', name: 'colour of ' + this.figure.dataset.view, value: mode}));
        radio.onchange = () => {
          this.wantedMode = mode;
          this.refresh();
        };
        return radio;
      });
      const largest_mm = 254 * this.data.distance_unit_m * 1000;
      const caps = CAPS_MM.filter((cap_mm) => cap_mm <= largest_mm * 1.01);
      if (caps.length === 0) caps.push(Math.round(largest_mm));
      if (!caps.includes(this.cap_mm)) this.cap_mm = caps[caps.length - 1];
      const options = caps.map((cap_mm) => make('option',
        {value: cap_mm, textContent: `≥ ${cap_mm} mm`, selected: cap_mm === this.cap_mm}));
      this.capChoice = control('cap', make('select', {}, ...options));
      this.capChoice.setAttribute('aria-label', 'Distance at the end of the colour scale');
      this.capChoice.onchange = () => {
        this.cap_mm = Number(this.capChoice.value);
        this.refresh();
      };
      const bar = make('div', {className: 'ramp'});
      bar.style.backgroundImage = `linear-gradient(to right, ${RAMP.join(', ')})`;
      const swatch = make('span', {className: 'swatch'});
      swatch.style.backgroundColor = UNKNOWN;
      this.rampLowText = make('span', {});
      this.rampHighText = make('span', {});
      this.unknownNote = make('div', {className: 'unknown'}, swatch, 'no surface nearby');
      this.legend = make('div', {className: 'legend'}, bar, make('div', {className: 'ends'},
        this.rampLowText, this.rampHighText, this.capChoice), this.unknownNote);
      const labels = this.modeButtons.map((radio) => make('label', {}, radio, 'by ' + radio.value));
      return this.group('colour', ...labels, this.legend);
    }

    shapeControls() {
      const slider = (name, label, properties, change) => {
        const input = control(name, make('input', Object.assign({type: 'range'}, properties)));
        const output = make('output', {});
        const update = () => {
          output.textContent = change(input);
          this.redraw();
        };
        input.oninput = update;
        update();
        return make('label', {className: 'slide'}, make('span', {}, label), input, output);
      };
      const size = slider('size', 'point size', {min: 1, max: 6, step: 0.5, value: 2},
        (input) => { this.pointSize = input; return input.value + ' px'; });
      // The ends of the sliders mean "no limit", because the range is that of a sample.
      const {minHeight, maxHeight} = this;
      const range = {min: minHeight, max: maxHeight, step: 0.1};
      const low = slider('low', 'z from', Object.assign({}, range, {value: minHeight}), (input) => {
        const value = input.valueAsNumber;
        this.common.low.value = value <= minHeight ? -1e9 : value;
        return metres(value);
      });
      const high = slider('high', 'z to', Object.assign({}, range, {value: maxHeight}), (input) => {
        const value = input.valueAsNumber;
        this.common.high.value = value >= maxHeight ? 1e9 : value;
        return metres(value);
      });
      const group = this.group('points', size, low, high);
      if (this.data.frame_note) group.title = 'z: ' + this.data.frame_note;
      return group;
    }

    // Makes the picture and the controls agree with the state.
    refresh() {
      const {states} = this.data;
      const hasGaps = this.layers.some((layer) => layer.gaps[this.state]);
      const mode = this.wantedMode === 'distance' && !hasGaps ? 'sensor' : this.wantedMode;
      this.common.mode.value = MODES.indexOf(mode);
      this.common.cap.value = this.cap_mm / 1000 / this.data.distance_unit_m;
      for (const layer of this.layers) {
        layer.show(this.state);
        layer.note.textContent = layer.poses[this.state]
          ? (layer.sensor.role === 'accepted' ? '' : layer.sensor.role) : 'no pose in this step';
      }
      this.slider.value = this.state;
      this.slider.setAttribute('aria-valuetext', states[this.state]);
      this.stateName.textContent = `${this.state + 1}/${states.length} ${states[this.state]}`;
      for (const radio of this.modeButtons) {
        radio.checked = radio.value === mode;
        radio.disabled = radio.value === 'distance' && !hasGaps;
        radio.parentNode.title = radio.disabled ? 'Distances are not stored for this step' : '';
      }
      this.legend.hidden = mode === 'sensor';
      this.capChoice.hidden = this.unknownNote.hidden = mode !== 'distance';
      this.rampHighText.hidden = mode === 'distance';
      this.rampLowText.textContent =
        mode === 'distance' ? '0 mm' : metres(this.common.rampLow.value);
      this.rampHighText.textContent = metres(this.common.rampHigh.value);
      this.redraw();
    }
  }

  function note(figure, text) {
    figure.querySelector('figcaption').after(make('p', {className: 'note', textContent: text}));
  }

  function start(figure) {
    const canvas = document.createElement('canvas');
    // Asking for the context here avoids the error that three.js logs where WebGL is missing. A
    // preserved buffer lets "Save image" of the browser save the picture.
    const context = canvas.getContext('webgl', {antialias: true, preserveDrawingBuffer: true});
    if (!context) {
      note(figure, 'WebGL is not available in this browser: pictures instead of the 3D view.');
      return;
    }
    try {
      const text = document.getElementById(figure.dataset.view).textContent;
      new Viewer(figure, JSON.parse(text), canvas, context);
    } catch (error) {
      const viewer = figure.querySelector('.viewer');
      if (viewer) viewer.remove();
      figure.classList.remove('live');
      note(figure, 'The 3D view could not be shown: pictures instead.');
      console.error(error);
    }
  }

  // The first view starts as soon as the page has been painted. The others start when they come
  // near, because browsers limit the number of WebGL contexts.
  const figures = [...document.querySelectorAll('figure.cloud-view[data-view]')];
  requestAnimationFrame(() => setTimeout(() => figures.slice(0, 1).forEach(start)));
  const observer = new IntersectionObserver((entries) => {
    for (const entry of entries.filter((each) => each.isIntersecting)) {
      observer.unobserve(entry.target);
      start(entry.target);
    }
  }, {rootMargin: '300px'});
  figures.slice(1).forEach((figure) => observer.observe(figure));
})();
