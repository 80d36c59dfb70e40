/**
 * Controls: a slider with its number, a row of choices, a switch, a select, a line of text.
 *
 * Each is `{element, set, fail}`: `set` shows a value without telling anybody, `fail` writes an error below or takes it
 * away. `onMove` is called while a hand moves, `onRest` when it rests; null stands for "automatic".
 */

import { freshId, h, plain } from "./dom.js";

/** @typedef {{element: HTMLElement, set: (value: any) => void, fail: (message: string|null) => void,
 *   rename?: (label: string) => void}} Control */
/** @typedef {(value: any, resting: boolean) => void} OnChange */

/**
 * The frame of a control: label, help below, place for an error.
 * @param {{label: HTMLElement, body: (HTMLElement|null)[], help?: string}} parts
 * @param {HTMLElement} focusable
 */
function frame({ label, body, help }, focusable) {
  const error = h("p", { class: "field-error", id: freshId("error"), role: "alert", hidden: true });
  const note = help ? h("p", { class: "field-help", id: freshId("help") }, help) : null;
  focusable.setAttribute("aria-describedby", [note?.id, error.id].filter(Boolean).join(" "));
  return {
    element: h("div", { class: "field" }, label, ...body, note, error),
    /** @param {string|null} message */
    fail(message) {
      error.hidden = !message;
      error.textContent = message ?? "";
      if (message) focusable.setAttribute("aria-invalid", "true");
      else focusable.removeAttribute("aria-invalid");
    },
  };
}

/**
 * A slider and its number.
 * @param {{label: string, unit?: string, least: number, most: number, step: number, auto?: string|null, autoWord?: string, start?: number,
 *   help?: string, onChange: OnChange}} what `auto` names the automatic value; `start` is where a hand begins from it.
 * @returns {Control}
 */
export function slider({
  label,
  unit = "",
  least,
  most,
  step,
  auto = null,
  autoWord = "auto",
  start = least,
  help,
  onChange,
}) {
  const id = freshId("slider");
  const range = h("input", {
    type: "range",
    id,
    min: String(least),
    max: String(most),
    step: String(step),
    value: String(start),
  });
  const title = h("label", { htmlFor: id }, label);
  const number = h("input", {
    type: "number",
    class: "number",
    min: String(least),
    step: "any",
    "aria-label": unit ? `${label}, ${unit === "%" ? "percent" : unit}` : label,
    placeholder: auto ? autoWord : "",
  });
  const reset = auto
    ? h(
        "button",
        { type: "button", class: "auto", "aria-pressed": "true", title: auto, onclick: () => choose(null, true) },
        autoWord,
      )
    : null;
  reset?.setAttribute("aria-label", `${label}: ${autoWord}`);
  const { element, fail } = frame(
    {
      label: h(
        "div",
        { class: "field-head" },
        title,
        h(
          "span",
          { class: "value" },
          number,
          unit ? h("span", { class: "unit", "aria-hidden": "true" }, unit) : null,
          reset,
        ),
      ),
      body: [range],
      help,
    },
    range,
  );

  /** @param {number|null} value */
  function set(value) {
    const isAuto = value === null || value === undefined;
    element.classList.toggle("is-auto", isAuto);
    reset?.setAttribute("aria-pressed", String(isAuto));
    range.value = String(isAuto ? start : value);
    number.value = isAuto ? "" : String(Number(Number(value).toFixed(4)));
    range.style.setProperty(
      "--share",
      `${Math.min(100, Math.max(0, ((Number(range.value) - least) / (most - least)) * 100))}%`,
    );
    range.setAttribute("aria-valuetext", isAuto ? (auto ?? autoWord) : `${plain(Number(value))} ${unit}`);
  }

  /**
   * @param {number|null} value
   * @param {boolean} resting
   */
  function choose(value, resting) {
    fail(null);
    set(value);
    onChange(value, resting);
  }

  range.addEventListener("input", () => choose(Number(range.value), false));
  range.addEventListener("change", () => choose(Number(range.value), true));
  number.addEventListener("change", () => {
    if (number.value === "" && !auto) set(Number(range.value));
    else choose(number.value === "" ? null : Number(number.value), true);
  });
  set(auto ? null : start);
  /** @param {string} text */
  function rename(text) {
    title.textContent = text;
    number.setAttribute("aria-label", unit ? `${text}, ${unit === "%" ? "percent" : unit}` : text);
  }

  return { element, set, fail, rename };
}

/**
 * A row of choices, of which one is chosen.
 * @param {{label: string, choices: {value: string, text: string, title?: string}[], help?: string, onChange: OnChange}} what
 * @returns {Control}
 */
export function choices({ label, choices: list, help, onChange }) {
  const name = freshId("choice");
  const inputs = list.map(({ value }) =>
    h("input", { type: "radio", name, value, onchange: () => onChange(value, true) }),
  );
  const row = h(
    "div",
    { class: "segments" },
    ...list.map(({ text, title }, i) => h("label", { title }, inputs[i], h("span", {}, text))),
  );
  const group = h("fieldset", { class: "field-set" }, h("legend", {}, label), row);
  const { element, fail } = frame({ label: group, body: [], help }, group);
  return {
    element,
    set(value) {
      for (const input of inputs) input.checked = input.value === value;
    },
    fail,
  };
}

/**
 * A box to tick.
 * @param {{label: string, help?: string, onChange: OnChange}} what
 * @returns {Control}
 */
export function tick({ label, help, onChange }) {
  const input = h("input", { type: "checkbox", onchange: () => onChange(input.checked, true) });
  const { element, fail } = frame(
    { label: h("label", { class: "tick" }, input, h("span", {}, label)), body: [], help },
    input,
  );
  return {
    element,
    set(value) {
      input.checked = Boolean(value);
    },
    fail,
  };
}

/**
 * A list to choose from.
 * @param {{label: string, choices: {value: string, text: string}[], help?: string, onChange: OnChange}} what
 * @returns {Control}
 */
export function select({ label, choices: list, help, onChange }) {
  const id = freshId("select");
  const input = h(
    "select",
    { id, onchange: () => onChange(input.value, true) },
    ...list.map(({ value, text }) => h("option", { value }, text)),
  );
  const head = h("div", { class: "field-head" }, h("label", { htmlFor: id }, label), input);
  const { element, fail } = frame({ label: head, body: [], help }, input);
  return {
    element,
    set(value) {
      input.value = value ?? list[0]?.value ?? "";
    },
    fail,
  };
}

/**
 * A line of text or a number, as typed; empty is the default.
 * @param {{label: string, kind: "text"|"number"|"whole", unit?: string, placeholder?: string, help?: string, onChange: OnChange}} what
 * @returns {Control}
 */
export function line({ label, kind, unit = "", placeholder = "", help, onChange }) {
  const id = freshId("line");
  const input = h("input", {
    id,
    type: kind === "text" ? "text" : "number",
    class: "line",
    placeholder,
    autocomplete: "off",
    spellcheck: false,
    onchange: () => onChange(read(), true),
  });
  if (kind !== "text") input.step = kind === "whole" ? "1" : "any";
  const title = h("label", { htmlFor: id }, label, unit ? h("span", { class: "unit" }, ` ${unit}`) : null);
  const { element, fail } = frame({ label: h("div", { class: "field-head" }, title, input), body: [], help }, input);

  function read() {
    if (input.value.trim() === "") return null;
    return kind === "text" ? input.value.trim() : Number(input.value);
  }
  return {
    element,
    set(value) {
      input.value = value ?? "";
    },
    fail,
  };
}
