// Profiles by drag and drop, or by a file dialogue. What is wrong with one the engine's own reader says.
import {element} from "../dom";

export type Kind = "rail"|"wheel";
const kLargest = 4 << 20;
const kEndings: Record<string, Kind> = {
  prr: "rail",
  ban: "rail",
  prw: "wheel",
  whl: "wheel"
};

export interface Profiles {
  node: HTMLElement;
  name(kind: Kind, words: string): void;
}

/// A name that a case file and a command line can hold as it is.
const plainName = (name: string) => name.replace(/[^\w.-]+/g, "_").replace(/^[.-]+/, "") || "profile.txt";

export function profiles(
    take: (kind: Kind, name: string, text: string) => void, refuse: (words: string) => void): Profiles {
  const names: Partial<Record<Kind, HTMLElement>> = {};
  const read = async (kind: Kind, file: File|undefined) => {
    if (!file) return;
    if (file.size > kLargest) return refuse(`${file.name} is larger than 4 MiB: a profile has a few kilobytes`);
    take(kind, plainName(file.name), await file.text());
  };
  const zone = (kind: Kind) => {
    const input = element("input", {type: "file", id: `profile-${kind}`, "aria-label": `profile of the ${kind}`});
    const name = element("span", {class: "which"}, "of the case");
    names[kind] = name;
    const node = element("label", {class: "drop"}, element("b", {}, kind === "rail" ? "Rail" : "Wheel"), name, input);
    input.onchange = () => {
      void read(kind, input.files?.[0]);
      input.value = "";
    };
    node.ondragover = (e) => {
      e.preventDefault();
      node.classList.add("over");
    };
    node.ondragleave = () => node.classList.remove("over");
    node.ondrop = (e) => {
      e.preventDefault();
      e.stopPropagation();
      node.classList.remove("over");
      void read(kind, e.dataTransfer?.files[0]);
    };
    return node;
  };
  // Anywhere else on the page the ending says whose profile it is; without this the browser would open the file.
  document.addEventListener("dragover", (e) => e.preventDefault());
  document.addEventListener("drop", (e) => {
    e.preventDefault();
    const file = e.dataTransfer?.files[0];
    const kind = file && kEndings[file.name.split(".").pop()!.toLowerCase()];
    if (kind)
      void read(kind, file);
    else if (file)
      refuse(`${file.name}: rail or wheel? Drop it on one of the two fields`);
  });
  const node = element(
      "details", {}, element("summary", {}, "Profiles"),
      element("p", {class: "note"}, "Drop a profile here, or choose one: two columns, Simpack, MiniProf."),
      zone("rail"), zone("wheel"));
  return {node, name: (kind, words) => names[kind]!.replaceChildren(words)};
}
