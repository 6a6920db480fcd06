// Play, pause, steps, speed, and the time.

import { type Clock, SPEEDS } from "../clock";
import { button, element, icon, mark, say } from "../element";
import { fixed } from "../quantity";

const PLAY = "M4.5 2.5v11l9-5.5z";
const PAUSE = "M4 2.5h3v11H4zM9 2.5h3v11H9z";
const BACK = "M12.5 2.5v11l-7-5.5zM3.5 2.5h1.6v11H3.5z";
const ON = "M3.5 2.5v11l7-5.5zM10.9 2.5h1.6v11h-1.6z";

export class Transport {
  readonly element: HTMLElement;
  private readonly time = element("span", { class: "clock" });
  private readonly play: HTMLButtonElement;
  private readonly speed = element("select", { "aria-label": "Speed of replay" });

  constructor(private readonly clock: Clock, jump: (way: -1 | 1) => void) {
    this.play = button("Play", icon(PLAY), () => clock.toggle(), "space");
    this.play.classList.add("play");
    for (const speed of SPEEDS) this.speed.append(element("option", { value: String(speed) }, `${speed}×`));
    this.speed.addEventListener("change", () => clock.setSpeed(Number(this.speed.value)));
    const end = element("span", { class: "soft" }, ` / ${fixed(clock.end_s, 1)} s`);
    this.element = element(
      "div",
      { class: "transport", role: "group", "aria-label": "Replay" },
      button("To the change of mode before", icon(BACK), () => jump(-1), "["),
      this.play,
      button("To the next change of mode", icon(ON), () => jump(1), "]"),
      this.speed,
      element("span", { class: "time" }, this.time, end),
    );
  }

  update(): void {
    const { playing, speed, t_s } = this.clock;
    const label = playing ? "Pause" : "Play";
    if (this.play.getAttribute("aria-label") !== label) {
      this.play.replaceChildren(icon(playing ? PAUSE : PLAY));
      mark(this.play, "aria-label", label);
      mark(this.play, "title", `${label} (space)`);
    }
    if (this.speed.value !== String(speed)) this.speed.value = String(speed);
    say(this.time, fixed(t_s, 2));
  }
}
