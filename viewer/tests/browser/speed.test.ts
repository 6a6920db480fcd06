// How much script a frame takes with fifty obstacles. What was measured is printed; that it was is tested.

import { writeFile } from "node:fs/promises";
import { join } from "node:path";
import type { Browser } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import { open, visit } from "./browser";
import { Folder, ran, Served } from "./conik";
import { crowded, OBSTACLES } from "./crowded";
import { scriptOfFrame } from "./script";

let folder: Folder, browser: Browser, served: Served;

beforeAll(async () => {
  folder = await Folder.make();
  browser = await open();
  const scenario = join(folder.path, "crowded.toml");
  await writeFile(scenario, crowded());
  served = await Served.of(await ran(folder, scenario));
});

afterAll(async () => {
  served?.stop();
  await browser?.close();
  await folder?.remove();
});

test("script of a frame with fifty obstacles", async () => {
  // Software draws a small picture more often; the script's work is the same.
  const { page } = await visit(browser, served.url, { viewport: { width: 800, height: 600 } });
  expect(await page.locator(".task").count()).toBe(OBSTACLES + 1);
  await page.keyboard.press(" ");
  const script = await scriptOfFrame(page);
  await page.keyboard.press("?");
  const said = (await page.locator(".timing").textContent()) ?? "";
  console.log(`${said}; on the processor ${script.ms.toFixed(2)} ms`);
  const [frames, median, p99] = [...said.matchAll(/[\d.]+/g)].map(Number).filter((_, nth) => nth !== 2);
  expect(frames).toBeGreaterThan(5);
  expect(median).toBeGreaterThan(0);
  expect(script.ms).toBeGreaterThan(0);
  expect(p99).toBeGreaterThanOrEqual(median!);
});
