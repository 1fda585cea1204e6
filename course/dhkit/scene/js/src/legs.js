// Planar parallel robots: three legs between anchors A and the joints B of a platform in a pose [x, y, phi].
// A leg is drawn out (3-RPR), or folded at an elbow by a driven bar (3-RRR). Metres and radians.

const STEPS = 1440; // of the platform's angle in the search for modes
const NEAR = 0.15; // of the platform's size: with a smaller determinant the lines nearly meet in one point

/** The joints of a platform in a pose. */
export function jointsOf(platform, [x, y, phi]) {
  const c = Math.cos(phi), s = Math.sin(phi);
  return platform.map(([u, v]) => [x + c * u - s * v, y + s * u + c * v]);
}

/** Angles of a driven bar that lets the other one reach a point, with the elbow on the side `sign`; null if none does. */
function driveTo([x, y], [l1, l2], sign) {
  const cosine = (x * x + y * y - l1 * l1 - l2 * l2) / (2 * l1 * l2);
  if (Math.abs(cosine) > 1) return null;
  const bend = sign * Math.acos(cosine);
  return Math.atan2(y, x) - Math.atan2(l2 * Math.sin(bend), l1 + l2 * Math.cos(bend));
}

/** What the drives measure in a pose: leg lengths, or angles of the driven bars; null where a leg does not reach. */
export function drivesAt({ base, platform, bars, elbows }, pose) {
  const drives = jointsOf(platform, pose).map(([x, y], i) => {
    const leg = [x - base[i][0], y - base[i][1]];
    return bars ? driveTo(leg, bars, elbows[i]) : Math.hypot(...leg);
  });
  return drives.includes(null) ? null : drives;
}

/** Where the last bar of each leg begins, and its length, for given drives. */
export function lastBars({ base, bars }, drives) {
  if (!bars) return { feet: base, lengths: drives };
  const feet = base.map(([x, y], i) => [x + bars[0] * Math.cos(drives[i]), y + bars[0] * Math.sin(drives[i])]);
  return { feet, lengths: base.map(() => bars[1]) };
}

/**
 * All poses that three bars of given lengths from given feet allow, by increasing phi.
 *
 * For one phi, the differences of the three circles give x and y, and the first circle is left as a function of phi
 * alone, cleared of its denominator: its changes of sign are the modes.
 */
export function modes(feet, platform, lengths) {
  const at = (phi) => {
    const turned = jointsOf(platform, [0, 0, phi]), c = feet.map(([x, y], i) => [x - turned[i][0], y - turned[i][1]]);
    const [rows, sides] = [[], []];
    for (const i of [1, 2]) {
      rows.push([2 * (c[0][0] - c[i][0]), 2 * (c[0][1] - c[i][1])]);
      sides.push(lengths[i] ** 2 - lengths[0] ** 2 - c[i][0] ** 2 - c[i][1] ** 2 + c[0][0] ** 2 + c[0][1] ** 2);
    }
    const det = rows[0][0] * rows[1][1] - rows[0][1] * rows[1][0];
    const x = sides[0] * rows[1][1] - sides[1] * rows[0][1], y = rows[0][0] * sides[1] - rows[1][0] * sides[0];
    const left = (x - det * c[0][0]) ** 2 + (y - det * c[0][1]) ** 2 - (det * lengths[0]) ** 2;
    return { left, pose: [x / det, y / det, phi] };
  };
  const step = (2 * Math.PI) / STEPS, start = -Math.PI + 0.05 * step; // not where a symmetric robot has a mode
  const value = (phi) => at(phi).left;
  const root = (low, high) => {
    const sign = Math.sign(value(low));
    for (let round = 0; round < 60; round++) {
      const middle = (low + high) / 2;
      if (value(middle) * sign > 0) low = middle;
      else high = middle;
    }
    return (low + high) / 2;
  };
  /** Where a value that keeps its sign comes closest to zero: there two modes may lie close together. */
  const closest = (low, high, sign) => {
    for (let round = 0; round < 60; round++) {
      const [a, b] = [low + (high - low) / 3, high - (high - low) / 3];
      if (sign * value(a) < sign * value(b)) high = b;
      else low = a;
    }
    return (low + high) / 2;
  };
  const values = Array.from({ length: STEPS + 2 }, (_, k) => value(start + k * step)), angles = [];
  for (let k = 0; k < STEPS; k++) {
    const low = start + k * step, [one, two, three] = values.slice(k, k + 3), sign = Math.sign(one);
    if (one * two < 0) angles.push(root(low, low + step));
    else if (two * three > 0 && sign * two <= sign * one && sign * two <= sign * three) {
      const dip = closest(low, low + 2 * step, sign);
      if (sign * value(dip) < 0) angles.push(root(low, dip), root(dip, low + 2 * step));
    }
  }
  return angles.map((phi) => at(turn(phi)).pose).sort((one, other) => one[2] - other[2]);
}

/** The smallest turn between two angles, from -pi to pi. */
const turn = (angle) => Math.atan2(Math.sin(angle), Math.cos(angle));

/** How far one pose is from another: metres, with the turn at the rim of the platform. */
export const apart = (one, other, size) => Math.hypot(one[0] - other[0], one[1] - other[1]) + size * Math.abs(turn(one[2] - other[2]));

/** The determinant of the bars' directions and moments about P, in metres: 0 where their lines meet in one point. */
export function determinant(feet, platform, pose) {
  const rows = jointsOf(platform, pose).map(([x, y], i) => {
    const way = [x - feet[i][0], y - feet[i][1]], length = Math.hypot(...way), u = way.map((part) => part / length);
    return [...u, (x - pose[0]) * u[1] - (y - pose[1]) * u[0]];
  });
  const [[a, b, c], [d, e, f], [g, h, i]] = rows;
  return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g);
}

/** Where the lines of two bars meet; null where they are parallel. */
function meeting(feet, joints, i, j) {
  const [u, v] = [i, j].map((k) => [joints[k][0] - feet[k][0], joints[k][1] - feet[k][1]]);
  const across = u[0] * v[1] - u[1] * v[0], gap = [feet[j][0] - feet[i][0], feet[j][1] - feet[i][1]];
  if (Math.abs(across) < 1e-6 * Math.hypot(...u) * Math.hypot(...v)) return null;
  const share = (gap[0] * v[1] - gap[1] * v[0]) / across;
  return [feet[i][0] + share * u[0], feet[i][1] + share * u[1]];
}

/** Whether the platform can begin to move with its drives locked, and about which point (null: it shifts). */
export function singular(feet, platform, pose, size) {
  const det = determinant(feet, platform, pose);
  if (Math.abs(det) > NEAR * size) return null;
  const joints = jointsOf(platform, pose);
  const points = [[0, 1], [1, 2], [2, 0]].flatMap(([i, j]) => [meeting(feet, joints, i, j) ?? []]).filter((point) => point.length);
  return { about: points[0] ?? null };
}
