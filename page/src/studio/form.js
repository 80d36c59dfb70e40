/**
 * A form of options: the few that matter first, then all others as the library declares them.
 *
 * A form holds controls by the keys of their options. It shows values and errors at the control that they are about, and
 * passes changes on; it keeps no values of its own.
 */

import { line, select, tick } from "./controls.js";
import { h } from "./dom.js";

/** @typedef {import("./server.js").Option} Option */
/** @typedef {import("./controls.js").Control} Control */

/**
 * Make a form.
 * @param {{options: Option[], main: {keys: string[], control: Control}[], hidden: string[],
 *   onChange: (key: string, value: any, resting: boolean) => void}} what `main` are the controls that come first, with
 *   the keys that they stand for; `hidden` are the keys that the page decides itself.
 */
export function createForm({ options, main, hidden, onChange }) {
  /** @type {Map<string, Control>} */
  const byKey = new Map();
  for (const { keys, control } of main) for (const key of keys) byKey.set(key, control);
  const rest = options.filter(({ key }) => !byKey.has(key) && !hidden.includes(key));
  const groups = [...new Set(rest.map(({ group }) => group))];
  const error = h("p", { class: "form-error", role: "alert", hidden: true });
  const own = h("div", { class: "own-parameters" });
  const all = h(
    "details",
    { class: "all-options" },
    h("summary", {}, "All options"),
    ...groups.map((group) =>
      h(
        "section",
        { class: "option-group" },
        h("h3", {}, group),
        ...rest
          .filter((option) => option.group === group)
          .map((option) => {
            const control = optionControl(option, (value) => onChange(option.key, value, true));
            byKey.set(option.key, control);
            return control.element;
          }),
      ),
    ),
  );
  const element = h("form", { class: "form", onsubmit: (/** @type {Event} */ event) => event.preventDefault() });
  for (const { control } of main) if (!element.contains(control.element)) element.append(control.element);
  element.append(own, error, rest.length ? all : "");

  return {
    element,
    own,
    /**
     * Show the values of the generated controls; views show those of the main ones.
     * @param {Record<string, any>} values
     */
    set(values) {
      for (const { key } of rest) byKey.get(key)?.set(values[key] ?? null);
    },
    /**
     * Write an error at the control that it is about, or below the main ones.
     * @param {string|null} message
     * @param {string|null} [parameter]
     */
    fail(message, parameter = null) {
      for (const control of new Set(byKey.values())) control.fail(null);
      error.hidden = true;
      if (!message) return;
      const control = byKey.get(parameter ?? "");
      if (!control) {
        error.hidden = false;
        error.textContent = message;
        return;
      }
      control.fail(message);
      if (all.contains(control.element)) all.open = true;
      if (control.element.getClientRects().length === 0) {
        error.hidden = false;
        error.textContent = message;
      }
    },
  };
}

/**
 * The control for an option as it is declared.
 * @param {Option} option
 * @param {(value: any) => void} onChange null for the default
 * @returns {Control}
 */
export function optionControl(option, onChange) {
  const label = title(option.key);
  const help = option.help;
  const standard =
    option.default_text ||
    (option.default === null || option.default === undefined ? "automatic" : String(option.default));
  if (option.kind === "flag") {
    const control = tick({ label, help, onChange });
    return { ...control, set: (value) => control.set(value ?? option.default ?? false) };
  }
  if (option.kind === "choice") {
    const list = [
      { value: "", text: standard === "automatic" ? "automatic" : `default: ${standard}` },
      ...option.choices.map((value) => ({ value: String(value), text: String(value) })),
    ];
    return select({ label, choices: list, help, onChange: (value) => onChange(value === "" ? null : value) });
  }
  const kind = option.kind === "number" || option.kind === "whole" ? option.kind : "text";
  return line({
    label,
    kind,
    unit: option.unit === "degrees" ? "°" : option.unit.replace("mm3", "mm³"),
    placeholder: standard,
    help,
    onChange,
  });
}

/**
 * The name of an option as a title: "smooth_radius" is "Smooth radius".
 * @param {string} key
 */
export function title(key) {
  const words = key.replaceAll("_", " ").replaceAll("-", " ");
  return words.charAt(0).toUpperCase() + words.slice(1);
}
