// The body of a robot: tubes, balls and boxes that are each fixed to a frame, so that a posture only moves them.
// Link i runs from O_i along the common normal to axis i + 1, then along that axis, as in dhkit/drawing/robot.py.

import { add, chain, column, cross, dot, norm, place, rowsAt, subtract } from "./kinematics.js";

const at = (frame, ...point) => ({ frame, point: point.length ? point : [0, 0, 0] });

/** Sum of all lengths with the slides drawn out: the size of the robot, in metres. */
export function sizeOf(arm) {
  const lengths = rowsAt(arm, arm.nominal).map(([, a, , d]) => Math.abs(a) + Math.abs(d));
  const tool = arm.tool ? norm(column(arm.tool, 3)) : 0;
  return lengths.reduce((sum, length) => sum + length, tool) || 1;
}

/** Numbers of the frames, from 1, that a joint moves. */
export const movingFrames = (arm) => arm.coupling.flatMap((shares, i) => (shares.some((share) => share) ? [i + 1] : []));

/** Ends of the common normal a and of the walk d behind it, for row i from 0, as points fixed to frames. */
export const normalOf = (arm, i) => [at(i), at(i, arm.rows[i][1], 0, 0), at(i + 1)];

export function layout(arm) {
  const rows = rowsAt(arm, arm.nominal), frames = chain(arm, arm.nominal), count = rows.length;
  const last = frames.length - 1, unit = sizeOf(arm), radius = 0.024 * unit, half = 2 * radius;
  const joints = movingFrames(arm), pieces = [];
  const world = ({ frame, point }) => place(frames[frame], point);
  const distance = (one, two) => norm(subtract(world(one), world(two)));
  const prismatic = (i) => rows[i - 1][0] === 1;
  const foot = (i) => at(i - 1, rows[i - 1][1], 0, 0);
  /** Direction of Z_i in the frame in which joint i stands: its guide does not move with it. */
  const standing = (i) => (prismatic(i) ? [0, -Math.sin(rows[i - 1][2]), Math.cos(rows[i - 1][2])] : [0, 0, 1]);

  const tube = (from, to, width, tone, joint) => {
    if (distance(from, to) > 1e-9 * unit) pieces.push({ kind: "tube", from, to, width, tone, joint });
  };
  const ball = (centre, width, tone) => pieces.push({ kind: "ball", centre, width, tone });
  const box = (centre, axes, sizes, tone, joint) => pieces.push({ kind: "box", centre, axes, sizes, tone, joint });
  const path = (stops, width, first = width) => {
    stops.slice(1).forEach((stop, k) => tube(stops[k], stop, k ? width : first, "link"));
    stops.slice(1, -1).forEach((stop) => ball(stop, width, "link"));
  };
  const along = (stop, i, reach) => at(stop.frame, ...add(stop.point, standing(i), reach));

  const centres = new Map(joints.map((i) => {
    const walk = rows[i - 1][3];
    return [i, prismatic(i) ? foot(i) : at(i, 0, 0, Math.abs(walk) > 3.2 * half ? -walk / 2 : 0)];
  }));
  const toolRow = !arm.tool && count > 1 && joints.at(-1) !== count ? rows[count - 1] : null;
  const hand = handOf();
  const reach = arm.tool ? norm(column(arm.tool, 3)) : toolRow ? Math.abs(toolRow[1]) + Math.abs(toolRow[3]) : 0;
  const small = reach > 0 ? Math.min(1, reach / (7 * radius)) : 1; // hand and last joint share the tool's length
  partJoints();

  /** Direction in which the hand points, in the last frame; null where the table does not tell of a hand. */
  function handOf() {
    if (arm.tool) {
      const way = column(arm.tool, 3), far = norm(way);
      return far > 1e-9 ? [0, 1, 2].map((j) => dot(column(arm.tool, j), way) / far) : [0, 0, 1];
    }
    if (toolRow) {
      const [, a, , d, theta] = toolRow;
      if (Math.abs(d) > 1e-9) return [0, 0, Math.sign(d)];
      return Math.abs(a) > 1e-9 ? [Math.sign(a) * Math.cos(theta), -Math.sign(a) * Math.sin(theta), 0] : [0, 0, 1];
    }
    if (count < 2 || rows[count - 1][1] !== 0) return null;
    if (Math.abs(Math.sin(rows[count - 1][2])) > 1e-9) return [0, 0, 1];
    const walks = rows.map((row, i) => row[3] * dot(column(frames[i + 1], 2), column(frames[count], 2)));
    return [0, 0, Math.sign(walks.findLast((walk) => Math.abs(walk) > 1e-9) ?? 1)];
  }

  /** Move joints that lie on one another apart, along their own axes. */
  function partJoints() {
    joints.forEach((i, k) => {
      const next = joints[k + 1];
      if (next === undefined || distance(centres.get(i), centres.get(next)) > 1.6 * half) return;
      const axes = [i, next].map((j) => column(frames[j], 2));
      const sameAxis = norm(cross(...axes)) < 1e-6 && norm(cross(subtract(world(at(next)), world(at(i))), axes[0])) < 1e-6 * unit;
      if (k + 2 === joints.length && (k > 0 || sameAxis) && !prismatic(next)) {
        const back = hand && last === next && hand[2] < 0 ? -1 : 1;
        centres.set(next, at(next, 0, 0, back * (reach ? Math.max(0.8 * half, 2.2 * half * small) : 2.2 * half)));
      } else {
        centres.set(i, along(centres.get(i), i, -2.6 * half));
      }
    });
  }

  // Base: a column and a plate under joint 1.
  const first = joints[0] === 1 ? world(centres.get(1))[2] : 0;
  const lowest = Math.min(first, 0);
  const drop = lowest - (first > 2 * half ? 0 : 2.1 * half);
  tube(at(0, 0, 0, drop), at(0, 0, 0, drop + 0.5 * radius), 4.2 * radius, "base");
  tube(at(0, 0, 0, drop), at(0), 1.2 * radius, "base");

  // Links.
  const stops = new Map([[0, at(0)], ...centres]);
  for (let i = 0; i < last; i++) {
    const ends = [stops.get(i) ?? at(i), at(i), ...(i < count ? [foot(i + 1)] : [])];
    const short = hand && i + 1 === last && !centres.has(last) ? -2.4 * radius : 0;
    ends.push(centres.get(i + 1) ?? at(i + 1, ...(hand ?? [0, 0, 0]).map((x) => short * x)));
    path(ends, radius, i > 0 && prismatic(i) ? 0.62 * radius : radius);
  }
  if (centres.has(last)) path([centres.get(last), at(last)], prismatic(last) ? 0.62 * radius : radius);

  // Joints.
  for (const i of joints) {
    const centre = centres.get(i);
    if (prismatic(i)) {
      const z = standing(i), side = [1, 0, 0];
      box(centre, [side, cross(z, side), z], [1.75 * radius, 1.75 * radius, 1.1 * half], "joint", i);
      // The rod slides through its guide: what the hand loses in reach sticks out behind.
      const walk = rows[i - 1][3];
      tube(at(i), at(i, 0, 0, -walk - Math.sign(walk || 1) * 2.2 * half), 0.62 * radius, "link");
    } else {
      const wide = i === joints.at(-1) ? half * Math.max(small, 0.4) : half;
      tube(along(centre, i, -wide), along(centre, i, wide), 1.75 * radius, "joint", i);
    }
  }
  if (hand) jaws();

  /** Two fingers that slide along Y of the last frame, its origin between their tips. */
  function jaws() {
    const r = radius * Math.max(small, 0.5);
    const side = Math.abs(hand[1]) < 0.9 ? [0, 1, 0] : [1, 0, 0];
    const axes = [hand, side, cross(hand, side)];
    let palm = at(last, ...hand.map((x) => -2.4 * r * x));
    if (centres.has(last)) {
      const past = Math.max(dot(subtract(world(centres.get(last)), world(at(last))), direction(frames[last], hand)), 0);
      palm = at(last, ...hand.map((x) => (past + half + 1.6 * r) * x));
      tube(at(last), palm, 0.8 * r, "hand");
    }
    box(palm, axes, [0.55 * r, 2.3 * r, 0.8 * r], "hand");
    for (const way of [-1, 1]) {
      const finger = at(last, ...add(add(palm.point, hand, 1.9 * r), side, way * 1.9 * r));
      box(finger, axes, [1.5 * r, 0.42 * r, 0.7 * r], "hand");
    }
  }
  return { pieces, unit, radius, drop, centres };
}

/** A direction of a frame seen from the base. */
export const direction = (frame, way) => subtract(place(frame, way), place(frame, [0, 0, 0]));
