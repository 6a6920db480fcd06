// Floor, light and frames: what everything else stands in.

import {
  CylinderGeometry, DirectionalLight, GridHelper, Group, HemisphereLight, LineBasicMaterial, Mesh,
  MeshBasicMaterial, Object3D, PlaneGeometry, ShadowMaterial,
} from "three";
import { AXES } from "../palette";
import type { Extent } from "./extent";
import type { Look } from "./look";

/** Side of a shadow's picture [px]. */
const SHADOW = 1024;

export class Room {
  readonly object = new Group();
  private readonly lines = new LineBasicMaterial({ transparent: true });
  private readonly shadow = new ShadowMaterial({ transparent: true, depthWrite: false });
  private readonly ground: Mesh;
  private readonly sun: DirectionalLight;

  constructor({ middle, radius, floor }: Extent) {
    const step = radius > 2 ? 0.5 : 0.1;
    const half = Math.ceil((1.7 * radius) / step) * step;
    const grid = new GridHelper(2 * half, Math.round((2 * half) / step));
    (grid.material as LineBasicMaterial).dispose();
    grid.material = this.lines;
    this.lines.vertexColors = false;
    grid.rotation.x = Math.PI / 2;
    // Lines are where coordinates are round.
    const round = (value: number) => Math.round(value / step) * step;
    grid.position.set(round(middle.x), round(middle.y), floor);
    const ground = (this.ground = new Mesh(new PlaneGeometry(4 * half, 4 * half), this.shadow));
    ground.position.set(grid.position.x, grid.position.y, floor - 1e-3);
    ground.receiveShadow = true;
    // What is seen through is seen before the floor.
    [grid.renderOrder, ground.renderOrder] = [-1, -2];
    this.sun = sun(middle.toArray(), radius);
    this.object.add(grid, ground, this.sun, this.sun.target, ...lights(middle.toArray(), radius));
  }

  paint(look: Look): void {
    this.lines.color.set(look.grid);
    this.shadow.opacity = look.shadow;
  }

  /** Whether things throw shadows. */
  throwShadows(are: boolean): void {
    this.sun.castShadow = are;
    this.ground.visible = are;
  }
}

type Point = readonly [number, number, number];

/** The one light that throws shadows. */
function sun([x, y, z]: Point, radius: number): DirectionalLight {
  const sun = new DirectionalLight(0xffffff, 2.1);
  sun.position.set(x + 0.8 * radius, y - 1.1 * radius, z + 2.6 * radius);
  sun.target.position.set(x, y, z);
  sun.castShadow = true;
  sun.shadow.mapSize.set(SHADOW, SHADOW);
  sun.shadow.radius = 5;
  sun.shadow.bias = -5e-4;
  sun.shadow.normalBias = 0.01 * radius;
  const camera = sun.shadow.camera;
  camera.left = camera.bottom = -1.5 * radius;
  camera.right = camera.top = 1.5 * radius;
  camera.near = 0.1 * radius;
  camera.far = 7 * radius;
  return sun;
}

function lights([x, y, z]: Point, radius: number): Object3D[] {
  const sky = new HemisphereLight(0xffffff, 0xb8bec8, 1.7);
  sky.position.set(0, 0, 1);
  const fill = new DirectionalLight(0xffffff, 0.5);
  fill.position.set(x - 2 * radius, y + radius, z + radius);
  fill.target.position.set(x, y, z);
  return [sky, fill, fill.target];
}

/** A frame: its x, y and z axis. */
export function triad(length: number): Group {
  const group = new Group();
  AXES.forEach((colour, axis) => {
    const bar = new Mesh(
      new CylinderGeometry(0.026 * length, 0.026 * length, length, 16).translate(0, length / 2, 0),
      new MeshBasicMaterial({ color: colour }),
    );
    if (axis === 0) bar.rotation.z = -Math.PI / 2;
    if (axis === 2) bar.rotation.x = Math.PI / 2;
    group.add(bar);
  });
  return group;
}
