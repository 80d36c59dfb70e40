/**
 * How to do it again: the command, the Python and the config file of an answer, each copied with one click; and files.
 */

import { announce, freshId, h, icon, replaceChildren } from "./dom.js";
import { readRefusal } from "./server.js";
import { describeError } from "./view.js";

const SLOW = 300; // ms after which a link says that its file is being made
const KEPT = 60_000; // ms for the browser to take a file over

const FORMS = [
  { key: "command", title: "Command" },
  { key: "python", title: "Python" },
  { key: "toml", title: "TOML" },
];
const FILES = {
  stl: "STL",
  "3mf": "3MF",
  ply: "PLY",
  glb: "GLB",
  obj: "OBJ",
  zip: "STL each",
  gcode: "G-code",
  bgcode: "Binary G-code",
  project: "Project",
};
const SLICERS = {
  prusaslicer: "PrusaSlicer",
  orcaslicer: "OrcaSlicer",
  bambustudio: "Bambu Studio",
  cura: "Cura",
  plain: "another slicer (two plain objects)",
};

/** The panel with the ways to do it again. */
export function createAgain() {
  /** @type {Record<string, string>} */
  let texts = {};
  let chosen = FORMS[0].key;
  const name = freshId("again");
  const code = h("code", {});
  const copy = h(
    "button",
    { type: "button", class: "quiet copy", onclick: () => copyText(texts[chosen] ?? "", copy) },
    icon("copy"),
    h("span", {}, "Copy"),
  );
  const tabs = h(
    "fieldset",
    { class: "segments small" },
    h("legend", { class: "hidden-text" }, "Form"),
    ...FORMS.map(({ key, title }, i) =>
      h(
        "label",
        {},
        h("input", { type: "radio", name, checked: i === 0, onchange: () => choose(key) }),
        h("span", {}, title),
      ),
    ),
  );
  const text = h("pre", { tabIndex: 0, role: "region", "aria-label": "How to do this again" }, code);
  const element = h(
    "section",
    { class: "again", hidden: true },
    h("div", { class: "again-head" }, h("h2", {}, "Do it again"), copy),
    tabs,
    text,
  );

  /** @param {string} key */
  function choose(key) {
    chosen = key;
    code.textContent = texts[key] ?? "";
  }
  return {
    element,
    /** @param {Record<string, string>} answer */
    show(answer) {
      texts = answer;
      element.hidden = !FORMS.some(({ key }) => answer[key]);
      choose(chosen);
    },
  };
}

/**
 * Copy a text, and say so on the button.
 * @param {string} text
 * @param {HTMLElement} button
 */
export async function copyText(text, button) {
  const words = button.querySelector("span");
  const before = words?.textContent ?? "";
  try {
    await navigator.clipboard.writeText(text);
    if (words) words.textContent = "Copied";
    announce("Copied");
  } catch {
    if (words) words.textContent = "Select and copy by hand";
  }
  setTimeout(() => {
    if (words) words.textContent = before;
  }, 1500);
}

/**
 * The panel of files to save.
 * @param {{server: import("./server.js").Server, slicers: string[]}} what
 */
export function createDownloads({ server, slicers }) {
  const list = h("div", { class: "downloads" });
  const waiting = h("p", { class: "field-help" }, "The files to save appear here when the exact result is ready.");
  const slicer = h(
    "select",
    { "aria-label": "Slicer of the project", onchange: () => refresh() },
    ...slicers.map((value) => h("option", { value }, SLICERS[/** @type {"cura"} */ (value)] ?? value)),
  );
  /** @type {{result: string, downloads: string[]}|null} */
  let current = null;

  function refresh() {
    waiting.hidden = Boolean(current);
    if (!current) return replaceChildren(list);
    const { result, downloads } = current;
    const plainFiles = downloads.filter((format) => format !== "project");
    replaceChildren(
      list,
      h(
        "div",
        { class: "save-row" },
        plainFiles.map((format, i) =>
          save(
            server.download(result, { format }),
            FILES[/** @type {"stl"} */ (format)] ?? format,
            i === 0 && !downloads.includes("project"),
          ),
        ),
      ),
      downloads.includes("project") && slicers.length
        ? h(
            "div",
            { class: "save-project" },
            h("label", {}, h("span", {}, "Project for"), slicer),
            save(server.download(result, { format: "project", slicer: slicer.value }), "Project (3MF)", true),
          )
        : null,
    );
  }

  return {
    element: h("section", { class: "save" }, h("h2", {}, "Save"), waiting, list),
    /** @param {{result: string|null, downloads?: string[]}|null} answer null while none is exact */
    show(answer) {
      current = answer?.result ? { result: answer.result, downloads: answer.downloads ?? [] } : null;
      refresh();
    },
  };
}

/**
 * A link to a file. While the file is made, which may take a while, the link says so; an error stands below it.
 * @param {string} address
 * @param {string} text
 * @param {boolean} isMain
 */
function save(address, text, isMain) {
  const words = h("span", {}, text);
  const link = h("a", { class: isMain ? "button main" : "button", href: address, download: "" }, icon("save"), words);
  link.addEventListener("click", async (event) => {
    if (event.ctrlKey || event.metaKey || event.shiftKey) return;
    event.preventDefault();
    if (link.getAttribute("aria-busy") === "true") return;
    const panel = link.closest(".save");
    panel?.querySelector(".field-error")?.remove();
    link.setAttribute("aria-busy", "true");
    const slow = setTimeout(() => {
      words.textContent = "Preparing";
      announce(`Preparing ${text}`);
    }, SLOW);
    try {
      await fetchFile(address);
    } catch (error) {
      panel?.append(
        h("p", { class: "field-error", role: "alert" }, describeError(error)?.message ?? "The file was not saved."),
      );
    }
    clearTimeout(slow);
    words.textContent = text;
    link.removeAttribute("aria-busy");
  });
  return link;
}

/**
 * Fetch a file, and hand it to the browser under the name that the server has for it.
 * @param {string} address
 */
async function fetchFile(address) {
  const response = await fetch(address);
  if (!response.ok) throw await readRefusal(response);
  const [, name] = /filename\*=UTF-8''([^;]+)/.exec(response.headers.get("content-disposition") ?? "") ?? [];
  const url = URL.createObjectURL(await response.blob());
  h("a", { href: url, download: decodeURIComponent(name ?? "result") }).click();
  setTimeout(() => URL.revokeObjectURL(url), KEPT);
}
