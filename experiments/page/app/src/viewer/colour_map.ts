import { interpolateBuPu, interpolateCividis, interpolateViridis } from "d3-scale-chromatic";
import { Color } from "three";

/** From the best (0) to the worst (1); each also runs from light to dark or back, for print and the colour-blind. */
export type ColourMap = (badness: number) => string;

export const kColourMaps: { id: string; label: string; map: ColourMap }[] = [
  { id: "purple", label: "pale to purple", map: (badness) => interpolateBuPu(0.06 + 0.94 * badness) },
  { id: "viridis", label: "viridis", map: (badness) => interpolateViridis(1 - badness) },
  { id: "cividis", label: "cividis", map: (badness) => interpolateCividis(1 - badness) },
];

const kSteps = 256;

/** Red, green and blue of kSteps colours, in the renderer's linear space, one after the other. */
export function colourTable(map: ColourMap): Float32Array {
  const table = new Float32Array(3 * kSteps);
  for (let i = 0; i < kSteps; ++i) new Color().setStyle(map(i / (kSteps - 1))).toArray(table, 3 * i);
  return table;
}

/** Where a colour begins in the table. */
export function tableOffset(badness: number): number {
  const clamped = Math.min(1, Math.max(0, badness));
  return 3 * Math.round(clamped * (kSteps - 1));
}

export function cssGradient(map: ColourMap): string {
  const stops = Array.from({ length: 11 }, (_, i) => map(i / 10));
  return `linear-gradient(to right, ${stops.join(", ")})`;
}
