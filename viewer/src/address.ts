// The time in the page's address, `#t=12.3`, so that a link leads to a moment.

/** The window whose address is shown: of a page in a frame of a report, the report's. */
export function addressed(): Window {
  if (location.href !== "about:srcdoc") return window;
  try {
    // Whoever may not read it may not write it either.
    return window.parent.location.href ? window.parent : window;
  } catch {
    return window;
  }
}

export function timeIn(hash: string): number | null {
  const t_s = Number(/^#t=(-?\d+(?:\.\d+)?)$/.exec(hash)?.[1]);
  return Number.isNaN(t_s) ? null : t_s;
}

/** `12.3` and never `12.300000000000001`. */
export function hashOf(t_s: number): string {
  return `#t=${Number(t_s.toFixed(4))}`;
}

/** Writes a moment into that address. What stands there already is left: to write it would undo a Back on its way. */
export function write(addressed: Window, t_s: number): void {
  const hash = hashOf(t_s);
  if (addressed.location.hash !== hash) addressed.history.replaceState(null, "", hash);
}

/** Calls `go` whenever somebody goes to another moment in that address. */
export function onMoment(addressed: Window, go: (t_s: number) => void): void {
  const told = () => {
    const t_s = timeIn(addressed.location.hash);
    if (t_s !== null) go(t_s);
  };
  addressed.addEventListener("hashchange", told);
  // A report outlives its frames.
  if (addressed !== window) window.addEventListener("pagehide", () => addressed.removeEventListener("hashchange", told));
}
