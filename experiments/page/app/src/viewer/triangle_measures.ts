import type { WorstMeasure } from "../data";
import { fixed, significant } from "../format";
import type { MeshArrays } from "../unpack";

export interface TriangleMeasure {
  id: WorstMeasure;
  label: string;
  /** The worst and the best value; colours run between them. */
  worst: number;
  best: number;
  unit: string;
  format: (value: number) => string;
}

const kDegrees = (value: number) => `${value < 1 ? significant(value) : fixed(value, 2)}°`;

export const kMeasures: TriangleMeasure[] = [
  { id: "smallest_angle", label: "smallest angle", worst: 0, best: 60, unit: "°", format: kDegrees },
  { id: "largest_angle", label: "largest angle", worst: 180, best: 60, unit: "°", format: kDegrees },
  { id: "edge_ratio", label: "edge ratio", worst: 0, best: 1, unit: "", format: (value) => significant(value) },
];

/** Squares of a triangle's sides, those opposite its first, second and third corner. */
function squaredSides({ positions, indices }: MeshArrays, triangle: number): [number, number, number] {
  const side = (from: number, to: number) => {
    const a = 3 * indices[3 * triangle + from]!;
    const b = 3 * indices[3 * triangle + to]!;
    return (positions[b]! - positions[a]!) ** 2 + (positions[b + 1]! - positions[a + 1]!) ** 2 + (positions[b + 2]! - positions[a + 2]!) ** 2;
  };
  return [side(1, 2), side(2, 0), side(0, 1)];
}

function angle(opposite: number, p: number, q: number): number {
  const cosine = (p + q - opposite) / (2 * Math.sqrt(p * q));
  return (Math.acos(Math.min(1, Math.max(-1, cosine))) * 180) / Math.PI;
}

const kOf: Record<WorstMeasure, (shortest: number, middle: number, longest: number) => number> = {
  smallest_angle: (shortest, middle, longest) => (shortest > 0 ? angle(shortest, middle, longest) : 0),
  largest_angle: (shortest, middle, longest) => (shortest > 0 ? angle(longest, shortest, middle) : 180),
  edge_ratio: (shortest, _middle, longest) => (longest > 0 ? Math.sqrt(shortest / longest) : 0),
};

/** In single precision, good for colours; the lists' values were worked out from the mesh itself. */
export function measureTriangle(mesh: MeshArrays, triangle: number, measure: WorstMeasure): number {
  const [x, y, z] = squaredSides(mesh, triangle).sort((p, q) => p - q) as [number, number, number];
  return kOf[measure](x, y, z);
}
