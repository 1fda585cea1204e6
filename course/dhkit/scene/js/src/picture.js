// What of a robot is drawn in one posture: body, frames, joint axes, common normals, and where their labels belong.

import { same } from "./follow.js";
import { add, chain, column, cross, dot, norm, place, rowsAt, subtract, walk } from "./kinematics.js";
import { direction, layout, movingFrames, normalOf } from "./layout.js";
import { ball, box, cone, ellipsoid, tube } from "./solids.js";
import { speeds, usual } from "./speeds.js";

const AXIS = 0.13; // length of a drawn axis, in sizes of the robot
const LETTERS = ["x", "y", "z"];
// Pieces of an axis from its origin (0) to its head (1): x is solid, y dashed, z dash-dotted, as in the still drawings.
const DASHES = {
  x: [[0, 1]],
  y: [[0, 0.3], [0.38, 0.64], [0.72, 1]],
  z: [[0, 0.36], [0.44, 0.5], [0.58, 0.82], [0.9, 0.96]],
};
const SPEED = 0.2; // seconds that the hand goes at the speeds of its ellipsoid
const CENTRE_LINE = [[0, 9], [12, 14]]; // dash and dot of a joint axis, of a period of 17

/** A number of metres in at most three digits behind the point, with a proper minus sign. */
export const metres = (value) => String(Number(value.toFixed(3))).replace("-", "\u2212");

export class Picture {
  /** `cloud` holds the points that the hand reaches, three numbers each. */
  constructor(arm, cloud = null) {
    this.arm = arm;
    this.cloud = cloud;
    this.start = arm.nominal;
    this.joints = movingFrames(arm);
    Object.assign(this, layout(arm));
    this.usual = usual(arm, this.unit);
    const axes = this.joints.map((i) => column(this.pose(arm.nominal)[i], 2));
    const level = axes.every(([, , z]) => Math.abs(z) > 0.999);
    /** Whether the hand stays on one level. */
    this.flat = level && this.joints.every((i) => arm.rows[i - 1][0] === 0);
    /** Direction from which it is looked at: from above if it moves in a plane, else from the front right. */
    this.seat = this.flat ? [0, -0.75, 1.5] : [0.55, -1, 0.55];
  }

  pose(q) {
    return chain(this.arm, q);
  }

  /** Where the hand is taken hold of. */
  handle(q) {
    return column(this.pose(q).at(-1), 3);
  }

  same(one, other) {
    return same(this.arm.joints, one, other);
  }

  /** All that is drawn beside the body: solids in front of it, others, those of the speeds, and labels. */
  scenery(frames, q, show, step, colours) {
    const shown = step ? [step.row, step.row + 1] : [...show.frames];
    const nothing = { solids: [], labels: [] };
    const axes = show.axes ? this.axes(frames, shown, colours) : nothing;
    const normals = show.normals ? this.normals(frames, q, colours) : nothing;
    const limits = show.limits ? this.limits(frames, q, colours) : [];
    const fast = show.ellipsoid ? this.velocities(frames, q, colours) : { solids: [], lines: [], labels: [] };
    const parts = [this.frames(frames, shown, colours), normals];
    const walker = step ? this.walker(walk(this.arm, q, step.row, step.share), colours) : [];
    return {
      front: [...parts.flatMap((part) => part.solids), ...fast.lines, ...walker],
      axes: [...axes.solids, ...limits],
      speeds: fast.solids,
      labels: [...fast.labels, ...parts.flatMap((part) => part.labels), ...axes.labels],
    };
  }

  /** What the speeds of the hand are in a posture. */
  speeds(q) {
    return speeds(this.arm, this.unit, q, this.usual);
  }

  /** The velocity ellipsoid at the hand, and the lines along or about which it cannot move. */
  velocities(frames, q, colours) {
    const { axes, lost } = this.speeds(q), hand = column(frames.at(-1), 3), thin = 0.004 * this.unit;
    const sizes = axes.map(({ speed }) => Math.max(SPEED * speed, thin)), ways = axes.map(({ way }) => way);
    const lines = axes.filter(({ speed }) => SPEED * speed > 2 * thin)
      .map(({ way, speed }) => tube(add(hand, way, -SPEED * speed), add(hand, way, SPEED * speed), 0.7 * thin, colours.speed));
    const labels = [];
    lost.forEach(({ way, turn }, i) => {
      const reach = 0.24 * this.unit, ends = [-1, 1].map((side) => add(hand, way, side * reach));
      for (let from = -1; from < 0.85; from += 0.25) lines.push(tube(add(hand, way, from * reach), add(hand, way, (from + 0.15) * reach), thin, colours.lost));
      ends.forEach((end, k) => {
        // A plate at each end bars the way along the line, a ring stands for the turn about it.
        const plate = 0.03 * this.unit, side = (k ? -1 : 1) * 0.004 * this.unit;
        if (!turn) lines.push(tube(end, add(end, way, side), plate, colours.lost));
        else lines.push(...ring(end, way, plate, thin, colours.lost));
      });
      labels.push({ id: `lost ${i}`, text: [[turn ? "no turn about" : "no motion along", ""]], kind: "lost", at: ends[1], way, gap: 10 });
    });
    return { solids: [ellipsoid(hand, ways, sizes, lost.length ? colours.lost : colours.speed)], lines, labels };
  }

  /** Arcs and rails between the limits of the joints, and where each joint stands between them. */
  limits(frames, q, colours) {
    return this.arm.joints.flatMap(({ prismatic, low, high }, j) => {
      const i = this.joints.find((frame) => this.arm.coupling[frame - 1][j]);
      if (!prismatic && high - low > 2 * Math.PI - 1e-6) return [];
      const share = this.arm.coupling[i - 1][j], frame = frames[i], z = column(frame, 2), width = 0.004 * this.unit;
      const stopped = q[j] - low < 1e-6 || high - q[j] < 1e-6, colour = stopped ? colours.lit : colours.limit;
      if (prismatic) {
        const side = add(column(frame, 3), column(frame, 0), 3 * this.radius);
        const ends = [low, high].map((end) => add(side, z, share * (end - q[j])));
        return [tube(...ends, width, colour), ...ends.map((end) => ball(end, 2 * width, colour)), ball(side, 2.8 * width, colours.lit)];
      }
      const centre = at(frames, this.centres.get(i)), far = 3.6 * this.radius;
      const spoke = (angle, out = far) => {
        const turn = share * (angle - q[j]), x = column(frame, 0), y = column(frame, 1);
        return add(add(centre, x, out * Math.cos(turn)), y, out * Math.sin(turn));
      };
      const count = Math.max(Math.ceil((high - low) / 0.12), 1), angles = Array.from({ length: count + 1 }, (_, k) => low + (k / count) * (high - low));
      return [
        ...angles.slice(1).map((angle, k) => tube(spoke(angles[k]), spoke(angle), width, colour)),
        ...[low, high].map((end) => tube(spoke(end, 0.8 * far), spoke(end, 1.2 * far), 1.4 * width, colour)),
        ball(spoke(q[j]), 2.8 * width, colours.lit),
      ];
    });
  }

  /** Solids of the body: `colours` by tone, and what the joint with the number `lit` drives in the colour `colours.lit`. */
  body(frames, colours, lit = null) {
    const world = ({ frame, point }) => place(frames[frame], point);
    return this.pieces.map((piece) => {
      const driven = lit !== null && piece.joint && this.arm.coupling[piece.joint - 1][lit] !== 0;
      const colour = driven ? colours.lit : colours[piece.tone];
      if (piece.kind === "tube") return tube(world(piece.from), world(piece.to), piece.width, colour);
      if (piece.kind === "ball") return ball(world(piece.centre), piece.width, colour);
      const frame = frames[piece.centre.frame];
      return box(world(piece.centre), piece.axes.map((axis) => direction(frame, axis)), piece.sizes, colour);
    });
  }

  /** Solids of one more posture, all in one colour and without the base, which they share. */
  ghost(frames, colour) {
    const moving = { arm: this.arm, pieces: this.pieces.filter((piece) => piece.tone !== "base") };
    return Picture.prototype.body.call(moving, frames, { link: colour, joint: colour, hand: colour });
  }

  /** The elbow of a posture: the frame's origin that is farthest from the line between base and hand, or the middle one. */
  elbow(frames) {
    const origins = frames.map((frame) => column(frame, 3)), hand = origins.at(-1);
    const far = norm(hand);
    const away = (point) => (far > 1e-6 * this.unit ? norm(cross(point, hand)) / far : norm(point));
    return origins.reduce((best, point) => (away(point) > away(best) + 1e-3 * this.unit ? point : best), origins[origins.length >> 1]);
  }

  /** Axes of the frames with the given numbers; those that lie on one another once, with all their names. */
  frames(frames, shown, colours) {
    const size = AXIS * this.unit, solids = [], labels = [], merged = new Map();
    for (const i of shown) {
      const origin = column(frames[i], 3);
      solids.push(ball(origin, 0.013 * this.unit, colours.ink));
      LETTERS.forEach((letter, j) => {
        const way = column(frames[i], j);
        const key = [letter, ...origin, ...way].map((x) => (typeof x === "number" ? Math.round(x / this.unit * 1e5) : x)).join();
        const axis = merged.get(key) ?? { letter, origin, way, owners: [] };
        axis.owners.push(i);
        merged.set(key, axis);
      });
    }
    for (const { letter, origin, way, owners } of merged.values()) {
      solids.push(...arrow(letter, origin, way, size, 0.006 * this.unit, colours[letter]));
      const text = owners.map((i) => [letter.toUpperCase(), this.arm.names[i]]);
      labels.push({ id: `frame ${letter} ${owners}`, text, kind: letter, at: add(origin, way, size), way, gap: 3 });
    }
    return { solids, labels };
  }

  /** A frame on its way from one to the next: larger than the others. */
  walker(frame, colours) {
    const origin = column(frame, 3), axes = LETTERS.map((letter, j) => [letter, column(frame, j)]);
    const arrows = axes.flatMap(([letter, way]) => arrow(letter, origin, way, 1.45 * AXIS * this.unit, 0.009 * this.unit, colours[letter]));
    return [...arrows, ball(origin, 0.02 * this.unit, colours.lit)];
  }

  /** Joint axes as centre lines, named at their end where the frame itself is not shown. */
  axes(frames, shown, colours) {
    const size = AXIS * this.unit, solids = [], labels = [], lines = [];
    for (const i of this.joints) {
      const point = column(frames[i], 3), way = column(frames[i], 2);
      const line = lines.find((other) => norm(cross(other.way, way)) < 1e-6
        && norm(cross(subtract(point, other.point), way)) < 1e-6 * this.unit);
      if (line) line.owners.push(i);
      else lines.push({ point, way, owners: [i] });
    }
    for (const { point, way, owners } of lines) {
      const stops = owners.flatMap((i) => [at(frames, this.centres.get(i)), column(frames[i], 3), at(frames, normalOf(this.arm, i - 1)[1])]);
      const places = stops.map((stop) => dot(subtract(stop, point), way));
      const low = Math.min(...places) - 1.05 * size, high = Math.max(...places) + 1.5 * size;
      const period = 0.15 * size;
      for (let from = low; from < high; from += 1.7 * period) {
        for (const [a, b] of CENTRE_LINE) {
          const start = from + (a / 10) * period, end = Math.min(from + (b / 10) * period, high);
          if (end > start) solids.push(tube(add(point, way, start), add(point, way, end), 0.0026 * this.unit, colours.soft));
        }
      }
      const hidden = owners.filter((i) => !shown.includes(i));
      if (!hidden.length) continue;
      const tip = add(point, way, high + 0.3 * size);
      for (const [from, to] of DASHES.z) {
        const reach = 0.55 * size;
        solids.push(tube(add(tip, way, reach * (from - 1.4)), add(tip, way, reach * (to - 1.4)), 0.0045 * this.unit, colours.z));
      }
      solids.push(cone(add(tip, way, -0.25 * size), tip, 0.015 * this.unit, colours.z));
      const text = hidden.map((i) => ["Z", this.arm.names[i]]);
      labels.push({ id: `axis ${owners}`, text, kind: "z", at: tip, way, gap: 3 });
    }
    return { solids, labels };
  }

  /** Common normals and the walks along the axes, with the names and values of a and d. */
  normals(frames, q, colours) {
    const solids = [], labels = [], rows = rowsAt(this.arm, q);
    const measure = (what, i, start, end, value, width) => {
      if (norm(subtract(end, start)) < 1e-4 * this.unit) return;
      solids.push(tube(start, end, width * this.unit, colours.ink));
      solids.push(ball(start, 0.009 * this.unit, colours.ink), ball(end, 0.009 * this.unit, colours.ink));
      const text = [[`${this.arm.letters[i][what]} = ${metres(value)}`, ""]];
      labels.push({ id: `${what} ${i}`, text, kind: "length", at: start.map((x, k) => (x + end[k]) / 2), across: subtract(end, start), gap: 12 });
    };
    rows.forEach(([, a, , d], i) => {
      const [start, foot, origin] = normalOf(this.arm, i).map((point) => at(frames, point));
      measure("a", i, start, foot, a, 0.0048);
      measure("d", i, foot, origin, d, 0.0032);
    });
    return { solids, labels };
  }

  /** Points that a view of this posture must hold. */
  outline(q) {
    const frames = chain(this.arm, q);
    const ends = this.pieces.flatMap((piece) => (piece.kind === "tube" ? [piece.from, piece.to] : [piece.centre]));
    const rim = 5 * this.radius, plate = [[rim, 0, this.drop], [0, rim, this.drop], [-rim, 0, this.drop], [0, -rim, this.drop]];
    return [...plate, ...ends.map((end) => at(frames, end)), ...frames.map((frame) => column(frame, 3))];
  }
}

/** A circle about a line. */
function ring(centre, way, radius, width, colour) {
  const side = cross(way, Math.abs(way[0]) < 0.8 ? [1, 0, 0] : [0, 1, 0]), x = side.map((part) => part / norm(side)), y = cross(way, x);
  const points = Array.from({ length: 19 }, (_, k) => add(add(centre, x, radius * Math.cos((k * Math.PI) / 9)), y, radius * Math.sin((k * Math.PI) / 9)));
  return points.slice(1).map((end, k) => tube(points[k], end, width, colour));
}

/** An axis of a frame, of the given length and half width: its dashes tell which one it is. */
export function arrow(letter, origin, way, size, width, colour) {
  const dashes = DASHES[letter].map((ends) => ends.map((end) => add(origin, way, 0.8 * size * end)));
  const head = cone(add(origin, way, 0.78 * size), add(origin, way, size), 3.3 * width, colour);
  return [...dashes.map(([from, to]) => tube(from, to, width, colour)), head];
}

const at = (frames, { frame, point }) => place(frames[frame], point);
