// The handles of ends: points, directions, circles.

import { show, showAngle } from "./numbers.js";

/** Pixels from an end to the handle of its direction, and along its circle to that of its curvature. */
const ARM = 92;
const ARC = 56;

const NAMES = { start: "start", end: "end", from: "start", to: "end" };

/** Curvature of the circle that touches a direction at a point and goes through another point. */
function through(point, direction, [x, y]) {
  const [dx, dy] = [x - point[0], y - point[1]];
  const across = dy * Math.cos(direction) - dx * Math.sin(direction);
  return (2 * across) / Math.max(dx * dx + dy * dy, 1e-300);
}

/** So many digits as the screen shows. */
const tidy = (x) => Number(x.toPrecision(6));

function tidyPoint([x, y], plane) {
  const step = 10 ** Math.floor(Math.log10(0.5 / plane.view.scale));
  return [x, y].map((v) => Number((Math.round(v / step) * step).toPrecision(12)));
}

/** An angle rounded to a hundredth of a degree, within a half turn. */
function tidyAngle(radians) {
  const degrees = Math.round((radians * 18000) / Math.PI) / 100;
  return ((degrees - 360 * Math.round(degrees / 360)) / 180) * Math.PI;
}

/**
 * Handles of an end with a point, a direction and perhaps a curvature.
 *
 * `end` has functions get() and set({ point, direction, curvature }).
 */
function endHandles(which, end, { bends, back, unit }) {
  const name = NAMES[which];
  const handles = [
    {
      id: `${which}-point`,
      which,
      shape: "point",
      label: `handle of the ${name} point`,
      at: (plane) => plane.toScreen(end.get().point),
      value: () =>
        end
          .get()
          .point.map((x) => show(x))
          .join(", "),
      move: (world, plane) => end.set({ point: tidyPoint(world, plane) }),
      nudge: (x, y, plane) => {
        const step = 10 ** Math.floor(Math.log10(4 / plane.view.scale));
        end.set({ point: [x, y].map((d, i) => Number((end.get().point[i] + d * step).toPrecision(12))) });
      },
    },
    {
      id: `${which}-direction`,
      which,
      shape: "arrow",
      label: `handle of the ${name} direction`,
      from: () => end.get().point,
      angle: () => end.get().direction,
      at: (plane) => {
        const { point, direction } = end.get();
        const [x, y] = plane.toScreen(point);
        return [x + ARM * Math.cos(direction), y - ARM * Math.sin(direction)];
      },
      value: () => showAngle(end.get().direction),
      move: ([x, y]) => {
        const { point } = end.get();
        end.set({ direction: tidyAngle(Math.atan2(y - point[1], x - point[0])) });
      },
      nudge: (x, y) => end.set({ direction: tidyAngle(end.get().direction + (((y || -x) / 2) * Math.PI) / 180) }),
    },
  ];
  if (!bends) return handles;
  handles.push({
    id: `${which}-curvature`,
    which,
    shape: "bend",
    label: `handle of the ${name} circle`,
    at: (plane) => {
      const { point, direction, curvature } = end.get();
      const [x, y] = plane.toScreen(point);
      const k = curvature / plane.view.scale;
      // At most half round the circle.
      const s = (back ? -1 : 1) * Math.min(ARC, Math.PI / Math.max(Math.abs(k), 1e-12));
      const half = 0.5 * k * s;
      const chord = half === 0 ? s : (s * Math.sin(half)) / half;
      return [x + chord * Math.cos(direction + half), y - chord * Math.sin(direction + half)];
    },
    value: () => `curvature ${show(end.get().curvature)} per ${unit()}`,
    move: (world) => {
      const { point, direction } = end.get();
      end.set({ curvature: tidy(through(point, direction, world)) });
    },
    nudge: (x, y, plane) => {
      const { curvature } = end.get();
      const step = Math.max(Math.abs(curvature) * 0.02, 0.0005 * plane.view.scale);
      end.set({ curvature: tidy(curvature + (y || x) * step) });
    },
  });
  return handles;
}

/** Handles of a circle: its centre and its radius. */
function circleHandles(which, end) {
  const name = NAMES[which];
  return [
    {
      id: `${which}-centre`,
      which,
      shape: "point",
      label: `handle of the ${name} centre`,
      at: (plane) => plane.toScreen(end.get().centre),
      value: () =>
        end
          .get()
          .centre.map((x) => show(x))
          .join(", "),
      move: (world, plane) => end.set({ centre: tidyPoint(world, plane) }),
      nudge: (x, y, plane) => {
        const step = 10 ** Math.floor(Math.log10(4 / plane.view.scale));
        end.set({ centre: [x, y].map((d, i) => Number((end.get().centre[i] + d * step).toPrecision(12))) });
      },
    },
    {
      id: `${which}-radius`,
      which,
      shape: "bend",
      label: `handle of the ${name} radius`,
      from: () => end.get().centre,
      at: (plane) => {
        const { centre, radius } = end.get();
        return plane.toScreen([centre[0] - radius * Math.SQRT1_2, centre[1] + radius * Math.SQRT1_2]);
      },
      value: () => show(end.get().radius),
      move: ([x, y], plane) => {
        const { centre } = end.get();
        end.set({ radius: tidy(Math.max(Math.hypot(x - centre[0], y - centre[1]), 2 / plane.view.scale)) });
      },
      nudge: (x, y) => end.set({ radius: tidy(end.get().radius * 1.02 ** (y || x)) }),
    },
  ];
}

/** All handles of a state, which `state` gives. */
export function allHandles(state) {
  const { mode, join } = state();
  const unit = () => state().unit;
  if (mode === "join") {
    return ["from", "to"].flatMap((which) => {
      const end = {
        get: () => state().join[which],
        set: (parts) => {
          const { join } = state();
          state().join = { ...join, [which]: { ...join[which], ...parts } };
        },
      };
      const { kind } = join[which];
      if (kind === "circle") return circleHandles(which, end);
      return endHandles(which, end, { bends: kind === "state", back: which === "from", unit });
    });
  }
  return ["start", "end"].flatMap((name) => {
    const [direction, curvature] = [`${name}_direction`, `${name}_curvature`];
    const end = {
      get: () => {
        const { ends } = state();
        return { point: ends[name], direction: ends[direction], curvature: ends[curvature] };
      },
      set: (parts) => {
        const e = state().ends;
        state().ends = {
          ...e,
          [name]: parts.point ?? e[name],
          [direction]: parts.direction ?? e[direction],
          [curvature]: parts.curvature ?? e[curvature],
        };
      },
    };
    return endHandles(name, end, { bends: true, back: name === "start", unit });
  });
}
