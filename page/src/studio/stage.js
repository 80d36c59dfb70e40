/**
 * The stage: where pictures stand, with what is under way, whether a picture is coarse, and errors of its own.
 */

import { capital, h, replaceChildren } from "./dom.js";

const STAGES_SHOWN_AFTER = 250; // ms, so that quick answers do not flicker

/**
 * Make a stage.
 * @param {...Node} pictures
 */
export function createStage(...pictures) {
  const bar = h("div", { class: "progress", hidden: true }, h("span", {}));
  const words = h("p", { class: "stage-words", hidden: true });
  const badge = h("p", { class: "badge", hidden: true });
  const message = h("div", { class: "stage-message", role: "alert", hidden: true });
  let timer = 0;

  return {
    element: h("div", { class: "stage" }, ...pictures, bar, h("div", { class: "stage-foot" }, badge, words), message),
    /**
     * Show how far the work is; null where there is none.
     * @param {{stage: string, share: number}|null} progress
     */
    progress(progress) {
      if (!progress) {
        clearTimeout(timer);
        timer = 0;
        bar.hidden = words.hidden = true;
        return;
      }
      const share = Math.min(1, Math.max(0.02, progress.share || 0));
      /** @type {HTMLElement} */ (bar.firstElementChild).style.transform = `scaleX(${share})`;
      words.textContent = capital(progress.stage);
      if (timer && !bar.hidden) words.hidden = !progress.stage;
      if (!timer)
        timer = window.setTimeout(() => {
          bar.hidden = false;
          words.hidden = !words.textContent;
        }, STAGES_SHOWN_AFTER);
    },
    /** @param {string|null} text such as "Preview" */
    badge(text) {
      badge.hidden = !text;
      badge.textContent = text ?? "";
    },
    /** @param {string|null} text an error that is about no control */
    fail(text) {
      message.hidden = !text;
      replaceChildren(message, text ? h("p", {}, text) : null);
    },
  };
}
