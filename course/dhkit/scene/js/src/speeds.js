// How fast the hand can go in each direction, and what it loses where the arm is singular.

import { eigen, product, transposed } from "./algebra.js";
import { add, chain } from "./kinematics.js";
import { jacobian, room } from "./follow.js";

const DRAWS = 24; // postures that tell what is usual for a robot
const NEAR = 0.12; // of the usual: below this a posture is called nearly singular
const BESIDE = 0.004; // radians
const ZERO = 1e-5;

/** Singular values of J, the largest first, each with its direction `left` of the hand. */
const singular = (J) => eigen(product(J, transposed(J))).map(({ value, vector }) => ({ size: Math.sqrt(Math.max(value, 0)), left: vector }));

/** Jacobians of the place, in sizes of the robot, and of the turn that is possible without leaving the place. */
function jacobians(arm, unit, q) {
  const columns = jacobian(arm, chain(arm, q));
  const place = transposed(columns.map(({ v }) => v.map((x) => x / unit))), turn = transposed(columns.map(({ w }) => w));
  return { place, whole: [...place, ...turn], turn: product(turn, room(place)) };
}

/** Numbers from 0 to 1 that are the same in every browser. */
function* draws() {
  for (let seed = 1; ;) {
    seed = (seed * 16807) % 2147483647;
    yield seed / 2147483647;
  }
}

/** For `place` and `turn`: the rank that an arm usually has, and the smallest singular value that goes with it. */
export function usual(arm, unit) {
  const numbers = draws();
  const postures = Array.from({ length: DRAWS }, () => arm.joints.map(({ low, high }) => low + numbers.next().value * (high - low)));
  const found = postures.map((q) => jacobians(arm, unit, q));
  return Object.fromEntries(["place", "turn"].map((kind) => {
    const all = found.map((each) => singular(each[kind]).map(({ size }) => size));
    const middle = transposed(all).map((sizes) => sizes.sort((a, b) => a - b)[DRAWS >> 1]).filter((size) => size > ZERO);
    return [kind, { rank: middle.length, smallest: middle.at(-1) ?? 1 }];
  }));
}

/**
 * The velocity ellipsoid of the hand, and what is lost near a singular posture.
 *
 * Gives `axes`, three {way, speed} of the ellipsoid, for joint speeds of total 1 rad/s or m/s; `lost`, directions
 * {way, turn} along which (or, if `turn`, about which, in its place) the hand cannot move; `free`, as many motions of
 * the joints, the largest by 1, that leave the hand nearly at rest.
 */
export function speeds(arm, unit, q, normal) {
  const here = jacobians(arm, unit, q);
  const axes = singular(here.place).map(({ size, left }) => ({ way: left, speed: size * unit }));
  const lost = ["place", "turn"].flatMap((kind) => {
    const { rank, smallest } = normal[kind];
    const count = singular(here[kind]).slice(0, rank).filter(({ size }) => size < NEAR * smallest).length;
    if (!count) return [];
    // In a singular posture itself, what such an arm can never do is as slow; a small way beside it the two part.
    const aside = rank === 3 ? q : q.map((value, j) => value + BESIDE * Math.cos(2.4 * j + 0.7) * (arm.joints[j].prismatic ? unit : 1));
    return singular(jacobians(arm, unit, aside)[kind]).slice(rank - count, rank).map(({ left }) => ({ way: left, turn: kind === "turn" }));
  });
  const rank = normal.place.rank + normal.turn.rank;
  return { axes, lost, free: lost.length ? freeOf(normal.turn.rank ? here.whole : here.place, rank, lost.length) : [] };
}

/** The `count` joint motions that move the hand least, besides those of a redundant arm, each with a joint of its own. */
function freeOf(J, rank, count) {
  const motions = eigen(product(transposed(J), J)).slice(rank - count, rank).map(({ vector }) => vector);
  motions.forEach((_, k) => {
    const lead = motions[k].reduce((best, x, j) => (Math.abs(x) > Math.abs(motions[k][best]) + 1e-9 ? j : best), 0);
    motions[k] = motions[k].map((x) => x / motions[k][lead]);
    motions.forEach((other, i) => {
      if (i !== k) motions[i] = add(other, motions[k], -other[lead]);
    });
  });
  return motions.map((motion) => {
    const largest = motion.reduce((most, x) => (Math.abs(x) > Math.abs(most) + 1e-9 ? x : most), 0);
    return motion.map((x) => x / largest);
  });
}
