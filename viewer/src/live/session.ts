// A run that is going on: what is heard of it goes into the run that the page shows, and what is asked of
// it is asked here.

import type { Scene, Ticks } from "../protocol";
import type { Run } from "../run";
import { sentence } from "../words";
import { Changer } from "./changer";
import { Connection, type Link } from "./connection";
import type { Change, Doing, FromServer, LiveScene, Request, State, Text } from "./messages";

export type News = "ticks" | "scene" | "state" | "link";

export class Session {
  state: State | null = null;
  /** The scene as it was when nobody had changed anything, where the page has seen it. */
  original: Scene | null = null;
  readonly changer: Changer;
  private readonly connection: Connection;
  private readonly listeners: ((news: News) => void)[] = [];

  /** `restart` is called if another run is there after the connection was lost. */
  constructor(url: string, private readonly run: Run, private readonly restart: () => void) {
    this.connection = new Connection(url, (message) => this.hear(message), () => this.tell("link"));
    this.changer = new Changer((changes) => this.ask({ kind: "change", changes }));
  }

  open(): void {
    this.connection.open();
  }

  subscribe(listener: (news: News) => void): void {
    this.listeners.push(listener);
  }

  get link(): Link {
    return this.connection.link;
  }

  /** Whether the run is over, or nobody knows of it any more. */
  get isOver(): boolean {
    return this.link === "gone" || this.state?.running === "ended";
  }

  /** Why something may not be done, in a sentence; `null`: it may. */
  refusal(doing: Doing): string | null {
    if (this.link !== "open" || !this.state) return "There is no connection to the run.";
    const { allowed, refusal, running } = this.state;
    const isEditable = doing !== "change" || this.run.scene.editable;
    if (allowed.includes(doing) && isEditable) return null;
    if (refusal) return sentence(refusal);
    return running === "ended" ? "The run has ended." : "This cannot be done with this arm.";
  }

  /** Resolves when it was done, and fails with a sentence. */
  async ask(request: Request): Promise<void> {
    await this.connection.ask(request);
  }

  /** The scenario as it is now, as a file. */
  async save(): Promise<Text> {
    const answer = await this.connection.ask({ kind: "save" });
    if (answer.kind !== "text") throw new Error("The answer has no scenario in it.");
    return answer;
  }

  /** Changes something now; fails with a sentence. */
  change(...changes: Change[]): Promise<void> {
    return this.ask({ kind: "change", changes });
  }

  /** How many messages came, and how long all of them took [ms]. */
  get heard(): { messages: number; ms: number } {
    return this.connection.heard;
  }

  private hear(message: FromServer): void {
    switch (message.kind) {
      case "scene":
        this.take(message);
        this.tell("scene");
        break;
      case "ticks":
        this.run.take(message as Ticks);
        this.tell("ticks");
        break;
      case "state":
        this.state = message;
        this.remember();
        this.tell("state");
        break;
      default:
    }
  }

  private take(scene: LiveScene): void {
    const { robot } = this.run.scene;
    // After the program was started anew another robot may answer.
    if (scene.robot && JSON.stringify(scene.robot) !== JSON.stringify(robot)) this.restart();
    this.run.change({ ...scene, robot }, scene.from_s ?? 0);
    this.remember();
  }

  /** What nobody has changed is what changes are told from. */
  private remember(): void {
    const { scene } = this.run;
    const isUntouched = this.state?.edited === false && this.state.revision === (scene.revision ?? 0);
    if (isUntouched) this.original = scene;
  }

  private tell(news: News): void {
    for (const listener of this.listeners) listener(news);
  }
}
