// A planar parallel robot that the reader moves: drives by sliders, the platform itself, and the other modes as ghosts.

import { buttons, jointSliders, make, pressed, toggles } from "./controls.js";
import { add } from "./kinematics.js";
import { apart, determinant, drivesAt, jointsOf, lastBars, modes, singular } from "./legs.js";
import { arrow, metres } from "./picture.js";
import { ball, plate, tube } from "./solids.js";
import { calm, motion, raise, seldom } from "./stage.js";

const REPORT = 100; // milliseconds between two reports of a pose to the kernel
const LEAP = 0.2; // of the robot's size: a platform does not move so far at one small step
const HALVINGS = 14;

/** What is drawn of a robot in a configuration q = [x, y, phi, three drives]. */
class Picture {
  constructor(legs, q) {
    this.legs = legs;
    this.start = q;
    const points = [...legs.base, ...jointsOf(legs.platform, q)], reach = (k) => points.map((point) => point[k]);
    this.unit = 1.3 * Math.max(...[0, 1].map((k) => Math.max(...reach(k)) - Math.min(...reach(k))));
    this.size = Math.max(...legs.platform.map((point) => Math.hypot(...point))) || 0.1 * this.unit;
    this.radius = 0.016 * this.unit;
    this.drop = -1.5 * this.radius;
    this.flat = true;
    this.seat = [0, -0.55, 1.5];
  }

  pose(q) {
    const drives = q.slice(3), { feet } = lastBars(this.legs, drives), level = this.radius;
    const rise = ([x, y], floor) => [x, y, floor * level];
    return {
      q, base: this.legs.base.map((point) => rise(point, 0)), low: this.legs.base.map((point) => rise(point, 2)),
      feet: feet.map((point) => rise(point, 2)), joints: jointsOf(this.legs.platform, q).map((point) => rise(point, 2)),
      top: jointsOf(this.legs.platform, q).map((point) => rise(point, 4)), centre: rise(q, 5),
    };
  }

  handle(q) {
    return this.pose(q).centre;
  }

  same(one, other) {
    return apart(one, other, this.size) < 1e-3 * this.unit;
  }

  #bars({ low, feet, joints, top }, colours, lit) {
    const r = this.radius, tone = (i, own) => (i === lit ? colours.lit : own);
    const bars = low.flatMap((foot, i) => {
      if (this.legs.bars) {
        return [tube(foot, feet[i], r, tone(i, colours.joint)), tube(feet[i], joints[i], 0.75 * r, colours.link), ball(feet[i], 1.5 * r, colours.hand)];
      }
      const middle = add(foot, add(joints[i], foot, -1), 0.55);
      return [tube(foot, middle, 1.15 * r, tone(i, colours.joint)), tube(middle, joints[i], 0.65 * r, colours.link)];
    });
    const rim = top.map((corner, i) => tube(corner, top[(i + 1) % 3], 0.7 * r, colours.hand));
    return [...bars, plate(top, 0.8 * r, colours.plate), ...rim];
  }

  body(pose, colours, lit) {
    const r = this.radius, pin = (from, to, width) => tube(add(from, [0, 0, -1.4 * r]), add(to, [0, 0, 1.2 * r]), width, colours.hand);
    return [
      ...this.#bars(pose, colours, lit), ...pose.joints.map((joint, i) => pin(joint, pose.top[i], 1.1 * r)),
      ...pose.base.map((foot, i) => pin(foot, pose.low[i], 1.3 * r)),
      ...pose.base.map((foot) => tube(add(foot, [0, 0, this.drop]), foot, 3.2 * r, colours.base)),
    ];
  }

  ghost(pose, colour) {
    return this.#bars(pose, Object.fromEntries(["joint", "link", "hand", "plate"].map((tone) => [tone, colour])), null);
  }

  elbow({ centre }) {
    return centre;
  }

  scenery(pose, q, show, step, colours) {
    const size = 0.1 * this.unit, front = [], labels = [], phi = q[2];
    const axes = (origin, turned, name) => {
      for (const [letter, angle] of [["x", turned], ["y", turned + Math.PI / 2]]) {
        const way = [Math.cos(angle), Math.sin(angle), 0];
        front.push(...arrow(letter, origin, way, size, 0.0055 * this.unit, colours[letter]));
        labels.push({ id: `${letter} ${name}`, text: [[letter.toUpperCase(), name]], kind: letter, at: add(origin, way, size), way, gap: 3 });
      }
      front.push(ball(origin, 0.011 * this.unit, colours.ink));
    };
    const point = (name, i, at, from) => labels.push({ id: `${name} ${i}`, text: [[name, String(i + 1)]], kind: "length", at, way: add(at, from, -1), gap: 12 });
    const middle = pose.joints.reduce((sum, joint) => add(sum, joint, 1 / 3), [0, 0, 0]);
    if (show.frames) {
      axes([0, 0, 0], 0, "0");
      axes(pose.centre, phi, "P");
      pose.base.forEach((foot, i) => point("A", i, foot, middle));
      pose.top.forEach((joint, i) => point("B", i, joint, middle));
    }
    if (show.lengths) {
      pose.joints.forEach((joint, i) => {
        const [start, value] = this.legs.bars ? [pose.low[i], `θ${"₁₂₃"[i]}`] : [pose.low[i], `q${"₁₂₃"[i]} = ${metres(q[3 + i])}`];
        const end = this.legs.bars ? pose.feet[i] : joint;
        labels.push({ id: `leg ${i}`, text: [[value, ""]], kind: "length", at: start.map((x, k) => (x + end[k]) / 2), across: add(end, start, -1), gap: 12 });
      });
    }
    const loose = this.loose(q);
    if (show.lines || loose) {
      pose.joints.forEach((joint, i) => {
        const way = add(joint, pose.feet[i], -1), far = 1.4 * this.unit / Math.hypot(...way);
        for (let from = -far; from < 1 + far; from += 0.09 * far) front.push(tube(add(pose.feet[i], way, from), add(pose.feet[i], way, from + 0.05 * far), 0.0025 * this.unit, loose ? colours.lost : colours.soft));
      });
    }
    if (loose?.about && Math.hypot(...loose.about) < 4 * this.unit) {
      const at = [...loose.about, 4 * this.radius];
      front.push(ball(at, 0.016 * this.unit, colours.lost));
      labels.unshift({ id: "about", text: [["turns about", ""]], kind: "lost", at, way: [0, 1, 0], gap: 10 });
    }
    return { front, axes: [], speeds: [], labels };
  }

  /** Where the platform can move with its drives locked: see `singular`. */
  loose(q) {
    return singular(lastBars(this.legs, q.slice(3)).feet, this.legs.platform, q, this.size);
  }

  outline(q) {
    const { base, feet, joints } = this.pose(q), rim = 3 * this.radius;
    return [...base, ...feet, ...joints].flatMap(([x, y, z]) => [[x - rim, y - rim, z], [x + rim, y + rim, z]]);
  }
}

/** Build a scene in an element; `state` holds legs and pose, as `dhkit.scene` writes them. `onMove(pose)` is told of every pose. */
export function mountParallel(element, state, { onMove = () => {} } = {}) {
  const { legs } = state, names = legs.bars ? ["θ₁", "θ₂", "θ₃"] : ["q₁", "q₂", "q₃"];
  const whole = (pose) => [...pose, ...drivesAt(legs, pose)];
  let q = whole(state.pose), others = [];
  const picture = new Picture(legs, q), { unit, size } = picture;
  const { animate, stop } = motion();
  const show = { frames: true, lengths: true, lines: false, trace: false };
  const stage = raise(element, {
    picture: `Parallel robot with three legs, ${legs.bars ? "each of two bars" : "which are drawn out"}.`,
    grip: "platform: drag it, or move it with the arrow keys",
  }, picture, show, { onPick: goTo, onHover: (i) => stage.view.light(i), onGrab: stop, onDrag: ([x, y]) => aim([x, y, q[2]]), onDrop: () => say(""), onNudge: (step) => aim([q[0] + step[0], q[1] + step[1], q[2]]) });
  if (!stage) return { setPose() {}, dispose() {} };
  const { view, panel, caption } = stage;
  const report = seldom(REPORT, () => onMove(q.slice(0, 3)));
  const joints = [...legs.drives.map((drive, i) => ({ ...drive, name: names[i], prismatic: !legs.bars })), { name: "φ", prismatic: false, low: -Math.PI, high: Math.PI }];
  const sliders = jointSliders(joints, {
    onMove(i, value) {
      stop();
      if (i < 3) drive(i, value);
      else aim([q[0], q[1], value]);
    },
    onTouch(i) {
      view.lit = i;
      view.update();
    },
  });
  const where = make("div", { className: "hand" }), strain = make("div", { className: "hand rates" });
  const extras = make("div", { style: "display: contents" });
  panel.append(...(legs.title ? [make("div", { className: "title" }, legs.title)] : []), sliders.element, where, strain, extras, toggles(show, [
    ["frames", "frames", "frames, anchors and joints"], ["lengths", "drives", legs.bars ? "driven angles" : "lengths of the legs"],
    ["lines", "lines", "lines of the last bars"], ["trace", "trace", "trace of the platform"],
  ], (key) => {
    if (key === "trace") view.clearTrail();
    view.update();
  }));

  const say = (words) => caption.replaceChildren(words);

  function set(next, told = true) {
    q = next;
    q[2] = Math.atan2(Math.sin(q[2]), Math.cos(q[2]));
    const { feet, lengths } = lastBars(legs, q.slice(3));
    const poses = modes(feet, legs.platform, lengths);
    const mine = poses.findIndex((pose) => apart(pose, q, size) < 1e-3 * unit);
    others = poses.map((pose, i) => (i === mine ? q : [...pose, ...q.slice(3)]));
    view.setGhosts(others);
    view.setPosture(q);
    sliders.set([...q.slice(3), q[2]]);
    where.textContent = `P at (${metres(q[0])}, ${metres(q[1])}) m`;
    const loose = picture.loose(q);
    strain.textContent = loose
      ? "nearly singular: with its drives locked the platform can still move a little"
      : `determinant of the legs: ${metres(determinant(feet, legs.platform, q))} m`;
    strain.classList.toggle("alarm", Boolean(loose));
    build(mine);
    if (told) report.call();
  }

  let choice = null;
  function build(mine) {
    if (choice?.buttons.length !== others.length) {
      choice = buttons("modes", others.map((_, i) => ({ text: String(i + 1), label: `mode ${i + 1}` })), goTo);
      choice.buttons.forEach((button, i) => {
        for (const event of ["focus", "pointerenter"]) button.addEventListener(event, () => view.light(i));
        for (const event of ["blur", "pointerleave"]) button.addEventListener(event, () => view.light(null));
      });
      extras.replaceChildren(choice.element);
    }
    choice.buttons.forEach((button, i) => pressed(button, i === mine));
  }

  /** Whether the drives can take these values. */
  const allowed = (drives) => drives && drives.every((value, i) => legs.bars || (value >= legs.drives[i].low - 1e-9 && value <= legs.drives[i].high + 1e-9));

  /** Bring the platform to a pose, or as far on the straight way there as its legs reach. */
  function aim(target) {
    const from = q.slice(0, 3), at = (share) => from.map((x, k) => x + share * (target[k] - x));
    let low = 0, high = 1;
    if (allowed(drivesAt(legs, target))) low = 1;
    for (let k = 0; k < HALVINGS && low < 1; k++) {
      const middle = (low + high) / 2;
      if (allowed(drivesAt(legs, at(middle)))) low = middle;
      else high = middle;
    }
    say(low < 1 ? "a leg is at its end" : "");
    set(whole(at(low)));
  }

  /** Where one small motion of the drives carries the platform; null where its mode ends. */
  function carried(from, drives) {
    const { feet, lengths } = lastBars(legs, drives);
    const next = modes(feet, legs.platform, lengths).reduce((best, pose) => (!best || apart(pose, from, size) < apart(best, from, size) ? pose : best), null);
    return next && apart(next, from, size) < LEAP * unit ? [...next, ...drives] : null;
  }

  /** Move one drive in small steps, the platform always in its mode; to the end of the mode where that comes first. */
  function drive(i, value) {
    const count = Math.max(1, Math.ceil(Math.abs(value - q[3 + i]) / (0.02 * (legs.bars ? 3 : unit))));
    const start = q[3 + i], at = (share) => q.slice(3).map((each, j) => (j === i ? start + share * (value - start) : each));
    let here = q, done = 0, step = 1 / count;
    while (done < 1 && step > 1e-4 / count) {
      const next = carried(here, at(Math.min(done + step, 1)));
      if (next) [here, done] = [next, Math.min(done + step, 1)];
      else step /= 2;
    }
    if (legs.bars) legs.elbows = elbowsOf(here);
    set([...here]);
    say(done < 1 ? "no further: here two modes meet" : "");
  }

  /** On which side of its legs the elbows stand. */
  function elbowsOf(here) {
    const { feet } = lastBars(legs, here.slice(3)), ends = jointsOf(legs.platform, here);
    return feet.map(([x, y], k) => {
      const [ax, ay] = legs.base[k];
      return Math.sign((x - ax) * (ends[k][1] - y) - (y - ay) * (ends[k][0] - x)) || 1;
    });
  }

  /** Go to another mode. No motion of the drives leads there: the robot is taken apart and put together again. */
  function goTo(i) {
    stop();
    say("");
    const end = others[i], start = q;
    const arrive = () => {
      if (legs.bars) legs.elbows = elbowsOf(end);
      set([...end]);
    };
    if (!end || picture.same(start, end)) return;
    if (calm()) return arrive();
    const turned = Math.atan2(Math.sin(end[2] - start[2]), Math.cos(end[2] - start[2]));
    animate(0.8, (done) => {
      if (done === 1) return arrive();
      const eased = done * done * (3 - 2 * done);
      view.setPosture([...[0, 1].map((k) => start[k] + eased * (end[k] - start[k])), start[2] + eased * turned, ...start.slice(3)]);
    });
  }

  set(q, false);
  stage.open();
  return {
    view,
    setPose(pose) {
      stop();
      set(whole(pose), false);
    },
    dispose() {
      stop();
      report.forget();
      stage.dispose();
    },
  };
}
