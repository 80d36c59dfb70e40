/**
 * A part: choose a pattern, pull sliders, see it cut open with its numbers, save it.
 */

import { decodeMesh } from "../viewer/mesh.js";
import { createViewer } from "../viewer/viewer.js";
import { createAgain, createDownloads } from "./again.js";
import { followTheme } from "./colours.js";
import { choices, select, slider, tick } from "./controls.js";
import { createCut } from "./cut.js";
import { createDensity } from "./density.js";
import { createDensityPaint } from "./density_paint.js";
import { announce, h, plain } from "./dom.js";
import { createForm } from "./form.js";
import { createLive } from "./live.js";
import { createNumbers, valueText } from "./numbers.js";
import { createPatternChoice, showOwnParameters } from "./pattern_choice.js";
import { createStage } from "./stage.js";
import { createFileHead, describeError, dropAgain, forServer, layout, withOption } from "./view.js";

/** @typedef {import("./store.js").Section} Section */
/** @typedef {{file: string, kind: string, name: string, part: any}} OpenPart */

const PRODUCT = "fill";
const PATTERN = "gyroid"; // the default of fill
// What the page decides itself: files come and go through it.
const HIDDEN = ["as", "for", "units", "max_triangles"];
const SURFACES = { part: "Shell", infill: "Infill", solid: "Part with infill" };
const SHELL = "part"; // name of the surface around an infill
const COLOURS = { part: "#b4c0c8", solid: "#b4c0c8", infill: "#e0973f" };
const UNSEEN = 1000; // ms after which a picture is not waited for
const GHOST = 0.25; // opacity of a shell that is seen through

/**
 * Make the view.
 * @param {import("./view.js").Studio} studio
 */
export function createPartView(studio) {
  const { server, about, patterns, store } = studio;
  /** @type {OpenPart|null} */
  let open = null;
  /** @type {Section} */
  let section = store.state.part;
  let asked = "";
  /** @type {any} */
  let answer = null;

  const head = createFileHead({
    accept: ".stl,.3mf,.obj,.off,.ply,.glb",
    title: "Open another part",
    open: studio.open,
  });
  const picture = h("div", { class: "viewer" });
  const stage = createStage({ pictures: [picture], onCancel: () => live.stop(), onResume: () => live.resume() });
  const viewer = createViewer(picture, {
    label: "The part",
    reducedMotion: matchMedia("(prefers-reduced-motion: reduce)").matches,
  });
  followTheme((theme) => viewer.setTheme(theme));
  const cut = createCut({ onChange: (value, resting) => change({ ...section, cut: value }, resting) });
  const densityPaint = createDensityPaint({ viewer });
  const surfaces = h("div", { class: "surfaces", role: "group", "aria-label": "What is shown" });
  const numbers = createNumbers();
  const again = createAgain();
  const downloads = createDownloads({ server, slicers: about.slicers });

  const pattern = createPatternChoice({
    patterns,
    product: PRODUCT,
    onChoose: (name) =>
      change(
        {
          ...section,
          options: {
            ...withOption(withOption(section.options, "set", null), "pattern", name === PATTERN ? null : name),
          },
        },
        true,
      ),
    onTile: studio.open,
  });
  const density = createDensity({
    start: 20,
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
  const wall = option("wall", slider, {
    label: "Shell",
    unit: "mm",
    least: 0,
    most: 5,
    step: 0.1,
    auto: "1.2 mm",
    start: 1.2,
  });
  const cell = option("cell", slider, {
    label: "Cell size",
    unit: "mm",
    least: 2,
    most: 30,
    step: 0.5,
    auto: "from the density",
    start: 8,
  });
  const radius = option("smooth_radius", slider, {
    label: "Rounding",
    unit: "mm",
    least: 0,
    most: 1.5,
    step: 0.05,
    auto: "0.25 mm",
    start: 0.25,
    help: "Radius of the fillets where walls meet.",
  });
  const sides = option("open", choices, {
    label: "Open sides",
    choices: [
      { value: "", text: "None" },
      { value: "top", text: "Top" },
      { value: "bottom", text: "Bottom" },
      { value: "both", text: "Both" },
    ],
  });
  const drain = option("drain", slider, {
    label: "Drain holes",
    unit: "mm",
    least: 1,
    most: 8,
    step: 0.25,
    auto: "No drain holes",
    autoWord: "none",
    start: 3,
    help: "For resin and powder: one hole at the bottom of every closed void.",
  });
  const vent = option("vent", tick, { label: "Also holes for air at the top" });
  const form = createForm({
    options: about.products[PRODUCT] ?? [],
    main: [
      { keys: ["pattern"], control: pattern },
      { keys: ["density", "by"], control: density },
      { keys: ["wall"], control: wall },
      { keys: ["cell"], control: cell },
      { keys: ["smooth_radius"], control: radius },
      { keys: ["open"], control: sides },
      { keys: ["drain", "drain_at"], control: drain },
      { keys: ["vent"], control: vent },
    ],
    hidden: HIDDEN,
    onChange: (key, value, resting) =>
      change({ ...section, options: withOption(section.options, key, value) }, resting),
  });
  const material = select({
    label: "Material",
    choices: [
      { value: "", text: "no weight" },
      ...about.materials.map(({ name, density: heavy }) => ({ value: name, text: `${name} (${heavy} g/cm³)` })),
    ],
    onChange: (value) => change({ ...section, material: value }, true),
  });

  const live = createLive({
    ask: (quality, signal) =>
      server.ask(
        { product: PRODUCT, file: open?.file ?? null, options: forServer(section.options), quality },
        { signal, onProgress: (progress) => stage.progress(progress) },
      ),
    show: (reply, quality) => {
      form.fail(null);
      stage.fail(null);
      answer = reply.answer;
      const drawn = reply.mesh ? showMesh(reply.mesh, quality === "coarse") : undefined;
      showNumbers();
      again.show(answer);
      numbers.setStale(quality === "coarse");
      stage.badge(quality === "coarse" ? "Preview" : null);
      if (quality === "exact") {
        downloads.show(answer);
        announce(
          `Exact result. ${answer.numbers
            .slice(0, 2)
            .map((/** @type {any} */ row) => `${row.name} ${valueText(row)}`)
            .join(", ")}`,
        );
      }
      return drawn;
    },
    fail: (error) => {
      const stated = describeError(error);
      if (!stated) return;
      form.fail(stated.message, stated.parameter);
      if (!stated.parameter) stage.badge(null);
      numbers.setStale(true);
      downloads.show(null);
    },
    busy: (state) => stage.busy(state, "Computing the exact result"),
  });

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
      onChange: (/** @type {any} */ value, /** @type {boolean} */ resting) =>
        change(
          { ...section, options: withOption(section.options, key, value === "" || value === false ? null : value) },
          resting,
        ),
    });
  }

  /**
   * @param {Section} next
   * @param {boolean} resting
   */
  function change(next, resting) {
    store.replace({ ...store.state, part: next }, { rest: resting, cause: resting ? "rest" : "move" });
  }

  /** @type {Record<string, boolean>} */
  const hiddenSurfaces = {};
  let isGhost = false;

  /**
   * @param {ArrayBuffer} bytes
   * @param {boolean} flat
   */
  function showMesh(bytes, flat) {
    const mesh = decodeMesh(bytes);
    // Skin and voids bound the walls together: a cut goes through both.
    for (const surface of mesh.surfaces) surface.solid = SHELL;
    viewer.setMesh(mesh, { flat });
    const names = mesh.surfaces.map(({ name }) => name);
    for (const name of names) viewer.setColour(name, COLOURS[/** @type {"part"} */ (name)] ?? COLOURS.part);
    densityPaint.show(
      answer?.painted ?? null,
      mesh.surfaces.filter(({ values }) => values).map(({ name }) => name),
    );
    surfaces.replaceChildren();
    if (names.length > 1) for (const name of names) surfaces.append(surfaceTick(name));
    if (names.length > 1 && names.includes(SHELL)) surfaces.append(ghostTick());
    for (const name of names) viewer.setVisible(name, names.length === 1 || !hiddenSurfaces[name]);
    if (names.length > 1 && names.includes(SHELL)) viewer.setOpacity(SHELL, isGhost ? GHOST : 1);
    viewer.setCut(cut.plane);
    // For those who measure the page: when the picture of a mesh has been drawn.
    const drawn = viewer.frame().then(() => void performance.mark("picture"));
    // A page that nobody looks at draws nothing.
    return Promise.race([drawn, new Promise((resolve) => setTimeout(resolve, UNSEEN))]);
  }

  /** @param {string} name */
  function surfaceTick(name) {
    const input = h("input", {
      type: "checkbox",
      checked: !hiddenSurfaces[name],
      onchange: () => {
        hiddenSurfaces[name] = !input.checked;
        viewer.setVisible(name, input.checked);
      },
    });
    return h("label", { class: "tick" }, input, h("span", {}, SURFACES[/** @type {"part"} */ (name)] ?? name));
  }

  function ghostTick() {
    const input = h("input", {
      type: "checkbox",
      checked: isGhost,
      onchange: () => {
        isGhost = input.checked;
        viewer.setOpacity(SHELL, isGhost ? GHOST : 1);
      },
    });
    return h("label", { class: "tick" }, input, h("span", {}, "See through the shell"));
  }

  function showNumbers() {
    if (!answer) return;
    const rows = [...answer.numbers];
    const weight = answer.grams?.[section.material];
    if (weight) {
      const after = rows.findIndex(({ name }) => name === "volume");
      rows.splice(after + 1, 0, {
        name: "weight",
        value: weight,
        unit: "g",
        help: `Of this volume in ${section.material}.`,
      });
    }
    numbers.show(rows, answer.warnings ?? []);
  }

  const empty = h("div", { class: "empty", hidden: true });
  const stageElement = stage.element;
  stageElement.append(empty);

  return {
    element: layout({
      label: "Part",
      controls: [head.element, form.element],
      stage: [stageElement, h("div", { class: "toolbar" }, cut.element, surfaces, densityPaint.element)],
      side: [numbers.element, material.element, downloads.element, again.element],
    }),
    /** Show a part that has been read. */
    /**
     * @param {OpenPart} file
     * @param {ArrayBuffer|null} mesh
     */
    opened(file, mesh) {
      open = file;
      asked = "";
      answer = null;
      empty.hidden = true;
      const { low, high } = boundsOf(file.part.bounds);
      const { volume, triangles } = file.part;
      const size = `${low.map((value, i) => plain(high[i] - value)).join(" × ")} mm`;
      head.show(file.name, size, `${plain(volume)} mm³ · ${plain(triangles)} triangles`);
      cut.setBounds({ low, high });
      if (mesh) showMesh(mesh, false);
      viewer.fit();
      stage.fail(null);
      form.fail(null);
      downloads.show(null);
      this.update(store.state.part, "jump");
    },
    /**
     * Follow the state.
     * @param {Section} next
     * @param {string} cause
     */
    update(next, cause) {
      section = next;
      const { options } = section;
      const name = options.pattern ?? PATTERN;
      pattern.set(name);
      density.set(options);
      for (const [key, control] of Object.entries({ wall, cell, smooth_radius: radius, drain }))
        control.set(options[key] ?? null);
      sides.set(options.open ?? "");
      vent.set(options.vent);
      vent.element.hidden = !options.drain;
      form.set(options);
      cut.set(section.cut);
      viewer.setCut(cut.plane);
      material.set(section.material);
      showNumbers();
      if (!open) {
        const waits = section.source?.name && !section.source.sample;
        empty.hidden = !waits;
        empty.textContent = waits ? dropAgain(section.source?.name ?? "") : "";
        return;
      }
      const wanted = JSON.stringify(options);
      if (wanted === asked) return;
      const isNew = asked.split('"pattern"')[1]?.split(",")[0] !== wanted.split('"pattern"')[1]?.split(",")[0];
      asked = wanted;
      if (isNew || cause === "history" || cause === "jump")
        showOwnParameters(
          form.own,
          patterns.find((one) => one.name === name),
          options.set ?? {},
          ["cell", "line_width", "density", "angle", "seed", "phase"],
          (key, value) =>
            change(
              { ...section, options: { ...section.options, set: withOption(section.options.set ?? {}, key, value) } },
              true,
            ),
        );
      downloads.show(null);
      numbers.setStale(true);
      if (cause === "move") live.move();
      else live.jump();
    },
    hold: () => live.hold(),
    go: () => live.go(),
    viewer,
  };
}

/**
 * Both corners of a box, however it is written.
 * @param {any} bounds
 * @returns {{low: number[], high: number[]}}
 */
export function boundsOf(bounds) {
  if (Array.isArray(bounds) && bounds.length === 6) return { low: bounds.slice(0, 3), high: bounds.slice(3) };
  if (Array.isArray(bounds)) return { low: bounds[0], high: bounds[1] };
  return bounds;
}
