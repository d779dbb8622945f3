// Figures 6 and 7: how edge ratios and angles are distributed.
import { type Case, type ReportData, isDone, textAt, valueAt } from "../data";
import { type Choice, chooser, element } from "../dom";
import { fixed } from "../format";
import { Chart, type ChartOption, legendStyle, tooltipStyle, valueAxisStyle } from "./echarts";
import { methodStyles } from "./styles";

interface Distribution {
  id: string;
  title: string;
  quantity: string; // its key in the metrics
  axis: string;
  perBin: string;
  range: [number, number];
  interval: number; // between labels
}

const kEdgeRatios: Distribution = { id: "ratios", title: "Figure 6. Edge ratios", quantity: "edge_ratio", axis: "shortest / longest edge", perBin: "triangles per 0.02", range: [0, 1], interval: 0.2 };
const kAngles: Distribution = { id: "angles", title: "Figure 7. Angles", quantity: "angle_deg", axis: "angle (°)", perBin: "angles per 2°", range: [0, 180], interval: 30 };

type Scale = "count" | "share";

interface Histogram {
  edges: number[];
  counts: number[];
}

function histogramOf(record: Case | undefined, quantity: string): Histogram | undefined {
  if (!isDone(record)) return undefined;
  const histogram = valueAt(record, "metrics", "after", quantity, "histogram") as Histogram | undefined;
  return histogram?.counts?.length ? histogram : undefined;
}

/** The outline of the bars: a point at each edge, with what stands to its right. */
function outline({ edges, counts }: Histogram, scale: Scale): [number, number][] {
  const total = counts.reduce((sum, value) => sum + value, 0);
  const heights = counts.map((value) => (scale === "share" ? (100 * value) / Math.max(1, total) : value));
  return edges.map((edge, i) => [edge, heights[i] ?? heights.at(-1)!]);
}

function seriesOf(data: ReportData, molecule: string, what: Distribution, scale: Scale) {
  const styles = methodStyles(data.methods);
  return data.methods.flatMap(({ name, title }) => {
    const histogram = histogramOf(data.cases[molecule]?.[name], what.quantity);
    if (!histogram) return [];
    const { colour, dash } = styles.get(name)!;
    return [{
      type: "line", name: title, step: "end", symbol: "none", data: outline(histogram, scale), itemStyle: { color: colour },
      lineStyle: { color: colour, width: name === "smopt" ? 2.5 : 1.8, type: dash }, areaStyle: name === "initial" ? { color: colour, opacity: 0.25 } : undefined,
    }];
  });
}

function option(data: ReportData, molecule: string, what: Distribution, scale: Scale): ChartOption {
  const digits = scale === "share" ? 2 : 0;
  return {
    tooltip: { ...tooltipStyle(), trigger: "axis", valueFormatter: (value: unknown) => fixed(Number(value), digits) + (scale === "share" ? " %" : "") },
    legend: { ...legendStyle(), selected: Object.fromEntries(data.methods.map(({ title, in_paper }) => [title, in_paper])) },
    grid: { left: 80, right: 24, top: 50, bottom: 50 },
    xAxis: { ...valueAxisStyle(), min: what.range[0], max: what.range[1], interval: what.interval, name: what.axis, nameGap: 28, splitLine: { show: false } },
    yAxis: { ...valueAxisStyle(), name: scale === "share" ? `% ${what.perBin.replace("per", "in")}` : what.perBin, nameGap: 60 },
    series: seriesOf(data, molecule, what, scale),
  };
}

function missingText(data: ReportData, molecule: string, quantity: string): string {
  const missing = data.methods
    .filter(({ name }) => !histogramOf(data.cases[molecule]?.[name], quantity))
    .map(({ name, title }) => `${title} (${textAt(data.cases[molecule]?.[name], "reason") ?? "not run"})`);
  return missing.length > 0 ? `No distribution: ${missing.join("; ")}.` : "";
}

function showDistribution(section: HTMLElement, data: ReportData, what: Distribution): void {
  let molecule = data.molecules[0]?.name ?? "";
  let scale: Scale = "count";
  const molecules: Choice[] = data.molecules.map(({ name, title }) => ({ value: name, label: title }));
  const scales: Choice[] = [{ value: "count", label: "counts" }, { value: "share", label: "shares" }];
  const place = element("div", { class: "chart", id: `chart-${what.id}` });
  const toolbar = element("div", { class: "toolbar" });
  const note = element("p", { class: "note" }, missingText(data, molecule, what.quantity));
  section.append(element("h3", {}, what.title), toolbar, place, note);
  const chart = new Chart(place, () => option(data, molecule, what, scale));
  const draw = () => {
    chart.draw();
    note.textContent = missingText(data, molecule, what.quantity);
  };
  toolbar.append(
    chooser("Molecule", `${what.id}-molecule`, molecules, molecule, (value) => ((molecule = value), draw())).box,
    chooser("Show", `${what.id}-scale`, scales, scale, (value) => ((scale = value as Scale), draw())).box,
    element("span", { class: "note" }, "Methods are switched on and off in the legend."),
  );
}

export function showDistributions(section: HTMLElement, data: ReportData): void {
  showDistribution(section, data, kEdgeRatios);
  showDistribution(section, data, kAngles);
}
