/**
 * Where one begins: drop a file, try a sample, or choose by picture.
 */

import { h, icon } from "./dom.js";

const FAVOURITES = [
  "gyroid",
  "honeycomb",
  "cubic",
  "octet",
  "voronoi-foam",
  "schwarz-d",
  "lightning",
  "tri-hexagon",
  "concentric-heart",
  "kelvin",
  "cross-hatch",
  "adaptive-cubic",
];
export const ACCEPT =
  ".stl,.3mf,.obj,.off,.ply,.glb,.gcode,.bgcode,.gco,.nrrd,.nhdr,.nii,.gz,.mha,.mhd,.npz,.npy,.tif,.tiff,.zip,.svg,.dxf,.png";

/**
 * Make the view.
 * @param {import("./view.js").Studio} studio
 * @param {{choosePattern: (name: string) => void, showGallery: () => void}} actions
 */
export function createStartView(studio, { choosePattern, showGallery }) {
  const input = h("input", {
    type: "file",
    accept: ACCEPT,
    class: "hidden-text",
    id: "first-file",
    onchange: () => {
      if (input.files?.[0]) studio.open(input.files[0]);
      input.value = "";
    },
  });
  const favourites = FAVOURITES.map((name) => studio.patterns.find((pattern) => pattern.name === name)).filter(
    (pattern) => pattern?.picture,
  );
  return {
    element: h(
      "div",
      { class: "start" },
      h("h1", {}, "See it before you print it"),
      h("p", { class: "lead" }, "Open a part, a sliced print or a scan. Everything stays on this computer."),
      h(
        "label",
        { class: "drop-zone" },
        input,
        h("span", { class: "drop-icon" }, icon("drop")),
        h("span", { class: "drop-title" }, "Drop a file here, or choose one"),
        h(
          "span",
          { class: "drop-kinds" },
          h("span", {}, h("b", {}, "Part"), " STL, 3MF, OBJ"),
          h("span", {}, h("b", {}, "Print"), " G-code, bgcode, .gcode.3mf"),
          h("span", {}, h("b", {}, "Scan"), " NRRD, NIfTI, DICOM as a zip"),
        ),
      ),
      h("h2", {}, "Or try a sample"),
      h(
        "div",
        { class: "samples" },
        sample("part", "A bracket", "Fill it with a pattern, cut it open, save it for your slicer."),
        sample("print", "A sliced plate", "Give it another infill, and see speed and time before and after."),
        sample("scan", "A finger bone", "Turn the scan into a smooth surface to print."),
      ),
      h(
        "div",
        { class: "start-head" },
        h("h2", {}, "Or begin with a pattern"),
        h("button", { type: "button", class: "quiet", onclick: showGallery }, `All ${studio.patterns.length} patterns`),
      ),
      h(
        "ul",
        { class: "strip" },
        ...favourites.map((pattern) =>
          h(
            "li",
            {},
            h(
              "button",
              { type: "button", class: "card small", onclick: () => choosePattern(pattern?.name ?? "") },
              h("img", { src: pattern?.picture, alt: "", loading: "lazy", width: 120, height: 120 }),
              h("span", { class: "card-title" }, pattern?.title),
            ),
          ),
        ),
      ),
    ),
  };

  /**
   * @param {"part"|"print"|"scan"} name
   * @param {string} title
   * @param {string} text
   */
  function sample(name, title, text) {
    return h(
      "button",
      { type: "button", class: "sample", onclick: () => studio.openSample(name) },
      h("span", { class: "sample-icon" }, icon(name)),
      h("span", { class: "sample-words" }, h("strong", {}, title), h("span", {}, text)),
    );
  }
}
