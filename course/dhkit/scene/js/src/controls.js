// The panel beside the picture: joints, postures, path, and what is shown. All texts are text, never HTML.

import { metres } from "./picture.js";

/** A new element; children are elements, or texts that stay texts. */
export function make(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name.includes("-") || name === "role") element.setAttribute(name, value);
    else element[name] = value;
  }
  element.append(...children);
  return element;
}

export const inDegrees = (angle) => {
  const value = (angle * 180) / Math.PI;
  const text = Math.abs(value) < 0.05 ? "0" : value.toFixed(Math.abs(value - Math.round(value)) < 1e-6 ? 0 : 1);
  return `${text.replace("-", "\u2212")}°`;
};
export const inMetres = (length) => `${metres(length)} m`;

/** What a slider shows and gives: whole degrees or round metres; only its ends may be odd. */
function scale({ prismatic, low, high, step }) {
  if (prismatic) return { low, high, step, shown: (q) => q, meant: (x) => x, text: inMetres };
  const turn = Math.PI / 180;
  return { low: Math.ceil(low / turn - 1e-9), high: Math.floor(high / turn + 1e-9), step: 1, shown: (q) => q / turn, meant: (x) => x * turn, text: inDegrees };
}

/** One slider per joint. `onMove(joint, value)`, and `onTouch(joint or null)` for the one under the pointer or the keys. */
export function jointSliders(joints, { onMove, onTouch }) {
  const rows = joints.map((joint, j) => {
    const { low, high, step, shown, meant, text } = scale(joint);
    const input = make("input", { type: "range", min: low, max: high, step, "aria-label": joint.name });
    const output = make("output");
    const row = make("label", { className: "joint", title: joint.name }, make("span", { className: "name" }, joint.name), input, output);
    input.addEventListener("input", () => onMove(j, meant(Number(input.value))));
    for (const event of ["focus", "pointerenter"]) input.addEventListener(event, () => onTouch(j));
    for (const event of ["blur", "pointerleave"]) input.addEventListener(event, () => onTouch(null));
    input.addEventListener("keydown", (event) => event.stopPropagation()); // a notebook would move to another cell
    const set = (q) => {
      input.value = shown(q);
      output.textContent = text(q);
      input.setAttribute("aria-valuetext", text(q));
    };
    return { row, set };
  });
  const element = make("div", { role: "group", "aria-label": "joints" }, ...rows.map(({ row }) => row));
  return { element, set: (q) => rows.forEach(({ set }, j) => set(q[j])) };
}

/** A row of buttons that tell with `aria-pressed` whether they are on. */
export function buttons(title, entries, onPress) {
  const made = entries.map(({ text, label, on = false }, i) => {
    const button = make("button", { type: "button", "aria-pressed": on, "aria-label": label, title: label }, text);
    button.addEventListener("click", () => onPress(i, button));
    return button;
  });
  const element = make("div", { className: "row", role: "group", "aria-label": title }, make("span", { className: "what" }, title), ...made);
  return { element, buttons: made };
}

export const pressed = (button, on) => button.setAttribute("aria-pressed", on);

/** Which frames are shown, and what else: `views` are [key, text, label]. `show` is changed in place. */
export function chooser(arm, show, views, onChange) {
  const frames = buttons("frames", arm.names.map((name, i) => ({ text: name, label: `frame ${name}`, on: show.frames.has(i) })), (i, button) => {
    if (!show.frames.delete(i)) show.frames.add(i);
    pressed(button, show.frames.has(i));
    onChange("frames");
  });
  return [frames.element, toggles(show, views, onChange)];
}

/** Buttons that turn entries of `show` on and off. */
export function toggles(show, views, onChange) {
  return buttons("shown", views.map(([key, text, label]) => ({ text, label, on: Boolean(show[key]) })), (i, button) => {
    const [key] = views[i];
    show[key] = !show[key];
    pressed(button, show[key]);
    onChange(key);
  }).element;
}

/** Play, pause, and a slider over the time of a path. */
export function player({ onToggle, onSeek }) {
  const button = make("button", { type: "button" });
  const time = make("input", { type: "range", min: 0, max: 1, step: 0.01, "aria-label": "place on the path" });
  button.addEventListener("click", onToggle);
  time.addEventListener("input", () => onSeek(Number(time.value)));
  time.addEventListener("keydown", (event) => event.stopPropagation());
  const element = make("div", { className: "row", role: "group", "aria-label": "path" }, make("span", { className: "what" }, "path"), button, time);
  const set = (share, playing) => {
    time.value = share;
    button.textContent = playing ? "\u2016" : "\u25b6";
    button.setAttribute("aria-label", playing ? "pause" : "play");
  };
  return { element, set };
}
