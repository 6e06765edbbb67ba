// What is said of the curves: verdicts, reasons, ways out.

import { byId, html, svg } from "./dom.js";
import { show, showAngle } from "./numbers.js";
import { KINDS, NAMES } from "./state.js";

const HEADS = {
  "equal-curvatures": "Both ends have the same curvature",
  "wrong-side": "The curvature changes the wrong way for these directions",
  "circles-cross": "The end circles cross or touch",
  "not-convex": "Both directions lie on one side of the chord",
  "turns-too-far": "The directions turn too far",
  straight: "One end is straight, and this family bends at both",
  inflection: "The curve would need an inflection",
  "no-root": "No curve of this family has these ends",
  "not-monotone": "A curve has these ends, but its curvature is not monotone",
  "no-ph-quintic": "No curve of this family has these ends",
  "no-ph-spiral": "A curve has these ends, but its curvature is not monotone",
};

/** The table of the three families. `chosen` and `toggled` get a kind. */
export function verdicts(answer, state, { chosen, toggled }) {
  const table = byId("verdicts");
  if (!table.rows.length) {
    for (const kind of KINDS) {
      table.append(
        html(
          "tr",
          { "data-kind": kind },
          html(
            "td",
            {},
            html(
              "label",
              {},
              html("input", { type: "radio", name: "kind", value: kind, onchange: () => chosen(kind) }),
              swatch(kind),
              NAMES[kind],
            ),
          ),
          html("td", { class: "word" }),
          html("td", { class: "length" }),
          html(
            "td",
            {},
            html("input", {
              type: "checkbox",
              "aria-label": `draw the ${NAMES[kind]}`,
              title: "draw it",
              onchange: () => toggled(kind),
            }),
          ),
        ),
      );
    }
  }
  const unit = byId("unit").value;
  for (const row of table.rows) {
    const { kind } = row.dataset;
    const curve = answer?.curves[kind];
    row.classList.toggle("active", kind === state.kind);
    row.querySelector("[type=radio]").checked = kind === state.kind;
    row.querySelector("[type=checkbox]").checked = state.shown.includes(kind);
    const word = row.querySelector(".word");
    word.textContent = !curve ? "" : curve.spiral ? "spiral" : curve.error ? "refused" : "none";
    word.dataset.spiral = curve ? String(curve.spiral) : "";
    row.querySelector(".length").textContent = curve?.spiral ? `${show(curve.length, 7)} ${unit}` : "";
  }
}

/** The line of a kind of curve. */
export function swatch(kind) {
  return svg("svg", { class: `swatch stroke ${kind}`, viewBox: "0 0 22 8" }, svg("path", { d: "M1 4H21" }));
}

/** Why the chosen curve is as it is. `take` gets ends that would do. */
export function reason(element, answer, state, advice, take) {
  const curve = answer.curves[state.kind];
  const unit = byId("unit").value;
  if (curve.error) {
    element.replaceChildren(html("p", { class: "head no" }, "Refused"), html("p", {}, curve.error));
    return;
  }
  if (curve.spiral) {
    const radius =
      curve.greatest_curvature > 0 ? `, least radius ${show(1 / curve.greatest_curvature, 5)} ${unit}` : "";
    element.replaceChildren(
      html("p", { class: "head yes" }, `${NAMES[state.kind]} spiral, proved`),
      html("p", {}, `The curvature is monotone from end to end${radius}.`),
      html("p", { class: "small" }, normalised(answer, curve)),
    );
    return;
  }
  const why = advice?.why ?? curve.why ?? {};
  const head = HEADS[why.cause ?? why.condition] ?? "No such curve";
  const parts = [html("p", { class: "head no" }, head)];
  if (why.needs?.length === 2)
    parts.push(html("p", {}, why.alone ? "One of these alone would do:" : "Both are needed:"));
  const list = [...needs(why), ...remedies(advice?.why, answer, unit, take)];
  if (list.length) parts.push(html("ul", { class: "needs" }, ...list));
  const told = measure(why);
  if (told) parts.push(html("p", {}, told));
  if (advice?.nearby) {
    parts.push(
      html(
        "button",
        { class: "take", id: "nearby", onclick: () => take(advice.nearby) },
        html("b", {}, "Nearest found"),
        html("span", {}, changes(answer.ends, advice.nearby, unit)),
      ),
    );
  }
  const open = element.querySelector("details")?.open;
  parts.push(
    html(
      "details",
      { open },
      html("summary", {}, "In full"),
      html("p", { class: "small" }, `${advice?.reason || curve.reason}.`),
    ),
  );
  element.replaceChildren(...parts);
}

/** A join in words, and its pieces. */
export function joinTold(element, joined, unit) {
  const { path, samples } = joined;
  if (!path) {
    const head = joined.error ? "Refused" : "No join found";
    element.replaceChildren(
      html("p", { class: "head no" }, head),
      html("p", {}, joined.error ?? `${joined.reason}.`),
    );
    return;
  }
  const count = path.pieces.length;
  const rate = Math.max(...path.rate_range.map(Math.abs));
  const rows = path.pieces.map((piece, i) => {
    const [first, last] = [samples[i][0][4], samples[i].at(-1)[4]].map((k) => show(k, 4));
    const bend =
      piece.kind === "line" ? "straight" : piece.kind === "arc" ? `${first}/${unit}` : `${first} → ${last}/${unit}`;
    const name =
      { line: "line", arc: "arc" }[piece.kind] ??
      `${NAMES[piece.kind].replace(/^[A-Z][a-z]/, (a) => a.toLowerCase())} spiral`;
    return html(
      "tr",
      {},
      html("td", {}, swatch(piece.kind), name),
      html("td", {}, `${show(piece.length, 5)} ${unit}`),
      html("td", {}, bend),
    );
  });
  element.replaceChildren(
    html(
      "p",
      { class: "head yes" },
      `${count === 1 ? "One piece" : `${count} pieces`}, ${show(path.length, 6)} ${unit}`,
    ),
    html("p", {}, `Least radius ${show(1 / path.greatest_curvature, 5)} ${unit}. Each spiral is proved.`),
    html(
      "p",
      { class: "small" },
      `Greatest |dκ/ds| ${show(rate, 4)}/${unit}², bending energy ${show(path.bending_energy, 4)}/${unit}.`,
    ),
    html("table", { class: "pieces" }, ...rows),
  );
}

/** The normalised numbers, beside the user's. */
function normalised(answer, { facts }) {
  const { phi0, phi1, kappa0, kappa1 } = answer.datum;
  const margin = facts.margin === undefined ? "" : `, margin ${show(facts.margin, 3)}`;
  const angles = `φ₀ ${showAngle(phi0, 4)}, φ₁ ${showAngle(phi1, 4)}`;
  return `${angles}, κ₀ ${show(kappa0, 4)}, κ₁ ${show(kappa1, 4)} in half chords${margin}`;
}

/** What the curvatures must pass, and by how much they miss it. */
function needs(why) {
  const unit = byId("unit").value;
  return (why.needs ?? []).map((need) => {
    const bound = need.above ?? need.below;
    const sign = need.above !== undefined ? ">" : "<";
    const off = Math.abs(bound - need.curvature);
    return html(
      "li",
      {},
      `${need.which} curvature ${sign} ${show(bound, 5)}/${unit}, off by ${show(off, 2)}/${unit}`,
    );
  });
}

/** Other curvatures that would do, each a button. */
function remedies(why, answer, unit, take) {
  return (why?.remedies ?? []).map((remedy) => {
    const ends = { ...answer.ends, [`${remedy.which}_curvature`]: remedy.instead };
    return html(
      "li",
      {},
      html(
        "button",
        { class: "plain", onclick: () => take(ends) },
        `${remedy.which} curvature ${show(remedy.instead, 5)}/${unit}`,
      ),
      ` would do, off by ${show(Math.abs(remedy.instead - remedy.curvature), 2)}/${unit}`,
    );
  });
}

/** By how much a condition fails that has no needs. */
function measure(why) {
  const both = () => `${showAngle(why.start_angle, 4)} and ${showAngle(why.end_angle, 4)}`;
  if (why.cause === "wrong-side") {
    const sum = why.start_angle + why.end_angle;
    const word = why.rising ? "above 0, because the curvature rises" : "below 0, because the curvature falls";
    return `Against the chord the directions are ${both()}. Their sum must be ${word}; it is ${showAngle(sum, 4)}.`;
  }
  if (why.condition === "not-convex")
    return `Against the chord they are ${both()}; one must be to each side.`;
  if (why.condition === "turns-too-far") {
    const off = showAngle(why.turning - Math.PI, 3);
    return `They turn by ${showAngle(why.turning, 5)}, which must be below 180°: off by ${off}.`;
  }
  if (why.condition === "not-monotone")
    return `Margin ${show(Math.max(...why.roots.map((root) => root.margin)), 3)}; a spiral has one above 0.`;
  if (why.condition === "no-ph-spiral")
    return `Margin ${show(Math.max(...why.margins), 3)}; a spiral has one above 0.`;
  if (why.condition === "no-root")
    return `The discriminant is ${show(why.discriminant, 3)}, and k is ${show(why.k, 3)}.`;
  return "";
}

/** What differs between two ends, in words. */
function changes(before, after, unit) {
  const parts = [];
  for (const end of ["start", "end"]) {
    const [k, d] = [`${end}_curvature`, `${end}_direction`];
    if (before[k] !== after[k]) parts.push(`${end} curvature ${show(before[k], 5)} → ${show(after[k], 5)}/${unit}`);
    if (before[d] !== after[d]) parts.push(`${end} direction ${showAngle(before[d], 5)} → ${showAngle(after[d], 5)}`);
  }
  return parts.join(", ");
}
