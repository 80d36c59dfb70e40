/**
 * Laws of the studio's page that need no browser: `npm test`.
 */

import assert from "node:assert/strict";
import { test } from "node:test";
import { suits } from "../src/studio/gallery.js";
import { decodeLayer, layerBounds } from "../src/studio/layer.js";
import { createLive } from "../src/studio/live.js";
import { outline } from "../src/studio/outline.js";
import { keptPieces, piecesText } from "../src/studio/pieces.js";
import { readFrames } from "../src/studio/server.js";
import { createStore, readFragment, writeFragment } from "../src/studio/store.js";
import { percents } from "../src/studio/view.js";

/** @param {[number, string][]} frames */
function encode(frames) {
  const pieces = frames.flatMap(([kind, text]) => {
    const payload = new TextEncoder().encode(text);
    const head = new DataView(new ArrayBuffer(5));
    head.setUint32(0, payload.length, true);
    head.setUint8(4, kind);
    return [...new Uint8Array(head.buffer), ...payload];
  });
  return Uint8Array.from(pieces);
}

/**
 * @param {Uint8Array} bytes
 * @param {number} size
 */
function streamOf(bytes, size) {
  return new ReadableStream({
    start(controller) {
      for (let at = 0; at < bytes.length; at += size) controller.enqueue(bytes.slice(at, at + size));
      controller.close();
    },
  });
}

test("an exact answer is cancelled, and asked for again", async () => {
  Object.assign(globalThis, { window: globalThis });
  /** @type {(string|null)[]} */
  const states = [];
  /** @type {{quality: string, signal: AbortSignal, answer: (reply: any) => void}[]} */
  const asked = [];
  /** @type {string[]} */
  const shown = [];
  const live = createLive({
    ask: (quality, signal) => new Promise((answer) => asked.push({ quality, signal, answer })),
    show: (_, quality) => void shown.push(quality),
    fail: assert.fail,
    busy: (state) => void states.push(state),
  });
  const settled = () => new Promise((resolve) => setTimeout(resolve));
  live.jump();
  live.stop(); // a draft is not stopped
  asked[0].answer({});
  await settled();
  live.stop();
  asked[1].answer({});
  await settled();
  assert.equal(asked[1].signal.aborted, true);
  assert.deepEqual(shown, ["coarse"]);
  live.hold();
  live.go();
  assert.equal(asked.length, 2);
  assert.equal(states.at(-1), "stopped");
  live.resume();
  asked[2].answer({});
  await settled();
  assert.deepEqual(shown, ["coarse", "exact"]);
  assert.equal(states.at(-1), null);
});

test("frames are the same, wherever the network cuts them", async () => {
  /** @type {[number, string][]} */
  const frames = [
    [1, '{"stage":"read"}'],
    [3, ""],
    [2, "x".repeat(300)],
  ];
  const bytes = encode(frames);
  for (const size of [1, 2, 3, 5, 7, 64, 1000]) {
    const seen = [];
    for await (const { kind, payload } of readFrames(streamOf(bytes, size)))
      seen.push([kind, new TextDecoder().decode(payload)]);
    assert.deepEqual(seen, frames, `in pieces of ${size}`);
  }
});

test("a link restores view, sample, options, cut and layer", () => {
  const links = [
    "#start",
    "#patterns",
    "#part?sample=part&pattern=octet&density=15%25:40%25&by=skin&wall=1.6&vent=true&set.ratio=0.5&cut=z,0.25&material=PETG",
    "#print?sample=print&pattern=gyroid&smooth_radius=1.5&layer=12",
    "#scan?given=1&range=200,900&steps=30&cut=none,0.5",
  ];
  for (const link of links) {
    const state = readFragment(link);
    assert.deepEqual(readFragment(writeFragment(state)), state);
    assert.equal(writeFragment(state), link);
  }
});

test("texts that look like numbers stay texts in a link", () => {
  const state = readFragment("#part");
  const next = {
    ...state,
    part: { ...state.part, options: { density: "20%", pattern: "12", wall: 1.2, ties: false } },
  };
  assert.deepEqual(readFragment(writeFragment(next)).part.options, next.part.options);
});

test("undo leads back to where a hand rested, and redo forth again", () => {
  const store = createStore(readFragment("#part"));
  const at = (/** @type {number} */ wall) => ({ ...store.state, part: { ...store.state.part, options: { wall } } });
  store.replace(at(1), { rest: false });
  store.replace(at(2), { rest: false });
  store.replace(at(3));
  store.replace(at(4));
  store.undo();
  assert.equal(store.state.part.options.wall, 3);
  store.undo();
  assert.equal(store.state.part.options.wall, undefined);
  assert.equal(store.canUndo, false);
  store.redo();
  store.redo();
  assert.equal(store.state.part.options.wall, 4);
  assert.equal(store.canRedo, false);
});

test("the outline of a disc is closed, and as long as its circle", () => {
  const [size, radius] = [64, 20.3];
  const values = Float32Array.from(
    { length: size * size },
    (_, i) => radius - Math.hypot((i % size) + 0.5 - 32, Math.floor(i / size) + 0.5 - 32),
  );
  const segments = outline(values, size, size, 0);
  let length = 0;
  const ends = new Map();
  for (let at = 0; at < segments.length; at += 4) {
    const [x0, y0, x1, y1] = segments.subarray(at, at + 4);
    length += Math.hypot(x1 - x0, y1 - y0);
    for (const end of [`${x0.toFixed(3)} ${y0.toFixed(3)}`, `${x1.toFixed(3)} ${y1.toFixed(3)}`])
      ends.set(end, (ends.get(end) ?? 0) + 1);
  }
  assert.ok(Math.abs(length / (2 * Math.PI * radius) - 1) < 0.01, `${length}`);
  assert.deepEqual(new Set(ends.values()), new Set([2]));
});

test("a layer is decoded as it was encoded", () => {
  const header = new TextEncoder().encode('{"beads":1,"features":["infill"],"z":0.2,"time_s":3}'.padEnd(56));
  const bytes = new Uint8Array(8 + header.length + 21);
  bytes.set(new TextEncoder().encode("IFL1"));
  const view = new DataView(bytes.buffer);
  view.setUint32(4, header.length, true);
  bytes.set(header, 8);
  for (const [i, value] of [1, 2, 5, -4, 80].entries()) view.setFloat32(8 + header.length + 4 * i, value, true);
  const layer = decodeLayer(bytes.buffer);
  assert.deepEqual([...layer.ends], [1, 2, 5, -4]);
  assert.deepEqual([...layer.speeds], [80]);
  assert.deepEqual(layerBounds(layer), [1, -4, 5, 2]);
  assert.throws(() => decodeLayer(new ArrayBuffer(32)));
});

test("densities are read as people and programs write them", () => {
  assert.deepEqual(percents("20%"), [20]);
  assert.deepEqual(percents("15%:40%"), [15, 40]);
  assert.deepEqual(percents(0.25), [25]);
  assert.deepEqual(percents(null), []);
});

test("every word of a search has to match", () => {
  /** @type {any} */
  const octet = {
    name: "octet",
    title: "Octet",
    sentence: "bars; stiff in all directions",
    kind: "in space",
    products: ["fill"],
  };
  const search = { words: "", product: "", kind: "" };
  assert.ok(suits(octet, search));
  assert.ok(suits(octet, { ...search, words: "stiff BARS" }));
  assert.ok(!suits(octet, { ...search, words: "stiff soft" }));
  assert.ok(!suits(octet, { ...search, product: "refill" }));
});

test("a choice of pieces is the same after it was written and read", () => {
  for (let bits = 1; bits < 64; bits += 1) {
    const kept = Array.from({ length: 6 }, (_, i) => Boolean((bits >> i) & 1));
    assert.deepEqual(keptPieces(piecesText(kept), 6), kept);
  }
  assert.equal(piecesText([true, true]), null);
  assert.equal(piecesText([true, false, true, true]), "1,3-");
  assert.deepEqual(keptPieces("2", 3), [false, true, false]);
});
