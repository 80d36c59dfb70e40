/**
 * Whether pictures are drawn by the processor, as on machines without a graphics card.
 *
 * Smoothing edges then doubles the time of a picture; a view draws without, and again in more pixels once it rests.
 */

const NAMES = /swiftshader|llvmpipe|softpipe|software|basic render/i;

/** @type {boolean | null} */
let answer = null;

/** Whether WebGL is drawn by software here; found out once. */
export function isSoftware() {
  answer ??= ask();
  return answer;
}

function ask() {
  const gl = document.createElement("canvas").getContext("webgl2");
  if (!gl) return false;
  const names = gl.getExtension("WEBGL_debug_renderer_info");
  const name = String(names ? gl.getParameter(names.UNMASKED_RENDERER_WEBGL) : gl.getParameter(gl.RENDERER));
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return NAMES.test(name);
}
