// The explorer on the case of the report, in a frame of its own (src/doors/explore/page.cpp): there if it was asked
// for.
import {details, element, note, part} from "../dom";

const page = () => document.getElementById("what-if-page");

export const hasWhatIf = () => page() !== null;

/// The engine starts when the part is opened for the first time.
export function whatIfPart(): HTMLElement[] {
  const text = page()?.textContent;
  if (!text) return [];
  const words = note(
      "Sliders for layers, load, traction, friction and place; the contact is computed in this page, and nothing ",
      "is sent. It begins with the case of this report and is compared with the report’s numbers; dotted: the report.");
  const fold = details("Open the explorer");
  fold.id = "what-if-fold";
  fold.addEventListener("toggle", () => {
    if (!fold.open || fold.querySelector("iframe")) return;
    const frame = element("iframe", {class: "what-if", title: "What if? Sliders and the contact that follows them"});
    frame.srcdoc = JSON.parse(text) as string;
    fold.append(frame);
  });
  return [part("what-if", "What if?", words, fold)];
}
