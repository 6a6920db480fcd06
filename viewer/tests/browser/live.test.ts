// A run that is going on, followed and steered: what the page does with what a server says, here one that
// plays a recorded run again.

import type { Browser, Page } from "playwright-core";
import { afterAll, afterEach, beforeAll, describe, expect, test } from "vitest";
import type { Recording } from "../../src/protocol";
import { open, shownTime, visit, type Visit } from "./browser";
import { Folder, ran, Served } from "./conik";
import { Mock } from "./mock";

let folder: Folder, browser: Browser, recording: Recording, mock: Mock | undefined;
/** For what has nothing to do with the scene, which software draws slowly. */
let flat: Browser;

beforeAll(async () => {
  [folder, browser, flat] = await Promise.all([Folder.make(), open(), open(false)]);
  const served = await Served.of(await ran(folder, "paper/example2", "--duration-s", "20"));
  recording = await (await fetch(`${served.url}recording.json`)).json();
  served.stop();
});

afterEach(async () => {
  for (const context of [browser, flat].flatMap((each) => each.contexts())) await context.close();
  await mock?.stop();
  mock = undefined;
});

afterAll(async () => {
  await browser?.close();
  await flat?.close();
  await folder?.remove();
});

/** A page of a run that is going on, without the explanation over it. */
async function follow(options: Parameters<typeof Mock.of>[1] = {}, query = "", through = flat): Promise<Visit & { mock: Mock }> {
  mock = await Mock.of(recording, options);
  const found = await visit(through, `${mock.url}${query}`, { viewport: { width: 900, height: 620 } });
  await found.page.locator(".state-chip[data-kind=running]").waitFor();
  await found.page.locator(".about").getByRole("button", { name: "Close" }).click();
  return { ...found, mock };
}

const press = (page: Page, name: string) => page.getByRole("button", { name, exact: true }).click();

describe("the page of a run that is going on", () => {
  test("goes with it, without a complaint", async () => {
    const { page, complaints } = await follow({}, "", browser);
    const first = await shownTime(page);
    await expect.poll(() => shownTime(page)).toBeGreaterThan(first + 1);
    expect(await page.locator(".live").getAttribute("aria-pressed")).toBe("true");
    expect(await page.locator(".when").textContent()).toContain("now");
    expect(page.url(), "now has no address").not.toContain("#");
    expect(complaints.filter((text) => !/GPU stall|GL Driver/.test(text))).toEqual([]);
  });

  test("carries what lets it in to every request", async () => {
    const { mock } = await follow({}, "?token=abc");
    expect(mock.requests.filter((url) => /live|recording/.test(url))).toEqual(["/recording.json?token=abc", "/live?token=abc"]);
  });

  test("shows the past while the run goes on, and comes back to now", async () => {
    const { page } = await follow();
    await expect.poll(() => shownTime(page)).toBeGreaterThan(2.5);
    await page.keyboard.press("Home");
    await expect.poll(() => shownTime(page)).toBe(0);
    await expect.poll(() => page.locator(".when").textContent()).toMatch(/s ago, the run goes on/);
    const ago = async () => Number.parseFloat((await page.locator(".when").textContent())!.replace(/^ s: /, ""));
    const before = await ago();
    await expect.poll(ago, { message: "now goes away" }).toBeGreaterThan(before + 0.5);
    expect(await shownTime(page)).toBe(0);
    await page.keyboard.press("End");
    await expect.poll(() => page.locator(".when").textContent()).toContain("now");
    await page.keyboard.press("Home");
    await press(page, "Go to now");
    await expect.poll(() => shownTime(page)).toBeGreaterThan(2.5);
  });

  test("replays the past until it has caught up", async () => {
    const { page, mock } = await follow();
    await expect.poll(() => shownTime(page)).toBeGreaterThan(3);
    mock.change({ running: "paused" });
    await page.keyboard.press("Home");
    await page.locator("select[aria-label='Speed of replay']").selectOption("8");
    await press(page, "Replay from here");
    await expect.poll(() => page.locator(".live").getAttribute("aria-pressed")).toBe("true");
    expect(await shownTime(page)).toBeGreaterThan(3);
  });

  test("says which changes of mode there are, once in a second", async () => {
    const { page } = await follow();
    const said: [string, number][] = [];
    await page.exposeFunction("heard", (text: string) => said.push([text, Date.now()]));
    await page.evaluate(() => {
      const status = document.querySelector("p.unseen[role=status]")!;
      const heard = (window as unknown as { heard: (text: string) => void }).heard;
      new MutationObserver(() => heard(status.textContent ?? "")).observe(status, { childList: true, characterData: true, subtree: true });
    });
    await page.locator("select[aria-label='Speed of the run']").selectOption("2");
    await expect.poll(() => said.map(([text]) => text), { timeout: 40_000 }).toContain("view");
    expect(said.map(([text]) => text)).toContain("no set active");
    for (const [nth, [, ms]] of said.slice(1).entries()) expect(ms - said[nth]![1]).toBeGreaterThan(900);
  });
});

describe("space", () => {
  test("stops and starts the run where that is allowed, and the page says that it did", async () => {
    const { page, mock } = await follow();
    await page.keyboard.press(" ");
    await page.locator(".state-chip[data-kind=paused]").waitFor();
    expect(await page.locator(".when").textContent()).toContain("run paused");
    const at = await shownTime(page);
    expect(await page.getByRole("button", { name: "Resume the run" }).isVisible()).toBe(true);
    for (let tick = 0; tick < 5; tick++) await page.keyboard.press(".");
    await expect.poll(() => shownTime(page)).toBeGreaterThan(at + 0.025);
    expect(await shownTime(page)).toBeLessThan(at + 0.055);
    await page.keyboard.press(" ");
    await expect.poll(() => shownTime(page)).toBeGreaterThan(at + 0.5);
    expect(mock.asked.map(({ kind }) => kind)).toEqual(["pause", "step", "step", "step", "step", "step", "resume"]);
  });

  test("holds the view where the run must go on, and the page says that it does", async () => {
    const refusal = "this may be a real arm";
    const { page, mock } = await follow({ allowed: [], refusal, editable: false });
    const main = page.getByRole("button", { name: "Hold the view" });
    expect(await main.getAttribute("title")).toContain("The run goes on: This may be a real arm.");
    await page.keyboard.press(" ");
    await expect.poll(() => page.locator(".when").textContent()).toContain("the run goes on");
    const at = await shownTime(page);
    await page.waitForTimeout(700);
    expect(await shownTime(page)).toBe(at);
    expect(mock.state.running).toBe("running");
    for (const name of ["One tick", "Restart the run"]) {
      const control = page.getByRole("button", { name });
      expect(await control.isDisabled(), name).toBe(true);
      expect(await control.getAttribute("title")).toContain("This may be a real arm.");
    }
    expect(mock.asked).toEqual([]);
  });
});

describe("the run's own speed", () => {
  test("is asked for, and one that is refused is not shown", async () => {
    const { page, mock } = await follow();
    const speed = page.locator("select[aria-label='Speed of the run']");
    await speed.selectOption("2");
    await expect.poll(() => page.locator(".chip.arm").textContent()).toContain("2× speed");
    await speed.selectOption("10");
    await expect.poll(() => page.locator(".transport [role=alert]").textContent()).toBe("At most 4.");
    await expect.poll(() => speed.inputValue()).toBe("2");
    expect(mock.asked.map(({ factor }) => factor)).toEqual([2, 10]);
  });

  test("has nothing to do with a restart, after which only new rows are there", async () => {
    const { page } = await follow();
    await expect.poll(() => shownTime(page)).toBeGreaterThan(3);
    await press(page, "Restart the run");
    await expect.poll(() => shownTime(page)).toBeLessThan(1.5);
    await page.keyboard.press("Home");
    await expect.poll(() => page.locator(".when").textContent()).not.toContain("now");
    const ago = Number.parseFloat((await page.locator(".when").textContent())!.replace(/^ s: /, ""));
    expect(ago).toBeLessThan(3);
  });
});

describe("what goes wrong", () => {
  test("a fault stands across the page in words, as text", async () => {
    const { page, mock } = await follow();
    // A replay that is over before anybody looks is none.
    await expect.poll(() => shownTime(page)).toBeGreaterThan(3);
    mock.scene = { ...mock.scene, arm: "10.0.0.7" };
    mock.end({ kind: "fault", name: "protective-stop", detail: "the arm touched <b>something</b>" });
    const banner = page.locator(".banner[data-kind=fault]");
    await banner.waitFor();
    expect(await banner.textContent()).toContain("Fault: protective-stop. The arm touched <b>something</b>. The run is over");
    expect(await banner.getAttribute("role")).toBe("alert");
    expect(await page.locator(".state-chip").textContent()).toContain("fault");
    const at = await shownTime(page);
    const end = Number(/[\d.]+/.exec((await page.locator(".when").textContent()) ?? ""));
    expect(Math.abs(at - end), "its end is shown").toBeLessThan(0.06);
    await page.keyboard.press(" ");
    await expect.poll(() => shownTime(page), { message: "what was is replayed" }).toBeLessThan(at - 0.2);
  });

  test("a page that is cut off says so and connects again", async () => {
    const { page, mock } = await follow();
    mock.shut(true);
    await page.locator(".banner[data-kind=lost]").waitFor();
    expect(await page.locator(".banner").textContent()).toContain("cut off");
    mock.shut(false);
    await page.locator(".banner").waitFor({ state: "hidden" });
    const at = await shownTime(page);
    await expect.poll(() => shownTime(page)).toBeGreaterThan(at + 0.5);
  });

  test("a page whose server is gone stays, and replays what it has", async () => {
    const { page, mock } = await follow();
    await expect.poll(() => shownTime(page)).toBeGreaterThan(2);
    mock.shut(true);
    await expect.poll(() => page.locator(".banner").textContent()).toContain("does not answer any more");
    await page.keyboard.press("Home");
    await expect.poll(() => shownTime(page)).toBe(0);
    await page.keyboard.press(" ");
    await expect.poll(() => shownTime(page)).toBeGreaterThan(0.5);
    await page.getByRole("button", { name: "Change view", exact: true }).click();
    expect(await page.locator(".editor input").first().isDisabled()).toBe(true);
    const again = page.getByRole("button", { name: "Try again now", exact: true, includeHidden: true });
    expect(await again.isVisible()).toBe(true);
    mock.shut(false);
    // The page tries by itself too, and may take the button away under the mouse.
    await again.evaluate((button: HTMLButtonElement) => button.click());
    await page.locator(".banner").waitFor({ state: "hidden" });
  });
});
