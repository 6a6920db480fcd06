// The connection, and changes one at a time, against a socket that is made up.

import { afterEach, beforeEach, describe, expect, test, vi } from "vitest";
import { Changer } from "../../src/live/changer";
import { Connection } from "../../src/live/connection";
import type { Change, FromServer } from "../../src/live/messages";

class Socket extends EventTarget {
  static all: Socket[] = [];
  readonly sent: { kind: string; id: number }[] = [];
  constructor(readonly url: string) {
    super();
    Socket.all.push(this);
  }
  send(text: string): void {
    this.sent.push(JSON.parse(text) as { kind: string; id: number });
  }
  open(): void {
    this.dispatchEvent(new Event("open"));
  }
  say(message: object): void {
    this.dispatchEvent(new MessageEvent("message", { data: JSON.stringify(message) }));
  }
  close(): void {
    this.dispatchEvent(new Event("close"));
  }
}

const last = () => Socket.all[Socket.all.length - 1]!;
let heard: FromServer[], links: string[], connection: Connection;

beforeEach(() => {
  vi.useFakeTimers();
  vi.stubGlobal("WebSocket", Socket);
  Socket.all = [];
  [heard, links] = [[], []];
  connection = new Connection("ws://here/live", (message) => heard.push(message), () => links.push(connection.link));
  connection.open();
});

afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

describe("the connection", () => {
  test("gives each question its own answer", async () => {
    last().open();
    const [one, two] = [connection.ask({ kind: "pause" }), connection.ask({ kind: "restart" })];
    const [first, second] = last().sent;
    last().say({ kind: "answer", id: second!.id, error: "no such thing here" });
    last().say({ kind: "answer", id: first!.id, revision: 7 });
    expect(await one).toMatchObject({ revision: 7 });
    await expect(two).rejects.toThrow("No such thing here.");
    expect(heard, "answers are nobody else's").toEqual([]);
  });

  test("fails what nobody will answer any more", async () => {
    await expect(connection.ask({ kind: "pause" })).rejects.toThrow("cut off");
    last().open();
    const asked = connection.ask({ kind: "pause" });
    last().close();
    await expect(asked).rejects.toThrow("cut off");
  });

  test("is tried again, later and later, and says when nobody is there", () => {
    last().open();
    last().say({ kind: "hello", protocol: 1, program: "x" });
    const waits: number[] = [];
    for (let nth = 0; nth < 6; nth++) {
      const tries = Socket.all.length;
      last().close();
      let waited = 0;
      for (; Socket.all.length === tries; waited += 50) vi.advanceTimersByTime(50);
      waits.push(waited);
    }
    expect(waits).toEqual([250, 500, 1000, 2000, 4000, 4000]);
    expect(links).toEqual(["open", "lost", "gone"]);
    last().open();
    last().say({ kind: "hello", protocol: 1, program: "x" });
    expect(connection.link).toBe("open");
    last().close();
    expect(connection.link, "one that spoke is only lost").toBe("lost");
  });

  test("can be tried at once, and is there once only", () => {
    last().close();
    connection.open();
    connection.open();
    expect(Socket.all).toHaveLength(2);
    vi.advanceTimersByTime(60_000);
    expect(Socket.all).toHaveLength(2);
  });
});

describe("changes", () => {
  const change = (value: number): Change[] => [{ task: "a", key: "min", value }];
  const value = (changes: Change[]) => (changes[0] as { value: number }).value;

  test("go one at a time, and the newest of those that wait", async () => {
    const sent: number[] = [];
    let answer = () => {};
    const changer = new Changer((changes) => {
      sent.push(value(changes));
      return new Promise((done) => (answer = done));
    });
    const done: number[] = [];
    for (const nth of [1, 2, 3, 4]) changer.put("a", change(nth), () => done.push(nth));
    expect(sent).toEqual([1]);
    answer();
    await vi.advanceTimersByTimeAsync(0);
    expect(sent).toEqual([1, 4]);
    answer();
    await vi.advanceTimersByTimeAsync(0);
    expect(done).toEqual([1, 4]);
  });

  test("of different things wait for each other, and a refusal stops none", async () => {
    const errors: (string | null)[] = [];
    const changer = new Changer((changes) => (value(changes) === 2 ? Promise.reject(new Error("Not two.")) : Promise.resolve()));
    for (const nth of [1, 2, 3]) changer.put(`task ${nth}`, change(nth), (error) => errors.push(error));
    await vi.advanceTimersByTimeAsync(0);
    expect(errors).toEqual([null, "Not two.", null]);
  });
});
