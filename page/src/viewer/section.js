/**
 * A cut through solids, filled: where a ray meets more back faces than front faces behind the plane, it is inside.
 *
 * Back faces count up in the stencil buffer and front faces down; the plane is drawn where the count is not 0.
 */

import {
  AlwaysStencilFunc,
  BackSide,
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
   * @param {import("three").BufferGeometry[]} geometries Of closed surfaces that bound one solid together.
   * @param {number} order Every section is drawn before the next one begins.
   */
  constructor(geometries, order) {
    this.group = new Group();
    this.counters = [counter(BackSide, IncrementWrapStencilOp), counter(FrontSide, DecrementWrapStencilOp)];
    for (const geometry of geometries) {
      for (const material of this.counters) {
        const mesh = new Mesh(geometry, material);
        mesh.renderOrder = order;
        this.group.add(mesh);
      }
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
    const plane = cutPlane(cut);
    for (const material of this.counters) material.clippingPlanes = [plane];
    const size = bounds.getSize(new Vector3()).length() * 1.1 || 1;
    bounds.getCenter(this.cap.position);
    this.cap.position[cut.axis] = cut.at;
    this.cap.scale.set(size, size, 1);
    this.cap.lookAt(this.cap.position.clone().sub(plane.normal));
  }

  dispose() {
    for (const material of this.counters) material.dispose();
    this.cap.geometry.dispose();
    this.material.dispose();
  }
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
