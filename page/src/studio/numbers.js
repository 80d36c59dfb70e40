/**
 * The numbers beside a picture, what they mean, and the warnings.
 */

import { capital, h, plain, replaceChildren } from "./dom.js";

/** @typedef {import("./server.js").NumberRow} NumberRow */

/**
 * Write the value of a row.
 * @param {NumberRow} row
 */
export function valueText({ value, unit }) {
  // The value of a share is the share itself.
  const scaled = unit === "%" && typeof value === "number" ? 100 * value : value;
  const number =
    typeof scaled === "number"
      ? plain(scaled)
      : typeof value === "boolean"
        ? value
          ? "yes"
          : "no"
        : String(value ?? "–");
  return unit ? `${number} ${unit.replace("mm3", "mm³").replace("cm3", "cm³").replace("mm2", "mm²")}` : number;
}

/** A table of numbers. */
export function createNumbers() {
  const list = h("dl", { class: "numbers" });
  const meanings = h("dl", { class: "meanings" });
  const more = h(
    "details",
    { class: "what-they-mean", hidden: true },
    h("summary", {}, "What these numbers mean"),
    meanings,
  );
  const warnings = h("ul", { class: "warnings", hidden: true });
  return {
    element: h("section", { class: "numbers-panel", "aria-label": "Numbers" }, list, warnings, more),
    /**
     * @param {NumberRow[]} rows
     * @param {string[]} [notes] warnings of the library
     */
    show(rows, notes = []) {
      replaceChildren(
        list,
        rows.map((row) => h("div", {}, h("dt", {}, capital(row.name)), h("dd", {}, valueText(row)))),
      );
      const explained = rows.filter(({ help }) => help);
      more.hidden = explained.length === 0;
      replaceChildren(
        meanings,
        explained.map(({ name, help }) => h("div", {}, h("dt", {}, capital(name)), h("dd", {}, help ?? ""))),
      );
      warnings.hidden = notes.length === 0;
      replaceChildren(
        warnings,
        notes.map((note) => h("li", {}, note)),
      );
    },
    /** @param {boolean} stale whether an answer for newer values is on its way */
    setStale(stale) {
      list.classList.toggle("stale", stale);
    },
  };
}
