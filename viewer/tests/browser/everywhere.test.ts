// The page where things are missing, small or dark: no 3-D, no server, a phone, two runs.

import { readFile, writeFile } from "node:fs/promises";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { gzipSync } from "node:zlib";
import type { Browser } from "playwright-core";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import { open, shownTime, visit } from "./browser";
import { Folder, ran, REPOSITORY, Served } from "./conik";

let folder: Folder, browser: Browser, example: Served, dir: string;

beforeAll(async () => {
  folder = await Folder.make();
  browser = await open();
  dir = await ran(folder, "paper/example2", "--duration-s", "20");
  example = await Served.of(dir);
});

afterAll(async () => {
  example?.stop();
  await browser?.close();
  await folder?.remove();
});

describe("without 3-D", () => {
  test("everything else is there, and a notice", async () => {
    const flat = await open(false);
    try {
      const { page } = await visit(flat, `${example.url}#t=17`);
      expect(await page.locator(".no-3d").textContent()).toContain("WebGL");
      await expect.poll(() => page.locator('.task[data-state="held"]').count()).toBe(2);
      expect(await page.locator(".plot").count()).toBe(4);
    } finally {
      await flat.close();
    }
  });
});

describe("in a file", () => {
  const page_of = () => readFile(join(REPOSITORY, "viewer/dist/index.html"), "utf8");
  const json = async () => (await fetch(`${example.url}recording.json`)).text();
  const kinds = {
    "application/json": async () => (await json()).replaceAll("<", "\\u003c"),
    "application/gzip": async () => gzipSync(await json()).toString("base64"),
  };

  test.each(Object.entries(kinds))("the run is embedded as %s", async (type, data) => {
    const block = `<script type="${type}" id="recording">${await data()}</script>`;
    const path = join(folder.path, `report-${type.split("/").pop()}.html`);
    await writeFile(path, (await page_of()).replace("<body>", () => `<body>\n${block}`));
    const context = await browser.newContext({ offline: true });
    const requests: string[] = [];
    context.on("request", (request) => requests.push(request.url()));
    const page = await context.newPage();
    await page.goto(`${pathToFileURL(path).href}#t=17`);
    await page.locator(".task").first().waitFor();
    await expect.poll(() => shownTime(page)).toBe(17);
    expect(await page.locator('.task[data-state="held"] .name').allTextContents()).toEqual(["obstacle_b", "view"]);
    expect(requests.filter((url) => !/^(file|data|blob):/.test(url))).toEqual([]);
    await context.close();
  });

  test("a page without a run says so", async () => {
    const path = join(folder.path, "empty.html");
    await writeFile(path, await page_of());
    const page = await browser.newPage();
    await page.goto(pathToFileURL(path).href);
    await expect.poll(() => page.locator("[role=alert]").textContent()).toContain("There is no run in this file");
    await page.close();
  });

  test("a run of another version is named", async () => {
    const path = join(folder.path, "version.html");
    const block = '<script type="application/json" id="recording">{"kind":"recording","protocol":99,"runs":[]}</script>';
    await writeFile(path, (await page_of()).replace("<body>", () => `<body>${block}`));
    const page = await browser.newPage();
    await page.goto(pathToFileURL(path).href);
    await expect.poll(() => page.locator("[role=alert]").textContent()).toContain("version 99");
    await page.close();
  });
});

describe("names in a run", () => {
  test("are text and never part of the page", async () => {
    const recording = await (await fetch(`${example.url}recording.json`)).json();
    recording.runs[0].scene.title = '<img src=x onerror="document.title=1">';
    const text = JSON.stringify(recording).replaceAll("<", "\\u003c");
    const page_text = await readFile(join(REPOSITORY, "viewer/dist/index.html"), "utf8");
    const block = `<script type="application/json" id="recording">${text}</script>`;
    const path = join(folder.path, "names.html");
    await writeFile(path, page_text.replace("<body>", () => `<body>${block}`));
    const page = await browser.newPage();
    await page.goto(pathToFileURL(path).href);
    await page.locator(".task").first().waitFor();
    expect(await page.locator("h1").textContent()).toBe(recording.runs[0].scene.title);
    expect(await page.locator("img").count()).toBe(0);
    await page.close();
  });
});

describe("on a phone", () => {
  test("nothing is wider than the screen, and everything is there", async () => {
    const { page } = await visit(browser, example.url, { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });
    const { width, most } = await page.evaluate(() => ({ width: innerWidth, most: document.documentElement.scrollWidth }));
    expect(width).toBe(390);
    expect(most).toBeLessThanOrEqual(width);
    for (const place of [".stage", ".transport", ".hierarchy", ".joints", ".plots"]) {
      expect(await page.locator(place).isVisible(), place).toBe(true);
    }
    await page.context().close();
  });
});

describe("light and dark", () => {
  const paper = "getComputedStyle(document.body).backgroundColor";

  test("follow the system until somebody chooses", async () => {
    const { page } = await visit(browser, example.url, { colorScheme: "dark" });
    const dark = await page.evaluate(paper);
    await page.emulateMedia({ colorScheme: "light" });
    await expect.poll(() => page.evaluate(paper)).not.toBe(dark);
    await page.getByRole("button", { name: "Light or dark" }).click();
    expect(await page.evaluate(paper)).toBe(dark);
    await page.reload();
    await page.locator(".task").first().waitFor();
    expect(await page.evaluate(paper), "is remembered").toBe(dark);
    await page.context().close();
  });
});

describe("for those who do not see it", () => {
  test("everything that can be pressed has a name, and pictures have words", async () => {
    const { page } = await visit(browser, `${example.url}#t=17`);
    const unnamed = await page.evaluate(() =>
      [...document.querySelectorAll("button, select, input")].filter(
        (it) => !it.getAttribute("aria-label") && !(it.closest("label") ?? it).textContent?.trim(),
      ).length,
    );
    expect(unnamed).toBe(0);
    const pictures = await page.locator("canvas").evaluateAll((all) => all.map((it) => it.getAttribute("aria-label")));
    expect(pictures.every(Boolean)).toBe(true);
    await expect.poll(() => page.locator(".stage canvas").getAttribute("aria-label")).toContain("obstacle_b + view");
    expect(await page.locator(".scrub").getAttribute("aria-valuetext")).toContain("obstacle_b + view");
    await page.keyboard.press("[");
    await expect.poll(() => page.locator("[role=status]").textContent()).toContain("s: ");
    await page.context().close();
  });
});

describe("two runs", () => {
  test("are shown side by side at one time", async () => {
    const other = await ran(folder, "paper/example2", "--duration-s", "15", "--mode-rule", "cone", "--border", "land");
    const both = await Served.of(dir, other);
    try {
      const { page } = await visit(browser, `${both.url}#t=18`);
      expect(await page.locator(".pane").count()).toBe(2);
      expect(await page.locator(".stage canvas").count()).toBe(2);
      expect(await page.locator(".now h2").allTextContents()).toEqual([
        expect.stringContaining("paper · freeze"),
        expect.stringContaining("cone · land"),
      ]);
      // The second is over by then, and stays where it ended.
      await expect.poll(() => page.locator(".plot .value").first().textContent()).toMatch(/^[^|]+ \| [^|–]+$/);
    } finally {
      both.stop();
    }
  });
});
