/**
 * The studio's page: it opens a page on the server, shows one view at a time, and follows the state.
 */

import { copyText } from "./again.js";
import { createBlockView } from "./block.js";
import { announce, h, icon, replaceChildren } from "./dom.js";
import { createGallery } from "./gallery.js";
import { createPartView } from "./part.js";
import { createPrintView } from "./print.js";
import { createScanView } from "./scan.js";
import { isAbort, Server } from "./server.js";
import { createStartView } from "./start.js";
import { createStore, readFragment, writeFragment } from "./store.js";
import { describeError, withOption } from "./view.js";

/** @typedef {import("./store.js").State} State */
/** @typedef {import("./store.js").Source} Source */
/** @typedef {import("./store.js").ViewName} ViewName */

const TABS = /** @type {const} */ ([
  ["part", "Part"],
  ["print", "Print"],
  ["scan", "Scan"],
  ["block", "Block"],
  ["patterns", "Patterns"],
]);
const MAKERS = { part: createPartView, print: createPrintView, scan: createScanView, block: createBlockView };
const NEEDS_FILE = ["part", "print", "scan"];
// What a sample is best seen with.
const SAMPLES = { part: {}, print: {}, scan: { threshold: 226 } };

async function begin() {
  const main = /** @type {HTMLElement} */ (document.getElementById("main"));
  const bar = /** @type {HTMLElement} */ (document.getElementById("bar"));
  const server = new Server();
  const opening = server.open(() =>
    showNotice(main, "The studio has stopped. Start it again in the terminal, then open the address that it prints."),
  );
  const [about, patterns] = await Promise.all([server.about(), server.patterns(), opening]);
  const store = createStore(readFragment(location.hash));
  /** @type {Partial<Record<"part"|"print"|"scan"|"block", any>>} */
  const views = {};
  /** @type {Partial<Record<ViewName, HTMLElement>>} */
  const elements = {};
  /** @type {AbortController|null} */
  let loading = null;

  const studio = {
    server,
    about,
    patterns,
    store,
    /** @param {File} file */
    open: (file) => load(file, { name: file.name }),
    /** @param {string} sample */
    openSample: (sample) => load({ sample }, { sample }, /** @type {"part"|"print"|"scan"} */ (sample)),
  };

  const start = createStartView(studio, { choosePattern, showGallery: () => go("patterns") });
  const gallery = createGallery({ patterns, onChoose: ({ name }) => choosePattern(name), onTile: studio.open });
  elements.start = start.element;
  elements.patterns = h(
    "div",
    { class: "page" },
    h("h1", {}, "Patterns"),
    h("p", { class: "lead" }, "Every pattern at 20 % in a cube, cut open. Choose one to fill a part with it."),
    gallery.element,
  );

  const links = TABS.map(([name, text]) => h("a", { href: `#${name}`, onclick: followLink(name) }, text));
  const undo = h(
    "button",
    { type: "button", class: "quiet", title: "Undo (Ctrl+Z)", "aria-label": "Undo", onclick: () => store.undo() },
    icon("undo"),
  );
  const redo = h(
    "button",
    { type: "button", class: "quiet", title: "Redo (Ctrl+Shift+Z)", "aria-label": "Redo", onclick: () => store.redo() },
    icon("redo"),
  );
  const link = h(
    "button",
    {
      type: "button",
      class: "quiet wide",
      title: "Copy a link that leads back here",
      onclick: () => copyText(location.href, link),
    },
    icon("link"),
    h("span", {}, "Copy link"),
  );
  replaceChildren(
    bar,
    h(
      "a",
      {
        class: "brand",
        href: "#start",
        onclick: followLink("start"),
      },
      icon("pattern"),
      "infill studio",
    ),
    h("nav", { "aria-label": "Views" }, ...links),
    h("div", { class: "tools" }, undo, redo, link),
  );
  const overlay = h("div", { class: "drop-overlay", hidden: true }, h("p", {}, "Drop to open"));
  const notice = h("div", { class: "loading", hidden: true, role: "status" });
  document.body.append(overlay, notice);

  /** @param {ViewName} view */
  function followLink(view) {
    return (/** @type {Event} */ event) => {
      event.preventDefault();
      go(view);
    };
  }

  /** @param {ViewName} view */
  function go(view) {
    store.replace({ ...store.state, view }, { record: false, cause: "view" });
  }

  /** @param {"part"|"print"|"scan"|"block"} name */
  function viewOf(name) {
    views[name] ??= MAKERS[name](studio);
    elements[name] ??= views[name].element;
    return views[name];
  }

  /** @param {string} name */
  function choosePattern(name) {
    const pattern = patterns.find((one) => one.name === name);
    const { state } = store;
    const view = state.print.source && !state.part.source && pattern?.products.includes("refill") ? "print" : "part";
    const section = state[view];
    const options = withOption({ ...section.options, pattern: name }, "set", null);
    store.replace({ ...state, view, [view]: { ...section, options } }, { cause: "view" });
    if (!state[view].source) studio.openSample(view);
  }

  /**
   * Load a file, and go to the view that is for it.
   * @param {File|{sample: string}|{given: true}} file
   * @param {Source} source
   * @param {"part"|"print"|"scan"|null} [wanted]
   */
  async function load(file, source, wanted = null) {
    loading?.abort();
    const control = new AbortController();
    loading = control;
    const name = file instanceof File ? file.name : "the sample";
    showLoading(`Reading ${name}`);
    for (const view of Object.values(views)) view.hold();
    try {
      const { answer, mesh } = await server.load(file, {
        signal: control.signal,
        onProgress: ({ stage }) => showLoading(stage === "read" ? `Reading ${name}` : `Reading ${name}: ${stage}`),
      });
      showLoading(null);
      if (answer.kind === "tile") return useTile(answer);
      if (answer.kind === "field") return useField(answer);
      const { state } = store;
      const view = /** @type {"part"|"print"|"scan"} */ (
        answer.kind === "part" && (state.view === "scan" || wanted === "scan") ? "scan" : answer.kind
      );
      const isSame = JSON.stringify(state[view].source) === JSON.stringify(source);
      // Another file begins with the options that were set, except for what belongs to one scan alone.
      const kept = isSame || view !== "scan" ? state[view].options : {};
      const section = { ...state[view], options: source.sample ? { ...SAMPLES[view], ...kept } : kept };
      const fresh = view === "print" && !isSame ? { ...section, layer: null } : section;
      store.replace({ ...state, view, [view]: { ...fresh, source } }, { record: false, cause: "view" });
      viewOf(view).opened({ ...answer, name: answer.name ?? name }, mesh);
      announce(`${answer.name ?? name} is open.`);
    } catch (error) {
      if (isAbort(error)) return;
      showLoading(describeError(error)?.message ?? null, true);
    } finally {
      if (loading === control) {
        loading = null;
        views[/** @type {"part"} */ (store.state.view)]?.go();
      }
    }
  }

  /** @param {{file: string}} tile */
  function useTile({ file }) {
    const { state } = store;
    const view = state.view === "print" ? "print" : "part";
    store.replace(
      { ...state, view, [view]: { ...state[view], options: { ...state[view].options, pattern: { file } } } },
      { cause: "view" },
    );
    if (!state[view].source) studio.openSample(view);
  }

  /** @param {{file: string}} field */
  function useField({ file }) {
    const { state } = store;
    const view = state.view === "print" ? "print" : "part";
    const { options } = state[view];
    const density = String(options.density ?? "").includes(":") ? options.density : "15%:40%";
    store.replace(
      { ...state, view, [view]: { ...state[view], options: { ...options, density, by: { file } } } },
      { cause: "rest" },
    );
  }

  /**
   * @param {string|null} text
   * @param {boolean} [isError]
   */
  function showLoading(text, isError = false) {
    notice.hidden = !text;
    notice.classList.toggle("is-error", isError);
    notice.setAttribute("role", isError ? "alert" : "status");
    replaceChildren(
      notice,
      text ? h("p", {}, text) : null,
      text && isError
        ? h(
            "button",
            { type: "button", class: "quiet", "aria-label": "Close this message", onclick: () => showLoading(null) },
            icon("close"),
          )
        : null,
    );
  }

  /**
   * @param {State} state
   * @param {string} cause
   */
  function render(state, cause) {
    const { view } = state;
    if (view === "part" || view === "print" || view === "scan" || view === "block") {
      const shown = viewOf(view);
      if (state[view].source || view !== "part") shown.update(state[view], cause);
      if (!loading) shown.go();
    }
    const element =
      NEEDS_FILE.includes(view) && !state[/** @type {"part"} */ (view)].source
        ? emptyView(/** @type {"part"} */ (view))
        : elements[view];
    if (element && main.firstElementChild !== element) {
      main.replaceChildren(element);
      document.body.dataset.view = view;
    }
    for (const [i, [name]] of TABS.entries()) {
      if (name === view) links[i].setAttribute("aria-current", "page");
      else links[i].removeAttribute("aria-current");
    }
    document.title = `${TABS.find(([name]) => name === view)?.[1] ?? "Start"} · infill studio`;
    undo.disabled = !store.canUndo;
    redo.disabled = !store.canRedo;
    link.hidden = !(view in MAKERS);
    const fragment = writeFragment(state);
    if (cause !== "move" && fragment !== location.hash) {
      if (cause === "view") history.pushState(null, "", fragment);
      else history.replaceState(null, "", fragment);
    }
  }

  /** @param {"part"|"print"|"scan"} view */
  function emptyView(view) {
    const words = {
      part: ["A part to fill", "STL, 3MF or OBJ", ".stl,.3mf,.obj,.off,.ply,.glb", "the bracket"],
      print: ["A print to refill", "G-code, bgcode or .gcode.3mf", ".gcode,.bgcode,.gco,.3mf,.g", "the sliced plate"],
      scan: [
        "A scan to smooth",
        "NRRD, NIfTI, a DICOM folder as a zip, or an STL",
        ".nrrd,.nhdr,.nii,.gz,.mha,.mhd,.npz,.npy,.tif,.tiff,.zip,.stl,.ply,.obj",
        "the finger bone",
      ],
    }[view];
    const input = h("input", {
      type: "file",
      class: "hidden-text",
      accept: words[2],
      onchange: () => input.files?.[0] && studio.open(input.files[0]),
    });
    return h(
      "div",
      { class: "start narrow" },
      h("h1", {}, words[0]),
      h(
        "label",
        { class: "drop-zone" },
        input,
        h("span", { class: "drop-icon" }, icon("drop")),
        h("span", { class: "drop-title" }, "Drop a file here, or choose one"),
        h("span", { class: "drop-kinds" }, words[1]),
      ),
      h(
        "p",
        {},
        h(
          "button",
          { type: "button", class: "quiet wide", onclick: () => studio.openSample(view) },
          `Or try ${words[3]}`,
        ),
      ),
    );
  }

  store.subscribe(render);
  addEventListener("popstate", () => {
    const next = readFragment(location.hash);
    const { state } = store;
    // Sections that are not in the link stay as they are.
    const section =
      next.view in MAKERS && location.hash.includes("?")
        ? { [next.view]: next[/** @type {"part"} */ (next.view)] }
        : {};
    store.replace({ ...state, ...section, view: next.view }, { record: false, cause: "popstate" });
  });
  addEventListener("keydown", (event) => {
    const isTyping =
      event.target instanceof HTMLInputElement && ["text", "search", "number"].includes(event.target.type);
    if (!(event.ctrlKey || event.metaKey) || isTyping) return;
    const key = event.key.toLowerCase();
    if (key !== "z" && key !== "y") return;
    event.preventDefault();
    if (key === "y" || event.shiftKey) store.redo();
    else store.undo();
  });
  dropAnywhere(overlay, studio.open);

  render(store.state, "popstate");
  const first = store.state;
  if (first.view in MAKERS) {
    const view = /** @type {"part"} */ (first.view);
    const { source } = first[view];
    if (source?.sample) await load({ sample: source.sample }, source, view);
    else if (source?.given && about.file) await load({ given: true }, source, view);
  } else if (about.file && first.view === "start") await load({ given: true }, { given: true });
}

/**
 * Open files that are dropped on the page.
 * @param {HTMLElement} overlay
 * @param {(file: File) => void} open
 */
function dropAnywhere(overlay, open) {
  let depth = 0;
  const hasFiles = (/** @type {DragEvent} */ event) => event.dataTransfer?.types.includes("Files");
  addEventListener("dragenter", (event) => {
    if (!hasFiles(event)) return;
    depth += 1;
    overlay.hidden = false;
  });
  addEventListener("dragleave", (event) => {
    if (!hasFiles(event)) return;
    depth -= 1;
    overlay.hidden = depth > 0 ? overlay.hidden : true;
  });
  addEventListener("dragover", (event) => event.preventDefault());
  addEventListener("drop", (event) => {
    event.preventDefault();
    depth = 0;
    overlay.hidden = true;
    const file = event.dataTransfer?.files[0];
    if (file) open(file);
  });
}

/**
 * @param {HTMLElement} main
 * @param {string} text
 */
function showNotice(main, text) {
  if (!document.querySelector(".stopped")) main.before(h("p", { class: "stopped", role: "alert" }, text));
}

begin().catch((error) => {
  const main = document.getElementById("main");
  if (main)
    main.replaceChildren(
      h("p", { class: "stopped", role: "alert" }, describeError(error)?.message ?? "The studio could not start."),
    );
});
