// How much script a page runs for each frame that it shows.

import type { Page } from "playwright-core";

/** What runs while somebody waits [ms]. */
const LONG = 8_000;

/**
 * Script of a frame in time of the page's own thread [ms], and how many frames there were. Unlike time on the
 * wall it does not count waiting for whatever draws in software on the same processor.
 */
export async function scriptOfFrame(page: Page): Promise<{ frames: number; ms: number }> {
  await page.evaluate("window.shown = 0; (function count() { window.shown++; requestAnimationFrame(count); })()");
  const session = await page.context().newCDPSession(page);
  await session.send("Performance.enable", { timeDomain: "threadTicks" });
  const look = async () => {
    const { metrics } = await session.send("Performance.getMetrics");
    const script_s = metrics.find(({ name }) => name === "ScriptDuration")!.value;
    return { script_s, shown: await page.evaluate<number>("window.shown") };
  };
  const before = await look();
  await page.waitForTimeout(LONG);
  const after = await look();
  const frames = after.shown - before.shown;
  return { frames, ms: (1e3 * (after.script_s - before.script_s)) / frames };
}
