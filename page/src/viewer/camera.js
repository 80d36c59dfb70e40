/**
 * A camera that turns about a point, z upwards, and the pointer and keys that move it.
 *
 * @typedef {object} CameraState
 * @property {[number, number, number]} target Point in the middle of the view, mm.
 * @property {number} distance From the camera to that point, mm.
 * @property {number} azimuth Where the camera stands, radians about z, from -y (the front) counter-clockwise.
 * @property {number} elevation Its height over the horizon, radians.
 */

import { PerspectiveCamera, Vector3 } from "three";

const FIELD = 30; // degrees, of the shorter side of the view
const STEEPEST = Math.PI / 2 - 1e-3;
const MOST_POINTS = 20_000; // of a surface that are looked at to fit the view
const MARGIN = 1.08; // of the distance, around what is fitted
const KEY_TURN = Math.PI / 24;
const KEY_ZOOM = 1.15;
/** @type {Record<string, {azimuth: number, elevation: number}>} */
const SIDES = {
  front: { azimuth: 0, elevation: 0 },
  right: { azimuth: Math.PI / 2, elevation: 0 },
  top: { azimuth: 0, elevation: STEEPEST },
};
const FRONT_RIGHT = { azimuth: Math.PI / 5, elevation: Math.PI / 6 };

export class OrbitCamera {
  constructor() {
    this.camera = new PerspectiveCamera(FIELD, 1, 1, 1000);
    this.camera.up.set(0, 0, 1);
    /** @type {CameraState} */
    this.state = { target: [0, 0, 0], distance: 100, ...FRONT_RIGHT };
    this.radius = 50; // mm, of what is shown
    this.centre = [0, 0, 0];
    /** @type {ArrayLike<number>[]} */
    this.points = [];
  }

  /**
   * Turn about the target.
   *
   * @param {number} right Radians.
   * @param {number} up
   */
  turn(right, up) {
    this.state.azimuth = wrap(this.state.azimuth + right);
    this.state.elevation = clamp(this.state.elevation + up, -STEEPEST, STEEPEST);
  }

  /** @param {number} times How many times as far away. */
  zoom(times) {
    this.state.distance = clamp(this.state.distance * times, this.radius / 200, this.radius * 50);
  }

  /**
   * Move the target along the view.
   *
   * @param {number} right Share of the height of the view.
   * @param {number} up
   */
  pan(right, up) {
    const height = 2 * this.state.distance * Math.tan((this.camera.fov * Math.PI) / 360);
    const axes = axesOf(this.state.azimuth, this.state.elevation);
    for (let axis = 0; axis < 3; axis++) {
      this.state.target[axis] += height * (right * axes.right[axis] + up * axes.up[axis]);
    }
  }

  /**
   * Say where everything is.
   *
   * @param {number[]} low Lower corner of a box around it.
   * @param {number[]} high
   * @param {ArrayLike<number>[]} points x, y, z of points that are to be seen.
   */
  setBounds(low, high, points) {
    this.centre = low.map((value, axis) => (value + high[axis]) / 2);
    this.radius = Math.max(Math.hypot(...low.map((value, axis) => (high[axis] - value) / 2)), 1e-3);
    this.points = points;
  }

  /** Show all points, from the side where the camera is. */
  fit() {
    const { back, right, up } = axesOf(this.state.azimuth, this.state.elevation);
    const upwards = Math.tan((this.camera.fov * Math.PI) / 360);
    const sidewards = upwards * this.camera.aspect;
    const [x, y, z] = this.centre;
    let distance = this.radius / 100;
    for (const points of this.points) {
      const stride = 3 * Math.ceil(points.length / 3 / MOST_POINTS);
      for (let i = 0; i < points.length; i += stride) {
        const offset = [points[i] - x, points[i + 1] - y, points[i + 2] - z];
        const needed = Math.max(Math.abs(dot(offset, right)) / sidewards, Math.abs(dot(offset, up)) / upwards);
        distance = Math.max(distance, dot(offset, back) + needed);
      }
    }
    this.state.target = [x, y, z];
    this.state.distance = MARGIN * distance;
  }

  /**
   * Turn to a side.
   *
   * @param {string} side One of `SIDES`, else that of the beginning.
   */
  lookFrom(side) {
    Object.assign(this.state, SIDES[side] ?? FRONT_RIGHT);
  }

  /** @param {number} aspect Width of the view by its height. */
  setAspect(aspect) {
    this.camera.aspect = aspect;
    const half = Math.tan((FIELD * Math.PI) / 360);
    this.camera.fov = (360 / Math.PI) * Math.atan(half / Math.min(aspect, 1));
  }

  /** Return the camera where its state says. */
  place() {
    const { target, distance, azimuth, elevation } = this.state;
    const to = new Vector3(...target);
    this.camera.position.fromArray(axesOf(azimuth, elevation).back).multiplyScalar(distance).add(to);
    this.camera.lookAt(to);
    const reach = this.radius + Math.hypot(...target.map((value, axis) => value - this.centre[axis]));
    this.camera.near = Math.max(distance - 1.1 * reach, distance / 200);
    this.camera.far = distance + 1.1 * reach;
    this.camera.updateProjectionMatrix();
    return this.camera;
  }
}

/**
 * Return the directions of a view: to the viewer, to the right and upwards.
 *
 * @param {number} azimuth
 * @param {number} elevation
 */
function axesOf(azimuth, elevation) {
  const [s, c] = [Math.sin(azimuth), Math.cos(azimuth)];
  const [rise, flat] = [Math.sin(elevation), Math.cos(elevation)];
  return { back: [s * flat, -c * flat, rise], right: [c, s, 0], up: [-s * rise, c * rise, flat] };
}

/**
 * @param {number[]} a
 * @param {number[]} b
 */
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/**
 * Move a camera by pointer, wheel and keys of an element.
 *
 * @param {HTMLElement} element
 * @param {OrbitCamera} orbit
 * @param {() => void} moved Called after each move.
 * @param {() => void} fit Called for the key that shows everything.
 * @returns {() => void} Ends it.
 */
export function listen(element, orbit, moved, fit) {
  const abort = new AbortController();
  const options = { signal: abort.signal };
  /** @type {Map<number, {x: number, y: number}>} */
  const pointers = new Map();

  element.addEventListener(
    "pointerdown",
    (event) => {
      element.focus({ preventScroll: true });
      pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
      element.setPointerCapture(event.pointerId);
    },
    options,
  );
  for (const end of /** @type {const} */ (["pointerup", "pointercancel"])) {
    element.addEventListener(end, (event) => pointers.delete(event.pointerId), options);
  }
  element.addEventListener(
    "pointermove",
    (event) => {
      const before = pointers.get(event.pointerId);
      if (!before) return;
      const after = { x: event.clientX, y: event.clientY };
      const height = element.clientHeight || 1;
      const [dx, dy] = [(after.x - before.x) / height, (after.y - before.y) / height];
      const other = [...pointers].find(([id]) => id !== event.pointerId)?.[1];
      pointers.set(event.pointerId, after);
      if (other) {
        orbit.zoom(separation(before, other) / Math.max(separation(after, other), 1));
        orbit.pan(-dx / 2, dy / 2);
      } else if (event.buttons & 6 || event.shiftKey || event.ctrlKey || event.metaKey) {
        orbit.pan(-dx, dy);
      } else {
        orbit.turn(-dx * Math.PI, dy * Math.PI);
      }
      moved();
    },
    options,
  );
  element.addEventListener("contextmenu", (event) => event.preventDefault(), options);
  element.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      orbit.zoom(Math.exp(clamp(event.deltaY * (event.deltaMode === 1 ? 20 : 1), -200, 200) / 500));
      moved();
    },
    { ...options, passive: false },
  );
  element.addEventListener(
    "keydown",
    (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey || event.target !== element) return;
      if (!act(event.key, event.shiftKey, orbit, fit)) return;
      event.preventDefault();
      moved();
    },
    options,
  );
  return () => abort.abort();
}

/**
 * Do what a key says; return false if it says nothing.
 *
 * @param {string} key
 * @param {boolean} shift
 * @param {OrbitCamera} orbit
 * @param {() => void} fit
 */
function act(key, shift, orbit, fit) {
  /** @type {Record<string, [number, number]>} */
  const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
  if (key in arrows) {
    const [right, up] = arrows[key];
    if (shift) orbit.pan(right / 20, up / 20);
    else orbit.turn(right * KEY_TURN, up * KEY_TURN);
  } else if (key === "+" || key === "=") orbit.zoom(1 / KEY_ZOOM);
  else if (key === "-" || key === "_") orbit.zoom(KEY_ZOOM);
  else if (key === "f" || key === "F") fit();
  else return false;
  return true;
}

/**
 * @param {{x: number, y: number}} a
 * @param {{x: number, y: number}} b
 */
const separation = (a, b) => Math.hypot(a.x - b.x, a.y - b.y);

/** @param {number} angle */
const wrap = (angle) => Math.atan2(Math.sin(angle), Math.cos(angle));

/**
 * @param {number} value
 * @param {number} low
 * @param {number} high
 */
const clamp = (value, low, high) => Math.min(Math.max(value, low), high);
