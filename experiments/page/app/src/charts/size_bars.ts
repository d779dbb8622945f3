// Figure 5: area and volume of each mesh, in bars.
import { type Method, type ReportData, changePercent, hasDiverged, isDone, numberAt, textAt } from "../data";
import { type Choice, chooser, element } from "../dom";
import { fixed, kNothing, signedPercent } from "../format";
import { Chart, type ChartOption, axisStyle, legendStyle, tooltipStyle, valueAxisStyle } from "./echarts";
import { methodStyles, preparedColour } from "./styles";

const kPrepared = "initial, cavities deleted";
/** More molecules than fit beside each other are scrolled through. */
const kMoleculesAtOnce = 8;

type Quantity = "area" | "volume";
type Scale = "value" | "change";

interface Series {
  name: string;
  title: string;
  colour: string;
  values: (number | undefined)[];
}

const kUnits: Record<Quantity, string> = { area: "area (Å²)", volume: "enclosed volume (Å³)" };

function preparedValue(data: ReportData, molecule: string, quantity: Quantity): number | undefined {
  for (const { name } of data.methods) {
    const value = name === "initial" ? undefined : numberAt(data.cases[molecule]?.[name], "metrics", "before", quantity);
    if (value !== undefined) return value;
  }
  return undefined;
}

function methodValue(data: ReportData, molecule: string, method: Method, quantity: Quantity, scale: Scale): number | undefined {
  const record = data.cases[molecule]?.[method.name];
  if (!isDone(record) || hasDiverged(record)) return undefined;
  return scale === "change" ? changePercent(record, quantity) : numberAt(record, "metrics", "after", quantity);
}

function seriesOf(data: ReportData, quantity: Quantity, scale: Scale): Series[] {
  const styles = methodStyles(data.methods);
  const methods = scale === "change" ? data.methods.filter(({ name }) => name !== "initial") : data.methods;
  const series = methods.map((method) => ({
    name: method.name,
    title: method.title,
    colour: styles.get(method.name)!.colour,
    values: data.molecules.map(({ name }) => methodValue(data, name, method, quantity, scale)),
  }));
  const prepared = { name: "prepared", title: kPrepared, colour: preparedColour(), values: data.molecules.map(({ name }) => preparedValue(data, name, quantity)) };
  if (scale === "value" && prepared.values.some((value) => value !== undefined)) series.splice(1, 0, prepared);
  return series;
}

function option(data: ReportData, quantity: Quantity, scale: Scale): ChartOption {
  const series = seriesOf(data, quantity, scale);
  const paperTitles = new Set(data.methods.filter(({ in_paper }) => in_paper).map(({ title }) => title));
  const format = (value: unknown) => (typeof value === "number" ? (scale === "change" ? signedPercent(value, 2) : fixed(value, 0)) : kNothing);
  return {
    aria: { enabled: true, decal: { show: true } },
    tooltip: { ...tooltipStyle(), trigger: "axis", axisPointer: { type: "shadow" }, valueFormatter: format },
    legend: { ...legendStyle(), selected: Object.fromEntries(series.map(({ title }) => [title, title === kPrepared || paperTitles.has(title)])) },
    grid: { left: 90, right: 20, top: 50, bottom: data.molecules.length > kMoleculesAtOnce ? 80 : 40 },
    xAxis: { ...axisStyle(), type: "category", data: data.molecules.map(({ title }) => title), splitLine: { show: false } },
    yAxis: { ...valueAxisStyle(), name: scale === "change" ? `change of ${quantity} (%)` : kUnits[quantity], nameGap: 72 },
    ...(data.molecules.length > kMoleculesAtOnce ? { dataZoom: [{ type: "slider", startValue: 0, endValue: kMoleculesAtOnce - 1 }] } : {}),
    series: series.map(({ title, colour, values }) => ({ type: "bar", name: title, itemStyle: { color: colour }, data: values.map((value) => value ?? "-") })),
  };
}

/** Which cases have no bar. */
function missingText(data: ReportData): string {
  const missing = data.molecules.flatMap((molecule) =>
    data.methods.flatMap((method) => {
      const record = data.cases[molecule.name]?.[method.name];
      if (!record || (isDone(record) && !hasDiverged(record))) return [];
      return [`${molecule.title}, ${method.title}: ${isDone(record) ? "diverged" : textAt(record, "status")}`];
    }),
  );
  return missing.length > 0 ? `Without bars: ${missing.join("; ")}.` : "";
}

export function showSizeBars(section: HTMLElement, data: ReportData): void {
  let quantity: Quantity = "area";
  let scale: Scale = "value";
  const quantities: Choice[] = [{ value: "area", label: "area" }, { value: "volume", label: "volume" }];
  const scales: Choice[] = [{ value: "value", label: "value" }, { value: "change", label: "change against the initial mesh without cavities" }];
  const place = element("div", { class: "chart", id: "chart-sizes" });
  const toolbar = element("div", { class: "toolbar" });
  section.append(element("h3", {}, "Figure 5. Area and volume"), toolbar, place, element("p", { class: "note" }, missingText(data)));
  const chart = new Chart(place, () => option(data, quantity, scale));
  toolbar.append(
    chooser("Quantity", "sizes-quantity", quantities, quantity, (value) => ((quantity = value as Quantity), chart.draw())).box,
    chooser("Show", "sizes-scale", scales, scale, (value) => ((scale = value as Scale), chart.draw())).box,
  );
}
