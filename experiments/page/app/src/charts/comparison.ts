// All methods beside each other by one number, a mark a molecule.
import { type Case, type ReportData, changePercent, hasDiverged, isDone, methodSeconds, numberAt, textAt } from "../data";
import { type Choice, chooser, element } from "../dom";
import { axisNumber, significant } from "../format";
import { Chart, type ChartOption, axisStyle, legendStyle, tooltipStyle } from "./echarts";
import { moleculeStyle } from "./styles";

/** Height of a method's row, and of axis and legend together. */
const kRowHeight = 30;
const kRestHeight = 120;

type Axis = "linear" | "logarithmic" | "from zero"; // the last: log(1 + x / unit), which has a place for 0

interface Quantity {
  id: string;
  label: string;
  axis: Axis;
  unit: number; // of the axis from zero: where it turns from linear to logarithmic
  of: (record: Case) => number | undefined;
}

function levelSetRatio(record: Case): number | undefined {
  const before = numberAt(record, "level_set_distance", "before", "mean");
  const after = numberAt(record, "level_set_distance", "after", "mean");
  return before && after !== undefined ? after / before : undefined;
}

function percentageBelow30(record: Case): number | undefined {
  const share = numberAt(record, "metrics", "after", "min_angle_share", "below_30");
  return share === undefined ? undefined : 100 * share;
}

const kQuantities: Quantity[] = [
  { id: "angle", label: "smallest angle (°)", axis: "linear", unit: 1, of: (record) => numberAt(record, "metrics", "after", "angle_deg", "min") },
  { id: "below30", label: "smallest angle < 30° (% of triangles)", axis: "from zero", unit: 0.1, of: percentageBelow30 },
  { id: "pairs", label: "intersecting pairs", axis: "from zero", unit: 1, of: (record) => numberAt(record, "metrics", "after", "intersecting_pairs") },
  { id: "level-set", label: "mean distance to the level set (× before)", axis: "logarithmic", unit: 1, of: levelSetRatio },
  { id: "volume", label: "change of volume (%)", axis: "linear", unit: 1, of: (record) => changePercent(record, "volume") },
  { id: "area", label: "change of area (%)", axis: "linear", unit: 1, of: (record) => changePercent(record, "area") },
  { id: "time", label: "processor time (s)", axis: "logarithmic", unit: 1, of: methodSeconds },
];

function place(value: number, { axis, unit }: Quantity): number {
  return axis === "from zero" ? Math.log10(1 + value / unit) : value;
}

function valueAtPlace(position: number, { axis, unit }: Quantity): number {
  return axis === "from zero" ? unit * (10 ** position - 1) : position;
}

function shownValue(record: Case | undefined, quantity: Quantity): number | undefined {
  if (!record || !isDone(record) || hasDiverged(record)) return undefined;
  const value = quantity.of(record);
  return quantity.axis === "logarithmic" && value !== undefined && value <= 0 ? undefined : value;
}

function seriesOf(data: ReportData, quantity: Quantity) {
  return data.molecules.map(({ name, title }, index) => {
    const { colour, symbol } = moleculeStyle(index);
    const points = data.methods.flatMap((method) => {
      const value = shownValue(data.cases[name]?.[method.name], quantity);
      return value === undefined ? [] : [{ value: [place(value, quantity), method.title], shown: value }];
    });
    return { type: "scatter", name: title, symbol, symbolSize: 11, data: points, itemStyle: { color: colour, borderColor: "#000", borderWidth: 0.5, opacity: 0.85 } };
  });
}

interface TooltipPoint {
  seriesName: string;
  data: { value: [number, string]; shown: number };
}

function axisLabel(position: number, quantity: Quantity): string {
  const value = valueAtPlace(position, quantity);
  return quantity.axis === "from zero" ? significant(value, 1) : axisNumber(value);
}

function option(data: ReportData, quantity: Quantity): ChartOption {
  const common = axisStyle();
  return {
    tooltip: { ...tooltipStyle(), trigger: "item", formatter: ({ seriesName, data: point }: TooltipPoint) => `${seriesName}, ${point.value[1]}\n${significant(point.shown)}` },
    legend: legendStyle(),
    grid: { left: 210, right: 30, top: 40, bottom: 50 },
    xAxis: {
      ...common, type: quantity.axis === "logarithmic" ? "log" : "value", name: quantity.label, nameLocation: "middle", nameGap: 30, scale: quantity.axis === "linear",
      axisLabel: { ...(common["axisLabel"] as object), formatter: (position: number) => axisLabel(position, quantity) },
    },
    yAxis: { ...common, type: "category", inverse: true, data: data.methods.map(({ title }) => title), splitLine: { show: true, lineStyle: (common["splitLine"] as { lineStyle: object }).lineStyle } },
    series: seriesOf(data, quantity),
  };
}

function whyMissing(record: Case): string {
  if (!isDone(record)) return textAt(record, "status") ?? "no status";
  return hasDiverged(record) ? "diverged" : "no number, or 0 on a logarithmic axis";
}

/** The initial mesh has no time and no change: nothing is missing there. */
function missingText(data: ReportData, quantity: Quantity): string {
  const missing = data.molecules.flatMap((molecule) =>
    data.methods.flatMap((method) => {
      const record = data.cases[molecule.name]?.[method.name];
      if (!record || method.name === "initial" || shownValue(record, quantity) !== undefined) return [];
      return [`${molecule.title}, ${method.title} (${whyMissing(record)})`];
    }),
  );
  return missing.length > 0 ? `Not shown: ${missing.join("; ")}.` : "";
}

export function showComparison(section: HTMLElement, data: ReportData): void {
  let quantity = kQuantities[0]!;
  const choices: Choice[] = kQuantities.map(({ id, label }) => ({ value: id, label }));
  const box = element("div", { class: "chart", id: "chart-comparison" });
  box.style.height = `${kRestHeight + kRowHeight * data.methods.length}px`;
  const toolbar = element("div", { class: "toolbar" });
  const note = element("p", { class: "note" }, missingText(data, quantity));
  section.append(element("h3", {}, "All methods compared"), toolbar, box, note);
  const chart = new Chart(box, () => option(data, quantity));
  const choose = (id: string) => {
    quantity = kQuantities.find((candidate) => candidate.id === id) ?? quantity;
    chart.draw();
    note.textContent = missingText(data, quantity);
  };
  toolbar.append(chooser("By", "comparison-quantity", choices, quantity.id, choose).box);
}
