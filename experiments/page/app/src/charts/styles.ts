import type { Method } from "../data";

// Okabe and Ito's colours (2008), which stay apart for the colour-blind; the same as in figures/plot.py.
const kFixed: Record<string, string> = {
  initial: "#999999",
  prepared: "#56B4E9",
  smopt: "#0072B2",
  laplacian: "#E69F00",
};
const kOthers = ["#009E73", "#D55E00", "#CC79A7", "#BDB000"];
const kMoleculeColours = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"];
const kSymbols = ["circle", "rect", "triangle", "diamond", "pin", "arrow"];
const kDashes: (string | number[])[] = ["solid", [6, 3], [2, 2], [8, 3, 2, 3]];

export interface SeriesStyle {
  colour: string;
  dash: string | number[];
}

/** For each method, always the same; dashes tell apart what has the same colour, in print as well. */
export function methodStyles(methods: Method[]): Map<string, SeriesStyle> {
  const styles = new Map<string, SeriesStyle>();
  let others = 0;
  for (const { name } of methods) {
    const fixed = kFixed[name];
    if (fixed) styles.set(name, { colour: fixed, dash: "solid" });
    else {
      styles.set(name, { colour: kOthers[others % kOthers.length]!, dash: kDashes[(1 + Math.floor(others / kOthers.length)) % kDashes.length]! });
      ++others;
    }
  }
  return styles;
}

export function preparedColour(): string {
  return kFixed["prepared"]!;
}

export function moleculeStyle(index: number): { colour: string; symbol: string } {
  return {
    colour: kMoleculeColours[index % kMoleculeColours.length]!,
    symbol: kSymbols[(index + Math.floor(index / kMoleculeColours.length)) % kSymbols.length]!,
  };
}
