// A run that is going on, of the command itself: `conik view SCENARIO`.

import { readFile } from "node:fs/promises";
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, afterEach, beforeAll, beforeEach, describe, expect, test } from "vitest";
import type { Recording } from "../../src/protocol";
import { open, shownTime, visit } from "./browser";
import { REPOSITORY, Served } from "./conik";
import { drag, spotOf } from "./scene";

const EXAMPLE = join(REPOSITORY, "scenarios/paper/example2.toml");

let browser: Browser, served: Served, page: Page, complaints: string[];

beforeAll(async () => {
  browser = await open();
});

beforeEach(async () => {
  served = await Served.of(EXAMPLE);
  ({ page, complaints } = await visit(browser, served.url, { viewport: { width: 900, height: 620 } }));
  await page.locator(".about").getByRole("button", { name: "Close" }).click();
  await expect.poll(() => shownTime(page)).toBeGreaterThan(0.5);
});

afterEach(async () => {
  await page?.context().close();
  served?.stop();
});

afterAll(async () => {
  await browser?.close();
});

const row = (name: string) => page.locator(".task", { has: page.locator(`.name:text-is("${name}")`) });
const recording = async (): Promise<Recording> => (await fetch(new URL("recording.json", served.url))).json();
const press = (name: string) => page.getByRole("button", { name, exact: true }).click();

/** Enters a number in the editor that is open. */
async function enter(label: string, value: string): Promise<void> {
  await page.getByLabel(label).fill(value);
  await page.getByLabel(label).press("Enter");
}

describe("a scenario that runs in the page", () => {
  test("is followed, paused, stepped, sped up and restarted", async () => {
    await press("Pause the run");
    await page.locator(".state-chip[data-kind=paused]").waitFor();
    await page.locator(".when", { hasText: "run paused" }).waitFor();
    const at = await shownTime(page);
    for (let tick = 0; tick < 5; tick++) await page.keyboard.press(".");
    await expect.poll(() => shownTime(page)).toBeGreaterThan(at + 0.025);
    expect(await shownTime(page)).toBeLessThan(at + 0.055);
    await page.locator("select[aria-label='Speed of the run']").selectOption("5");
    await expect.poll(() => page.locator(".chip.arm").textContent()).toContain("5× speed");
    await press("Resume the run");
    await expect.poll(() => shownTime(page)).toBeGreaterThan(at + 3);
    await page.locator("select[aria-label='Speed of the run']").selectOption("1");
    const before = await shownTime(page);
    await press("Restart the run");
    await expect.poll(() => shownTime(page)).toBeLessThan(before);
    expect(complaints.filter((text) => !/GPU stall|GL Driver/.test(text))).toEqual([]);
  });

  test("evades an obstacle that is put in its way, whose set becomes active", async () => {
    expect(await row("obstacle_b").getAttribute("data-state")).toBe("inside");
    await press("Pause the run");
    await page.locator(".state-chip[data-kind=paused]").waitFor();
    const { columns } = (await recording()).runs[0]!.ticks;
    const tool = ["tool_x_m", "tool_y_m", "tool_z_m"].map((axis) => columns[axis]!.at(-1)!);
    await press("Change obstacle_b");
    const editor = row("obstacle_b").locator(".editor");
    for (const [nth, axis] of ["x", "y", "z"].entries()) {
      const field = editor.getByLabel(`${axis} [m]`);
      await field.fill(String(Number(tool[nth]!.toFixed(3))));
      await field.press("Enter");
    }
    await press("Resume the run");
    const wasHeld = async () => {
      const { active, active_sets } = (await recording()).runs[0]!.ticks;
      return active.some((nth) => active_sets[nth]?.includes("obstacle_b"));
    };
    await expect.poll(wasHeld).toBe(true);
    // Its ball has a radius of 150 mm, and the arm stays out of it.
    await expect.poll(async () => Number.parseFloat((await row("obstacle_b").locator(".value").textContent())!)).toBeGreaterThan(145);
    await row("obstacle_b").locator(".changed").waitFor();
    await press("Undo all changes");
    await row("obstacle_b").locator(".changed").waitFor({ state: "hidden" });
  });

  test("takes what a hand drags in the scene", async () => {
    const point = async () => (await recording()).runs[0]!.scene.tasks[0]!.point_m!;
    const before = await point();
    await drag(page, await spotOf(page, /^obstacle_a/), 50, 0);
    await page.mouse.up();
    await expect.poll(async () => Math.hypot(...(await point()).map((value, nth) => value - before[nth]!))).toBeGreaterThan(0.03);
    await row("obstacle_a").locator(".changed").waitFor();
  });

  test("says why it does not take a value, and keeps the old one", async () => {
    await press("Change view");
    await enter("gain [1/s]", "-1");
    const error = row("view").locator(".editor [role=alert]:visible");
    await error.waitFor();
    expect((await error.textContent())!.length).toBeGreaterThan(10);
    expect(await page.getByLabel("gain [1/s]").inputValue()).toBe("");
    await enter("greatest [°]", "20");
    await expect.poll(async () => (await recording()).runs[0]!.scene.tasks[2]!.max).toBeCloseTo(2 * Math.sin((10 * Math.PI) / 180), 6);
  });

  test("takes another order and other settings, and is saved with them", async () => {
    await row("obstacle_a").focus();
    await page.keyboard.press("Alt+ArrowDown");
    await expect.poll(() => page.locator(".hierarchy .name").allTextContents()).toEqual(["obstacle_b", "obstacle_a", "view", "position"]);
    await page.getByLabel("mode rule").selectOption("cone");
    await expect.poll(async () => (await recording()).runs[0]!.scene.settings.mode_rule).toBe("cone");
    const [download] = await Promise.all([page.waitForEvent("download"), press("Save as scenario")]);
    expect(download.suggestedFilename()).toBe("example2-edited.toml");
    const toml = await readFile(await download.path(), "utf8");
    expect(toml).toContain('mode_rule = "cone"');
    expect(toml.indexOf('name = "obstacle_b"')).toBeLessThan(toml.indexOf('name = "obstacle_a"'));
  });

  test("stays in the page when the command ends", async () => {
    served.stop();
    await expect.poll(() => page.locator(".banner").textContent()).toContain("does not answer any more");
    await page.keyboard.press("Home");
    await expect.poll(() => shownTime(page)).toBe(0);
  });
});
