/**
 * A density that changes, painted on the walls inside, with its legend and a switch.
 */

import { speedColours } from "./colours.js";
import { h, plain } from "./dom.js";

/** @typedef {ReturnType<typeof import("../viewer/viewer.js").createViewer>} View */

/**
 * Make the switch and the legend.
 * @param {{viewer: View}} what
 */
export function createDensityPaint({ viewer }) {
  const ramp = speedColours().map((css) => css.replaceAll(" ", ","));
  let isOn = true;
  /** @type {string[]} */
  let names = [];
  const [least, most] = [h("span", {}), h("span", {})];
  const bar = h("span", { class: "legend-bar", "aria-hidden": "true" });
  bar.style.background = `linear-gradient(to right, ${ramp.join(", ")})`;
  const input = h("input", {
    type: "checkbox",
    checked: true,
    onchange: () => {
      isOn = input.checked;
      paint();
    },
  });
  const legend = h("span", { class: "legend" }, least, bar, most);
  const element = h(
    "div",
    { class: "density-paint", hidden: true },
    h("label", { class: "tick" }, input, h("span", {}, "Paint the density")),
    legend,
  );

  function paint() {
    legend.hidden = !isOn;
    for (const name of names) viewer.setRamp(name, isOn ? ramp : []);
  }

  return {
    element,
    /**
     * Paint the surfaces that are shown.
     * @param {{lowest: number, highest: number}|null} range null where the density is the same everywhere
     * @param {string[]} surfaces
     */
    show(range, surfaces) {
      element.hidden = !range;
      names = range ? surfaces : [];
      least.textContent = range ? `${plain(100 * range.lowest)} %` : "";
      most.textContent = range ? `${plain(100 * range.highest)} %` : "";
      paint();
    },
  };
}
