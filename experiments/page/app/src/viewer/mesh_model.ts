import {
  BufferAttribute,
  BufferGeometry,
  CanvasTexture,
  DoubleSide,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  Sprite,
  SpriteMaterial,
  Vector3,
} from "three";

import type { MeshFacts, WorstMeasure } from "../data";
import type { MeshArrays } from "../unpack";
import { type ColourMap, colourTable, tableOffset } from "./colour_map";
import { type TriangleMeasure, measureTriangle } from "./triangle_measures";

// The colours of the paper's Figure 4.
export const kPairColours = ["#e3000b", "#ffd500"] as const;
export const kHighlightColour = "#00b7ff";
const kEdgeColour = "#20242a";

// How strong edges are drawn, from those that merge into each other to those of so many pixels.
const kFaintestEdges = 0.08;
const kStrongestEdges = 0.55;
const kClearEdge = 14;
const kSampledTriangles = 2000;

/** The ring around a highlighted triangle, as a share of the picture's height. */
const kRingSize = 0.09;

/** Surface and edges lie in one place; the surface steps back, marks step forward. */
const kBehind = { polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 };
const kInFront = { polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -2 };

/** One mesh on the stage: its coloured surface, its edges, the marks of its intersecting pairs, and the triangles that are highlighted. */
export class MeshModel {
  readonly group = new Group();
  readonly surface: Mesh<BufferGeometry, MeshLambertMaterial>;
  private readonly edges: LineSegments<BufferGeometry, LineBasicMaterial>;
  private readonly edgeLength: number; // of many edges the mean, Å
  private readonly pairMarks = new Group();
  private readonly highlight = new Group();

  constructor(
    readonly arrays: MeshArrays,
    readonly facts: MeshFacts,
  ) {
    this.surface = new Mesh(cornerGeometry(arrays), new MeshLambertMaterial({ vertexColors: true, flatShading: true, side: DoubleSide, ...kBehind }));
    this.edges = new LineSegments(edgeGeometry(arrays), new LineBasicMaterial({ color: kEdgeColour, transparent: true }));
    this.edgeLength = meanEdgeLength(arrays);
    this.markPairs();
    this.group.add(this.surface, this.edges, this.pairMarks, this.highlight);
    for (const object of [this.surface, this.edges]) object.frustumCulled = false;
  }

  /** Edges fade where they are too close to be told apart. \param pixelsPerAngstrom  where the camera looks. */
  fadeEdges(pixelsPerAngstrom: number): void {
    const share = Math.min(1, (this.edgeLength * pixelsPerAngstrom) / kClearEdge);
    this.edges.material.opacity = kFaintestEdges + (kStrongestEdges - kFaintestEdges) * share;
  }

  showEdges(isShown: boolean): void {
    this.edges.visible = isShown;
  }

  showPairs(isShown: boolean): void {
    this.pairMarks.visible = isShown;
  }

  colour(measure: TriangleMeasure, map: ColourMap): void {
    const table = colourTable(map);
    const colours = this.surface.geometry.getAttribute("color") as BufferAttribute;
    const values = colours.array as Float32Array;
    for (let triangle = 0; triangle < this.facts.shown_triangles; ++triangle) {
      const value = measureTriangle(this.arrays, triangle, measure.id);
      const offset = tableOffset((measure.best - value) / (measure.best - measure.worst));
      for (let i = 0; i < 9; ++i) values[9 * triangle + i] = table[offset + (i % 3)]!;
    }
    colours.needsUpdate = true;
  }

  value(triangle: number, measure: WorstMeasure): number {
    return measureTriangle(this.arrays, triangle, measure);
  }

  corner(triangle: number, corner: number): Vector3 {
    return new Vector3().fromArray(this.arrays.positions, 3 * this.arrays.indices[3 * triangle + corner]!);
  }

  middle(triangle: number): Vector3 {
    return this.corner(triangle, 0).add(this.corner(triangle, 1)).add(this.corner(triangle, 2)).divideScalar(3);
  }

  longestEdge(triangle: number): number {
    const [a, b, c] = [this.corner(triangle, 0), this.corner(triangle, 1), this.corner(triangle, 2)];
    return Math.max(a.distanceTo(b), b.distanceTo(c), c.distanceTo(a));
  }

  /** Outward; of a triangle without area, away from the middle of the mesh. */
  normal(triangle: number): Vector3 {
    const a = this.corner(triangle, 0);
    const normal = this.corner(triangle, 1).sub(a).cross(this.corner(triangle, 2).sub(a));
    return normal.length() > 0 ? normal.normalize() : this.middle(triangle).normalize();
  }

  /** Fills and outlines the triangles, in the colours given or the highlight's, with a ring around the first. */
  highlightTriangles(triangles: number[], colours: readonly string[] = [kHighlightColour]): void {
    this.clearHighlight();
    triangles.forEach((triangle, i) => {
      const colour = colours[i % colours.length]!;
      this.highlight.add(filledTriangles(this, [triangle], colour), outlinedTriangle(this, triangle));
    });
    const first = triangles[0];
    if (first !== undefined) this.highlight.add(ringAt(this.middle(first)));
  }

  clearHighlight(): void {
    disposeOf(this.highlight);
    this.highlight.clear();
  }

  dispose(): void {
    disposeOf(this.group);
  }

  private markPairs(): void {
    const listed = this.facts.pairs.listed;
    if (listed.length === 0) return;
    this.pairMarks.add(filledTriangles(this, listed.map(([first]) => first), kPairColours[0]));
    this.pairMarks.add(filledTriangles(this, listed.map(([, second]) => second), kPairColours[1]));
  }
}

/** Three corners of its own for each triangle, so that each has its own colour. */
function cornerGeometry({ positions, indices }: MeshArrays): BufferGeometry {
  const corners = new Float32Array(3 * indices.length);
  for (let i = 0; i < indices.length; ++i) corners.set(positions.subarray(3 * indices[i]!, 3 * indices[i]! + 3), 3 * i);
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(corners, 3));
  geometry.setAttribute("color", new BufferAttribute(new Float32Array(corners.length), 3));
  return geometry;
}

/** Each edge once where two triangles name it in opposite directions, as on a closed surface; a border's edges where they ascend. */
function edgeGeometry({ positions, indices }: MeshArrays): BufferGeometry {
  const ends: number[] = [];
  for (let i = 0; i < indices.length; ++i) {
    const from = indices[i]!;
    const to = indices[i % 3 === 2 ? i - 2 : i + 1]!;
    if (from < to) ends.push(from, to);
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(positions, 3));
  geometry.setIndex(new BufferAttribute(new Uint32Array(ends), 1));
  return geometry;
}

function meanEdgeLength({ positions, indices }: MeshArrays): number {
  const stride = 3 * Math.max(1, Math.floor(indices.length / 3 / kSampledTriangles));
  let sum = 0;
  let count = 0;
  for (let i = 0; i + 1 < indices.length; i += stride, ++count) {
    const [a, b] = [3 * indices[i]!, 3 * indices[i + 1]!];
    sum += Math.hypot(positions[b]! - positions[a]!, positions[b + 1]! - positions[a + 1]!, positions[b + 2]! - positions[a + 2]!);
  }
  return count > 0 ? sum / count : 1;
}

function filledTriangles(model: MeshModel, triangles: number[], colour: string): Mesh {
  const points = triangles.flatMap((triangle) => [0, 1, 2].map((corner) => model.corner(triangle, corner)));
  const material = new MeshBasicMaterial({ color: colour, side: DoubleSide, ...kInFront });
  return new Mesh(new BufferGeometry().setFromPoints(points), material);
}

/** Seen through whatever lies before it, as a sliver may be too thin to be drawn otherwise. */
function outlinedTriangle(model: MeshModel, triangle: number): LineSegments {
  const [a, b, c] = [model.corner(triangle, 0), model.corner(triangle, 1), model.corner(triangle, 2)];
  const material = new LineBasicMaterial({ color: kHighlightColour, depthTest: false, transparent: true });
  const outline = new LineSegments(new BufferGeometry().setFromPoints([a, b, b, c, c, a]), material);
  outline.renderOrder = 2;
  return outline;
}

function ringAt(place: Vector3): Sprite {
  const material = new SpriteMaterial({ map: ringTexture(), depthTest: false, sizeAttenuation: false, transparent: true });
  const ring = new Sprite(material);
  ring.position.copy(place);
  ring.scale.setScalar(kRingSize);
  ring.renderOrder = 3;
  return ring;
}

function ringTexture(): CanvasTexture {
  const size = 128;
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = size;
  const context = canvas.getContext("2d");
  if (context) {
    context.strokeStyle = kHighlightColour;
    context.lineWidth = 5;
    context.beginPath();
    context.arc(size / 2, size / 2, size / 2 - 4, 0, 2 * Math.PI);
    context.stroke();
  }
  return new CanvasTexture(canvas);
}

function disposeOf(group: Group): void {
  group.traverse((object) => {
    if (object instanceof Mesh || object instanceof LineSegments) {
      object.geometry.dispose();
      object.material.dispose();
    } else if (object instanceof Sprite) {
      object.material.map?.dispose();
      object.material.dispose();
    }
  });
}
