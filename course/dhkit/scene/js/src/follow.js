// The arm follows its hand: damped least squares on the geometric Jacobian, within the limits of the joints.

import { damped, product, solve, times, transposed } from "./algebra.js";
import { add, chain, column, cross, norm, subtract } from "./kinematics.js";

const ROUNDS = 40;
const LONGEST = 0.25; // step of the hand in one round, in sizes of the robot

/** The projection of joint speeds on those that leave the hand in its place; V holds its speeds as rows. */
export function room(V) {
  const S = damped(V, 1e-8);
  return transposed(transposed(V).map((speed, j) => times(transposed(V), solve(S, speed)).map((x, i) => Number(i === j) - x)));
}

/** Columns (speed of the hand, its angular velocity) of the joints: a list of {v, w}. */
export function jacobian(arm, frames) {
  const hand = column(frames.at(-1), 3), zero = [0, 0, 0];
  return arm.joints.map((_, j) => arm.rows.reduce(({ v, w }, [sigma], i) => {
    const share = arm.coupling[i][j];
    if (!share) return { v, w };
    const z = column(frames[i + 1], 2);
    if (sigma === 1) return { v: add(v, z, share), w };
    return { v: add(v, cross(z, subtract(hand, column(frames[i + 1], 3))), share), w: add(w, z, share) };
  }, { v: zero, w: zero }));
}

/** The turn that leads from the axes of one frame to those of another, as a vector along its axis, in radians. */
export function turnBetween(from, to) {
  const sine = [0, 1, 2].reduce((sum, k) => add(sum, cross(column(from, k), column(to, k)), 0.5), [0, 0, 0]);
  const cosine = ([0, 1, 2].reduce((sum, k) => sum + column(from, k).reduce((dot, x, i) => dot + x * column(to, k)[i], 0), 0) - 1) / 2;
  const length = norm(sine);
  return length < 1e-12 ? sine : sine.map((x) => (x * Math.atan2(length, cosine)) / length);
}

/** A joint that may go round and round. */
const endless = ({ prismatic, low, high }) => !prismatic && high - low > 2 * Math.PI - 1e-6;

/** Joint values within their limits: a joint that may go round is turned back, any other one stops. */
export function within(joints, q) {
  return q.map((value, j) => {
    const { low, high } = joints[j];
    if (!endless(joints[j])) return Math.min(Math.max(value, low), high);
    const turns = value < low ? Math.ceil((low - value) / (2 * Math.PI)) : value > high ? -Math.ceil((value - high) / (2 * Math.PI)) : 0;
    return value + 2 * Math.PI * turns;
  });
}

/** Whether two postures are the same, up to full turns. */
export const same = (joints, one, other, close = 1e-4) => one.every((value, j) => {
  const apart = value - other[j];
  return Math.abs(joints[j].prismatic ? apart : Math.atan2(Math.sin(apart), Math.cos(apart))) < close;
});

/**
 * The step of the joints for an error of the hand's place, and of its orientation as far as the place leaves room.
 * Place comes first: the second step is taken among those that leave the hand where it is.
 */
function stepFor(V, W, place, turn, damping) {
  const inverse = (J, e) => times(transposed(J), solve(damped(J, damping), e));
  const first = inverse(V, place);
  if (!turn) return first;
  const free = room(V), second = times(free, inverse(product(W, free), subtract(turn, times(W, first))));
  return add(first, second);
}

/**
 * Joint values near q that bring the hand to a frame, or as close as the arm can.
 *
 * `unit` is the size of the robot; `turning` tells whether the orientation counts too. Gives {q, missed, turned}: what
 * is left of the distance, in metres, and of the turn, in radians.
 */
export function follow(arm, unit, q, target, turning = true) {
  const { joints } = arm;
  /** A posture with what is left to go, in sizes of the robot and in radians. */
  const look = (q) => {
    const frames = chain(arm, q), hand = frames.at(-1);
    const way = subtract(column(target, 3), column(hand, 3)).map((x) => x / unit), turn = turning ? turnBetween(hand, target) : null;
    const missed = norm(way), turned = turn ? norm(turn) : 0;
    return { q, frames, way, turn, missed, turned, worth: missed + 0.01 * turned };
  };
  let here = look(q), damping = 1e-3;
  for (let round = 0; round < ROUNDS && here.worth > 1e-11 && damping < 1e6; round++) {
    const step = stepWithin(arm, unit, here, damping);
    const next = look(q.map((_, j) => here.q[j] + Math.min(Math.max(step[j], -0.6), 0.6)));
    // Levenberg and Marquardt: bolder after a step that helped, more careful after one that did not.
    if (next.worth < here.worth) [here, damping] = [next, Math.max(damping / 8, 1e-10)];
    else damping *= 6;
  }
  return { q: within(joints, here.q), missed: here.missed * unit, turned: here.turned };
}

/** A step of all joints. Those that would pass a limit stop there, and the others make up for it. */
function stepWithin(arm, unit, { q, frames, way, turn, missed }, damping) {
  const { joints } = arm, columns = jacobian(arm, frames), step = new Array(joints.length).fill(0);
  const short = Math.min(1, LONGEST / Math.max(missed, 1e-12));
  let free = joints.map((_, j) => j), place = way.map((x) => short * x), rest = turn;
  while (free.length) {
    const V = transposed(free.map((j) => columns[j].v.map((x) => x / unit))), W = transposed(free.map((j) => columns[j].w));
    const found = stepFor(V, W, place, rest, damping);
    free.forEach((j, k) => (step[j] = found[k]));
    const stopped = free.filter((j) => !endless(joints[j]) && (q[j] + step[j] < joints[j].low || q[j] + step[j] > joints[j].high));
    for (const j of stopped) {
      step[j] = Math.min(Math.max(q[j] + step[j], joints[j].low), joints[j].high) - q[j];
      place = add(place, columns[j].v, -step[j] / unit);
      if (rest) rest = add(rest, columns[j].w, -step[j]);
    }
    if (!stopped.length) break;
    free = free.filter((j) => !stopped.includes(j));
  }
  return step;
}
