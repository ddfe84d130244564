// Colours and letters of the figures.

export interface Theme {
  ink: string;
  soft: string;
  grid: string;
  paper: string;
  series: string[];   // runs, in order
  reference: string;  // theory
  stick: string;
  slip: string;
  size: number;  // of letters, px
}

// Okabe and Ito's colours, told apart with any colour vision; brighter on dark paper.
export const kLight: Theme = {
  ink: "#1b1f24",
  soft: "#59636e",
  grid: "#dfe3e8",
  paper: "#ffffff",
  reference: "#59636e",
  stick: "#0072b2",
  slip: "#e69f00",
  size: 12,
  series: ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#7a6400", "#56b4e9"],
};
export const kDark: Theme = {
  ink: "#e6e9ed",
  soft: "#a3adb8",
  grid: "#343b44",
  paper: "#16191d",
  reference: "#a3adb8",
  stick: "#3b9edb",
  slip: "#f0b22a",
  size: 12,
  series: ["#56b4e9", "#f28b3c", "#3fcf9f", "#e59bc5", "#d8c23f", "#9fd0f0"],
};

const kFont = 'system-ui, -apple-system, "Segoe UI", Roboto, "DejaVu Sans", sans-serif';
export const letters = (size: number, weight = "") => `${weight} ${size}px ${kFont}`.trim();
