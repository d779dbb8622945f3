import type { ReportData } from "../data";
import { showComparison } from "./comparison";
import { showDistributions } from "./distributions";
import { showSizeBars } from "./size_bars";

export function showFigures(section: HTMLElement, data: ReportData): void {
  showSizeBars(section, data);
  showDistributions(section, data);
  showComparison(section, data);
}
