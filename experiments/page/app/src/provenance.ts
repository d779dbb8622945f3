import type { ReportData } from "./data";
import { element } from "./dom";
import { kNothing } from "./format";

export function showProvenance(footer: HTMLElement, { provenance }: ReportData): void {
  const entries: [string, string[]][] = [
    ["Version", provenance.version],
    ["Compiler", provenance.compiler],
    ["Machine", provenance.machine],
    ["Threads", provenance.threads],
  ];
  const list = element("dl", {});
  for (const [term, values] of entries) list.append(element("dt", {}, term), element("dd", {}, values.length > 0 ? values.join("; ") : kNothing));
  const paper = "The paper: Liu et al. 2017, PLoS ONE 12(9): e0184206. Made by smopt report from the run's records and meshes, and from nothing else.";
  const libraries = "Drawn with three.js, Apache ECharts, Tabulator and d3-scale-chromatic.";
  footer.append(element("h2", {}, "Provenance"), list, element("p", { class: "note" }, `${paper} ${libraries}`));
}
