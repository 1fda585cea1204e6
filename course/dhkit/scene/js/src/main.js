// A live robot in a notebook (anywidget), or in a page of its own.

import { mountArm } from "./serial.js";

export { follow } from "./follow.js";
export { forward, walk } from "./kinematics.js";
export { arrange } from "./labels.js";
export { layout } from "./layout.js";
export { along, inWords } from "./serial.js";
export { speeds, usual } from "./speeds.js";

const read = (model) => Object.fromEntries(["arm", "q", "ghosts", "path", "seconds", "cloud"].map((name) => [name, model.get(name)]));

/** Numbers of a cloud from the bytes that hold them. */
const numbers = (bytes) => new Float32Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength));

/** The widget, as anywidget wants it. */
export default {
  render({ model, el }) {
    let own = false; // a change that this view has made itself
    const tell = (name, value) => {
      own = true;
      model.set(name, value);
      own = false;
      model.save_changes();
    };
    const state = read(model);
    const scene = mountArm(el, { ...state, cloud: numbers(state.cloud) }, {
      onMove: (q) => tell("q", q),
      ask: state.arm.asks ? (question) => tell("asked", question) : null,
    });
    const heard = {
      "change:q": () => own || scene.setQ(model.get("q")),
      "change:ghosts": () => scene.setGhosts(model.get("ghosts")),
      "change:run": () => scene.play(model.get("path"), model.get("seconds")),
      "change:answer": () => scene.answer(model.get("answer")),
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
  const scene = mountArm(document.getElementById("scene"), { ...state, cloud: numbers(Uint8Array.from(atob(state.cloud), (letter) => letter.charCodeAt(0))) });
  if (state.path.length) scene.play(state.path, state.seconds);
  return scene;
}
