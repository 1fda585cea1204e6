// What every scene has: the picture with its buttons, the panel beside it, light or dark, and things that move.

import { make } from "./controls.js";
import style from "./style.css";
import { View } from "./view.js";

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

/**
 * While something in the element has the focus, plain keys are its own: JupyterLab and Notebook, which hear of a key before
 * it does and would move to another cell, leave alone what carries this attribute. Keys with Ctrl stay theirs.
 */
function keepKeys(element) {
  const look = (event) => {
    if (!event.composedPath().includes(element)) return;
    const theirs = event.ctrlKey || event.metaKey || event.altKey || event.key === "Escape" || (event.shiftKey && event.key === "Enter");
    element.toggleAttribute("data-lm-suppress-shortcuts", !theirs);
  };
  addEventListener("keydown", look, true);
  return () => removeEventListener("keydown", look, true);
}

/** Whether the reader wants nothing to move by itself. */
export const calm = () => matchMedia("(prefers-reduced-motion: reduce)").matches;

/** Calls `step` with shares from 0 to 1, over some seconds; a new motion ends the old one. */
export function motion() {
  let request = null;
  const stop = () => {
    cancelAnimationFrame(request);
    request = null;
  };
  const animate = (duration, step, from = 0) => {
    stop();
    const start = performance.now() - 1000 * duration * from;
    const tick = (now) => {
      const done = Math.min(Math.max((now - start) / (1000 * duration), 0), 1); // a frame may begin before its request
      request = done < 1 ? requestAnimationFrame(tick) : null;
      step(done);
    };
    request = requestAnimationFrame(tick);
  };
  return { animate, stop };
}

/**
 * Set up picture and panel in an element; null, with a word to the reader, where nothing can be drawn in space.
 *
 * `words` says what is to be seen and what the handle moves; `picture`, `show` and `handlers` are as for `View`.
 */
export function raise(element, words, picture, show, handlers) {
  const layer = make("div", { className: "labels", "aria-hidden": "true" });
  const grip = make("button", { type: "button", className: "grip", "aria-label": words.grip, title: words.grip });
  const corner = make("div", { className: "corner" });
  const caption = make("div", { className: "caption", role: "status" });
  const stage = make("div", { className: "stage" }, layer, grip, caption, corner);
  const panel = make("div", { className: "panel" });
  const root = make("div", { className: "scene" }, make("div", { className: "frame" }, stage, panel));
  const shadow = element.shadowRoot ?? element.attachShadow({ mode: "open" });
  shadow.replaceChildren(make("style", {}, style), root);

  let view;
  try {
    view = new View(stage, picture, show, handlers);
  } catch (fault) {
    stage.replaceChildren(make("p", { className: "fault" }, `This browser draws nothing in space (no WebGL): ${fault.message}`));
    return null;
  }
  view.canvas.setAttribute("role", "application");
  view.canvas.setAttribute("aria-label", `${words.picture} Arrow keys turn it, plus and minus zoom, Home resets the view.`);
  for (const [text, label, act] of [
    ["+", "zoom in", () => view.zoom(0.85)], ["\u2212", "zoom out", () => view.zoom(1 / 0.85)], ["\u2302", "reset the view", () => view.home()],
  ]) {
    const button = make("button", { type: "button", "aria-label": label, title: label }, text);
    button.addEventListener("click", act);
    corner.append(button);
  }
  const theme = watchTheme(element, (name) => {
    root.classList.toggle("dark", name === "dark");
    view.theme = name;
  });
  const leaveKeys = keepKeys(element);
  const size = new ResizeObserver(() => {
    theme.look();
    view.resize(stage.clientWidth, stage.clientHeight);
  });
  /** To be called when all is in its place. */
  const open = () => size.observe(stage);
  const dispose = () => {
    theme.forget();
    leaveKeys();
    size.disconnect();
    view.dispose();
  };
  return { view, panel, caption, open, dispose };
}

/** Calls `act` at most every so many milliseconds. */
export function seldom(milliseconds, act) {
  let timer = null;
  const call = () => {
    timer ??= setTimeout(() => {
      timer = null;
      act();
    }, milliseconds);
  };
  return { call, forget: () => clearTimeout(timer) };
}
