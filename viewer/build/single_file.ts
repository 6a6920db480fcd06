// Puts style and script into the page, and into its head what it may load: itself and its data.
import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import type { Plugin } from "vite";

/** What the page has in it of others, whose licence goes with it. */
const THREE_LICENCE = new URL("../node_modules/three/LICENSE", import.meta.url);

/** Where the policy goes in index.html. */
const POLICY = "<!-- policy -->";

export function singleFile(): Plugin {
  return {
    name: "single-file",
    enforce: "post",
    generateBundle(_options, bundle) {
      const page = bundle["index.html"];
      if (page?.type !== "asset") throw new Error("there is no index.html");
      let html = String(page.source);
      let script = "";
      for (const [name, part] of Object.entries(bundle)) {
        if (part === page) continue;
        if (part.type === "chunk") {
          // In HTML a script ends at this, wherever it stands in it.
          script = part.code.trim().replaceAll("</script", "<\\/script");
          // A function, because `$` means something in a text.
          html = replaced(html, scriptTag(name), () => "");
        } else if (name.endsWith(".css")) {
          const style = String(part.source).trim();
          html = replaced(html, styleTag(name), () => `<style>${style}</style>`);
        } else {
          throw new Error(`the page is one file, and ${name} is another`);
        }
        delete bundle[name];
      }
      html = replaced(html, POLICY, () => policy(script));
      const last = `${notice()}\n<script type="module">${script}</script>\n</body>`;
      page.source = replaced(html, "</body>", () => last);
    },
  };
}

function notice(): string {
  return `<!-- The script has three.js in it:\n\n${readFileSync(THREE_LICENCE, "utf8").trim()}\n-->`;
}

function scriptTag(name: string): RegExp {
  return new RegExp(`\\s*<script[^>]*src="\\./${escaped(name)}"[^>]*></script>`);
}

function styleTag(name: string): RegExp {
  return new RegExp(`<link[^>]*href="\\./${escaped(name)}"[^>]*>`);
}

function escaped(text: string): string {
  return text.replaceAll(/[.*+?^${}()|[\]\\]/g, "\\$&");
}

function replaced(text: string, what: string | RegExp, by: () => string): string {
  const after = text.replace(what, by);
  if (after === text) throw new Error(`index.html has no ${String(what)}`);
  return after;
}

/** Scripts are this one only, named by its digest; everything else comes from the page's own server. */
function policy(script: string): string {
  const digest = createHash("sha256").update(script).digest("base64");
  const rules = [
    "default-src 'none'",
    `script-src 'sha256-${digest}'`,
    "style-src 'unsafe-inline'",
    "img-src data: blob:",
    "connect-src 'self'",
    "base-uri 'none'",
    "form-action 'none'",
  ];
  return `<meta http-equiv="Content-Security-Policy" content="${rules.join("; ")}">`;
}
