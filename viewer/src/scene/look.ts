// The colours of a theme that the scene needs.

import { style } from "../element";

export interface Look {
  background: string;
  ink: string;
  soft: string;
  accent: string;
  glass: string;
  grid: string;
  limb: string;
  housing: string;
  ring: string;
  shadow: number;
}

/** What the style sheet says now. */
export function look(): Look {
  return {
    background: style("--stage"),
    ink: style("--ink"),
    soft: style("--soft"),
    accent: style("--accent"),
    glass: style("--glass"),
    grid: style("--stage-grid"),
    limb: style("--limb"),
    housing: style("--housing"),
    ring: style("--ring"),
    shadow: Number(style("--shadow")) || 0.2,
  };
}
