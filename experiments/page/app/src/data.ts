// What `smopt report` put into the page: experiments/page/page_data.h and run_views.h describe it.

export type Cell = null | string | number | [number, number];

export interface Table {
  name: string;
  caption: string;
  columns: { id: string; title: string }[];
  rows: Cell[][];
  notes: string[];
}

export interface Molecule {
  name: string;
  title: string;
  role: string;
  about?: string;
  atoms?: number;
  paper_row?: string | null;
}

export interface Method {
  name: string;
  title: string;
  in_paper: boolean;
}

/** A record's part that is shown; anything may be missing, as in the record of a case that failed. */
export type Case = { [key: string]: unknown };

/** [index among the shown triangles, id in the mesh, value, rank in the whole mesh] */
export type WorstTriangle = [number, number, number, number];
/** [index, index, id, id] */
export type Pair = [number, number, number, number];
export type WorstMeasure = "smallest_angle" | "largest_angle" | "edge_ratio";

export interface MeshFacts {
  title: string;
  vertices: number;
  triangles: number;
  shown_vertices: number;
  shown_triangles: number;
  undrawable_triangles: number;
  worst: Record<WorstMeasure, WorstTriangle[]>;
  pairs: { count: number | null; listed: Pair[]; why_not_counted: string };
  positions: number;
  indices: number;
}

export interface MoleculeViews {
  radius: number | null;
  meshes: Record<string, MeshFacts>;
  left_out: Record<string, { title: string; why: string }>;
}

export interface ReportData {
  name: string;
  provenance: { version: string[]; compiler: string[]; machine: string[]; threads: string[] };
  tables: Table[];
  molecules: Molecule[];
  methods: Method[];
  cases: Record<string, Record<string, Case>>;
  views: Record<string, MoleculeViews>;
}

export function readData(): ReportData {
  const element = document.getElementById("report-data");
  if (!element?.textContent) throw new Error("this page holds no data; it is the empty template");
  return JSON.parse(element.textContent) as ReportData;
}

/** The value at a path of keys, if it is a finite number. */
export function numberAt(record: Case | undefined, ...keys: string[]): number | undefined {
  const value = valueAt(record, ...keys);
  return typeof value === "number" && Number.isFinite(value) ? value : undefined;
}

export function textAt(record: Case | undefined, ...keys: string[]): string | undefined {
  const value = valueAt(record, ...keys);
  return typeof value === "string" ? value : undefined;
}

export function valueAt(record: Case | undefined, ...keys: string[]): unknown {
  let value: unknown = record;
  for (const key of keys) value = typeof value === "object" && value !== null ? (value as Case)[key] : undefined;
  return value;
}

export function isDone(record: Case | undefined): boolean {
  return textAt(record, "status") === "done";
}

/** Whether the method blew the mesh up: what is left is no surface. */
export function hasDiverged(record: Case | undefined): boolean {
  return numberAt(record, "diverged_at_step") !== undefined;
}

/** Of the case's initial mesh without its cavities, which changes refer to; in percent. */
export function changePercent(record: Case | undefined, quantity: "area" | "volume"): number | undefined {
  const before = numberAt(record, "metrics", "before", quantity);
  const after = numberAt(record, "metrics", "after", quantity);
  return before && after !== undefined ? 100 * (after / before - 1) : undefined;
}

/** Processor seconds of the method itself, without what comes before any. */
export function methodSeconds(record: Case | undefined): number | undefined {
  if (numberAt(record, "cpu_seconds", "smoothing") === undefined) return undefined;
  return ["redundant", "resampling", "smoothing"].reduce((sum, stage) => sum + (numberAt(record, "cpu_seconds", stage) ?? 0), 0);
}
