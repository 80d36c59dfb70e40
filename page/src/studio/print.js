/**
 * A print: its layers before and after a refill side by side, in the colour of their speed, and what changed.
 */

import { createAgain, createDownloads } from "./again.js";
import { slider } from "./controls.js";
import { createDensity } from "./density.js";
import { announce, h, icon, plain, replaceChildren } from "./dom.js";
import { createForm } from "./form.js";
import { layerBounds } from "./layer.js";
import { createLive } from "./live.js";
import { createNumbers, timeText, valueText } from "./numbers.js";
import { createPatternChoice, showOwnParameters } from "./pattern_choice.js";
import { createLegend, createPlot, speedRange } from "./plot.js";
import { isAbort } from "./server.js";
import { createStage } from "./stage.js";
import { createFileHead, describeError, dropAgain, forServer, layout, withOption } from "./view.js";

/** @typedef {import("./store.js").Section} Section */
/** @typedef {import("./layer.js").Layer} Layer */
/** @typedef {{name: string, role: string, seconds: number, filament: number, length: number}} Feature */
/** @typedef {{file: string, kind: string, name: string, numbers: any[], print: {slicer: string, layers: {z: number|null, height: number}[], features: Feature[], time_s: number, filament_mm: number}}} OpenPrint */

const PRODUCT = "refill";
const KEEP = "keep";
const LEAST_SHARE = 0.005; // of the longest feature; shorter ones are left out
const WIDE = 1.2; // width for height of a layer
const HIDDEN = ["printer"];

/**
 * Make the view.
 * @param {import("./view.js").Studio} studio
 */
export function createPrintView(studio) {
  const { server, about, patterns, store } = studio;
  /** @type {OpenPrint|null} */
  let open = null;
  /** @type {Section} */
  let section = store.state.print;
  let asked = "";
  /** @type {string|null} */
  let result = null;
  /** @type {{before: Layer|null, after: Layer|null}} */
  const shown = { before: null, after: null };

  const head = createFileHead({
    accept: ".gcode,.bgcode,.gco,.3mf,.g",
    title: "Open another print",
    open: studio.open,
  });
  const before = createPlot("The layer before");
  const after = createPlot("The layer after");
  before.onCamera((camera) => after.setCamera(camera));
  after.onCamera((camera) => before.setCamera(camera));
  const beforeWords = h("span", { class: "plot-words" });
  const afterWords = h("span", { class: "plot-words" });
  const pair = h(
    "div",
    { class: "pair" },
    h("figure", {}, h("figcaption", {}, "Before", beforeWords), before.element),
    h("figure", {}, h("figcaption", {}, "After", afterWords), after.element),
  );
  const stage = createStage({ pictures: [pair], onCancel: () => live.stop(), onResume: () => live.resume() });
  const empty = h("div", { class: "empty", hidden: true });
  stage.element.append(empty);
  const legend = createLegend();
  const layerWords = h("output", { class: "cut-place" });
  const layerRange = h("input", {
    type: "range",
    min: "1",
    step: "1",
    "aria-label": "Layer",
    oninput: () => change({ ...section, layer: Number(layerRange.value) }, false),
    onchange: () => change({ ...section, layer: Number(layerRange.value) }, true),
  });
  const fit = h(
    "button",
    {
      type: "button",
      class: "quiet small",
      "aria-label": "Fit the layer",
      title: "Fit (F)",
      onclick: () => after.fit(),
    },
    icon("fit"),
  );
  const numbers = createNumbers();
  const features = h("section", { class: "features", hidden: true });
  const again = createAgain();
  const downloads = createDownloads({ server, slicers: [] });

  const pattern = createPatternChoice({
    patterns,
    product: PRODUCT,
    keep: {
      name: KEEP,
      title: "Keep the slicer's infill",
      sentence: "The paths stay where they are; their corners are rounded.",
    },
    onChoose: (name) => choosePattern(name),
    onTile: studio.open,
  });
  const density = createDensity({
    start: 20,
    auto: "the filament of the print",
    onChange: (two, resting) =>
      change(
        {
          ...section,
          options: Object.entries(two).reduce((all, [key, value]) => withOption(all, key, value), section.options),
        },
        resting,
      ),
    onField: studio.open,
  });
  const radius = slider({
    label: "Corner radius",
    unit: "mm",
    least: 0,
    most: 5,
    step: 0.1,
    auto: "as large as fits",
    start: 1,
    help: "Round corners keep the speed up.",
    onChange: (value, resting) =>
      change({ ...section, options: withOption(section.options, "smooth_radius", value) }, resting),
  });
  const form = createForm({
    options: about.products[PRODUCT] ?? [],
    main: [
      { keys: ["pattern"], control: pattern },
      { keys: ["density", "by"], control: density },
      { keys: ["smooth_radius"], control: radius },
    ],
    hidden: HIDDEN,
    onChange: (key, value, resting) =>
      change({ ...section, options: withOption(section.options, key, value) }, resting),
  });

  const live = createLive({
    ask: (quality, signal) =>
      server.ask(
        {
          product: PRODUCT,
          file: open?.file ?? null,
          options: forServer(section.options),
          quality,
          layer: layerIndex() + 1,
        },
        { signal, onProgress: (progress) => stage.progress(progress) },
      ),
    show: (reply, quality) => {
      form.fail(null);
      stage.fail(null);
      if (reply.layer) showAfter(reply.layer);
      stage.badge(quality === "coarse" ? "This layer" : null);
      again.show(reply.answer);
      if (quality === "coarse") return;
      result = reply.answer.result;
      numbers.show(reply.answer.numbers, reply.answer.warnings ?? []);
      showFeatures(features, reply.answer.features ?? [], open?.print.features);
      numbers.setStale(false);
      downloads.show(reply.answer);
      if (!reply.layer) loadLayers();
      announce(
        `The whole print is refilled. ${reply.answer.numbers
          .slice(0, 2)
          .map((/** @type {any} */ row) => `${row.name} ${valueText(row)}`)
          .join(", ")}`,
      );
    },
    fail: (error) => {
      const stated = describeError(error);
      if (!stated) return;
      form.fail(stated.message, stated.parameter);
      stage.badge(null);
    },
    busy: (state) => stage.busy(state, "Refilling the whole print"),
  });

  /** @param {string} name */
  function choosePattern(name) {
    let options = withOption(withOption(section.options, "set", null), "pattern", name === KEEP ? null : name);
    if (name === KEEP) options = withOption(withOption(options, "density", null), "by", null);
    change({ ...section, options }, true);
  }

  /**
   * @param {Section} next
   * @param {boolean} resting
   */
  function change(next, resting) {
    store.replace({ ...store.state, print: next }, { rest: resting, cause: resting ? "rest" : "move" });
  }

  function layerIndex() {
    const count = open?.print.layers.length ?? 1;
    return Math.min(count, Math.max(1, section.layer ?? Math.ceil(count / 2))) - 1;
  }

  let control = new AbortController();
  async function loadLayers() {
    if (!open) return;
    control.abort();
    control = new AbortController();
    const { signal } = control;
    const number = layerIndex() + 1;
    try {
      const [first, second] = await Promise.all([
        server.layer(open.file, number, null, signal),
        result ? server.layer(open.file, number, result, signal) : null,
      ]);
      shown.before = first;
      if (result) shown.after = second;
      draw();
    } catch (error) {
      if (!isAbort(error)) stage.fail(describeError(error)?.message ?? null);
    }
  }

  /** @param {Layer} layer */
  function showAfter(layer) {
    shown.after = layer;
    draw();
  }

  function draw() {
    const box = shown.before && layerBounds(shown.before);
    // A wide layer is larger with one picture above the other.
    if (box) pair.classList.toggle("stacked", box[2] - box[0] > WIDE * (box[3] - box[1]));
    const range = speedRange([shown.before, shown.after]);
    before.show(shown.before, range);
    after.show(shown.after, range);
    legend.show(range);
    beforeWords.textContent = timeWords(shown.before);
    afterWords.textContent = timeWords(shown.after);
  }

  return {
    element: layout({
      label: "Print",
      controls: [head.element, form.element],
      stage: [
        stage.element,
        h(
          "div",
          { class: "toolbar" },
          h(
            "div",
            { class: "cut" },
            h("span", { class: "field-label", "aria-hidden": "true" }, "Layer"),
            layerRange,
            layerWords,
          ),
          legend.element,
          fit,
        ),
      ],
      side: [numbers.element, features, downloads.element, again.element],
    }),
    /** @param {OpenPrint} file */
    opened(file) {
      open = file;
      asked = "";
      result = null;
      shown.before = shown.after = null;
      empty.hidden = true;
      layerRange.max = String(file.print.layers.length);
      head.show(file.name, [file.print.slicer, `${file.print.layers.length} layers`].filter(Boolean).join(" · "));
      numbers.show(file.numbers ?? []);
      showFeatures(features, file.print.features);
      stage.fail(null);
      form.fail(null);
      downloads.show(null);
      this.update(store.state.print, "jump");
    },
    /**
     * Follow the state.
     * @param {Section} next
     * @param {string} cause
     */
    update(next, cause) {
      const lastLayer = layerIndex();
      section = next;
      const { options } = section;
      const name = options.pattern ?? KEEP;
      pattern.set(name);
      density.set(options);
      density.element.hidden = name === KEEP;
      radius.set(options.smooth_radius ?? null);
      form.set(options);
      if (!open) {
        const waits = section.source?.name;
        empty.hidden = !waits;
        empty.textContent = waits ? dropAgain(waits) : "";
        return;
      }
      const index = layerIndex();
      layerRange.value = String(index + 1);
      layerRange.style.setProperty("--share", `${(index / Math.max(1, open.print.layers.length - 1)) * 100}%`);
      layerWords.textContent = `${index + 1} of ${open.print.layers.length} · z ${heightWords(open.print.layers[index].z)}`;
      layerRange.setAttribute("aria-valuetext", layerWords.textContent);
      const wanted = JSON.stringify(options);
      if (wanted === asked) {
        if (index !== lastLayer) {
          loadLayers();
          if (!result) live.jump();
        }
        return;
      }
      asked = wanted;
      result = null;
      showOwnParameters(
        form.own,
        patterns.find((one) => one.name === name),
        options.set ?? {},
        ["density", "line_width"],
        (key, value) =>
          change(
            { ...section, options: { ...section.options, set: withOption(section.options.set ?? {}, key, value) } },
            true,
          ),
      );
      downloads.show(null);
      numbers.setStale(true);
      if (!shown.before || index !== lastLayer) loadLayers();
      if (cause === "move") live.move();
      else live.jump();
    },
    hold: () => live.hold(),
    go: () => live.go(),
  };
}

/**
 * Show how long each feature of the print takes, the longest first; beside it, how long it took before.
 * @param {HTMLElement} place
 * @param {Feature[]} features
 * @param {Feature[]} [before]
 */
function showFeatures(place, features, before) {
  const longest = Math.max(...[...features, ...(before ?? [])].map(({ seconds }) => seconds), 1e-9);
  const rows = features.filter(({ seconds }) => seconds > LEAST_SHARE * longest).sort((a, b) => b.seconds - a.seconds);
  place.hidden = !rows.length;
  replaceChildren(
    place,
    h("h2", {}, "Time by feature"),
    h(
      "ul",
      {},
      rows.map(({ name, seconds }) => {
        const bar = h("span", { class: "share", "aria-hidden": "true" });
        bar.style.inlineSize = `${(100 * seconds) / longest}%`;
        const old = before?.find((one) => one.name === name)?.seconds;
        const change = old && timeText(old) !== timeText(seconds) ? `${timeText(old)} → ` : "";
        return h(
          "li",
          {},
          h("span", {}, name),
          h("span", { class: "feature-time" }, `${change}${timeText(seconds)}`),
          bar,
        );
      }),
    ),
  );
}

/** @param {number|null} z */
function heightWords(z) {
  return z === null ? "unknown" : `${z.toFixed(2)} mm`;
}

/** @param {Layer|null} layer */
function timeWords(layer) {
  return layer?.time_s ? `${plain(layer.time_s)} s` : "";
}
