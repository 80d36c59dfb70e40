/**
 * Places where smoothing lost or added something: marked in the views, and listed, each to be looked at.
 */

import { h, replaceChildren } from "./dom.js";

/** @typedef {{change: "lost"|"added"|"wall", at: number[], text: string, label: string}} Place */
/** @typedef {ReturnType<typeof import("../viewer/viewer.js").createViewer>} View */

const KINDS = {
  lost: { title: "Lost", colour: "#e0402f" },
  wall: { title: "Wall that vanished", colour: "#f0a020" },
  added: { title: "Added", colour: "#3f8cff" },
};

/**
 * Make the switches and the list.
 * @param {{views: View[]}} what in which places are marked; the camera of the first one goes to a place.
 */
export function createPlaces({ views }) {
  /** @type {Place[]} */
  let places = [];
  /** @type {Record<string, boolean>} */
  const hidden = {};
  const legend = h("div", { class: "surfaces marks", role: "group", "aria-label": "Marked places" });
  const list = h("table", { class: "components places", hidden: true });

  function mark() {
    const shown = places.filter(({ change }) => !hidden[change]);
    const marks = shown.map(({ at, change }) => ({ at, colour: KINDS[change].colour }));
    for (const view of views) view.setMarks("places", marks);
  }

  /** @param {keyof typeof KINDS} change */
  function legendTick(change) {
    const { title, colour } = KINDS[change];
    const count = places.filter((place) => place.change === change).length;
    const input = h("input", {
      type: "checkbox",
      checked: !hidden[change],
      onchange: () => {
        hidden[change] = !input.checked;
        mark();
      },
    });
    const ring = h("span", { class: "ring", "aria-hidden": "true" });
    ring.style.borderColor = colour;
    return h("label", { class: "tick" }, input, ring, h("span", {}, `${title} (${count})`));
  }

  /** @param {Place} place */
  function row({ change, at, text, label }) {
    const title = [KINDS[change].title, label].filter(Boolean).join(", ");
    const where = at.map((value) => value.toFixed(1)).join(", ");
    return h(
      "tr",
      {},
      h("td", {}, h("strong", {}, title), h("br"), `${text}, at ${where}`),
      h(
        "td",
        {},
        h(
          "button",
          {
            type: "button",
            class: "quiet",
            "aria-label": `Look at: ${title}, at ${where}`,
            onclick: () => {
              for (const view of views) view.lookAt(at);
            },
          },
          "Look",
        ),
      ),
    );
  }

  return {
    legend,
    list,
    /** @param {Place[]} next */
    show(next) {
      places = next;
      const changes = /** @type {(keyof typeof KINDS)[]} */ (Object.keys(KINDS));
      replaceChildren(
        legend,
        changes.filter((change) => places.some((place) => place.change === change)).map(legendTick),
      );
      list.hidden = !places.length;
      replaceChildren(list, h("caption", {}, "Changed places"), h("tbody", {}, places.map(row)));
      mark();
    },
  };
}
