/**
 * The numbers beside a picture, what they mean, and the warnings.
 */

import { capital, h, plain, replaceChildren, withoutFlags } from "./dom.js";

/** @typedef {import("./server.js").NumberRow} NumberRow */

const ABOUT = "Of the preview. The exact number follows when the exact result is there.";
const BEFORE = " before"; // ends the name of a number that is followed by the same one afterwards

/**
 * Write the value of a row.
 * @param {NumberRow} row
 */
export function valueText({ about, ...row }) {
  const text = plainText(row);
  return about ? `≈ ${text}` : text;
}

/** @param {NumberRow} row */
function plainText({ value, unit }) {
  if (typeof value === "boolean") return value ? "yes" : "no";
  if (typeof value !== "number") return String(value ?? "–");
  if (unit === "s") return timeText(value);
  // The value of a share is the share itself.
  return unit === "%" ? `${plain(100 * value)} %` : unit ? `${plain(value)} ${unit}` : plain(value);
}

/**
 * Write a time as clocks have it.
 * @param {number} seconds
 */
export function timeText(seconds) {
  if (seconds < 60) return `${plain(seconds)} s`;
  const whole = Math.round(seconds);
  const minutes = Math.round(seconds / 60);
  if (whole < 3600) return `${Math.floor(whole / 60)} min ${whole % 60} s`;
  return `${Math.floor(minutes / 60)} h ${minutes % 60} min`;
}

/**
 * Put numbers from before into the row of the same number afterwards.
 * @param {NumberRow[]} rows
 * @returns {{row: NumberRow, before: NumberRow|undefined}[]}
 */
export function pairRows(rows) {
  const before = new Map(
    rows.filter(({ name }) => name.endsWith(BEFORE)).map((row) => [row.name.slice(0, -BEFORE.length), row]),
  );
  const names = new Set(rows.map(({ name }) => name));
  return rows
    .filter(({ name }) => !(name.endsWith(BEFORE) && names.has(name.slice(0, -BEFORE.length))))
    .map((row) => ({ row, before: before.get(row.name) }));
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
        pairRows(rows).map(({ row, before }) =>
          h(
            "div",
            {},
            h("dt", {}, capital(row.name)),
            h(
              "dd",
              row.about ? { title: ABOUT } : {},
              valueText(row),
              before && valueText(before) !== valueText(row)
                ? h("span", { class: "before" }, `before ${valueText(before)}`)
                : null,
            ),
          ),
        ),
      );
      const explained = rows.filter(({ help }) => help);
      const isAbout = rows.some(({ about }) => about);
      more.hidden = explained.length === 0 && !isAbout;
      replaceChildren(
        meanings,
        isAbout ? h("div", {}, h("dt", {}, "≈"), h("dd", {}, ABOUT)) : null,
        explained.map(({ name, help }) => h("div", {}, h("dt", {}, capital(name)), h("dd", {}, help ?? ""))),
      );
      warnings.hidden = notes.length === 0;
      replaceChildren(
        warnings,
        notes.map((note) => h("li", {}, capital(withoutFlags(note)))),
      );
    },
    /** @param {boolean} stale whether an answer for newer values is on its way */
    setStale(stale) {
      list.classList.toggle("stale", stale);
    },
  };
}
