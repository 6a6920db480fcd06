// How much script a frame takes with fifty obstacles in a run that is going on at 125 Hz.
// What was measured is printed; that it was is tested.

import { writeFile } from "node:fs/promises";
import { join } from "node:path";
import { afterAll, beforeAll, expect, test } from "vitest";
import type { Recording } from "../../src/protocol";
import { open, visit } from "./browser";
import { Folder, ran, Served } from "./conik";
import { crowded, OBSTACLES } from "./crowded";
import { Mock } from "./mock";
import { scriptOfFrame } from "./script";

let folder: Folder, recording: Recording;

beforeAll(async () => {
  folder = await Folder.make();
  const scenario = join(folder.path, "crowded.toml");
  await writeFile(scenario, crowded());
  const served = await Served.of(await ran(folder, scenario));
  recording = await (await fetch(`${served.url}recording.json`)).json();
  served.stop();
});

afterAll(async () => {
  await folder?.remove();
});

// Software draws so seldom that each frame has ten messages to go with; without a picture there are sixty
// frames a second, as where a graphics card draws.
test.each([true, false])("script of a frame with fifty obstacles while the run goes on, picture: %s", async (has3d) => {
  const browser = await open(has3d);
  const mock = await Mock.of(recording);
  try {
    const { page } = await visit(browser, mock.url, { viewport: { width: 800, height: 600 } });
    expect(await page.locator(".task").count()).toBe(OBSTACLES + 1);
    await page.locator(".live[aria-pressed=true]").waitFor();
    const script = await scriptOfFrame(page);
    await page.keyboard.press("?");
    const said = (await page.locator(".timing").textContent()) ?? "";
    console.log(`${has3d ? "drawn in software" : "without a picture"}: ${said}; on the processor, with its messages, ${script.ms.toFixed(2)} ms a frame`);
    const [frames, median] = [...said.matchAll(/[\d.]+/g)].map(Number);
    expect(frames).toBeGreaterThan(5);
    expect(median).toBeGreaterThan(0);
    expect(script.ms).toBeGreaterThan(0);
  } finally {
    await mock.stop();
    await browser.close();
  }
});
