import { type MeshFacts, type MoleculeViews, type ReportData, textAt } from "../data";
import { type Choice, chooser, element } from "../dom";
import { count } from "../format";
import { type ListActions, pairList, worstList } from "./lists";
import { type MeshModel, kPairColours } from "./mesh_model";
import type { Side, Stage } from "./stage";
import { type TriangleMeasure, kMeasures } from "./triangle_measures";

/** From how far a triangle is looked at, in lengths of its longest edge: with its neighbours around it. */
const kViewingDistance = 14;
const kNames = ["left", "right"] as const;

/** What is written about one of the two meshes: its chooser above the stage, its facts and lists below. */
export class Pane {
  readonly head = element("div", { class: "pane-head" });
  readonly lists: HTMLElement;
  private readonly facts = element("span", { class: "note" });
  private readonly picked = element("p", { class: "picked", "aria-live": "polite" });

  constructor(
    readonly side: Side,
    private readonly data: ReportData,
    private readonly stage: Stage,
  ) {
    this.lists = element("div", { class: "pane-lists", id: `lists-${kNames[side]}` });
  }

  /** A chooser of the meshes that there are; what there is not is listed with the reason, and cannot be chosen. */
  offerMeshes(molecule: string, views: MoleculeViews, chosen: string, onChange: (method: string) => void): void {
    const choices: Choice[] = Object.entries(views.meshes).map(([value, { title }]) => ({ value, label: title }));
    const { box, select } = chooser(kNames[this.side] === "left" ? "Left" : "Right", `mesh-${kNames[this.side]}`, choices, chosen, onChange);
    for (const text of this.missingMeshes(molecule, views)) select.append(element("option", { disabled: true }, text));
    this.head.replaceChildren(box, this.facts);
  }

  /** Of the mesh that now stands on the stage. */
  describe(model: MeshModel, measure: TriangleMeasure): void {
    this.facts.textContent = factsText(model.facts);
    this.picked.textContent = "A click on a triangle, or in a list, tells of it.";
    this.fillLists(model, measure);
  }

  /** In place of all that when there is no mesh. */
  tellProblem(problem: string): void {
    this.facts.textContent = problem;
    this.lists.replaceChildren();
  }

  fillLists(model: MeshModel, measure: TriangleMeasure): void {
    const actions: ListActions = {
      showTriangle: (triangle, text) => this.flyToTriangles(model, [triangle], text),
      showPair: (first, second, text) => this.flyToTriangles(model, [first, second], `Intersecting pair ${text}`, kPairColours),
    };
    this.lists.replaceChildren(this.picked, worstList(model.facts, measure, actions), pairList(model.facts, actions));
  }

  /** Highlights a triangle without moving the camera. */
  tellOf(triangle: number): void {
    const model = this.stage.model(this.side);
    if (!model) return;
    model.highlightTriangles([triangle]);
    this.picked.textContent = triangleText(model, triangle);
    this.stage.draw();
  }

  private flyToTriangles(model: MeshModel, triangles: number[], text: string, colours?: readonly string[]): void {
    const first = triangles[0]!;
    model.highlightTriangles(triangles, colours);
    const size = Math.max(...triangles.map((triangle) => model.longestEdge(triangle)));
    this.stage.flyTo(model.middle(first), model.normal(first), kViewingDistance * size);
    this.picked.textContent = triangles.length > 1 ? text : `${text}. ${triangleText(model, first)}`;
  }

  private missingMeshes(molecule: string, views: MoleculeViews): string[] {
    const leftOut = Object.values(views.left_out).map(({ title, why }) => `${title}: ${why}`);
    const absent = this.data.methods
      .filter(({ name }) => !views.meshes[name] && !views.left_out[name] && this.data.cases[molecule]?.[name])
      .map(({ name, title }) => `${title}: ${textAt(this.data.cases[molecule]?.[name], "reason") ?? "no mesh kept"}`);
    return [...leftOut, ...absent];
  }
}

function factsText(facts: MeshFacts): string {
  const parts = [`${count(facts.vertices)} vertices`, `${count(facts.triangles)} triangles`];
  if (facts.shown_triangles + facts.undrawable_triangles < facts.triangles) parts.push(`${count(facts.shown_triangles)} of them shown`);
  if (facts.undrawable_triangles > 0) parts.push(`${count(facts.undrawable_triangles)} too far away or without finite corners, not drawn`);
  return parts.join(", ");
}

function triangleText(model: MeshModel, triangle: number): string {
  const values = kMeasures.map(({ label, id, format }) => `${label} ${format(model.value(triangle, id))}`);
  return `${values.join(", ")}, longest edge ${model.longestEdge(triangle).toPrecision(3)} Å.`;
}
