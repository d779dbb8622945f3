import type { MeshFacts } from "../data";
import { element } from "../dom";
import { count } from "../format";
import type { TriangleMeasure } from "./triangle_measures";

export interface ListActions {
  showTriangle: (triangle: number, text: string) => void;
  showPair: (first: number, second: number, text: string) => void;
}

function jump(text: string, onClick: () => void): HTMLElement {
  const button = element("button", { type: "button", class: "jump" }, text);
  button.addEventListener("click", () => {
    for (const other of button.closest("ol")?.querySelectorAll(".jump") ?? []) other.removeAttribute("aria-current");
    button.setAttribute("aria-current", "true");
    onClick();
  });
  return element("li", {}, button);
}

function worstHeading(facts: MeshFacts, measure: TriangleMeasure): string {
  const isWhole = facts.shown_triangles + facts.undrawable_triangles === facts.triangles;
  return `Worst triangles by ${measure.label}${isWhole ? "" : ", of the part shown"}`;
}

export function worstList(facts: MeshFacts, measure: TriangleMeasure, actions: ListActions): HTMLElement {
  const items = facts.worst[measure.id].map(([triangle, id, value, rank]) => {
    const text = `${count(rank)}. ${measure.format(value)} — triangle ${count(id)}`;
    return jump(text, () => actions.showTriangle(triangle, text));
  });
  const list = element("ol", { class: "jumps", "aria-label": "worst triangles" }, ...items);
  return element("div", { class: "list worst" }, element("h4", {}, worstHeading(facts, measure)), items.length > 0 ? list : element("p", { class: "note" }, "There is none."));
}

function pairsText({ pairs }: MeshFacts): string {
  if (pairs.count === null) return `not counted: ${pairs.why_not_counted}`;
  if (pairs.count === 0) return "none";
  return pairs.listed.length < pairs.count ? `${count(pairs.count)}, the first ${pairs.listed.length} listed and marked` : count(pairs.count);
}

export function pairList(facts: MeshFacts, actions: ListActions): HTMLElement {
  const items = facts.pairs.listed.map(([first, second, firstId, secondId], i) => {
    const text = `${i + 1}. triangles ${count(firstId)} and ${count(secondId)}`;
    return jump(text, () => actions.showPair(first, second, text));
  });
  const list = element("ol", { class: "jumps", "aria-label": "intersecting pairs" }, ...items);
  return element("div", { class: "list pairs" }, element("h4", {}, `Intersecting pairs: ${pairsText(facts)}`), ...(items.length > 0 ? [list] : []));
}
