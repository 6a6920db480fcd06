// Colours: those of Okabe and Ito, which people with any kind of colour vision tell apart, in the order
// of the figures and the report (crates/conik-cli/src/figure/palette.rs), so that a mode has one colour.

const OKABE_ITO = ["#D55E00", "#0072B2", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"];
const FURTHER = "#8a8a8a";

/** Colour of the nth mode with an active set, counted from 0. */
export function modeColour(nth: number): string {
  return OKABE_ITO[nth] ?? FURTHER;
}

/** Axes x, y and z of a frame. */
export const AXES = ["#D55E00", "#009E73", "#0072B2"] as const;
