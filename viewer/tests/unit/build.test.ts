// The page that is committed, and embedded in the command, is what its sources make.

import { mkdtemp, readFile, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { build } from "vite";
import { expect, test } from "vitest";

const ROOT = join(import.meta.dirname, "../..");

test("the committed page is up to date", async () => {
  const folder = await mkdtemp(join(tmpdir(), "conik-page-"));
  try {
    // Tests have a mode of their own, which is not that of the page.
    await build({ root: ROOT, mode: "production", logLevel: "error", build: { outDir: folder, emptyOutDir: true } });
    const [made, committed] = await Promise.all(
      [folder, join(ROOT, "dist")].map((where) => readFile(join(where, "index.html"), "utf8")),
    );
    expect(made === committed, "run `npm run build` and commit dist/index.html").toBe(true);
  } finally {
    await rm(folder, { recursive: true });
  }
});
