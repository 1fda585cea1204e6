// A serial robot that the reader moves: sliders, the hand itself, postures to compare, a path, the moves of a row.

import { buttons, chooser, inDegrees, inMetres, jointSliders, make, player, pressed } from "./controls.js";
import { follow, same, turnBetween, within } from "./follow.js";
import { add, chain, column, forward, norm, rowsAt, subtract } from "./kinematics.js";
import { below } from "./labels.js";
import { Picture, metres } from "./picture.js";
import { calm, motion, raise, seldom } from "./stage.js";

const REPORT = 100; // milliseconds between two reports of a posture to the kernel
const PATIENCE = 10_000; // milliseconds after which an unanswered question is asked again
const SAMPLES = 400; // points of a drawn path
const SAME = 1e-4; // of the robot's size, or in radians: two hands are in one place

/** The posture at a share, from 0 to 1, of a path with equal times between its points. */
export function along(path, share) {
  const here = share * (path.length - 1), i = Math.min(Math.floor(here), path.length - 2);
  return path[i].map((value, j) => value + (here - i) * (path[i + 1][j] - value));
}

/** What of a hand another one shares: "pose", "point" or null. */
function shared(hand, other, unit) {
  if (norm(subtract(column(hand, 3), column(other, 3))) > SAME * unit) return null;
  return norm(turnBetween(hand, other)) < SAME ? "pose" : "point";
}

/** Joint motions in words: θ₄ − θ₆. */
export function inWords(motion, joints) {
  const terms = motion.flatMap((share, j) => {
    if (Math.abs(share) < 0.05) return [];
    const size = Math.abs(Math.abs(share) - 1) < 0.05 ? "" : `${metres(Number(Math.abs(share).toFixed(1)))} `;
    return [[share < 0 ? "\u2212" : "+", size + joints[j].name]];
  });
  const first = terms.findIndex(([sign]) => sign === "+"), sorted = [...terms.splice(Math.max(first, 0), 1), ...terms];
  return sorted.map(([sign, term], k) => (k ? ` ${sign} ${term}` : sign === "+" ? term : sign + term)).join("");
}

/**
 * Build a scene in an element.
 *
 * `state` holds arm, q, ghosts, path, seconds and cloud, as `dhkit.scene` writes them; `onMove(q)` is told of every
 * posture that the reader chooses, `ask({number, q})`, where there is a kernel, of hands to find all postures for. What comes back
 * sets each of these again.
 */
export function mountArm(element, state, { onMove = () => {}, ask = null } = {}) {
  const { arm } = state, { joints } = arm;
  let { q, path, seconds } = state, branches = state.ghosts.map((each) => ({ q: each }));
  let playing = false, share = 0, trace = [];
  const picture = new Picture(arm, state.cloud);
  const show = { frames: new Set(arm.frames), axes: true, normals: true, ...Object.fromEntries(arm.shown.map((name) => [name, true])) };
  const { animate, stop: halt } = motion();
  const stage = raise(element, {
    picture: `Robot with ${joints.length} joints in space.`,
    grip: "hand: drag it, or move it with the arrow keys",
  }, picture, show, { onPick: goTo, onHover: (i) => stage.view.light(i), onGrab: grab, onDrag: reach, onDrop: release, onNudge: nudge });
  if (!stage) return { setQ() {}, setGhosts() {}, play() {}, answer() {}, dispose() {} };
  const { view, panel, caption } = stage;
  const report = seldom(REPORT, () => onMove(q));

  const sliders = jointSliders(joints, {
    onMove: (j, value) => {
      stop();
      moveTo(q.map((old, k) => (k === j ? value : old)));
      if (ask) inquire();
    },
    onTouch: (j) => {
      view.lit = j;
      view.update();
    },
  });
  const hand = make("div", { className: "hand" }), rates = make("div", { className: "hand rates" });
  const extras = make("div", { className: "extras", style: "display: contents" });
  const moves = buttons("moves of row", arm.rows.map((_, i) => ({ text: String(i + 1), label: `the four moves of row ${i + 1}` })), walkRow);
  let postures = null, control = null;
  const views = [
    ["axes", "axes", "joint axes"], ["normals", "a, d", "common normals, a and d"], ["trace", "trace", "trace of the hand"],
    ["ellipsoid", "speeds", "velocity ellipsoid of the hand"],
    ...(joints.some(({ limited }) => limited) ? [["limits", "limits", "limits of the joints"]] : []),
    ...(picture.cloud?.length ? [["cloud", "cloud", "workspace: points that the hand reaches"]] : []),
  ];
  panel.append(
    ...(arm.title ? [make("div", { className: "title" }, arm.title)] : []), sliders.element, hand, rates, extras,
    ...chooser(arm, show, views, (key) => {
      if (key === "trace") view.clearTrail();
      view.update();
      tellSpeeds();
    }), moves.element,
  );

  function set(next) {
    q = next;
    view.setPosture(q);
    sliders.set(within(joints, q));
    const [x, y, z] = column(forward(arm, q), 3).map(metres);
    hand.textContent = `${arm.tool || arm.names.at(-1) === "E" ? "tool" : `O${arm.names.at(-1)}`} at (${x}, ${y}, ${z}) m`;
    postures?.buttons.forEach((button, i) => {
      pressed(button, Boolean(branches[i].q) && same(joints, branches[i].q, q));
      button.disabled = !branches[i].q;
    });
    tellSpeeds();
  }

  function moveTo(next) {
    set(next);
    report.call();
  }

  /** How fast the hand can go, and what it has lost, in words. */
  function tellSpeeds() {
    rates.hidden = !show.ellipsoid;
    if (!show.ellipsoid) return;
    const { axes, lost, free } = picture.speeds(q), speed = (value) => metres(Number(value.toFixed(2)));
    const able = axes.filter((_, i) => i < Math.min(3, joints.length) && !(picture.flat && i === 2));
    const words = lost.length
      ? `${lost.length > 1 ? "singular" : "near a singular posture"}: the hand stays while ${free.map((each) => inWords(each, joints)).join(", or ")} moves`
      : `hand: ${speed(able.at(-1).speed)} to ${speed(axes[0].speed)} m/s per rad/s of the joints`;
    rates.textContent = words;
    rates.classList.toggle("alarm", lost.length > 0);
  }

  function stop() {
    halt();
    playing = false;
    control?.set(share, playing);
    if (view.step) standStill();
  }

  // ---------------------------------------------------------------- the hand

  let held = null;

  /** From now on the hand is led; postures that share its pose, or its place, come along. */
  function grab() {
    stop();
    held = forward(arm, q);
    for (const branch of branches) if (branch.q) branch.shares = shared(held, forward(arm, branch.q), view.picture.unit);
  }

  /** Bring the hand to a point, its orientation kept where the arm can. */
  function reach(point) {
    const target = held.map((x, i) => (i % 4 === 3 && i < 12 ? point[(i - 3) / 4] : x)), { unit } = picture;
    const found = follow(arm, unit, q, target, picture.usual.turn.rank > 0);
    const stopped = joints.filter(({ prismatic, low, high }, j) => (prismatic || high - low < 2 * Math.PI - 1e-6) && (found.q[j] - low < 1e-9 || high - found.q[j] < 1e-9));
    const far = found.missed > 1e-3 * unit;
    say(!far ? "" : stopped.length ? `${stopped.map(({ name }) => name).join(", ")} at the limit` : "out of reach");
    if (!ask) lead(forward(arm, found.q), unit);
    moveTo(found.q);
    if (ask) inquire();
  }

  /** Let the other branches follow the hand, each from where it stood last. */
  function lead(pose, unit) {
    for (const branch of branches) {
      if (!branch.shares) continue;
      const from = branch.q ?? branch.last, whole = branch.shares === "pose";
      const found = follow(arm, unit, from, pose, whole);
      const there = found.missed < 1e-3 * unit && (!whole || found.turned < 1e-2);
      branch.q = there ? found.q : null;
      branch.last = there ? found.q : from;
    }
    view.setGhosts(branches.map((branch) => branch.q));
  }

  function release() {
    if (!caption.classList.contains("fault")) say("");
  }

  function nudge(step) {
    grab();
    reach(add(column(held, 3), step));
  }

  function say(words, fault = false) {
    caption.replaceChildren(words);
    caption.classList.toggle("fault", fault);
  }

  // One question is under way at a time; the next one asks for where the hand is by then.
  let number = 0, waiting = null, again = false;
  function inquire() {
    again = waiting !== null;
    if (again) return;
    const mine = ++number;
    waiting = setTimeout(() => answer({ number: mine, ghosts: [], words: "the kernel does not answer" }), PATIENCE);
    ask({ number: mine, q });
  }

  /** What the kernel found for the last question: all postures, or in words why there are none. */
  function answer(found) {
    if (found.number !== number || waiting === null) return;
    clearTimeout(waiting);
    waiting = null;
    setBranches(found.ghosts);
    if (found.words || caption.classList.contains("fault")) say(found.words, Boolean(found.words));
    if (again) inquire();
  }

  function setBranches(ghosts) {
    const rebuild = ghosts.length !== branches.length;
    branches = ghosts.map((each) => ({ q: each }));
    view.setGhosts(ghosts);
    if (rebuild) build();
    set(q);
  }

  // ---------------------------------------------------------------- the moves of a row

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

  /** What move k of a row does, in words. */
  function describe(row, k, value) {
    const named = (word, i) => [word, below(arm.names[i])];
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

  // ---------------------------------------------------------------- postures and path

  /** Move to the posture of a ghost. */
  function goTo(i) {
    const start = q, end = branches[i].q;
    if (!end) return;
    stop();
    if (calm()) return moveTo(end);
    animate(0.8, (done) => {
      const eased = done * done * (3 - 2 * done);
      moveTo(done < 1 ? start.map((value, j) => value + eased * (end[j] - value)) : end);
    });
  }

  function build() {
    postures = branches.length ? buttons("postures", branches.map((_, i) => ({ text: String(i + 1), label: `posture ${i + 1}` })), goTo) : null;
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
    moveTo(along(path, share));
    control.set(share, playing);
  }

  function start(from) {
    playing = true;
    animate(seconds, (done) => {
      playing = done < 1;
      seek(done);
    }, from);
  }

  function draw() {
    share = 0;
    const count = Math.max(SAMPLES, Math.min(path.length, 3 * SAMPLES));
    trace = path.length ? Array.from({ length: count + 1 }, (_, k) => column(chain(arm, along(path, k / count)).at(-1), 3)) : [];
    view.setTrace(trace, share);
  }

  view.setGhosts(branches.map((branch) => branch.q));
  draw();
  build();
  set(q);
  stage.open();

  return {
    view,
    setQ(next) {
      stop();
      set(next);
    },
    setGhosts(next) {
      setBranches(next);
      if (view.width && next.length) view.home();
    },
    play(next, duration) {
      stop();
      [path, seconds] = [next, duration];
      draw();
      build();
      if (view.width && path.length) view.home();
      if (path.length) calm() ? seek(0) : start(0);
    },
    answer,
    dispose() {
      stop();
      report.forget();
      clearTimeout(waiting);
      stage.dispose();
    },
  };
}
