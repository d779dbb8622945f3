import { type Case, type Method, type ReportData, changePercent, hasDiverged, isDone, methodSeconds, numberAt, textAt } from "./data";
import { element, plainTable } from "./dom";
import { count, fixed, kNothing, range, significant, signedPercent } from "./format";

/** Which switches of TetGen a case is counted by. */
const kTetgenSwitches = ["p", "pY"];

interface NamedCase {
  molecule: string;
  method: string;
  record: Case;
}

function casesOf(data: ReportData, method: Method): NamedCase[] {
  return data.molecules.flatMap(({ name, title }) => {
    const record = data.cases[name]?.[method.name];
    return record ? [{ molecule: title, method: method.title, record }] : [];
  });
}

function numbersOf(cases: NamedCase[], number: (record: Case) => number | undefined): number[] {
  return cases.map(({ record }) => number(record)).filter((value) => value !== undefined);
}

function pairsText(cases: NamedCase[]): string {
  const pairs = numbersOf(cases, (record) => numberAt(record, "metrics", "after", "intersecting_pairs"));
  const uncounted = cases.length - pairs.length;
  const total = pairs.reduce((sum, value) => sum + value, 0);
  const meshes = pairs.filter((value) => value > 0).length;
  const parts = [pairs.length === 0 ? kNothing : total === 0 ? "0" : `${count(total)} in ${meshes} of ${pairs.length}`];
  if (uncounted > 0 && pairs.length > 0) parts.push(`${uncounted} not counted`);
  return parts.join(", ");
}

function tetgenText(cases: NamedCase[], switches: string): string {
  const statuses = cases.map(({ record }) => textAt(record, "tetgen", switches, "status")).filter((status) => status !== undefined);
  return statuses.length === 0 ? kNothing : `${statuses.filter((status) => status === "success").length} of ${statuses.length}`;
}

function endedText(cases: NamedCase[]): string {
  const done = cases.filter(({ record }) => isDone(record));
  const diverged = done.filter(({ record }) => hasDiverged(record)).length;
  return `${done.length} of ${cases.length}${diverged > 0 ? `, ${diverged} diverged` : ""}`;
}

function methodRow(data: ReportData, method: Method): string[] {
  const all = casesOf(data, method);
  const cases = all.filter(({ record }) => isDone(record));
  const sound = cases.filter(({ record }) => !hasDiverged(record));
  const isInitial = method.name === "initial";
  return [
    method.title,
    endedText(all),
    pairsText(cases),
    significant(Math.min(...numbersOf(sound, (record) => numberAt(record, "metrics", "after", "angle_deg", "min")))),
    isInitial ? kNothing : range(numbersOf(sound, (record) => changePercent(record, "volume")), (value) => signedPercent(value)),
    ...kTetgenSwitches.map((switches) => tetgenText(cases, switches)),
    isInitial ? kNothing : range(numbersOf(cases, methodSeconds), (value) => `${significant(value)} s`),
  ];
}

function methodsTable(data: ReportData): HTMLElement {
  const heads = ["Method", "Cases done", "Intersecting pairs", "Smallest angle (°)", "Volume change", "TetGen -p", "TetGen -pY", "Processor time"];
  const table = plainTable(heads, data.methods.map((method) => methodRow(data, method)), { id: "summary-methods" });
  const note =
    "Over all molecules: pairs as a sum, the angle as the worst, volume (against the initial mesh without its cavities) and time from least to most. " +
    "Angles and volumes of meshes that diverged are left out.";
  return element("div", { class: "wide" }, table, element("p", { class: "note" }, note));
}

const kRoles: Record<string, string> = {
  real: "the paper's own",
  "near-copy": "near copy of the paper's",
  "stand-in": "stand-in for the paper's",
  extra: "not in the paper",
};

function sizesText(data: ReportData, molecule: string): string {
  const initial = data.cases[molecule]?.["initial"];
  return count(numberAt(initial, "metrics", "after", "triangles"));
}

function moleculesTable(data: ReportData): HTMLElement {
  const rows = data.molecules.map(({ name, title, role, about, atoms }) => [
    title,
    kRoles[role] ?? role,
    about ?? kNothing,
    count(atoms),
    sizesText(data, name),
  ]);
  return element("div", { class: "wide" }, plainTable(["Molecule", "In the paper", "What it is", "Atoms", "Initial triangles"], rows, { id: "summary-molecules" }));
}

function unfinishedCases(data: ReportData): NamedCase[] {
  return data.methods.flatMap((method) => casesOf(data, method)).filter(({ record }) => !isDone(record) || hasDiverged(record));
}

function whyUnfinished(record: Case): string {
  if (isDone(record)) return `diverged at step ${numberAt(record, "diverged_at_step")}`;
  return `${textAt(record, "status") ?? "no status"}: ${textAt(record, "reason") ?? "no reason given"}`;
}

function unfinishedTable(data: ReportData): HTMLElement {
  const unfinished = unfinishedCases(data);
  if (unfinished.length === 0) return element("p", { id: "summary-failures" }, "Every case ended well.");
  const rows = unfinished.map(({ molecule, method, record }) => [molecule, method, whyUnfinished(record)]);
  return element("div", { class: "wide" }, plainTable(["Molecule", "Method", "Why"], rows, { id: "summary-failures" }));
}

function card(value: string, label: string, kind = ""): HTMLElement {
  return element("div", { class: `card ${kind}` }, element("strong", {}, value), element("span", {}, label));
}

function cards(data: ReportData): HTMLElement {
  const all = data.methods.flatMap((method) => casesOf(data, method));
  const failed = all.filter(({ record }) => textAt(record, "status") === "failed").length;
  const absent = all.filter(({ record }) => textAt(record, "status") === "not installed").length;
  const box = element("div", { class: "cards" }, card(count(data.molecules.length), "molecules"), card(count(data.methods.length), "methods, with the initial mesh"));
  box.append(card(count(all.length), "cases"), card(count(failed), "failed", failed > 0 ? "bad" : "good"));
  if (absent > 0) box.append(card(count(absent), "of programs not installed"));
  const smopt = data.methods.filter(({ name }) => name === "smopt").flatMap((method) => casesOf(data, method).filter(({ record }) => isDone(record)));
  if (smopt.length > 0) appendSmoptCards(box, smopt);
  return box;
}

function appendSmoptCards(box: HTMLElement, smopt: NamedCase[]): void {
  const pairs = numbersOf(smopt, (record) => numberAt(record, "metrics", "after", "intersecting_pairs")).reduce((sum, value) => sum + value, 0);
  const angle = Math.min(...numbersOf(smopt, (record) => numberAt(record, "metrics", "after", "angle_deg", "min")));
  box.append(card(count(pairs), "intersecting pairs after SMOPT", pairs > 0 ? "bad" : "good"));
  box.append(card(`${fixed(angle, 2)}°`, "smallest angle after SMOPT"));
  box.append(card(tetgenText(smopt, "pY"), "of SMOPT's meshes TetGen -pY fills", "plain"));
}

export function showSummary(section: HTMLElement, data: ReportData): void {
  section.append(
    element("p", { class: "note" }, `Run “${data.name}”.`),
    cards(data),
    element("h3", {}, "Methods"),
    methodsTable(data),
    element("h3", {}, "Molecules"),
    moleculesTable(data),
    element("h3", {}, "What failed or diverged, and why"),
    unfinishedTable(data),
  );
}
