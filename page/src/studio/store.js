/**
 * The state of the page: what is open and how it is set. It can be undone, and written into a link.
 *
 * The state is a plain value that is never changed, only replaced: undo is the value before. The link holds the open
 * view with its source and its options; a file of the user's is known by its name alone and has to be dropped again.
 */

/** @typedef {"start"|"patterns"|"part"|"print"|"scan"|"block"} ViewName */
/** @typedef {{sample?: string, given?: boolean, name?: string}} Source */
/** @typedef {{source: Source|null, options: Record<string, any>, [key: string]: any}} Section */
/** @typedef {{view: ViewName, part: Section, print: Section, scan: Section, block: Section}} State */

export const VIEWS = /** @type {const} */ (["start", "patterns", "part", "print", "scan", "block"]);
const SECTIONS = ["part", "print", "scan", "block"];
const MOST_UNDONE = 200;

/** @type {State} */
const EMPTY = {
  view: "start",
  part: { source: null, options: {}, cut: { axis: "y", share: 0.5 }, material: "" },
  print: { source: null, options: {}, layer: null },
  scan: { source: null, options: {}, cut: { axis: "none", share: 0.5 }, places: {} },
  block: { source: null, options: {}, cut: { axis: "none", share: 0.5 } },
};

/**
 * Read a state from the fragment of a link; the rest is as in an empty page.
 * @param {string} fragment
 * @returns {State}
 */
export function readFragment(fragment) {
  const [word, query] = fragment.replace(/^#/, "").split("?");
  const view = /** @type {ViewName} */ (VIEWS.find((name) => name === word) ?? "start");
  if (!SECTIONS.includes(view)) return { ...EMPTY, view };
  /** @type {Section} */
  const section = { ...EMPTY[/** @type {"part"} */ (view)], options: {} };
  for (const [key, text] of new URLSearchParams(query ?? "")) {
    if (key === "sample") section.source = { sample: text };
    else if (key === "given") section.source = { given: true };
    else if (key === "file") section.source = { name: text };
    else if (key === "cut") section.cut = { axis: text.split(",")[0], share: Number(text.split(",")[1]) };
    else if (key === "layer") section.layer = Number(text);
    else if (key === "material") section.material = text;
    else if (key.startsWith("set.")) section.options.set = { ...section.options.set, [key.slice(4)]: readValue(text) };
    else section.options[key] = readValue(text);
  }
  return { ...EMPTY, view, [view]: section };
}

/**
 * Write the open view as the fragment of a link.
 * @param {State} state
 */
export function writeFragment(state) {
  if (!SECTIONS.includes(state.view)) return `#${state.view}`;
  const section = state[/** @type {"part"} */ (state.view)];
  const words = new URLSearchParams();
  if (section.source?.sample) words.set("sample", section.source.sample);
  else if (section.source?.given) words.set("given", "1");
  else if (section.source?.name) words.set("file", section.source.name);
  for (const [key, value] of Object.entries(section.options)) {
    if (key === "set") for (const [name, own] of Object.entries(value)) words.set(`set.${name}`, JSON.stringify(own));
    else if (isFile(value))
      continue; // an upload, which ends with its page
    else words.set(key, typeof value === "string" && !looksLikeValue(value) ? value : JSON.stringify(value));
  }
  if (section.cut) words.set("cut", `${section.cut.axis},${Number(section.cut.share.toFixed(3))}`);
  if (section.layer != null) words.set("layer", String(section.layer));
  if (section.material) words.set("material", section.material);
  return `#${state.view}?${words.toString().replaceAll("%2C", ",").replaceAll("%3A", ":")}`;
}

/** @param {any} value */
function isFile(value) {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

/** @param {string} text */
function readValue(text) {
  return looksLikeValue(text) ? JSON.parse(text) : text;
}

/** @param {string} text */
function looksLikeValue(text) {
  try {
    JSON.parse(text);
    return true;
  } catch {
    return false;
  }
}

/**
 * Make a store.
 * @param {State} first
 */
export function createStore(first) {
  let state = first;
  let settled = first; // the state that undo leaves
  /** @type {State[]} */
  const before = [];
  /** @type {State[]} */
  let after = [];
  /** @type {((state: State, cause: string) => void)[]} */
  const listeners = [];

  /** @param {string} cause */
  function publish(cause) {
    for (const listener of listeners) listener(state, cause);
  }

  /**
   * Go to another state of the history.
   * @param {State[]} from
   * @param {State[]} to
   */
  function step(from, to) {
    const earlier = from.pop();
    if (!earlier) return;
    to.push(settled);
    // Files stay open: only what was set is undone.
    const next = { ...earlier };
    for (const name of SECTIONS)
      next[/** @type {"part"} */ (name)] = {
        ...earlier[/** @type {"part"} */ (name)],
        source: settled[/** @type {"part"} */ (name)].source,
      };
    state = next;
    settled = next;
    publish("history");
  }

  return {
    get state() {
      return state;
    },
    get canUndo() {
      return before.length > 0;
    },
    get canRedo() {
      return after.length > 0;
    },
    /** @param {(state: State, cause: string) => void} listener */
    subscribe(listener) {
      listeners.push(listener);
    },
    /**
     * Replace the state.
     *
     * `rest` says that a hand has come to rest, so that undo leads back here; `record: false` that this is no change to
     * undo, such as another view or file.
     * @param {State} next
     * @param {{rest?: boolean, record?: boolean, cause?: string}} [how]
     */
    replace(next, { rest = true, record = true, cause = "change" } = {}) {
      state = next;
      if (!record) settled = next;
      else if (rest && writeFragment(next) !== writeFragment(settled)) {
        before.push(settled);
        if (before.length > MOST_UNDONE) before.shift();
        after = [];
        settled = next;
      }
      publish(cause);
    },
    undo: () => step(before, after),
    redo: () => step(after, before),
  };
}

/** @typedef {ReturnType<typeof createStore>} Store */
