/**
 * The histogram of a scan with the threshold on it: pull the line, or the slider below it.
 */

import { freshId, h, plain } from "./dom.js";

/** @typedef {{edges: number[], counts: number[]}} Histogram */
/** @typedef {{name: string, value: number}} NamedThreshold */

const HEIGHT = 64;
const STEPS = 500;

/**
 * Make the control of one threshold, or of the two ends of a range.
 * @param {{histogram: Histogram, least: number, most: number, named?: NamedThreshold[],
 *   onChange: (ends: number[], resting: boolean) => void}} what `named` are thresholds to choose with one click
 */
export function createHistogram({ histogram, least, most, named = [], onChange }) {
  let ends = [(least + most) / 2];
  const svg = makeSvg(histogram, least, most);
  const marks = [0, 1].map(() => svgElement("line", { class: "threshold", y1: 0, y2: HEIGHT }));
  const shade = svgElement("rect", { class: "solid-range", y: 0, height: HEIGHT });
  svg.prepend(shade);
  svg.append(...marks);
  const error = h("p", { class: "field-error", id: freshId("error"), role: "alert", hidden: true });
  const rows = ["Solid from", "to"].map((label, i) => {
    const range = h("input", {
      type: "range",
      min: String(least),
      max: String(most),
      step: String((most - least) / STEPS),
      "aria-label": i ? "Upper threshold" : "Threshold",
      "aria-describedby": error.id,
    });
    const number = h("input", {
      type: "number",
      class: "number",
      step: "any",
      "aria-label": i ? "Upper threshold as a number" : "Threshold as a number",
    });
    range.addEventListener("input", () => change(i, Number(range.value), false));
    range.addEventListener("change", () => change(i, Number(range.value), true));
    number.addEventListener("change", () => change(i, Number(number.value), true));
    const element = h(
      "div",
      { class: "threshold-row" },
      h("span", { class: "field-label", "aria-hidden": "true" }, label),
      number,
      range,
    );
    return { range, number, element };
  });

  const buttons = named.map(({ name, value }) => ({
    value,
    element: h(
      "button",
      { type: "button", class: "quiet small", onclick: () => change(0, value, true) },
      `${name} ${plain(value)}`,
    ),
  }));

  /**
   * @param {number} i
   * @param {number} value
   * @param {boolean} resting
   */
  function change(i, value, resting) {
    const next = [...ends];
    next[i] = tidy(value);
    if (next.length === 2 && next[0] > next[1]) next[1 - i] = next[i];
    set(next);
    onChange(next, resting);
  }

  /** @param {number} value */
  function tidy(value) {
    const step = (most - least) / STEPS;
    const digits = Math.max(0, Math.ceil(-Math.log10(step)));
    return Number(Math.min(most, Math.max(least, value)).toFixed(digits));
  }

  /** @param {number[]} next one value, or two */
  function set(next) {
    ends = next;
    const [from, to] = [ends[0], ends[1] ?? most];
    for (const { value, element } of buttons) element.setAttribute("aria-pressed", String(tidy(value) === tidy(from)));
    for (const [i, { range, number, element }] of rows.entries()) {
      element.hidden = i >= ends.length;
      marks[i].classList.toggle("unused", i >= ends.length);
      if (i >= ends.length) continue;
      range.value = String(ends[i]);
      range.style.setProperty("--share", `${share(ends[i]) * 100}%`);
      number.value = String(ends[i]);
      for (const side of ["x1", "x2"]) marks[i].setAttribute(side, String(share(ends[i]) * 100));
    }
    shade.setAttribute("x", String(share(from) * 100));
    shade.setAttribute("width", String(Math.max(0, share(to) - share(from)) * 100));
  }

  /** @param {number} value */
  function share(value) {
    return Math.min(1, Math.max(0, (value - least) / (most - least || 1)));
  }

  let pulled = -1;
  /**
   * @param {PointerEvent} event
   * @param {boolean} resting
   */
  function pull(event, resting) {
    const box = svg.getBoundingClientRect();
    const value = least + Math.min(1, Math.max(0, (event.clientX - box.left) / box.width)) * (most - least);
    if (pulled < 0) pulled = ends.length === 2 && Math.abs(value - ends[1]) < Math.abs(value - ends[0]) ? 1 : 0;
    change(pulled, value, resting);
  }
  svg.addEventListener("pointerdown", (event) => {
    svg.setPointerCapture(event.pointerId);
    pull(event, false);
  });
  svg.addEventListener("pointermove", (event) => {
    if (pulled >= 0) pull(event, false);
  });
  svg.addEventListener("pointerup", (event) => {
    if (pulled >= 0) pull(event, true);
    pulled = -1;
  });

  return {
    element: h(
      "div",
      { class: "field histogram" },
      svg,
      h("p", { class: "axis", "aria-hidden": "true" }, h("span", {}, plain(least)), h("span", {}, plain(most))),
      ...rows.map(({ element }) => element),
      buttons.length
        ? h(
            "div",
            { class: "named-thresholds", role: "group", "aria-label": "Thresholds of a CT, Hounsfield units" },
            ...buttons.map(({ element }) => element),
          )
        : null,
      h("p", { class: "field-help" }, "The outline in the slices shows what is solid."),
      error,
    ),
    set,
    /** @param {string|null} message */
    fail(message) {
      error.hidden = !message;
      error.textContent = message ?? "";
    },
  };
}

/**
 * @param {Histogram} histogram
 * @param {number} least
 * @param {number} most
 */
function makeSvg({ edges, counts }, least, most) {
  const svg = /** @type {SVGSVGElement} */ (
    svgElement("svg", { viewBox: `0 0 100 ${HEIGHT}`, preserveAspectRatio: "none", "aria-hidden": "true" })
  );
  // Most of a scan is air: heights are logarithms, so that bone shows beside it.
  const highest = Math.log1p(Math.max(...counts));
  let path = `M0 ${HEIGHT}`;
  for (const [i, count] of counts.entries()) {
    const [x0, x1] = [edges[i], edges[i + 1]].map((edge) => ((edge - least) / (most - least || 1)) * 100);
    const y = HEIGHT - (Math.log1p(count) / (highest || 1)) * (HEIGHT - 4);
    path += `L${x0.toFixed(2)} ${y.toFixed(1)}L${x1.toFixed(2)} ${y.toFixed(1)}`;
  }
  svg.append(svgElement("path", { class: "counts", d: `${path}L100 ${HEIGHT}Z` }));
  return svg;
}

/**
 * @param {string} tag
 * @param {Record<string, string|number>} attributes
 */
function svgElement(tag, attributes) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  return element;
}
