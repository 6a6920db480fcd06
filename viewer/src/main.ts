// Where the page begins.

import { App } from "./app";
import { element } from "./element";
import { liveAddress, load } from "./source";
import { apply } from "./theme";
import "./style/colours.css";
import "./style/frame.css";
import "./style/side.css";
import "./style/foot.css";
import "./style/live.css";
import "./style/edit.css";
import "./style/over.css";
import "./style/sizes.css";

apply();
const root = document.getElementById("page")!;
root.replaceChildren(element("p", { class: "message", role: "status" }, "Loading the run …"));
load(document, location)
  .then((recording) => new App(recording, root, liveAddress(recording, location)).start())
  .catch((error: unknown) => {
    const text = error instanceof Error ? error.message : String(error);
    root.replaceChildren(element("p", { class: "message", role: "alert" }, text));
  });
