/**
 * Normals of triangles, smooth where a surface is, and sharp where it has an edge.
 *
 * Corners of a vertex share a normal if the triangles around it all lie within `CREASE`; else every corner takes the
 * mean of those triangles that do so with its own, and the vertex is split where these differ.
 */

const CREASE = Math.PI / 6;
const WITHIN = Math.cos(CREASE);
const ALL_WITHIN = Math.cos(CREASE / 2); // of the mean: then any two of them are within CREASE
const SAME = 0.9998;

/**
 * Compute normals; split vertices at sharp edges.
 *
 * @param {Float32Array} positions x, y, z of every vertex.
 * @param {Uint32Array} indices Three vertices a triangle.
 * @returns {{positions: Float32Array, normals: Float32Array, indices: Uint32Array, origin: Uint32Array}}
 *   `origin` has the number of the vertex that each vertex came from, beginning with all of them in their order.
 */
export function computeNormals(positions, indices) {
  const count = positions.length / 3;
  const faces = faceNormals(positions, indices);
  const { starts, corners } = cornersOfVertices(count, indices);
  const normals = new Float32Array(positions.length);
  const outIndices = indices.slice();
  /** @type {number[]} */
  const addedNormals = [];
  /** @type {number[]} */
  const addedOrigin = [];
  const sum = [0, 0, 0];

  for (let vertex = 0; vertex < count; vertex++) {
    const begin = starts[vertex];
    const end = starts[vertex + 1];
    sumNormals(faces, corners, begin, end, -1, sum);
    normals.set(sum, 3 * vertex);
    if (isSmooth(faces, corners, begin, end, sum)) continue;
    let used = false;
    const firstAdded = addedOrigin.length;
    for (let i = begin; i < end; i++) {
      sumNormals(faces, corners, begin, end, (corners[i] / 3) | 0, sum);
      if (!used) {
        normals.set(sum, 3 * vertex);
        used = true;
        continue;
      }
      if (isSame(normals, 3 * vertex, sum)) continue;
      let added = firstAdded;
      while (added < addedOrigin.length && !isSame(addedNormals, 3 * added, sum)) added++;
      if (added === addedOrigin.length) {
        addedNormals.push(sum[0], sum[1], sum[2]);
        addedOrigin.push(vertex);
      }
      outIndices[corners[i]] = count + added;
    }
  }
  return withAdded(positions, normals, outIndices, addedNormals, addedOrigin);
}

/**
 * Compute the unit normal of every face, and twice its area: (nx, ny, nz, area).
 *
 * @param {Float32Array} positions
 * @param {Uint32Array} indices
 */
function faceNormals(positions, indices) {
  const faces = new Float32Array((4 * indices.length) / 3);
  for (let corner = 0, out = 0; corner < indices.length; corner += 3, out += 4) {
    const a = 3 * indices[corner];
    const b = 3 * indices[corner + 1];
    const c = 3 * indices[corner + 2];
    const ux = positions[b] - positions[a];
    const uy = positions[b + 1] - positions[a + 1];
    const uz = positions[b + 2] - positions[a + 2];
    const vx = positions[c] - positions[a];
    const vy = positions[c + 1] - positions[a + 1];
    const vz = positions[c + 2] - positions[a + 2];
    const x = uy * vz - uz * vy;
    const y = uz * vx - ux * vz;
    const z = ux * vy - uy * vx;
    const length = Math.sqrt(x * x + y * y + z * z);
    if (length === 0) continue; // a face without an area has no normal
    faces[out] = x / length;
    faces[out + 1] = y / length;
    faces[out + 2] = z / length;
    faces[out + 3] = length;
  }
  return faces;
}

/**
 * List the corners at every vertex: those of vertex v are corners[starts[v]] up to corners[starts[v + 1]].
 *
 * @param {number} count
 * @param {Uint32Array} indices
 */
function cornersOfVertices(count, indices) {
  const starts = new Uint32Array(count + 2);
  for (const vertex of indices) starts[vertex + 2]++;
  for (let vertex = 2; vertex < count + 2; vertex++) starts[vertex] += starts[vertex - 1];
  const corners = new Uint32Array(indices.length);
  for (let corner = 0; corner < indices.length; corner++) corners[starts[indices[corner] + 1]++] = corner;
  return { starts, corners };
}

/**
 * Add up the normals of the faces at a vertex, by area: of all, or of those within the crease of one.
 *
 * @param {Float32Array} faces
 * @param {Uint32Array} corners
 * @param {number} begin
 * @param {number} end
 * @param {number} own The face, or -1.
 * @param {number[]} sum Set to the unit normal.
 */
function sumNormals(faces, corners, begin, end, own, sum) {
  let x = 0;
  let y = 0;
  let z = 0;
  const o = 4 * own;
  for (let i = begin; i < end; i++) {
    const f = 4 * ((corners[i] / 3) | 0);
    if (own >= 0 && f !== o) {
      const dot = faces[o] * faces[f] + faces[o + 1] * faces[f + 1] + faces[o + 2] * faces[f + 2];
      if (dot < WITHIN) continue;
    }
    x += faces[f] * faces[f + 3];
    y += faces[f + 1] * faces[f + 3];
    z += faces[f + 2] * faces[f + 3];
  }
  const length = Math.sqrt(x * x + y * y + z * z) || 1;
  sum[0] = x / length;
  sum[1] = y / length;
  sum[2] = z / length;
}

/**
 * Tell whether all faces at a vertex lie within the crease of one another.
 *
 * @param {Float32Array} faces
 * @param {Uint32Array} corners
 * @param {number} begin
 * @param {number} end
 * @param {number[]} mean
 */
function isSmooth(faces, corners, begin, end, mean) {
  for (let i = begin; i < end; i++) {
    const f = 4 * ((corners[i] / 3) | 0);
    const dot = faces[f] * mean[0] + faces[f + 1] * mean[1] + faces[f + 2] * mean[2];
    if (dot < ALL_WITHIN && faces[f + 3] > 0) return false;
  }
  return true;
}

/**
 * Tell whether a normal in an array is nearly another.
 *
 * @param {ArrayLike<number>} normals
 * @param {number} at
 * @param {number[]} other
 */
function isSame(normals, at, other) {
  return normals[at] * other[0] + normals[at + 1] * other[1] + normals[at + 2] * other[2] > SAME;
}

/**
 * Append the vertices that were added.
 *
 * @param {Float32Array} positions
 * @param {Float32Array} normals
 * @param {Uint32Array} indices
 * @param {number[]} addedNormals
 * @param {number[]} addedOrigin
 */
function withAdded(positions, normals, indices, addedNormals, addedOrigin) {
  const count = positions.length / 3;
  const origin = new Uint32Array(count + addedOrigin.length);
  for (let vertex = 0; vertex < count; vertex++) origin[vertex] = vertex;
  origin.set(addedOrigin, count);
  const allPositions = new Float32Array(3 * origin.length);
  allPositions.set(positions);
  const allNormals = new Float32Array(3 * origin.length);
  allNormals.set(normals);
  allNormals.set(addedNormals, 3 * count);
  for (let vertex = count; vertex < origin.length; vertex++) {
    const from = 3 * origin[vertex];
    allPositions.set(positions.subarray(from, from + 3), 3 * vertex);
  }
  return { positions: allPositions, normals: allNormals, indices, origin };
}
