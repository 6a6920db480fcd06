// How the page is built, one file with everything in it, and how it is tested.
import { defineConfig } from "vitest/config";
import { singleFile } from "./build/single_file.ts";

/** Whoever waits longer than this waits in vain [ms]. Software draws 3-D slowly. */
const IN_VAIN = 120_000;

export default defineConfig({
  base: "./",
  plugins: [singleFile()],
  build: {
    target: "es2022",
    modulePreload: false,
    cssCodeSplit: false,
    assetsInlineLimit: Number.MAX_SAFE_INTEGER,
    chunkSizeWarningLimit: 2000,
    reportCompressedSize: false,
  },
  test: {
    testTimeout: IN_VAIN,
    hookTimeout: 5 * IN_VAIN,
    expect: { poll: { timeout: IN_VAIN / 2 } },
    // Browsers that draw in software leave nothing for each other.
    fileParallelism: false,
    // One that draws in software beside other programs may lose a click: what fails twice has failed.
    retry: 1,
  },
});
