/**
 * A layer of a print from above, its beads in the colour of their speed; two plots can share one camera.
 */

import { followTheme, STEPS, speedColours } from "./colours.js";
import { h } from "./dom.js";
import { layerBounds } from "./layer.js";

/** @typedef {import("./layer.js").Layer} Layer */
/** @typedef {{x: number, y: number, scale: number}} Camera middle of the plot in mm, and pixels of CSS to a mm */

const BEAD = 0.42; // mm, drawn width of a bead
const COLOURS = speedColours();
const ZOOM = 1.25;
const MARGIN = 0.92; // share of the plot that a layer takes when it fits

/**
 * Make a plot.
 * @param {string} label
 */
export function createPlot(label) {
  const canvas = h("canvas", {});
  const element = h(
    "div",
    {
      class: "plot",
      tabindex: "0",
      role: "application",
      "aria-label": `${label}. Arrow keys move, plus and minus zoom, F fits.`,
    },
    canvas,
  );
  /** @type {Camera|null} */
  let camera = null;
  /** @type {Layer|null} */
  let layer = null;
  let range = { least: 0, most: 100 };
  let faint = "#ccc";
  let asked = 0;
  /** @type {((camera: Camera) => void)[]} */
  const listeners = [];

  function draw() {
    asked = 0;
    const [width, height, ratio] = [element.clientWidth, element.clientHeight, devicePixelRatio];
    if (!width || !height) return;
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
    }
    const context = canvas.getContext("2d");
    if (!context) return;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, canvas.width, canvas.height);
    if (!layer || !camera) return;
    const scale = camera.scale * ratio;
    context.setTransform(
      scale,
      0,
      0,
      -scale,
      canvas.width / 2 - camera.x * scale,
      canvas.height / 2 + camera.y * scale,
    );
    context.lineWidth = Math.max(BEAD * 0.86, 0.7 / camera.scale);
    context.lineCap = "round";
    for (const [bin, path] of pathsBySpeed(layer, range).entries()) {
      if (!path) continue;
      context.strokeStyle = COLOURS[bin] ?? faint;
      context.stroke(path);
    }
  }

  function redraw() {
    if (!asked) asked = requestAnimationFrame(draw);
  }

  /** @param {Camera} next */
  function move(next) {
    camera = next;
    redraw();
    for (const listener of listeners) listener(next);
  }

  function fit() {
    const box = layer && layerBounds(layer);
    if (!box || !element.clientWidth) return;
    const [x0, y0, x1, y1] = box;
    const scale =
      MARGIN * Math.min(element.clientWidth / Math.max(x1 - x0, 1), element.clientHeight / Math.max(y1 - y0, 1));
    move({ x: (x0 + x1) / 2, y: (y0 + y1) / 2, scale });
  }

  /**
   * Zoom so that a place of the plot stays where it is.
   * @param {number} factor
   * @param {number} [px] from the middle of the plot, pixels
   * @param {number} [py]
   */
  function zoom(factor, px = 0, py = 0) {
    if (!camera) return;
    const scale = Math.min(2000, Math.max(0.2, camera.scale * factor));
    const shift = 1 / camera.scale - 1 / scale;
    move({ x: camera.x + px * shift, y: camera.y - py * shift, scale });
  }

  /**
   * @param {number} dx pixels
   * @param {number} dy pixels
   */
  function pan(dx, dy) {
    if (camera) move({ ...camera, x: camera.x - dx / camera.scale, y: camera.y + dy / camera.scale });
  }

  element.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const keys = {
      ArrowLeft: () => pan(40, 0),
      ArrowRight: () => pan(-40, 0),
      ArrowUp: () => pan(0, 40),
      ArrowDown: () => pan(0, -40),
      "+": () => zoom(ZOOM),
      "=": () => zoom(ZOOM),
      "-": () => zoom(1 / ZOOM),
      f: fit,
      F: fit,
    };
    const act = keys[/** @type {"f"} */ (event.key)];
    if (!act) return;
    event.preventDefault();
    act();
  });
  element.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      const box = element.getBoundingClientRect();
      zoom(
        Math.exp(-event.deltaY * 0.0015),
        event.clientX - box.left - box.width / 2,
        event.clientY - box.top - box.height / 2,
      );
    },
    { passive: false },
  );
  /** @type {Map<number, {x: number, y: number}>} */
  const fingers = new Map();
  element.addEventListener("pointerdown", (event) => {
    element.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
  });
  element.addEventListener("pointermove", (event) => {
    const last = fingers.get(event.pointerId);
    if (!last) return;
    const apart = spread(fingers);
    fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    if (fingers.size === 2 && apart) zoom(spread(fingers) / apart);
    pan((event.clientX - last.x) / fingers.size, (event.clientY - last.y) / fingers.size);
  });
  for (const end of ["pointerup", "pointercancel"])
    element.addEventListener(end, (event) => fingers.delete(/** @type {PointerEvent} */ (event).pointerId));
  new ResizeObserver(() => (camera ? redraw() : fit())).observe(element);
  followTheme((theme) => {
    faint = theme === "dark" ? "#4a4f57" : "#c9ccd1";
    redraw();
  });

  return {
    element,
    /**
     * @param {Layer|null} next
     * @param {{least: number, most: number}} speeds mm/s, ends of the colours
     */
    show(next, speeds) {
      const isFirst = !camera;
      layer = next;
      range = speeds;
      if (isFirst) fit();
      redraw();
    },
    fit,
    getCamera: () => camera,
    /** @param {Camera} next */
    setCamera(next) {
      camera = next;
      redraw();
    },
    /** @param {(camera: Camera) => void} listener */
    onCamera(listener) {
      listeners.push(listener);
    },
  };
}

/** @param {Map<number, {x: number, y: number}>} fingers */
function spread(fingers) {
  const [a, b] = [...fingers.values()];
  return b ? Math.hypot(a.x - b.x, a.y - b.y) : 0;
}

/** @type {WeakMap<Layer, {key: string, paths: (Path2D|undefined)[]}>} */
const drawn = new WeakMap();

/**
 * One path for all beads of a colour.
 * @param {Layer} layer
 * @param {{least: number, most: number}} range
 */
function pathsBySpeed(layer, { least, most }) {
  const key = `${least} ${most}`;
  const ready = drawn.get(layer);
  if (ready?.key === key) return ready.paths;
  /** @type {(Path2D|undefined)[]} */
  const paths = new Array(STEPS);
  const { ends, speeds } = layer;
  const span = Math.max(most - least, 1e-6);
  for (let i = 0; i < layer.beads; i += 1) {
    const share = Math.min(1, Math.max(0, (speeds[i] - least) / span));
    const bin = Math.round(share * (STEPS - 1));
    paths[bin] ??= new Path2D();
    paths[bin]?.moveTo(ends[4 * i], ends[4 * i + 1]);
    paths[bin]?.lineTo(ends[4 * i + 2], ends[4 * i + 3]);
  }
  drawn.set(layer, { key, paths });
  return paths;
}

/**
 * The range of speeds that colours span: without the slowest and the fastest hundredth.
 * @param {(Layer|null)[]} layers
 */
export function speedRange(layers) {
  const all = layers.flatMap((layer) => (layer ? [...layer.speeds] : [])).sort((a, b) => a - b);
  if (!all.length) return { least: 0, most: 100 };
  return {
    least: Math.floor(all[Math.floor(all.length * 0.01)]),
    most: Math.ceil(all[Math.ceil(all.length * 0.99) - 1]),
  };
}

/** Make the legend of speeds. */
export function createLegend() {
  const canvas = h("canvas", { width: STEPS, height: 1, class: "legend-bar" });
  const context = canvas.getContext("2d");
  for (const [i, colour] of COLOURS.entries()) {
    if (!context) break;
    context.fillStyle = colour;
    context.fillRect(i, 0, 1, 1);
  }
  const [least, most] = [h("span", {}), h("span", {})];
  return {
    element: h("p", { class: "legend" }, least, canvas, most),
    /** @param {{least: number, most: number}} range */
    show(range) {
      least.textContent = `${range.least} mm/s`;
      most.textContent = `${range.most} mm/s`;
    },
  };
}
