// The region at the present angles: computed by the worker, finer and finer, with a cursor at the present datum.

import { byId, html, onMove, sizeOf, svg } from "./dom.js";
import { logTicks, show, ticks } from "./numbers.js";
import { colours, css, paint, ramp } from "./paint.js";

const MARGIN = { left: 58, right: 10, top: 8, bottom: 40 };
const FAMILY = { cubic: "cubic", "ph-quintic": "ph-quintic", involute: "any-spiral" };
/** Most pixels along a side, whatever the screen. */
const MOST = 800;

export class Region {
  #chart = byId("chart");
  #canvas = byId("slice");
  #svg = byId("slice-axes");
  #asker;
  #wanted = "";
  #shown;
  #held = false;
  took;

  /** `moved` gets new curvatures of both ends; `released` is called when the drag has ended. */
  constructor(asker, moved, released) {
    this.#asker = asker;
    this.moved = moved;
    this.#chart.addEventListener("pointerdown", (event) => {
      if (event.button > 0 || !this.#inside(event)) return;
      this.#chart.setPointerCapture(event.pointerId);
      this.#held = true;
      this.#drag(event);
    });
    onMove(this.#chart, (event) => this.#held && this.#drag(event));
    for (const name of ["pointerup", "pointercancel"]) {
      this.#chart.addEventListener(name, () => {
        if (this.#held) released();
        this.#held = false;
      });
    }
    this.#svg.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
      if (!step || !this.#shown || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      const size = event.shiftKey ? 0.05 : 0.005;
      const [x, y] = this.#place();
      this.#move([x + step[0] * size, y + step[1] * size], event.timeStamp);
      released();
    });
  }

  /** Shows the region of a kind at the angles of an answer. `steady` keeps the ranges while the cursor moves. */
  show(answer, kind) {
    this.answer = answer;
    this.kind = kind;
    const { phi0, phi1, kappa0, kappa1 } = answer.datum;
    const [W, H] = sizeOf(this.#chart);
    const [w, h] = [W - MARGIN.left - MARGIN.right, H - MARGIN.top - MARGIN.bottom];
    if (w < 20 || h < 20) return;
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    const [width, height] = [w, h].map((n) => Math.max(16, Math.min(MOST, Math.round(n * ratio))));
    // κ1 is on a logarithmic axis.
    const at = [kappa0, Math.max(kappa1, 1e-3)];
    const same = [kind, phi0, phi1, width, height, answer.turn, answer.placement.reversed].join();
    const [x, y] = this.#shown?.ranges ?? [];
    const seen = x && at[0] >= x[0] && at[0] <= x[1] && at[1] >= y[0] && at[1] <= y[1];
    if (same === this.#wanted && (seen || this.#held)) {
      this.#axes();
      return;
    }
    this.#wanted = same;
    const slice = { family: FAMILY[kind], phi0, phi1, at, width, height };
    this.#asker.slice(slice, (answer) => {
      // Where a family has no region at all at such angles, that of all spirals is shown.
      if (answer.error)
        this.#asker.slice({ ...slice, family: "any-spiral" }, (other) => this.#told(other, answer.error));
      else this.#told(answer);
    });
  }

  #told(answer, instead) {
    if (answer.error) {
      byId("slice-note").textContent = answer.error;
      return;
    }
    this.#shown = { ...answer, instead };
    if (answer.drawn) this.took = answer.took;
    this.paint();
  }

  /** Paints what is known. */
  paint() {
    if (!this.#shown) return;
    const { width, height, pixels, nested, flags, family, open, drawn, proved, instead } = this.#shown;
    const solvable = flags.findIndex((flag) => flag.name === "SOLVABLE");
    const ranks = new Uint8Array(256).map((_, code) =>
      nested.reduce((rank, bit, i) => ((code >> bit) & 1 ? i + 1 : rank), 0),
    );
    // What no precision decided has a colour of its own.
    ranks[open] = nested.length + 1;
    const rank = new Uint8Array(width * height);
    const within = solvable >= 0 && new Uint8Array(width * height);
    for (let x = 0, from = 0; x < width; x++) {
      for (let y = height - 1; y >= 0; y--, from++) {
        const at = y * width + x;
        rank[at] = ranks[pixels[from]];
        if (within) within[at] = pixels[from] !== open && (pixels[from] >> solvable) & 1;
      }
    }
    const colors = ramp(nested.length);
    paint(this.#canvas, width, height, rank, [...colors, colours().line], within);
    const share = Math.round((1000 * proved) / (width * height)) / 10;
    byId("slice-note").textContent = drawn
      ? `${width} × ${height}, ${share} % in proved boxes`
      : "refining…";
    byId("slice-title").textContent = {
      cubic: "Cubic spirals",
      "ph-quintic": "PH quintic spirals",
      "any-spiral": "Spirals of any kind",
    }[family];
    const swatch = (color) =>
      svg(
        "svg",
        { class: "swatch", viewBox: "0 0 14 14" },
        svg("rect", { width: 14, height: 14, rx: 3, fill: css(color) }),
      );
    const entries = nested.map((bit, i) =>
      html("li", { title: flags[bit].doc }, swatch(colors[i]), flags[bit].label),
    );
    if (within) {
      const red = svg(
        "svg",
        { class: "swatch", viewBox: "0 0 14 14" },
        svg("path", { d: "M1 2H13M2 12l4-9M7 12l4-9", stroke: css(colours().line), "stroke-width": 2 }),
      );
      entries.push(html("li", { title: flags[solvable].doc }, red, flags[solvable].label));
    }
    if (pixels.includes(open)) entries.push(html("li", {}, swatch(colours().line), "not decided"));
    if (instead)
      entries.push(
        html("li", { class: "small", title: instead }, "no curve of the chosen family has such directions"),
      );
    byId("legend").replaceChildren(...entries);
    this.#axes();
  }

  /** Where the present datum is in the chart, from 0 to 1. */
  #place() {
    const { kappa0, kappa1 } = this.answer.datum;
    const [[x0, x1], [y0, y1]] = this.#shown.ranges;
    return [(kappa0 - x0) / (x1 - x0), Math.log(Math.max(kappa1, 1e-300) / y0) / Math.log(y1 / y0)];
  }

  #axes() {
    if (!this.#shown) return;
    const { unit, turn, placement } = this.answer;
    const [W, H] = sizeOf(this.#chart);
    const [w, h] = [W - MARGIN.left - MARGIN.right, H - MARGIN.top - MARGIN.bottom];
    if (w < 20 || h < 20) return;
    const [[x0, x1], [y0, y1]] = this.#shown.ranges.map((range) => range.map((k) => k / unit));
    const sign = turn === "right" ? -1 : 1;
    const [first, second] = placement.reversed ? ["end", "start"] : ["start", "end"];
    const parts = [
      svg("rect", { class: "frame", x: MARGIN.left + 0.5, y: MARGIN.top + 0.5, width: w - 1, height: h - 1 }),
    ];
    for (const k of ticks(x0, x1, w < 260 ? 3 : 5)) {
      const x = MARGIN.left + ((k - x0) / (x1 - x0)) * w;
      parts.push(svg("path", { class: "tick", d: `M${x} ${MARGIN.top + h}v4` }));
      parts.push(svg("text", { x, y: MARGIN.top + h + 16, "text-anchor": "middle" }, show(sign * k, 4)));
    }
    for (const k of logTicks(y0, y1, 6)) {
      const y = MARGIN.top + h - (Math.log(k / y0) / Math.log(y1 / y0)) * h;
      parts.push(svg("path", { class: "tick", d: `M${MARGIN.left} ${y}h-4` }));
      parts.push(svg("text", { x: MARGIN.left - 7, y: y + 4, "text-anchor": "end" }, show(sign * k, 3)));
    }
    const name = byId("unit").value;
    parts.push(
      svg(
        "text",
        { class: "label", x: MARGIN.left + w / 2, y: H - 6, "text-anchor": "middle" },
        `${first} curvature, 1/${name}`,
      ),
    );
    parts.push(
      svg(
        "text",
        { class: "label", transform: `translate(11 ${MARGIN.top + h / 2}) rotate(-90)`, "text-anchor": "middle" },
        `${second} curvature, 1/${name}`,
      ),
    );
    const [x, y] = this.#place();
    const { start_curvature: start, end_curvature: end } = this.answer.ends;
    const clamp = (v) => Math.max(0, Math.min(1, v));
    const cursor = svg(
      "g",
      {
        class: "cursor",
        tabindex: 0,
        role: "slider",
        "aria-label": "the present curvatures in the region",
        "aria-valuetext": `start ${show(start)}, end ${show(end)}`,
        "data-handle": "slice",
        transform: `translate(${MARGIN.left + clamp(x) * w} ${MARGIN.top + (1 - clamp(y)) * h})`,
      },
      svg("circle", { class: "reach", r: 18 }),
      svg("path", { class: "under", d: "M-10 0H-4M4 0H10M0 -10V-4M0 4V10" }),
      svg("circle", { class: "under", r: 5 }),
      svg("path", { d: "M-10 0H-4M4 0H10M0 -10V-4M0 4V10" }),
      svg("circle", { r: 5 }),
    );
    const focused = this.#svg.contains(document.activeElement);
    this.#svg.replaceChildren(...parts, cursor);
    if (focused) cursor.focus({ preventScroll: true });
  }

  #inside(event) {
    const box = this.#chart.getBoundingClientRect();
    const [x, y] = [event.clientX - box.left, event.clientY - box.top];
    return this.#shown && x >= MARGIN.left - 4 && y <= box.height - MARGIN.bottom + 4;
  }

  #drag(event) {
    const box = this.#chart.getBoundingClientRect();
    const [w, h] = [box.width - MARGIN.left - MARGIN.right, box.height - MARGIN.top - MARGIN.bottom];
    this.#move(
      [(event.clientX - box.left - MARGIN.left) / w, 1 - (event.clientY - box.top - MARGIN.top) / h],
      event.timeStamp,
    );
  }

  #move([x, y], time) {
    const clamp = (v) => Math.max(0, Math.min(1, v));
    const [[x0, x1], [y0, y1]] = this.#shown.ranges;
    const tidy = (k) => Number(k.toPrecision(6));
    const { unit, turn, placement } = this.answer;
    const sign = turn === "right" ? -1 : 1;
    // The order of both curvatures stays: beyond it the angles would change their places.
    const high = y0 * (y1 / y0) ** clamp(y);
    const low = Math.min(x0 + (x1 - x0) * clamp(x), high * 0.999999);
    const both = [low, high].map((k) => tidy((sign * k) / unit));
    this.moved(placement.reversed ? both.reverse() : both, time);
  }
}
