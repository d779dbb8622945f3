import type { MoleculeViews, ReportData } from "../data";
import { type Choice, button, checkbox, chooser, element } from "../dom";
import { count, fixed } from "../format";
import { unpackMesh } from "../unpack";
import { cssGradient, kColourMaps } from "./colour_map";
import { MeshModel, kPairColours } from "./mesh_model";
import { Pane } from "./pane";
import { type Side, Stage, kSides } from "./stage";
import { type TriangleMeasure, kMeasures } from "./triangle_measures";

/** What is compared at first. */
const kFirstShown: [string, string] = ["initial", "smopt"];
/** Of the distances from the middle, the share within which all is shown at first: an outlier of a diverged mesh does not count. */
const kShownShare = 0.995;

/** The 3D view of the run's meshes. */
class Viewer {
  private molecule: string;
  private methods: [string, string] = [...kFirstShown];
  private measure: TriangleMeasure = kMeasures[0]!;
  private colourMap = kColourMaps[0]!;
  private hasEdges = true;
  private hasPairs = true;
  private readonly stage: Stage;
  private readonly panes: [Pane, Pane];
  private readonly legend = element("div", { class: "legend" });
  private readonly part = element("p", { class: "note", id: "shown-part" });
  private readonly loading = element("p", { class: "loading", role: "status" });
  private unpacking = 0; // meshes

  constructor(
    section: HTMLElement,
    private readonly data: ReportData,
    box: HTMLElement,
  ) {
    this.molecule = shownMolecules(data)[0]!.value;
    this.stage = new Stage(box, (side, triangle) => this.panes[side].tellOf(triangle));
    this.panes = [new Pane(0, data, this.stage), new Pane(1, data, this.stage)];
    const heads = element("div", { class: "pane-heads" }, this.panes[0].head, this.panes[1].head);
    const lists = element("div", { class: "pane-heads" }, this.panes[0].lists, this.panes[1].lists);
    box.append(this.loading);
    section.append(this.toolbar(), this.legend, this.part, heads, box, this.help(), lists);
    this.drawLegend();
  }

  async showMolecule(molecule: string): Promise<void> {
    this.molecule = molecule;
    const views = this.views();
    const available = Object.keys(views.meshes);
    for (const side of kSides) {
      if (!available.includes(this.methods[side])) this.methods[side] = available.includes(kFirstShown[side]) ? kFirstShown[side] : (available[side] ?? available[0] ?? "");
      this.panes[side].offerMeshes(molecule, views, this.methods[side], (method) => void this.showMesh(side, method));
    }
    this.part.textContent = partText(views);
    await Promise.all(kSides.map((side) => this.showMesh(side, this.methods[side])));
    this.showAll();
  }

  private async showMesh(side: Side, method: string): Promise<void> {
    this.methods[side] = method;
    const molecule = this.molecule;
    const facts = this.views().meshes[method];
    if (!facts) {
      this.stage.setModel(side, undefined);
      this.panes[side].tellProblem("There is no mesh to show.");
      return;
    }
    this.countUnpacking(1);
    try {
      const arrays = await unpackMesh(facts.positions, facts.indices);
      if (this.molecule === molecule && this.methods[side] === method) this.putOnStage(side, new MeshModel(arrays, facts));
    } catch (error) {
      this.stage.setModel(side, undefined);
      this.panes[side].tellProblem(`The mesh cannot be shown: ${error instanceof Error ? error.message : String(error)}`);
    } finally {
      this.countUnpacking(-1);
    }
  }

  private putOnStage(side: Side, model: MeshModel): void {
    model.showEdges(this.hasEdges);
    model.showPairs(this.hasPairs);
    model.colour(this.measure, this.colourMap.map);
    this.stage.setModel(side, model);
    this.panes[side].describe(model, this.measure);
  }

  private countUnpacking(change: number): void {
    this.unpacking += change;
    this.loading.textContent = this.unpacking > 0 ? "Unpacking …" : "";
  }

  private views(): MoleculeViews {
    return this.data.views[this.molecule]!;
  }

  private toolbar(): HTMLElement {
    const measures: Choice[] = kMeasures.map(({ id, label }) => ({ value: id, label }));
    const maps: Choice[] = kColourMaps.map(({ id, label }) => ({ value: id, label }));
    return element(
      "div",
      { class: "toolbar" },
      chooser("Molecule", "mesh-molecule", shownMolecules(this.data), this.molecule, (value) => void this.showMolecule(value)).box,
      chooser("Colour by", "mesh-measure", measures, this.measure.id, (value) => this.setMeasure(value)).box,
      chooser("Colours", "mesh-colours", maps, this.colourMap.id, (value) => this.setColours(value)).box,
      checkbox("edges", "mesh-edges", this.hasEdges, (isShown) => this.toggle("hasEdges", isShown)),
      checkbox("intersecting pairs", "mesh-pairs", this.hasPairs, (isShown) => this.toggle("hasPairs", isShown)),
      button("+", "mesh-zoom-in", "Zoom in", () => this.stage.zoom(0.7)),
      button("−", "mesh-zoom-out", "Zoom out", () => this.stage.zoom(1 / 0.7)),
      button("Show all", "mesh-reset", "Show all of both meshes", () => this.showAll()),
    );
  }

  private help(): HTMLElement {
    return element("p", { class: "note" }, "Drag to turn, wheel to zoom, right button to move; arrow keys, + and −, Home. Both sides move together.");
  }

  private setMeasure(id: string): void {
    this.measure = kMeasures.find((measure) => measure.id === id) ?? this.measure;
    this.recolour();
    for (const side of kSides) {
      const model = this.stage.model(side);
      if (model) this.panes[side].fillLists(model, this.measure);
    }
  }

  private setColours(id: string): void {
    this.colourMap = kColourMaps.find((map) => map.id === id) ?? this.colourMap;
    this.recolour();
  }

  private recolour(): void {
    for (const side of kSides) this.stage.model(side)?.colour(this.measure, this.colourMap.map);
    this.drawLegend();
    this.stage.draw();
  }

  private toggle(what: "hasEdges" | "hasPairs", isShown: boolean): void {
    this[what] = isShown;
    for (const side of kSides) {
      this.stage.model(side)?.showEdges(this.hasEdges);
      this.stage.model(side)?.showPairs(this.hasPairs);
    }
    this.stage.draw();
  }

  private showAll(): void {
    for (const side of kSides) this.stage.model(side)?.clearHighlight();
    const first = kSides.map((side) => this.stage.model(side)).find((model) => model !== undefined);
    if (first) this.stage.showAll(radiusOf(first.arrays.positions));
  }

  private drawLegend(): void {
    const { worst, best, unit, label } = this.measure;
    const bar = element("span", { class: "gradient", role: "img", "aria-label": `colours of ${label}` });
    bar.style.background = cssGradient(this.colourMap.map);
    const keys = kPairColours.map((colour) => {
      const key = element("span", { class: "key" });
      key.style.background = colour;
      return key;
    });
    this.legend.replaceChildren(`${label}: ${best}${unit} `, bar, ` ${worst}${unit}`, element("span", { class: "keys" }, ...keys, " the two triangles of an intersecting pair"));
  }
}

/** Of a ball around the middle that holds nearly all vertices. */
function radiusOf(positions: Float32Array): number {
  const distances = new Float32Array(positions.length / 3);
  for (let i = 0; i < distances.length; ++i) distances[i] = Math.hypot(positions[3 * i]!, positions[3 * i + 1]!, positions[3 * i + 2]!);
  distances.sort();
  return distances[Math.floor(kShownShare * (distances.length - 1))] || 1;
}

function shownMolecules(data: ReportData): Choice[] {
  return data.molecules.filter(({ name }) => Object.keys(data.views[name]?.meshes ?? {}).length > 0).map(({ name, title }) => ({ value: name, label: title }));
}

function partText(views: MoleculeViews): string {
  if (views.radius === null) return "";
  const most = Math.max(...Object.values(views.meshes).map(({ shown_triangles }) => shown_triangles));
  return (
    `The mesh is too large to be shown whole: what is shown is a ball of ${fixed(views.radius, 1)} Å around the initial mesh's worst place ` +
    `(its first intersecting pair, or its smallest angle), the same for all methods, with up to ${count(most)} triangles. ` +
    "Ranks in the lists count all triangles of the mesh; the pairs are those of the part shown."
  );
}

export function showMeshes(section: HTMLElement, data: ReportData): void {
  if (shownMolecules(data).length === 0) {
    const why = "This run has no meshes, so there is nothing to show in space. `smopt reproduce --keep-meshes` keeps them.";
    section.append(element("p", { id: "no-meshes" }, why));
    return;
  }
  try {
    const viewer = new Viewer(section, data, element("div", { class: "stage", id: "stage" }));
    void viewer.showMolecule(shownMolecules(data)[0]!.value);
  } catch (error) {
    const reason = error instanceof Error ? error.message : String(error);
    section.append(element("p", { id: "no-webgl" }, `The meshes cannot be shown: this browser gives no WebGL (${reason}).`));
  }
}
