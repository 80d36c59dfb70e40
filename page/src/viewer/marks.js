/**
 * Marks: rings around places, as large on the screen from near and far, and seen through everything.
 *
 * @typedef {{at: number[], colour: string}} Mark at x, y, z in mm, with a colour as CSS writes it.
 */

import { BufferAttribute, BufferGeometry, CanvasTexture, Color, Points, PointsMaterial } from "three";

const SIZE = 30; // pixels across
const DRAWN = 64; // pixels of the picture of a ring
const LAST = 1e6; // in the order of drawing: over everything

/** Draw a ring in white, to be coloured, with a dark rim that stands out from any surface. */
function drawRing() {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = DRAWN;
  const context = canvas.getContext("2d");
  if (!context) return canvas;
  const middle = DRAWN / 2;
  for (const [style, width] of /** @type {[string, number][]} */ ([
    ["#000", 14],
    ["#fff", 9],
  ])) {
    context.beginPath();
    context.arc(middle, middle, middle - 9, 0, 2 * Math.PI);
    context.strokeStyle = style;
    context.lineWidth = width;
    context.stroke();
  }
  return canvas;
}

/**
 * Make marks for a scene.
 *
 * @param {Mark[]} marks
 */
export function makeMarks(marks) {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(marks.flatMap(({ at }) => at)), 3));
  const colours = marks.flatMap(({ colour }) => new Color(colour).toArray());
  geometry.setAttribute("color", new BufferAttribute(new Float32Array(colours), 3));
  const material = new PointsMaterial({
    map: new CanvasTexture(drawRing()),
    size: SIZE,
    sizeAttenuation: false,
    vertexColors: true,
    transparent: true,
    depthTest: false,
    depthWrite: false,
  });
  const points = new Points(geometry, material);
  points.renderOrder = LAST;
  points.frustumCulled = false;
  return points;
}
