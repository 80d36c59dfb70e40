/**
 * A block: a pattern by itself, as large as one likes, cut open with its numbers, and saved.
 */

import { decodeMesh } from "../viewer/mesh.js";
import { createViewer } from "../viewer/viewer.js";
import { createAgain, createDownloads } from "./again.js";
import { followTheme } from "./colours.js";
import { line, slider } from "./controls.js";
import { createCut } from "./cut.js";
import { announce, h } from "./dom.js";
import { createForm } from "./form.js";
import { createLive } from "./live.js";
import { createNumbers, valueText } from "./numbers.js";
import { createPatternChoice, showOwnParameters } from "./pattern_choice.js";
import { createStage } from "./stage.js";
import { describeError, forServer, layout, percent, withOption } from "./view.js";

/** @typedef {import("./store.js").Section} Section */

const PRODUCT = "make";
const PATTERN = "honeycomb"; // where none is chosen
const COLOUR = "#e0973f";

/**
 * Make the view.
 * @param {import("./view.js").Studio} studio
 */
export function createBlockView({ server, about, patterns, store }) {
  /** @type {Section} */
  let section = store.state.block;
  let asked = "";
  let shownPattern = "";
  let shownSize = ""; // to which the view is fitted

  const picture = h("div", { class: "viewer" });
  const stage = createStage({ pictures: [picture], onCancel: () => live.stop(), onResume: () => live.resume() });
  const viewer = createViewer(picture, { label: "The block" });
  followTheme((theme) => viewer.setTheme(theme));
  const cut = createCut({ onChange: (value, resting) => change({ ...section, cut: value }, resting) });
  const numbers = createNumbers();
  const again = createAgain();
  const downloads = createDownloads({ server, slicers: [] });
  const pattern = createPatternChoice({
    patterns,
    product: PRODUCT,
    onChoose: (name) =>
      change({ ...section, options: { ...withOption(section.options, "set", null), pattern: name } }, true),
  });
  const size = option("size", line, {
    label: "Size",
    kind: "text",
    unit: "mm",
    placeholder: "60x60",
    help: "Width and depth.",
  });
  const height = option("height", slider, {
    label: "Height",
    unit: "mm",
    least: 1,
    most: 60,
    step: 0.5,
    auto: "6 mm",
    start: 6,
  });
  const density = slider({
    label: "Density",
    unit: "%",
    least: 3,
    most: 80,
    step: 1,
    auto: "as drawn",
    start: 20,
    onChange: (/** @type {number|null} */ value, /** @type {boolean} */ resting) =>
      setOption("density", value === null ? null : `${value}%`, resting),
  });
  const width = option("line_width", slider, {
    label: "Line width",
    unit: "mm",
    least: 0.3,
    most: 3,
    step: 0.05,
    auto: "0.45 mm",
    start: 0.45,
  });
  const form = createForm({
    options: about.products[PRODUCT] ?? [],
    main: [
      { keys: ["pattern"], control: pattern },
      { keys: ["size"], control: size },
      { keys: ["height"], control: height },
      { keys: ["density"], control: density },
      { keys: ["line_width"], control: width },
    ],
    hidden: [],
    onChange: setOption,
  });

  const live = createLive({
    drafts: false,
    ask: (quality, signal) =>
      server.ask(
        { product: PRODUCT, file: null, options: forServer(effective()), quality },
        { signal, onProgress: (progress) => stage.progress(progress) },
      ),
    show: ({ answer, mesh }) => {
      form.fail(null);
      if (mesh) showMesh(mesh);
      numbers.show(answer.numbers, answer.warnings ?? []);
      numbers.setStale(false);
      again.show(answer);
      downloads.show(answer);
      announce(`The block is there. ${answer.numbers.slice(0, 2).map(numberText).join(", ")}`);
    },
    fail: (error) => {
      const stated = describeError(error);
      if (stated) form.fail(stated.message, stated.parameter);
    },
    busy: (state) => stage.busy(state, "Computing the block"),
  });

  /** @param {import("./numbers.js").NumberRow} row */
  function numberText(row) {
    return `${row.name} ${valueText(row)}`;
  }

  /** @returns {Record<string, any>} */
  function effective() {
    return { pattern: PATTERN, ...section.options };
  }

  /**
   * A control of one option.
   * @template T
   * @param {string} key
   * @param {(what: any) => T} make
   * @param {Record<string, any>} what
   */
  function option(key, make, what) {
    return make({
      ...what,
      onChange: (/** @type {any} */ value, /** @type {boolean} */ resting = true) => setOption(key, value, resting),
    });
  }

  /**
   * @param {string} key
   * @param {any} value
   * @param {boolean} resting
   */
  function setOption(key, value, resting) {
    change({ ...section, options: withOption(section.options, key, value === "" ? null : value) }, resting);
  }

  /**
   * @param {Section} next
   * @param {boolean} resting
   */
  function change(next, resting) {
    store.replace({ ...store.state, block: next }, { rest: resting, cause: resting ? "rest" : "move" });
  }

  /** @param {ArrayBuffer} bytes */
  function showMesh(bytes) {
    const mesh = decodeMesh(bytes);
    viewer.setMesh(mesh);
    for (const { name } of mesh.surfaces) viewer.setColour(name, COLOUR);
    const [{ low, size: extent }] = mesh.surfaces;
    cut.setBounds({ low, high: low.map((value, axis) => value + extent[axis]) });
    viewer.setCut(cut.plane);
    if (String(extent) !== shownSize) viewer.fit();
    shownSize = String(extent);
  }

  return {
    element: layout({
      label: "Block",
      controls: [form.element],
      stage: [stage.element, h("div", { class: "toolbar" }, cut.element)],
      side: [numbers.element, downloads.element, again.element],
    }),
    /**
     * Follow the state.
     * @param {Section} next
     * @param {string} cause
     */
    update(next, cause) {
      section = next;
      const options = effective();
      pattern.set(options.pattern);
      size.set(options.size ?? null);
      height.set(options.height ?? null);
      density.set(percent(options.density ?? null));
      width.set(options.line_width ?? null);
      form.set(options);
      cut.set(section.cut);
      viewer.setCut(cut.plane);
      const wanted = JSON.stringify(options);
      if (wanted === asked) return;
      asked = wanted;
      if (options.pattern !== shownPattern || cause === "history") {
        shownPattern = options.pattern;
        showOwnParameters(
          form.own,
          patterns.find(({ name }) => name === options.pattern),
          options.set ?? {},
          about.products[PRODUCT].map(({ key }) => key),
          (key, value) => setOption("set", withOption(section.options.set ?? {}, key, value), true),
        );
      }
      downloads.show(null);
      numbers.setStale(true);
      if (cause === "move") live.move();
      else live.jump();
    },
    hold: () => live.hold(),
    go: () => live.go(),
  };
}
