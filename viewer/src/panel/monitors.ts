// What was seen besides in a run that has ended.

import { element } from "../element";
import type { Result } from "../protocol";
import { seconds } from "../quantity";

interface Monitor {
  verdict: string;
  ticks: number;
  at_s: number | null;
  task: string | null;
}

const WORDS: Record<string, string> = {
  rank_lost: "a task lost directions to a singularity, or to what stands above it",
  frozen_moves: "a frozen set moved",
  frozen_inside: "a set strictly inside was frozen",
  stuck: "the arm stood still at a border with its goal not reached",
  went_outside: "a tick announced that the next sample would be outside",
  unannounced: "a sample was outside unannounced",
  stood_still: "no velocity would land inside every set, and the arm stood still",
  mode_changes: "the mode changed",
};

/** Lines for the monitors that saw something; `null` where nobody watched. */
export function monitors(result: Result | null): HTMLElement | null {
  const seen = Object.entries(result?.monitors ?? {}).filter(([name, monitor]) => WORDS[name] && isSeen(monitor));
  if (!result?.monitors) return null;
  const lines = seen.map(([name, monitor]) => element("li", {}, line(name, monitor as Monitor)));
  const none = element("p", { class: "soft" }, "No monitor saw anything.");
  return element(
    "section",
    { class: "monitors", "aria-label": "Monitors" },
    element("h2", {}, "What was seen besides"),
    lines.length ? element("ul", {}, ...lines) : none,
  );
}

function isSeen(monitor: unknown): boolean {
  return (monitor as Monitor | null)?.verdict === "seen";
}

function line(name: string, { ticks, at_s, task }: Monitor): string {
  const who = task ? ` (${task})` : "";
  const when = typeof at_s === "number" ? `, worst at ${seconds(at_s)}` : "";
  return `In ${ticks} ${ticks === 1 ? "tick" : "ticks"} ${WORDS[name]}${who}${when}.`;
}
