/**
 * The cut: along which axis a part is cut open, and where; along z it goes layer by layer.
 */

import { choices } from "./controls.js";
import { h } from "./dom.js";

/** @typedef {{axis: "none"|"x"|"y"|"z", share: number}} Cut where: as a share of the part's extent */
/** @typedef {{low: number[], high: number[]}} Bounds */

const STEPS = 200;
const LAYER = 0.2; // mm, a step along z

/**
 * Make the control.
 * @param {{onChange: (cut: Cut, resting: boolean) => void}} what
 */
export function createCut({ onChange }) {
  /** @type {Cut} */
  let cut = { axis: "none", share: 0.5 };
  /** @type {Bounds} */
  let bounds = { low: [0, 0, 0], high: [1, 1, 1] };
  const axis = choices({
    label: "Cut open",
    choices: [
      { value: "none", text: "Off" },
      { value: "x", text: "X", title: "From the side" },
      { value: "y", text: "Y", title: "From the front" },
      { value: "z", text: "Z", title: "From above, layer by layer" },
    ],
    onChange: (value) => change({ ...cut, axis: value }, true),
  });
  const place = h("input", {
    type: "range",
    min: "0",
    max: String(STEPS),
    step: "1",
    "aria-label": "Place of the cut",
    oninput: () => change({ ...cut, share: read() }, false),
    onchange: () => change({ ...cut, share: read() }, true),
  });
  const words = h("output", { class: "cut-place" });

  function read() {
    return Number(place.value) / Number(place.max);
  }

  /**
   * @param {Cut} next
   * @param {boolean} resting
   */
  function change(next, resting) {
    set(next);
    onChange(next, resting);
  }

  /** @param {Cut} next */
  function set(next) {
    cut = next;
    axis.set(cut.axis);
    const isOff = cut.axis === "none";
    place.disabled = isOff;
    const extent = isOff ? 0 : bounds.high[index()] - bounds.low[index()];
    const steps = cut.axis === "z" ? Math.max(1, Math.round(extent / LAYER)) : STEPS;
    place.max = String(steps);
    place.value = String(Math.round(cut.share * steps));
    place.style.setProperty("--share", `${cut.share * 100}%`);
    const at = isOff ? "" : `${(cut.share * extent).toFixed(1)} mm`;
    words.textContent = cut.axis === "z" ? `layer ${Math.round(cut.share * steps)} · ${at}` : at;
    place.setAttribute("aria-valuetext", words.textContent);
  }

  function index() {
    return "xyz".indexOf(cut.axis);
  }

  return {
    element: h("div", { class: "cut" }, axis.element, place, words),
    set,
    /** @param {Bounds} next */
    setBounds(next) {
      bounds = next;
      set(cut);
    },
    /** The cut as the viewer takes it. */
    get plane() {
      if (cut.axis === "none") return null;
      const i = index();
      // Just inside of both ends, where a cut shows something.
      const share = Math.min(0.999, Math.max(0.001, cut.share));
      return { axis: cut.axis, at: bounds.low[i] + share * (bounds.high[i] - bounds.low[i]) };
    },
  };
}
