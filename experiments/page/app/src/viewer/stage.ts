import { Color, DirectionalLight, HemisphereLight, MathUtils, PerspectiveCamera, Raycaster, Scene, Spherical, Vector2, Vector3, WebGLRenderer } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

import { onThemeChange, styleColour } from "../theme";
import type { MeshModel } from "./mesh_model";

export type Side = 0 | 1;
export const kSides: Side[] = [0, 1];

const kFieldOfView = 35; // degrees
const kFlightMilliseconds = 600;
const kKeyTurn = 8; // degrees
const kKeyZoom = 0.85;
/** Distance of the nearest and the farthest that is drawn, in distances of the camera from its target. */
const kNearest = 0.02;
const kGap = 2; // pixels between the panes

interface Flight {
  began: number;
  fromPosition: Vector3;
  fromTarget: Vector3;
  toPosition: Vector3;
  toTarget: Vector3;
}

/** Two panes side by side in one canvas, seen by one camera: what is turned in one is turned in the other. Draws only when something changed. */
export class Stage {
  private readonly renderer: WebGLRenderer;
  private readonly camera = new PerspectiveCamera(kFieldOfView);
  private readonly controls: OrbitControls;
  private readonly scenes: [Scene, Scene];
  /** Beside the camera, so that what is looked at is lit. */
  private readonly lamps = [new DirectionalLight(0xffffff, 1.6), new DirectionalLight(0xffffff, 1.6)] as const;
  private readonly models: [MeshModel | undefined, MeshModel | undefined] = [undefined, undefined];
  private flight: Flight | undefined;
  private isAskedFor = false;
  private radius = 1; // of what is shown

  /** \param onPick  called with the side and the triangle that was clicked. */
  constructor(
    private readonly box: HTMLElement,
    private readonly onPick: (side: Side, triangle: number) => void,
  ) {
    this.renderer = new WebGLRenderer({ antialias: true });
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    this.renderer.autoClear = false;
    this.scenes = [this.makeScene(this.lamps[0]), this.makeScene(this.lamps[1])];
    const canvas = this.renderer.domElement;
    canvas.tabIndex = 0;
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", "Two meshes side by side. Arrow keys turn them, plus and minus zoom, Home shows all.");
    box.append(canvas);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.zoomToCursor = false;
    this.controls.addEventListener("change", () => this.draw());
    this.controls.addEventListener("start", () => (this.flight = undefined));
    this.listen(canvas);
  }

  setModel(side: Side, model: MeshModel | undefined): void {
    const old = this.models[side];
    if (old) {
      this.scenes[side].remove(old.group);
      old.dispose();
    }
    this.models[side] = model;
    if (model) this.scenes[side].add(model.group);
    this.draw();
  }

  model(side: Side): MeshModel | undefined {
    return this.models[side];
  }

  /** Moves the camera so that a ball of `radius` around the origin is seen whole. */
  showAll(radius = this.radius): void {
    this.radius = radius;
    const distance = (1.05 * radius) / Math.sin(MathUtils.degToRad(kFieldOfView) / 2) / Math.min(1, this.camera.aspect);
    this.flight = undefined;
    this.controls.target.set(0, 0, 0);
    this.camera.position.copy(new Vector3(0.35, 0.3, 1).setLength(distance));
    this.controls.update();
    this.draw();
  }

  /** Flies to where `target` is seen from the direction of `normal`, `distance` away. */
  flyTo(target: Vector3, normal: Vector3, distance: number): void {
    this.flight = {
      began: performance.now(),
      fromPosition: this.camera.position.clone(),
      fromTarget: this.controls.target.clone(),
      toPosition: target.clone().addScaledVector(normal, distance),
      toTarget: target,
    };
    if (matchMedia("(prefers-reduced-motion: reduce)").matches) this.flight.began -= kFlightMilliseconds;
    this.draw();
  }

  /** Asks for a picture at the next frame. */
  draw(): void {
    if (this.isAskedFor) return;
    this.isAskedFor = true;
    requestAnimationFrame((now) => {
      this.isAskedFor = false;
      this.proceed(now);
      this.render();
    });
  }

  private makeScene(lamp: DirectionalLight): Scene {
    const scene = new Scene();
    scene.add(new HemisphereLight(0xffffff, 0xb4bac4, 2.2), lamp);
    return scene;
  }

  private listen(canvas: HTMLCanvasElement): void {
    new ResizeObserver(() => this.resize()).observe(this.box);
    onThemeChange(() => this.draw());
    canvas.addEventListener("keydown", (event) => this.onKey(event));
    let pressed = new Vector2();
    canvas.addEventListener("pointerdown", (event) => (pressed = new Vector2(event.clientX, event.clientY)));
    canvas.addEventListener("click", (event) => {
      if (pressed.distanceTo(new Vector2(event.clientX, event.clientY)) < 4) this.pick(event);
    });
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.box;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height);
    this.camera.aspect = width / 2 / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  private onKey(event: KeyboardEvent): void {
    const turns: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const turn = turns[event.key];
    if (turn) this.turn(turn[0] * kKeyTurn, turn[1] * kKeyTurn);
    else if (event.key === "+" || event.key === "=") this.zoom(kKeyZoom);
    else if (event.key === "-") this.zoom(1 / kKeyZoom);
    else if (event.key === "Home") this.showAll();
    else return;
    event.preventDefault();
  }

  private turn(horizontal: number, vertical: number): void {
    const place = new Spherical().setFromVector3(this.camera.position.clone().sub(this.controls.target));
    place.theta += MathUtils.degToRad(horizontal);
    place.phi += MathUtils.degToRad(vertical);
    this.camera.position.setFromSpherical(place.makeSafe()).add(this.controls.target);
    this.controls.update();
    this.draw();
  }

  zoom(factor: number): void {
    this.camera.position.sub(this.controls.target).multiplyScalar(factor).add(this.controls.target);
    this.controls.update();
    this.draw();
  }

  /** The flight's next step. */
  private proceed(now: number): void {
    if (!this.flight) return;
    const { began, fromPosition, fromTarget, toPosition, toTarget } = this.flight;
    const share = MathUtils.smoothstep(now - began, 0, kFlightMilliseconds);
    this.camera.position.lerpVectors(fromPosition, toPosition, share);
    this.controls.target.lerpVectors(fromTarget, toTarget, share);
    if (share >= 1) this.flight = undefined;
    this.controls.update();
    this.draw();
  }

  private render(): void {
    const { clientWidth: width, clientHeight: height } = this.box;
    const distance = this.camera.position.distanceTo(this.controls.target);
    this.camera.near = kNearest * distance;
    this.camera.far = distance + 4 * this.radius;
    this.camera.updateProjectionMatrix();
    const pixelsPerAngstrom = height / (2 * distance * Math.tan(MathUtils.degToRad(kFieldOfView) / 2));
    this.renderer.setScissorTest(true);
    for (const side of kSides) {
      const left = side === 0 ? 0 : width / 2 + kGap / 2;
      this.renderer.setViewport(left, 0, width / 2 - kGap / 2, height);
      this.renderer.setScissor(left, 0, width / 2 - kGap / 2, height);
      this.renderer.setClearColor(new Color(styleColour("--stage")));
      this.renderer.clear();
      this.lamps[side].position.copy(this.camera.position).sub(this.controls.target);
      this.models[side]?.fadeEdges(pixelsPerAngstrom);
      this.renderer.render(this.scenes[side], this.camera);
    }
  }

  private pick(event: MouseEvent): void {
    const rectangle = this.renderer.domElement.getBoundingClientRect();
    const half = rectangle.width / 2;
    const x = event.clientX - rectangle.left;
    const side: Side = x < half ? 0 : 1;
    const model = this.models[side];
    if (!model) return;
    const place = new Vector2((2 * (x - side * half)) / half - 1, 1 - (2 * (event.clientY - rectangle.top)) / rectangle.height);
    const ray = new Raycaster();
    ray.setFromCamera(place, this.camera);
    const hit = ray.intersectObject(model.surface)[0];
    if (hit?.faceIndex !== undefined && hit.faceIndex !== null) this.onPick(side, hit.faceIndex);
  }
}
