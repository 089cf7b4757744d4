// A hundred coins in 3D, side by side in ten rows, each with a rim of its own colour.

import * as THREE from "./three.module.min.js";
import { colorOf, dispose, drawOn, light, poseAt } from "./posed.js";

const COLUMNS = 10, APART = 2.7; // between two coins, in radii
const STEPS = 200, SLANT = 0.55; // times at which the camera knows how high the coins still come; its slant [rad]
const HEADS = "#f5ab1f", TAILS = "#0d5ca8";

// The hue of each coin, as its row of the strip has it.
export const hueOf = (i, count) => `hsl(${Math.round((300 * i) / count)}, 85%, 48%)`;

// Returns what shows tosses and draws them at a time. Throws where there is no WebGL.
export function makeCrowd(canvas) {
  const renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true });
  const pose = new THREE.Object3D(), center = new THREE.Vector3();
  let tosses = [], parts = [], scene = null, camera = null, view = null;

  function show(found) {
    dispose(scene);
    for (const part of parts) part.dispose();
    tosses = found;
    const { radius: r, thickness } = tosses[0].coin, count = tosses.length;
    const side = new THREE.CylinderGeometry(1.04 * r, 1.04 * r, Math.max(thickness, 0.2 * r), 32, 1, true).rotateX(Math.PI / 2);
    const disc = (turned) => new THREE.CircleGeometry(r, 32).rotateX(turned ? Math.PI : 0).translate(0, 0, (turned ? -0.5 : 0.5) * thickness);
    const material = (color, more = {}) => new THREE.MeshStandardMaterial({ color, roughness: 0.6, ...more });
    parts = [[side, material("#ffffff", { side: THREE.DoubleSide })], [disc(false), material(HEADS)], [disc(true), material(TAILS)]].map(([shape, skin]) => {
      const part = new THREE.InstancedMesh(shape, skin, count);
      part.frustumCulled = false;
      return part;
    });
    for (let i = 0; i < count; i++) parts[0].setColorAt(i, new THREE.Color(hueOf(i, count)));
    scene = new THREE.Scene();
    const wide = COLUMNS * APART * r, tops = heightsToCome(tosses), top = tops[0];
    const floor = new THREE.Mesh(new THREE.PlaneGeometry(1.1 * wide, 1.1 * wide), new THREE.MeshBasicMaterial({ color: colorOf("--floor-dark") }));
    floor.position.z = -0.06 * r;
    light(scene, 2.4, 1.2);
    scene.add(floor, ...parts);
    camera = new THREE.PerspectiveCamera(32, 1, r, 40 * (wide + top));
    view = { wide, tops, end: Math.max(...tosses.map(({ path }) => path.time.at(-1))), least: 4 * r };
  }

  function draw(time) {
    if (!scene) return;
    drawOn(renderer, canvas, (width, height) => {
      tosses.forEach((toss, i) => place(toss, i, time));
      for (const part of parts) part.instanceMatrix.needsUpdate = true;
      aim(width / height, time);
      renderer.render(scene, camera);
    });
  }

  function place({ path, coin }, i, time) {
    const { position: { x, y, z }, attitude } = poseAt(path, time), gap = APART * coin.radius;
    pose.quaternion.copy(attitude);
    // The path is that of the mass centre.
    center.set(...coin.center.map((each) => -each)).applyQuaternion(pose.quaternion);
    const column = (i % COLUMNS) - (COLUMNS - 1) / 2, row = Math.floor(i / COLUMNS) - (COLUMNS - 1) / 2;
    pose.position.set(column * gap + x - path.position[0], row * gap + y - path.position[1], z).add(center);
    pose.updateMatrix();
    for (const each of parts) each.setMatrixAt(i, pose.matrix);
  }

  // From in front, at a slant, so that all of the floor and of what is still to come is seen.
  function aim(aspect, time) {
    const { wide, tops, end, least } = view, place = (time / end) * (tops.length - 1), at = Math.min(Math.floor(place), tops.length - 2);
    const top = Math.max(tops[at] + (place - at) * (tops[at + 1] - tops[at]), least), half = Math.tan((camera.fov * Math.PI) / 360);
    const far = 0.5 * Math.max((1.1 * wide) / aspect, wide * Math.sin(SLANT) + (top + least) * Math.cos(SLANT)) / half + wide / 2;
    camera.aspect = aspect;
    camera.position.set(0, -far * Math.cos(SLANT), top / 2 + far * Math.sin(SLANT));
    camera.lookAt(0, 0, top / 2);
    camera.updateProjectionMatrix();
  }

  return { show, draw };
}

// The greatest height of any coin from each of evenly spread times on.
function heightsToCome(tosses) {
  const end = Math.max(...tosses.map(({ path }) => path.time.at(-1))), tops = new Array(STEPS + 1).fill(0);
  for (const { path } of tosses) path.time.forEach((time, k) => {
    const at = Math.min(Math.floor((time / end) * STEPS), STEPS);
    tops[at] = Math.max(tops[at], path.position[3 * k + 2]);
  });
  for (let at = STEPS - 1; at >= 0; at--) tops[at] = Math.max(tops[at], tops[at + 1]);
  return tops;
}
