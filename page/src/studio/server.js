/**
 * The page's side of the studio's HTTP: every call of it stands here, and frames are read here.
 *
 * A frame is a uint32 length (little endian), a byte that says its kind, and as many bytes as the length says.
 */

import { decodeLayer } from "./layer.js";

/** @typedef {{key: string, flag: string, group: string, help: string, kind: string, unit: string, choices: string[],
 *   default: any, default_text?: string, least: number|null, most: number|null}} Option */
/** @typedef {{name: string, title: string, sentence: string, kind: string, products: string[],
 *   facts: Record<string, any>, parameters: Option[], picture: string}} Pattern */
/** @typedef {{name: string, value: any, unit?: string, help?: string, key?: string, about?: boolean}} NumberRow */
/** @typedef {{version: string, limits: Record<string, number>, products: Record<string, Option[]>,
 *   materials: {name: string, density: number}[], slicers: string[], file: {name: string}|null}} About */
/** @typedef {{stage: string, share: number}} Progress */
/** @typedef {{answer: any, mesh: ArrayBuffer|null, layer: import("./layer.js").Layer|null}} Reply */

const PROGRESS = 1;
const ANSWER = 2;
const MESH = 3;
const ERROR = 4;
const LAYER = 5;
const HEAD = 5; // bytes before a payload

/** An error that the server states: one sentence, and the option it is about. */
export class StatedError extends Error {
  /**
   * @param {string} message
   * @param {string|null} [parameter]
   * @param {boolean} [refused] whether the result was made, and is not the requested solid
   */
  constructor(message, parameter = null, refused = false) {
    super(message);
    this.parameter = parameter;
    this.refused = refused;
  }
}

/**
 * Whether an error only says that a request was dropped for a newer one.
 * @param {unknown} error
 */
export function isAbort(error) {
  return error instanceof DOMException && error.name === "AbortError";
}

/**
 * Split a stream of bytes into frames.
 * @param {ReadableStream<Uint8Array>} stream
 * @returns {AsyncGenerator<{kind: number, payload: Uint8Array<ArrayBuffer>}>}
 */
export async function* readFrames(stream) {
  const reader = stream.getReader();
  /** @type {Uint8Array[]} */
  let pieces = [];
  let size = 0;
  let wanted = HEAD;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) return;
    pieces.push(value);
    size += value.length;
    if (size < wanted) continue;
    const bytes = join(pieces, size);
    let at = 0;
    wanted = HEAD;
    while (size - at >= HEAD) {
      const length = new DataView(bytes.buffer).getUint32(at, true);
      if (size - at < HEAD + length) {
        wanted = HEAD + length;
        break;
      }
      yield { kind: bytes[at + 4], payload: bytes.slice(at + HEAD, at + HEAD + length) };
      at += HEAD + length;
    }
    pieces = [bytes.subarray(at)];
    size -= at;
  }
}

/**
 * @param {Uint8Array[]} pieces
 * @param {number} size
 */
function join(pieces, size) {
  const bytes = new Uint8Array(size);
  let at = 0;
  for (const piece of pieces) {
    bytes.set(piece, at);
    at += piece.length;
  }
  return bytes;
}

/**
 * Read the frames of a response; raise StatedError for an error in them.
 * @param {Response} response
 * @param {(progress: Progress) => void} onProgress
 * @returns {Promise<Reply>}
 */
async function readReply(response, onProgress) {
  if (!response.ok || !response.body) throw await readRefusal(response);
  /** @type {Reply} */
  const reply = { answer: null, mesh: null, layer: null };
  for await (const { kind, payload } of readFrames(response.body)) {
    if (kind === PROGRESS) onProgress(parseJson(payload));
    else if (kind === ANSWER) reply.answer = parseJson(payload);
    else if (kind === MESH) reply.mesh = payload.buffer;
    else if (kind === LAYER) reply.layer = decodeLayer(payload.buffer);
    else if (kind === ERROR) {
      const { message, parameter, cancelled, refused } = parseJson(payload);
      if (cancelled) throw new DOMException(message, "AbortError");
      throw new StatedError(message, parameter, refused);
    }
  }
  if (!reply.answer) throw new StatedError("The studio stopped before it had answered. Try again.");
  return reply;
}

/** @param {Uint8Array} payload */
function parseJson(payload) {
  return JSON.parse(new TextDecoder().decode(payload));
}

/** @param {Response} response that is not ok */
export async function readRefusal(response) {
  const text = await response.text();
  try {
    const { message, parameter } = JSON.parse(text);
    return new StatedError(message, parameter);
  } catch {
    return new StatedError(`The studio refused this (${response.status}).`);
  }
}

/** The studio's server, as one open page sees it. */
export class Server {
  #page = "";

  /** Open a page on the server; `onEnd` is called when the server goes. */
  /** @param {() => void} onEnd */
  async open(onEnd) {
    const response = await fetch("api/pages", { method: "POST" });
    if (!response.ok) throw await readRefusal(response);
    this.#page = (await response.json()).page;
    const alive = new EventSource(`api/pages/${this.#page}/alive`);
    alive.onerror = () => {
      alive.close();
      onEnd();
    };
  }

  /** @returns {Promise<About>} */
  async about() {
    return (await fetch("api/about")).json();
  }

  /** @returns {Promise<Pattern[]>} */
  async patterns() {
    const answer = await (await fetch("api/patterns")).json();
    return answer.patterns ?? answer;
  }

  /**
   * Send a file; or take a sample, or the file of the command line.
   * @param {File | {sample: string} | {given: true}} file
   * @param {{onProgress?: (progress: Progress) => void, signal?: AbortSignal}} [how]
   */
  async load(file, { onProgress = () => {}, signal } = {}) {
    const query = file instanceof File ? { name: file.name } : file;
    const words = new URLSearchParams(Object.entries(query).map(([key, value]) => [key, String(value)]));
    const body = file instanceof File ? file : null;
    const response = await fetch(this.path(`files?${words}`), { method: "POST", body, signal });
    return readReply(response, onProgress);
  }

  /**
   * Ask for an answer: one call of the library.
   * @param {{product: string, file: string|null, options: object, quality: "coarse"|"exact", layer?: number, lane?: string}} request
   * @param {{onProgress?: (progress: Progress) => void, signal?: AbortSignal}} [how]
   */
  async ask(request, { onProgress = () => {}, signal } = {}) {
    const response = await fetch(this.path("requests"), {
      method: "POST",
      headers: { "content-type": "application/json" },
      body: JSON.stringify(request),
      signal,
    });
    return readReply(response, onProgress);
  }

  /**
   * A layer of a print, as sliced, or as a result has it.
   * @param {string} file
   * @param {number} index
   * @param {string|null} result
   * @param {AbortSignal} [signal]
   */
  async layer(file, index, result, signal) {
    const query = result ? `?result=${result}` : "";
    const response = await fetch(this.path(`files/${file}/layers/${index}${query}`), { signal });
    if (!response.ok) throw await readRefusal(response);
    return decodeLayer(await response.arrayBuffer());
  }

  /**
   * A slice of a scan as grey values, 0 for `low` and 255 for `high`.
   * @param {string} file
   * @param {{axis: string, index: number, low: number, high: number}} place
   * @param {AbortSignal} [signal]
   */
  async slice(file, place, signal) {
    const query = new URLSearchParams(Object.entries(place).map(([key, value]) => [key, String(value)]));
    const response = await fetch(this.path(`files/${file}/slice?${query}`), { signal });
    if (!response.ok) throw await readRefusal(response);
    return createImageBitmap(await response.blob());
  }

  /**
   * The address of a result as a file.
   * @param {string} result
   * @param {Record<string, string>} query
   */
  download(result, query) {
    return this.path(`results/${result}?${new URLSearchParams(query)}`);
  }

  /** @param {string} rest */
  path(rest) {
    return `api/pages/${this.#page}/${rest}`;
  }
}
