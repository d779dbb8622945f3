export const kNothing = "—";
const kMinus = "−";

/** With a thin space between thousands and a true minus. */
export function count(value: number | null | undefined): string {
  if (value === null || value === undefined) return kNothing;
  return fixed(value, 0);
}

export function fixed(value: number | undefined, decimals: number): string {
  if (value === undefined || !Number.isFinite(value)) return kNothing;
  const [whole = "", fraction] = Math.abs(value).toFixed(decimals).split(".");
  const grouped = whole.replace(/\B(?=(\d{3})+$)/g, "\u202f");
  const isZero = Number(value.toFixed(decimals)) === 0;
  return (value < 0 && !isZero ? kMinus : "") + grouped + (fraction === undefined ? "" : `.${fraction}`);
}

/** Three significant digits; as a power of ten where that is shorter. */
export function significant(value: number | undefined, digits = 3): string {
  if (value === undefined || !Number.isFinite(value)) return kNothing;
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size < 1e-4 || size >= 1e7) return value.toExponential(digits - 1).replace("-", kMinus);
  return fixed(value, Math.max(0, digits - 1 - Math.floor(Math.log10(size))));
}

export function signedPercent(value: number | undefined, decimals = 1): string {
  if (value === undefined) return kNothing;
  return `${value > 0 ? "+" : ""}${fixed(value, decimals)} %`;
}

/** "-1.2 … 3.4" of the smallest and the largest value, or the one there is. */
export function range(values: number[], format: (value: number) => string): string {
  if (values.length === 0) return kNothing;
  const low = format(Math.min(...values));
  const high = format(Math.max(...values));
  return low === high ? low : `${low} … ${high}`;
}

/** At an axis's tick. */
export function axisNumber(value: number): string {
  return Math.abs(value) >= 1000 ? fixed(value, 0) : String(Number(value.toPrecision(6))).replace("-", kMinus);
}
