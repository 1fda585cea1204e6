// Forward kinematics of a modified DH table. Matrices are 4x4 in one array, row by row; metres and radians.

export const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

/** Trans_x(a) Rot_x(alpha) Trans_z(d) Rot_z(theta). */
export function transform(a, alpha, d, theta) {
  const ca = Math.cos(alpha), sa = Math.sin(alpha), c = Math.cos(theta), s = Math.sin(theta);
  return [c, -s, 0, a, s * ca, c * ca, -sa, -sa * d, s * sa, c * sa, ca, ca * d, 0, 0, 0, 1];
}

export function multiply(A, B) {
  const C = new Array(16).fill(0);
  for (let i = 0; i < 4; i++) {
    for (let j = 0; j < 4; j++) {
      for (let k = 0; k < 4; k++) C[4 * i + j] += A[4 * i + k] * B[4 * k + j];
    }
  }
  return C;
}

/** Rows [sigma, a, alpha, d, theta] for joint values q: each joint adds to the moving entry of the rows it drives. */
export function rowsAt(arm, q) {
  return arm.rows.map(([sigma, a, alpha, d, theta], i) => {
    const moved = arm.coupling[i].reduce((sum, share, j) => sum + share * q[j], 0);
    return sigma === 1 ? [sigma, a, alpha, d + moved, theta] : [sigma, a, alpha, d, theta + moved];
  });
}

/** Frames 0 to n seen from the base, and the tool's frame behind them if the arm has one. */
export function chain(arm, q) {
  const frames = [IDENTITY];
  for (const [, a, alpha, d, theta] of rowsAt(arm, q)) {
    frames.push(multiply(frames.at(-1), transform(a, alpha, d, theta)));
  }
  if (arm.tool) frames.push(multiply(frames.at(-1), arm.tool));
  return frames;
}

/** Frame i - 1 on its way to frame i, for row i - 1 from 0: `share` of the moves a, alpha, d, theta done, from 0 to 4. */
export function walk(arm, q, row, share) {
  const [, ...moves] = rowsAt(arm, q)[row];
  const done = moves.map((move, k) => move * Math.min(Math.max(share - k, 0), 1));
  return multiply(chain(arm, q)[row], transform(...done));
}

/** The hand seen from the base. */
export const forward = (arm, q) => chain(arm, q).at(-1);

/** Where a point of a frame lies, seen from the base. */
export function place(frame, [x, y, z]) {
  return [0, 4, 8].map((i) => frame[i] * x + frame[i + 1] * y + frame[i + 2] * z + frame[i + 3]);
}

/** Column 0, 1 or 2 of a frame, its X, Y or Z axis; column 3 is its origin. */
export const column = (frame, j) => [frame[j], frame[4 + j], frame[8 + j]];

export const add = (u, v, share = 1) => u.map((x, i) => x + share * v[i]);
export const subtract = (u, v) => add(u, v, -1);
export const dot = (u, v) => u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
export const cross = (u, v) => [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
export const norm = (u) => Math.hypot(...u);
