/**
 * Triangles from the symbols of `infill/viewer/compact.py`: each lies across an edge of an earlier one.
 *
 * The same loops of edges are linked here as in `infill/kernels/mesh_traversal.py`, step by step.
 */

import { readDifference } from "./planes.js";

const NEW = 0;
const NEXT = 1;
const PREVIOUS = 2;
const BOTH = 3;
const OLD = 4;

/**
 * Read triangles, and the places of their vertices in steps.
 *
 * @param {Uint8Array} symbols
 * @param {Uint8Array} named Four planes of bytes.
 * @param {Uint8Array} places Six planes of bytes.
 * @param {number} vertexCount
 * @param {number} triangleCount
 */
export function decodeCompact(symbols, named, places, vertexCount, triangleCount) {
  const indices = new Uint32Array(3 * triangleCount);
  const steps = new Uint16Array(3 * vertexCount);
  const most = 3 * triangleCount + 3;
  const begin = new Int32Array(most);
  const end = new Int32Array(most);
  const apex = new Int32Array(most);
  const before = new Int32Array(most);
  const after = new Int32Array(most);
  const waits = new Uint8Array(most);
  const leaving = new Int32Array(vertexCount).fill(-1);
  const stack = new Int32Array(most);
  const names = named.length / 4;
  let edges = 0;
  let depth = 0;
  let vertices = 0;
  let nextName = 0;
  let nextSymbol = 0;
  let triangles = 0;

  const readName = () => {
    const i = nextName++;
    return named[i] | (named[names + i] << 8) | (named[2 * names + i] << 16) | (named[3 * names + i] << 24);
  };
  /** Read the place of a new vertex, from that of a + b - c, of which some may be missing: -1. */
  const readPlace = (/** @type {number} */ a, /** @type {number} */ b, /** @type {number} */ c) => {
    for (let axis = 0; axis < 3; axis++) {
      const difference = readDifference(places, vertexCount, 3, axis, vertices);
      const first = a < 0 ? 0 : steps[3 * a + axis] - steps[3 * c + axis];
      steps[3 * vertices + axis] = first + (b < 0 ? 0 : steps[3 * b + axis]) + difference;
    }
    return vertices++;
  };
  /** Add an edge of a loop, which waits on the stack. */
  const addEdge = (/** @type {number} */ a, /** @type {number} */ b, /** @type {number} */ c) => {
    begin[edges] = a;
    end[edges] = b;
    apex[edges] = c;
    waits[edges] = 1;
    leaving[a] = edges;
    stack[depth++] = edges;
    return edges++;
  };
  const link = (/** @type {number} */ first, /** @type {number} */ second) => {
    after[first] = second;
    before[second] = first;
  };
  const addTriangle = (/** @type {number} */ a, /** @type {number} */ b, /** @type {number} */ c) => {
    indices[3 * triangles] = a;
    indices[3 * triangles + 1] = b;
    indices[3 * triangles + 2] = c;
    triangles++;
  };

  while (triangles < triangleCount) {
    const corners = [0, 0, 0];
    for (let k = 0; k < 3; k++) {
      const ago = readName();
      corners[k] = ago ? vertices - ago : readPlace(-1, vertices - 1, -1);
    }
    const [x, y, z] = corners;
    addTriangle(x, y, z);
    const first = addEdge(x, y, z);
    addEdge(y, z, x);
    addEdge(z, x, y);
    link(first, first + 1);
    link(first + 1, first + 2);
    link(first + 2, first);
    while (depth) {
      const g = stack[--depth];
      if (!waits[g]) continue;
      const symbol = symbols[nextSymbol++];
      if (symbol > OLD) continue;
      const [a, b, p, n] = [begin[g], end[g], before[g], after[g]];
      waits[g] = 0;
      if (symbol === BOTH) {
        addTriangle(b, a, end[n]);
        waits[p] = waits[n] = 0;
        link(before[p], after[n]);
      } else if (symbol === NEXT) {
        const c = end[n];
        addTriangle(b, a, c);
        waits[n] = 0;
        const e = addEdge(a, c, b);
        const beyond = after[n];
        link(p, e);
        link(e, beyond);
      } else if (symbol === PREVIOUS) {
        const c = begin[p];
        addTriangle(b, a, c);
        waits[p] = 0;
        const e = addEdge(c, b, a);
        link(before[p], e);
        link(e, n);
      } else {
        const c = symbol === NEW ? readPlace(a, b, apex[g]) : vertices - readName();
        const other = symbol === OLD ? leaving[c] : -1;
        addTriangle(b, a, c);
        const left = addEdge(a, c, b);
        const right = addEdge(c, b, a);
        if (other >= 0 && waits[other] && other !== g) {
          const earlier = before[other];
          link(earlier, right);
          link(left, other);
        } else {
          link(left, right);
        }
        link(p, left);
        link(right, n);
      }
    }
  }
  return { indices, steps };
}
