// What keys do.

export interface Keys {
  toggle: () => void;
  /** By so many seconds. */
  move: (seconds: number) => void;
  /** By so many ticks. */
  step: (ticks: number) => void;
  jump: (way: -1 | 1) => void;
  toEnd: (way: -1 | 1) => void;
  speed: (step: -1 | 1) => void;
  fit: (direction: "perspective" | "front" | "side" | "top") => void;
  plots: () => void;
  theme: () => void;
  about: () => void;
  /** Lets go of what is held, or closes what is over the scene. */
  close: () => void;
  /** Plays the past of a run that is going on. */
  replay: () => void;
  /** Moves what is selected to the right, away or up; whether anything is. */
  nudge: (way: readonly [number, number, number], isFar: boolean) => boolean;
  help: () => void;
}

export function listen(keys: Keys): void {
  const acts: Record<string, (shift: boolean) => void> = {
    " ": keys.toggle,
    ArrowLeft: (shift) => keys.move(shift ? -10 : -1),
    ArrowRight: (shift) => keys.move(shift ? 10 : 1),
    ",": () => keys.step(-1),
    ".": () => keys.step(1),
    "[": () => keys.jump(-1),
    "]": () => keys.jump(1),
    Home: () => keys.toEnd(-1),
    End: () => keys.toEnd(1),
    "-": () => keys.speed(-1),
    "+": () => keys.speed(1),
    "=": () => keys.speed(1),
    f: () => keys.fit("perspective"),
    "1": () => keys.fit("front"),
    "2": () => keys.fit("side"),
    "3": () => keys.fit("top"),
    p: keys.plots,
    t: keys.theme,
    w: keys.about,
    k: keys.replay,
    Escape: keys.close,
    "?": keys.help,
  };
  window.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented || isTyping(event.target)) return;
    const way = WAYS[event.key];
    if (way && !(event.target instanceof HTMLInputElement) && keys.nudge(way, event.shiftKey)) {
      event.preventDefault();
      return;
    }
    const act = acts[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!act || (event.key === " " && isPressed(event.target))) return;
    // Escape closes the help too, which is the browser's to do.
    if (event.key !== "Escape") event.preventDefault();
    act(event.shiftKey);
  });
}

/** To the right, away from who looks, and up. */
const WAYS: Record<string, readonly [number, number, number]> = {
  ArrowLeft: [-1, 0, 0],
  ArrowRight: [1, 0, 0],
  ArrowUp: [0, 1, 0],
  ArrowDown: [0, -1, 0],
  PageUp: [0, 0, 1],
  PageDown: [0, 0, -1],
};

/** Whether space presses the element that has the focus. */
function isPressed(target: EventTarget | null): boolean {
  return target instanceof HTMLButtonElement || (target instanceof HTMLInputElement && target.type === "checkbox");
}

/** Whether keys are for the element that has the focus. */
function isTyping(target: EventTarget | null): boolean {
  if (target instanceof HTMLInputElement) return !["range", "checkbox"].includes(target.type);
  return target instanceof HTMLSelectElement || target instanceof HTMLTextAreaElement;
}
