/**
 * The density: one slider, or two where it changes from place to place, and along what it changes.
 */

import { select, slider } from "./controls.js";
import { h } from "./dom.js";
import { percents } from "./view.js";

const EVEN = "";
const FILE = "file";
const WAYS = [
  { value: EVEN, text: "not at all", ends: ["Density", ""] },
  { value: "z", text: "with height (z)", ends: ["Density at the bottom", "Density at the top"] },
  { value: "x", text: "from left to right (x)", ends: ["Density on the left", "Density on the right"] },
  { value: "y", text: "from front to back (y)", ends: ["Density in front", "Density at the back"] },
  { value: "skin", text: "from the skin inwards", ends: ["Density at the skin", "Density deep inside"] },
];
const BY_FILE = {
  value: FILE,
  text: "by a file (CSV, VTU, picture)",
  ends: ["Density at the least value", "Density at the greatest"],
};

/**
 * Make the controls.
 * @param {{start: number, auto?: string|null, ways?: string[], onChange: (options: {density: string|null, by: string|null}, resting: boolean) => void,
 *   onField?: (file: File) => void}} what `start` in percent; `onField` takes a file of values to follow.
 */
export function createDensity({ start, auto = null, ways, onChange, onField }) {
  /** @type {{ends: (number|null)[], by: string}} */
  let now = { ends: [start], by: EVEN };
  const first = slider({
    label: "Density",
    unit: "%",
    least: 3,
    most: 80,
    step: 1,
    auto,
    start,
    onChange: (value, resting) => change({ ...now, ends: [value, ...now.ends.slice(1)] }, resting),
  });
  const second = slider({
    label: "Density at the top",
    unit: "%",
    least: 3,
    most: 80,
    step: 1,
    start: 2 * start,
    onChange: (value, resting) => change({ ...now, ends: [now.ends[0], value] }, resting),
  });
  const list = WAYS.filter(({ value }) => !ways || value === EVEN || ways.includes(value));
  if (onField) list.push(BY_FILE);
  const input = h("input", {
    type: "file",
    class: "hidden-text",
    tabIndex: -1,
    "aria-hidden": "true",
    accept: ".csv,.vtu,.frd,.npy,.png,.jpg",
    onchange: () => input.files?.[0] && onField?.(input.files[0]),
  });
  const way = select({
    label: "Varies",
    choices: list,
    onChange: (value) => {
      if (value === FILE) return input.click();
      const ends =
        value === EVEN
          ? [now.ends[0]]
          : [now.ends[0] ?? start, now.ends[1] ?? Math.min(80, 2 * (now.ends[0] ?? start))];
      change({ ends, by: value }, true);
    },
  });
  const element = h("div", { class: "density" }, first.element, second.element, way.element, input);

  /**
   * @param {typeof now} next
   * @param {boolean} resting
   */
  function change(next, resting) {
    show(next);
    const density = next.ends[0] === null ? null : next.ends.map((end) => `${end}%`).join(":");
    onChange({ density, by: next.by || null }, resting);
  }

  /** @param {typeof now} next */
  function show(next) {
    now = next;
    const [firstName, secondName] = (WAYS.find(({ value }) => value === now.by) ?? BY_FILE).ends;
    first.rename?.(firstName);
    second.rename?.(secondName || "Density at the top");
    first.set(now.ends[0]);
    second.element.hidden = now.ends.length < 2;
    if (now.ends.length > 1) second.set(now.ends[1]);
    way.set(WAYS.some(({ value }) => value === now.by) ? now.by : FILE);
  }

  return {
    element,
    /** @param {Record<string, any>} options */
    set({ density, by }) {
      const ends = density === undefined || density === null ? [auto ? null : start] : percents(density);
      show({ ends: ends.length ? ends : [start], by: ends.length > 1 ? (by ?? "z") : EVEN });
    },
    /** @param {string|null} message */
    fail(message) {
      first.fail(message);
    },
    way,
  };
}
