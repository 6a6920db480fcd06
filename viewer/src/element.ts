// Elements of the page. What a run says goes in as text only, never as HTML.

type Child = Node | string;

/** An element with attributes and children. */
export function element<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Record<string, string> = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

/** A button that says what it does to those who cannot see its picture. */
export function button(label: string, content: Child, act: () => void, key?: string): HTMLButtonElement {
  const made = element("button", { type: "button", "aria-label": label, title: key ? `${label} (${key})` : label }, content);
  made.addEventListener("click", act);
  return made;
}

/** A picture of 16 by 16, drawn in the colour of the text. */
export function icon(path: string): SVGSVGElement {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  svg.setAttribute("viewBox", "0 0 16 16");
  svg.setAttribute("class", "icon");
  svg.setAttribute("aria-hidden", "true");
  const shape = document.createElementNS("http://www.w3.org/2000/svg", "path");
  shape.setAttribute("d", path);
  svg.append(shape);
  return svg;
}

/** Sets the text of an element that has nothing else, where it differs; the same node keeps it, which is cheap. */
export function say(node: HTMLElement, text: string): void {
  const { firstChild } = node;
  if (!(firstChild instanceof Text)) node.textContent = text;
  else if (firstChild.data !== text) firstChild.data = text;
}

/** Sets an attribute only where it differs. */
export function mark(node: Element, name: string, value: string): void {
  if (node.getAttribute(name) !== value) node.setAttribute(name, value);
}

/** Values of the style that were asked for, by theme and name. */
const styles = new Map<string, string>();

/** The value of a colour or length of the style, `--ink` for instance, which only the theme changes. */
export function style(name: string): string {
  const page = document.documentElement;
  const key = `${page.dataset["theme"]} ${name}`;
  // Whoever asks the page has all styles computed that have changed since the last frame.
  const value = styles.get(key) ?? getComputedStyle(page).getPropertyValue(name).trim();
  styles.set(key, value);
  return value;
}
