/** What a page lets one change about prints: how many layers are shown. */

/** @typedef {ReturnType<typeof import("./viewer.js").createViewer>} View */

/**
 * Show a print, and connect the controls of the page.
 *
 * @param {View[]} _viewers All of the page.
 * @param {number} _number Of the view that shows this print.
 * @param {ArrayBuffer} _data
 */
export function showPrint(_viewers, _number, _data) {}
