// How much script a frame takes with fifty obstacles in a run that is going on at 125 Hz.
// What was measured is printed; that it was is tested.

import { writeFile } from "node:fs/promises";
import { join } from "node:path";
import type { Browser } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import type { Recording } from "../../src/protocol";
import { open, visit } from "./browser";
import { Folder, ran, Served } from "./conik";
import { crowded, OBSTACLES } from "./crowded";
import { Mock } from "./mock";

let folder: Folder, browser: Browser, mock: Mock;

beforeAll(async () => {
  folder = await Folder.make();
  browser = await open();
  const scenario = join(folder.path, "crowded.toml");
  await writeFile(scenario, crowded());
  const served = await Served.of(await ran(folder, scenario));
  const recording: Recording = await (await fetch(`${served.url}recording.json`)).json();
  served.stop();
  mock = await Mock.of(recording);
});

afterAll(async () => {
  await mock?.stop();
  await browser?.close();
  await folder?.remove();
});

test("script of a frame with fifty obstacles while the run goes on", async () => {
  const { page } = await visit(browser, mock.url, { viewport: { width: 800, height: 600 } });
  expect(await page.locator(".task").count()).toBe(OBSTACLES + 1);
  await page.locator(".live[aria-pressed=true]").waitFor();
  await page.waitForTimeout(15_000);
  await page.keyboard.press("?");
  const said = (await page.locator(".timing").textContent()) ?? "";
  console.log(said);
  const [frames, median] = [...said.matchAll(/[\d.]+/g)].map(Number);
  expect(frames).toBeGreaterThan(5);
  expect(median).toBeGreaterThan(0);
});
