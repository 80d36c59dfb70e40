/**
 * Marching squares: the outline of what lies at or above a threshold in a picture of grey values.
 */

// Which sides of a square an outline joins, by the corners that lie above: bit 0 is the upper left, then clockwise.
// Sides: 0 upper, 1 right, 2 lower, 3 left. Of the two ways through a saddle, the one that parts what is above.
const CASES = [
  [],
  [3, 0],
  [0, 1],
  [3, 1],
  [1, 2],
  [3, 0, 1, 2],
  [0, 2],
  [3, 2],
  [2, 3],
  [2, 0],
  [0, 1, 2, 3],
  [2, 1],
  [1, 3],
  [1, 0],
  [0, 3],
  [],
];

/**
 * Find the outline.
 * @param {ArrayLike<number>} values width * height grey values, row by row
 * @param {number} width
 * @param {number} height
 * @param {number} threshold
 * @param {number} [most] values above this one are outside, too
 * @returns {Float32Array} segments, x0 y0 x1 y1 each, in pixels; the middle of the first pixel is 0.5, 0.5
 */
export function outline(values, width, height, threshold, most = Number.POSITIVE_INFINITY) {
  /** @type {number[]} */
  const segments = [];
  /** @param {number} value */
  const depth = (value) => Math.min(value - threshold, most - value);
  for (let y = 0; y + 1 < height; y += 1) {
    for (let x = 0; x + 1 < width; x += 1) {
      const at = y * width + x;
      const corners = [values[at], values[at + 1], values[at + width + 1], values[at + width]].map(depth);
      let bits = 0;
      for (let i = 0; i < 4; i += 1) if (corners[i] >= 0) bits |= 1 << i;
      for (const side of CASES[bits]) {
        const [a, b] = [corners[side], corners[(side + 1) % 4]];
        const share = Math.abs(b - a) < 1e-9 ? 0.5 : a / (a - b);
        const along = side < 2 ? share : 1 - share;
        segments.push(x + 0.5 + [along, 1, along, 0][side], y + 0.5 + [0, along, 1, along][side]);
      }
    }
  }
  return new Float32Array(segments);
}
