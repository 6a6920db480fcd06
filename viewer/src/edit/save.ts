// The scenario as it is now, as a file that the browser puts where downloads go.

import { button, element, say } from "../element";
import type { Session } from "../live/session";

/** How long a name stays good for the download [ms]. */
const GOOD = 10_000;

export class Save {
  readonly element: HTMLElement;
  readonly dialog = element("dialog", { "aria-label": "The scenario is saved" });
  private readonly words = element("p");
  private readonly command = element("code", { class: "command" });

  constructor(private readonly session: Session) {
    this.element = button("Save as scenario", element("span", {}, "Save as scenario"), () => void this.save());
    this.element.classList.add("save");
    this.dialog.append(this.words, element("p", { class: "line" }, this.command), button("Close", "Close", () => this.dialog.close()));
  }

  private async save(): Promise<void> {
    try {
      const { name, toml } = await this.session.save();
      const file = `${name.replace(/\.toml$/, "").replaceAll(/[^\w.-]+/g, "-") || "scenario"}.toml`;
      const url = URL.createObjectURL(new Blob([toml], { type: "application/toml" }));
      element("a", { href: url, download: file }).click();
      setTimeout(() => URL.revokeObjectURL(url), GOOD);
      say(this.words, `The scenario as it is now went to ${file} in your downloads. Run it again from there with:`);
      say(this.command, `conik run ${file}`);
      this.command.hidden = false;
    } catch (error) {
      say(this.words, error instanceof Error ? error.message : String(error));
      this.command.hidden = true;
    }
    this.dialog.showModal();
  }
}
