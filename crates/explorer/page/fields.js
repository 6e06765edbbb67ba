// The numbers of both ends, typed with units.

import { byId, html } from "./dom.js";
import { readAngle, readCurvature, readLength, readRadius, show, showAngle } from "./numbers.js";

let page;
let fields = [];

function field(label, get, read, set, format) {
  const input = html("input", {
    inputmode: "decimal",
    autocomplete: "off",
    spellcheck: "false",
    "aria-label": label,
  });
  const entry = { input, get, format };
  const take = () => {
    if (input.value === entry.shown) return;
    try {
      const value = read(input.value);
      if (Math.abs(value) > 1e15) throw new Error("that is more than 1e15");
      input.setCustomValidity("");
      page.notice("");
      page.update(() => set(value));
    } catch (error) {
      input.setCustomValidity(error.message);
      page.notice(`${label}: ${error.message}`);
      input.setAttribute("aria-invalid", "true");
    }
  };
  input.addEventListener("change", take);
  input.addEventListener("focus", () => input.select());
  fields.push(entry);
  return input;
}

/** Builds the table for the state; `page` has state(), update(change) and notice(text). */
export function buildNumbers(the) {
  page = the;
  const state = page.state();
  const held = document.activeElement?.getAttribute?.("aria-label");
  fields = [];
  const unit = state.unit;
  const length = (text) => readLength(text, page.state().unit);
  const curvature = (text) => readCurvature(text, page.state().unit);
  const radius = (text) => readRadius(text, page.state().unit);
  const columns =
    state.mode === "ends"
      ? ["start", "end"].map((name) => ({
          name,
          get: (part) => page.state().ends[part === "point" ? name : `${name}_${part}`],
          set: (part, value) =>
            (page.state().ends = { ...page.state().ends, [part === "point" ? name : `${name}_${part}`]: value }),
          parts: ["point", "direction", "curvature"],
        }))
      : ["from", "to"].map((which) => ({
          name: which === "from" ? "start" : "end",
          get: (part) => page.state().join[which][part],
          set: (part, value) => {
            const { join } = page.state();
            page.state().join = { ...join, [which]: { ...join[which], [part]: value } };
          },
          parts: {
            state: ["point", "direction", "curvature"],
            line: ["point", "direction"],
            circle: ["centre", "radius", "turn"],
          }[state.join[which].kind],
        }));
  const rows = [
    [
      "x",
      (c, part) =>
        field(
          `${c.name} x`,
          () => c.get(part)[0],
          length,
          (v) => c.set(part, [v, c.get(part)[1]]),
          (v) => show(v, 8),
        ),
      ["point", "centre"],
      unit,
    ],
    [
      "y",
      (c, part) =>
        field(
          `${c.name} y`,
          () => c.get(part)[1],
          length,
          (v) => c.set(part, [c.get(part)[0], v]),
          (v) => show(v, 8),
        ),
      ["point", "centre"],
      unit,
    ],
    [
      "direction",
      (c, part) =>
        field(
          `${c.name} direction`,
          () => c.get(part),
          readAngle,
          (v) => c.set(part, v),
          (v) => showAngle(v, 6),
        ),
      ["direction"],
      "",
    ],
    [
      "curvature",
      (c, part) =>
        field(
          `${c.name} curvature`,
          () => c.get(part),
          curvature,
          (v) => c.set(part, v),
          (v) => show(v, 6),
        ),
      ["curvature"],
      `1/${unit}`,
    ],
    [
      "radius",
      (c, part) =>
        field(
          `${c.name} radius`,
          () => 1 / c.get(part),
          radius,
          (v) => c.set(part, v),
          (v) => show(Math.abs(v) === Infinity ? Infinity : v, 6),
        ),
      ["curvature"],
      unit,
    ],
    [
      "radius",
      (c, part) =>
        field(
          `${c.name} radius`,
          () => c.get(part),
          (text) => {
            const value = length(text);
            if (!(value > 0)) throw new Error("a radius must be above 0");
            return value;
          },
          (v) => c.set(part, v),
          (v) => show(v, 6),
        ),
      ["radius"],
      unit,
    ],
    [
      "turns",
      (c, part) =>
        html(
          "select",
          { "aria-label": `${c.name} turn`, onchange: (event) => page.update(() => c.set(part, event.target.value)) },
          ...["left", "right"].map((turn) => html("option", { value: turn, selected: c.get(part) === turn }, turn)),
        ),
      ["turn"],
      "",
    ],
  ];
  const body = [];
  for (const [label, make, parts, suffix] of rows) {
    const cells = columns.map((c) => {
      const part = c.parts.find((p) => parts.includes(p));
      return html("td", {}, part && make(c, part));
    });
    if (cells.some((cell) => cell.firstChild))
      body.push(
        html("tr", {}, html("th", { scope: "row" }, label, suffix && html("small", {}, ` ${suffix}`)), ...cells),
      );
  }
  const head = html(
    "tr",
    {},
    html("th", {}),
    ...["start", "end"].map((name) => html("th", { scope: "col", class: name }, name)),
  );
  byId("numbers").replaceChildren(html("thead", {}, head), html("tbody", {}, ...body));
  showNumbers();
  if (held) byId("numbers").querySelector(`[aria-label="${held}"]`)?.focus();
}

/** Shows the numbers of the state, but for one that is being typed. */
export function showNumbers() {
  const state = page.state();
  for (const entry of fields) {
    const text = entry.format(entry.get());
    if (entry.input === document.activeElement && entry.shown === text) continue;
    entry.shown = text;
    entry.input.value = text;
    entry.input.removeAttribute("aria-invalid");
  }
  if (document.activeElement !== byId("join-radius"))
    byId("join-radius").value = `${show(state.join.radius, 7)} ${state.unit}`;
  byId("join-pieces").value = state.join.pieces;
}
