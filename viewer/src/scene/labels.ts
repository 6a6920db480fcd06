// Words in the scene, each at a point of it.

import type { Camera, Vector3 } from "three";
import { element, mark, say } from "../element";

export interface Label {
  text: string;
  /** Where it is in the world; used up. */
  at: Vector3;
  kind: string;
}

export class Labels {
  readonly element = element("div", { class: "labels", "aria-hidden": "true" });
  private readonly spans: HTMLElement[] = [];

  /** Shows these and no others, in a picture so wide and high [px]. */
  place(camera: Camera, { width, height }: { width: number; height: number }, labels: Label[]): void {
    while (this.spans.length < labels.length) {
      const span = element("span");
      this.spans.push(span);
      this.element.append(span);
    }
    this.spans.forEach((span, nth) => {
      const label = labels[nth];
      span.hidden = !label;
      if (!label) return;
      say(span, label.text);
      mark(span, "class", label.kind);
      const { x, y, z } = label.at.project(camera);
      span.hidden = z > 1;
      span.style.transform = `translate(${((x + 1) / 2) * width}px, ${((1 - y) / 2) * height}px)`;
    });
  }
}
