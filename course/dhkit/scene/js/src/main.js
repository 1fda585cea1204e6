// A live robot in a notebook (anywidget), or in a page of its own.

import { mountParallel } from "./parallel.js";
import { mountArm } from "./serial.js";

export { follow } from "./follow.js";
export { forward, walk } from "./kinematics.js";
export { arrange } from "./labels.js";
export { determinant, drivesAt, jointsOf, lastBars, modes } from "./legs.js";
export { layout } from "./layout.js";
export { along, inWords } from "./serial.js";
export { speeds, usual } from "./speeds.js";

/** Numbers of a cloud from the bytes that hold them. */
const numbers = (bytes) => new Float32Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength));

/** A serial robot and what the kernel says to it: each change with what it does. */
function arm(el, get, tell) {
  const state = Object.fromEntries(["arm", "q", "ghosts", "path", "seconds"].map((name) => [name, get(name)]));
  const scene = mountArm(el, { ...state, cloud: numbers(get("cloud")) }, {
    onMove: (q) => tell("q", q),
    ask: state.arm.asks ? (question) => tell("asked", question) : null,
  });
  const play = () => scene.play(get("path"), get("seconds"));
  if (get("run")) play();
  return [scene, { q: () => scene.setQ(get("q")), ghosts: () => scene.setGhosts(get("ghosts")), run: play, answer: () => scene.answer(get("answer")) }];
}

function parallel(el, get, tell) {
  const scene = mountParallel(el, { legs: structuredClone(get("legs")), pose: get("pose") }, { onMove: (pose) => tell("pose", pose) });
  return [scene, { pose: () => scene.setPose(get("pose")) }];
}

/** The widget, as anywidget wants it. */
export default {
  render({ model, el }) {
    let own = false; // a change that this view has made itself
    const get = (name) => model.get(name);
    const tell = (name, value) => {
      own = true;
      model.set(name, value);
      own = false;
      model.save_changes();
    };
    const [scene, changes] = (get("legs") ? parallel : arm)(el, get, tell);
    const heard = Object.entries(changes).map(([name, act]) => [`change:${name}`, () => own || act()]);
    for (const [event, act] of heard) model.on(event, act);
    return () => {
      for (const [event, act] of heard) model.off(event, act);
      scene.dispose();
    };
  },
};

/** A page that holds one scene and its data. */
export function page() {
  const state = JSON.parse(document.getElementById("state").textContent), host = document.getElementById("scene");
  if (state.legs) return mountParallel(host, state);
  const scene = mountArm(host, { ...state, cloud: numbers(Uint8Array.from(atob(state.cloud), (letter) => letter.charCodeAt(0))) });
  if (state.path.length) scene.play(state.path, state.seconds);
  return scene;
}
