// Curvature against length.

import { byId, pathOf, sizeOf, svg } from "./dom.js";
import { show, ticks } from "./numbers.js";

const LEFT = 64;
const RIGHT = 16;
const TOP = 14;
const BOTTOM = 26;

/** Draws curves { kind, samples }; `marked` gets which sample of the active one the pointer is at. */
export function drawGraph(element, curves, active, marked) {
  const [w, h] = sizeOf(element).map((size, i) => size || [600, 140][i]);
  const unit = byId("unit").value;
  const all = curves.map((c) => c.samples.filter((s) => Number.isFinite(s[4]) && s[4] !== null));
  const longest = Math.max(...all.map((s) => s.at(-1)?.[0] ?? 0), 0);
  if (!(longest > 0)) {
    element.replaceChildren(
      svg("text", { class: "empty", x: w / 2, y: h / 2, "text-anchor": "middle" }, "no curve, no curvature"),
    );
    element.onpointermove = element.onpointerleave = null;
    return;
  }
  // What is no spiral may bend without bounds between its ends; as much of it is shown as shows that.
  const seen = (curve, samples) => {
    const ends = [samples.at(0), samples.at(-1)].map((s) => Math.abs(s?.[4] ?? 0));
    const most = curve.kind === "waver" ? 3 * Math.max(...ends) : Infinity;
    return samples.map((s) => Math.max(-most, Math.min(most, s[4])));
  };
  const values = curves.flatMap((curve, i) => seen(curve, all[i]));
  let [low, high] = [Math.min(0, ...values), Math.max(0, ...values)];
  const room = 0.06 * (high - low || 1);
  [low, high] = [low - (low < 0 ? room : 0), high + (high > 0 ? room : 0)];
  const x = (s) => LEFT + (s / longest) * (w - LEFT - RIGHT);
  const y = (k) => h - BOTTOM - ((k - low) / (high - low)) * (h - TOP - BOTTOM);
  const parts = [];
  for (const k of ticks(low, high, 5)) {
    parts.push(svg("path", { class: k === 0 ? "zero" : "line", d: `M${LEFT} ${y(k)}H${w - RIGHT}` }));
    parts.push(svg("text", { x: LEFT - 8, y: y(k) + 4, "text-anchor": "end" }, show(k, 4)));
  }
  for (const s of ticks(0, longest, 6))
    parts.push(svg("text", { x: x(s), y: h - 9, "text-anchor": "middle" }, show(s, 4)));
  const place = (s) => [x(s[0]), Math.max(-h, Math.min(2 * h, y(s[4])))];
  curves.forEach((curve, i) => {
    if (curve !== active)
      parts.push(
        svg("path", {
          class: curve.kind === "waver" ? "waver" : `curve other ${curve.kind}`,
          d: pathOf(all[i].map(place)),
        }),
      );
  });
  if (active)
    parts.push(
      svg("path", {
        class: `curve ${active.kind}`,
        d: pathOf(active.samples.filter((s) => Number.isFinite(s[4]) && s[4] !== null).map(place)),
      }),
    );
  parts.push(svg("text", { class: "label", x: LEFT + 6, y: TOP + 2 }, `κ in 1/${unit}, against length in ${unit}`));
  const reading = svg("text", { class: "label reading", x: w - RIGHT, y: TOP + 2, "text-anchor": "end" });
  const dot = svg("circle", { class: "dot", r: 4, visibility: "hidden" });
  element.replaceChildren(...parts, dot, reading);
  element.onpointermove = (event) => {
    if (!active) return;
    const s = ((event.clientX - element.getBoundingClientRect().left - LEFT) / (w - LEFT - RIGHT)) * longest;
    const nearest = active.samples.reduce((best, sample) =>
      Math.abs(sample[0] - s) < Math.abs(best[0] - s) ? sample : best,
    );
    dot.setAttribute("visibility", "visible");
    dot.setAttribute("cx", x(nearest[0]));
    dot.setAttribute("cy", y(nearest[4]));
    reading.textContent = `s = ${show(nearest[0], 5)} ${unit}, κ = ${show(nearest[4], 5)}/${unit}`;
    marked([nearest[1], nearest[2]]);
  };
  element.onpointerleave = () => {
    dot.setAttribute("visibility", "hidden");
    reading.textContent = "";
    marked(undefined);
  };
}
