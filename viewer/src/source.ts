// Where the page's data comes from: out of the page itself, as in a report, or from its server.

import { PROTOCOL, type Recording } from "./protocol";

/** Id of the element that holds the data of a report: JSON, or its gzip in base64. */
const EMBEDDED = "recording";

/** Whatever goes wrong is an `Error` whose message is for people. */
export async function load(page: Document, place: Location): Promise<Recording> {
  const embedded = page.getElementById(EMBEDDED);
  const text = embedded ? await unpacked(embedded) : await fetched(place);
  return checked(text);
}

async function unpacked(element: HTMLElement): Promise<string> {
  const text = element.textContent ?? "";
  if (element.getAttribute("type") !== "application/gzip") return text;
  const bytes = Uint8Array.from(atob(text.trim()), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).text();
}

async function fetched(place: Location): Promise<string> {
  if (!place.protocol.startsWith("http")) {
    throw new Error("There is no run in this file. Look at one with: conik view DIR");
  }
  // The query may hold what lets a page in.
  const answer = await fetch(`recording.json${place.search}`).catch(() => null);
  if (!answer) throw new Error("The program that serves this page does not answer any more.");
  if (!answer.ok) throw new Error(`The run cannot be had: ${(await answer.text()).trim()}`);
  return answer.text();
}

function checked(text: string): Recording {
  let recording: Recording;
  try {
    recording = JSON.parse(text);
  } catch (error) {
    throw new Error(`The run cannot be read: ${String(error)}`);
  }
  if (recording?.kind !== "recording") throw new Error("What was found is no recording of a run.");
  if (recording.protocol !== PROTOCOL) {
    const versions = `version ${recording.protocol}, and this page reads ${PROTOCOL}`;
    throw new Error(`The recording is of ${versions}. Use the page of the program that wrote it.`);
  }
  if (!recording.runs?.length) throw new Error("There is no run in this recording.");
  return recording;
}

/** Where a run that is going on is followed, of a page at a place; `null` where there is none. */
export function liveAddress(recording: Recording, place: Location): string | null {
  if (!recording.runs[0]?.scene.live || !place.protocol.startsWith("http")) return null;
  const address = new URL(`live${place.search}`, place.href);
  address.protocol = place.protocol === "https:" ? "wss:" : "ws:";
  return address.href;
}
