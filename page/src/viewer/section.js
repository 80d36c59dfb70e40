/**
 * A cut through solids, filled.
 *
 * The cut of a plane with all triangles is a set of directed lines. Every line and one fixed point make a triangle; those
 * that turn one way count up in the stencil buffer, the others down. Where the count is not 0, the plane is in the solid.
 */

import {
  AlwaysStencilFunc,
  BackSide,
  BufferAttribute,
  BufferGeometry,
  DecrementWrapStencilOp,
  DoubleSide,
  FrontSide,
  Group,
  IncrementWrapStencilOp,
  Mesh,
  MeshBasicMaterial,
  NotEqualStencilFunc,
  Plane,
  PlaneGeometry,
  ReplaceStencilOp,
  Vector3,
} from "three";

/** @typedef {{axis: 'x' | 'y' | 'z', at: number}} Cut */

// The side that is taken away: what is nearer to a viewer in front, on the right and above.
const KEPT = { x: new Vector3(-1, 0, 0), y: new Vector3(0, 1, 0), z: new Vector3(0, 0, -1) };

/** @param {Cut} cut */
export function cutPlane(cut) {
  const normal = KEPT[cut.axis];
  return new Plane(normal, -cut.at * (normal.x + normal.y + normal.z));
}

export class Section {
  /**
   * @param {BufferGeometry[]} geometries Of closed surfaces that bound one solid together.
   * @param {number} order Every section is drawn before the next one begins.
   */
  constructor(geometries, order) {
    this.group = new Group();
    this.geometries = geometries;
    this.fan = new BufferGeometry();
    this.counters = [counter(BackSide, IncrementWrapStencilOp), counter(FrontSide, DecrementWrapStencilOp)];
    for (const material of this.counters) {
      const mesh = new Mesh(this.fan, material);
      mesh.renderOrder = order;
      mesh.frustumCulled = false;
      this.group.add(mesh);
    }
    this.material = new MeshBasicMaterial({
      side: DoubleSide,
      stencilWrite: true,
      stencilRef: 0,
      stencilFunc: NotEqualStencilFunc,
      stencilFail: ReplaceStencilOp,
      stencilZFail: ReplaceStencilOp,
      stencilZPass: ReplaceStencilOp,
    });
    this.cap = new Mesh(new PlaneGeometry(1, 1), this.material);
    this.cap.renderOrder = order + 0.1;
    this.cap.onAfterRender = (renderer) => renderer.clearStencil();
    this.group.add(this.cap);
    this.group.visible = false;
    this.drawn = "";
  }

  /**
   * Fill the cut at a plane, in the bounds of what is shown.
   *
   * @param {Cut | null} cut
   * @param {import("three").Box3} bounds
   */
  set(cut, bounds) {
    this.group.visible = cut !== null;
    if (cut === null) return;
    const size = bounds.getSize(new Vector3()).length() * 1.1 || 1;
    bounds.getCenter(this.cap.position);
    this.cap.position[cut.axis] = cut.at;
    this.cap.scale.set(size, size, 1);
    this.cap.lookAt(this.cap.position.clone().sub(cutPlane(cut).normal));
    const key = `${cut.axis} ${cut.at}`;
    if (key === this.drawn) return;
    this.drawn = key;
    const axis = "xyz".indexOf(cut.axis);
    const parts = this.geometries.map(({ attributes, index }) =>
      cutLines(attributes.position.array, /** @type {BufferAttribute} */ (index).array, axis, cut.at),
    );
    this.fan.setAttribute("position", new BufferAttribute(fanOf(parts, this.cap.position.toArray()), 3));
  }

  dispose() {
    this.fan.dispose(); // materials stay, as those of surfaces do
    this.cap.geometry.dispose();
  }
}

/**
 * Find the lines in which a plane across an axis cuts triangles; the solid lies on the same side of all of them.
 *
 * @param {ArrayLike<number>} positions
 * @param {ArrayLike<number>} indices
 * @param {number} axis
 * @param {number} at
 * @returns {number[]} x, y, z of both ends of every line
 */
export function cutLines(positions, indices, axis, at) {
  /** @type {number[]} */
  const lines = [];
  for (let i = 0; i < indices.length; i += 3) {
    const [a, b, c] = [3 * indices[i], 3 * indices[i + 1], 3 * indices[i + 2]];
    const [up, vp, wp] = [positions[a + axis] >= at, positions[b + axis] >= at, positions[c + axis] >= at];
    if (up === vp && vp === wp) continue;
    // The corner that is alone on its side, and the two others in the order of the triangle.
    const [tip, next, last, rises] = vp === wp ? [a, b, c, up] : wp === up ? [b, c, a, vp] : [c, a, b, wp];
    for (const end of rises ? [next, last] : [last, next]) {
      // From below to above, so that both triangles of an edge find the very same point.
      const [low, high] = rises ? [end, tip] : [tip, end];
      const share = (at - positions[low + axis]) / (positions[high + axis] - positions[low + axis]);
      for (let k = 0; k < 3; k += 1) {
        lines.push(k === axis ? at : positions[low + k] + share * (positions[high + k] - positions[low + k]));
      }
    }
  }
  return lines;
}

/**
 * Make a triangle of every line and one point.
 *
 * @param {number[][]} parts
 * @param {number[]} point
 */
function fanOf(parts, point) {
  const fan = new Float32Array((parts.reduce((sum, lines) => sum + lines.length, 0) / 2) * 3);
  let at = 0;
  for (const lines of parts) {
    for (let i = 0; i < lines.length; i += 6) {
      fan.set(point, at);
      for (let k = 0; k < 6; k += 1) fan[at + 3 + k] = lines[i + k];
      at += 9;
    }
  }
  return fan;
}

/**
 * @param {import("three").Side} side
 * @param {import("three").StencilOp} operation
 */
function counter(side, operation) {
  return new MeshBasicMaterial({
    side,
    depthWrite: false,
    depthTest: false,
    colorWrite: false,
    stencilWrite: true,
    stencilFunc: AlwaysStencilFunc,
    stencilFail: operation,
    stencilZFail: operation,
    stencilZPass: operation,
  });
}
