// Sliders with a field beside each: a slider for looking around, a field for a number.
import {element} from "../dom";
import {kKnobs, type Knob, type State} from "./state";

/// From the slider's own scale to the shown number and back; stiffness goes by factors.
const toSlider = (k: Knob, shown: number) => (k.log ? Math.log2(Math.max(shown, 1e-6)) : shown);
const fromSlider = (k: Knob, at: number) =>
    (k.log ? Number((2 ** at).toPrecision(3)) : Number((Math.round(at / k.step) * k.step).toPrecision(10)));

export interface Controls {
  node: HTMLElement;
  refresh(): void;
}

function row(knob: Knob, state: State, changed: () => void): {node: HTMLElement; refresh: () => void} {
  const slider = element("input", {type: "range", id: `s-${knob.id}`, "aria-label": knob.name, step: "any"});
  const field =
      element("input", {type: "number", id: `n-${knob.id}`, "aria-label": `${knob.name}, number`, step: "any"});
  const none = element("span", {class: "none"});
  const name = element("span", {class: "name"}, knob.name, knob.unit ? element("small", {}, ` ${knob.unit}`) : null);
  const node = element("label", {class: "knob"}, name, slider, field, none);
  const refresh = () => {
    const value = state.value(knob);
    slider.min = String(toSlider(knob, Math.min(knob.low, value)));
    slider.max = String(toSlider(knob, Math.max(knob.high, value)));
    if (document.activeElement !== slider) slider.value = String(toSlider(knob, value));
    if (document.activeElement !== field) field.value = String(value);
    node.classList.toggle("moved", state.moved.has(knob.id));
    const off = knob.layer >= 0 && !state.has(knob.layer);
    const excluded = off ? null : state.excludedBy(knob);
    slider.disabled = field.disabled = excluded !== null || (off && knob.key !== "thickness");
    none.textContent = excluded ?? knob.zeroIsNone ?? "";
    node.classList.toggle("empty", excluded !== null || (knob.zeroIsNone !== undefined && value === 0));
  };
  const take = (shown: number) => {
    state.set(knob, shown);
    refresh();
    changed();
  };
  slider.addEventListener("input", () => {
    field.value = String(fromSlider(knob, Number(slider.value)));
    take(fromSlider(knob, Number(slider.value)));
  });
  field.addEventListener("input", () => {
    if (field.value === "" || !Number.isFinite(field.valueAsNumber)) return;
    slider.value = String(toSlider(knob, field.valueAsNumber));
    take(field.valueAsNumber);
  });
  return {node, refresh};
}

export function controls(state: State, changed: () => void): Controls {
  const refreshers: (() => void)[] = [];
  const refresh = () => refreshers.forEach((r) => r());
  const all = () => {
    refresh();
    changed();
  };
  const groups = [...new Set(kKnobs.map((k) => k.group))];
  const parts = groups.map((group) => {
    const rows = kKnobs.filter((k) => k.group === group).map((k) => row(k, state, all));
    refreshers.push(...rows.map((r) => r.refresh));
    const used = kKnobs.some((k) => k.group === group && state.value(k) !== 0);
    const narrow = window.innerWidth < 640;  // a telephone has no room for all of them at once
    const open = group === "Layer" || (!narrow && group !== "Strength" && used);
    const box = element("details", open ? {open: ""} : {}, element("summary", {}, group), ...rows.map((r) => r.node));
    return box;
  });
  refresh();
  return {node: element("div", {class: "controls"}, ...parts), refresh};
}
