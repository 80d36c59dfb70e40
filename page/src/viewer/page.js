/** The page that `infill.viewer.page` writes: views of the data that are in it, and what one can change about them. */

import { decodeMesh } from "./mesh.js";
import { decodePrint, showPrints } from "./print.js";
import { showSurfaces } from "./surfaces.js";
import { createViewer } from "./viewer.js";

/**
 * Read data from the page: base64 of bytes that were deflated.
 *
 * @param {string} id
 */
async function readData(id) {
  const text = /** @type {HTMLElement} */ (document.getElementById(id)).textContent ?? "";
  const packed = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(stream).arrayBuffer();
}

async function start() {
  const views = [.../** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll(".view"))];
  const settings = JSON.parse(document.getElementById("settings")?.textContent ?? "{}");
  const viewers = views.map((view) => createViewer(view, { label: view.dataset.label }));
  followTheme(viewers);
  for (const viewer of viewers) {
    viewer.onCamera((camera) => {
      for (const other of viewers) if (other !== viewer) other.setCamera(camera);
    });
  }
  for (const button of document.querySelectorAll("button[data-side]")) {
    button.addEventListener("click", () => {
      for (const viewer of viewers) viewer.lookFrom(/** @type {HTMLElement} */ (button).dataset.side ?? "corner");
    });
  }
  const data = await Promise.all(views.map((view) => readData(view.dataset.source ?? "")));
  if (settings.kind === "print") showPrints(viewers, data.map(decodePrint));
  else showSurfaces(viewers[0], decodeMesh(data[0]), settings);
  await Promise.all(viewers.map((viewer) => viewer.frame()));
  Object.assign(globalThis, { viewers });
  document.documentElement.dataset.ready = "";
}

/**
 * Keep the light of the views as that of the page.
 *
 * @param {ReturnType<typeof createViewer>[]} viewers
 */
function followTheme(viewers) {
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const set = () => {
    for (const viewer of viewers) viewer.setTheme(dark.matches ? "dark" : "light");
  };
  dark.addEventListener("change", set);
  set();
}

start().catch((error) => {
  const message = document.querySelector(".message");
  if (message) {
    message.textContent = `The picture cannot be shown: ${error.message}`;
    /** @type {HTMLElement} */ (message).hidden = false;
  }
});
