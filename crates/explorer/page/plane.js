// The drawing: curves, polygons, circles and combs in the plane, and the handles that are dragged.

import { byId, onMove, pathOf, sizeOf, svg } from "./dom.js";

/** Pixels beyond which a drawn number would only slow the browser down. */
const FAR = 2e4;
/** Pixels from the border that handles keep when everything is shown. */
const EDGE = 16;
/** Length of the longest tooth of a comb, in pixels. */
const TOOTH = 64;

/** The drawing of the plane, with its own view of it. */
export class Plane {
  #svg;
  #layers = {};
  #handles = new Map();
  #pointers = new Map();
  #scene = { circles: [], curves: [] };
  view = { x: 0, y: 0, scale: 1 };

  constructor(element, { changed, released }) {
    this.#svg = element;
    this.changed = changed;
    this.released = released;
    for (const name of ["grid", "circles", "comb", "polygon", "curves", "marker", "handles"]) {
      this.#layers[name] = svg("g", { class: name });
      element.append(this.#layers[name]);
    }
    element.addEventListener("wheel", (event) => this.#wheel(event), { passive: false });
    element.addEventListener("pointerdown", (event) => this.#down(event));
    element.addEventListener("pointermove", (event) => this.#pan(event));
    for (const name of ["pointerup", "pointercancel"])
      element.addEventListener(name, (event) => this.#pointers.delete(event.pointerId));
  }

  get size() {
    const [w, h] = sizeOf(this.#svg);
    return [w || 600, h || 400];
  }

  toScreen([x, y]) {
    const [w, h] = this.size;
    return [w / 2 + (x - this.view.x) * this.view.scale, h / 2 - (y - this.view.y) * this.view.scale];
  }

  toWorld([x, y]) {
    const [w, h] = this.size;
    return [this.view.x + (x - w / 2) / this.view.scale, this.view.y - (y - h / 2) / this.view.scale];
  }

  /** Shows all of these points. */
  fit(points) {
    sizeOf(this.#svg, true);
    const [w, h] = this.size;
    const [xs, ys] = [0, 1].map((i) => points.map((p) => p[i]).filter(Number.isFinite));
    const [left, right, low, high] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
    const extent = Math.max(right - left, high - low, 1e-12);
    const scale = Math.min(
      (w - 150) / Math.max(right - left, 0.02 * extent),
      (h - 130) / Math.max(high - low, 0.02 * extent),
    );
    this.view = { x: (left + right) / 2, y: (low + high) / 2, scale: Math.max(scale, 1e-300) };
    // Handles have a length of pixels, so that their places follow from the scale: a few rounds bring them in.
    for (let round = 0; round < 4; round++) {
      const places = [...this.#handles.values()].map(({ handle }) => handle.at(this));
      const beyond = [0, 1].map((i) => {
        const size = this.size[i];
        const over = (values) => Math.max(0, ...values.filter(Number.isFinite));
        return [over(places.map((p) => EDGE - p[i])), over(places.map((p) => p[i] + EDGE - size))];
      });
      const worst = Math.max(...beyond.map(([before, after], i) => (before + after) / this.size[i]));
      if (!(worst > 0)) return;
      this.view.x += (beyond[0][1] - beyond[0][0]) / 2 / this.view.scale;
      this.view.y -= (beyond[1][1] - beyond[1][0]) / 2 / this.view.scale;
      this.view.scale *= Math.max(0.5, 1 - worst);
    }
  }

  draw(scene = this.#scene) {
    this.#scene = scene;
    const { circles, curves, active, wavers, comb, marker } = scene;
    this.#grid();
    this.#layers.circles.replaceChildren(...circles.map((circle) => this.#circle(circle)).filter(Boolean));
    const path = (points, attributes) => svg("path", { d: pathOf(points.map((p) => this.#near(p))), ...attributes });
    const drawn = [];
    for (const points of wavers ?? []) drawn.push(path(points, { class: "waver" }));
    for (const curve of curves)
      if (curve !== active) drawn.push(path(curve.points, { class: `curve other ${curve.kind}` }));
    if (active) {
      drawn.push(path(active.points, { class: "casing" }));
      for (const part of active.parts ?? [active]) drawn.push(path(part.points, { class: `curve ${part.kind}` }));
      for (const joint of active.joints ?? []) {
        const [x, y] = this.toScreen(joint);
        drawn.push(svg("circle", { class: "joint", cx: x, cy: y, r: 3.5 }));
      }
    }
    this.#layers.curves.replaceChildren(...drawn);
    const polygon = active?.control?.map((p) => this.#near(p));
    this.#layers.polygon.replaceChildren(
      ...(polygon
        ? [
            svg("path", { d: pathOf(polygon) }),
            ...polygon.slice(1, -1).map(([x, y]) => svg("rect", { x: x - 3, y: y - 3, width: 6, height: 6 })),
          ]
        : []),
    );
    this.#layers.comb.replaceChildren(...(comb && active ? this.#comb(active.samples) : []));
    this.mark(marker);
    this.place();
  }

  /** A dot on the curve. */
  mark(point) {
    const [x, y] = point ? this.toScreen(point) : [];
    this.#layers.marker.replaceChildren(...(point ? [svg("circle", { cx: x, cy: y, r: 5 })] : []));
  }

  /** Takes over the handles: { id, label, at(plane), value(), move(world, plane), nudge(x, y, plane), shape }. */
  handles(list) {
    const known = new Set(list.map((handle) => handle.id));
    for (const [id, { element }] of this.#handles) {
      if (!known.has(id)) {
        element.remove();
        this.#handles.delete(id);
      }
    }
    for (const handle of list) {
      const there = this.#handles.get(handle.id);
      if (there) there.handle = handle;
      else this.#add(handle);
    }
    this.place();
  }

  /** Puts the handles where they belong. */
  place() {
    for (const { element, arm, handle } of this.#handles.values()) {
      const [x, y] = handle.at(this);
      element.setAttribute("transform", `translate(${x.toFixed(2)} ${y.toFixed(2)})`);
      element.setAttribute("aria-valuetext", handle.value());
      if (arm) {
        const [x0, y0] = this.toScreen(handle.from());
        arm.setAttribute("d", `M${(x0 - x).toFixed(2)} ${(y0 - y).toFixed(2)}L0 0`);
      }
      if (handle.angle)
        element.lastChild.setAttribute("transform", `rotate(${((-handle.angle() * 180) / Math.PI).toFixed(2)})`);
    }
  }

  #add(handle) {
    const arm = handle.from && svg("path", { class: "arm" });
    const shapes = {
      point: () => svg("circle", { class: "knob", r: 7 }),
      arrow: () => svg("path", { class: "knob", d: "M11 0L-6 -7L-2.500 0L-6 7Z" }),
      bend: () => svg("path", { class: "knob", d: "M0 -7L7 0L0 7L-7 0Z" }),
    };
    const element = svg(
      "g",
      {
        class: `handle ${handle.shape} ${handle.which}`,
        tabindex: 0,
        role: "slider",
        "aria-label": handle.label,
        "data-handle": handle.id,
      },
      svg("title", {}, handle.label),
      arm,
      svg("circle", { class: "reach", r: 20 }),
      shapes[handle.shape](),
    );
    const entry = { element, arm, handle };
    element.addEventListener("pointerdown", (event) => {
      if (event.button > 0) return;
      event.stopPropagation();
      event.preventDefault();
      element.focus({ preventScroll: true });
      element.setPointerCapture(event.pointerId);
      element.classList.add("held");
      const [x, y] = entry.handle.at(this);
      entry.offset = [event.clientX - x, event.clientY - y];
    });
    onMove(element, (event) => {
      if (!entry.offset) return;
      const [x, y] = entry.offset;
      entry.handle.move(this.toWorld([event.clientX - x, event.clientY - y]), this);
      this.place();
      this.changed(event.timeStamp);
    });
    for (const name of ["pointerup", "pointercancel", "lostpointercapture"]) {
      element.addEventListener(name, () => {
        if (!entry.offset) return;
        entry.offset = undefined;
        element.classList.remove("held");
        this.released();
      });
    }
    element.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
      if (!step || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      const size = event.shiftKey ? 10 : 1;
      entry.handle.nudge(step[0] * size, step[1] * size, this);
      this.place();
      this.changed(event.timeStamp);
      this.released();
    });
    this.#handles.set(handle.id, entry);
    this.#layers.handles.append(element);
  }

  #local(event) {
    const box = this.#svg.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  #near(point) {
    const [x, y] = this.toScreen(point);
    return [Math.max(-FAR, Math.min(FAR, x)), Math.max(-FAR, Math.min(FAR, y))];
  }

  #circle(end) {
    if (end.circle) {
      const { centre, radius } = end.circle;
      const [x, y] = this.toScreen(centre);
      const r = radius * this.view.scale;
      if (r < 40 * FAR) return r > 0.2 ? svg("circle", { cx: x, cy: y, r }) : undefined;
      return undefined;
    }
    const { point, direction } = end.line;
    const [x, y] = this.toScreen(point);
    const [dx, dy] = [FAR * Math.cos(direction), -FAR * Math.sin(direction)];
    return svg("path", {
      d: pathOf([
        [x - dx, y - dy],
        [x + dx, y + dy],
      ]),
    });
  }

  #comb(samples) {
    const greatest = Math.max(...samples.map((s) => Math.abs(s[4])));
    if (!(greatest > 0) || !Number.isFinite(greatest)) return [];
    // A tooth stands on the outer side, as long as the curvature is great.
    const tip = ([, x, y, heading, k]) => {
      const [sx, sy] = this.#near([x, y]);
      const length = (TOOTH * k) / greatest;
      return [sx + length * Math.sin(heading), sy + length * Math.cos(heading)];
    };
    const good = samples.filter((s) => s.every((x) => x !== null && Number.isFinite(x)));
    const thin = Math.max(1, Math.ceil(good.length / 80));
    const teeth = good.filter((_, i) => i % thin === 0).map((s) => pathOf([this.#near([s[1], s[2]]), tip(s)]));
    return [
      svg("path", { class: "teeth", d: teeth.join("") }),
      svg("path", { class: "edge", d: pathOf(good.map(tip)) }),
    ];
  }

  #grid() {
    const [w, h] = this.size;
    const [left, top] = this.toWorld([0, 0]);
    const [right, bottom] = this.toWorld([w, h]);
    const rough = 90 / this.view.scale;
    const power = 10 ** Math.floor(Math.log10(rough));
    const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= rough);
    let lines = "";
    for (let i = Math.ceil(left / step); i * step <= right && lines.length < 9000; i++)
      lines += `M${this.toScreen([i * step, 0])[0].toFixed(1)} 0V${h}`;
    for (let i = Math.ceil(bottom / step); i * step <= top && lines.length < 9000; i++)
      lines += `M0 ${this.toScreen([0, i * step])[1].toFixed(1)}H${w}`;
    const unit = byId("unit").value;
    const length = step * this.view.scale;
    this.#layers.grid.replaceChildren(
      svg("path", { d: lines }),
      svg("path", { class: "scale", d: `M${w - 20 - length} ${h - 18}v5h${length}v-5` }),
      svg(
        "text",
        { x: w - 20 - length / 2, y: h - 20, "text-anchor": "middle" },
        `${Number(step.toPrecision(6))} ${unit}`,
      ),
    );
  }

  #wheel(event) {
    event.preventDefault();
    const factor = Math.exp(-Math.max(-200, Math.min(200, event.deltaY)) * 0.0015);
    this.#zoom(this.#local(event), factor);
  }

  #zoom(at, factor) {
    const before = this.toWorld(at);
    this.view.scale *= factor;
    const after = this.toWorld(at);
    this.view.x += before[0] - after[0];
    this.view.y += before[1] - after[1];
    this.draw();
  }

  #down(event) {
    if (event.button > 0) return;
    this.#pointers.set(event.pointerId, this.#local(event));
    this.#svg.setPointerCapture(event.pointerId);
  }

  /** One pointer moves the plane, two stretch it. */
  #pan(event) {
    const before = this.#pointers.get(event.pointerId);
    if (!before) return;
    const at = this.#local(event);
    const others = [...this.#pointers].filter(([id]) => id !== event.pointerId).map(([, p]) => p);
    this.#pointers.set(event.pointerId, at);
    if (others.length === 1) {
      const apart = (p) => Math.max(20, Math.hypot(p[0] - others[0][0], p[1] - others[0][1]));
      this.#zoom(others[0], apart(at) / apart(before));
      return;
    }
    this.view.x -= (at[0] - before[0]) / this.view.scale;
    this.view.y += (at[1] - before[1]) / this.view.scale;
    this.draw();
  }
}
