/** What a page lets one change about surfaces: which are shown, and where they are cut open. */

/** @typedef {ReturnType<typeof import("./viewer.js").createViewer>} View */
/** @typedef {'x' | 'y' | 'z'} Axis */

const STEPS = 200; // of the slider

/**
 * Show surfaces, and connect the controls of the page.
 *
 * @param {View} viewer
 * @param {import("./mesh.js").Decoded} decoded
 * @param {{cut?: Axis | null, hidden?: string[]}} settings Across which axis surfaces are cut open at first, and which
 *   are not shown.
 */
export function showSurfaces(viewer, decoded, { cut, hidden = [] }) {
  viewer.setMesh(decoded);
  for (const name of hidden) viewer.setVisible(name, false);
  listSurfaces(viewer, decoded, hidden);
  const low = [0, 1, 2].map((axis) => Math.min(...decoded.surfaces.map((surface) => surface.low[axis])));
  const high = [0, 1, 2].map((axis) => Math.max(...decoded.surfaces.map((each) => each.low[axis] + each.size[axis])));
  const choice = /** @type {HTMLSelectElement} */ (document.getElementById("axis"));
  choice.value = cut ?? "";
  connectCut(viewer, choice, low, high);
}

/**
 * List surfaces with their colours, each to be shown or hidden; a single one needs no list.
 *
 * @param {View} viewer
 * @param {import("./mesh.js").Decoded} decoded
 * @param {string[]} hidden
 */
function listSurfaces(viewer, decoded, hidden) {
  const list = document.getElementById("surfaces");
  if (!list || decoded.surfaces.length < 2) return;
  list.hidden = false;
  for (const { name } of decoded.surfaces) {
    const label = document.createElement("label");
    const box = document.createElement("input");
    box.type = "checkbox";
    box.checked = !hidden.includes(name);
    box.addEventListener("change", () => viewer.setVisible(name, box.checked));
    const swatch = document.createElement("span");
    swatch.className = "swatch";
    swatch.style.background = viewer.getColour(name) ?? "";
    label.append(box, swatch, name);
    list.append(label);
  }
}

/**
 * Let the controls of the cut move it.
 *
 * @param {View} viewer
 * @param {HTMLSelectElement} choice
 * @param {number[]} low
 * @param {number[]} high
 */
function connectCut(viewer, choice, low, high) {
  const slider = /** @type {HTMLInputElement} */ (document.getElementById("at"));
  const output = /** @type {HTMLOutputElement} */ (document.getElementById("place"));
  const cut = () => {
    const axis = /** @type {Axis | ""} */ (choice.value);
    slider.disabled = axis === "";
    if (axis === "") {
      output.value = "";
      viewer.setCut(null);
      return;
    }
    output.value = `${Number(slider.value).toFixed(2)} mm`;
    viewer.setCut({ axis, at: Number(slider.value) });
  };
  const begin = () => {
    const axis = ["x", "y", "z"].indexOf(choice.value);
    if (axis >= 0) {
      slider.step = "any";
      slider.min = String(low[axis]);
      slider.max = String(high[axis]);
      slider.value = String((low[axis] + high[axis]) / 2);
      slider.step = String((high[axis] - low[axis]) / STEPS || "any");
    }
    cut();
  };
  choice.addEventListener("change", begin);
  slider.addEventListener("input", cut);
  begin();
}
