/**
 * Layers of a print as bytes: b"IFL1", length of the header, the header as JSON, then the beads.
 *
 * Beads are n rows of x0 y0 x1 y1 (float32, mm), n speeds (float32, mm/s) and n indices of features (uint8).
 */

/** @typedef {{beads: number, features: string[], z: number, time_s: number, ends: Float32Array, speeds: Float32Array,
 *   feature: Uint8Array}} Layer */

/**
 * Decode a layer.
 * @param {ArrayBuffer} buffer
 * @returns {Layer}
 */
export function decodeLayer(buffer) {
  const mark = new TextDecoder().decode(new Uint8Array(buffer, 0, 4));
  if (mark !== "IFL1") throw new Error("these bytes are not a layer of a print");
  const length = new DataView(buffer).getUint32(4, true);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 8, length)));
  const n = header.beads;
  // The arrays are copied, so that they need not begin at a multiple of four.
  let at = 8 + length;
  at += (4 - (at % 4)) % 4;
  const ends = new Float32Array(buffer.slice(at, at + 16 * n));
  const speeds = new Float32Array(buffer.slice(at + 16 * n, at + 20 * n));
  const feature = new Uint8Array(buffer.slice(at + 20 * n, at + 21 * n));
  return { ...header, ends, speeds, feature };
}

/**
 * The box around all beads, [x0, y0, x1, y1], mm; null for a layer without any.
 * @param {Layer} layer
 * @returns {[number, number, number, number]|null}
 */
export function layerBounds(layer) {
  if (!layer.beads) return null;
  const { ends } = layer;
  let [x0, y0, x1, y1] = [ends[0], ends[1], ends[0], ends[1]];
  for (let i = 0; i < ends.length; i += 2) {
    x0 = Math.min(x0, ends[i]);
    x1 = Math.max(x1, ends[i]);
    y0 = Math.min(y0, ends[i + 1]);
    y1 = Math.max(y1, ends[i + 1]);
  }
  return [x0, y0, x1, y1];
}
