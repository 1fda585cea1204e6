// A live robot from its table: in a notebook (anywidget), or in a page of its own.

import { buttons, chooser, inDegrees, inMetres, jointSliders, make, player, pressed } from "./controls.js";
import { chain, column, forward, rowsAt } from "./kinematics.js";
import { below } from "./labels.js";
import { metres } from "./picture.js";
import style from "./style.css";
import { View } from "./view.js";

export { forward };
export { walk } from "./kinematics.js";
export { arrange } from "./labels.js";
export { layout } from "./layout.js";

const REPORT = 100; // milliseconds between two reports of a posture to the kernel
const SAMPLES = 400; // points of a drawn path

/** Whether the page around writes light on dark. */
function isDark(element) {
  const colour = getComputedStyle(element).color;
  if (!colour) return matchMedia("(prefers-color-scheme: dark)").matches; // not in the page yet
  const [r, g, b] = colour.match(/[\d.]+/g).map(Number);
  return 0.3 * r + 0.6 * g + 0.1 * b > 128;
}

function watchTheme(element, apply) {
  let last = null;
  const look = () => {
    const theme = isDark(element) ? "dark" : "light";
    if (theme !== last) apply((last = theme));
  };
  const observer = new MutationObserver(look);
  for (const node of [document.documentElement, document.body]) observer.observe(node, { attributes: true });
  const scheme = matchMedia("(prefers-color-scheme: dark)");
  scheme.addEventListener("change", look);
  look();
  const forget = () => {
    observer.disconnect();
    scheme.removeEventListener("change", look);
  };
  return { look, forget };
}

/** The posture at a share, from 0 to 1, of a path with equal times between its points. */
export function along(path, share) {
  const here = share * (path.length - 1), i = Math.min(Math.floor(here), path.length - 2);
  return path[i].map((value, j) => value + (here - i) * (path[i + 1][j] - value));
}

/**
 * Build a scene in an element.
 *
 * `state` holds arm, q, ghosts, path and seconds, as `dhkit.scene` writes them; `onMove(q)` is told of every posture
 * that the reader chooses. What comes back sets each of these again.
 */
export function mount(element, state, onMove = () => {}) {
  const { arm } = state;
  let { q, ghosts, path, seconds } = state;
  let motion = null, playing = false, share = 0, report = null;

  const layer = make("div", { className: "labels", "aria-hidden": "true" });
  const corner = make("div", { className: "corner" });
  const caption = make("div", { className: "caption", role: "status" });
  const stage = make("div", { className: "stage" }, layer, caption, corner);
  const panel = make("div", { className: "panel" });
  const root = make("div", { className: "scene" }, make("div", { className: "frame" }, stage, panel));
  const shadow = element.shadowRoot ?? element.attachShadow({ mode: "open" });
  shadow.replaceChildren(make("style", {}, style), root);

  let view;
  try {
    view = new View(stage, arm, { onPick: (i) => goTo(i), onHover: (i) => view.light(i) });
  } catch (fault) {
    stage.replaceChildren(make("p", { className: "fault" }, `This browser draws nothing in space (no WebGL): ${fault.message}`));
    return { setQ() {}, setGhosts() {}, play() {}, dispose() {} };
  }
  view.canvas.setAttribute("role", "application");
  view.canvas.setAttribute("aria-label", `Robot with ${arm.joints.length} joints in space. Arrow keys turn it, plus and minus zoom, Home resets the view.`);
  for (const [text, label, act] of [
    ["+", "zoom in", () => view.zoom(0.85)], ["\u2212", "zoom out", () => view.zoom(1 / 0.85)], ["\u2302", "reset the view", () => view.home()],
  ]) {
    const button = make("button", { type: "button", "aria-label": label, title: label }, text);
    button.addEventListener("click", act);
    corner.append(button);
  }

  const sliders = jointSliders(arm.joints, {
    onMove: (j, value) => {
      stop();
      show(q.map((old, k) => (k === j ? value : old)), true);
    },
    onTouch: (j) => {
      view.lit = j;
      view.update();
    },
  });
  const hand = make("div", { className: "hand" });
  const extras = make("div", { className: "extras", style: "display: contents" });
  const moves = buttons("moves of row", arm.rows.map((_, i) => ({ text: String(i + 1), label: `the four moves of row ${i + 1}` })), walkRow);
  panel.append(...(arm.title ? [make("div", { className: "title" }, arm.title)] : []), sliders.element, hand, extras, ...chooser(arm, view.show, () => view.update()), moves.element);
  let postures = null, control = null;

  function show(next, told = false) {
    q = next;
    view.setPosture(q);
    sliders.set(q);
    const [x, y, z] = column(forward(arm, q), 3).map(metres);
    hand.textContent = `${arm.tool || arm.names.at(-1) === "E" ? "tool" : `O${arm.names.at(-1)}`} at (${x}, ${y}, ${z}) m`;
    postures?.buttons.forEach((button, i) => pressed(button, ghosts[i].every((value, j) => Math.abs(value - q[j]) < 1e-6)));
    if (told) tell();
  }

  function tell() {
    report ??= setTimeout(() => {
      report = null;
      onMove(q);
    }, REPORT);
  }

  function stop() {
    cancelAnimationFrame(motion);
    motion = null;
    playing = false;
    control?.set(share, playing);
    if (view.step) standStill();
  }

  /** Show how a frame walks to the next one by the four moves of a row, one after the other. */
  function walkRow(row) {
    stop();
    pressed(moves.buttons[row], true);
    const values = rowsAt(arm, q)[row].slice(1), stays = values.map((value) => Math.abs(value) < 1e-9);
    const lengths = stays.map((still) => (still ? 0.6 : 1.4));
    const total = lengths.reduce((sum, length) => sum + length, 1.2); // and a rest at the end
    animate(total, (done) => {
      let left = done * total, k = 0;
      while (k < 4 && left >= lengths[k]) left -= lengths[k++];
      view.step = { row, share: k < 4 ? k + Math.min(left / (0.8 * lengths[k]), 1) : 4 };
      view.update();
      caption.replaceChildren(...(k < 4 ? describe(row, k, values[k]) : [`there is frame ${arm.names[row + 1]}`]));
      if (done === 1) standStill();
    });
  }

  const named = (word, i) => [word, below(arm.names[i])];

  /** What move k of a row does, in words. */
  function describe(row, k, value) {
    const way = `${k + 1}. ${k % 2 ? "about" : "along"} `, axis = k < 2 ? named("X", row) : named("Z", row + 1);
    const letter = [arm.letters[row].a, "α", arm.letters[row].d, "θ"][k];
    return [way, ...axis, ` by ${letter} = ${k % 2 ? inDegrees(value) : inMetres(value)}`];
  }

  function standStill() {
    moves.buttons.forEach((button) => pressed(button, false));
    caption.replaceChildren();
    view.step = null;
    view.update();
  }

  /** Call `step` with shares from 0 to 1, over some seconds. */
  function animate(duration, step, from = 0) {
    cancelAnimationFrame(motion);
    const start = performance.now() - 1000 * duration * from;
    const tick = (now) => {
      const done = Math.min(Math.max((now - start) / (1000 * duration), 0), 1); // a frame may begin before its request
      motion = done < 1 ? requestAnimationFrame(tick) : null;
      step(done);
    };
    motion = requestAnimationFrame(tick);
  }

  const calm = () => matchMedia("(prefers-reduced-motion: reduce)").matches;

  /** Move to the posture of a ghost. */
  function goTo(i) {
    stop();
    const start = q, end = ghosts[i];
    if (calm()) return show(end, true);
    animate(0.8, (done) => {
      const eased = done * done * (3 - 2 * done);
      show(done < 1 ? start.map((value, j) => value + eased * (end[j] - value)) : end, true);
    });
  }

  function build() {
    postures = ghosts.length ? buttons("postures", ghosts.map((_, i) => ({ text: String(i + 1), label: `posture ${i + 1}` })), goTo) : null;
    postures?.buttons.forEach((button, i) => {
      for (const event of ["focus", "pointerenter"]) button.addEventListener(event, () => view.light(i));
      for (const event of ["blur", "pointerleave"]) button.addEventListener(event, () => view.light(null));
    });
    control = path.length ? player({ onToggle: () => (playing ? stop() : start(share < 1 ? share : 0)), onSeek: (at) => { stop(); seek(at); } }) : null;
    control?.set(share, playing);
    extras.replaceChildren(...[postures, control].filter(Boolean).map((part) => part.element));
  }

  function seek(at) {
    share = at;
    view.setTrace(trace, share);
    show(along(path, share), true);
    control.set(share, playing);
  }

  function start(from) {
    playing = true;
    animate(seconds, (done) => {
      playing = done < 1;
      seek(done);
    }, from);
  }

  let trace = [];
  function follow(from = 0) {
    share = from;
    const count = Math.max(SAMPLES, Math.min(path.length, 3 * SAMPLES));
    trace = path.length ? Array.from({ length: count + 1 }, (_, k) => column(chain(arm, along(path, k / count)).at(-1), 3)) : [];
    view.setTrace(trace, share);
  }

  const theme = watchTheme(element, (name) => {
    root.classList.toggle("dark", name === "dark");
    view.theme = name;
  });
  view.setGhosts(ghosts);
  follow();
  build();
  show(q);
  const size = new ResizeObserver(() => {
    theme.look();
    view.resize(stage.clientWidth, stage.clientHeight);
  });
  size.observe(stage);

  return {
    view,
    setQ(next) {
      stop();
      show(next);
    },
    setGhosts(next) {
      ghosts = next;
      view.setGhosts(ghosts);
      build();
      show(q);
      if (view.width && ghosts.length) view.home();
    },
    play(next, duration) {
      stop();
      [path, seconds] = [next, duration];
      follow();
      build();
      if (view.width && path.length) view.home();
      if (path.length) calm() ? seek(0) : start(0);
    },
    dispose() {
      stop();
      clearTimeout(report);
      theme.forget();
      size.disconnect();
      view.dispose();
    },
  };
}

const read = (model) => Object.fromEntries(["arm", "q", "ghosts", "path", "seconds"].map((name) => [name, model.get(name)]));

/** The widget, as anywidget wants it. */
export default {
  render({ model, el }) {
    let own = false; // a change that this view has made itself
    const scene = mount(el, read(model), (q) => {
      own = true;
      model.set("q", q);
      own = false;
      model.save_changes();
    });
    const heard = {
      "change:q": () => own || scene.setQ(model.get("q")),
      "change:ghosts": () => scene.setGhosts(model.get("ghosts")),
      "change:run": () => scene.play(model.get("path"), model.get("seconds")),
    };
    for (const [event, act] of Object.entries(heard)) model.on(event, act);
    if (model.get("run")) scene.play(model.get("path"), model.get("seconds"));
    return () => {
      for (const [event, act] of Object.entries(heard)) model.off(event, act);
      scene.dispose();
    };
  },
};

/** A page that holds one scene and its data. */
export function page() {
  const state = JSON.parse(document.getElementById("state").textContent);
  const scene = mount(document.getElementById("scene"), state);
  if (state.path.length) scene.play(state.path, state.seconds);
  return scene;
}
