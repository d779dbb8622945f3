type Attributes = Record<string, string | number | boolean>;

/** An element with attributes and children; a string is a text, never markup. */
export function element<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: (Node | string)[]
): HTMLElementTagNameMap[K] {
  const result = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) if (value !== false) result.setAttribute(name, value === true ? "" : String(value));
  result.append(...children);
  return result;
}

export interface Choice {
  value: string;
  label: string;
}

/** A labelled list to choose from; calls `onChange` with the chosen value. */
export function chooser(label: string, id: string, choices: Choice[], chosen: string, onChange: (value: string) => void) {
  const select = element("select", { id });
  for (const { value, label: text } of choices) select.append(element("option", { value, selected: value === chosen }, text));
  select.addEventListener("change", () => onChange(select.value));
  return { box: element("label", { class: "control", for: id }, `${label} `, select), select };
}

export function checkbox(label: string, id: string, isChecked: boolean, onChange: (isChecked: boolean) => void): HTMLElement {
  const input = element("input", { type: "checkbox", id, checked: isChecked });
  input.addEventListener("change", () => onChange(input.checked));
  return element("label", { class: "control", for: id }, input, ` ${label}`);
}

export function button(label: string, id: string, title: string, onClick: () => void): HTMLButtonElement {
  const result = element("button", { type: "button", id, title, "aria-label": title }, label);
  result.addEventListener("click", onClick);
  return result;
}

/** A plain table with one head row; texts flush left, numbers (as made by format.ts) right. */
export function plainTable(heads: string[], rows: (string | Node)[][], attributes: Attributes = {}): HTMLTableElement {
  const head = element("tr", {}, ...heads.map((text) => element("th", { scope: "col" }, text)));
  const body = rows.map((cells) =>
    element("tr", {}, ...cells.map((cell, i) => (i === 0 ? element("th", { scope: "row" }, cell) : element("td", {}, cell)))),
  );
  return element("table", { class: "plain", ...attributes }, element("thead", {}, head), element("tbody", {}, ...body));
}

export function byId(id: string): HTMLElement {
  const found = document.getElementById(id);
  if (!found) throw new Error(`no element ${id}`);
  return found;
}
