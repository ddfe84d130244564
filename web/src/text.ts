// How numbers are written for people.

/// Four significant digits, no exponent where it can be avoided; "–" for no number.
export function numberText(value: number|null|undefined, digits = 4): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size < 1e-4 || size >= 1e7) {
    const [mantissa, power] = value.toExponential(digits - 1).split("e");
    return `${minus(mantissa.replace(/\.?0+$/, ""))} × ${powerOfTen(Number(power))}`;
  }
  const decimals = Math.max(0, digits - 1 - Math.floor(Math.log10(size)));
  return minus(value.toFixed(Math.min(decimals, 8)));
}

/// An error bar after its value: " ± 6.1"; empty where there is none.
export function barText(error: number|null|undefined): string {
  return typeof error === "number" && Number.isFinite(error) ? ` ± ${numberText(error, 2)}` : "";
}

/// Two digits and a power of ten: "3.1 × 10⁻⁴".
export function powerText(value: number|null|undefined): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const [mantissa, power] = value.toExponential(1).split("e");
  return `${minus(mantissa)} × ${powerOfTen(Number(power))}`;
}

/// A whole number in groups of three.
export function countText(value: number|null): string {
  return value === null ? "–" : String(Math.round(value)).replace(/\B(?=(\d{3})+$)/g, "\u202f");
}

/// So many decimals, never "−0.00".
export function fixedText(value: number, decimals: number): string {
  const text = value.toFixed(decimals);
  return minus(Number(text) === 0 ? text.replace("-", "") : text);
}

export function minus(text: string): string { return text.replace("-", "−"); }

function superscript(n: number): string {
  return String(n).split("").map((c) => (c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(c)])).join("");
}

export const powerOfTen = (power: number) => `10${superscript(power)}`;

export function percentText(fraction: number|null, digits = 2): string {
  if (fraction === null || !Number.isFinite(fraction)) return "–";
  const text = (100 * fraction).toFixed(digits);
  if (Number(text) === 0) return `${text.replace("-", "")} %`;
  return `${fraction > 0 ? "+" : ""}${minus(text)} %`;
}

/// Words with values in them: "p %{y:.1f} MPa"; f: so many decimals, g: so many digits, e: with a power of ten.
export function filled(template: string, values: Record<string, number>): string {
  return template.replace(/%\{(\w)(?::\.(\d)([fge]))?\}/g, (_, name: string, digits: string, form: string) => {
    if (form === "f") return fixedText(values[name], Number(digits));
    if (form === "e") return powerText(values[name]);
    return form === "g" ? numberText(values[name], Number(digits)) : String(values[name]);
  });
}
