// The picture in space: camera, light, and the robot with its ghosts and the trace of its hand.

import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

import { add, chain, column, norm, subtract, walk } from "./kinematics.js";
import { Labels } from "./labels.js";
import { Picture } from "./picture.js";
import { Solids, ball, tube } from "./solids.js";

const AXES = { light: { x: "#c94f00", y: "#00835f", z: "#0067a8" }, dark: { x: "#ff8a3d", y: "#2fd3a0", z: "#63b8f5" } };
const THEMES = {
  light: {
    ...AXES.light, ink: "#222222", soft: "#7d858f", link: "#dbe1e8", joint: "#6f8fb3", hand: "#566270", base: "#b4bdc7",
    lit: "#f0a30a", trace: "#b0307a", ahead: "#d9a8c4", ghost: "#9fb4cc", chosen: "#e69f00", grid: "#c9d0d8",
  },
  dark: {
    ...AXES.dark, ink: "#f0f0f0", soft: "#8f98a3", link: "#b9c2cc", joint: "#5d83ad", hand: "#d5dbe2", base: "#626d79",
    lit: "#ffb627", trace: "#ff7cc0", ahead: "#6e4a60", ghost: "#8ba3bd", chosen: "#ffb627", grid: "#39414a",
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

/** Directions in which a camera looks well at an arm: from above if it moves in a plane, else from the front right. */
function seat(picture) {
  const frames = chain(picture.arm, picture.arm.nominal);
  const flat = picture.joints.every((i) => Math.abs(column(frames[i], 2)[2]) > 0.999)
    && picture.joints.every((i) => picture.arm.rows[i - 1][0] === 0);
  return flat ? [0, -0.75, 1.5] : [0.55, -1, 0.55];
}

export class View {
  constructor(stage, arm, { onPick, onHover }) {
    this.stage = stage;
    this.picture = new Picture(arm);
    this.show = { frames: new Set(arm.frames), axes: true, normals: true };
    this.q = arm.nominal;
    this.lit = null;
    this.ghosts = [];
    this.trace = { points: [], done: 0 };
    this.step = null; // {row, share}: the moves of a row under way
    this.renderer = new THREE.WebGLRenderer({ antialias: true, alpha: true, stencil: true, preserveDrawingBuffer: true });
    this.renderer.shadowMap.enabled = true;
    this.canvas = this.renderer.domElement;
    stage.prepend(this.canvas);
    this.labels = new Labels(stage.querySelector(".labels"));
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
    this.drawn = this.#add(new Solids(new THREE.MeshBasicMaterial()));
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.enableZoom = false; // until the picture has the focus: the wheel belongs to the page
    this.controls.enablePan = false;
    this.controls.addEventListener("change", () => this.draw());
    this.canvas.style.touchAction = "pan-y";
    this.#listen(onPick, onHover);
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
    this.ground = this.#add(new THREE.Mesh(new THREE.CircleGeometry(3 * unit, 48), new THREE.ShadowMaterial({ opacity: 0.16 })));
    this.ground.position.z = drop;
    this.ground.receiveShadow = true;
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
    this.setGhosts(this.ghosts.map((ghost) => ghost.q));
    this.#drawTrace();
    this.update();
  }

  #listen(onPick, onHover) {
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
    const postures = [this.q, ...this.ghosts.map((ghost) => ghost.q)];
    const points = [...postures.flatMap((q) => picture.outline(q)), ...this.trace.points, ...this.marks.map((mark) => mark.at)];
    const corners = points.map((point) => new THREE.Vector3(...point));
    const box = new THREE.Box3().setFromPoints(corners), { target } = this.controls;
    box.getCenter(target);
    let far = 4 * box.getSize(new THREE.Vector3()).length();
    for (let round = 0; round < 6; round++) {
      this.camera.position.copy(target).add(new THREE.Vector3(...seat(picture)).setLength(far));
      this.camera.lookAt(target);
      this.camera.updateMatrixWorld();
      const seen = new THREE.Box3().setFromPoints(corners.map((corner) => corner.clone().project(this.camera)));
      const [right, up] = [0, 1].map((k) => new THREE.Vector3().setFromMatrixColumn(this.camera.matrixWorld, k));
      const [middle, size] = [seen.getCenter(new THREE.Vector3()), seen.getSize(new THREE.Vector3())];
      const scale = far * Math.tan((FIELD / 2) * (Math.PI / 180));
      target.addScaledVector(right, middle.x * scale * this.camera.aspect).addScaledVector(up, middle.y * scale);
      far = Math.max((far * Math.max(size.x, size.y)) / 2 / FILLED, 1.2 * picture.unit);
    }
    this.#stand(new THREE.Vector3(...seat(picture)).setLength(far));
  }

  setPosture(q) {
    this.q = q;
    this.update();
    this.#keepInView();
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

  setGhosts(postures) {
    for (const ghost of this.ghosts) {
      for (const part of [ghost.solids, ghost.depth]) {
        this.scene.remove(part);
        part.dispose();
      }
    }
    this.ghosts = postures.map((q) => {
      // Its depth first, unseen: otherwise its own parts would shine through one another.
      const depth = this.#add(new Solids(new THREE.MeshBasicMaterial({ colorWrite: false })));
      const solids = this.#add(new Solids(new THREE.MeshStandardMaterial(GHOST)));
      depth.renderOrder = 1;
      solids.renderOrder = 3;
      const frames = chain(this.picture.arm, q);
      for (const part of [depth, solids]) part.draw(this.picture.ghost(frames, this.colours.ghost));
      return { q, solids, depth, elbow: this.picture.elbow(frames) };
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
    this.trace = { points, done };
    this.#drawTrace();
    this.draw();
  }

  #drawTrace() {
    const { points, done } = this.trace, width = 0.006 * this.picture.unit;
    const here = done * (points.length - 1);
    const solids = points.slice(1).flatMap((end, i) => {
      const start = points[i], share = here - i;
      if (norm(subtract(end, start)) < 1e-9) return [];
      const middle = add(start, subtract(end, start), Math.min(Math.max(share, 0), 1));
      return [
        ...(share > 0 ? [tube(start, middle, width, this.colours.trace), ball(middle, width, this.colours.trace)] : []),
        ...(share < 1 ? [tube(middle, end, 0.4 * width, this.colours.ahead)] : []),
      ];
    });
    this.drawn.draw(solids);
  }

  /** Build what depends on the posture, and draw. */
  update() {
    if (!this.colours) return;
    const { picture, q, colours } = this, frames = chain(picture.arm, q);
    const shown = this.step ? [this.step.row, this.step.row + 1] : [...this.show.frames];
    const nothing = { solids: [], labels: [] };
    const axes = this.show.axes ? picture.axes(frames, shown, colours) : nothing;
    const normals = this.show.normals ? picture.normals(frames, q, colours) : nothing;
    const parts = [picture.frames(frames, shown, colours), normals];
    this.arm.draw(picture.body(frames, colours, this.lit));
    const walker = this.step ? picture.walker(walk(picture.arm, q, this.step.row, this.step.share), colours) : [];
    this.lines.draw([...parts.flatMap((part) => part.solids), ...walker]);
    this.axes.draw(axes.solids);
    this.marks = [...this.#numbers(), ...parts.flatMap((part) => part.labels), ...axes.labels];
    for (const ghost of this.ghosts) {
      const here = ghost.q.every((value, i) => Math.abs(value - q[i]) < 1e-6);
      ghost.solids.visible = ghost.depth.visible = !here;
    }
    this.draw();
  }

  /** Numbers of the ghosts at their elbows, of those that share one together. */
  #numbers() {
    const places = new Map();
    this.ghosts.forEach(({ elbow }, i) => {
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
    const project = (point) => {
      const { x, y, z } = new THREE.Vector3(...point).project(this.camera);
      return { x: ((x + 1) / 2) * this.width, y: ((1 - y) / 2) * this.height, seen: z < 1 };
    };
    const placed = this.marks.flatMap((mark) => {
      const here = project(mark.at), there = project(add(mark.at, mark.way ?? mark.across, 0.05));
      const lean = Math.atan2(there.y - here.y, there.x - here.x);
      const heading = mark.way ? lean : lean - Math.PI / 2;
      return here.seen ? [{ ...mark, x: here.x, y: here.y, heading }] : [];
    });
    this.labels.show(placed, this.width, this.height, [CORNER(this.width)]);
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
    for (const part of [this.arm, this.axes, this.lines, this.drawn, ...this.ghosts.flatMap((ghost) => [ghost.solids, ghost.depth])]) part.dispose();
    this.grid?.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss(); // a browser gives out only a few
  }
}
