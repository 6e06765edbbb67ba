// What the page shows, as one plain object; a link has all of it.

import { UNITS } from "./numbers.js";

export const KINDS = ["cubic", "ph-quintic", "involute"];
export const NAMES = {
  cubic: "Cubic",
  "ph-quintic": "PH quintic",
  involute: "Involute",
  "trig-quintic": "Trigonometric",
};
export const FAMILIES = [...KINDS, "trig-quintic"];
export const OBJECTIVES = ["length", "greatest-curvature", "greatest-rate", "bending-energy"];
const MODES = ["ends", "join", "file"];
const END_KINDS = ["state", "line", "circle"];
/** Beyond this, numbers are no data but mistakes. */
const GREATEST = 1e15;

const rad = (degrees) => (degrees / 180) * Math.PI;
const state = (x, y, degrees, curvature) => ({ kind: "state", point: [x, y], direction: rad(degrees), curvature });
const line = (x, y, degrees) => ({ kind: "line", point: [x, y], direction: rad(degrees) });
const circle = (x, y, radius, turn) => ({ kind: "circle", centre: [x, y], radius, turn });

/** Joins to begin with. */
export const PRESETS = {
  "Two states": { from: state(0, 0, 0, 0), to: state(180, 150, 100, 0), radius: 60, pieces: 11 },
  "Line to circle": { from: line(0, 0, 0), to: circle(160, 66, 60, "left"), radius: 60, pieces: 1 },
  S: { from: circle(0, 0, 30, "left"), to: circle(110, 20, 40, "right"), radius: 30, pieces: 3 },
  C: { from: circle(0, 0, 30, "left"), to: circle(110, 20, 40, "left"), radius: 30, pieces: 3 },
  U: { from: line(0, 0, 0), to: line(60, 180, 165), radius: 60, pieces: 3 },
};

function preset(name) {
  const { from, to, radius, pieces } = structuredClone(PRESETS[name]);
  return { from, to, radius, pieces, family: "cubic", objective: "length" };
}

/** The state after the page is opened. */
export function fresh() {
  return {
    mode: "ends",
    unit: "m",
    ends: {
      start: [0, 0],
      end: [200, 0],
      start_direction: rad(-40),
      end_direction: rad(80),
      start_curvature: 0.004,
      end_curvature: 0.04,
    },
    kind: "cubic",
    shown: [...KINDS],
    comb: true,
    join: preset("Two states"),
  };
}

export { preset };

/** The part of a link after #. */
export function encode(s) {
  const e = s.ends;
  const end = (end) =>
    end.kind === "circle"
      ? ["circle", ...end.centre, end.radius, end.turn]
      : ["state", "line"].includes(end.kind) && [
          end.kind,
          ...end.point,
          end.direction,
          ...(end.kind === "state" ? [end.curvature] : []),
        ];
  const parts = {
    mode: s.mode,
    unit: s.unit,
    start: [...e.start, e.start_direction, e.start_curvature],
    end: [...e.end, e.end_direction, e.end_curvature],
    kind: s.kind,
    shown: s.shown,
    comb: s.comb ? 1 : 0,
    from: end(s.join.from),
    to: end(s.join.to),
    radius: s.join.radius,
    pieces: s.join.pieces,
    family: s.join.family,
    objective: s.join.objective,
  };
  return Object.entries(parts)
    .map(([name, value]) => `${name}=${[value].flat().join(",")}`)
    .join("&");
}

/** The state of a link, and what of it could not be read; that is as in a fresh page. */
export function decode(hash) {
  const s = fresh();
  const wrong = [];
  for (const part of hash.replace(/^#/, "").slice(0, 4000).split("&").filter(Boolean)) {
    const at = part.indexOf("=");
    const name = at < 0 ? part : part.slice(0, at);
    let values;
    try {
      values = decodeURIComponent(part.slice(at + 1)).split(",");
    } catch {
      values = [];
    }
    const read = Object.hasOwn(READERS, name) && READERS[name];
    try {
      if (!read) throw new Error();
      read(s, values);
    } catch {
      wrong.push(name.slice(0, 20));
    }
  }
  return { state: s, wrong };
}

function number(text, positive = false) {
  if (!/^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(text)) throw new Error();
  const value = Number(text);
  if (Math.abs(value) > GREATEST || (positive && !(value > 0))) throw new Error();
  return value;
}

function one(list, [value]) {
  if (!list.includes(value)) throw new Error();
  return value;
}

function exactly(values, count) {
  if (values.length !== count) throw new Error();
  return values.map((text) => number(text));
}

function joinEnd([kind, ...rest]) {
  one(END_KINDS, [kind]);
  if (kind === "circle") {
    const turn = one(["left", "right"], [rest[3]]);
    return circle(number(rest[0]), number(rest[1]), number(rest[2], true), turn);
  }
  const [x, y, direction, curvature] = exactly(rest, kind === "state" ? 4 : 3);
  return kind === "state" ? { kind, point: [x, y], direction, curvature } : { kind, point: [x, y], direction };
}

const READERS = {
  mode: (s, v) => (s.mode = one(MODES, v)),
  unit: (s, v) => (s.unit = one(Object.keys(UNITS), v)),
  kind: (s, v) => (s.kind = one(KINDS, v)),
  shown: (s, v) => (s.shown = v.filter(Boolean).map((kind) => one(KINDS, [kind]))),
  comb: (s, v) => (s.comb = one(["0", "1"], v) === "1"),
  start: (s, v) => {
    const [x, y, direction, curvature] = exactly(v, 4);
    Object.assign(s.ends, { start: [x, y], start_direction: direction, start_curvature: curvature });
  },
  end: (s, v) => {
    const [x, y, direction, curvature] = exactly(v, 4);
    Object.assign(s.ends, { end: [x, y], end_direction: direction, end_curvature: curvature });
  },
  from: (s, v) => (s.join.from = joinEnd(v)),
  to: (s, v) => (s.join.to = joinEnd(v)),
  radius: (s, v) => (s.join.radius = number(v[0], true)),
  pieces: (s, v) => {
    const value = number(v[0], true);
    if (!Number.isInteger(value) || value > 11) throw new Error();
    s.join.pieces = value;
  },
  family: (s, v) => (s.join.family = one(FAMILIES, v)),
  objective: (s, v) => (s.join.objective = one(OBJECTIVES, v)),
};

/** The same things in another unit of length. */
export function inUnit(s, unit) {
  const factor = UNITS[s.unit] / UNITS[unit];
  // Twelve digits: what was a round number stays one.
  const by = (x, power) => Number((x * factor ** power).toPrecision(12));
  const length = (x) => by(x, 1);
  const end = (end) =>
    end.kind === "circle"
      ? { ...end, centre: end.centre.map(length), radius: length(end.radius) }
      : { ...end, point: end.point.map(length), ...(end.kind === "state" && { curvature: by(end.curvature, -1) }) };
  const e = s.ends;
  return {
    ...s,
    unit,
    ends: {
      ...e,
      start: e.start.map(length),
      end: e.end.map(length),
      start_curvature: by(e.start_curvature, -1),
      end_curvature: by(e.end_curvature, -1),
    },
    join: { ...s.join, from: end(s.join.from), to: end(s.join.to), radius: length(s.join.radius) },
  };
}

/** The points that should be seen: the ends, and the curves of an answer. */
export function extent(s, answer) {
  const points = (samples) => (samples ?? []).map((sample) => [sample[1], sample[2]]);
  if (s.mode !== "join") {
    return [s.ends.start, s.ends.end, ...s.shown.flatMap((kind) => points(answer?.curves?.[kind]?.samples))];
  }
  const around = ({ centre: [x, y], radius }) =>
    [-1, 1].flatMap((d) => [
      [x + d * radius, y],
      [x, y + d * radius],
    ]);
  const of = (end) => (end.kind === "circle" ? around(end) : [end.point]);
  return [...of(s.join.from), ...of(s.join.to), ...points(answer?.samples?.flat())];
}
