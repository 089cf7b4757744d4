// What scenes in 3D share: their colours and light, where a coin is at a time, and how they are left.

import * as THREE from "./three.module.min.js";
import { placeIn } from "./sampled.js";

export const colorOf = (name) => new THREE.Color(getComputedStyle(document.documentElement).getPropertyValue(name).trim());

export function light(scene, sky, lamp) {
  const sun = new THREE.DirectionalLight("#ffffff", lamp);
  sun.position.set(0.4, -1, 1.6);
  scene.add(new THREE.HemisphereLight("#ffffff", "#cfd6dd", sky), sun);
}

// Position of the mass centre and attitude at a time, between the samples `at` and `next`, and the part of the way between these.
export function poseAt(path, time) {
  const { at, part } = placeIn(path.time, time), next = Math.min(at + 1, path.time.length - 1);
  const vector = (k) => new THREE.Vector3().fromArray(path.position, 3 * k);
  // Scalar first, as everywhere in cointoss; three.js has it last.
  const attitude = (k) => new THREE.Quaternion(...[1, 2, 3, 0].map((each) => path.quaternion[4 * k + each])).normalize();
  return { position: vector(at).lerp(vector(next), part), attitude: attitude(at).slerp(attitude(next), part), at, next, part };
}

// Draws to a canvas as large as it is, if it is seen; `paint` gets its width and height.
export function drawOn(renderer, canvas, paint) {
  const { width, height } = canvas.getBoundingClientRect();
  if (!width || !height) return;
  renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
  renderer.setSize(width, height, false);
  renderer.setClearColor(colorOf("--sky"), 1);
  paint(width, height);
}

export function dispose(scene) {
  scene?.traverse((part) => {
    part.geometry?.dispose();
    for (const material of [part.material].flat().filter(Boolean)) {
      material.map?.dispose();
      material.dispose();
    }
  });
}
