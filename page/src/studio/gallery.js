/**
 * The gallery: every pattern a card with its picture, its sentence and its facts; search and filters above.
 */

import { freshId, h, icon, plain, replaceChildren } from "./dom.js";

/** @typedef {import("./server.js").Pattern} Pattern */

const PRODUCTS = [
  { value: "", text: "Any use" },
  { value: "fill", text: "Fill a part" },
  { value: "refill", text: "Refill a print" },
];
const USES = { fill: "part", refill: "print" };

const EXPLAINED =
  "Measured at a density of 20 %. Stiffness: of the solid material, in the weakest and the stiffest direction; upright: along z. " +
  "Overhang: share of the surfaces inside that overhang by more than 45°.";

/**
 * Make the gallery.
 * @param {{patterns: Pattern[], product?: string, onChoose: (pattern: Pattern) => void, onTile?: (file: File) => void}} what
 *   With a `product`, only its patterns are shown.
 */
export function createGallery({ patterns, product = "", onChoose, onTile }) {
  const wanted = { words: "", product, kind: "" };
  const kinds = [...new Set(patterns.map(({ kind }) => kind))].filter(Boolean);
  const search = h("input", {
    type: "search",
    class: "search",
    id: freshId("search"),
    placeholder: "Search: gyroid, bars, stiff along z",
    "aria-label": "Search patterns",
    oninput: () => update({ words: search.value }),
  });
  const use = product ? null : chips("Use", PRODUCTS, (value) => update({ product: value }));
  const kind = chips(
    "Kind",
    [{ value: "", text: "All kinds" }, ...kinds.map((value) => ({ value, text: kindTitle(value) }))],
    (value) => update({ kind: value }),
  );
  const count = h("p", { class: "count", role: "status" });
  const list = h("ul", { class: "cards" });
  const cards = patterns.map((pattern) => ({ pattern, card: patternCard(pattern, onChoose) }));
  const tile = onTile ? tileCard(onTile) : null;

  /** @param {Partial<typeof wanted>} change */
  function update(change) {
    Object.assign(wanted, change);
    const shown = cards.filter(({ pattern }) => suits(pattern, wanted));
    replaceChildren(
      list,
      shown.map(({ card }) => card),
      tile,
    );
    count.textContent = shown.length
      ? `${shown.length} of ${cards.length} patterns`
      : "No pattern matches. Try fewer words.";
  }
  update({});

  return {
    element: h(
      "div",
      { class: "gallery" },
      h("div", { class: "filters" }, search, use, kind),
      count,
      list,
      h("p", { class: "field-help" }, EXPLAINED),
    ),
    search,
    /** @param {string} name the pattern that is chosen now */
    mark(name) {
      for (const { pattern, card } of cards) {
        const isChosen = pattern.name === name;
        card.querySelector("button")?.setAttribute("aria-pressed", String(isChosen));
      }
    },
  };
}

/**
 * Whether a pattern is shown: every word has to stand somewhere in what is known about it.
 * @param {Pattern} pattern
 * @param {{words: string, product: string, kind: string}} wanted
 */
export function suits(pattern, { words, product, kind }) {
  if (product && !pattern.products.includes(product)) return false;
  if (kind && pattern.kind !== kind) return false;
  const text = `${pattern.name} ${pattern.title} ${pattern.sentence} ${kindTitle(pattern.kind)}`
    .toLowerCase()
    .replaceAll("-", " ");
  return words
    .toLowerCase()
    .replaceAll("-", " ")
    .split(/\s+/)
    .every((word) => text.includes(word));
}

/** @param {string} kind */
function kindTitle(kind) {
  return kind ? kind.charAt(0).toUpperCase() + kind.slice(1).replaceAll("_", " ") : "";
}

/**
 * @param {string} label
 * @param {{value: string, text: string}[]} list
 * @param {(value: string) => void} onChoose
 */
function chips(label, list, onChoose) {
  const name = freshId("chips");
  return h(
    "fieldset",
    { class: "chips" },
    h("legend", { class: "hidden-text" }, label),
    ...list.map(({ value, text }, i) =>
      h(
        "label",
        {},
        h("input", { type: "radio", name, checked: i === 0, onchange: () => onChoose(value) }),
        h("span", {}, text),
      ),
    ),
  );
}

/**
 * @param {Pattern} pattern
 * @param {(pattern: Pattern) => void} onChoose
 */
function patternCard(pattern, onChoose) {
  const uses = pattern.products.map((name) => USES[/** @type {"fill"} */ (name)]).filter(Boolean);
  return h(
    "li",
    {},
    h(
      "button",
      { type: "button", class: "card", onclick: () => onChoose(pattern) },
      pattern.picture
        ? h("img", { src: pattern.picture, alt: "", loading: "lazy", width: 200, height: 200 })
        : h("span", { class: "no-picture" }, icon("pattern")),
      h("span", { class: "card-title" }, pattern.title),
      h("span", { class: "card-text" }, sentenceOf(pattern)),
      h("span", { class: "facts" }, ...factWords(pattern).map((text) => h("span", {}, text))),
      h("span", { class: "uses" }, uses.length ? `For a ${uses.join(" or a ")}` : ""),
    ),
  );
}

/**
 * The measured facts in words; shares are of the solid material and of all surfaces.
 * @param {Pattern} pattern
 */
export function factWords({ facts }) {
  /** @type {string[]} */
  const words = [];
  const { weakest, stiffest, stiffness_z: upright, overhang, smallest_radius: radius } = facts ?? {};
  if (weakest !== undefined) words.push(`Stiffness ${range(weakest, stiffest)}`);
  else if (upright !== undefined) words.push(`Stiffness ${percentOf(upright)} upright`);
  if (overhang !== undefined) words.push(`Overhang ${percentOf(overhang)}`);
  if (radius !== undefined) words.push(`Radius ${plain(radius)} mm`);
  return words;
}

/** @param {number} share */
function percentOf(share) {
  return `${plain(Number((100 * share).toPrecision(2)))} %`;
}

/**
 * @param {number} least
 * @param {number} most
 */
function range(least, most) {
  const [low, high] = [percentOf(least), percentOf(most ?? least)];
  return low === high ? low : `${low.replace(" %", "")}–${high}`;
}

/**
 * The sentence of a pattern, from a capital letter to a full stop.
 * @param {Pattern} pattern
 */
export function sentenceOf({ sentence }) {
  const text = sentence.charAt(0).toUpperCase() + sentence.slice(1);
  return /[.!?]$/.test(text) || !text ? text : `${text}.`;
}

/** @param {(file: File) => void} onTile */
function tileCard(onTile) {
  const input = h("input", {
    type: "file",
    accept: ".svg,.dxf,.png,.jpg,.bmp,.wkt",
    class: "hidden-text",
    "aria-label": "Your own tile: an SVG, DXF or PNG",
    onchange: () => input.files?.[0] && onTile(input.files[0]),
  });
  return h(
    "li",
    {},
    h(
      "label",
      { class: "card tile-card" },
      input,
      h("span", { class: "no-picture" }, icon("drop")),
      h("span", { class: "card-title" }, "Your own tile"),
      h("span", { class: "card-text" }, "A drawing that repeats: SVG, DXF or PNG. Choose it here or drop it anywhere."),
    ),
  );
}

/**
 * A dialog with the gallery, to choose a pattern for a product.
 * @param {{patterns: Pattern[], product: string, onChoose: (pattern: Pattern) => void, onTile?: (file: File) => void}} what
 */
export function createPicker({ patterns, product, onChoose, onTile }) {
  const gallery = createGallery({
    patterns,
    product,
    onChoose: (pattern) => {
      dialog.close();
      onChoose(pattern);
    },
    onTile: onTile
      ? (file) => {
          dialog.close();
          onTile(file);
        }
      : undefined,
  });
  const heading = h("h2", { id: freshId("picker") }, "Choose a pattern");
  const dialog = h(
    "dialog",
    { class: "picker", "aria-labelledby": heading.id },
    h(
      "div",
      { class: "picker-head" },
      heading,
      h(
        "button",
        { type: "button", class: "quiet", "aria-label": "Close", onclick: () => dialog.close() },
        icon("close"),
      ),
    ),
    gallery.element,
  );
  return {
    dialog,
    /** @param {string} name */
    open(name) {
      gallery.mark(name);
      dialog.showModal();
      gallery.search.focus();
    },
  };
}
