// A drawing of its own size: drawn once for each size and theme, with a cursor laid over it.

import { element, style } from "../element";

export type Draw = (pen: CanvasRenderingContext2D, width: number, height: number) => void;

export class Canvas {
  readonly element: HTMLElement;
  private readonly canvas = element("canvas");
  private readonly cursor = element("i", { class: "cursor", "aria-hidden": "true" });
  private width = 0;
  private height = 0;

  /** `inset` is what the drawing leaves free at its left and right [px]. */
  constructor(private readonly draw: Draw, private readonly inset: [number, number], label: string) {
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", label);
    this.element = element("div", { class: "canvas" }, this.canvas, this.cursor);
    new ResizeObserver(([box]) => {
      ({ width: this.width, height: this.height } = box!.contentRect);
      this.redraw();
    }).observe(this.element);
  }

  redraw(): void {
    // As it was told: whoever asks the element has the whole page laid out.
    const { width, height } = this;
    if (width === 0 || height === 0) return;
    const dense = Math.min(window.devicePixelRatio || 1, 3);
    const [across, down] = [Math.round(width * dense), Math.round(height * dense)];
    // A size that is set, though it is the same, costs as much as what is drawn.
    const isResized = this.canvas.width !== across || this.canvas.height !== down;
    if (isResized) [this.canvas.width, this.canvas.height] = [across, down];
    const pen = this.canvas.getContext("2d");
    if (!pen) return;
    // A font has the styles of the page computed; a drawing keeps it until its size is set.
    if (isResized) pen.font = `11px ${style("--font")}`;
    pen.setTransform(dense, 0, 0, dense, 0, 0);
    this.draw(pen, width, height);
    this.place();
  }

  private share = 0;

  /** Puts the cursor at a share of the drawing. */
  setCursor(share: number): void {
    this.share = share;
    this.place();
  }

  private place(): void {
    const [left, right] = this.inset;
    const x = left + this.share * (this.width - left - right);
    this.cursor.style.transform = `translateX(${x.toFixed(1)}px)`;
  }

  /** Tells which share of the drawing somebody presses, or drags to. */
  onDrag(act: (share: number) => void): void {
    const tell = (event: PointerEvent) => {
      const box = this.element.getBoundingClientRect();
      const [left, right] = this.inset;
      act(Math.min(1, Math.max(0, (event.clientX - box.left - left) / (box.width - left - right))));
    };
    this.element.addEventListener("pointerdown", (event) => {
      this.element.setPointerCapture(event.pointerId);
      tell(event);
    });
    this.element.addEventListener("pointermove", (event) => {
      if (this.element.hasPointerCapture(event.pointerId)) tell(event);
    });
  }
}
