// The command `conik`, built from these sources: runs scenarios and serves the page.

import { type ChildProcess, execFile, spawn } from "node:child_process";
import { mkdtemp, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { createInterface } from "node:readline";
import { promisify } from "node:util";

const run = promisify(execFile);
export const REPOSITORY = join(import.meta.dirname, "../../..");

/** A folder that is gone with the tests that use it. */
export class Folder {
  private constructor(readonly path: string) {}

  static async make(): Promise<Folder> {
    return new Folder(await mkdtemp(join(tmpdir(), "conik-browser-")));
  }

  remove(): Promise<void> {
    return rm(this.path, { recursive: true });
  }
}

let program: Promise<string> | undefined;

/** Path of the command, which stands in the environment or is built. */
function conik(): Promise<string> {
  const given = process.env["CONIK"];
  if (given) return Promise.resolve(given);
  program ??= run("cargo", ["build", "--quiet", "--package", "conik-cli", "--message-format", "json"], {
    cwd: REPOSITORY,
    maxBuffer: 1 << 28,
  }).then(({ stdout }) => {
    const messages = stdout.trim().split("\n").map((line) => JSON.parse(line));
    const built = messages.find(({ target, executable }) => executable && target?.name === "conik");
    if (!built) throw new Error("cargo built no conik");
    return built.executable as string;
  });
  return program;
}

/** Runs a scenario on the ideal arm and returns the run's folder. */
export async function ran(folder: Folder, scenario: string, ...options: string[]): Promise<string> {
  const out = join(folder.path, `${scenario.split("/").pop()}-${options.length}`);
  const path = scenario.startsWith("/") ? scenario : join(REPOSITORY, "scenarios", `${scenario}.toml`);
  await run(await conik(), ["run", path, "--robot", "ideal", "--quiet", "--out", out, ...options], { cwd: folder.path });
  return out;
}

/** A page that is served. */
export class Served {
  private constructor(readonly url: string, private readonly process: ChildProcess) {}

  static async of(...dirs: string[]): Promise<Served> {
    const process = spawn(await conik(), ["view", ...dirs], { stdio: ["ignore", "pipe", "inherit"] });
    for await (const line of createInterface({ input: process.stdout! })) {
      if (line.startsWith("http://")) return new Served(line, process);
    }
    throw new Error("conik view ended without an address");
  }

  stop(): void {
    this.process.kill("SIGINT");
  }
}
