/**
 * Surfaces from bytes, as `infill/viewer/packing.py` describes them.
 *
 * @typedef {object} Surface
 * @property {string} name
 * @property {boolean} closed Whether the surface bounds a solid, so that a cut through it can be filled.
 * @property {string} [solid] Surfaces with the same word bound one solid together, such as a skin and the voids inside.
 * @property {[number, number, number] | null} colour From 0 to 1, sRGB.
 * @property {[number, number, number]} low Lower corner of the bounds, mm.
 * @property {[number, number, number]} size Size of the bounds, mm.
 * @property {Float32Array} positions Vertices x, y, z, mm.
 * @property {Uint32Array} indices Three vertices a triangle.
 * @property {Uint8Array | null} values A number for every vertex.
 *
 * @typedef {{surfaces: Surface[]}} Decoded
 */

import { decodeCompact } from "./compact.js";

const STEPS = 65535;

/**
 * Read packed surfaces.
 *
 * @param {ArrayBuffer} buffer
 * @returns {Decoded}
 */
export function decodeMesh(buffer) {
  const { header, start } = readHeader(buffer, "IFM1");
  return { surfaces: header.surfaces.map((/** @type {any} */ entry) => decodeSurface(buffer, start, entry)) };
}

/**
 * Read the JSON header of packed data; return it and where the arrays begin.
 *
 * @param {ArrayBuffer} buffer
 * @param {string} magic The four letters that the data begin with.
 * @returns {{header: any, start: number}}
 */
export function readHeader(buffer, magic) {
  const bytes = new Uint8Array(buffer);
  const text = new TextDecoder();
  if (text.decode(bytes.subarray(0, 4)) !== magic) throw new Error(`these are not data of the form ${magic}`);
  const length = new DataView(buffer).getUint32(4, true);
  return { header: JSON.parse(text.decode(bytes.subarray(8, 8 + length))), start: 8 + length };
}

/**
 * Read one surface.
 *
 * @param {ArrayBuffer} buffer
 * @param {number} start Where the arrays begin.
 * @param {any} entry Its entry in the header.
 * @returns {Surface}
 */
function decodeSurface(buffer, start, entry) {
  const { steps, indices } = entry.symbols ? readCompact(buffer, start, entry) : readPlain(buffer, start, entry);
  return {
    name: entry.name,
    closed: entry.closed !== false,
    colour: entry.colour,
    low: entry.low,
    size: entry.size,
    positions: restorePositions(steps, entry.low, entry.size),
    indices,
    values: entry.values === null ? null : new Uint8Array(buffer, start + entry.values, entry.vertices),
  };
}

/**
 * @param {ArrayBuffer} buffer
 * @param {number} start
 * @param {any} entry
 */
function readPlain(buffer, start, entry) {
  const differences = new Uint32Array(buffer, start + entry.indices, 3 * entry.triangles);
  return {
    steps: new Uint16Array(buffer, start + entry.positions, 3 * entry.vertices),
    indices: addPrevious(differences),
  };
}

/**
 * @param {ArrayBuffer} buffer
 * @param {number} start
 * @param {any} entry
 */
function readCompact(buffer, start, entry) {
  const [symbols, named, places] = [entry.symbols, entry.named, entry.places].map(
    ([offset, length]) => new Uint8Array(buffer, start + offset, length),
  );
  return decodeCompact(symbols, named, places, entry.vertices, entry.triangles);
}

/**
 * Turn steps of the bounds into mm.
 *
 * @param {Uint16Array} steps
 * @param {number[]} low
 * @param {number[]} size
 */
export function restorePositions(steps, low, size) {
  const positions = new Float32Array(steps.length);
  for (let axis = 0; axis < 3; axis++) {
    const scale = size[axis] / STEPS;
    for (let i = axis; i < steps.length; i += 3) positions[i] = low[axis] + steps[i] * scale;
  }
  return positions;
}

/**
 * Add to each number the one before it, modulo 2³².
 *
 * @param {Uint32Array} differences
 */
function addPrevious(differences) {
  const numbers = new Uint32Array(differences.length);
  let last = 0;
  for (let i = 0; i < differences.length; i++) {
    last = (last + differences[i]) >>> 0;
    numbers[i] = last;
  }
  return numbers;
}
