// A server that says of a run that is going on what tests want to hear: the rows of a recorded run in wall
// time, changes that are taken or refused, and what a real server seldom does: faults, and cutting off.

import { createServer, type Server } from "node:http";
import { readFile } from "node:fs/promises";
import type { AddressInfo } from "node:net";
import { join } from "node:path";
import { type WebSocket, WebSocketServer } from "ws";
import type { Change, Doing, State } from "../../src/live/messages";
import type { Glide, Obstacle, Outcome, Recording, Scene, Task, Ticks } from "../../src/protocol";
import { REPOSITORY } from "./conik";

/** Messages of ticks a second, and for how long what was moved glides [s]. */
const RATE = 30;
const GLIDES_S = 0.6;

interface Options {
  allowed?: Doing[];
  refusal?: string | null;
  editable?: boolean;
}

type Asked = { kind: string; id: number; changes?: Change[]; ticks?: number; factor?: number };

export class Mock {
  url = "";
  /** What pages requested, and everything that they asked. */
  readonly requests: string[] = [];
  readonly asked: Asked[] = [];
  state: State;
  scene: Scene;
  private readonly http: Server;
  private readonly sockets: WebSocketServer;
  private readonly original: Scene;
  private readonly rows: Ticks;
  private sent = 0;
  private beat: ReturnType<typeof setInterval> | undefined;
  private gliding: { glide: Glide; until_ms: number }[] = [];
  private page = "";
  /** Whether whoever comes is turned away. */
  private isShut = false;

  private constructor(recording: Recording, { allowed, refusal = null, editable = true }: Options) {
    const run = recording.runs[0]!;
    this.rows = run.ticks;
    this.scene = { ...run.scene, live: true, editable, result: null, revision: 0, from_s: 0 };
    this.original = this.scene;
    this.state = {
      kind: "state", running: "running", t_s: 0, speed: 1, refusal,
      allowed: allowed ?? ["pause", "step", "restart", "speed", "change"],
      step_time_us: { median: 0.8, p99: 2, max: 9 }, deadline_misses: 0, outcome: null, viewers: 1, revision: 0, edited: false,
    };
    this.http = createServer((request, response) => {
      this.requests.push(request.url ?? "");
      const path = (request.url ?? "").split("?")[0];
      const body = path === "/recording.json" ? JSON.stringify(this.recording()) : this.page;
      response.writeHead(200, { "content-type": path === "/recording.json" ? "application/json" : "text/html" }).end(body);
    });
    this.sockets = new WebSocketServer({ server: this.http, path: "/live" });
    this.sockets.on("connection", (socket, request) => {
      this.requests.push(request.url ?? ""); 
      if (this.isShut) socket.close();
      else this.greet(socket);
    });
  }

  static async of(recording: Recording, options: Options = {}): Promise<Mock> {
    const mock = new Mock(recording, options);
    mock.page = await readFile(join(REPOSITORY, "viewer/dist/index.html"), "utf8");
    await new Promise<void>((done) => mock.http.listen(0, "127.0.0.1", done));
    mock.url = `http://127.0.0.1:${(mock.http.address() as AddressInfo).port}/`;
    mock.beat = setInterval(() => mock.tick(), 1000 / RATE);
    return mock;
  }

  async stop(): Promise<void> {
    clearInterval(this.beat);
    this.cutOff();
    this.http.closeAllConnections();
    await new Promise((done) => this.http.close(done));
  }

  cutOff(): void {
    for (const socket of this.sockets.clients) socket.close(1013);
  }

  /** Cuts everybody off and lets nobody in, or lets them in again. */
  shut(isShut: boolean): void {
    this.isShut = isShut;
    if (isShut) this.cutOff();
  }

  end(outcome: Outcome): void {
    this.change({ running: "ended", outcome, allowed: ["restart"] });
  }

  change(state: Partial<State>): void {
    Object.assign(this.state, state);
    this.tell(this.state);
  }

  /** All that was changed, the last change last. */
  get changes(): Change[] {
    return this.asked.flatMap(({ changes }) => changes ?? []);
  }

  private recording(): Recording {
    const runs = [{ name: "mock", scene: this.scene, ticks: this.part(0, this.sent) }];
    return { kind: "recording", protocol: 1, runs };
  }

  private part(from: number, to: number): Ticks {
    const cut = <T>(list: T[]) => list.slice(from, to);
    const { rows } = this;
    const columns = Object.fromEntries(Object.entries(rows.columns).map(([name, list]) => [name, cut(list)]));
    return { ...rows, t_s: cut(rows.t_s), mode: cut(rows.mode), active: cut(rows.active), why: cut(rows.why), columns };
  }

  private greet(socket: WebSocket): void {
    const say = (message: object) => socket.send(JSON.stringify(message));
    socket.on("message", (data) => say(this.answer(JSON.parse(String(data)) as Asked)));
    say({ kind: "hello", protocol: 1, program: "mock 0" });
    say(this.scene);
    say({ ...this.part(0, this.sent), reset: true, gliding: [] });
    say(this.state);
  }

  private tick(): void {
    if (this.state.running !== "running") return;
    this.state.t_s += this.state.speed / RATE;
    const to = this.rows.t_s.findLastIndex((t_s) => t_s <= this.state.t_s) + 1;
    if (to > this.sent) this.advance(to);
  }

  private advance(to: number): void {
    this.gliding = this.gliding.filter(({ until_ms }) => until_ms > Date.now());
    const gliding = this.gliding.map(({ glide, until_ms }) => {
      const left = (until_ms - Date.now()) / (1e3 * GLIDES_S);
      const [x, y, z] = glide.away_m ?? [0, 0, 0];
      return { ...glide, away_m: [x * left, y * left, z * left] as const };
    });
    this.tell({ ...this.part(this.sent, to), gliding });
    this.sent = to;
  }

  private answer(asked: Asked): object {
    this.asked.push(asked);
    const { id } = asked;
    switch (asked.kind) {
      case "pause":
        this.change({ running: "paused" });
        break;
      case "resume":
        this.change({ running: "running" });
        break;
      case "step":
        this.advance(Math.min(this.sent + (asked.ticks ?? 1), this.rows.t_s.length));
        break;
      case "speed":
        if (asked.factor! > 4) return { kind: "answer", id, error: "At most 4." };
        this.change({ speed: asked.factor! });
        break;
      case "restart":
        this.sent = 0;
        this.change({ running: "running", t_s: 0 });
        this.tell({ ...this.part(0, 0), reset: true });
        break;
      case "reset":
        this.put(this.original, false);
        break;
      case "save":
        return { kind: "text", id, name: "mock", toml: "title = \"mock\"\n" };
      case "change": {
        const error = this.apply(asked.changes ?? []);
        if (error) return { kind: "answer", id, error };
      }
    }
    return { kind: "answer", id, revision: this.state.revision };
  }

  private apply(changes: Change[]): string | null {
    let scene = this.scene;
    for (const change of changes) {
      if ("order" in change) {
        const tasks = change.order.map((name) => scene.tasks.find((task) => task.name === name)!);
        scene = { ...scene, tasks };
      } else if ("control" in change) {
        scene = { ...scene, settings: { ...scene.settings, [change.control]: change.value } };
      } else {
        const [list, name] = "task" in change ? ["tasks", change.task] as const : ["obstacles", change.obstacle] as const;
        if (change.key === "min" && Number(change.value) > 1) return `${name}: ${String(change.value)} is beyond 1`;
        this.glide(scene[list].find((thing) => thing.name === name) as unknown as Record<string, unknown>, name, change);
        const changed = (scene[list] as (Task | Obstacle)[]).map((thing) =>
          thing.name === name ? { ...thing, [change.key]: change.value } : thing);
        scene = { ...scene, [list]: changed };
      }
    }
    this.put(scene, true);
    return null;
  }

  private glide(thing: Record<string, unknown>, name: string, change: Change): void {
    if (!("key" in change) || !["point_m", "center_m"].includes(change.key)) return;
    const [was, is] = [thing[change.key], change.value] as number[][];
    const away_m = was!.map((value, nth) => value - is![nth]!) as unknown as readonly [number, number, number];
    this.gliding = [{ glide: { name, away_m }, until_ms: Date.now() + 1e3 * GLIDES_S }];
  }

  private put(scene: Scene, edited: boolean): void {
    const revision = this.state.revision + 1;
    this.scene = { ...scene, revision, from_s: this.rows.t_s[this.sent] ?? 0 };
    this.tell({ ...this.scene, robot: null });
    this.change({ revision, edited });
  }

  private tell(message: object): void {
    const text = JSON.stringify(message);
    for (const socket of this.sockets.clients) socket.send(text);
  }
}
