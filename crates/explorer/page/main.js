// The page: its state, and who hears when that changes.

import { Asker } from "./asker.js";
import { byId, html } from "./dom.js";
import { buildNumbers, showNumbers } from "./fields.js";
import { Files } from "./file.js";
import { drawGraph } from "./graph.js";
import { allHandles } from "./handles.js";
import { listenToMenus } from "./menus.js";
import { readLength, show, UNITS } from "./numbers.js";
import { onScheme } from "./paint.js";
import { Plane } from "./plane.js";
import { Region } from "./slice.js";
import { decode, encode, extent, fresh, inUnit, KINDS, preset, PRESETS } from "./state.js";
import { joinTold, reason, verdicts } from "./verdict.js";

/** Milliseconds of rest before what costs more is asked, and before the link is written. */
const REST = 120;

let state = fresh();
let answer;
let joined;
let advice;
let resting;
let plane;
let region;
let files;
let curves;
let helper;

/** What tests look at. */
const seen = {
  times: [],
  idle: () => idle(),
  state: () => state,
  answer: () => answer,
  joined: () => joined,
  advice: () => advice,
  ask: (question) => curves.ask(question),
};
globalThis.explorer = seen;

function notice(text) {
  byId("notice").textContent = text;
  byId("notice").hidden = !text;
}

function broken(text) {
  byId("loading").hidden = false;
  byId("loading").textContent = `The explorer cannot run here: ${text}`;
}

// ---- from the state to questions, and from answers to the page

function changed(time = performance.now()) {
  seen.busy = true;
  if (answer) answer.whole = false;
  if (state.mode === "ends") {
    // The chosen curve first: it is drawn while the others are computed.
    const { ends, kind } = state;
    const began = performance.now();
    curves.newest("curves", { question: { ask: "curves", ends, kinds: [kind] } }, (found) => {
      answer = found.error ? found : { ...found, curves: { ...answer?.curves, ...found.curves } };
      advice = undefined;
      showEnds();
      seen.times.push([performance.now() - time, performance.now() - began]);
      const others = KINDS.filter((other) => other !== kind);
      if (!found.error)
        curves.newest("others", { question: { ask: "curves", ends, kinds: others } }, (rest) =>
          showOthers(rest, ends, kind),
        );
    });
  } else if (state.mode === "join") {
    const { from, to, radius, pieces, family, objective } = state.join;
    const end = ({ kind, ...rest }) => ({ [kind]: rest });
    const question = {
      ask: "join",
      from: end(from),
      to: end(to),
      greatest_curvature: 1 / radius,
      family,
      objective,
      most_pieces: pieces,
    };
    curves.newest("join", { question }, (found) => {
      joined = found;
      showJoin();
    });
  }
  showNumbers();
  clearTimeout(resting);
  resting = setTimeout(rested, REST);
}

/** When nothing has changed for a while. */
function rested() {
  history.replaceState(null, "", `#${encode(state)}`);
  if (state.mode === "ends" && answer?.curves?.[state.kind]?.spiral === false) {
    const asked = JSON.stringify([state.ends, state.kind]);
    helper.newest("advice", { question: { ask: "advice", ends: state.ends, kind: state.kind } }, (found) => {
      if (asked !== JSON.stringify([state.ends, state.kind]) || found.error) return;
      advice = found;
      showReason();
    });
  }
  seen.busy = false;
}

/** Whether all that was asked is shown. */
const idle = () => !seen.busy && (state.mode !== "ends" || !answer || answer.error || answer.whole);

/** What the other families have, unless the question has changed meanwhile. */
function showOthers(rest, ends, kind) {
  if (rest.error || answer.error || state.kind !== kind) return;
  answer.curves = { ...answer.curves, ...rest.curves };
  if (ends === state.ends) answer.whole = true;
  showEnds();
}

function showEnds() {
  if (!answer || state.mode !== "ends") return;
  if (answer.error) {
    plane.draw({ circles: [], curves: [] });
    drawGraph(byId("graph"), [], undefined, () => {});
    byId("reason").replaceChildren(html("p", { class: "head no" }, "Refused"), html("p", {}, answer.error));
    verdicts(undefined, state, choices);
    return;
  }
  if (!answer.curves[state.kind]) return;
  const shown = state.shown.filter((kind) => answer.curves[kind]?.spiral);
  const drawn = shown.map((kind) => {
    const { samples, control_points } = answer.curves[kind];
    return { kind, samples, points: samples.map((s) => [s[1], s[2]]), control: control_points };
  });
  const active = drawn.find((curve) => curve.kind === state.kind);
  const others = (!answer.curves[state.kind].spiral && answer.curves[state.kind].others) || [];
  plane.draw({
    circles: answer.circles,
    curves: drawn,
    active,
    wavers: others.map(({ samples }) => samples.map((s) => [s[1], s[2]])),
    comb: state.comb,
  });
  const wavers = others.map(({ samples }) => ({ kind: "waver", samples }));
  drawGraph(byId("graph"), [...drawn, ...wavers], active, (point) => plane.mark(point));
  verdicts(answer, state, choices);
  showReason();
  region.show(answer, state.kind);
}

function showReason() {
  if (answer?.curves?.[state.kind])
    reason(byId("reason"), answer, state, advice, (ends) => update(() => (state.ends = pick(ends))));
}

const shownAnswer = () => (state.mode === "join" ? joined : answer);

const pick = ({ start, end, start_direction, end_direction, start_curvature, end_curvature }) => ({
  start,
  end,
  start_direction,
  end_direction,
  start_curvature,
  end_curvature,
});

const choices = {
  chosen: (kind) =>
    update(() => {
      state.kind = kind;
      if (!state.shown.includes(kind)) state.shown.push(kind);
    }),
  toggled: (kind) =>
    update(
      () =>
        (state.shown = state.shown.includes(kind) ? state.shown.filter((k) => k !== kind) : [...state.shown, kind]),
    ),
};

function showJoin() {
  if (!joined || state.mode !== "join") return;
  const { path, samples } = joined;
  if (path) {
    const parts = path.pieces.map((piece, i) => ({ kind: piece.kind, points: samples[i].map((s) => [s[1], s[2]]) }));
    const all = samples.flat();
    const active = {
      kind: "join",
      samples: all,
      points: all.map((s) => [s[1], s[2]]),
      parts,
      joints: parts.slice(1).map((part) => part.points[0]),
    };
    plane.draw({ circles: joined.circles, curves: [active], active, comb: state.comb });
    drawGraph(byId("graph"), [active], active, (point) => plane.mark(point));
  } else {
    plane.draw({ circles: joined.circles ?? [], curves: [] });
    drawGraph(byId("graph"), [], undefined, () => {});
  }
  joinTold(byId("join-reason"), joined, state.unit);
}

// ---- from the user to the state

/** Changes the state as a whole, and the page with it. */
function update(change) {
  change();
  setUp();
  changed();
}

function setUp() {
  document.querySelector("main").dataset.mode = state.mode;
  document.querySelector(`[name=mode][value=${state.mode}]`).checked = true;
  byId("unit").value = state.unit;
  byId("comb").checked = state.comb;
  plane.handles(allHandles(() => state));
  byId("join-family").value = state.join.family;
  byId("join-objective").value = state.join.objective;
  buildNumbers({ state: () => state, update, notice });
}

function fit() {
  plane.fit(extent(state, shownAnswer()));
  if (state.mode === "join") showJoin();
  else showEnds();
  plane.place();
}

// ---- listening

function listen() {
  for (const input of document.querySelectorAll("[name=mode]")) {
    input.addEventListener("change", () => {
      notice("");
      update(() => (state.mode = input.value));
      if (state.mode !== "file") waitAndFit();
      else files.resize();
    });
  }
  byId("unit").append(...Object.keys(UNITS).map((unit) => html("option", {}, unit)));
  byId("unit").addEventListener("change", (event) => {
    const factor = UNITS[state.unit] / UNITS[event.target.value];
    update(() => (state = inUnit(state, event.target.value)));
    plane.view = { x: plane.view.x * factor, y: plane.view.y * factor, scale: plane.view.scale / factor };
    plane.draw();
  });
  byId("comb").addEventListener("change", (event) => update(() => (state.comb = event.target.checked)));
  byId("fit").addEventListener("click", fit);
  byId("reset").addEventListener("click", () => {
    const { mode } = state;
    notice("");
    update(() => (state = { ...fresh(), mode }));
    if (mode !== "file") waitAndFit();
  });
  listenToMenus(() => ({
    state,
    answer: shownAnswer(),
    notice,
    ask: seen.ask,
    copied: (text) => (seen.copied = text),
  }));
  addEventListener("keydown", (event) => {
    if (event.key === "f" && !event.ctrlKey && !event.metaKey && !event.target.closest("input, select")) fit();
  });
  byId("presets").append(
    ...Object.keys(PRESETS).map((name) =>
      html(
        "button",
        {
          onclick: () => (
            update(
              () => (state.join = { ...preset(name), family: state.join.family, objective: state.join.objective }),
            ),
            waitAndFit()
          ),
        },
        name,
      ),
    ),
  );
  byId("join-family").addEventListener("change", (event) => update(() => (state.join.family = event.target.value)));
  byId("join-objective").addEventListener("change", (event) =>
    update(() => (state.join.objective = event.target.value)),
  );
  byId("join-pieces").addEventListener("change", (event) => {
    const value = Number(event.target.value);
    if (Number.isInteger(value) && value >= 1 && value <= 11) update(() => (state.join.pieces = value));
    else notice("The pieces at most are a whole number from 1 to 11.");
  });
  byId("join-radius").addEventListener("change", (event) => {
    try {
      const value = readLength(event.target.value, state.unit);
      if (!(value > 0)) throw new Error("it must be above 0");
      notice("");
      update(() => (state.join.radius = value));
    } catch (error) {
      notice(`Least radius: ${error.message}.`);
    }
  });
  addEventListener("hashchange", () => {
    open(location.hash);
    waitAndFit();
  });
  new ResizeObserver(() => {
    if (state.mode === "file") files.resize();
    else if (state.mode === "join") showJoin();
    else showEnds();
  }).observe(byId("plane"));
  onScheme(() => {
    region.paint();
    files.paint();
  });
}

/** Fits the view once the answer is there. */
async function waitAndFit() {
  const before = shownAnswer();
  for (let i = 0; i < 100 && (!shownAnswer() || shownAnswer() === before); i++)
    await new Promise((resolve) => setTimeout(resolve, 10));
  if (state.mode !== "file") fit();
}

/** Takes over the state of a link. */
function open(hash) {
  const { state: read, wrong } = decode(hash);
  const parts = [...new Set(wrong)].slice(0, 5).join(", ");
  notice(
    wrong.length
      ? `The link has parts that cannot be read: ${parts}. They are as in a fresh page.`
      : "",
  );
  update(() => (state = read));
}

async function start() {
  listenSoon();
  const response = await fetch(new URL("core.wasm", import.meta.url));
  if (!response.ok) throw new Error(`core.wasm: ${response.status} ${response.statusText}`);
  const module = await WebAssembly.compile(await response.arrayBuffer());
  // One worker answers while one dragging waits; the other one has time for regions and advice.
  curves = new Asker(module, broken);
  helper = new Asker(module, broken);
  await Promise.all([curves.ready, helper.ready]);
  plane = new Plane(byId("plane"), { changed, released: rested });
  region = new Region(
    helper,
    ([start, end], time) => {
      state.ends = { ...state.ends, start_curvature: start, end_curvature: end };
      plane.place();
      changed(time);
    },
    rested,
  );
  files = new Files(helper, {
    opened: () => {
      notice("");
      update(() => (state.mode = "file"));
    },
    failed: notice,
  });
  listen();
  plane.fit(extent(state, shownAnswer()));
  open(location.hash);
  await waitAndFit();
  byId("loading").hidden = true;
  seen.region = region;
  document.documentElement.dataset.ready = "yes";
}

/** A module error before the start would leave “Loading…” there for ever. */
function listenSoon() {
  addEventListener("unhandledrejection", (event) => broken(event.reason?.message ?? String(event.reason)));
}

start().catch((error) => broken(error.message));
