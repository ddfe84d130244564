// Elements in one line each; text is always set as text, never as markup.
export type Child = Node|string|null;

export function element<K extends keyof HTMLElementTagNameMap>(
    tag: K, attributes: Record<string, string> = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const e = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes))
    if (name === "style")
      e.style.cssText = value;  // the page's policy allows no attribute of it
    else
      e.setAttribute(name, value);
  for (const child of children)
    if (child !== null) e.append(child);
  return e;
}

/// A heading with its part of the page, reachable from the contents line.
export function part(id: string, title: string, ...children: Child[]): HTMLElement {
  return element("section", {id}, element("h2", {}, title), ...children);
}

export interface Cell {
  text: string;
  attributes?: Record<string, string>;
}
export function table(
    caption: string, head: string[], rows: (string|Cell)[][], attributes: Record<string, string> = {}): HTMLElement {
  const title = caption ? element("caption", {}, caption) : null;
  const body = element("tbody", {}, ...rows.map(tableRow));
  return element("div", {class: "scroll"}, element("table", attributes, title, tableHead(head), body));
}

export function tableHead(names: string[]): HTMLElement {
  return element("thead", {}, element("tr", {}, ...names.map((name) => element("th", {scope: "col"}, name))));
}

function tableRow(cells: (string|Cell)[]): HTMLElement {
  return element("tr", {}, ...cells.map((c, k) => tableCell(k === 0 ? "th" : "td", c)));
}

function tableCell(tag: "th"|"td", c: string|Cell): HTMLElement {
  return typeof c === "string" ? element(tag, {}, c) : element(tag, c.attributes ?? {}, c.text);
}

/// A paragraph in small letters.
export function note(...children: Child[]): HTMLElement { return element("p", {class: "note"}, ...children); }

/// What is shown on demand.
export function details(summary: string, ...children: Child[]): HTMLDetailsElement {
  return element("details", {}, element("summary", {}, summary), ...children);
}

/// What the program has put into the page.
export const embedded = (id: string) => document.getElementById(id)?.textContent ?? "";

/// Offers a file; nothing leaves the page.
export function download(name: string, content: string|Blob): void {
  const file = typeof content === "string" ? new Blob([content], {type: "text/csv;charset=utf-8"}) : content;
  const address = URL.createObjectURL(file);
  const link = element("a", {href: address, download: name});
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}

/// Copies a text; where the browser refuses (no focus, an old one) it is shown to be copied by hand.
export async function copy(text: string, done: (words: string) => void, what: string): Promise<void> {
  try {
    await navigator.clipboard.writeText(text);
    done(`${what} copied`);
  } catch {
    const area = element("textarea", {class: "copied", readonly: "", rows: "6", "aria-label": what});
    area.value = text;
    const close = element("button", {}, "Close");
    const dialog = element("dialog", {}, element("p", {}, `${what}: copy it from here`), area, close);
    close.onclick = () => dialog.remove();
    document.body.append(dialog);
    dialog.showModal();
    area.select();
  }
}
