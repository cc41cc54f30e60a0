// The body on the screen: triangles coloured by a table, its edges, a camera without perspective.

import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

import { colourTable } from "./colours";
import type { Grid } from "./grid";
import type { Range } from "./quantities";
import { surfaceOf, type Surface } from "./surface";

const COLOURS = 256;

function tableTexture(): THREE.DataTexture {
  const texture = new THREE.DataTexture(colourTable(COLOURS), COLOURS, 1);
  texture.colorSpace = THREE.SRGBColorSpace;
  texture.magFilter = THREE.LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

export class Stage {
  triangles = 0;
  private readonly renderer: THREE.WebGLRenderer;
  private readonly scene = new THREE.Scene();
  private readonly camera = new THREE.OrthographicCamera();
  private readonly controls: OrbitControls;
  private readonly mesh: THREE.Mesh<THREE.BufferGeometry, THREE.Material>;
  private readonly lines: THREE.LineSegments<THREE.BufferGeometry, THREE.LineBasicMaterial>;
  private surface: Surface | undefined;
  private shape: Int32Array | undefined; // the connectivity that `surface` is of
  private radius = 1; // of the body

  constructor(
    private readonly canvas: HTMLCanvasElement,
    inSpace: boolean,
  ) {
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true, preserveDrawingBuffer: true });
    const behindLines = { polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 };
    const colours = { map: tableTexture(), side: THREE.DoubleSide, ...behindLines };
    const material = inSpace ? new THREE.MeshLambertMaterial(colours) : new THREE.MeshBasicMaterial(colours);
    this.mesh = new THREE.Mesh(new THREE.BufferGeometry(), material);
    const faint = new THREE.LineBasicMaterial({ color: 0x202020, transparent: true, opacity: 0.35 });
    this.lines = new THREE.LineSegments(new THREE.BufferGeometry(), faint);
    this.mesh.frustumCulled = this.lines.frustumCulled = false;
    const light = new THREE.DirectionalLight(0xffffff, 1.5);
    light.position.set(0.4, 0.5, 1);
    this.camera.add(light);
    this.scene.add(this.camera, this.mesh, this.lines, new THREE.AmbientLight(0xffffff, 2));
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableRotate = inSpace;
    this.controls.mouseButtons.LEFT = inSpace ? THREE.MOUSE.ROTATE : THREE.MOUSE.PAN;
    this.controls.touches.ONE = inSpace ? THREE.TOUCH.ROTATE : THREE.TOUCH.PAN;
    this.controls.addEventListener("change", () => this.draw());
    new ResizeObserver(() => this.resize()).observe(canvas);
  }

  /** Looks at all these points, each array [n][3]. */
  lookAt(places: Float64Array[], inSpace: boolean): void {
    const box = new THREE.Box3();
    for (const points of places) {
      box.union(new THREE.Box3().setFromArray(points as unknown as number[]));
    }
    const centre = box.getCenter(new THREE.Vector3());
    this.radius = 0.5 * box.getSize(new THREE.Vector3()).length();
    const from = inSpace ? new THREE.Vector3(0.6, -1, 0.45) : new THREE.Vector3(0, 0, 1);
    this.camera.up.set(0, inSpace ? 0 : 1, inSpace ? 1 : 0);
    this.camera.position.copy(centre).addScaledVector(from.normalize(), 4 * this.radius);
    this.camera.near = 0;
    this.camera.far = 20 * this.radius;
    this.controls.target.copy(centre);
    this.controls.update();
    this.resize();
  }

  /** Colours by `values` of points or cells; `moved` [n][3] are the points where they are drawn. */
  show(grid: Grid, moved: Float64Array, values: Float64Array, onCells: boolean, range: Range): void {
    if (this.surface === undefined || this.shape !== grid.connectivity) {
      this.surface = surfaceOf(grid);
      this.shape = grid.connectivity;
    }
    const { points, cells, edges } = this.surface;
    this.triangles = cells.length;
    const width = range.high - range.low;
    const shade = (value: number) => (width > 0 ? Math.min(1, Math.max(0, (value - range.low) / width)) : 0.5);
    const positions = new Float32Array(3 * points.length);
    const places = new Float32Array(2 * points.length); // in the table of colours
    points.forEach((point, i) => {
      positions.set(moved.subarray(3 * point, 3 * point + 3), 3 * i);
      const value = shade(values[onCells ? cells[Math.floor(i / 3)] : point]);
      places[2 * i] = (value * (COLOURS - 1) + 0.5) / COLOURS;
      places[2 * i + 1] = 0.5;
    });
    const ends = new Float32Array(3 * edges.length);
    edges.forEach((point, i) => ends.set(moved.subarray(3 * point, 3 * point + 3), 3 * i));
    const geometry = this.mesh.geometry;
    geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
    geometry.setAttribute("uv", new THREE.BufferAttribute(places, 2));
    geometry.computeVertexNormals();
    this.lines.geometry.setAttribute("position", new THREE.BufferAttribute(ends, 3));
    this.draw();
  }

  showLines(visible: boolean): void {
    this.lines.visible = visible;
    this.draw();
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0 || height === 0) {
      return;
    }
    this.renderer.setPixelRatio(window.devicePixelRatio);
    this.renderer.setSize(width, height, false);
    const half = 1.15 * this.radius;
    const [x, y] = width > height ? [(half * width) / height, half] : [half, (half * height) / width];
    Object.assign(this.camera, { left: -x, right: x, bottom: -y, top: y });
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  private draw(): void {
    this.renderer.render(this.scene, this.camera);
  }
}
