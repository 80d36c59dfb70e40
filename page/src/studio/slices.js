/**
 * Three slices through a scan, with the outline of what is solid.
 */

import { h } from "./dom.js";
import { outline } from "./outline.js";
import { isAbort } from "./server.js";

/** @typedef {{shape: number[], spacing: number[], least: number, most: number}} Scan */

const AXES = /** @type {const} */ (["x", "y", "z"]);
const PICTURE = 480; // pixels along the longer side
const TITLES = { x: "From the side", y: "From the front", z: "From above" };

/**
 * Make the three views.
 * @param {{server: import("./server.js").Server, onFail: (error: unknown) => void}} what
 */
export function createSlices({ server, onFail }) {
  /** @type {string|null} */
  let file = null;
  /** @type {Scan} */
  let scan = { shape: [1, 1, 1], spacing: [1, 1, 1], least: 0, most: 1 };
  /** @type {number[]} */
  let ends = [];
  const views = AXES.map((axis, i) => {
    const canvas = h("canvas", { role: "img", "aria-label": `Slice ${TITLES[axis].toLowerCase()}` });
    const range = h("input", {
      type: "range",
      min: "0",
      step: "1",
      "aria-label": `Slice ${TITLES[axis].toLowerCase()}`,
      oninput: () => load(),
    });
    const words = h("output", {});
    /** @type {{values: Uint8Array, width: number, height: number, image: ImageBitmap}|null} */
    let slice = null;
    let control = new AbortController();
    let isLoading = false;
    let isWanted = false;

    async function load() {
      range.style.setProperty("--share", `${(Number(range.value) / Math.max(1, Number(range.max))) * 100}%`);
      words.textContent = `${Number(range.value) + 1} of ${Number(range.max) + 1}`;
      if (!file) return;
      isWanted = true;
      if (isLoading) return;
      isLoading = true;
      try {
        while (isWanted) {
          isWanted = false;
          const place = { axis, index: Number(range.value), low: scan.least, high: scan.most };
          const image = await upright(await server.slice(file, place, control.signal), axis);
          slice = { ...greyValues(image), image };
          draw();
        }
      } catch (error) {
        if (!isAbort(error)) onFail(error);
      }
      isLoading = false;
    }

    function draw() {
      if (!slice) return;
      const { values, width, height, image } = slice;
      const [across, up] = AXES.filter((other) => other !== axis).map((other) => AXES.indexOf(other));
      // Pixels of the picture are square, voxels need not be.
      const [wide, high] = [width * scan.spacing[across], height * scan.spacing[up]];
      const size = PICTURE / Math.max(wide, high);
      canvas.width = Math.round(wide * size);
      canvas.height = Math.round(high * size);
      const [zoomX, zoomY] = [canvas.width / width, canvas.height / height];
      const context = canvas.getContext("2d");
      if (!context) return;
      context.imageSmoothingEnabled = true;
      context.drawImage(image, 0, 0, canvas.width, canvas.height);
      if (!ends.length) return;
      const grey = (/** @type {number} */ value) => ((value - scan.least) / (scan.most - scan.least || 1)) * 255;
      const segments = outline(values, width, height, grey(ends[0]), ends.length > 1 ? grey(ends[1]) : undefined);
      context.strokeStyle = "#ffa02e";
      context.lineWidth = 3.5;
      context.beginPath();
      for (let at = 0; at < segments.length; at += 4) {
        context.moveTo(segments[at] * zoomX, segments[at + 1] * zoomY);
        context.lineTo(segments[at + 2] * zoomX, segments[at + 3] * zoomY);
      }
      context.stroke();
    }

    return {
      draw,
      element: h(
        "figure",
        { class: "slice" },
        h("div", { class: "slice-picture" }, canvas),
        h("figcaption", {}, h("span", {}, TITLES[axis]), words),
        range,
      ),
      begin() {
        control.abort();
        control = new AbortController();
        isLoading = false;
        slice = null;
        range.max = String(scan.shape[i] - 1);
        range.value = String(Math.floor(scan.shape[i] / 2));
        load();
      },
    };
  });
  return {
    element: h("div", { class: "slices" }, ...views.map(({ element }) => element)),
    /**
     * @param {string} nextFile
     * @param {Scan} nextScan
     */
    open(nextFile, nextScan) {
      file = nextFile;
      scan = nextScan;
      for (const view of views) view.begin();
    },
    /** @param {number[]} nextEnds the threshold, or both ends of a range; none for no outline */
    outline(nextEnds) {
      ends = nextEnds;
      for (const view of views) view.draw();
    },
  };
}

/**
 * A slice with z upwards; one from above stays as it is, with y downwards, as doctors look at it.
 * @param {ImageBitmap} image
 * @param {string} axis
 */
function upright(image, axis) {
  return axis === "z" ? image : createImageBitmap(image, { imageOrientation: "flipY" });
}

/** @param {ImageBitmap} image */
function greyValues(image) {
  const { width, height } = image;
  const canvas = new OffscreenCanvas(width, height);
  const context = canvas.getContext("2d", { willReadFrequently: true });
  if (!context) throw new Error("this browser cannot read pictures");
  context.drawImage(image, 0, 0);
  const pixels = context.getImageData(0, 0, width, height).data;
  return { values: Uint8Array.from({ length: width * height }, (_, i) => pixels[4 * i]), width, height };
}
