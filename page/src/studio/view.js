/**
 * What the views of a part, a print and a scan share: their layout, and how options change.
 */

import { capital, h, icon, replaceChildren, withoutFlags } from "./dom.js";
import { isAbort, StatedError } from "./server.js";

/** @typedef {import("./store.js").Source} Source */
/**
 * @typedef {object} Studio what every view works with
 * @property {import("./server.js").Server} server
 * @property {import("./server.js").About} about
 * @property {import("./server.js").Pattern[]} patterns
 * @property {import("./store.js").Store} store
 * @property {(file: File) => void} open
 * @property {(sample: string) => void} openSample
 */

/**
 * The three columns of a view; on narrow pages the stage comes first and stays in sight.
 * @param {{label: string, controls: Node[], stage: Node[], side: Node[]}} what
 */
export function layout({ label, controls, stage, side }) {
  return h(
    "div",
    { class: "view", role: "group", "aria-label": label },
    h("div", { class: "controls" }, ...controls),
    h("div", { class: "middle" }, ...stage),
    h("div", { class: "side" }, ...side),
  );
}

/**
 * The head of a view: the open file, and a way to another one.
 * @param {{accept: string, title: string, open: (file: File) => void}} what
 */
export function createFileHead({ accept, title, open }) {
  const name = h("strong", {}, "");
  const facts = h("span", { class: "file-facts" }, "");
  const input = h("input", {
    type: "file",
    accept,
    class: "hidden-text",
    "aria-label": title,
    onchange: () => {
      if (input.files?.[0]) open(input.files[0]);
      input.value = "";
    },
  });
  return {
    element: h(
      "div",
      { class: "file-head" },
      h("div", { class: "file-name" }, name, facts),
      h("label", { class: "button quiet" }, input, icon("drop"), "Open"),
    ),
    /**
     * @param {string} text
     * @param {...string} more lines of facts
     */
    show(text, ...more) {
      name.textContent = text;
      name.title = text;
      replaceChildren(facts, ...more.flatMap((line, i) => [i ? h("br") : null, line]));
    },
  };
}

/**
 * Options with one changed; null takes it away.
 * @param {Record<string, any>} options
 * @param {string} key
 * @param {any} value
 */
export function withOption(options, key, value) {
  const { [key]: _, ...rest } = options;
  return value === null || value === undefined ? rest : { ...rest, [key]: value };
}

/**
 * Options for the server: empty tables left out.
 * @param {Record<string, any>} options
 */
export function forServer(options) {
  const { set, ...rest } = options;
  return set && Object.keys(set).length ? { ...rest, set } : rest;
}

/**
 * An error as a sentence, and the option that it is about.
 * @param {unknown} error
 * @returns {{message: string, parameter: string|null}|null}
 */
export function describeError(error) {
  if (isAbort(error)) return null;
  if (error instanceof StatedError) return { message: sentence(error.message), parameter: error.parameter };
  if (error instanceof TypeError)
    return { message: "The studio does not answer. Is it still running?", parameter: null };
  return { message: error instanceof Error ? error.message : String(error), parameter: null };
}

/** @param {string} text */
function sentence(text) {
  const trimmed = withoutFlags(text.trim());
  if (!trimmed) return "Something went wrong.";
  // The name of a file stays as its owner wrote it.
  return /^\S+\.\w/.test(trimmed) ? trimmed : capital(trimmed);
}

/**
 * What to ask for where a link names a file that only its owner has.
 * @param {string} name
 */
export function dropAgain(name) {
  return `These are the settings for ${name}. Open that file again to go on with them.`;
}

/**
 * A share in percent from what an option holds: "20%" or 0.2.
 * @param {any} value
 * @returns {number|null}
 */
export function percent(value) {
  if (typeof value === "number") return value * 100;
  if (typeof value !== "string") return null;
  const number = Number.parseFloat(value);
  if (Number.isNaN(number)) return null;
  return value.trim().endsWith("%") ? number : number * 100;
}

/**
 * Both ends of a density: "15%:40%" is [15, 40], "20%" is [20].
 * @param {any} value
 * @returns {number[]}
 */
export function percents(value) {
  const parts = typeof value === "string" ? value.split(":") : Array.isArray(value) ? value : [value];
  return parts.map(percent).filter((part) => part !== null);
}
