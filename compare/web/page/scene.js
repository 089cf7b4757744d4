// Tosses in 3D, side by side: gold with an H is heads, blue with a T is tails, as in the films.

import * as THREE from "./three.module.min.js";
import { colorOf, dispose, drawOn, light, poseAt } from "./posed.js";

const TRAIL = "#7d8894", PIN = "#d6006c";
const FAINT = 0.35; // of the path that is still to come
const NEAR = 7.5, BOUNCES = 11; // radii to the coin in the close view: where it lies, and where it bounces
const LOW = 5; // radii: below such a height the close view hardly follows the coin up and down
const DOWN = [0.42, 0.75]; // how far the close view looks down: near the floor, and how much more high above it [rad]
const MOST = 0.16; // the coin is at most so far above the middle of the close view, so that all of it is seen [rad]

export function makeScene(canvas) {
  const renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true });
  renderer.setScissorTest(true);
  let panels = [], looks = "close", turn = -0.5, drag = null;

  function show(tosses) {
    for (const panel of panels) dispose(panel?.scene);
    panels = tosses.map((toss) => (toss?.path ? makePanel(toss, tosses) : null));
    recolor();
  }

  function makePanel(toss, tosses) {
    const scene = new THREE.Scene(), r = toss.coin.radius, half = toss.coin.thickness / 2;
    light(scene, 2.6, 1.4);
    const coin = new THREE.Group(), body = new THREE.Group();
    const side = new THREE.MeshStandardMaterial({ color: "#9aa1ab", roughness: 0.45, metalness: 0.3 });
    const shape = new THREE.CylinderGeometry(r, r, 2 * half, 72).rotateX(Math.PI / 2);
    body.add(new THREE.Mesh(shape, [side, faceMaterial("#f5ab1f", "#2a1a00", "H"), faceMaterial("#0d5ca8", "#ffffff", "T")]));
    body.position.set(...toss.coin.center.map((part) => -part));
    coin.add(body);
    // A pin along the normal through the mass centre, where that lies aside.
    if (Math.hypot(...toss.coin.center.slice(0, 2)) > 1e-3 * r) {
      const pin = new THREE.CylinderGeometry(0.035 * r, 0.035 * r, 2 * half + 0.06 * r, 12).rotateX(Math.PI / 2);
      const place = new THREE.Mesh(pin, new THREE.MeshBasicMaterial({ color: PIN }));
      place.position.z = -toss.coin.center[2];
      coin.add(place);
    }
    coin.add(...turningAxis(r, half));
    scene.add(coin);

    // Light from straight above: the shadow is the coin, pressed flat.
    const shadow = new THREE.Mesh(shape, new THREE.MeshBasicMaterial({ depthWrite: false, side: THREE.DoubleSide }));
    shadow.matrixAutoUpdate = shadow.frustumCulled = false;
    scene.add(shadow);

    const box = boxOf(tosses.filter((one) => one?.path), r);
    const tile = Math.max(2 * r, box.size / 12);
    const wide = 2 * tile * Math.ceil(Math.max(box.wide + 6 * r, 16 * r, box.high / 2) / (2 * tile));
    const checks = new THREE.CanvasTexture(document.createElement("canvas"), undefined, THREE.RepeatWrapping, THREE.RepeatWrapping, THREE.NearestFilter);
    checks.repeat.set(wide / tile / 2, wide / tile / 2);
    Object.assign(checks, { colorSpace: THREE.SRGBColorSpace, anisotropy: 4 });
    const edge = new THREE.MeshBasicMaterial(), top = new THREE.MeshBasicMaterial({ map: checks }), thick = tile / 4;
    const floor = new THREE.Mesh(new THREE.BoxGeometry(wide, wide, thick), [edge, edge, edge, edge, top, edge]);
    floor.position.set(box.middle.x, box.middle.y, -0.03 * r - thick / 2);
    scene.add(floor);

    const path = new THREE.BufferAttribute(new Float32Array(toss.path.position), 3);
    const [trail] = [1, FAINT].map((opacity) => {
      const line = new THREE.Line(new THREE.BufferGeometry().setAttribute("position", path), new THREE.LineBasicMaterial({ color: TRAIL, transparent: true, opacity }));
      line.frustumCulled = false;
      scene.add(line);
      return line;
    });
    const camera = new THREE.PerspectiveCamera(35, 1, r / 2, 8 * (box.size + wide));
    return { scene, coin, body, shadow, checks, edge, trail, toss, box, r, camera, highest: highestAfter(toss.path) };
  }

  function recolor() {
    const colors = ["--floor-light", "--floor-dark", "--shadow"].map(colorOf);
    for (const panel of panels.filter(Boolean)) {
      const image = panel.checks.image, pen = image.getContext("2d");
      image.width = image.height = 2;
      for (const [i, j] of [[0, 0], [0, 1], [1, 0], [1, 1]]) {
        pen.fillStyle = `#${colors[(i + j) % 2].getHexString()}`;
        pen.fillRect(i, j, 1, 1);
      }
      panel.checks.needsUpdate = true;
      panel.shadow.material.color = colors[2];
      panel.edge.color = colors[2];
    }
  }

  function draw(time) {
    drawOn(renderer, canvas, (width, height) => panels.forEach((panel, i) => {
      const part = width / panels.length;
      renderer.setViewport(i * part, 0, part, height);
      renderer.setScissor(i * part, 0, part - (i < panels.length - 1 ? 1 : 0), height);
      renderer.clear();
      if (!panel) return;
      pose(panel, time);
      aim(panel, part / height);
      renderer.render(panel.scene, panel.camera);
    }));
  }

  function pose(panel, time) {
    const { position, attitude, at, next, part } = poseAt(panel.toss.path, time);
    panel.coin.position.copy(position);
    panel.coin.quaternion.copy(attitude);
    panel.coin.updateMatrixWorld(true);
    panel.shadow.matrix.makeScale(1, 1, 0).multiply(panel.body.matrixWorld);
    panel.trail.geometry.setDrawRange(0, at + 1);
    panel.still = panel.highest[at] + part * (panel.highest[next] - panel.highest[at]);
  }

  function aim(panel, aspect) {
    const { camera } = panel, { target, far, up, down } = looks === "whole" ? wholeView(panel, aspect) : closeView(panel, aspect);
    camera.aspect = aspect;
    camera.up.set(0, 0, 1);
    camera.position.set(
      target.x + far * Math.cos(up) * Math.sin(turn), target.y - far * Math.cos(up) * Math.cos(turn), target.z + far * Math.sin(up));
    const ahead = new THREE.Vector3(-Math.cos(down) * Math.sin(turn), Math.cos(down) * Math.cos(turn), -Math.sin(down));
    camera.lookAt(ahead.add(camera.position));
    camera.updateProjectionMatrix();
  }

  canvas.addEventListener("pointerdown", (event) => {
    drag = { x: event.clientX, turn };
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => (turn = drag ? drag.turn - (event.clientX - drag.x) / 120 : turn));
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, () => (drag = null));
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", recolor);
  return { show, draw, look: (how) => (looks = how) };
}

function wholeView({ box, r }, aspect) {
  const up = 0.26;
  return { target: box.middle, far: 1.9 * Math.max(box.high + 3 * r, box.wide / aspect) + box.wide / 2, up, down: up };
}

// Coin and floor are both in sight. Near the floor the camera stands nearly still, so that the coin is seen to bounce;
// from high above it looks down, past the coin, on the place where it will fall.
function closeView({ coin, r, still }, aspect) {
  const { x, y, z } = coin.position, lift = (z * z) / (z + LOW * r);
  const up = DOWN[0] + (DOWN[1] * lift) / (lift + LOW * r);
  const far = r * (NEAR + (BOUNCES - NEAR) * Math.min(still / (LOW * r), 1)) * Math.max(1, 0.65 / aspect);
  const along = far * Math.cos(up), above = lift + far * Math.sin(up);
  const [toCoin, toFloor] = [above - z, above].map((fall) => Math.atan2(fall, along));
  return { target: new THREE.Vector3(x, y, lift), far, up, down: Math.min((toCoin + toFloor) / 2, toCoin + MOST) };
}

// How high the coin will still be, at each sample of a path.
function highestAfter({ time, position }) {
  const highest = new Float64Array(time.length);
  for (let k = time.length - 1, most = 0; k >= 0; k--) highest[k] = most = Math.max(most, position[3 * k + 2]);
  return highest;
}

// What both paths need together.
function boxOf(tosses, r) {
  const low = [Infinity, Infinity, 0], high = [-Infinity, -Infinity, 0];
  for (const { path } of tosses) {
    path.position.forEach((value, k) => {
      low[k % 3] = Math.min(low[k % 3], value);
      high[k % 3] = Math.max(high[k % 3], value);
    });
  }
  const wide = Math.hypot(high[0] - low[0], high[1] - low[1]) + 4 * r, tall = high[2] - low[2] + 2 * r;
  const middle = new THREE.Vector3(...low.map((value, k) => (value + high[k]) / 2));
  return { middle, wide, high: tall, size: Math.max(wide, tall) };
}

// The diameter η about which the coin turns over, and its letter: beside the coin, for over a T it would make an H.
function turningAxis(r, half) {
  const rod = (side) => new THREE.CylinderGeometry(0.025 * r, 0.025 * r, 0.25 * r, 8).translate(0, 1.125 * side * r, 0);
  const rods = [-1, 1].map((side) => new THREE.Mesh(rod(side), new THREE.MeshBasicMaterial({ color: TRAIL })));
  const image = Object.assign(document.createElement("canvas"), { width: 64, height: 64 }), pen = image.getContext("2d");
  Object.assign(pen, { font: "bold 46px serif", textAlign: "center", textBaseline: "middle", lineWidth: 8, strokeStyle: "#fff", fillStyle: "#2a333d" });
  pen.strokeText("η", 32, 30);
  pen.fillText("η", 32, 30);
  const letter = new THREE.Sprite(new THREE.SpriteMaterial({ map: new THREE.CanvasTexture(image) }));
  letter.scale.setScalar(0.5 * r);
  letter.position.set(0, 1.45 * r, half);
  return [...rods, letter];
}

function faceMaterial(color, ink, letter) {
  const size = 256, image = Object.assign(document.createElement("canvas"), { width: size, height: size }), pen = image.getContext("2d");
  pen.fillStyle = color;
  pen.fillRect(0, 0, size, size);
  Object.assign(pen, { strokeStyle: ink, fillStyle: ink, globalAlpha: 0.35, lineWidth: 5 });
  pen.beginPath();
  pen.arc(size / 2, size / 2, 0.46 * size, 0, 2 * Math.PI);
  pen.stroke();
  pen.globalAlpha = 1;
  const bar = 0.1 * size;
  const bars = letter === "H" ? [[-0.22, -0.25, 1, 5], [0.12, -0.25, 1, 5], [-0.22, -0.05, 4, 1]] : [[-0.22, -0.25, 4.4, 1], [-0.05, -0.25, 1, 5]];
  for (const [x, y, wide, high] of bars) pen.fillRect((0.5 + x) * size, (0.5 + y) * size, wide * bar, high * bar);
  const texture = new THREE.CanvasTexture(image);
  texture.colorSpace = THREE.SRGBColorSpace;
  return new THREE.MeshStandardMaterial({ map: texture, roughness: 0.5, metalness: 0.1 });
}
