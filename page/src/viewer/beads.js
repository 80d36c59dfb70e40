/**
 * Lines of filament, as beads with a round top: one instance of a small roof for every segment.
 *
 * Every layer is a mesh of its own, so that layers can be hidden, and only those that are shown reach the graphics card.
 */

import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  Group,
  InstancedBufferAttribute,
  InstancedBufferGeometry,
  InstancedInterleavedBuffer,
  InterleavedBufferAttribute,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  ShaderMaterial,
} from "three";

// Corners of the roof: along the segment, across it (in halves of the width) and whether it is the ridge.
const ROOF = new Float32Array([0, -1, 0, 0, 0, 1, 0, 1, 0, 1, -1, 0, 1, 0, 1, 1, 1, 0]);
const ROOF_FACES = [0, 3, 1, 1, 3, 4, 1, 4, 2, 2, 4, 5];

const VERTEX = `
attribute vec3 corner;
attribute vec3 begin;
attribute vec3 end;
attribute vec3 shade;
uniform float width;
uniform float height;
varying vec3 vShade;
varying vec3 vNormal;
#include <clipping_planes_pars_vertex>
void main() {
  vec3 along = end - begin;
  float size = max(length(along), 1e-6);
  along /= size;
  vec3 side = normalize(cross(along, vec3(0.0, 0.0, 1.0)) + vec3(1e-9, 0.0, 0.0));
  vec3 point = mix(begin, end, corner.x) + along * (corner.x - 0.5) * 0.3 * width;
  point += side * corner.y * 0.5 * width - vec3(0.0, 0.0, (1.0 - corner.z) * height);
  vShade = shade;
  vNormal = normalMatrix * normalize(mix(side * corner.y + vec3(0.0, 0.0, 0.4), vec3(0.0, 0.0, 1.0), corner.z));
  vec4 mvPosition = modelViewMatrix * vec4(point, 1.0);
  gl_Position = projectionMatrix * mvPosition;
  #include <clipping_planes_vertex>
}`;

const FRAGMENT = `
varying vec3 vShade;
varying vec3 vNormal;
#include <clipping_planes_pars_fragment>
void main() {
  #include <clipping_planes_fragment>
  float light = 0.55 + 0.45 * abs(normalize(vNormal).z);
  gl_FragColor = vec4(vShade * light, 1.0);
}`;

/**
 * Make the beads of a print, a child of the group for every layer.
 *
 * @param {Float32Array} segments x, y, z of both ends of every segment, mm; z is the top of the bead.
 * @param {Uint8Array} colours red, green, blue of every segment.
 * @param {{starts?: ArrayLike<number>, width?: number, height?: number}} options `starts` has the first segment of every
 *   layer; without a width, mm, segments are thin lines.
 */
export function makeBeads(segments, colours, { starts = [0], width = 0, height = 0.2 }) {
  const group = new Group();
  const count = segments.length / 6;
  const material = width > 0 ? beadMaterial(width, height) : new LineBasicMaterial({ vertexColors: true });
  for (let layer = 0; layer < starts.length; layer++) {
    const begin = starts[layer];
    const end = layer + 1 < starts.length ? starts[layer + 1] : count;
    const ends = segments.subarray(6 * begin, 6 * end);
    const shades = colours.subarray(3 * begin, 3 * end);
    const child = width > 0 ? beadMesh(ends, shades, material) : thinLines(ends, shades, material);
    child.visible = end > begin;
    child.userData.empty = end <= begin;
    group.add(child);
  }
  return { group, material };
}

/**
 * @param {number} width
 * @param {number} height
 */
function beadMaterial(width, height) {
  const uniforms = { width: { value: width }, height: { value: height } };
  return new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms,
    side: DoubleSide,
    clipping: true,
  });
}

/**
 * @param {Float32Array} ends
 * @param {Uint8Array} shades
 * @param {import("three").Material} material
 */
function beadMesh(ends, shades, material) {
  const geometry = new InstancedBufferGeometry();
  geometry.setAttribute("corner", new BufferAttribute(ROOF, 3));
  geometry.setAttribute("position", new BufferAttribute(ROOF, 3));
  geometry.setIndex(ROOF_FACES);
  const buffer = new InstancedInterleavedBuffer(ends, 6);
  geometry.setAttribute("begin", new InterleavedBufferAttribute(buffer, 3, 0));
  geometry.setAttribute("end", new InterleavedBufferAttribute(buffer, 3, 3));
  geometry.setAttribute("shade", new InstancedBufferAttribute(shades, 3, true));
  geometry.instanceCount = ends.length / 6;
  const mesh = new Mesh(geometry, material);
  mesh.frustumCulled = false;
  return mesh;
}

/**
 * @param {Float32Array} ends
 * @param {Uint8Array} shades
 * @param {import("three").Material} material
 */
function thinLines(ends, shades, material) {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(ends, 3));
  const both = new Uint8Array(2 * shades.length);
  for (let i = 0; i < shades.length / 3; i++) {
    both.set(shades.subarray(3 * i, 3 * i + 3), 6 * i);
    both.set(shades.subarray(3 * i, 3 * i + 3), 6 * i + 3);
  }
  geometry.setAttribute("color", new BufferAttribute(both, 3, true));
  const lines = new LineSegments(geometry, material);
  lines.frustumCulled = false;
  return lines;
}
