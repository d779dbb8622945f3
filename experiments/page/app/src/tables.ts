import { type CellComponent, type ColumnDefinition, TabulatorFull as Tabulator } from "tabulator-tables";

import type { Cell, ReportData, Table } from "./data";
import { element } from "./dom";
import { fixed, kNothing } from "./format";

/** A table's text column gets a list of its values to choose from when it has no more than so many. */
const kListedValues = 40;
/** Taller tables scroll in themselves. */
const kTallestTable = 640;

// Widths of columns, pixels; a longer text is cut and shown whole in its tooltip.
const kCharacter = 8.3;
const kHeadCharacter = 8.6;
const kHeadLines = 3;
const kPadding = 24;
const kSortArrow = 26;
const kWidestColumn = 330;

type Row = Record<string, Cell>;

const kTitles: Record<string, string> = { table1: "Table 1", table2: "Table 2", table3: "Table 3", methods: "All methods" };

function cellText(cell: Cell): string {
  if (cell === null || cell === undefined) return kNothing;
  if (typeof cell === "string") return cell;
  return typeof cell === "number" ? fixed(cell, 0) : fixed(cell[0], cell[1]);
}

function cellNumber(cell: Cell): number | undefined {
  if (typeof cell === "number") return cell;
  if (Array.isArray(cell)) return cell[0];
  if (typeof cell === "string" && cell.trim() !== "" && Number.isFinite(Number(cell))) return Number(cell);
  return undefined;
}

/** Numbers before texts; what is missing stays last whichever way is sorted. */
function compareCells(a: Cell, b: Cell, direction: string): number {
  const sign = direction === "desc" ? -1 : 1;
  if (a === null || b === null) return a === b ? 0 : sign * (a === null ? 1 : -1);
  const x = cellNumber(a);
  const y = cellNumber(b);
  if (x !== undefined && y !== undefined) return x - y;
  if (x === undefined && y === undefined) return String(a).localeCompare(String(b));
  return x === undefined ? 1 : -1;
}

function escapeMarkup(text: string): string {
  return element("span", {}, text).innerHTML;
}

function isTextColumn(rows: Row[], field: string): boolean {
  return rows.some((row) => row[field] !== null && cellNumber(row[field] ?? null) === undefined);
}

function columnFilter(rows: Row[], field: string): Partial<ColumnDefinition> {
  const texts = [...new Set(rows.map((row) => cellText(row[field] ?? null)))];
  if (texts.length < 2) return {};
  const matches = (wanted: string, cell: Cell) => !wanted || cellText(cell) === wanted;
  if (texts.length > kListedValues) {
    return { headerFilter: "input", headerFilterFunc: (wanted, cell) => cellText(cell as Cell).toLowerCase().includes(String(wanted).toLowerCase()) };
  }
  return { headerFilter: "list", headerFilterParams: { values: texts, clearable: true }, headerFilterFunc: matches };
}

function column(table: Table, index: number, rows: Row[]): ColumnDefinition {
  const { id, title } = table.columns[index]!;
  const field = `c${index}`;
  const isText = isTextColumn(rows, field);
  const isPaper = title === "paper";
  return {
    title: escapeMarkup(title),
    field,
    headerTooltip: id.replaceAll("_", " "),
    hozAlign: isText ? "left" : "right",
    headerHozAlign: isText ? "left" : "right",
    cssClass: isPaper ? "paper" : "",
    frozen: index === 0,
    width: columnWidth(title, rows, field),
    headerWordWrap: true,
    formatter: (cell: CellComponent) => escapeMarkup(cellText(cell.getValue() as Cell)),
    tooltip: (_event, cell: CellComponent) => escapeMarkup(cellText(cell.getValue() as Cell)),
    sorter: (a, b, _row1, _row2, _column, direction) => compareCells(a as Cell, b as Cell, direction),
    ...(isText ? columnFilter(rows, field) : {}),
  };
}

/** As wide as its longest cell, the longest word of its head, and what lets the head stand in a few lines. */
function columnWidth(title: string, rows: Row[], field: string): number {
  const longestCell = Math.max(...rows.map((row) => cellText(row[field] ?? null).length));
  const longestWord = Math.max(...title.split(/[\s-]/).map((word) => word.length));
  const head = kHeadCharacter * Math.max(longestWord, title.length / kHeadLines + 2) + kSortArrow;
  return kPadding + Math.min(kWidestColumn, Math.max(kCharacter * longestCell, head));
}

function rowsOf(table: Table): Row[] {
  return table.rows.map((cells) => Object.fromEntries(cells.map((cell, index) => [`c${index}`, cell])));
}

/** A field that keeps the rows in which any cell holds the text. */
function searchField(name: string, grid: Tabulator): HTMLElement {
  const input = element("input", { type: "search", id: `search-${name}`, placeholder: "text in any cell" });
  input.addEventListener("input", () => {
    const wanted = input.value.toLowerCase();
    grid.setFilter((row: Row) => Object.keys(row).some((field) => /^c\d+$/.test(field) && cellText(row[field] ?? null).toLowerCase().includes(wanted)));
  });
  return element("label", { class: "control", for: `search-${name}` }, "Search ", input);
}

function showTable(section: HTMLElement, table: Table): void {
  const rows = rowsOf(table);
  const place = element("div", { id: `table-${table.name}` });
  const heading = element("h3", {}, kTitles[table.name] ?? table.name);
  const toolbar = element("div", { class: "toolbar" });
  section.append(heading, element("p", {}, table.caption.replace(/^Table \d+\. /, "")), toolbar, place);
  const grid = new Tabulator(place, {
    data: rows,
    columns: table.columns.map((_, index) => column(table, index, rows)),
    layout: "fitData",
    maxHeight: kTallestTable,
    columnHeaderSortMulti: true,
    placeholder: "No row fits",
  });
  toolbar.append(searchField(table.name, grid), element("span", { class: "note" }, "A click on a head sorts; with Shift, by several."));
  if (table.notes.length > 0) section.append(element("ul", { class: "note" }, ...table.notes.map((note) => element("li", {}, note))));
}

export function showTables(section: HTMLElement, data: ReportData): void {
  for (const table of data.tables) showTable(section, table);
}
