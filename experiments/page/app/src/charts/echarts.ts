// Of Apache ECharts only what the figures use.
import { BarChart, LineChart, ScatterChart } from "echarts/charts";
import { AriaComponent, DataZoomComponent, GridComponent, LegendComponent, TooltipComponent } from "echarts/components";
import { type ECharts, type EChartsCoreOption, init, use } from "echarts/core";
import { SVGRenderer } from "echarts/renderers";

import { axisNumber } from "../format";
import { onThemeChange, styleColour } from "../theme";

use([BarChart, LineChart, ScatterChart, AriaComponent, DataZoomComponent, GridComponent, LegendComponent, TooltipComponent, SVGRenderer]);

export type ChartOption = EChartsCoreOption;

/** A chart that keeps its place's width and is drawn anew, by `option`, when the system turns dark or light. */
export class Chart {
  private readonly chart: ECharts;

  constructor(
    place: HTMLElement,
    private readonly option: () => ChartOption,
  ) {
    this.chart = init(place, undefined, { renderer: "svg" });
    new ResizeObserver(() => this.chart.resize()).observe(place);
    onThemeChange(() => this.draw());
    this.draw();
  }

  draw(): void {
    this.chart.setOption({ ...commonOption(), ...this.option() }, { notMerge: true });
  }

}

function commonOption(): ChartOption {
  return {
    animationDuration: 200,
    textStyle: { color: styleColour("--text"), fontFamily: getComputedStyle(document.body).fontFamily },
    aria: { enabled: true },
  };
}

/** An axis of numbers, beyond `axisStyle`. */
export function valueAxisStyle(): ChartOption {
  return { ...axisStyle(), type: "value", nameLocation: "middle", axisLabel: { color: styleColour("--text"), hideOverlap: true, formatter: axisNumber } };
}

/** Text and lines of an axis in the page's colours. */
export function axisStyle(): ChartOption {
  const text = styleColour("--text");
  const line = styleColour("--line");
  return {
    nameTextStyle: { color: text },
    axisLabel: { color: text, hideOverlap: true },
    axisLine: { lineStyle: { color: styleColour("--muted") } },
    splitLine: { lineStyle: { color: line } },
  };
}

export function tooltipStyle(): ChartOption {
  return {
    renderMode: "richText", // names and reasons are data, not markup
    confine: true,
    backgroundColor: styleColour("--surface"),
    borderColor: styleColour("--line"),
    textStyle: { color: styleColour("--text") },
  };
}

export function legendStyle(): ChartOption {
  return {
    type: "scroll",
    top: 0,
    textStyle: { color: styleColour("--text") },
    inactiveColor: styleColour("--line"),
    pageTextStyle: { color: styleColour("--text") },
    pageIconColor: styleColour("--accent"),
    pageIconInactiveColor: styleColour("--line"),
  };
}
