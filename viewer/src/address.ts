// The time in the page's address, `#t=12.3`, so that a link leads to a moment.

export function timeIn(hash: string): number | null {
  const t_s = Number(/^#t=(-?\d+(?:\.\d+)?)$/.exec(hash)?.[1]);
  return Number.isNaN(t_s) ? null : t_s;
}

/** `12.3` and never `12.300000000000001`. */
export function hashOf(t_s: number): string {
  return `#t=${Number(t_s.toFixed(4))}`;
}
