import "tabulator-tables/dist/css/tabulator_simple.min.css";
import "./style.css";

import { showFigures } from "./charts/figures";
import { readData } from "./data";
import { byId } from "./dom";
import { showProvenance } from "./provenance";
import { showSummary } from "./summary";
import { showTables } from "./tables";
import { showMeshes } from "./viewer/viewer";

const data = readData();
document.title = `SMOPT report: ${data.name}`;
showSummary(byId("summary"), data);
showTables(byId("tables"), data);
showFigures(byId("figures"), data);
showMeshes(byId("meshes"), data);
showProvenance(byId("provenance"), data);
