// Small dense matrices as lists of rows.

/** The solution x of A x = b, A square and not singular: Gauss with the largest pivots. */
export function solve(A, b) {
  const n = b.length, M = A.map((row, i) => [...row, b[i]]);
  for (let k = 0; k < n; k++) {
    let pivot = k;
    for (let i = k + 1; i < n; i++) if (Math.abs(M[i][k]) > Math.abs(M[pivot][k])) pivot = i;
    [M[k], M[pivot]] = [M[pivot], M[k]];
    for (let i = k + 1; i < n; i++) {
      const share = M[i][k] / M[k][k];
      for (let j = k; j <= n; j++) M[i][j] -= share * M[k][j];
    }
  }
  const x = new Array(n);
  for (let k = n - 1; k >= 0; k--) {
    x[k] = M[k][n];
    for (let j = k + 1; j < n; j++) x[k] -= M[k][j] * x[j];
    x[k] /= M[k][k];
  }
  return x;
}

export const transposed = (A) => A[0].map((_, j) => A.map((row) => row[j]));
export const times = (A, x) => A.map((row) => row.reduce((sum, entry, j) => sum + entry * x[j], 0));
export const product = (A, B) => {
  const columns = transposed(B);
  return A.map((row) => times(columns, row));
};

/** J J^T + damping I, which can always be solved with. */
export function damped(J, damping) {
  const S = product(J, transposed(J));
  S.forEach((row, i) => (row[i] += damping));
  return S;
}

/** Eigenvalues of a symmetric matrix, the largest first, each with its unit vector: Jacobi's rotations. */
export function eigen(S) {
  const n = S.length, A = S.map((row) => [...row]), V = S.map((_, i) => S.map((_, j) => Number(i === j)));
  const size = Math.max(...A.flat().map(Math.abs)) || 1;
  for (let sweep = 0; sweep < 40; sweep++) {
    let off = 0;
    for (let p = 0; p < n; p++) {
      for (let q = p + 1; q < n; q++) {
        off = Math.max(off, Math.abs(A[p][q]));
        if (Math.abs(A[p][q]) < 1e-16 * size) continue;
        const angle = 0.5 * Math.atan2(2 * A[p][q], A[p][p] - A[q][q]), c = Math.cos(angle), s = Math.sin(angle);
        for (const row of [...A, ...V]) [row[p], row[q]] = [c * row[p] + s * row[q], c * row[q] - s * row[p]];
        for (let j = 0; j < n; j++) [A[p][j], A[q][j]] = [c * A[p][j] + s * A[q][j], c * A[q][j] - s * A[p][j]];
      }
    }
    if (off < 1e-15 * size) break;
  }
  return A.map((row, i) => ({ value: row[i], vector: V.map((each) => each[i]) })).sort((one, other) => other.value - one.value);
}
