// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Sky, light and ground.
import * as THREE from 'three';
import { RoomEnvironment } from 'three/examples/jsm/environments/RoomEnvironment.js';
import { scenery } from './palette.js';

const kGroundRadius = 120;

/** One metre of ground: a line a metre, fainter ones each quarter. */
export function gridTexture(colors) {
  const n = 512;
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = n;
  const g = canvas.getContext('2d');
  g.fillStyle = '#' + new THREE.Color(colors.ground).getHexString();
  g.fillRect(0, 0, n, n);
  for (let i = 0; i < 4; ++i) {
    g.strokeStyle = i === 0 ? colors.line : colors.minor;
    g.lineWidth = i === 0 ? 5 : 3;
    const at = (i * n) / 4;
    for (const edge of i === 0 ? [0, n] : [at]) {
      g.beginPath();
      g.moveTo(edge, 0);
      g.lineTo(edge, n);
      g.moveTo(0, edge);
      g.lineTo(n, edge);
      g.stroke();
    }
  }
  const texture = new THREE.CanvasTexture(canvas);
  texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
  texture.colorSpace = THREE.SRGBColorSpace;
  texture.anisotropy = 16;
  return texture;
}

function skyDome() {
  const material = new THREE.ShaderMaterial({
    side: THREE.BackSide,
    depthWrite: false,
    fog: false,
    uniforms: { zenith: { value: new THREE.Color() }, horizon: { value: new THREE.Color() } },
    vertexShader: 'varying vec3 d; void main() { d = position; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }',
    fragmentShader: `varying vec3 d; uniform vec3 zenith, horizon;
      void main() {
        float up = clamp(normalize(d).z, 0.0, 1.0);
        gl_FragColor = vec4(mix(horizon, zenith, pow(up, 0.55)), 1.0);
        #include <colorspace_fragment>
      }`,
  });
  const dome = new THREE.Mesh(new THREE.SphereGeometry(400, 32, 24), material);
  dome.renderOrder = -1;
  dome.frustumCulled = false;
  return dome;
}

/** Drawn over a terrain's own colour. */
export const kTerrainGrid = { ground: 0xffffff, line: '#b4b4b4', minor: '#dcdcdc' };

export class Scenery {
  /** `size`: about how far the robot reaches, m; shadows are drawn that far around it. */
  constructor(renderer, scene, size) {
    this.size = size;
    this.sky = skyDome();
    this.hemisphere = new THREE.HemisphereLight(0xf2f7ff, 0x77736c, 1);
    this.sun = new THREE.DirectionalLight(0xfff4e4, 2.5);
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(2048, 2048);
    const reach = Math.max(0.4, size * 1.6);
    Object.assign(this.sun.shadow.camera, { left: -reach, right: reach, top: reach, bottom: -reach, near: 0.05, far: reach * 8 });
    this.sun.shadow.normalBias = reach / 600;
    this.sun.shadow.radius = 5;
    this.offset = new THREE.Vector3(-0.7, -0.35, 1.15).multiplyScalar(reach * 2);
    this.fog = scene.fog = new THREE.Fog(0xffffff, 8, 60);
    const room = new THREE.PMREMGenerator(renderer);
    scene.environment = room.fromScene(new RoomEnvironment(), 0.04).texture;
    room.dispose();
    scene.add(this.sky, this.hemisphere, this.sun, this.sun.target);
    this.scene = scene;
    this.grounds = [];
  }

  /** A level plane of the world: drawn to the horizon, with its grid. */
  ground(parent) {
    const mesh = new THREE.Mesh(new THREE.CircleGeometry(kGroundRadius, 64), new THREE.MeshStandardMaterial({ roughness: 0.96 }));
    // A terrain that lies on the plane wins over it.
    Object.assign(mesh.material, { polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 4 });
    mesh.receiveShadow = true;
    parent.add(mesh);
    this.grounds.push(mesh);
  }

  paint() {
    const c = scenery();
    this.sky.material.uniforms.zenith.value.setHex(c.zenith);
    this.sky.material.uniforms.horizon.value.setHex(c.horizon);
    this.fog.color.setHex(c.horizon);
    this.hemisphere.intensity = c.sky;
    this.sun.intensity = c.sun;
    this.scene.environmentIntensity = c.room;
    for (const mesh of this.grounds) {
      mesh.material.map?.dispose();
      mesh.material.map = gridTexture(c);
      mesh.material.map.repeat.set(2 * kGroundRadius, 2 * kGroundRadius);
      mesh.material.needsUpdate = true;
    }
  }

  /** Light and sky go with what is watched. */
  follow(centre, camera) {
    this.sun.target.position.copy(centre);
    this.sun.position.copy(centre).add(this.offset);
    this.sky.position.copy(camera.position);
  }
}
