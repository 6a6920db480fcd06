// What this page is, for newcomers, and its keys.

import { button, element, icon } from "../element";
import type { FrameTimes } from "../frame_times";
import type { Session } from "../live/session";

const CLOSE = "M4 4l8 8M12 4l-8 8";

const ABOUT =
  "A robot arm and its list of tasks, the most important first. An equality task wants one value, such as " +
  "the tool at a point. A set-based task only wants to stay within an interval: 18 cm or more from that, no " +
  "more than 15° away from there. While it is inside, it costs nothing. Only where the rest would push it " +
  "out does it become active: it is held at its border and lights up, and the tasks below get what freedom " +
  "is left. The coloured strip shows which were active when";

export const KEYS: readonly (readonly [string, string])[] = [
  ["space", "play, pause"],
  ["← →", "a second back, on; with shift, ten"],
  [", .", "a tick back, on"],
  ["[ ]", "to the change of mode before, after"],
  ["home end", "to the beginning, the end"],
  ["− +", "slower, faster"],
  ["F 1 2 3", "see everything; from the front, the side, above"],
  ["P", "plots on, off"],
  ["T", "light, dark"],
  ["W", "what am I looking at?"],
  ["?", "this help"],
];

/** What keys do besides in a run that is going on. */
const LIVE_KEYS: readonly (readonly [string, string])[] = [
  ["space", "pause, resume the run; where it may not be paused, hold the view"],
  [".", "a tick on, while the run is paused"],
  ["end", "to now"],
  ["K", "replay the past from here"],
  ["← → ↑ ↓", "move what is selected left, right, away, nearer; with shift, farther"],
  ["page↑ page↓", "move it up, down"],
  ["alt ↑ ↓", "make the task that has the focus more, less important"],
  ["esc", "let go; what is dragged goes back to where it was"],
];

/** The explanation, which can be closed; `invitation` says what there is to try. */
export function about(close: () => void, invitation: HTMLElement | null = null): HTMLElement {
  return element(
    "aside",
    { class: "about", "aria-label": "What am I looking at?" },
    element("div", { class: "line" }, element("h2", {}, "What am I looking at?"), button("Close", icon(CLOSE), close)),
    element("p", {}, invitation ? `${ABOUT}.` : `${ABOUT}; press play and watch the arm meet them.`),
    ...(invitation ? [invitation] : []),
  );
}

export class Help {
  readonly element = element("dialog", { "aria-label": "Keys and help" });
  private readonly timing = element("p", { class: "soft timing" });

  /** `session` is that of a run that is going on. */
  constructor(private readonly frames: FrameTimes, private readonly session: Session | null = null) {
    const isLive = session !== null;
    const own = (keys: string) => isLive && LIVE_KEYS.some(([others]) => others === keys);
    const all = [...(isLive ? LIVE_KEYS : []), ...KEYS.filter(([keys]) => !own(keys))];
    const rows = all.map(([keys, does]) => element("tr", {}, element("th", { scope: "row" }, ...caps(keys)), element("td", {}, does)));
    this.element.append(
      element("div", { class: "line" }, element("h2", {}, "Keys"), button("Close", icon(CLOSE), () => this.element.close())),
      element("table", {}, element("tbody", {}, ...rows)),
      element("p", {}, "Drag in the scene to turn it, with the right button to move it; scroll to come closer. Point at a task to find it in the scene, or the other way round. A link to this page leads to the moment that it shows."),
      this.timing,
    );
    // A press beside the dialog is on the dialog itself, one within it on something in it.
    this.element.addEventListener("click", (event) => {
      if (event.target === this.element) this.element.close();
    });
  }

  toggle(): void {
    if (this.element.open) {
      this.element.close();
      return;
    }
    const { frames, median, p99 } = this.frames.summary;
    const frame = `Script for a frame, last ${frames}: median ${median.toFixed(2)} ms, 99 % below ${p99.toFixed(2)} ms`;
    const { messages, ms } = this.session?.heard ?? { messages: 0, ms: 0 };
    const message = messages > 0 ? `; for a message of the run, mean of ${messages}: ${(ms / messages).toFixed(2)} ms` : "";
    this.timing.textContent = frame + message;
    this.element.showModal();
  }
}

function caps(keys: string): (Node | string)[] {
  return keys.split(" ").flatMap((key) => [element("kbd", {}, key), " "]);
}
