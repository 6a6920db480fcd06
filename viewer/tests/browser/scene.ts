// Finding things in the scene: a browser shows only pixels, and what it says when a pointer is over them.

import type { Page } from "playwright-core";
import { expect } from "vitest";

export interface Spot {
  x: number;
  y: number;
}

/** A point of the scene over which the page says something that matches. */
export async function spotOf(page: Page, says: RegExp): Promise<Spot> {
  const box = (await page.locator(".stage").boundingBox())!;
  const tip = page.locator(".tip");
  // From the middle outwards, where things are.
  const shares = [0.5, 0.56, 0.44, 0.62, 0.38, 0.68, 0.32, 0.74, 0.26];
  for (const down of shares) {
    for (const right of shares) {
      const spot = { x: Math.round(box.x + right * box.width), y: Math.round(box.y + down * box.height) };
      await page.mouse.move(spot.x, spot.y);
      // What is under a pointer is looked for in the next frame.
      await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
      if ((await tip.isVisible()) && says.test((await tip.textContent()) ?? "")) return spot;
    }
  }
  throw new Error(`nothing in the scene says ${String(says)}`);
}

/** How many pixels of the picture are drawn for one that is seen, across. */
export function fineness(page: Page): Promise<number> {
  return page.locator(".stage canvas").evaluate((it) => (it as HTMLCanvasElement).width / it.clientWidth);
}

/** The scene as it is once it stands still: where software draws, what moves is drawn roughly. */
export async function still(page: Page): Promise<Buffer> {
  await expect.poll(() => fineness(page)).toBeCloseTo(2, 1);
  return page.locator(".stage canvas").screenshot();
}

/** The point of the scene that a label belongs to. */
export async function labelled(page: Page, text: string): Promise<Spot> {
  const label = page.locator(".labels span:visible", { hasText: text }).first();
  const { left, top } = await label.evaluate((it) => {
    const { e, f } = new DOMMatrix(getComputedStyle(it).transform);
    return { left: e, top: f };
  });
  const box = (await page.locator(".stage").boundingBox())!;
  return { x: box.x + left, y: box.y + top };
}

/** Drags from a spot by so many pixels, and leaves the button down. */
export async function drag(page: Page, { x, y }: Spot, right: number, down: number): Promise<void> {
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + right, y + down, { steps: 5 });
}
