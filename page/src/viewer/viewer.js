/**
 * A view of surfaces and lines that can be turned, moved, cut open and shared with another view.
 *
 * It draws when something changes and rests otherwise; it never moves by itself.
 */

import {
  Box3,
  BufferAttribute,
  BufferGeometry,
  Color,
  DirectionalLight,
  DoubleSide,
  FrontSide,
  HemisphereLight,
  Mesh,
  MeshLambertMaterial,
  Scene,
  Vector3,
  WebGLRenderer,
} from "three";
import { makeBeads } from "./beads.js";
import { listen, OrbitCamera } from "./camera.js";
import { makeMarks } from "./marks.js";
import { computeNormals } from "./normals.js";
import { cutPlane, Section } from "./section.js";
import { isSoftware } from "./software.js";

/** @typedef {import("./camera.js").CameraState} CameraState */
/** @typedef {import("./section.js").Cut} Cut */

// In the order in which surfaces come that have no colour of their own; legible on white and on black.
export const COLOURS = ["#d9903d", "#4d8fd1", "#5faa5f", "#c46bb0", "#c9b23f", "#6a7fd6", "#cf6a5c", "#49a7a0"];
const LOST = new Color("#d03a2b"); // values below 128
const ADDED = new Color("#2f6fde"); // values above 128
const WHITE = new Color("white");
const UNCHANGED = 128;
const SECTION_WHITE = 0.3; // share of white in the colour of a section
const IDLE = 400; // ms between two frames that do not belong together
const MOST_PIXELS = 2; // of the screen, a CSS pixel
const REST = 900; // ms after which a picture drawn by software is drawn again in more pixels

const LIGHTS = {
  light: { sky: 0xffffff, ground: 0xb8b4ac, ambient: 1.6, sun: 1.7 },
  dark: { sky: 0xf2f4ff, ground: 0x6d6a66, ambient: 1.35, sun: 1.8 },
};

/**
 * Create a view in an element, which gets the keyboard's focus and a name.
 *
 * @param {HTMLElement} element Its size is that of the view.
 * @param {{label?: string, reducedMotion?: boolean}} options The view has no motion that could be reduced.
 */
export function createViewer(element, { label = "3D view" } = {}) {
  return new Viewer(element, label);
}

/** @typedef {{mesh: Mesh, material: MeshLambertMaterial, section: Section | null, members: Shown[],
 *   origin: Uint32Array, values: Uint8Array | null, ramp: Color[] | null, triangles: number, opacity: number, colour: Color}} Shown */

class Viewer {
  /**
   * @param {HTMLElement} element
   * @param {string} label
   */
  constructor(element, label) {
    this.element = element;
    this.software = isSoftware();
    this.renderer = new WebGLRenderer({
      antialias: !this.software,
      alpha: true,
      stencil: true,
      preserveDrawingBuffer: false,
    });
    this.renderer.localClippingEnabled = true;
    this.canvas = this.renderer.domElement;
    this.canvas.style.cssText = "display:block;width:100%;height:100%";
    this.canvas.setAttribute("aria-hidden", "true");
    element.append(this.canvas);
    describe(element, label);

    this.scene = new Scene();
    this.orbit = new OrbitCamera();
    this.sky = new HemisphereLight();
    this.sky.position.set(0, 0, 1);
    this.sun = new DirectionalLight(0xffffff);
    this.scene.add(this.sky, this.sun, this.sun.target);

    /** @type {Map<string, Shown>} */
    this.shown = new Map();
    /** @type {Map<string, ReturnType<typeof makeBeads>>} */
    this.lines = new Map();
    /** @type {Map<string, ReturnType<typeof makeMarks>>} */
    this.marks = new Map();
    /** @type {Cut | null} */
    this.cut = null;
    /** @type {Set<(camera: CameraState) => void>} */
    this.listeners = new Set();
    /** @type {(() => void)[]} */
    this.waiting = [];
    this.request = 0;
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    this.sharpening = undefined;
    this.bounds = new Box3(new Vector3(), new Vector3());
    this.empty = true;
    this.frames = { last: 0, mean: 0 };

    this.setTheme("light");
    this.unlisten = listen(
      element,
      this.orbit,
      () => this.moved(),
      () => this.fit(),
    );
    this.observer = new ResizeObserver(() => this.resize());
    this.observer.observe(element);
    this.resize();
  }

  /**
   * Show surfaces in place of those shown before; names that stay keep what is set for them. The first ones are fitted.
   *
   * @param {import("./mesh.js").Decoded} decoded
   * @param {{flat?: boolean}} [how] A flat one shows its triangles, and is there in a third of the time.
   */
  setMesh(decoded, { flat = false } = {}) {
    const before = this.shown;
    const cut = this.cut;
    this.shown = new Map();
    decoded.surfaces.forEach((surface, number) => {
      const shown = this.show(surface, number, flat);
      const old = before.get(surface.name);
      if (old) {
        shown.mesh.visible = old.mesh.visible;
        shown.ramp = old.ramp;
        paint(shown, old.colour);
      }
      this.shown.set(surface.name, shown);
    });
    this.addSections(decoded.surfaces);
    for (const [name, old] of before) {
      this.remove(old);
      const shown = this.shown.get(name);
      if (shown) fade(shown, old.opacity);
    }
    this.changed();
    this.setCut(cut);
  }

  /**
   * Make a section for every solid: of one closed surface, or of several that bound it together. It has the colour of
   * the last of them.
   *
   * @param {import("./mesh.js").Surface[]} surfaces
   */
  addSections(surfaces) {
    /** @type {Map<string, Shown[]>} */
    const solids = new Map();
    for (const { name, closed, solid } of surfaces) {
      const shown = this.shown.get(name);
      if (closed && shown) solids.set(solid ?? name, [...(solids.get(solid ?? name) ?? []), shown]);
    }
    [...solids.values()].forEach((members, number) => {
      const shown = members[members.length - 1];
      const geometries = members.map(({ mesh }) => mesh.geometry);
      shown.section = new Section(geometries, number + 1);
      shown.members = members;
      shown.section.material.color.copy(shown.colour).lerp(WHITE, SECTION_WHITE);
      this.scene.add(shown.section.group);
    });
  }

  /**
   * @param {string} name
   * @param {boolean} visible
   */
  setVisible(name, visible) {
    const shown = this.shown.get(name);
    if (shown) shown.mesh.visible = visible;
    const lines = this.lines.get(name);
    if (lines) lines.group.visible = visible;
    this.setCut(this.cut);
  }

  /**
   * @param {string} name
   * @param {number} opacity From 0 to 1.
   */
  setOpacity(name, opacity) {
    const shown = this.shown.get(name);
    if (shown) fade(shown, opacity);
    this.setCut(this.cut);
  }

  /**
   * @param {string} name
   * @param {string} css A colour as CSS writes it.
   */
  setColour(name, css) {
    const shown = this.shown.get(name);
    if (shown) paint(shown, new Color(css));
    this.invalidate();
  }

  /**
   * Choose the colours of the values of a surface, from the lowest to the highest; none show the surface in its own.
   *
   * @param {string} name
   * @param {string[]} ramp Colours as CSS writes them.
   */
  setRamp(name, ramp) {
    const shown = this.shown.get(name);
    if (!shown) return;
    shown.ramp = ramp.map((css) => new Color(css));
    paint(shown, shown.colour);
    this.invalidate();
  }

  /**
   * Take away what lies before a plane, and fill the cut through closed surfaces; null takes nothing away.
   *
   * What goes is above z, right of x, or in front of y.
   *
   * @param {Cut | null} cut
   */
  setCut(cut) {
    this.cut = cut;
    const planes = cut === null ? null : [cutPlane(cut)];
    for (const shown of this.shown.values()) {
      shown.material.clippingPlanes = planes;
      shown.section?.set(shown.members.some(({ mesh }) => mesh.visible) ? cut : null, this.bounds);
    }
    for (const { material } of this.lines.values()) material.clippingPlanes = planes;
    this.invalidate();
  }

  /**
   * Add lines, or replace those of the same name.
   *
   * @param {string} name
   * @param {Float32Array} segments x, y, z of both ends of every segment, mm.
   * @param {Uint8Array} colours red, green, blue of every segment.
   * @param {Parameters<typeof makeBeads>[2]} options
   */
  addLines(name, segments, colours, options = {}) {
    this.removeLines(name);
    const lines = makeBeads(segments, colours, options);
    lines.group.userData = { bounds: boundsOf(segments), points: segments };
    this.lines.set(name, lines);
    this.scene.add(lines.group);
    this.changed();
    this.setCut(this.cut);
  }

  /** @param {string} name */
  removeLines(name) {
    const lines = this.lines.get(name);
    if (!lines) return;
    this.scene.remove(lines.group);
    for (const child of lines.group.children) /** @type {Mesh} */ (child).geometry.dispose();
    lines.material.dispose();
    this.lines.delete(name);
    this.changed();
  }

  /**
   * Show some of the layers of lines, counted from 0.
   *
   * @param {string} name
   * @param {number} first
   * @param {number} last
   */
  setLayers(name, first, last) {
    this.lines.get(name)?.group.children.forEach((child, layer) => {
      child.visible = layer >= first && layer <= last && !child.userData.empty;
    });
    this.invalidate();
  }

  /**
   * Mark places with rings, in place of those marked before under the same name.
   *
   * @param {string} name
   * @param {import("./marks.js").Mark[]} marks
   */
  setMarks(name, marks) {
    const before = this.marks.get(name);
    if (before) {
      this.scene.remove(before);
      before.geometry.dispose();
      this.marks.delete(name);
    }
    if (marks.length) {
      const made = makeMarks(marks);
      this.marks.set(name, made);
      this.scene.add(made);
    }
    this.invalidate();
  }

  /**
   * Turn about a place from now on, and have it in the middle.
   *
   * @param {number[]} at x, y, z in mm.
   */
  lookAt(at) {
    this.orbit.state.target = [at[0], at[1], at[2]];
    this.moved();
  }

  /** Show everything, from where the camera stands. */
  fit() {
    this.resize(); // the observer comes later, if the element has just changed
    this.orbit.fit();
    this.moved();
  }

  /**
   * Show everything from a side: "front", "right", "top", or else from the front, the right and above.
   *
   * @param {string} side
   */
  lookFrom(side) {
    this.orbit.lookFrom(side);
    this.fit();
  }

  /**
   * Return the colour of a surface as CSS writes it, undefined for an unknown one.
   *
   * @param {string} name
   */
  getColour(name) {
    const shown = this.shown.get(name);
    return shown && `#${shown.colour.getHexString()}`;
  }

  /** Return the camera, a copy. */
  getCamera() {
    const { target, ...angles } = this.orbit.state;
    return /** @type {CameraState} */ ({ ...angles, target: [...target] });
  }

  /**
   * Put the camera somewhere; listeners are not called, so that two views can share one camera.
   *
   * @param {CameraState} camera
   */
  setCamera(camera) {
    this.orbit.state = { ...camera, target: [...camera.target] };
    this.invalidate();
  }

  /**
   * Call a function whenever the person moves the camera; the function that is returned ends it.
   *
   * @param {(camera: CameraState) => void} callback
   */
  onCamera(callback) {
    this.listeners.add(callback);
    return () => this.listeners.delete(callback);
  }

  /** @param {'light' | 'dark'} theme */
  setTheme(theme) {
    const { sky, ground, ambient, sun } = LIGHTS[theme];
    this.sky.color.set(sky);
    this.sky.groundColor.set(ground);
    this.sky.intensity = ambient;
    this.sun.intensity = sun;
    this.invalidate();
  }

  /** Return a promise of the next frame; one is drawn if nothing else asks for it. */
  frame() {
    return /** @type {Promise<void>} */ (
      new Promise((resolve) => {
        this.waiting.push(resolve);
        this.invalidate();
      })
    );
  }

  /** Return the triangles of all surfaces, and the frames a second while the view last moved, if it did. */
  stats() {
    let triangles = 0;
    for (const shown of this.shown.values()) triangles += shown.triangles;
    return { triangles, fps: this.frames.mean ? 1000 / this.frames.mean : null };
  }

  /** Free what the view holds, and leave the element empty. */
  dispose() {
    cancelAnimationFrame(this.request);
    this.unlisten();
    this.observer.disconnect();
    clearTimeout(this.sharpening);
    for (const shown of this.shown.values()) this.remove(shown);
    for (const name of [...this.lines.keys()]) this.removeLines(name);
    cancelAnimationFrame(this.request);
    this.renderer.dispose();
    this.canvas.remove();
  }

  // --- what the methods above share ---

  /**
   * @param {import("./mesh.js").Surface} surface
   * @param {number} number
   * @param {boolean} flat
   * @returns {Shown}
   */
  show(surface, number, flat) {
    const geometry = new BufferGeometry();
    /** @type {Uint32Array} */
    let origin = Uint32Array.from(surface.values?.keys() ?? []);
    if (flat) {
      geometry.setAttribute("position", new BufferAttribute(surface.positions, 3));
      geometry.setIndex(new BufferAttribute(surface.indices, 1));
    } else {
      const split = computeNormals(surface.positions, surface.indices);
      origin = split.origin;
      geometry.setAttribute("position", new BufferAttribute(split.positions, 3));
      geometry.setAttribute("normal", new BufferAttribute(split.normals, 3));
      geometry.setIndex(new BufferAttribute(split.indices, 1));
    }
    geometry.computeBoundingSphere();
    const material = new MeshLambertMaterial({ side: surface.closed ? FrontSide : DoubleSide, flatShading: flat });
    const mesh = new Mesh(geometry, material);
    this.scene.add(mesh);
    mesh.renderOrder = number + 1.2;
    mesh.userData.bounds = new Box3(
      new Vector3(...surface.low),
      new Vector3(...surface.low).add(new Vector3(...surface.size)),
    );
    mesh.userData.points = surface.positions;
    const triangles = surface.indices.length / 3;
    const own = surface.colour && new Color().setRGB(...surface.colour, "srgb");
    const colour = own ?? new Color(COLOURS[number % COLOURS.length]);
    const { values } = surface;
    /** @type {Shown} */
    const shown = {
      mesh,
      material,
      section: null,
      members: [],
      origin,
      values,
      ramp: null,
      triangles,
      opacity: 1,
      colour,
    };
    paint(shown, colour);
    return shown;
  }

  /** @param {Shown} shown */
  remove(shown) {
    this.scene.remove(shown.mesh);
    // Its material is left to the garbage collector: if it were disposed of, the program that draws it would go too,
    // and be compiled again for the next mesh, which takes longer than drawing it.
    shown.mesh.geometry.dispose();
    if (shown.section) {
      this.scene.remove(shown.section.group);
      shown.section.dispose();
    }
  }

  /** Find the bounds again after surfaces or lines changed; fit the view to the first of them. */
  changed() {
    const all = [...[...this.shown.values()].map((shown) => shown.mesh), ...this.linesGroups()];
    const bounds = new Box3();
    for (const { userData } of all) if (!userData.bounds.isEmpty()) bounds.union(userData.bounds);
    if (bounds.isEmpty()) return;
    this.bounds = bounds;
    const points = all.map(({ userData }) => userData.points);
    this.orbit.setBounds(bounds.min.toArray(), bounds.max.toArray(), points);
    if (this.empty) {
      this.resize();
      this.orbit.fit();
    }
    this.empty = false;
    this.invalidate();
  }

  linesGroups() {
    return [...this.lines.values()].map((lines) => lines.group);
  }

  moved() {
    this.invalidate();
    for (const listener of this.listeners) listener(this.getCamera());
  }

  resize() {
    const width = Math.max(this.element.clientWidth, 1);
    const height = Math.max(this.element.clientHeight, 1);
    this.renderer.setPixelRatio(this.software ? 1 : Math.min(window.devicePixelRatio || 1, MOST_PIXELS));
    this.renderer.setSize(width, height, false);
    this.orbit.setAspect(width / height);
    this.invalidate();
  }

  /**
   * Draw in few pixels now, and once in many when nothing has moved for a while.
   *
   * @param {import("three").Camera} camera
   */
  sharpenAtRest(camera) {
    clearTimeout(this.sharpening);
    if (this.renderer.getPixelRatio() !== 1) this.renderer.setPixelRatio(1);
    this.sharpening = setTimeout(() => {
      this.renderer.setPixelRatio(MOST_PIXELS);
      this.renderer.render(this.scene, camera);
    }, REST);
  }

  invalidate() {
    if (!this.request) this.request = requestAnimationFrame((time) => this.draw(time));
  }

  /** @param {number} time ms */
  draw(time) {
    this.request = 0;
    const camera = this.orbit.place();
    this.sun.position.copy(camera.position);
    this.sun.position.z += this.orbit.state.distance * 0.6;
    this.sun.target.position.set(...this.orbit.state.target);
    if (this.software) this.sharpenAtRest(camera);
    this.renderer.render(this.scene, camera);
    const passed = time - this.frames.last;
    this.frames.last = time;
    if (passed > 0 && passed < IDLE) {
      this.frames.mean = this.frames.mean ? 0.8 * this.frames.mean + 0.2 * passed : passed;
    }
    for (const resolve of this.waiting.splice(0)) resolve();
  }
}

/**
 * Give an element a name, a role and a place in the order of the keyboard.
 *
 * @param {HTMLElement} element
 * @param {string} label
 */
function describe(element, label) {
  element.tabIndex = 0;
  element.setAttribute("role", "application");
  element.setAttribute("aria-roledescription", "3D view");
  element.setAttribute("aria-label", label);
  element.setAttribute("aria-keyshortcuts", "ArrowLeft ArrowRight ArrowUp ArrowDown Shift+ArrowLeft + - f");
  element.style.touchAction = "none";
}

/**
 * Make a surface transparent; a filled cut stays opaque, because the order of drawing counts there.
 *
 * @param {Shown} shown
 * @param {number} opacity
 */
function fade(shown, opacity) {
  shown.opacity = opacity;
  shown.material.opacity = opacity;
  shown.material.transparent = opacity < 1;
  shown.material.depthWrite = opacity >= 1;
  shown.material.needsUpdate = true;
}

/**
 * Colour a surface, by its values if it has any.
 *
 * @param {Shown} shown
 * @param {Color} colour
 */
function paint(shown, colour) {
  shown.colour = colour;
  shown.section?.material.color.copy(colour).lerp(WHITE, SECTION_WHITE);
  if (shown.values === null || shown.ramp?.length === 0) {
    shown.material.color.copy(colour);
    shown.material.vertexColors = false;
    shown.material.needsUpdate = true;
    return;
  }
  const table = shown.ramp ? rampTable(shown.ramp) : changeTable(colour);
  const colours = new Float32Array(3 * shown.origin.length);
  shown.origin.forEach((vertex, i) => {
    const at = 3 * /** @type {Uint8Array} */ (shown.values)[vertex];
    colours.set(table.subarray(at, at + 3), 3 * i);
  });
  shown.mesh.geometry.setAttribute("color", new BufferAttribute(colours, 3));
  shown.material.color.set("white");
  shown.material.vertexColors = true;
  shown.material.needsUpdate = true;
}

/**
 * Return the colours of 256 values that say what was lost and added: three numbers each.
 *
 * @param {Color} colour Of what has not changed.
 */
function changeTable(colour) {
  const table = new Float32Array(3 * 256);
  const mixed = new Color();
  for (let value = 0; value < 256; value++) {
    const share = Math.abs(value - UNCHANGED) / (value < UNCHANGED ? UNCHANGED : 255 - UNCHANGED);
    mixed.lerpColors(colour, value < UNCHANGED ? LOST : ADDED, share).toArray(table, 3 * value);
  }
  return table;
}

/**
 * Return the colours of 256 values along a ramp: three numbers each.
 *
 * @param {Color[]} ramp
 */
function rampTable(ramp) {
  const table = new Float32Array(3 * 256);
  const mixed = new Color();
  for (let value = 0; value < 256; value++) {
    const place = (value / 255) * (ramp.length - 1);
    const low = Math.max(0, Math.min(ramp.length - 2, Math.floor(place)));
    mixed.lerpColors(ramp[low], ramp[Math.min(low + 1, ramp.length - 1)], place - low).toArray(table, 3 * value);
  }
  return table;
}

/** @param {Float32Array} points x, y, z of each. */
function boundsOf(points) {
  const box = new Box3();
  for (let axis = 0; axis < 3; axis++) {
    let low = Infinity;
    let high = -Infinity;
    for (let i = axis; i < points.length; i += 3) {
      low = Math.min(low, points[i]);
      high = Math.max(high, points[i]);
    }
    box.min.setComponent(axis, low);
    box.max.setComponent(axis, high);
  }
  return box;
}
