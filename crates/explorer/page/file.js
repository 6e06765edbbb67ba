// An atlas file that is opened here: its slices.

import { byId, html, svg } from "./dom.js";
import { logTicks, show, showAngle, ticks } from "./numbers.js";
import { css, paint, ramp } from "./paint.js";

const MARGIN = { left: 70, right: 16, top: 12, bottom: 46 };
/** Larger files do not fit into the memory of the worker. */
const MOST = 1 << 30;
/** Nodes or cells along an axis; cells may all lie at one value. */
const count = (axis, kind) => Math.max(1, axis.values.length - (kind === "cells"));
const ANGLES = ["phi0", "phi1", "theta", "alpha", "beta", "theta0", "theta1"];

export class Files {
  #asker;
  #chart = byId("file-chart");
  #svg = byId("file-svg");
  #about;
  #plane;

  constructor(asker, { opened, failed }) {
    this.#asker = asker;
    this.opened = opened;
    this.failed = failed;
    const picker = byId("picker");
    byId("choose").addEventListener("click", () => picker.click());
    picker.addEventListener("change", () => picker.files[0] && this.open(picker.files[0]));
    let depth = 0;
    const veil = (shown) => (byId("veil").hidden = !shown);
    addEventListener("dragenter", () => veil(++depth > 0));
    addEventListener("dragleave", () => veil(--depth > 0));
    addEventListener("dragover", (event) => event.preventDefault());
    addEventListener("drop", (event) => {
      event.preventDefault();
      veil((depth = 0));
      const file = event.dataTransfer.files[0];
      if (file) this.open(file);
    });
    this.#chart.addEventListener("pointermove", (event) => this.#read(event));
    this.#chart.addEventListener("pointerleave", () => (byId("file-reading").textContent = ""));
  }

  async open(file) {
    if (file.size > MOST) {
      this.failed(
        `${file.name} has ${Math.round(file.size / 2 ** 20)} MiB; the browser opens atlases of up to 1024 MiB`,
      );
      return;
    }
    try {
      const about = await this.#asker.open(await file.arrayBuffer());
      if (about.error) {
        this.failed(`${file.name}: ${about.error.replace("(memory): ", "")}`);
        return;
      }
      if (about.axes.length < 2) throw new Error("it has a single axis, and so no slices");
      this.#about = about;
      this.#build();
      this.opened();
      this.resize();
    } catch (error) {
      this.failed(`${file.name}: ${error.message}`);
    }
  }

  #build() {
    const about = this.#about;
    byId("drop").hidden = true;
    byId("browser").hidden = false;
    byId("file-title").textContent = about.name;
    const counts = about.axes.map((axis) => count(axis, about.kind)).join(" × ");
    byId("file-note").textContent =
      `${about.title ?? about.family}; ${about.kind}, ${counts}. All bytes are checked.`;
    const names = about.axes.map((axis) => axis.name);
    const wide = [...names.keys()].filter((i) => about.axes[i].values.length > 1);
    const [across, up] = (wide.length > 1 ? wide : [...names.keys()]).slice(-2);
    const choice = (label, chosen, options) =>
      html(
        "label",
        {},
        label,
        html(
          "select",
          { "data-axis": label, onchange: () => this.#ask() },
          ...options.map((name, i) => html("option", { value: i, selected: i === chosen }, name)),
        ),
      );
    const sliders = about.axes.map((axis, i) => {
      const places = count(axis, about.kind);
      const input = html("input", {
        type: "range",
        min: 0,
        max: places - 1,
        value: places >> 1,
        "data-at": i,
        "aria-label": axis.name,
        oninput: () => this.#ask(),
      });
      return html(
        "label",
        { class: "slider", "data-slider": i },
        html("span", {}, axis.name),
        input,
        html("output", {}),
      );
    });
    const flags =
      about.kind === "cells"
        ? [
            choice(
              "flag",
              Math.max(
                0,
                about.flags.findIndex((f) => f.name === "SPIRAL"),
              ),
              about.flags.map((f) => f.name),
            ),
          ]
        : [];
    byId("file-axes").replaceChildren(
      choice("across", across, names),
      choice("up", up, names),
      ...flags,
      ...sliders,
    );
    this.#ask();
  }

  #chosen(name) {
    return Number(byId("file-axes").querySelector(`[data-axis=${name}]`)?.value ?? 0);
  }

  #ask() {
    const about = this.#about;
    const x = this.#chosen("across");
    const y = this.#chosen("up");
    const at = about.axes.map((axis, i) => {
      const label = byId("file-axes").querySelector(`[data-slider="${i}"]`);
      const input = label.querySelector("input");
      label.hidden = i === x || i === y || axis.values.length === 1;
      const place = Number(input.value);
      label.querySelector("output").textContent = this.#value(axis, place);
      return place;
    });
    if (x === y) {
      byId("file-reading").textContent = "Choose two different axes.";
      return;
    }
    this.#asker.newest("plane", { question: { ask: "plane", x, y, at } }, (answer) => {
      if (answer.error) this.failed(answer.error);
      else {
        this.#plane = { ...answer, x, y };
        this.paint();
      }
    });
  }

  #value(axis, i) {
    const between = this.#about.kind === "cells" && axis.values.length > 1;
    const value = between ? 0.5 * (axis.values[i] + axis.values[i + 1]) : axis.values[i];
    return ANGLES.includes(axis.name) ? showAngle(value, 5) : show(value, 5);
  }

  paint() {
    if (!this.#plane) return;
    const { width, height, inside, outside } = this.#plane;
    const about = this.#about;
    const rank = new Uint8Array(width * height);
    let labels;
    let fills;
    if (about.kind === "cells") {
      const bit = this.#chosen("flag");
      const label = about.flags[bit].label;
      labels = [`${label}: not known, or in a part of the cell`, `${label}: all over the cell`];
      fills = ramp(2);
      for (let i = 0; i < rank.length; i++) rank[i] = (inside[i] >> bit) & 1 ? 2 : (outside[i] >> bit) & 1 ? 0 : 1;
    } else {
      const nested = about.nested.length ? about.nested : about.flags.map((_, i) => i).slice(0, 4);
      labels = nested.map((bit) => about.flags[bit].label);
      fills = ramp(nested.length);
      for (let i = 0; i < rank.length; i++)
        rank[i] = nested.reduce((rank, bit, n) => ((inside[i] >> bit) & 1 ? n + 1 : rank), 0);
    }
    // As many pixels as the screen has there, so that edges between regions are thin and whole.
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    const [w, h] = [
      Math.max(16, Math.round((this.#chart.clientWidth - MARGIN.left - MARGIN.right) * ratio)),
      Math.max(16, Math.round((this.#chart.clientHeight - MARGIN.top - MARGIN.bottom) * ratio)),
    ];
    const shown = new Uint8Array(w * h);
    for (let y = 0, to = 0; y < h; y++) {
      const row = (height - 1 - Math.floor((y * height) / h)) * width;
      for (let x = 0; x < w; x++, to++) shown[to] = rank[row + Math.floor((x * width) / w)];
    }
    paint(byId("file-plane"), w, h, shown, fills);
    const swatch = (color) =>
      svg(
        "svg",
        { class: "swatch", viewBox: "0 0 14 14" },
        svg("rect", { width: 14, height: 14, rx: 3, fill: css(color) }),
      );
    byId("file-legend").replaceChildren(...labels.map((label, i) => html("li", {}, swatch(fills[i]), label)));
    this.#axes();
  }

  /** After the chart has another size. */
  resize() {
    this.paint();
  }

  #axes() {
    if (!this.#plane) return;
    const [W, H] = [this.#chart.clientWidth, this.#chart.clientHeight];
    const [w, h] = [W - MARGIN.left - MARGIN.right, H - MARGIN.top - MARGIN.bottom];
    if (w < 20 || h < 20) return;
    const parts = [
      svg("rect", { class: "frame", x: MARGIN.left + 0.5, y: MARGIN.top + 0.5, width: w - 1, height: h - 1 }),
    ];
    const axes = [this.#plane.x, this.#plane.y].map((i) => this.#about.axes[i]);
    axes.forEach((axis, i) => {
      const angle = ANGLES.includes(axis.name);
      const by = angle ? 180 / Math.PI : 1;
      const [lo, hi] = [axis.values[0] * by, axis.values.at(-1) * by];
      const at = (v) => (axis.log ? Math.log(v / lo) / Math.log(hi / lo) : (v - lo) / (hi - lo));
      for (const v of axis.log ? logTicks(lo, hi, 8) : ticks(lo, hi, 7)) {
        const text = show(v, 4) + (angle ? "°" : "");
        if (i === 0) {
          const x = MARGIN.left + at(v) * w;
          parts.push(
            svg("path", { class: "tick", d: `M${x} ${MARGIN.top + h}v4` }),
            svg("text", { x, y: MARGIN.top + h + 18, "text-anchor": "middle" }, text),
          );
        } else {
          const y = MARGIN.top + (1 - at(v)) * h;
          parts.push(
            svg("path", { class: "tick", d: `M${MARGIN.left} ${y}h-4` }),
            svg("text", { x: MARGIN.left - 8, y: y + 4, "text-anchor": "end" }, text),
          );
        }
      }
    });
    parts.push(
      svg("text", { class: "label", x: MARGIN.left + w / 2, y: H - 6, "text-anchor": "middle" }, axes[0].name),
    );
    parts.push(
      svg(
        "text",
        { class: "label", transform: `translate(13 ${MARGIN.top + h / 2}) rotate(-90)`, "text-anchor": "middle" },
        axes[1].name,
      ),
    );
    this.#svg.replaceChildren(...parts);
  }

  /** What is under the pointer. */
  #read(event) {
    if (!this.#plane) return;
    const { width, height, inside, outside, x, y } = this.#plane;
    const box = this.#chart.getBoundingClientRect();
    const i = Math.floor(
      ((event.clientX - box.left - MARGIN.left) / (box.width - MARGIN.left - MARGIN.right)) * width,
    );
    const j = Math.floor(
      (1 - (event.clientY - box.top - MARGIN.top) / (box.height - MARGIN.top - MARGIN.bottom)) * height,
    );
    if (i < 0 || j < 0 || i >= width || j >= height) return;
    const about = this.#about;
    const at = j * width + i;
    const holds = about.flags.filter((_, bit) => (inside[at] >> bit) & 1).map((flag) => flag.name);
    const open =
      about.kind === "cells"
        ? about.flags.filter((_, bit) => !(((inside[at] | outside[at]) >> bit) & 1)).map((flag) => flag.name)
        : [];
    const along = (axis, index) => `${axis.name} ${this.#value(axis, index)}`;
    const place = `${along(about.axes[x], i)}, ${along(about.axes[y], j)}`;
    byId("file-reading").textContent =
      `${place}: ${holds.join(", ") || "no flag"}${open.length ? `; MIXED: ${open.join(", ")}` : ""}`;
  }
}
