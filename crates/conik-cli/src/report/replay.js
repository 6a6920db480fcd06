// Shows the replay in place of the report while the address names a moment, `#t=12.3`: so that it can be
// linked to, and the browser's Back leads back to the report.
(() => {
  const views = document.getElementById("views");
  const [player, recording] = ["player", "recording"].map((id) => document.getElementById(id));
  if (!views || !player || !recording || typeof DecompressionStream === "undefined") return;
  const [toReport, toReplay] = views.querySelectorAll("a");
  const report = document.querySelector("main");
  const title = document.title;
  let frame = null;
  // Where the report was read, and up to when the run was replayed.
  let scrolled = 0, last = toReplay.hash;

  const isMoment = (hash) => /^#t=-?\d+(\.\d+)?$/.test(hash);
  const moment = () => isMoment(location.hash);

  async function unpacked(element) {
    const bytes = Uint8Array.from(atob(element.textContent), (letter) => letter.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
    return new Response(stream).text();
  }

  async function open() {
    scrolled = scrollY;
    const made = document.createElement("iframe");
    made.id = "replay";
    made.title = "Replay of the run in 3-D";
    made.addEventListener("load", () => made.contentWindow.focus());
    frame = made;
    report.hidden = true;
    views.after(made);
    document.body.classList.add("replaying");
    const page = await unpacked(player);
    // The page reads the run out of itself. A function, because `$` means something in a text.
    made.srcdoc = page.replace("<body>", () => `<body>${recording.outerHTML}`);
  }

  function close() {
    frame.remove();
    frame = null;
    report.hidden = false;
    document.body.classList.remove("replaying");
    document.title = title;
    scrollTo(0, scrolled);
  }

  function show() {
    if (moment() && !frame) open();
    if (!moment() && frame) close();
    toReplay.href = last;
    for (const link of [toReport, toReplay]) link.removeAttribute("aria-current");
    (frame ? toReplay : toReport).setAttribute("aria-current", "page");
  }

  // The page in the frame writes the moment into the address whenever it rests.
  toReport.addEventListener("click", () => { last = moment() ? location.hash : last; });
  toReplay.addEventListener("click", (event) => { if (frame) event.preventDefault(); });
  addEventListener("hashchange", ({ newURL }) => {
    // The page in the frame may have written its moment where somebody has just gone back to.
    if (moment() && !isMoment(new URL(newURL).hash)) history.replaceState(null, "", newURL);
    show();
  });
  for (const element of document.querySelectorAll("[data-t]")) {
    const link = document.createElement("a");
    link.href = `#t=${Number(element.dataset.t)}`;
    link.title = "Replay from here";
    link.append(...element.childNodes);
    element.append(link);
  }
  views.hidden = false;
  show();
})();
