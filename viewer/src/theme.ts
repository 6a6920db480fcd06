// Light or dark: as the system says, until somebody says otherwise.

import { store, stored } from "./memory";

type Theme = "light" | "dark";

const KEY = "conik-theme";
const dark = window.matchMedia("(prefers-color-scheme: dark)");

/** What was chosen on this page, which may have no memory. */
let picked: Theme | null = null;

function theme(): Theme {
  const chosen = picked ?? stored(KEY);
  return chosen === "light" || chosen === "dark" ? chosen : dark.matches ? "dark" : "light";
}

/** Puts the page into the colours of the theme that is in force. */
export function apply(): void {
  document.documentElement.dataset["theme"] = theme();
}

/** Goes with the system; `changed` is called whenever the colours are others. */
export function follow(changed: () => void): void {
  dark.addEventListener("change", () => {
    apply();
    changed();
  });
}

/** Changes to the other theme. */
export function toggle(): void {
  picked = theme() === "dark" ? "light" : "dark";
  store(KEY, picked);
  apply();
}
