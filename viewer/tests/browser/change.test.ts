// A run that is going on, changed: in the scene, as numbers, in its order, and taken back.

import { readFile } from "node:fs/promises";
import type { Browser, BrowserContextOptions, Page } from "playwright-core";
import { afterAll, afterEach, beforeAll, describe, expect, test } from "vitest";
import type { Recording } from "../../src/protocol";
import { open, visit } from "./browser";
import { Folder, ran, Served } from "./conik";
import { Mock } from "./mock";
import { drag, labelled, spotOf, still } from "./scene";

let folder: Folder, browser: Browser, recording: Recording, mock: Mock;
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
});

afterAll(async () => {
  await browser?.close();
  await flat?.close();
  await folder?.remove();
});

async function follow(options: Parameters<typeof Mock.of>[1] = {}, context: BrowserContextOptions = {}, through = browser): Promise<Page> {
  mock = await Mock.of(recording, options);
  const { page } = await visit(through, mock.url, { viewport: { width: 900, height: 620 }, ...context });
  await page.locator(".state-chip[data-kind=running]").waitFor();
  await page.locator(".about").getByRole("button", { name: "Close" }).click();
  return page;
}

const followFlat = (context: BrowserContextOptions = {}): Promise<Page> => follow({}, context, flat);

const row = (page: Page, name: string) => page.locator(".task", { has: page.locator(`.name:text-is("${name}")`) });
const names = (page: Page) => page.locator(".hierarchy .name").allTextContents();
const pointOf = (name: string) => mock.scene.tasks.find((task) => task.name === name)!.point_m!;

describe("in the scene", () => {
  test("an obstacle is dragged, one change at a time, and says so before", async () => {
    const page = await follow();
    const before = pointOf("obstacle_a");
    const spot = await spotOf(page, /^obstacle_a: drag to move it$/);
    expect(await page.locator(".stage canvas").evaluate((it) => getComputedStyle(it).cursor)).toBe("move");
    await drag(page, spot, 60, 0);
    await expect.poll(() => mock.changes.length).toBeGreaterThan(0);
    await page.mouse.up();
    await expect.poll(() => Math.hypot(...pointOf("obstacle_a").map((value, nth) => value - before[nth]!))).toBeGreaterThan(0.05);
    expect(mock.changes.every((change) => "task" in change && change.task === "obstacle_a" && change.key === "point_m")).toBe(true);
    await row(page, "obstacle_a").locator(".changed").waitFor();
    expect(await row(page, "obstacle_b").locator(".changed").isVisible()).toBe(false);
  });

  test("Escape puts back what is dragged", async () => {
    const page = await follow();
    const before = pointOf("obstacle_a");
    await drag(page, await spotOf(page, /^obstacle_a/), 60, 10);
    await expect.poll(() => String(pointOf("obstacle_a"))).not.toBe(String(before));
    await page.keyboard.press("Escape");
    await expect.poll(() => pointOf("obstacle_a")).toEqual(before);
    await page.mouse.move(10, 300);
    await page.mouse.up();
    expect(pointOf("obstacle_a")).toEqual(before);
  });

  test("a waypoint and a direction can be dragged too", async () => {
    const page = await follow();
    const spot = await labelled(page, "2");
    await page.mouse.move(spot.x, spot.y);
    await expect.poll(() => page.locator(".tip").textContent()).toMatch(/^waypoint 2 of position/);
    await drag(page, spot, 30, -10);
    await page.mouse.up();
    await expect.poll(() => mock.scene.tasks[3]!.waypoints_m![1]).not.toEqual(recording.runs[0]!.scene.tasks[3]!.waypoints_m![1]);
    expect(mock.scene.tasks[3]!.waypoints_m![0]).toEqual(recording.runs[0]!.scene.tasks[3]!.waypoints_m![0]);
    await page.getByRole("button", { name: "Change view", exact: true }).click();
    await page.locator(".stage canvas").focus();
    await page.keyboard.press("Shift+PageUp");
    await expect.poll(() => mock.scene.tasks[2]!.direction![2]).toBeGreaterThan(0.05);
  });

  test("keys move what is selected, and time only if nothing is", async () => {
    const page = await follow();
    const before = pointOf("obstacle_b");
    await page.getByRole("button", { name: "Change obstacle_b", exact: true }).click();
    for (const key of ["PageUp", "PageUp", "PageDown", "Shift+PageUp"]) {
      const asked = mock.asked.length;
      await page.keyboard.press(key);
      await expect.poll(() => mock.asked.length).toBe(asked + 1);
    }
    await expect.poll(() => pointOf("obstacle_b")[2]).toBeCloseTo(before[2] + 0.055, 3);
    expect(pointOf("obstacle_b").slice(0, 2)).toEqual(before.slice(0, 2));
    await page.keyboard.press("Escape");
    await page.keyboard.press("ArrowLeft");
    await expect.poll(() => page.locator(".when").textContent()).toContain("ago");
  });

  test("says why nothing can be dragged where nothing can", async () => {
    const page = await follow({ editable: false, allowed: [], refusal: "this may be a real arm" });
    const spot = await spotOf(page, /^This may be a real arm\.$/);
    expect(await page.locator(".stage canvas").evaluate((it) => getComputedStyle(it).cursor)).toBe("not-allowed");
    await drag(page, spot, 60, 0);
    await page.mouse.up();
    expect(mock.asked).toEqual([]);
  });

  test("is drawn with an outline of where things shall go", async () => {
    const page = await follow();
    await page.keyboard.press(" ");
    await page.locator(".state-chip[data-kind=paused]").waitFor();
    const before = await still(page);
    // The run stands, so that what it is told to do is yet to come.
    mock.scene = { ...mock.scene, tasks: mock.scene.tasks.map((task) => (task.name === "obstacle_b" ? { ...task, point_m: [0.5, 0.1, -0.1] } : task)) };
    const asked = mock.asked.length;
    await page.getByRole("button", { name: "Change obstacle_a", exact: true }).click();
    await page.getByLabel("x", { exact: false }).first().fill("0.45");
    await page.keyboard.press("Enter");
    await expect.poll(() => mock.asked.length).toBe(asked + 1);
    await page.keyboard.press("Escape");
    await page.keyboard.press("Escape");
    await expect.poll(async () => (await still(page)).equals(before)).toBe(false);
  });
});

describe("as numbers", () => {
  test("a bound is changed in the unit that is shown", async () => {
    const page = await followFlat();
    await page.getByRole("button", { name: "Change view", exact: true }).click();
    const most = page.getByLabel("greatest [°]");
    expect(Number(await most.inputValue())).toBeCloseTo(15.07, 1);
    await most.fill("20");
    await most.press("Enter");
    await expect.poll(() => mock.scene.tasks[2]!.max).toBeCloseTo(2 * Math.sin((10 * Math.PI) / 180), 6);
    await expect.poll(() => row(page, "view").locator(".what").textContent()).toContain("(20°)");
    await most.press("ArrowUp");
    await expect.poll(() => mock.scene.tasks[2]!.max).toBeCloseTo(2 * Math.sin((10.5 * Math.PI) / 180), 6);
  });

  test("what is refused stands beside what was changed, and the old value is back", async () => {
    const page = await followFlat();
    await page.getByRole("button", { name: "Change obstacle_a", exact: true }).click();
    const least = page.getByLabel("least [mm]");
    await least.fill("5000");
    await least.press("Enter");
    await expect.poll(() => row(page, "obstacle_a").locator(".editor [role=alert]:visible").textContent()).toBe("Obstacle_a: 5 is beyond 1.");
    expect(await least.inputValue()).toBe("180");
    expect(await least.getAttribute("aria-invalid")).toBe("true");
    await least.fill("many");
    await least.press("Enter");
    await expect.poll(() => row(page, "obstacle_a").locator(".editor [role=alert]:visible").textContent()).toBe('"many" is no number.');
    await least.fill("200");
    await least.press("Enter");
    await expect.poll(() => mock.scene.tasks[0]!.min).toBe(0.2);
    await expect.poll(() => row(page, "obstacle_a").locator(".editor [role=alert]:visible").count()).toBe(0);
  });

  test("a key that need not be there is taken away", async () => {
    const page = await followFlat();
    await page.getByRole("button", { name: "Change obstacle_a", exact: true }).click();
    const recovery = page.getByLabel("recovery [mm/s]");
    await recovery.fill("10");
    await recovery.press("Enter");
    // Whether or not the answer has come.
    await recovery.fill("");
    await recovery.press("Enter");
    await expect.poll(() => mock.changes.at(-1)).toMatchObject({ key: "recovery_per_s", value: null });
    await expect.poll(() => mock.scene.tasks[0]!.recovery_per_s ?? null).toBe(null);
    await expect.poll(() => recovery.inputValue()).toBe("");
  });

  test("a bound is dragged on its bar", async () => {
    const page = await followFlat();
    const grip = row(page, "obstacle_a").locator(".bound:visible");
    const box = (await grip.boundingBox())!;
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width / 2 + 40, box.y + 4, { steps: 4 });
    await page.mouse.up();
    await expect.poll(() => mock.scene.tasks[0]!.min).toBeGreaterThan(0.19);
  });

  test("settings are chosen", async () => {
    const page = await followFlat();
    await page.getByLabel("recursion").selectOption("siciliano-slotine");
    await expect.poll(() => mock.scene.settings.recursion).toBe("siciliano-slotine");
    expect(mock.changes).toEqual([{ control: "recursion", value: "siciliano-slotine" }]);
  });

  test("can be changed without 3-D", async () => {
    const page = await followFlat();
    expect(await page.locator(".no-3d").isVisible()).toBe(true);
    await page.getByRole("button", { name: "Change obstacle_b", exact: true }).click();
    const z = row(page, "obstacle_b").getByLabel("z [m]");
    await z.fill("-0.1");
    await z.press("Enter");
    await expect.poll(() => pointOf("obstacle_b")[2]).toBe(-0.1);
  });
});

describe("the order", () => {
  test("is changed by keys, by buttons, and by a hand", async () => {
    const page = await followFlat({ viewport: { width: 900, height: 1100 } });
    await row(page, "obstacle_a").focus();
    await page.keyboard.press("Alt+ArrowDown");
    await expect.poll(() => names(page)).toEqual(["obstacle_b", "obstacle_a", "view", "position"]);
    expect(await row(page, "obstacle_a").evaluate((it) => it === document.activeElement), "keeps the focus").toBe(true);
    await page.getByRole("button", { name: "Change view", exact: true }).click();
    await page.getByRole("button", { name: "More important: view" }).click();
    await expect.poll(() => names(page)).toEqual(["obstacle_b", "view", "obstacle_a", "position"]);
    await page.getByRole("button", { name: "Change view", exact: true }).click();
    const [grip, target] = [row(page, "position").locator(".number"), row(page, "obstacle_b")];
    await row(page, "position").scrollIntoViewIfNeeded();
    const from = (await grip.boundingBox())!;
    await page.mouse.move(from.x + 6, from.y + 8);
    await page.mouse.down();
    await page.mouse.move(from.x + 6, (await target.boundingBox())!.y + 4, { steps: 6 });
    await expect.poll(() => target.getAttribute("data-drop")).toBe("before");
    await page.mouse.up();
    await expect.poll(() => names(page)).toEqual(["position", "obstacle_b", "view", "obstacle_a"]);
  });
});

describe("all changes", () => {
  test("are taken back at once, and nothing is marked any more", async () => {
    const page = await followFlat();
    await row(page, "obstacle_a").focus();
    await page.getByRole("button", { name: "Change obstacle_a", exact: true }).click();
    await page.getByLabel("least [mm]").fill("210");
    await page.keyboard.press("Enter");
    await row(page, "obstacle_a").locator(".changed").waitFor();
    await page.getByRole("button", { name: "Undo all changes" }).click();
    await row(page, "obstacle_a").locator(".changed").waitFor({ state: "hidden" });
    await expect.poll(() => page.getByLabel("least [mm]").inputValue()).toBe("180");
    expect(await page.getByRole("button", { name: "Undo all changes" }).isVisible()).toBe(false);
  });

  test("are kept as a scenario, with the command that runs it", async () => {
    const page = await followFlat();
    const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "Save as scenario" }).click()]);
    expect(download.suggestedFilename()).toBe("mock.toml");
    expect(await readFile(await download.path(), "utf8")).toBe('title = "mock"\n');
    expect(await page.locator("dialog .command").textContent()).toBe("conik run mock.toml");
  });
});

describe("on a phone", () => {
  test("everything is there, a finger drags, and nothing is wider than the screen", async () => {
    const page = await follow({}, { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });
    await page.getByRole("button", { name: "Change position", exact: true }).click();
    const { width, most } = await page.evaluate(() => ({ width: innerWidth, most: document.documentElement.scrollWidth }));
    expect([width, most]).toEqual([390, 390]);
    for (const name of ["Pause the run", "Go to now", "Save as scenario"]) {
      expect(await page.getByRole("button", { name, exact: true }).isVisible(), name).toBe(true);
    }
    await page.evaluate(() => scrollTo(0, 0));
    const spot = await spotOf(page, /^obstacle_a/);
    const touch = await page.context().newCDPSession(page);
    const send = (type: "touchStart" | "touchMove" | "touchEnd", x: number) =>
      touch.send("Input.dispatchTouchEvent", { type, touchPoints: type === "touchEnd" ? [] : [{ x, y: spot.y }] });
    await send("touchStart", spot.x);
    for (const way of [10, 25, 40]) await send("touchMove", spot.x + way);
    await send("touchEnd", spot.x);
    await expect.poll(() => mock.changes.length).toBeGreaterThan(0);
    expect(mock.changes.at(-1)).toMatchObject({ task: "obstacle_a", key: "point_m" });
  });
});

describe("for those who do not see it", () => {
  test("everything that changes something has a name", async () => {
    const page = await follow();
    await page.getByRole("button", { name: "Change position", exact: true }).click();
    const unnamed = await page.evaluate(() =>
      [...document.querySelectorAll("button, select, input")].filter(
        (it) => !it.getAttribute("aria-label") && !(it.closest("label") ?? it).textContent?.trim(),
      ).length,
    );
    expect(unnamed).toBe(0);
    expect(await page.getByRole("group", { name: "waypoint 1 of position" }).getByRole("textbox").count()).toBe(3);
  });
});
