// Many tubes, balls, boxes and cones drawn in a few calls.

import * as THREE from "three";

const UP = new THREE.Vector3(0, 1, 0);
const GEOMETRIES = {
  tube: () => new THREE.CylinderGeometry(1, 1, 1, 28),
  ball: () => new THREE.SphereGeometry(1, 24, 16),
  box: () => new THREE.BoxGeometry(2, 2, 2),
  cone: () => new THREE.ConeGeometry(1, 1, 24),
  prism: () => new THREE.CylinderGeometry(1, 1, 1, 3),
  globe: () => new THREE.SphereGeometry(1, 40, 28),
};

function between(start, end, width) {
  const from = new THREE.Vector3(...start), to = new THREE.Vector3(...end);
  const way = to.clone().sub(from), length = Math.max(way.length(), 1e-9);
  const turn = new THREE.Quaternion().setFromUnitVectors(UP, way.divideScalar(length));
  return new THREE.Matrix4().compose(from.add(to).multiplyScalar(0.5), turn, new THREE.Vector3(width, length, width));
}

export const tube = (start, end, width, colour) => ({ kind: "tube", matrix: between(start, end, width), colour });
export const cone = (start, end, width, colour) => ({ kind: "cone", matrix: between(start, end, width), colour });
export const ball = ([x, y, z], width, colour) => ({
  kind: "ball", colour, matrix: new THREE.Matrix4().makeScale(width, width, width).setPosition(x, y, z),
});
const along = (axes, sizes, centre) => new THREE.Matrix4()
  .makeBasis(...axes.map((axis, i) => new THREE.Vector3(...axis).multiplyScalar(sizes[i]))).setPosition(...centre);
export const box = (centre, axes, sizes, colour) => ({ kind: "box", colour, matrix: along(axes, sizes, centre) });
export function ellipsoid(centre, axes, sizes, colour) {
  const [x, y, z] = axes.map((axis) => new THREE.Vector3(...axis));
  const right = x.clone().cross(y).dot(z) > 0 ? axes : [axes[0], axes[1], axes[2].map((part) => -part)];
  return { kind: "globe", colour, matrix: along(right, sizes, centre) };
}

/** A triangle of some thickness, level. */
export function plate(corners, thickness, colour) {
  const [one, two, three] = corners.map((corner) => new THREE.Vector3(...corner));
  const upward = two.clone().sub(one).cross(three.clone().sub(one)).z > 0;
  const centre = one.clone().add(two).add(three).divideScalar(3), z = one.clone().sub(centre), side = upward ? two : three;
  const x = side.clone().sub(centre).addScaledVector(z, 0.5).multiplyScalar(2 / Math.sqrt(3));
  return { kind: "prism", colour, matrix: new THREE.Matrix4().makeBasis(x, new THREE.Vector3(0, 0, thickness), z).setPosition(centre) };
}

/** A group whose contents are set anew at each step: `draw` a list of what the functions above make. */
export class Solids extends THREE.Group {
  constructor(material) {
    super();
    this.material = material;
    this.meshes = new Map();
  }

  draw(solids) {
    for (const kind of Object.keys(GEOMETRIES)) {
      const own = solids.filter((solid) => solid.kind === kind);
      const mesh = this.meshes.get(kind);
      if (!own.length && !mesh) continue;
      this.#fill(mesh && mesh.instanceMatrix.count >= own.length ? mesh : this.#grow(kind, own.length), own);
    }
  }

  /** Show only the first so many of each kind. */
  reveal(count) {
    for (const mesh of this.meshes.values()) mesh.count = count;
  }

  #grow(kind, count) {
    const old = this.meshes.get(kind);
    const mesh = new THREE.InstancedMesh(old?.geometry ?? GEOMETRIES[kind](), this.material, Math.ceil(1.5 * count));
    mesh.frustumCulled = false;
    mesh.castShadow = this.material.isMeshStandardMaterial && !this.material.transparent;
    if (old) this.remove(old.dispose());
    this.meshes.set(kind, mesh);
    this.add(mesh);
    return mesh;
  }

  #fill(mesh, solids) {
    const colour = new THREE.Color();
    solids.forEach((solid, i) => {
      mesh.setMatrixAt(i, solid.matrix);
      mesh.setColorAt(i, colour.set(solid.colour));
    });
    mesh.count = solids.length;
    mesh.instanceMatrix.needsUpdate = true;
    if (mesh.instanceColor) mesh.instanceColor.needsUpdate = true;
    mesh.boundingSphere = mesh.boundingBox = null; // what a ray asks first
  }

  dispose() {
    for (const mesh of this.meshes.values()) {
      mesh.geometry.dispose();
      mesh.dispose();
    }
    this.material.dispose();
  }
}
