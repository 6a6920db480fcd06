// What a pointer does in the scene: it turns the scene where there is nothing, and drags what is there.

import { Vector2 } from "three";
import type { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { element, say } from "../element";
import type { Handle } from "../edit/handles";
import type { Bench, Mover } from "./mover";

/** A press that goes no farther than this is a press and no drag [px]. */
const STILL = 4;
/** How long a word stays where no pointer hovers [ms]. */
const STAYS = 3500;

export class Pointer {
  readonly tip = element("div", { class: "tip", role: "tooltip" });
  private pressed: { x: number; y: number; isHeld: boolean } | null = null;
  private gone: ReturnType<typeof setTimeout> | undefined;

  /** `changed` is called whenever the scene is to be drawn anew. */
  constructor(
    private readonly stage: HTMLElement,
    private readonly canvas: HTMLCanvasElement,
    private readonly mover: Mover,
    private readonly bench: Bench,
    private readonly controls: OrbitControls,
    private readonly changed: () => void,
  ) {
    this.tip.hidden = true;
    // Before the camera's controls, which listen on the canvas.
    stage.addEventListener("pointerdown", (event) => this.down(event), { capture: true });
    stage.addEventListener("pointermove", (event) => this.moved(event));
    for (const kind of ["pointerup", "pointercancel"]) stage.addEventListener(kind, (event) => this.up(event as PointerEvent));
  }

  /** Says what the handle under a pointer is, or why it stays where it is; `null`: there is none. */
  hover(handle: Handle | null, at: Vector2): void {
    if (this.mover.isDragging) return;
    const refusal = handle && this.bench.refusal();
    this.canvas.style.cursor = !handle ? "" : refusal ? "not-allowed" : "move";
    if (!handle) this.tip.hidden = true;
    else this.tell(refusal ?? `${handle.label}: drag to ${verb(handle)} it`, at);
  }

  /** Says something about what is in hand, or was. */
  complain(text: string): void {
    this.tell(text, null);
    this.fade();
  }

  /** Lets go of what is in hand, and back to where it was; whether anything was. */
  cancel(): boolean {
    const was = this.mover.cancel();
    if (was) this.letGo();
    return was;
  }

  private down(event: PointerEvent): void {
    if (event.target !== this.canvas || event.button !== 0 || !event.isPrimary) return;
    this.canvas.focus({ preventScroll: true });
    const at = this.place(event);
    this.pressed = { x: event.clientX, y: event.clientY, isHeld: this.mover.begin(at) };
    if (!this.pressed.isHeld) {
      const found = this.mover.at(at);
      const refusal = found && this.bench.refusal();
      // A finger does not hover.
      if (refusal && event.pointerType === "touch") {
        this.tell(refusal, at);
        this.fade();
      }
      return;
    }
    event.stopPropagation();
    this.controls.enabled = false;
    this.canvas.setPointerCapture(event.pointerId);
    this.canvas.style.cursor = "grabbing";
    this.tip.hidden = true;
    this.changed();
  }

  private moved(event: PointerEvent): void {
    if (!this.pressed?.isHeld || !this.mover.isDragging || this.isStill(event)) return;
    this.mover.move(this.place(event));
    this.changed();
  }

  private up(event: PointerEvent): void {
    const { pressed } = this;
    if (!pressed) return;
    if (event.type === "pointercancel") this.mover.cancel();
    // Who presses beside everything lets go of what was selected.
    else if (!pressed.isHeld && this.isStill(event)) this.bench.select(null);
    this.mover.end();
    this.letGo();
  }

  private letGo(): void {
    this.pressed = null;
    this.controls.enabled = true;
    this.canvas.style.cursor = "";
    this.changed();
  }

  private isStill({ clientX, clientY }: PointerEvent): boolean {
    const { pressed } = this;
    if (!pressed) return true;
    const isStill = Math.hypot(clientX - pressed.x, clientY - pressed.y) < STILL;
    // Who has moved once drags, also back to the beginning.
    if (!isStill) [pressed.x, pressed.y] = [Number.NaN, Number.NaN];
    return isStill;
  }

  private place(event: PointerEvent): Vector2 {
    const box = this.canvas.getBoundingClientRect();
    return new Vector2((2 * (event.clientX - box.left)) / box.width - 1, 1 - (2 * (event.clientY - box.top)) / box.height);
  }

  private tell(text: string, at: Vector2 | null): void {
    clearTimeout(this.gone);
    say(this.tip, text);
    this.tip.hidden = false;
    const { clientWidth, clientHeight } = this.stage;
    const [x, y] = at ? [((at.x + 1) / 2) * clientWidth, ((1 - at.y) / 2) * clientHeight] : [clientWidth / 2, 16];
    this.tip.style.left = `${Math.min(Math.max(x, 110), Math.max(110, clientWidth - 110))}px`;
    this.tip.style.top = `${Math.min(y + 18, clientHeight - 44)}px`;
  }

  private fade(): void {
    clearTimeout(this.gone);
    this.gone = setTimeout(() => (this.tip.hidden = true), STAYS);
  }
}

function verb({ kind }: Handle): string {
  return kind === "direction" ? "turn" : kind === "plane" ? "shift" : "move";
}
