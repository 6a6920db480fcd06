// The connection to a run that is going on: kept up, and begun again when it was cut off.

import { sentence } from "../words";
import type { Answer, FromServer, Request, Text } from "./messages";

/** `lost`: cut off, and tried again; `gone`: nobody has answered for a while, and it is tried now and then. */
export type Link = "connecting" | "open" | "lost" | "gone";

/** Waits before the first and further tries [ms]; the last one counts for all that follow. */
const WAITS = [250, 500, 1000, 2000, 4000];
/** After so many tries in vain nobody seems to be there. */
const GONE_AFTER = 3;

interface Waiting {
  done: (answer: Answer | Text) => void;
  failed: (error: Error) => void;
}

export class Connection {
  link: Link = "connecting";
  /** How many messages came, and how long all of them took [ms]. */
  readonly heard = { messages: 0, ms: 0 };
  private socket: WebSocket | null = null;
  private tries = 0;
  private next = 1;
  private again: ReturnType<typeof setTimeout> | undefined;
  private readonly waiting = new Map<number, Waiting>();

  /** `hear` is told every message but answers, `changed` whenever the link is another. */
  constructor(
    private readonly url: string,
    private readonly hear: (message: FromServer) => void,
    private readonly changed: () => void,
  ) {}

  /** Begins, or tries again at once. */
  open(): void {
    if (this.socket) return;
    clearTimeout(this.again);
    const socket = new WebSocket(this.url);
    this.socket = socket;
    socket.addEventListener("message", ({ data }) => this.read(String(data)));
    socket.addEventListener("open", () => this.become("open"));
    // An error is always followed by a close.
    socket.addEventListener("close", () => this.lose());
  }

  /** Asks for something. Fails with a sentence for people if it is refused or nobody answers. */
  ask(request: Request): Promise<Answer | Text> {
    const { socket } = this;
    if (!socket || this.link !== "open") return Promise.reject(new Error(CUT_OFF));
    const id = this.next++;
    socket.send(JSON.stringify({ ...request, id }));
    return new Promise((done, failed) => this.waiting.set(id, { done, failed }));
  }

  private read(text: string): void {
    const before = performance.now();
    this.take(JSON.parse(text) as FromServer);
    this.heard.messages++;
    this.heard.ms += performance.now() - before;
  }

  private take(message: FromServer): void {
    if (message.kind !== "answer" && message.kind !== "text") {
      // Whoever speaks is there; one who takes the connection and drops it is not.
      this.tries = 0;
      this.hear(message);
      return;
    }
    const waiting = this.waiting.get(message.id);
    this.waiting.delete(message.id);
    if (message.kind === "answer" && message.error !== undefined) waiting?.failed(new Error(sentence(message.error)));
    else waiting?.done(message);
  }

  private lose(): void {
    this.socket = null;
    for (const { failed } of this.waiting.values()) failed(new Error(CUT_OFF));
    this.waiting.clear();
    const wait = WAITS[Math.min(this.tries, WAITS.length - 1)]!;
    this.tries++;
    this.again = setTimeout(() => this.open(), wait);
    this.become(this.tries > GONE_AFTER ? "gone" : "lost");
  }

  private become(link: Link): void {
    if (link === this.link) return;
    this.link = link;
    this.changed();
  }
}

const CUT_OFF = "The connection to the run is cut off.";
