/**
 * Prints from bytes, as `infill/viewer/print_page.py` describes them, and what a page lets one change about them.
 *
 * @typedef {ReturnType<typeof import("./viewer.js").createViewer>} View
 *
 * @typedef {object} Print
 * @property {Float32Array} segments x, y, z of both ends of every line, mm.
 * @property {Uint8Array} speeds Of every line, from 0 to 255 for `top`.
 * @property {{number: number, start: number, z: number}[]} layers The first line of each.
 * @property {number} width Of a line, mm.
 * @property {number} height Of a layer, mm.
 * @property {number} top mm/s
 */

import { readHeader, restorePositions } from "./mesh.js";
import { readDifference } from "./planes.js";

// As in infill/pictures/speeds.py, from 0 to the top of the scale.
const STOPS = [
  [38, 56, 150],
  [20, 140, 180],
  [90, 180, 70],
  [240, 160, 40],
  [190, 30, 40],
];
const NAME = "print";

/**
 * Read a packed print.
 *
 * @param {ArrayBuffer} buffer
 * @returns {Print}
 */
export function decodePrint(buffer) {
  const { header, start } = readHeader(buffer, "IFP1");
  const places = new Uint8Array(buffer, start + header.places[0], header.places[1]);
  const count = 2 * header.lines;
  const steps = new Uint16Array(3 * count);
  for (let axis = 0; axis < 3; axis++) {
    let last = 0;
    for (let row = 0; row < count; row++) {
      last = (last + readDifference(places, count, 3, axis, row)) & 0xffff;
      steps[3 * row + axis] = last;
    }
  }
  return {
    segments: restorePositions(steps, header.low, header.size),
    speeds: new Uint8Array(buffer, start + header.speeds[0], header.speeds[1]),
    layers: header.layers,
    width: header.width,
    height: header.height,
    top: header.top,
  };
}

/**
 * Return the colour of a speed.
 *
 * @param {number} share Of the top, from 0 to 1.
 */
export function speedColour(share) {
  const place = Math.min(Math.max(share, 0), 1) * (STOPS.length - 1);
  const below = Math.min(Math.floor(place), STOPS.length - 2);
  return STOPS[below].map((value, i) => Math.round(value + (place - below) * (STOPS[below + 1][i] - value)));
}

/**
 * Show prints side by side, and connect the controls of the page.
 *
 * @param {View[]} viewers
 * @param {Print[]} prints
 */
export function showPrints(viewers, prints) {
  const table = new Uint8Array(3 * 256);
  for (let value = 0; value < 256; value++) table.set(speedColour(value / 255), 3 * value);
  prints.forEach(({ segments, speeds, layers, width, height }, number) => {
    const colours = new Uint8Array(3 * speeds.length);
    for (let line = 0; line < speeds.length; line++) {
      colours.set(table.subarray(3 * speeds[line], 3 * speeds[line] + 3), 3 * line);
    }
    const starts = layers.map((layer) => layer.start);
    viewers[number].addLines(NAME, segments, colours, { starts, width, height });
  });
  shareCamera(viewers);
  connectLayers(viewers, prints);
  const scale = /** @type {HTMLElement} */ (document.getElementById("scale"));
  scale.style.background = `linear-gradient(to right, ${STOPS.map((stop) => `rgb(${stop.join(" ")})`).join(", ")})`;
}

/**
 * Look at every print from where the first one is seen as a whole.
 *
 * @param {View[]} viewers
 */
function shareCamera(viewers) {
  for (const viewer of viewers.slice(1)) viewer.setCamera(viewers[0].getCamera());
}

/**
 * Let the controls choose the layers that are shown: up to one of them, or that one alone.
 *
 * @param {View[]} viewers
 * @param {Print[]} prints
 */
function connectLayers(viewers, prints) {
  const slider = /** @type {HTMLInputElement} */ (document.getElementById("layer"));
  const single = /** @type {HTMLInputElement} */ (document.getElementById("single"));
  const output = /** @type {HTMLOutputElement} */ (document.getElementById("shown"));
  const most = Math.max(...prints.map((print) => print.layers.length));
  slider.max = String(most);
  slider.value = String(Math.max(Math.floor(most / 2), 1));
  const show = () => {
    const last = Number(slider.value) - 1;
    for (const viewer of viewers) viewer.setLayers(NAME, single.checked ? last : 0, last);
    const layers = prints.map((print) => print.layers[last]).find((layer) => layer);
    output.value = layers ? `Layer ${layers.number}, ${layers.z} mm high` : "";
  };
  slider.addEventListener("input", show);
  single.addEventListener("change", show);
  show();
}
