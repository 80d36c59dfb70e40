/**
 * The pieces of a scan or mesh, each with its volume, to be kept or dropped; they count from 1, the largest first.
 */

import { h, plain, replaceChildren } from "./dom.js";

/** @typedef {{count: number, volumes: number[], places: number[][], rest: number}} Pieces */

/**
 * Which of `count` pieces a text such as "1,3-5,8-" keeps; all without one.
 * @param {any} text
 * @param {number} count
 * @returns {boolean[]}
 */
export function keptPieces(text, count) {
  const kept = new Array(count).fill(text === undefined || text === null);
  const words = text === undefined || text === null ? [] : String(text).split(",");
  for (const word of words) {
    const [first, last] = word.split("-");
    const end = last === undefined ? Number(first) : last === "" ? count : Number(last);
    for (let number = Number(first); number <= Math.min(end, count); number += 1) kept[number - 1] = true;
  }
  return kept;
}

/**
 * The text for a choice of pieces: null if all are kept.
 * @param {boolean[]} kept
 * @returns {string|null}
 */
export function piecesText(kept) {
  if (kept.every(Boolean)) return null;
  /** @type {string[]} */
  const words = [];
  for (let i = 0; i < kept.length; i += 1) {
    if (!kept[i]) continue;
    const first = i + 1;
    while (kept[i + 1]) i += 1;
    const isEnd = i + 1 === kept.length && i + 1 > first;
    words.push(i + 1 === first ? `${first}` : isEnd ? `${first}-` : `${first}-${i + 1}`);
  }
  return words.join(",");
}

/**
 * Make the list.
 * @param {{onChange: (keep: string|null) => void, onLook: (at: number[]|null) => void}} what `onLook` gets the place of a
 *   piece that is pointed at, null where none is.
 */
export function createPieces({ onChange, onLook }) {
  /** @type {Pieces|null} */
  let pieces = null;
  /** @type {any} */
  let text = null;
  const element = h("fieldset", { class: "pieces", hidden: true });

  /**
   * @param {number} first counted from 0
   * @param {number} last
   * @param {string} name
   * @param {number} volume
   * @param {number[]|null} place
   * @param {boolean[]} kept
   */
  function row(first, last, name, volume, place, kept) {
    const input = h("input", {
      type: "checkbox",
      checked: kept[first],
      onchange: () => {
        const next = kept.map((is, i) => (i >= first && i <= last ? input.checked : is));
        if (next.some(Boolean)) onChange(piecesText(next));
        else input.checked = true; // one has to stay
      },
      onfocus: () => onLook(place),
      onblur: () => onLook(null),
    });
    return h(
      "label",
      { class: "tick piece", onmouseenter: () => onLook(place), onmouseleave: () => onLook(null) },
      input,
      h("span", {}, name),
      h("span", { class: "piece-volume" }, `${plain(volume)} mm³`),
    );
  }

  function draw() {
    element.hidden = !pieces;
    if (!pieces) return;
    const { count, volumes, places, rest } = pieces;
    const kept = keptPieces(text, count);
    const number = kept.filter(Boolean).length;
    const listed = volumes.length;
    replaceChildren(
      element,
      h("legend", {}, number === count ? `${count} pieces` : `${number} of ${count} pieces kept`),
      volumes.map((volume, i) => row(i, i, `Piece ${i + 1}`, volume, places[i], kept)),
      count > listed ? row(listed, count - 1, `${plain(count - listed)} smaller ones`, rest, null, kept) : null,
    );
  }

  return {
    element,
    /** @param {Pieces|null} next */
    show(next) {
      const focused = [...element.querySelectorAll("input")].indexOf(/** @type {any} */ (document.activeElement));
      pieces = next;
      draw();
      if (focused >= 0) element.querySelectorAll("input")[focused]?.focus();
    },
    /** @param {any} next the value of the option */
    set(next) {
      if (next === text) return;
      text = next;
      this.show(pieces);
    },
    /** @param {string|null} _message which the form shows */
    fail(_message) {},
  };
}
