// Elements in one line each; text is always set as text, never as markup.
type Child = Node|string|null;

export function element<K extends keyof HTMLElementTagNameMap>(
    tag: K, attributes: Record<string, string> = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const e = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) e.setAttribute(name, value);
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
  const cell = (tag: "th"|"td", c: string|Cell) =>
      (typeof c === "string" ? element(tag, {}, c) : element(tag, c.attributes ?? {}, c.text));
  return element(
      "div",
      {class: "scroll"},
      element(
          "table",
          attributes,
          caption ? element("caption", {}, caption) : null,
          element("thead", {}, element("tr", {}, ...head.map((h) => element("th", {scope: "col"}, h)))),
          element(
              "tbody", {},
              ...rows.map((row) => element("tr", {}, ...row.map((c, k) => cell(k === 0 ? "th" : "td", c))))),
          ),
  );
}

/// Offers a text as a file; nothing leaves the page.
export function download(name: string, text: string): void {
  const address = URL.createObjectURL(new Blob([text], {type: "text/csv;charset=utf-8"}));
  const link = element("a", {href: address, download: name});
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}
