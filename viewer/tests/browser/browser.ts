// The system's Chromium, without a screen, drawing 3-D in software.

import { type Browser, type BrowserContextOptions, type Page, chromium } from "playwright-core";

const WITH_3D = ["--disable-gpu", "--enable-unsafe-swiftshader"];
const WITHOUT_3D = ["--disable-gpu", "--disable-3d-apis"];

export function open(has3d = true): Promise<Browser> {
  // Browsers refuse to shut in what they run as root.
  const args = ["--no-sandbox", ...(has3d ? WITH_3D : WITHOUT_3D)];
  return chromium.launch({ executablePath: process.env["CHROMIUM"] ?? "/usr/bin/chromium", args });
}

/** A page, and what it complained about. */
export interface Visit {
  page: Page;
  complaints: string[];
}

/** Visits an address, and waits until the run is there. */
export async function visit(browser: Browser, url: string, options: BrowserContextOptions = {}): Promise<Visit> {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, ...options });
  const page = await context.newPage();
  const complaints: string[] = [];
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type())) complaints.push(message.text());
  });
  page.on("pageerror", (error) => complaints.push(String(error)));
  await page.goto(url);
  await page.locator(".hierarchy [data-state]").first().waitFor({ state: "attached" });
  return { page, complaints };
}

/** The time that the page shows [s]. */
export async function shownTime(page: Page): Promise<number> {
  return Number(await page.locator(".clock").textContent());
}
