// The picture in space: camera, light, and the robot with its ghosts and the trace of its hand.

import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

import { add, norm, subtract } from "./kinematics.js";
import { Labels } from "./labels.js";
import { Solids, ball, tube } from "./solids.js";

const AXES = { light: { x: "#c94f00", y: "#00835f", z: "#0067a8" }, dark: { x: "#ff8a3d", y: "#2fd3a0", z: "#63b8f5" } };
const THEMES = {
  light: {
    ...AXES.light, ink: "#222222", soft: "#7d858f", link: "#dbe1e8", joint: "#6f8fb3", hand: "#566270", base: "#b4bdc7",
    lit: "#f0a30a", trace: "#b0307a", ahead: "#d9a8c4", ghost: "#9fb4cc", chosen: "#e69f00", grid: "#c9d0d8",
    low: "#0067a8", high: "#3fae9a", speed: "#7b5bb5", lost: "#c2185b", limit: "#8a939e", plate: "#c3d0de",
  },
  dark: {
    ...AXES.dark, ink: "#f0f0f0", soft: "#8f98a3", link: "#b9c2cc", joint: "#5d83ad", hand: "#d5dbe2", base: "#626d79",
    lit: "#ffb627", trace: "#ff7cc0", ahead: "#6e4a60", ghost: "#8ba3bd", chosen: "#ffb627", grid: "#39414a",
    low: "#4d9be6", high: "#5fe0b8", speed: "#b79cf0", lost: "#ff6f9f", limit: "#7d8894", plate: "#7f93a8",
  },
};
const FIELD = 28; // degrees
const CORNER = (width) => ({ x: width - 58, y: 24, w: 116, h: 48 }); // where the buttons are: no label goes there
const FILLED = 0.84; // share of the picture that the robot takes: labels need the rest

// Each point of the screen takes the colour of one ghost only: those that coincide would add up to a solid one.
const GHOST = {
  transparent: true, opacity: 0.34, depthWrite: false, roughness: 0.7,
  stencilWrite: true, stencilRef: 1, stencilFunc: THREE.NotEqualStencilFunc, stencilZPass: THREE.ReplaceStencilOp,
};

const TRAIL = 600; // points of the hand's way that are kept

export class View {
  /** `picture` tells what is drawn in a posture q (see picture.js and parallel.js), `show` what of it is wanted. */
  constructor(stage, picture, show, handlers) {
    this.stage = stage;
    this.picture = picture;
    this.show = show;
    this.q = picture.start;
    this.lit = null;
    this.ghosts = [];
    this.trace = { points: [], done: 0 };
    this.pieces = [];
    this.trail = [];
    this.step = null; // {row, share}: the moves of a row under way
    this.renderer = new THREE.WebGLRenderer({ antialias: true, alpha: true, stencil: true, preserveDrawingBuffer: true });
    this.renderer.shadowMap.enabled = true;
    this.canvas = this.renderer.domElement;
    stage.prepend(this.canvas);
    this.labels = new Labels(stage.querySelector(".labels"));
    this.grip = stage.querySelector(".grip");
    this.scene = new THREE.Scene();
    this.front = new THREE.Scene(); // frames and lengths, which no body hides
    this.renderer.autoClear = false;
    this.renderer.setClearColor("#000000", 0);
    this.camera = new THREE.PerspectiveCamera(FIELD, 1, 0.01 * this.picture.unit, 60 * this.picture.unit);
    this.camera.up.set(0, 0, 1);
    this.#light();
    this.arm = this.#add(new Solids(new THREE.MeshStandardMaterial({ roughness: 0.55, metalness: 0.05 })));
    this.axes = this.#add(new Solids(new THREE.MeshBasicMaterial()));
    this.lines = new Solids(new THREE.MeshBasicMaterial());
    this.front.add(this.lines);
    [this.ahead, this.drawn, this.tip] = [0, 1, 2].map(() => this.#add(new Solids(new THREE.MeshBasicMaterial()))); // of the path
    this.trailed = this.#add(new Solids(new THREE.MeshBasicMaterial()));
    this.speeds = this.#add(new Solids(new THREE.MeshStandardMaterial({ transparent: true, opacity: 0.4, roughness: 0.8, depthWrite: false })));
    this.speeds.renderOrder = 4;
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.enableZoom = false; // until the picture has the focus: the wheel belongs to the page
    this.controls.enablePan = false;
    this.controls.addEventListener("change", () => this.draw());
    this.canvas.style.touchAction = "pan-y";
    this.#listen(handlers);
    if (picture.cloud?.length) this.#spread(picture.cloud);
  }

  #add(object) {
    this.scene.add(object);
    return object;
  }

  #light() {
    const { unit, drop } = this.picture;
    this.#add(new THREE.HemisphereLight("#ffffff", "#aab2bd", 2.1));
    const sun = this.#add(new THREE.DirectionalLight("#ffffff", 2.2));
    sun.position.set(-0.8 * unit, -1.1 * unit, 2.2 * unit);
    sun.castShadow = true;
    sun.shadow.mapSize.set(1024, 1024);
    sun.shadow.radius = 5;
    sun.shadow.bias = -0.0005;
    Object.assign(sun.shadow.camera, { left: -1.3 * unit, right: 1.3 * unit, top: 1.3 * unit, bottom: -1.3 * unit, near: 0.1 * unit, far: 6 * unit });
    this.ground = this.#add(new THREE.Mesh(new THREE.CircleGeometry(3 * unit, 48), new THREE.ShadowMaterial({ opacity: 0.16, depthWrite: false })));
    this.ground.position.z = drop;
    this.ground.receiveShadow = true;
  }

  /** The points that the hand reaches, lower ones darker: three numbers each, in one array. */
  #spread(points) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(points, 3));
    geometry.setAttribute("color", new THREE.BufferAttribute(new Float32Array(points.length), 3));
    this.cloud = this.#add(new THREE.Points(geometry, new THREE.PointsMaterial({
      size: 2.2, sizeAttenuation: false, vertexColors: true, transparent: true, opacity: 0.5, depthWrite: false,
    })));
    this.cloud.renderOrder = 5;
    geometry.computeBoundingBox();
  }

  #paintCloud() {
    const { geometry } = this.cloud, { min, max } = geometry.boundingBox, places = geometry.attributes.position, shades = geometry.attributes.color;
    const [low, high, shade] = [new THREE.Color(this.colours.low), new THREE.Color(this.colours.high), new THREE.Color()];
    for (let i = 0; i < places.count; i++) {
      shade.lerpColors(low, high, (places.getZ(i) - min.z) / (max.z - min.z || 1));
      shades.setXYZ(i, shade.r, shade.g, shade.b);
    }
    shades.needsUpdate = true;
  }

  #grid() {
    const { unit, drop } = this.picture;
    if (this.grid) {
      this.scene.remove(this.grid);
      this.grid.dispose();
    }
    const cell = 10 ** Math.floor(Math.log10(0.5 * unit)), cells = 2 * Math.ceil((1.1 * unit) / cell);
    this.grid = this.#add(new THREE.GridHelper(cells * cell, cells, this.colours.grid, this.colours.grid));
    this.grid.rotation.x = Math.PI / 2;
    this.grid.position.z = drop - 0.001 * unit;
  }

  set theme(name) {
    this.colours = THEMES[name];
    this.#grid();
    if (this.cloud) this.#paintCloud();
    this.setGhosts(this.ghosts.map((ghost) => ghost.q));
    this.#drawTrail();
    this.#layTrace();
    this.#drawTrace();
    this.update();
  }

  #listen({ onPick, onHover, onGrab, onDrag, onDrop, onNudge }) {
    this.#grip({ onGrab, onDrag, onDrop, onNudge });
    const { canvas, controls } = this;
    canvas.tabIndex = 0;
    canvas.addEventListener("webglcontextrestored", () => this.draw()); // a browser may take it away from a scene out of sight
    canvas.addEventListener("focus", () => (controls.enableZoom = true));
    canvas.addEventListener("blur", () => (controls.enableZoom = false));
    canvas.addEventListener("keydown", (event) => {
      const turns = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
      if (event.key in turns) this.turn(...turns[event.key].map((step) => step * 0.12));
      else if (event.key === "+" || event.key === "=") this.zoom(0.88);
      else if (event.key === "-") this.zoom(1 / 0.88);
      else if (event.key === "Home") this.home();
      else return;
      event.preventDefault();
      event.stopPropagation(); // a notebook would move to another cell
    });
    let pressed = null;
    canvas.addEventListener("pointerdown", (event) => (pressed = [event.clientX, event.clientY]));
    canvas.addEventListener("pointerup", (event) => {
      const still = pressed && Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) < 5;
      pressed = null;
      const ghost = still ? this.#ghostAt(event) : null;
      if (ghost !== null) onPick(ghost);
    });
    canvas.addEventListener("pointermove", (event) => {
      if (!this.ghosts.length || event.buttons) return;
      const ghost = this.#ghostAt(event);
      canvas.style.cursor = ghost === null ? "" : "pointer";
      onHover(ghost);
    });
    canvas.addEventListener("pointerleave", () => onHover(null));
  }

  /** The handle over the hand: an element, so that the keyboard and a finger find it too. */
  #grip({ onGrab, onDrag, onDrop, onNudge }) {
    const { grip } = this;
    let held = null;
    grip.addEventListener("pointerdown", (event) => {
      grip.setPointerCapture(event.pointerId);
      const middle = this.project(this.picture.handle(this.q)), box = this.canvas.getBoundingClientRect();
      held = [event.clientX - box.left - middle.x, event.clientY - box.top - middle.y];
      this.dragged = true;
      onGrab();
    });
    grip.addEventListener("pointermove", (event) => {
      if (!held) return;
      const box = this.canvas.getBoundingClientRect();
      const to = this.#under(event.clientX - box.left - held[0], event.clientY - box.top - held[1]);
      if (to) onDrag(to);
    });
    const drop = () => {
      if (!held) return;
      held = this.dragged = null;
      onDrop();
      this.#keepInView();
      this.draw();
    };
    for (const event of ["pointerup", "pointercancel", "lostpointercapture"]) grip.addEventListener(event, drop);
    grip.addEventListener("keydown", (event) => {
      const ways = { ArrowLeft: [-1, 0, 0], ArrowRight: [1, 0, 0], ArrowUp: [0, 1, 0], ArrowDown: [0, -1, 0], PageUp: [0, 0, -1], PageDown: [0, 0, 1] };
      if (!(event.key in ways)) return;
      event.preventDefault();
      event.stopPropagation(); // a notebook would move to another cell
      const step = 0.01 * this.picture.unit, way = new THREE.Vector3(...ways[event.key]).applyQuaternion(this.camera.quaternion);
      if (this.picture.flat) way.setZ(0);
      onNudge(way.setLength(step).toArray());
    });
  }

  /** The place under a point of the picture, as far away as the hand; on its level, for a robot that moves in a plane. */
  #under(x, y) {
    const ray = new THREE.Raycaster();
    ray.setFromCamera(new THREE.Vector2((2 * x) / this.width - 1, 1 - (2 * y) / this.height), this.camera);
    const across = this.picture.flat ? new THREE.Vector3(0, 0, 1) : this.camera.getWorldDirection(new THREE.Vector3());
    const plane = new THREE.Plane().setFromNormalAndCoplanarPoint(across, new THREE.Vector3(...this.picture.handle(this.q)));
    return ray.ray.intersectPlane(plane, new THREE.Vector3())?.toArray() ?? null;
  }

  /** Where a point lies in the picture, in its pixels, and whether it is before the camera. */
  project(point) {
    const { x, y, z } = new THREE.Vector3(...point).project(this.camera);
    return { x: ((x + 1) / 2) * this.width, y: ((1 - y) / 2) * this.height, seen: z < 1 };
  }

  /** The number of the ghost under a pointer, or null; the robot itself hides what lies behind it. */
  #ghostAt(event) {
    const box = this.canvas.getBoundingClientRect();
    const ray = new THREE.Raycaster();
    ray.setFromCamera(new THREE.Vector2((2 * (event.clientX - box.left)) / box.width - 1, 1 - (2 * (event.clientY - box.top)) / box.height), this.camera);
    const shown = this.ghosts.filter((ghost) => ghost.solids.visible);
    const hit = ray.intersectObjects([this.arm, ...shown.map((ghost) => ghost.solids)])[0];
    const found = shown.find((ghost) => ghost.solids === hit?.object.parent);
    return found ? this.ghosts.indexOf(found) : null;
  }

  /** Turn the camera about the robot, by angles in radians. */
  turn(sideways, upwards) {
    const place = new THREE.Spherical().setFromVector3(this.#offset().applyAxisAngle(new THREE.Vector3(1, 0, 0), -Math.PI / 2));
    place.theta += sideways;
    place.phi = Math.min(Math.max(place.phi + upwards, 0.02), Math.PI - 0.02);
    this.#stand(new THREE.Vector3().setFromSpherical(place).applyAxisAngle(new THREE.Vector3(1, 0, 0), Math.PI / 2));
  }

  zoom(factor) {
    const offset = this.#offset(), far = offset.length() * factor;
    this.#stand(offset.setLength(Math.min(Math.max(far, 0.3 * this.picture.unit), 20 * this.picture.unit)));
  }

  #offset() {
    return this.camera.position.clone().sub(this.controls.target);
  }

  #stand(offset) {
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
    this.draw();
  }

  /** Look at the robot, its ghosts and its path as a whole, from the seat it is best seen from. */
  home() {
    const { picture } = this;
    const postures = [this.q, ...this.ghosts.flatMap((ghost) => (ghost.q ? [ghost.q] : []))];
    const points = [...postures.flatMap((q) => picture.outline(q)), ...this.trace.points, ...this.marks.map((mark) => mark.at)];
    const corners = points.map((point) => new THREE.Vector3(...point));
    if (this.cloud && this.show.cloud) {
      const places = this.cloud.geometry.attributes.position, some = Math.ceil(places.count / 300);
      for (let i = 0; i < places.count; i += some) corners.push(new THREE.Vector3().fromBufferAttribute(places, i));
    }
    const box = new THREE.Box3().setFromPoints(corners), { target } = this.controls;
    box.getCenter(target);
    let far = 4 * box.getSize(new THREE.Vector3()).length();
    for (let round = 0; round < 6; round++) {
      this.camera.position.copy(target).add(new THREE.Vector3(...picture.seat).setLength(far));
      this.camera.lookAt(target);
      this.camera.updateMatrixWorld();
      const seen = new THREE.Box3().setFromPoints(corners.map((corner) => corner.clone().project(this.camera)));
      const [right, up] = [0, 1].map((k) => new THREE.Vector3().setFromMatrixColumn(this.camera.matrixWorld, k));
      const [middle, size] = [seen.getCenter(new THREE.Vector3()), seen.getSize(new THREE.Vector3())];
      const scale = far * Math.tan((FIELD / 2) * (Math.PI / 180));
      target.addScaledVector(right, middle.x * scale * this.camera.aspect).addScaledVector(up, middle.y * scale);
      far = Math.max((far * Math.max(size.x, size.y)) / 2 / FILLED, 1.2 * picture.unit);
    }
    this.#stand(new THREE.Vector3(...picture.seat).setLength(far));
  }

  setPosture(q) {
    const from = this.picture.handle(this.q), to = this.picture.handle(q), pace = 0.006 * this.picture.unit;
    this.q = q;
    if (this.show.trace && this.width) {
      if (!this.trail.length) this.trail.push(from);
      if (norm(subtract(to, this.trail.at(-1))) > pace) this.trail = [...this.trail, to].slice(-TRAIL);
      this.#drawTrail();
    }
    this.update();
    if (!this.dragged) this.#keepInView();
  }

  /** Forget the way of the hand so far. */
  clearTrail() {
    this.trail = [];
    this.#drawTrail();
  }

  #drawTrail() {
    const width = 0.005 * this.picture.unit;
    this.trailed.draw(this.trail.slice(1).map((end, i) => tube(this.trail[i], end, width, this.colours.trace)));
  }

  /** Step back where the moving arm would leave the picture; never jump forward again. */
  #keepInView() {
    if (!this.width) return;
    this.camera.updateMatrixWorld();
    const points = this.picture.outline(this.q).map((point) => new THREE.Vector3(...point));
    const outside = () => points.some((point) => {
      const { x, y } = point.clone().project(this.camera);
      return Math.abs(x) > 0.94 || Math.abs(y) > 0.94;
    });
    for (let steps = 0; steps < 40 && outside(); steps++) {
      const offset = this.#offset().multiplyScalar(1.03);
      this.camera.position.copy(this.controls.target).add(offset);
      this.camera.updateMatrixWorld();
    }
    this.controls.update();
  }

  /** Postures beside the robot; null stands for one that is out of reach. */
  setGhosts(postures) {
    for (const ghost of this.ghosts.splice(postures.length)) {
      for (const part of [ghost.solids, ghost.depth]) {
        this.scene.remove(part);
        part.dispose();
      }
    }
    while (this.ghosts.length < postures.length) {
      // Its depth first, unseen: otherwise its own parts would shine through one another.
      const depth = this.#add(new Solids(new THREE.MeshBasicMaterial({ colorWrite: false })));
      const solids = this.#add(new Solids(new THREE.MeshStandardMaterial(GHOST)));
      depth.renderOrder = 1;
      solids.renderOrder = 3;
      this.ghosts.push({ solids, depth });
    }
    postures.forEach((q, i) => {
      const ghost = this.ghosts[i];
      ghost.q = q;
      if (!q) return;
      const pose = this.picture.pose(q);
      for (const part of [ghost.depth, ghost.solids]) part.draw(this.picture.ghost(pose, this.colours.ghost));
      ghost.elbow = this.picture.elbow(pose);
    });
    this.update();
  }

  /** Let one ghost stand out, or none. */
  light(number) {
    this.ghosts.forEach((ghost, i) => {
      const material = ghost.solids.material;
      material.opacity = i === number ? 0.8 : GHOST.opacity;
      ghost.solids.renderOrder = i === number ? 2 : 3;
      material.color.set(i === number ? this.colours.chosen : "#ffffff");
    });
    this.draw();
  }

  /** Points of the hand's path, and the share of it, from 0 to 1, that has been drawn. */
  setTrace(points, done) {
    const same = points === this.trace.points;
    this.trace = { points, done };
    if (!same) this.#layTrace();
    this.#drawTrace();
    this.draw();
  }

  /** All of the path at once, thin, and thick for what will have been drawn: at each step only more of it is revealed. */
  #layTrace() {
    const { points } = this.trace, width = 0.006 * this.picture.unit;
    this.pieces = points.slice(1).flatMap((end, i) => (norm(subtract(end, points[i])) < 1e-9 ? [] : [{ start: points[i], end, from: i }]));
    this.ahead.draw(this.pieces.map(({ start, end }) => tube(start, end, 0.4 * width, this.colours.ahead)));
    this.drawn.draw(this.pieces.flatMap(({ start, end }) => [tube(start, end, width, this.colours.trace), ball(end, width, this.colours.trace)]));
  }

  #drawTrace() {
    const { points, done } = this.trace, width = 0.006 * this.picture.unit, here = done * (points.length - 1);
    const next = this.pieces.findIndex(({ from }) => from + 1 > here), { start, end, from } = this.pieces[next] ?? {};
    this.drawn.reveal(next < 0 ? this.pieces.length : next);
    if (next < 0 || from >= here) return this.tip.draw([]);
    const middle = add(start, subtract(end, start), here - from);
    this.tip.draw([tube(start, middle, width, this.colours.trace), ball(middle, width, this.colours.trace)]);
  }

  /** Build what depends on the posture, and draw. */
  update() {
    if (!this.colours) return;
    const { picture, q, colours } = this, pose = picture.pose(q);
    const { front, labels, axes, speeds } = picture.scenery(pose, q, this.show, this.step, colours);
    this.arm.draw(picture.body(pose, colours, this.lit));
    this.lines.draw(front);
    this.axes.draw(axes);
    this.speeds.draw(speeds);
    for (const ghost of this.ghosts) ghost.solids.visible = ghost.depth.visible = Boolean(ghost.q) && !picture.same(ghost.q, q);
    if (this.cloud) this.cloud.visible = Boolean(this.show.cloud);
    this.trailed.visible = Boolean(this.show.trace);
    this.marks = [...this.#numbers(), ...labels];
    this.draw();
  }

  /** Numbers of the ghosts at their elbows, of those that share one together. */
  #numbers() {
    const places = new Map();
    this.ghosts.forEach(({ q, elbow }, i) => {
      if (!q) return;
      const key = elbow.map((x) => Math.round((50 * x) / this.picture.unit)).join();
      places.set(key, { elbow, owners: [...(places.get(key)?.owners ?? []), i + 1] });
    });
    return [...places.values()].map(({ elbow, owners }) => ({
      id: `ghost ${owners}`, text: [[owners.join(", "), ""]], kind: "ghost", at: elbow, way: [0, 0, 1], gap: 10,
    }));
  }

  /** Draw at the next frame of the screen, once however often this is called. */
  draw() {
    this.pending ??= requestAnimationFrame(() => {
      this.pending = null;
      if (!this.colours || !this.width) return;
      this.renderer.clear();
      this.renderer.render(this.scene, this.camera);
      this.renderer.clearDepth();
      this.renderer.render(this.front, this.camera);
      this.#placeLabels();
    });
  }

  #placeLabels() {
    const placed = this.marks.flatMap((mark) => {
      const here = this.project(mark.at), there = this.project(add(mark.at, mark.way ?? mark.across, 0.05));
      const lean = Math.atan2(there.y - here.y, there.x - here.x);
      const heading = mark.way ? lean : lean - Math.PI / 2;
      return here.seen ? [{ ...mark, x: here.x, y: here.y, heading }] : [];
    });
    const hand = this.project(this.picture.handle(this.q));
    this.grip.style.transform = `translate(${hand.x}px, ${hand.y}px)`;
    this.labels.show(placed, this.width, this.height, [CORNER(this.width), { x: hand.x, y: hand.y, w: 22, h: 22 }]);
  }

  resize(width, height) {
    if (!width || !height) return;
    const first = !this.width;
    Object.assign(this, { width, height });
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    if (first) this.home();
    else this.draw();
  }

  dispose() {
    cancelAnimationFrame(this.pending);
    this.controls.dispose();
    for (const part of [this.arm, this.axes, this.lines, this.ahead, this.drawn, this.tip, this.trailed, this.speeds, ...this.ghosts.flatMap((ghost) => [ghost.solids, ghost.depth])]) part.dispose();
    this.grid?.dispose();
    this.cloud?.geometry.dispose();
    this.cloud?.material.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss(); // a browser gives out only a few
  }
}
