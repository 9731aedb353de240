// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// engine::Shape → three.js. SDF's axes: z up, cylinders and capsules along z, planes facing z.
import * as THREE from 'three';
import { RoundedBoxGeometry } from 'three/examples/jsm/geometries/RoundedBoxGeometry.js';
import { mergeGeometries } from 'three/examples/jsm/utils/BufferGeometryUtils.js';
import { gridTexture, kTerrainGrid } from './scenery.js';

function triangles({ vertices, indices }, flat) {
  let geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(vertices, 3));
  if (indices.length) geometry.setIndex(new THREE.BufferAttribute(indices, 1));
  if (flat && geometry.index) geometry = geometry.toNonIndexed();
  geometry.computeVertexNormals();
  return geometry;
}

// Pieces that round shapes are made of.
const kFine = { sphere: [32, 20], cylinder: 40, capsule: [10, 28], edge: 0.07 };
const kCoarse = { sphere: [14, 9], cylinder: 14, capsule: [4, 12], edge: 0 };

/**
 * Null where there is nothing to draw (a mesh without triangles). The geometry is in the shape's frame, meshes' in the link's. `coarse`:
 * a seventh of a snake's triangles, for machines that draw with the processor.
 */
export function geometryOf(shape, run, still, coarse = false) {
  const [a, b, c] = shape.size;
  const pieces = coarse ? kCoarse : kFine;
  switch (shape.kind) {
    case 'box': {
      // Edges that catch a little light make parts readable; terrain stays exact.
      const edge = still ? 0 : Math.min(a, b, c) * pieces.edge;
      return edge > 0 ? new RoundedBoxGeometry(a, b, c, 2, edge) : new THREE.BoxGeometry(a, b, c);
    }
    case 'sphere':
      return new THREE.SphereGeometry(a, ...pieces.sphere);
    case 'cylinder':
      return new THREE.CylinderGeometry(a, a, b, pieces.cylinder).rotateX(Math.PI / 2);
    case 'capsule':
      return new THREE.CapsuleGeometry(a, b, ...pieces.capsule).rotateX(Math.PI / 2);
    case 'plane':
      return new THREE.PlaneGeometry(a, b);
    default:
      return shape.geometry === undefined ? null : triangles(run.geometries[shape.geometry], shape.kind === 'mesh');
  }
}

/** Heights as light and shade, valleys darker, ridges lighter, around the SDF's own colour; and a coordinate a metre for a grid. */
function shadeByHeight(geometry, rgba) {
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

/** Of a mesh whose vertices carry the colour. */
function materialOf(shape) {
  const alpha = shape.rgba[3];
  const terrain = shape.kind === 'heightmap';
  return new THREE.MeshStandardMaterial({
    vertexColors: true,
    roughness: terrain ? 0.95 : 0.5,
    metalness: 0.04,
    transparent: alpha < 1,
    opacity: alpha,
    side: shape.kind === 'mesh' || terrain ? THREE.DoubleSide : THREE.FrontSide,
  });
}

/** A geometry as mergeGeometries() wants it: in the link's frame, indexed, with position, normal and the shape's colour only. */
function partOf(shape, geometry) {
  for (const name of Object.keys(geometry.attributes)) {
    if (name !== 'position' && name !== 'normal') geometry.deleteAttribute(name);
  }
  const count = geometry.getAttribute('position').count;
  if (!geometry.index) geometry.setIndex([...Array(count).keys()]);
  geometry.clearGroups();
  // Triangles come in the link's frame already.
  if (shape.geometry === undefined) {
    const frame = new THREE.Object3D();
    place(frame, shape.pose);
    frame.updateMatrix();
    geometry.applyMatrix4(frame.matrix);
  }
  const [r, g, b] = shape.rgba;
  const color = new THREE.Color().setRGB(r, g, b, THREE.SRGBColorSpace);
  const colors = new Float32Array(3 * count);
  for (let i = 0; i < count; ++i) color.toArray(colors, 3 * i);
  geometry.setAttribute('color', new THREE.BufferAttribute(colors, 3));
  return geometry;
}

/** Meshes of [{shape, geometry}] of one link: as few as their materials allow, as each is a call to the graphics card. */
export function meshesOf(parts, coarse) {
  const alike = new Map();
  const meshes = [];
  for (const { shape, geometry } of parts) {
    if (shape.kind === 'heightmap') {
      shadeByHeight(geometry, shape.rgba);
      const mesh = new THREE.Mesh(geometry, materialOf(shape));
      mesh.material.map = gridTexture(kTerrainGrid);
      if (shape.geometry === undefined) place(mesh, shape.pose);
      mesh.castShadow = !coarse; // a terrain has many triangles, and its shading shows its slopes
      meshes.push(mesh);
      continue;
    }
    const key = [shape.kind === 'mesh', shape.kind === 'plane', shape.rgba[3]].join();
    if (!alike.has(key)) alike.set(key, []);
    alike.get(key).push({ shape, geometry });
  }
  for (const same of alike.values()) {
    const { shape } = same[0];
    const whole = mergeGeometries(same.map((part) => partOf(part.shape, part.geometry)));
    const mesh = new THREE.Mesh(whole, materialOf(shape));
    mesh.castShadow = shape.kind !== 'plane';
    meshes.push(mesh);
  }
  return meshes;
}

export function place(object, pose) {
  object.position.set(pose[0], pose[1], pose[2]);
  object.quaternion.set(pose[4], pose[5], pose[6], pose[3]);
}
