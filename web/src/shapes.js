// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// engine::Shape → three.js. SDF's axes: z up, cylinders and capsules along z, planes facing z.
import * as THREE from 'three';
import { RoundedBoxGeometry } from 'three/examples/jsm/geometries/RoundedBoxGeometry.js';

function triangles({ vertices, indices }, flat) {
  let geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(vertices, 3));
  if (indices.length) geometry.setIndex(new THREE.BufferAttribute(indices, 1));
  if (flat && geometry.index) geometry = geometry.toNonIndexed();
  geometry.computeVertexNormals();
  return geometry;
}

/** Null where there is nothing to draw (a mesh without triangles). The geometry is in the shape's frame, meshes' in the link's. */
export function geometryOf(shape, run, still) {
  const [a, b, c] = shape.size;
  switch (shape.kind) {
    case 'box': {
      // Edges that catch a little light make parts readable; terrain stays exact.
      const edge = still ? 0 : Math.min(a, b, c) * 0.07;
      return edge > 0 ? new RoundedBoxGeometry(a, b, c, 2, edge) : new THREE.BoxGeometry(a, b, c);
    }
    case 'sphere':
      return new THREE.SphereGeometry(a, 32, 20);
    case 'cylinder':
      return new THREE.CylinderGeometry(a, a, b, 40).rotateX(Math.PI / 2);
    case 'capsule':
      return new THREE.CapsuleGeometry(a, b, 10, 28).rotateX(Math.PI / 2);
    case 'plane':
      return new THREE.PlaneGeometry(a, b);
    default:
      return shape.geometry === undefined ? null : triangles(run.geometries[shape.geometry], shape.kind === 'mesh');
  }
}

/** Heights as light and shade, valleys darker, ridges lighter, around the SDF's own colour; and a coordinate a metre for a grid. */
export function shadeByHeight(geometry, rgba) {
  geometry.computeBoundingBox();
  const { min, max } = geometry.boundingBox;
  const at = geometry.getAttribute('position');
  const colors = new Float32Array(at.count * 3);
  const grid = new Float32Array(at.count * 2);
  const base = new THREE.Color().setRGB(rgba[0], rgba[1], rgba[2], THREE.SRGBColorSpace);
  const color = new THREE.Color();
  for (let i = 0; i < at.count; ++i) {
    const part = max.z > min.z ? (at.getZ(i) - min.z) / (max.z - min.z) : 0.5;
    color.copy(base).multiplyScalar(0.72 + 0.5 * part);
    colors.set([color.r, color.g, color.b], 3 * i);
    grid.set([at.getX(i), at.getY(i)], 2 * i);
  }
  geometry.setAttribute('color', new THREE.BufferAttribute(colors, 3));
  geometry.setAttribute('uv', new THREE.BufferAttribute(grid, 2));
}

export function materialOf(shape) {
  const [r, g, b, alpha] = shape.rgba;
  const color = new THREE.Color().setRGB(r, g, b, THREE.SRGBColorSpace);
  const terrain = shape.kind === 'heightmap';
  return new THREE.MeshStandardMaterial({
    color: terrain ? 0xffffff : color,
    vertexColors: terrain,
    roughness: terrain ? 0.95 : 0.5,
    metalness: 0.04,
    transparent: alpha < 1,
    opacity: alpha,
    side: shape.kind === 'mesh' || terrain ? THREE.DoubleSide : THREE.FrontSide,
  });
}

export function place(object, pose) {
  object.position.set(pose[0], pose[1], pose[2]);
  object.quaternion.set(pose[4], pose[5], pose[6], pose[3]);
}
