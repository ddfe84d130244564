// Elements in one line each; text is always set as text, never as markup.
export type Child = Node|string|null;

export function element<K extends keyof HTMLElementTagNameMap>(
    tag: K, attributes: Record<string, string> = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const e = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) e.setAttribute(name, value);
  for (const child of children)
    if (child !== null) e.append(child);
  return e;
}

/// What the program has put into the page.
export const embedded = (id: string) => document.getElementById(id)?.textContent ?? "";

/// Offers a text as a file; nothing leaves the page.
export function download(name: string, text: string, type = "text/csv"): void {
  const address = URL.createObjectURL(new Blob([text], {type: `${type};charset=utf-8`}));
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
