// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Sky, light and ground.
import * as THREE from 'three';
import { RoomEnvironment } from 'three/examples/jsm/environments/RoomEnvironment.js';
import { scenery } from './palette.js';

const kGroundRadius = 120;
const kCoarseAnisotropy = 2;
const kPlainSky = 1.9; // light from the sky in place of the reflections
export const kExposure = 1.15;

/** One metre of ground: a line a metre, fainter ones each quarter. */
export function gridTexture(colors, anisotropy = 16) {
  const n = 512;
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = n;
  const g = canvas.getContext('2d');
  g.fillStyle = typeof colors.ground === 'string' ? colors.ground : '#' + new THREE.Color(colors.ground).getHexString();
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
  texture.anisotropy = anisotropy;
  return texture;
}

/** As the renderer's neutral tone mapping and its colour space make it, below where that begins to compress. */
function shown(color) {
  const c = color.clone().multiplyScalar(kExposure);
  const least = Math.min(c.r, c.g, c.b);
  const offset = least < 0.08 ? least - 6.25 * least * least : 0.04;
  return new THREE.Color(c.r - offset, c.g - offset, c.b - offset).convertLinearToSRGB();
}

/** A level ground under one sun and an even sky: its light is worked out once, not in each pixel. */
function flatGroundMaterial() {
  return new THREE.ShaderMaterial({
    lights: true,
    fog: true,
    uniforms: THREE.UniformsUtils.merge([
      THREE.UniformsLib.lights,
      THREE.UniformsLib.fog,
      { map: { value: null }, repeat: { value: 1 }, shade: { value: new THREE.Color() } },
    ]),
    vertexShader: `varying vec2 at; uniform float repeat;
      #include <common>
      #include <fog_pars_vertex>
      #include <shadowmap_pars_vertex>
      void main() {
        at = uv * repeat;
        #include <beginnormal_vertex>
        #include <defaultnormal_vertex>
        #include <begin_vertex>
        #include <project_vertex>
        #include <worldpos_vertex>
        #include <shadowmap_vertex>
        #include <fog_vertex>
      }`,
    fragmentShader: `varying vec2 at; uniform sampler2D map; uniform vec3 shade;
      #include <common>
      #include <packing>
      #include <fog_pars_fragment>
      #include <lights_pars_begin>
      #include <shadowmap_pars_fragment>
      #include <shadowmask_pars_fragment>
      void main() {
        gl_FragColor = vec4(texture2D(map, at).rgb * mix(shade, vec3(1.0), getShadowMask()), 1.0);
        #include <fog_fragment>
      }`,
  });
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
  dome.renderOrder = 1; // after what hides it: each covered pixel saves its work
  dome.frustumCulled = false;
  return dome;
}

/** Drawn over a terrain's own colour. */
export const kTerrainGrid = { ground: 0xffffff, line: '#b4b4b4', minor: '#dcdcdc' };

export class Scenery {
  /** `size`: about how far the robot reaches, m; shadows are drawn that far around it. `coarse`: nothing is reflected. */
  constructor(renderer, scene, size, coarse = false) {
    this.size = size;
    this.coarse = coarse;
    this.skyLight = coarse ? kPlainSky : 1;
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
    if (!coarse) {
      const room = new THREE.PMREMGenerator(renderer);
      scene.environment = room.fromScene(new RoomEnvironment(), 0.04).texture;
      room.dispose();
    }
    scene.add(this.sky, this.hemisphere, this.sun, this.sun.target);
    this.scene = scene;
    this.grounds = [];
  }

  /** A level plane of the world: drawn to the horizon, with its grid. */
  ground(parent) {
    const material = this.coarse ? flatGroundMaterial() : new THREE.MeshStandardMaterial({ roughness: 0.96 });
    const mesh = new THREE.Mesh(new THREE.CircleGeometry(kGroundRadius, 64), material);
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
    this.hemisphere.intensity = c.sky * this.skyLight;
    this.sun.intensity = c.sun;
    this.scene.environmentIntensity = c.room;
    for (const mesh of this.grounds) this.paintGround(mesh.material, c);
  }

  paintGround(material, c) {
    const repeat = 2 * kGroundRadius;
    if (!this.coarse) {
      material.map?.dispose();
      material.map = gridTexture(c);
      material.map.repeat.set(repeat, repeat);
      material.needsUpdate = true;
      return;
    }
    const part = (color, intensity) => color.clone().multiplyScalar(intensity / Math.PI);
    // The hemisphere's pole is y: a level ground sees half of each.
    const sky = part(this.hemisphere.color.clone().lerp(this.hemisphere.groundColor, 0.5), this.hemisphere.intensity);
    const all = part(this.sun.color, (this.sun.intensity * this.offset.z) / this.offset.length()).add(sky);
    const lit = (color, light) => shown(new THREE.Color(color).multiply(light));
    const ground = lit(c.ground, all);
    const shaded = lit(c.ground, sky);
    const { map, shade, repeat: times } = material.uniforms;
    const style = (color) => `rgb(${color.toArray().map((v) => Math.round(255 * v)).join()})`;
    map.value?.dispose();
    map.value = gridTexture({ ground: style(ground), line: style(lit(c.line, all)), minor: style(lit(c.minor, all)) }, kCoarseAnisotropy);
    map.value.colorSpace = THREE.NoColorSpace;
    shade.value.setRGB(shaded.r / ground.r, shaded.g / ground.g, shaded.b / ground.b);
    times.value = repeat;
  }

  /** Without reflections the sky lights more. */
  withoutReflections() {
    this.scene.environment = null;
    this.skyLight = kPlainSky;
    this.paint();
  }

  /** Light and sky go with what is watched. */
  follow(centre, camera) {
    this.sun.target.position.copy(centre);
    this.sun.position.copy(centre).add(this.offset);
    this.sky.position.copy(camera.position);
  }
}
