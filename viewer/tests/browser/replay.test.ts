// A run replayed in a browser: what is shown, and how it is steered.

import type { Browser } from "playwright-core";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import { Kinematics } from "../../src/kinematics";
import type { Recording } from "../../src/protocol";
import { ModeColours, Run } from "../../src/run";
import { open, shownTime, visit } from "./browser";
import { Folder, ran, Served } from "./conik";
import { fineness, still } from "./scene";

let folder: Folder, browser: Browser, example: Served, recording: Recording;
/** For what has nothing to do with the scene, which software draws slowly. */
let flat: Browser;

beforeAll(async () => {
  folder = await Folder.make();
  [browser, flat, example] = await Promise.all([
    open(),
    open(false),
    ran(folder, "paper/example2", "--duration-s", "20").then((dir) => Served.of(dir)),
  ]);
  recording = await (await fetch(`${example.url}recording.json`)).json();
});

afterAll(async () => {
  example?.stop();
  await browser?.close();
  await flat?.close();
  await folder?.remove();
});

describe("the page", () => {
  test("shows the run without a complaint", async () => {
    const { page, complaints } = await visit(browser, example.url);
    expect(await page.title()).toContain("Example 2");
    const names = await page.locator(".task .name").allTextContents();
    expect(names).toEqual(["obstacle_a", "obstacle_b", "view", "position"]);
    expect(await page.locator(".stage canvas").count()).toBe(1);
    expect(await page.locator(".plot").count()).toBe(4);
    expect(await page.locator(".joint").count()).toBe(6);
    // What software drawing says of itself is no complaint of the page.
    expect(complaints.filter((text) => !/GPU stall|GL Driver/.test(text))).toEqual([]);
    await page.context().close();
  });

  test("shows at every change of mode what the log has there", async () => {
    const run = new Run(recording.runs[0]!, new ModeColours());
    expect(run.spans.length).toBeGreaterThan(3);
    const { page } = await visit(flat, example.url);
    for (const span of run.spans.slice(1)) {
      await page.keyboard.press("]");
      await expect.poll(() => shownTime(page)).toBeCloseTo(span.from_s, 2);
      const number = run.modeNumber(run.rowAt(span.from_s));
      expect(await page.locator(".mode").textContent()).toBe(`Mode ${number}: ${span.mode.label}`);
      const held = await page.locator('.task[data-state="held"] .name').allTextContents();
      expect(held).toEqual([...span.mode.active]);
    }
    await page.context().close();
  });

  test("draws another picture where the arm is elsewhere, and the same where it is not", async () => {
    const { page } = await visit(browser, `${example.url}#t=0`);
    const picture = async (key: string, t_s: number) => {
      await page.keyboard.press(key);
      await expect.poll(() => shownTime(page)).toBe(t_s);
      return still(page);
    };
    const start = await picture("Home", 0);
    const later = await picture("Shift+ArrowRight", 10);
    const again = await picture("Home", 0);
    expect(later.equals(start)).toBe(false);
    expect(again.equals(start)).toBe(true);
    await page.context().close();
  });

  test("draws roughly in software what moves, and finely what stands still", async () => {
    const { page } = await visit(browser, `${example.url}#t=0`);
    await still(page);
    await page.keyboard.press(" ");
    await expect.poll(() => fineness(page)).toBeCloseTo(1, 1);
    await page.keyboard.press(" ");
    await still(page);
    await page.context().close();
  });

  test("is steered by keys", async () => {
    const { page } = await visit(flat, `${example.url}#t=5`);
    const steps: [string, number][] = [
      ["ArrowRight", 6], ["ArrowLeft", 5], [".", 5.01], [",", 5], ["Shift+ArrowRight", 15], ["End", 20], ["Home", 0],
    ];
    for (const [key, t_s] of steps) {
      await page.keyboard.press(key);
      await expect.poll(() => shownTime(page), { message: key }).toBeCloseTo(t_s, 1);
    }
    await page.keyboard.press("?");
    expect(await page.locator("dialog").isVisible()).toBe(true);
    await page.keyboard.press("Escape");
    expect(await page.locator("dialog").isVisible()).toBe(false);
    expect(await page.locator(".about").isVisible(), "one thing at a time").toBe(true);
    await page.keyboard.press("Escape");
    expect(await page.locator(".about").isVisible()).toBe(false);
    await page.keyboard.press("p");
    expect(await page.locator(".plots").isVisible()).toBe(false);
    await page.context().close();
  });

  test("plays, and stops at the end", async () => {
    const { page } = await visit(flat, `${example.url}#t=18`);
    await page.locator("select[aria-label='Speed of replay']").selectOption("8");
    await page.getByRole("button", { name: "Play", exact: true }).click();
    await expect.poll(() => shownTime(page)).toBe(20);
    await page.getByRole("button", { name: "Play", exact: true }).waitFor();
    await page.context().close();
  });

  test("has an address for every moment", async () => {
    const { page } = await visit(flat, `${example.url}#t=12.5`);
    await expect.poll(() => shownTime(page)).toBe(12.5);
    await page.keyboard.press("ArrowRight");
    await expect.poll(() => page.url()).toMatch(/#t=13\.5$/);
    await page.evaluate(() => (location.hash = "#t=3"));
    await expect.poll(() => shownTime(page)).toBe(3);
    await page.context().close();
  });

  test("goes where somebody presses in the timeline or in a plot", async () => {
    const { page } = await visit(flat, example.url);
    for (const place of [".timeline .canvas", ".plot .canvas"]) {
      await page.keyboard.press("Home");
      const box = (await page.locator(place).first().boundingBox())!;
      await page.mouse.click(box.x + box.width / 2, box.y + 8);
      await expect.poll(() => shownTime(page), { message: place }).toBeGreaterThan(8);
      expect(await shownTime(page)).toBeLessThan(12.5);
    }
    await page.context().close();
  });

  test("plots any column", async () => {
    const { page } = await visit(flat, example.url);
    await page.locator("select[aria-label='Add a plot']").selectOption("qd2_rad_s");
    expect(await page.locator(".plot h3").allTextContents()).toContain("shoulder_lift_joint speed [°/s]");
    await page.getByRole("button", { name: "Remove the plot of shoulder_lift_joint speed" }).click();
    expect(await page.locator(".plot").count()).toBe(4);
    await page.context().close();
  });

  test("leaves out what is inside, if asked to, also while it plays", async () => {
    const { page } = await visit(flat, `${example.url}#t=17`);
    await page.getByLabel("only what is held").check();
    const shown = () => page.locator(".task .name:visible").allTextContents();
    await expect.poll(shown).toEqual(["obstacle_b", "view", "position"]);
    // From where obstacle_a alone is held.
    await page.evaluate(() => (location.hash = "#t=3"));
    await expect.poll(shown).toEqual(["obstacle_a", "view", "position"]);
    await page.getByRole("button", { name: "Play", exact: true }).click();
    await expect.poll(() => shownTime(page)).toBeGreaterThan(6.5);
    expect(await shown()).toEqual(["position"]);
    await page.context().close();
  });

  test("finds a task in the scene, and in the list what is pointed at", async () => {
    const { page } = await visit(browser, example.url);
    const stage = page.locator(".stage");
    await page.locator(".task").nth(1).hover();
    await expect.poll(() => stage.locator(".labels .region:visible").allTextContents()).toEqual(["obstacle_b"]);
    await page.mouse.move(5, 5);
    const box = (await stage.boundingBox())!;
    // From above, both balls and nothing before them.
    await page.keyboard.press("3");
    const pointed = page.locator(".task[data-pointed] .name");
    for (let share = 0.3; share < 0.8 && (await pointed.count()) === 0; share += 0.04) {
      await page.mouse.move(box.x + 0.55 * box.width, box.y + share * box.height);
      await page.waitForTimeout(300);
    }
    expect(await pointed.textContent()).toMatch(/obstacle_[ab]/);
    await page.context().close();
  });

  test("explains itself once", async () => {
    const { page } = await visit(flat, example.url);
    await page.locator(".about button").click();
    await page.reload();
    await page.locator(".task").first().waitFor();
    expect(await page.locator(".about").isVisible()).toBe(false);
    await page.getByRole("button", { name: "What am I looking at?" }).click();
    expect(await page.locator(".about").isVisible()).toBe(true);
    await page.context().close();
  });
});

describe("the page's kinematics", () => {
  const scenarios = ["gallery/urdf-rail-arm", "gallery/welding", "gallery/shelf", "gallery/keep-looking"];
  test.each(scenarios)("have the tool of %s where the log has it", async (scenario) => {
    const served = await Served.of(await ran(folder, scenario, "--duration-s", "10"));
    try {
      const { runs }: Recording = await (await fetch(`${served.url}recording.json`)).json();
      const run = new Run(runs[0]!, new ModeColours());
      const kinematics = new Kinematics(run.scene.robot);
      expect(run.rows).toBeGreaterThan(100);
      for (let row = 0; row < run.rows; row += 7) {
        kinematics.update((joint) => run.q(joint, row));
        for (const [axis, i] of [["x", 3], ["y", 7], ["z", 11]] as const) {
          // The numbers come in single precision.
          expect(Math.abs(kinematics.tool[i]! - run.at(`tool_${axis}_m`, row))).toBeLessThan(2e-6);
        }
      }
    } finally {
      served.stop();
    }
  });
});
