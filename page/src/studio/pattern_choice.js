/**
 * The chosen pattern as a picture that opens the gallery, and the pattern's own parameters.
 */

import { h, replaceChildren } from "./dom.js";
import { optionControl } from "./form.js";
import { createPicker, sentenceOf } from "./gallery.js";

/** @typedef {import("./server.js").Pattern} Pattern */

/**
 * Make the choice.
 * @param {{patterns: Pattern[], product: string, keep?: {name: string, title: string, sentence: string},
 *   onChoose: (name: string) => void, onTile?: (file: File) => void}} what `keep` stands for what is there already.
 */
export function createPatternChoice({ patterns, product, keep, onChoose, onTile }) {
  const picture = h("img", { alt: "", width: 72, height: 72 });
  const [title, sentence] = [h("strong", {}), h("span", {})];
  const picker = createPicker({ patterns, product, onChoose: ({ name }) => onChoose(name), onTile });
  let chosen = "";
  const button = h(
    "button",
    {
      type: "button",
      class: "pattern-choice",
      "aria-haspopup": "dialog",
      onclick: () => picker.open(chosen),
    },
    picture,
    h(
      "span",
      { class: "pattern-words" },
      h("span", { class: "pattern-title" }, h("span", { class: "hidden-text" }, "Pattern: "), title),
      sentence,
      h("span", { class: "change", "aria-hidden": "true" }, "Choose another"),
    ),
  );
  const back = keep
    ? h("button", { type: "button", class: "quiet keep", onclick: () => onChoose(keep.name) }, keep.title)
    : null;
  const error = h("p", { class: "field-error", role: "alert", hidden: true });
  return {
    element: h("div", { class: "field" }, button, back, error, picker.dialog),
    /** @param {string|{file: string}} value */
    set(value) {
      const name = typeof value === "string" ? value : "";
      chosen = name;
      const pattern = patterns.find((one) => one.name === name);
      const isKept = keep?.name === name;
      picture.hidden = !pattern?.picture;
      if (pattern?.picture) picture.src = pattern.picture;
      title.textContent = pattern?.title ?? (isKept ? keep.title : "Your own tile");
      sentence.textContent = pattern ? sentenceOf(pattern) : isKept ? keep.sentence : "A drawing that repeats.";
      if (back) back.hidden = isKept;
    },
    /** @param {string|null} message */
    fail(message) {
      error.hidden = !message;
      error.textContent = message ?? "";
    },
  };
}

/**
 * Show controls for the pattern's own parameters.
 * @param {HTMLElement} place
 * @param {Pattern|undefined} pattern
 * @param {Record<string, any>} values
 * @param {string[]} taken names that stand elsewhere on the form
 * @param {(name: string, value: any) => void} onChange
 */
export function showOwnParameters(place, pattern, values, taken, onChange) {
  const own = (pattern?.parameters ?? []).filter(({ key }) => !taken.includes(key));
  const controls = own.map((option) => {
    const control = optionControl(option, (value) => onChange(option.key, value));
    control.set(values[option.key] ?? null);
    return control.element;
  });
  replaceChildren(
    place,
    controls.length
      ? h(
          "details",
          { class: "all-options" },
          h("summary", {}, `Options of ${pattern?.title}`),
          h("section", { class: "option-group" }, controls),
        )
      : null,
  );
}
