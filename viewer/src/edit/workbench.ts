// What somebody works on: the thing that is selected, and the way of changes to the run.

import type { Clock } from "../clock";
import type { Change } from "../live/messages";
import type { Session } from "../live/session";
import type { Task, Vector } from "../protocol";
import type { Run } from "../run";
import type { Bench } from "../scene/mover";
import { type Handle, handles, type Subject } from "./handles";

export class Workbench implements Bench {
  private subject: Subject | null = null;
  private handle: string | null = null;
  private readonly listeners: (() => void)[] = [];
  /** Told why something that was done in the scene was refused. */
  onComplaint: ((text: string) => void) | null = null;

  constructor(readonly session: Session, readonly run: Run, private readonly clock: Clock) {}

  /** Called whenever something else is selected. */
  subscribe(listener: () => void): void {
    this.listeners.push(listener);
  }

  /** Why nothing can be changed now, in a sentence; `null`: it can. */
  refusal(): string | null {
    const refusal = this.session.refusal("change");
    if (refusal) return refusal;
    return this.clock.following ? null : "This is the past. Go back to now (End) to change something.";
  }

  /** Changes something; `done` is told the sentence why not, or `null`. */
  put(key: string, changes: Change[], done: (error: string | null) => void): void {
    this.session.changer.put(key, changes, done);
  }

  move(handle: Handle, to: Vector, done: () => void): void {
    this.put(handle.id, handle.move(to), (error) => {
      if (error !== null) this.onComplaint?.(error);
      done();
    });
  }

  select(handle: Handle | null): void {
    this.choose(handle?.subject ?? null, handle?.id ?? null);
  }

  /** Selects a task or an obstacle, and the first thing of it that can be moved. */
  open(subject: Subject | null): void {
    const found = handles(this.run.scene).find((handle) => isSame(handle.subject, subject));
    this.choose(subject, found?.id ?? null);
  }

  selected(): string | null {
    return this.handle;
  }

  isOpen(subject: Subject): boolean {
    return isSame(subject, this.subject);
  }

  /** Name of what is selected. */
  get name(): string | null {
    return this.subject?.name ?? null;
  }

  /** Whether a task is other than at the start, where the page knows how it was. */
  isChanged({ kind, name }: Subject): boolean {
    const { original } = this.session;
    if (!original) return false;
    const list = kind === "task" ? "tasks" : "obstacles";
    const [was, is] = [original, this.run.scene].map((scene) => (scene[list] as Task[]).find((thing) => thing.name === name));
    return was !== is && JSON.stringify(was) !== JSON.stringify(is);
  }

  /** The time that is shown [s]. */
  get t_s(): number {
    return this.clock.t_s;
  }

  private choose(subject: Subject | null, handle: string | null): void {
    if (isSame(subject, this.subject) && handle === this.handle) return;
    this.subject = subject;
    this.handle = handle;
    for (const listener of this.listeners) listener();
  }
}

function isSame(a: Subject | null, b: Subject | null): boolean {
  return a?.kind === b?.kind && a?.name === b?.name;
}
