// Borders of cells from their centres.

/// Of rows that go down: the first begins at the surface.
export function rowEdges(centres: number[]): number[] {
  const edges = [0];
  for (const c of centres) edges.push(2 * c - edges[edges.length - 1]);
  return edges;
}

export function columnEdges(centres: number[]): number[] {
  const n = centres.length;
  if (n === 1) return [centres[0] - 0.5, centres[0] + 0.5];
  const middle = centres.slice(1).map((c, i) => 0.5 * (c + centres[i]));
  return [1.5 * centres[0] - 0.5 * centres[1], ...middle, 1.5 * centres[n - 1] - 0.5 * centres[n - 2]];
}
