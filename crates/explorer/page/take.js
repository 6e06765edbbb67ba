// What is taken away: text for other programs, and files.

import { tellAngle } from "./numbers.js";

/** The present question for a command line. */
export function command(s) {
  if (s.mode === "join") {
    const { from, to, radius, pieces, family, objective } = s.join;
    const end = (name, end) => {
      if (end.kind === "circle") return `--${name}-circle=${[...end.centre, end.radius, end.turn].join(",")}`;
      const state = [...end.point, tellAngle(end.direction), ...(end.kind === "state" ? [end.curvature] : [])].join(
        ",",
      );
      return `--${name}${end.kind === "line" ? "-line" : ""}=${state}`;
    };
    return [
      "spiral-atlas join",
      end("from", from),
      end("to", to),
      `--greatest-curvature ${1 / radius}`,
      `--family ${family} --objective ${objective} --most-pieces ${pieces}`,
    ].join(" ");
  }
  const e = s.ends;
  return [
    `spiral-atlas curve ${s.kind}`,
    `--from=${e.start.join(",")} --to=${e.end.join(",")}`,
    `--start-direction=${tellAngle(e.start_direction)} --end-direction=${tellAngle(e.end_direction)}`,
    `--start-curvature=${e.start_curvature} --end-curvature=${e.end_curvature}`,
  ].join(" ");
}

function states({ from, to }, program) {
  if (from.kind !== "state" || to.kind !== "state")
    throw new Error(`In ${program} joins lead from state to state; the command line has lines and circles, too.`);
  return [from, to].map((end) => [...end.point, end.direction, end.curvature].join(", "));
}

export function python(s) {
  if (s.mode === "join") {
    const [from, to] = states(s.join, "Python");
    const { radius, pieces, family, objective } = s.join;
    return [
      "import spiral_atlas",
      "",
      `join = spiral_atlas.join([${from}], [${to}], ${1 / radius},`,
      `                         family="${family}", objective="${objective}", most_pieces=${pieces})`,
      "print(join.curve.pieces if join else join.reason)",
    ].join("\n");
  }
  const e = s.ends;
  return [
    "import spiral_atlas",
    "",
    `fit = spiral_atlas.fit((${e.start.join(", ")}), (${e.end.join(", ")}), ${e.start_direction}, ${e.end_direction},`,
    `                       ${e.start_curvature}, ${e.end_curvature}, family="${s.kind}")`,
    "print(fit)",
  ].join("\n");
}

export function cpp(s) {
  if (s.mode === "join") {
    const [from, to] = states(s.join, "C++");
    const { radius, pieces, family, objective } = s.join;
    return [
      "#include <cmath>",
      "#include <spiral_atlas.hpp>",
      "",
      `const auto curve = spiral_atlas::join({${from}}, {${to}}, ${1 / radius},`,
      `                                      "${family}", "${objective}", INFINITY, ${pieces});`,
    ].join("\n");
  }
  const e = s.ends;
  const [from, to] = ["start", "end"].map((end) =>
    [...e[end], e[`${end}_direction`], e[`${end}_curvature`]].join(", "),
  );
  return `#include <spiral_atlas.hpp>\n\nconst auto curve = spiral_atlas::fit({${from}}, {${to}}, "${s.kind}");`;
}

/** The pieces of what is shown, as all programs of this project read them; none where there is no curve. */
export function pieces(s, answer) {
  if (s.mode === "join") return answer?.path?.pieces;
  const piece = answer?.curves?.[s.kind]?.piece;
  return piece && [piece];
}

export function json(s, answer) {
  const found = pieces(s, answer);
  const path =
    s.mode === "join"
      ? answer?.path
      : found && {
          length: found[0].length,
          greatest_curvature: answer.curves[s.kind].greatest_curvature,
          pieces: found,
        };
  const reason = s.mode === "join" ? answer?.reason : answer?.curves?.[s.kind]?.reason;
  const asked = s.mode === "join" ? s.join : s.ends;
  return JSON.stringify({ asked, ...(path ? { paths: [path] } : { paths: [], reason }) }, null, 2);
}

/** Attributes that a drawing needs to look the same outside of the page. */
const LOOK = [
  "fill",
  "stroke",
  "stroke-width",
  "stroke-dasharray",
  "stroke-linecap",
  "stroke-linejoin",
  "stroke-opacity",
  "fill-opacity",
  "opacity",
  "font-family",
  "font-size",
  "font-weight",
  "visibility",
  "display",
];

/** A drawing as the text of an SVG file of its own; without the handles. */
export function drawing(element) {
  const copy = element.cloneNode(true);
  const all = [element, ...element.querySelectorAll("*")];
  [copy, ...copy.querySelectorAll("*")].forEach((node, i) => {
    const style = getComputedStyle(all[i]);
    for (const name of LOOK) {
      const value = style.getPropertyValue(name);
      if (value) node.setAttribute(name, value);
    }
    for (const name of ["class", "tabindex", "role", "data-handle"]) node.removeAttribute(name);
    for (const name of node.getAttributeNames()) if (name.startsWith("aria-")) node.removeAttribute(name);
  });
  const handles = [...element.children].findIndex((child) => child.classList.contains("handles"));
  if (handles >= 0) copy.children[handles].remove();
  const [w, h] = [element.clientWidth, element.clientHeight];
  copy.removeAttribute("id");
  copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
  copy.setAttribute("viewBox", `0 0 ${w} ${h}`);
  copy.setAttribute("width", w);
  copy.setAttribute("height", h);
  const paper = document.createElementNS("http://www.w3.org/2000/svg", "rect");
  for (const [name, value] of Object.entries({
    width: w,
    height: h,
    fill: getComputedStyle(element).backgroundColor,
  }))
    paper.setAttribute(name, value);
  copy.prepend(paper);
  return new XMLSerializer().serializeToString(copy);
}

/** An SVG file as a PNG file of twice the size. */
export async function png(text) {
  const url = URL.createObjectURL(new Blob([text], { type: "image/svg+xml" }));
  try {
    const image = new Image();
    image.src = url;
    await image.decode();
    const canvas = document.createElement("canvas");
    canvas.width = 2 * image.width;
    canvas.height = 2 * image.height;
    canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
    return await new Promise((resolve) => canvas.toBlob(resolve, "image/png"));
  } finally {
    URL.revokeObjectURL(url);
  }
}

/** Hands a file to the browser. */
export function save(name, blob) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}
