// The menus: what is copied, and what is saved.

import { byId } from "./dom.js";
import { encode } from "./state.js";
import { command, cpp, drawing, json, pieces, png, python, save } from "./take.js";

const COPIES = { link: (state) => location.href.split("#")[0] + "#" + encode(state), command, python, cpp, json };

/** Copies one of them. */
async function copy(what, { state, answer, notice, copied }) {
  try {
    if (state.mode === "file") throw new Error("a file is open; choose “Two ends” or “Joins” first");
    const text = COPIES[what](state, answer);
    copied(text);
    try {
      await navigator.clipboard.writeText(text);
      notice(`Copied: ${text.length > 160 ? `${text.slice(0, 160)}…` : text}`);
    } catch {
      // Without the right to write there, the text is shown to be copied by hand.
      notice(text);
    }
  } catch (error) {
    notice(error.message);
  }
}

/** Saves one of them. */
async function take(what, { state, answer, notice, ask }) {
  try {
    const sheet = state.mode === "file" ? byId("file-svg") : byId("plane");
    if (what === "svg") save("spiral.svg", new Blob([drawing(sheet)], { type: "image/svg+xml" }));
    if (what === "png") save("spiral.png", await png(drawing(sheet)));
    if (what === "slice") {
      const canvas = byId(state.mode === "file" ? "file-plane" : "slice");
      canvas.toBlob((blob) => blob && save("region.png", blob), "image/png");
    }
    if (what === "json") save("spiral.json", new Blob([json(state, answer)], { type: "application/json" }));
    if (what === "xodr") {
      const found = pieces(state, answer);
      if (!found) throw new Error("There is no curve to make a road of.");
      if (state.unit !== "m") throw new Error("Roads are in metres: choose the unit m.");
      const road = await ask({ ask: "road", pieces: found });
      if (road.error) throw new Error(road.error);
      if (road.off > 0)
        notice(`A PH quintic is fitted by cubics there, no further away than ${road.off.toPrecision(2)} m.`);
      save("road.xodr", new Blob([road.text], { type: "application/xml" }));
    }
  } catch (error) {
    notice(error.message);
  }
}

/** Listens to both menus; `now` gives { state, answer, notice, ask, copied }. */
export function listenToMenus(now) {
  for (const [id, act] of [
    ["copy", copy],
    ["save", take],
  ]) {
    byId(id).addEventListener("click", (event) => {
      const what = event.target.dataset?.[id];
      if (!what) return;
      byId(id).open = false;
      act(what, now());
    });
  }
  const close = (but) =>
    document.querySelectorAll("details.menu[open]").forEach((menu) => menu.contains(but) || (menu.open = false));
  addEventListener("pointerdown", (event) => close(event.target));
  addEventListener("keydown", (event) => event.key === "Escape" && close(null));
}
