/**
 * Answers while a hand moves: coarse ones as fast as they come, the exact one when it rests.
 *
 * One request is under way at a time. A coarse one that is under way while the values change is let finish, so that
 * a long pull shows pictures all along, and the newest values follow at once. An exact one is dropped at any change, and
 * by `stop`, after which nothing is asked for until the next change, or `resume`.
 */

import { isAbort } from "./server.js";

const REST = 350; // ms after the last picture, without a change, until the exact answer is asked for

/** @typedef {"coarse"|"exact"|"stopped"|null} LiveState what is under way; "stopped" where the exact answer was cancelled */
/**
 * @typedef {object} Work
 * @property {(quality: "coarse"|"exact", signal: AbortSignal) => Promise<any>} ask
 * @property {(reply: any, quality: "coarse"|"exact") => Promise<void>|void} show resolves when it has been drawn
 * @property {(error: unknown) => void} fail
 * @property {(state: LiveState) => void} busy
 * @property {boolean} [drafts] whether there are coarse answers
 */

/**
 * Make the runner of one view.
 * @param {Work} work
 */
export function createLive({ ask, show, fail, busy, drafts = true }) {
  /** @type {{quality: "coarse"|"exact", control: AbortController}|null} */
  let running = null;
  let wantsCoarse = false;
  let wantsExact = false;
  let isMoving = false;
  let isHeld = false;
  let isStopped = false;
  let timer = 0;

  function next() {
    if (running || isHeld) return;
    if (wantsCoarse) run("coarse");
    else if (wantsExact) run("exact");
    else busy(isStopped ? "stopped" : null);
  }

  /** Ask for the exact answer in a while, if nothing changes until then. */
  function waitForRest() {
    timer = window.setTimeout(() => {
      timer = 0;
      wantsExact = true;
      next();
    }, REST);
  }

  /** @param {"coarse"|"exact"} quality */
  async function run(quality) {
    const control = new AbortController();
    const mine = { quality, control };
    running = mine;
    isStopped = false;
    if (quality === "coarse") wantsCoarse = false;
    else wantsExact = false;
    busy(quality);
    try {
      const reply = await ask(quality, control.signal);
      // What follows waits until the picture is there, which needs the processor, too.
      if (!control.signal.aborted) await show(reply, quality);
    } catch (error) {
      if (!isAbort(error) && !control.signal.aborted) {
        // A coarse answer may fail where the exact one does not: the exact one has the word.
        if (quality === "exact") fail(error);
      }
    }
    if (running !== mine) return;
    running = null;
    if (quality === "coarse" && isMoving && !wantsCoarse) waitForRest();
    next();
  }

  function drop() {
    running?.control.abort();
    running = null;
  }

  function forget() {
    clearTimeout(timer);
    timer = 0;
    isMoving = false;
    isStopped = false;
    wantsExact = false;
  }

  return {
    /** The values change under a moving hand. */
    move() {
      forget();
      isMoving = true;
      wantsCoarse = drafts;
      if (running?.quality === "exact") drop();
      if (!drafts) waitForRest();
      next();
    },
    /** The values jump: whatever is under way is for values of before. */
    jump() {
      forget();
      drop();
      wantsCoarse = drafts;
      wantsExact = true;
      next();
    },
    /** Cancel the exact answer that is under way: closing its connection ends its work on the server. */
    stop() {
      if (running?.quality !== "exact") return;
      forget();
      drop();
      isStopped = true;
      next();
    },
    /** Ask again for the exact answer that was cancelled. */
    resume() {
      wantsExact = true;
      next();
    },
    /** Let go of the processor, which a file that is being read needs, until `go`. */
    hold() {
      if (isHeld) return;
      isHeld = true;
      if (running?.quality === "exact") wantsExact = true;
      else if (running) wantsCoarse = true;
      drop();
      busy(null);
    },
    /** Go on with what is still wanted. */
    go() {
      if (!isHeld) return;
      isHeld = false;
      next();
    },
  };
}
