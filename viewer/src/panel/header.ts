// What run this is, how it ended, and the page's own switches.

import { button, element, icon } from "../element";
import type { Outcome, Scene } from "../protocol";
import type { Run } from "../run";

const MOON = "M13 10.2A5.6 5.6 0 0 1 5.8 3a5.6 5.6 0 1 0 7.2 7.2z";
const QUESTION = "M6 6.2a2 2 0 1 1 2.9 1.8c-.6.3-.9.7-.9 1.4M8 11.7v.1";

interface Acts {
  about: () => void;
  theme: () => void;
  help: () => void;
}

/** `live` is what a run that is going on tells of itself, and what can be done with it. */
export function header(runs: Run[], acts: Acts, live: { chips: HTMLElement[]; acts: HTMLElement[] } | null = null): HTMLElement {
  const run = runs[0]!;
  const { scene } = run;
  const title = runs.length > 1 ? runs.map((run) => run.name).join(" | ") : run.title;
  const facts = runs.length > 1
    ? [element("span", { class: "chip" }, "two runs, one clock")]
    : [
        element("span", { class: "chip" }, scene.robot.name),
        ...(live?.chips ?? [
          element("span", { class: "chip arm" }, `${arm(scene)}, ${scene.rate_hz} Hz${step(scene)}`),
          element("span", { class: "chip rules", title: "mode rule, border, recursion" }, rules(scene)),
          ...(run.every > 1 ? [element("span", { class: "chip" }, `every ${run.every}th tick`)] : []),
          ending(scene),
        ]),
      ];
  const open = button("What am I looking at?", element("span", {}, "What am I looking at?"), acts.about, "W");
  open.classList.add("about-open");
  return element(
    "header",
    {},
    element("span", { class: "brand", "aria-hidden": "true" }, brand(), "Conik"),
    element("h1", { title }, title),
    element("div", { class: "facts" }, ...facts),
    element(
      "div",
      { class: "switches" },
      ...(live?.acts ?? []),
      open,
      button("Light or dark", icon(MOON), acts.theme, "T"),
      button("Keys and help", icon(QUESTION), acts.help, "?"),
    ),
  );
}

export function rules({ settings }: Scene): string {
  return `${settings.mode_rule} · ${settings.border} · ${settings.recursion}`;
}

function arm(scene: Scene): string {
  return scene.arm === "ideal" ? "ideal arm" : scene.arm;
}

/** How long a step of the controller took. */
function step({ result }: Scene): string {
  return result ? `, ${Number(result.step_time_us.median.toPrecision(2))} µs a step` : "";
}

/** How the run ended, and whether what must hold did. */
export function ending(scene: Scene): HTMLElement {
  const { result } = scene;
  if (!result) return chip("bad", "cut off", "The program that ran it was killed.");
  const broken = ["inside_stays", "outside_never_worse", "entered_stays"].filter(
    (name) => result.properties[name]?.holds === false,
  );
  const text = outcome(result.outcome);
  if (result.outcome.kind !== "completed") return chip("bad", text, detail(result.outcome));
  if (broken.length === 0) return chip("good", "completed, every set kept", "No sample left a high-priority set that it was in.");
  return chip("doubtful", "completed, sets left", "Between samples this border promises nothing; the report says by how much.");
}

function outcome(outcome: Outcome): string {
  return outcome.kind === "fault" ? `fault: ${outcome.name}` : outcome.kind;
}

function detail(outcome: Outcome): string {
  return outcome.kind === "fault" ? outcome.detail : "It was stopped before its end.";
}

function chip(kind: string, text: string, title: string): HTMLElement {
  return element("span", { class: `chip ending ${kind}`, title }, text);
}

function brand(): SVGSVGElement {
  const svg = icon("M3 13 8 2l5 11z");
  svg.classList.add("logo");
  return svg;
}
