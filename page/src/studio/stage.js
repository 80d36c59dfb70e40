/**
 * The stage: where pictures stand, with what is under way, whether a picture is coarse, and errors of its own.
 */

import { announce, capital, h, replaceChildren } from "./dom.js";

const AGAIN = "Compute the exact result";
const STAGES_SHOWN_AFTER = 250; // ms, so that quick answers do not flicker

/**
 * Make a stage.
 * @param {{pictures: Node[], onCancel: () => void, onResume: () => void}} what `onCancel` stops the exact answer, and
 *   `onResume` asks for it again
 */
export function createStage({ pictures, onCancel, onResume }) {
  const bar = h("div", { class: "progress", hidden: true }, h("span", {}));
  const words = h("p", { class: "stage-words", hidden: true });
  const badge = h("p", { class: "badge", hidden: true });
  const message = h("div", { class: "stage-message", role: "alert", hidden: true });
  // One button for both, so that it keeps the focus of the keyboard.
  const cancel = h("button", {
    type: "button",
    class: "button small cancel",
    hidden: true,
    onclick: (/** @type {MouseEvent} */ event) => {
      if (event.detail > 1) return; // the second click of two would take the first one back
      if (isStopped) onResume();
      else onCancel();
    },
  });
  let isStopped = false;
  let timer = 0;

  /** @param {{stage: string, share: number}|null} progress */
  function showProgress(progress) {
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
  }

  return {
    element: h(
      "div",
      { class: "stage" },
      ...pictures,
      bar,
      h("div", { class: "stage-foot" }, badge, words, cancel),
      message,
    ),
    /** Show how far the work is. */
    progress: showProgress,
    /**
     * Show what is under way, and the button that stops an exact answer or asks for it again.
     * @param {import("./live.js").LiveState} state
     * @param {string} exact what the exact answer is, such as "Refilling the whole print"
     */
    busy(state, exact) {
      if (state === "stopped" && !isStopped) announce("Cancelled");
      isStopped = state === "stopped";
      cancel.textContent = isStopped ? AGAIN : "Cancel";
      cancel.hidden = state !== "exact" && !isStopped;
      const isWorking = state === "exact" || state === "coarse";
      showProgress(isWorking ? { stage: state === "exact" ? exact : "", share: 0 } : null);
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
