// The report of a run, opened from a file as from a mail: the figures first, and the run replayed in it.

import { readFile, writeFile } from "node:fs/promises";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import type { Browser, BrowserContextOptions, FrameLocator, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import { open } from "./browser";
import { Folder, ran } from "./conik";

let folder: Folder, browser: Browser, report: string;

beforeAll(async () => {
  folder = await Folder.make();
  browser = await open();
  report = join(await ran(folder, "paper/example2", "--duration-s", "20"), "report.html");
});

afterAll(async () => {
  await browser?.close();
  await folder?.remove();
});

/** A reader of a report: without a network, and noting what went wrong and what was asked for. */
class Reader {
  readonly complaints: string[] = [];
  readonly requests: string[] = [];

  private constructor(readonly page: Page) {}

  static async of(path: string, hash = "", options: BrowserContextOptions = {}): Promise<Reader> {
    const context = await browser.newContext({ offline: true, viewport: { width: 1280, height: 800 }, ...options });
    const reader = new Reader(await context.newPage());
    const { page, complaints, requests } = reader;
    page.on("console", (message) => {
      if (["error", "warning"].includes(message.type())) complaints.push(message.text());
    });
    page.on("pageerror", (error) => complaints.push(String(error)));
    page.on("request", (request) => requests.push(request.url()));
    await page.goto(pathToFileURL(path).href + hash);
    return reader;
  }

  get replay(): FrameLocator {
    return this.page.frameLocator("#replay");
  }

  view(name: string) {
    return this.page.getByRole("navigation").getByRole("link", { name });
  }

  async time(): Promise<number> {
    return Number(await this.replay.locator(".clock").textContent());
  }

  /** What software drawing says of itself is no complaint of the page. */
  async leave(): Promise<void> {
    expect(this.complaints.filter((text) => !/GPU stall|GL Driver/.test(text))).toEqual([]);
    expect(this.requests.filter((url) => !/^(file:|data:|blob:|about:srcdoc)/.test(url))).toEqual([]);
    await this.page.context().close();
  }
}

describe("a report", () => {
  test("opens with its figures, replays the run, and goes back", async () => {
    const reader = await Reader.of(report);
    const { page, replay } = reader;
    expect(await page.locator("h1").textContent()).toContain("Example 2");
    expect(await page.locator("iframe").count()).toBe(0);
    await page.getByText("Tasks, the most important first").scrollIntoViewIfNeeded();
    // Whoever clicks for us may scroll before the click.
    const left = page.evaluate(
      () => new Promise<number>((tell) => document.addEventListener("click", () => tell(scrollY), { capture: true, once: true })),
    );
    await reader.view("Replay in 3-D").click();
    const read = await left;
    expect(read).toBeGreaterThan(0);
    await replay.locator(".task").first().waitFor();
    expect(await replay.locator(".stage canvas").count()).toBe(1);
    expect(await page.locator("main").isVisible()).toBe(false);
    await replay.getByRole("button", { name: "Play", exact: true }).click();
    await expect.poll(() => reader.time()).toBeGreaterThan(0.3);
    await replay.getByRole("button", { name: "Pause", exact: true }).click();
    await replay.locator(".scrub").fill("850");
    await expect.poll(() => replay.locator('.task[data-state="held"] .name').allTextContents()).toEqual(["obstacle_b", "view"]);
    await expect.poll(() => page.url()).toMatch(/#t=17$/);

    await reader.view("Report").click();
    await expect.poll(() => page.locator("iframe").count()).toBe(0);
    expect(await page.locator("main").isVisible()).toBe(true);
    expect(await page.evaluate(() => scrollY)).toBe(read);
    await reader.view("Replay in 3-D").click();
    await expect.poll(() => reader.time(), { message: "where it was left" }).toBe(17);
    // The page in the frame may write its moment after the address is that of the report, and before that is told.
    await page.evaluate(() => addEventListener("popstate", () => history.replaceState(null, "", "#t=17"), { once: true }));
    await page.goBack();
    await expect.poll(() => page.locator("main").isVisible()).toBe(true);
    expect(new URL(page.url()).hash).toBe("#report");
    await reader.leave();
  });

  test("leads to the moments that it speaks of", async () => {
    const reader = await Reader.of(report);
    const moments = reader.page.getByRole("link", { name: /^[\d.]+\ss$/ });
    const moment = moments.nth((await moments.count()) - 1);
    const t_s = Number.parseFloat((await moment.textContent())!);
    expect(t_s).toBeGreaterThan(10);
    await moment.click();
    await expect.poll(() => reader.time()).toBeCloseTo(t_s, 2);
    await reader.leave();
  });

  test("opens at the moment in its address, and goes to another one", async () => {
    const reader = await Reader.of(report, "#t=12.3");
    await expect.poll(() => reader.time()).toBe(12.3);
    await reader.page.evaluate(() => (location.hash = "#t=3"));
    await expect.poll(() => reader.time()).toBe(3);
    // Keys reach the replay without a click into it.
    await reader.page.keyboard.press("ArrowRight");
    await expect.poll(() => reader.time()).toBe(4);
    await reader.leave();
  });

  test("is whole without scripts, and on paper", async () => {
    const still = await Reader.of(report, "#t=12.3", { javaScriptEnabled: false });
    expect(await still.page.locator("#views").isVisible()).toBe(false);
    expect(await still.page.locator("#path svg").isVisible()).toBe(true);
    await still.leave();

    const printed = await Reader.of(report, "#t=12.3");
    await printed.replay.locator(".task").first().waitFor();
    await printed.page.emulateMedia({ media: "print" });
    expect(await printed.page.locator("main").isVisible()).toBe(true);
    expect(await printed.page.locator("#replay").isVisible()).toBe(false);
    expect(await printed.page.locator("#views").isVisible()).toBe(false);
    await printed.leave();
  });

  test("runs no script but its own", async () => {
    const path = join(folder.path, "injected.html");
    const text = await readFile(report, "utf8");
    await writeFile(path, text.replace("<main>", '<main><script>document.title = "injected"</script>'));
    const reader = await Reader.of(path);
    expect(await reader.page.title()).toContain("Example 2");
    expect(reader.complaints.join()).toContain("Content Security Policy");
    await reader.page.context().close();
  });

  test("fits a phone, replay and all", async () => {
    const reader = await Reader.of(report, "#t=5", { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });
    await reader.replay.locator(".task").first().waitFor();
    const { width, most, high } = await reader.page.evaluate(() => ({
      width: innerWidth, most: document.documentElement.scrollWidth, high: document.documentElement.scrollHeight,
    }));
    expect(most).toBeLessThanOrEqual(width);
    expect(high).toBeLessThanOrEqual(844);
    await reader.leave();
  });
});
