/**
 * A scan, or a rough mesh: choose what is solid on the histogram, see its outline in three slices and its surface
 * before and after smoothing, save it.
 */

import { decodeMesh } from "../viewer/mesh.js";
import { createViewer, COLOURS as LABEL_COLOURS } from "../viewer/viewer.js";
import { createAgain, createDownloads } from "./again.js";
import { followTheme } from "./colours.js";
import { choices, slider } from "./controls.js";
import { createCut } from "./cut.js";
import { announce, h, plain, replaceChildren } from "./dom.js";
import { createForm } from "./form.js";
import { createHistogram } from "./histogram.js";
import { createLive } from "./live.js";
import { createNumbers, valueText } from "./numbers.js";
import { boundsOf } from "./part.js";
import { createPieces } from "./pieces.js";
import { createPlaces } from "./places.js";
import { StatedError } from "./server.js";
import { createSlices } from "./slices.js";
import { createStage } from "./stage.js";
import { createFileHead, describeError, dropAgain, forServer, layout, withOption } from "./view.js";

/** @typedef {import("./store.js").Section} Section */
/** @typedef {{value: number, name: string, colour: number[]|null}} Label */
/** @typedef {{file: string, kind: string, name: string, numbers: any[], part?: any, scan?: {shape: number[], spacing: number[],
 *   least: number, most: number, histogram: {edges: number[], counts: number[]}, otsu: number|null,
 *   thresholds: import("./histogram.js").NamedThreshold[], labels: Label[]|null}}} OpenScan */

const SMOOTH = "smooth";
const LABELS = "labels";
const BEFORE = "voxels"; // name of the surface before smoothing
const SOLID_NAME = "solid"; // of the surface that is not of a label
const PIECE = "#12b5a6"; // of the ring around a piece
const COLOURS = { voxels: "#b4c0c8", solid: "#d3bf98" };
const HIDDEN = [
  "as",
  "units",
  "otsu",
  "array",
  "series",
  "labels",
  "each_label",
  "keep_going",
  "max_triangles",
  "refine",
];
const SOLID = ["threshold", "range", "label", "otsu"]; // options that say what is solid

/**
 * Make the view.
 * @param {import("./view.js").Studio} studio
 */
export function createScanView(studio) {
  const { server, about, store } = studio;
  /** @type {OpenScan|null} */
  let open = null;
  /** @type {Section} */
  let section = store.state.scan;
  let asked = "";
  /** @type {any} */
  let meshBefore = null;
  let isFresh = true; // whether the first mesh of a file is awaited, to which the view is fitted

  const head = createFileHead({
    accept: ".nrrd,.nhdr,.nii,.gz,.mha,.mhd,.npz,.npy,.tif,.tiff,.zip,.stl,.ply,.obj",
    title: "Open another scan",
    open: studio.open,
  });
  const reducedMotion = matchMedia("(prefers-reduced-motion: reduce)").matches;
  const frames = [h("div", { class: "viewer" }), h("div", { class: "viewer" })];
  const [before, after] = ["The surface before smoothing", "The surface after smoothing"].map((label, i) =>
    createViewer(frames[i], { label, reducedMotion }),
  );
  before.onCamera((/** @type {any} */ camera) => after.setCamera(camera));
  after.onCamera((/** @type {any} */ camera) => before.setCamera(camera));
  followTheme((theme) => {
    for (const viewer of [before, after]) viewer.setTheme(theme);
  });
  const figureBefore = h("figure", { hidden: true }, h("figcaption", {}, "Before"), frames[0]);
  const pair = h("div", { class: "pair" }, figureBefore, h("figure", {}, h("figcaption", {}, "After"), frames[1]));
  const stage = createStage({ pictures: [pair], onCancel: () => live.stop(), onResume: () => live.resume() });
  const empty = h("div", { class: "empty", hidden: true });
  stage.element.append(empty);
  const cut = createCut({ onChange: (value, resting) => change({ ...section, cut: value }, resting) });
  const places = createPlaces({ views: [before, after] });
  const slices = createSlices({ server, onFail: (error) => stage.fail(describeError(error)?.message ?? null) });
  const numbers = createNumbers();
  const again = createAgain();
  const downloads = createDownloads({ server, slicers: [] });

  const mode = choices({
    label: "What is solid",
    choices: [
      { value: "threshold", text: "From a value" },
      { value: "range", text: "Between two" },
    ],
    onChange: (value) => {
      const [low] = ends();
      const high = open?.scan ? (low + open.scan.most) / 2 : low;
      setSolid(value === "range" ? { range: `${low},${Number(high.toFixed(3))}` } : { threshold: low }, true);
    },
  });
  const histogramPlace = h("div", { class: "histogram-place" });
  /** @type {ReturnType<typeof createHistogram>|null} */
  let histogram = null;
  const labelList = h("div", { class: "labels", role: "group", "aria-label": "Labels" });
  const method = option("smooth", choices, {
    label: "Method",
    choices: [
      { value: "", text: "Auto", title: "Chosen by the data" },
      { value: "plain", text: "Plain", title: "For noise" },
      { value: "refine", text: "Refine", title: "Keeps edges and thin walls" },
      { value: "grey", text: "Grey", title: "Keeps the grey levels of a scan" },
    ],
  });
  const steps = option("steps", slider, { label: "Smoothing", unit: "steps", least: 0, most: 100, step: 1, start: 20 });
  const despeckle = option("despeckle", slider, {
    label: "Drop pieces up to",
    unit: "mm³",
    least: 0,
    most: 500,
    step: 1,
    start: 0,
    help: "Loose pieces smaller than this are left out.",
  });
  const pieces = createPieces({
    onChange: (keep) => change({ ...section, options: withOption(section.options, "keep_components", keep) }, true),
    onLook: (at) => {
      for (const viewer of [before, after]) viewer.setMarks("piece", at ? [{ at, colour: PIECE }] : []);
    },
  });
  const solid = {
    element: h("div", { class: "solid" }, mode.element, histogramPlace, labelList),
    set() {},
    /** @param {string|null} message */
    fail: (message) => (histogram ? histogram.fail(message) : mode.fail(message)),
  };
  const form = createForm({
    options: about.products[SMOOTH] ?? [],
    main: [
      { keys: SOLID, control: solid },
      { keys: ["smooth"], control: method },
      { keys: ["steps"], control: steps },
      { keys: ["keep_components"], control: pieces },
      { keys: ["despeckle"], control: despeckle },
    ],
    hidden: HIDDEN,
    onChange: (key, value, resting) =>
      change({ ...section, options: withOption(section.options, key, value) }, resting),
  });

  /** @type {import("./places.js").Place[]} */
  let changed = []; // of the answer that is shown
  const anyway = h(
    "button",
    {
      type: "button",
      class: "button anyway",
      hidden: true,
      onclick: () => change({ ...section, options: withOption(section.options, "allow_broken", true) }, true),
    },
    "Make it anyway, and mark what is lost",
  );
  form.element.querySelector(".form-error")?.after(anyway);

  const live = createLive({
    ask: (quality, signal) =>
      server.ask(
        { product: product(), file: open?.file ?? null, options: forServer(effective()), quality },
        { signal, onProgress: (progress) => stage.progress(progress) },
      ),
    show: (reply, quality) => {
      form.fail(null);
      stage.fail(null);
      if (reply.mesh) showMesh(decodeMesh(reply.mesh));
      numbers.show(reply.answer.numbers, reply.answer.warnings ?? []);
      numbers.setStale(quality === "coarse");
      pieces.show(reply.answer.pieces ?? null);
      again.show(reply.answer);
      stage.badge(quality === "coarse" ? "Preview" : null);
      anyway.hidden = true;
      changed = reply.answer.places ?? [];
      // A preview is smoothed in larger voxels, which loses more.
      places.show(quality === "exact" ? changed : []);
      if (quality !== "exact") return;
      downloads.show(reply.answer);
      announce(
        `Exact result. ${reply.answer.numbers
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
      downloads.show(null);
      anyway.hidden = !(error instanceof StatedError && error.refused);
      if (!anyway.hidden) places.show(changed);
    },
    busy: (state) => stage.busy(state, "Computing the exact surface"),
  });

  function product() {
    const isSolid = ["threshold", "range", "otsu"].some((key) => key in section.options);
    return open?.scan?.labels?.length && !isSolid ? LABELS : SMOOTH;
  }

  /** The options, with the threshold that is chosen for a scan that has none. */
  function effective() {
    const { options } = section;
    if (!open?.scan || product() === LABELS || SOLID.some((key) => key in options)) return options;
    return { threshold: ends()[0], ...options };
  }

  /** @returns {number[]} the threshold, or both ends of a range */
  function ends() {
    const { threshold, range } = section.options;
    if (range !== undefined) return (Array.isArray(range) ? range : String(range).split(",")).map(Number);
    if (threshold !== undefined) return [Number(threshold)];
    const scan = open?.scan;
    return scan ? [Number((scan.otsu ?? (scan.least + scan.most) / 2).toPrecision(4))] : [0];
  }

  /**
   * @param {Record<string, any>} choice
   * @param {boolean} resting
   */
  function setSolid(choice, resting) {
    // Pieces are counted anew.
    const rest = [...SOLID, "keep_components"].reduce((all, key) => withOption(all, key, null), section.options);
    change({ ...section, options: { ...rest, ...choice } }, resting);
  }

  /**
   * @template T
   * @param {string} key
   * @param {(what: any) => T} make
   * @param {Record<string, any>} what
   */
  function option(key, make, what) {
    return make({
      ...what,
      onChange: (/** @type {any} */ value, /** @type {boolean} */ resting) =>
        change({ ...section, options: withOption(section.options, key, value === "" ? null : value) }, resting),
    });
  }

  /**
   * @param {Section} next
   * @param {boolean} resting
   */
  function change(next, resting) {
    store.replace({ ...store.state, scan: next }, { rest: resting, cause: resting ? "rest" : "move" });
  }

  /** @param {any} mesh */
  function showMesh(mesh) {
    const [old, fresh] = [true, false].map((wanted) =>
      mesh.surfaces.filter((/** @type {{name: string}} */ { name }) => (name === BEFORE) === wanted),
    );
    if (old.length) meshBefore = { ...mesh, surfaces: old };
    const appears = Boolean(meshBefore) && figureBefore.hidden; // which leaves the other half the width
    figureBefore.hidden = !meshBefore;
    pair.classList.toggle("single", !meshBefore);
    if (meshBefore) {
      before.setMesh(meshBefore);
      before.setColour(BEFORE, COLOURS.voxels);
    }
    if (fresh.length) after.setMesh({ ...mesh, surfaces: fresh });
    after.setColour(SOLID_NAME, COLOURS.solid);
    cut.setBounds(boundsOfSurfaces(mesh.surfaces));
    // Once both stand in their places, they are seen from the same one.
    requestAnimationFrame(() => {
      if (!fresh.length) return before.fit();
      if (isFresh || appears) after.fit();
      isFresh = false;
      before.setCamera(after.getCamera());
    });
    setCuts();
  }

  function setCuts() {
    for (const viewer of [before, after]) viewer.setCut(cut.plane);
  }

  /** @param {Label[]} labels */
  function showLabels(labels) {
    replaceChildren(
      labelList,
      ...labels.map((label, i) => {
        const input = h("input", { type: "checkbox", checked: true, onchange: () => chooseLabels(input) });
        const swatch = h("span", { class: "swatch", "aria-hidden": "true" });
        swatch.style.background = cssColour(label.colour) ?? LABEL_COLOURS[i % LABEL_COLOURS.length];
        return h("label", { class: "tick" }, input, swatch, h("span", {}, label.name || `Label ${label.value}`));
      }),
    );
  }

  function labelTicks() {
    return [...labelList.querySelectorAll("input")];
  }

  /**
   * Leave out the labels that are not ticked: of the view at once, of the files with the next answer.
   * @param {HTMLInputElement} changed
   */
  function chooseLabels(changed) {
    const labels = open?.scan?.labels ?? [];
    const ticks = labelTicks();
    if (!ticks.some((tick) => tick.checked)) changed.checked = true; // one has to stay
    for (const [i, { name }] of labels.entries()) after.setVisible(name, ticks[i].checked);
    const chosen = labels.filter((_, i) => ticks[i].checked).map(({ value }) => value);
    const all = chosen.length === labels.length;
    change({ ...section, options: withOption(section.options, "label", all ? null : chosen) }, true);
  }

  return {
    element: layout({
      label: "Scan",
      controls: [head.element, form.element],
      stage: [stage.element, h("div", { class: "toolbar" }, cut.element, places.legend), slices.element],
      side: [numbers.element, places.list, downloads.element, again.element],
    }),
    /**
     * @param {OpenScan} file
     * @param {ArrayBuffer|null} mesh
     */
    opened(file, mesh) {
      open = file;
      asked = "";
      meshBefore = null;
      isFresh = true;
      anyway.hidden = true;
      places.show([]);
      pieces.show(null);
      after.setMesh({ surfaces: [] });
      empty.hidden = true;
      numbers.show(file.numbers ?? []);
      const { scan } = file;
      const facts = scan ? scan.shape.join(" × ") : `${plain(file.part?.triangles ?? 0)} triangles`;
      head.show(file.name, facts);
      solid.element.hidden = !scan;
      slices.element.hidden = !scan;
      method.element.querySelectorAll("label")[3]?.toggleAttribute("hidden", !scan);
      if (scan) {
        slices.open(file.file, scan);
        const labels = scan.labels ?? [];
        mode.element.hidden = labels.length > 0;
        histogramPlace.hidden = labels.length > 0;
        labelList.hidden = !labels.length;
        showLabels(labels);
        histogram = createHistogram({
          histogram: scan.histogram,
          least: scan.least,
          most: scan.most,
          named: scan.thresholds,
          onChange: (next, resting) =>
            setSolid(next.length > 1 ? { range: next.join(",") } : { threshold: next[0] }, resting),
        });
        replaceChildren(histogramPlace, histogram.element);
      } else if (file.part) cut.setBounds(boundsOf(file.part.bounds));
      if (mesh) {
        const decoded = decodeMesh(mesh);
        showMesh({
          ...decoded,
          surfaces: decoded.surfaces.map((/** @type {any} */ one) => ({ ...one, name: BEFORE })),
        });
      }
      stage.fail(null);
      form.fail(null);
      downloads.show(null);
      this.update(store.state.scan, "jump");
    },
    /**
     * Follow the state.
     * @param {Section} next
     * @param {string} cause
     */
    update(next, cause) {
      section = next;
      const { options } = section;
      mode.set(options.range === undefined ? "threshold" : "range");
      histogram?.set(ends());
      if (open?.scan) slices.outline(product() === LABELS ? [] : ends());
      method.set(options.smooth ?? "");
      steps.set(options.steps ?? 20);
      despeckle.set(options.despeckle ?? 0);
      pieces.set(options.keep_components ?? null);
      const chosen = options.label === undefined ? null : [options.label].flat();
      for (const [i, tick] of labelTicks().entries())
        tick.checked = !chosen || chosen.includes(open?.scan?.labels?.[i].value);
      form.set(options);
      cut.set(section.cut);
      setCuts();
      if (!open) {
        const waits = section.source?.name;
        empty.hidden = !waits;
        empty.textContent = waits ? dropAgain(waits) : "";
        return;
      }
      const wanted = JSON.stringify(effective());
      if (wanted === asked) return;
      asked = wanted;
      downloads.show(null);
      numbers.setStale(true);
      if (cause === "move") live.move();
      else live.jump();
    },
    hold: () => live.hold(),
    go: () => live.go(),
  };
}

/**
 * The box around surfaces.
 * @param {import("../viewer/mesh.js").Surface[]} surfaces
 */
function boundsOfSurfaces(surfaces) {
  const axes = [0, 1, 2];
  return {
    low: axes.map((i) => Math.min(...surfaces.map(({ low }) => low[i]))),
    high: axes.map((i) => Math.max(...surfaces.map(({ low, size }) => low[i] + size[i]))),
  };
}

/** @param {number[]|null} colour sRGB, from 0 to 1 */
function cssColour(colour) {
  if (!colour) return null;
  return `rgb(${colour.map((share) => Math.round(255 * share)).join(" ")})`;
}
