// Regions in the colours of the PNG pictures, with the same edges and stripes.

const dark = matchMedia("(prefers-color-scheme: dark)");

/**
 * Paper, and regions from the largest to the innermost: those of the pictures. In the dark, what is paper or grey there
 * is dark.
 */
const LIGHT = {
  paper: [255, 255, 255],
  ramp: [
    [226, 226, 226],
    [242, 188, 60],
    [38, 137, 152],
    [54, 26, 92],
  ],
  edge: [0, 0, 0],
  line: [210, 32, 32],
};
const DARK = {
  paper: [24, 27, 31],
  ramp: [
    [74, 80, 88],
    [242, 188, 60],
    [38, 137, 152],
    [112, 72, 176],
  ],
  edge: [16, 18, 21],
  line: [255, 110, 100],
};
const PICKED = [[], [2], [0, 1], [0, 1, 3], [0, 1, 2, 3]];

export const colours = () => (dark.matches ? DARK : LIGHT);
export const onScheme = (changed) => dark.addEventListener("change", changed);

/** The colours of so many nested regions. */
export function ramp(count) {
  const { ramp } = colours();
  return (PICKED[Math.min(count, 4)] ?? []).map((i) => ramp[i]);
}

export const css = ([r, g, b]) => `rgb(${r} ${g} ${b})`;

function luminance(color) {
  const [r, g, b] = color.map((part) =>
    part / 255 <= 0.04045 ? part / 255 / 12.92 : ((part / 255 + 0.055) / 1.055) ** 2.4,
  );
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

function contrast(a, b) {
  const [p, q] = [luminance(a) + 0.05, luminance(b) + 0.05];
  return Math.max(p, q) / Math.min(p, q);
}

/**
 * Paints a picture. `rank` has for each pixel, top row first, how many regions hold it, innermost last; `within`
 * whether the outlined condition holds.
 */
export function paint(canvas, width, height, rank, fills, within) {
  const { paper, edge, line } = colours();
  const all = [paper, ...fills];
  const parted = all.map((a) => all.map((b) => a !== b && contrast(a, b) < 3));
  const image = new ImageData(width, height);
  const put = (at, [r, g, b]) => image.data.set([r, g, b, 255], 4 * at);
  const words = new Uint32Array(image.data.buffer);
  const packed = all.map(([r, g, b]) => ((255 << 24) | (b << 16) | (g << 8) | r) >>> 0);
  const black = ((255 << 24) | (edge[2] << 16) | (edge[1] << 8) | edge[0]) >>> 0;
  for (let y = 0, at = 0; y < height; y++) {
    for (let x = 0; x < width; x++, at++) {
      const own = rank[at];
      let word = packed[own];
      // The earlier of two fills that look alike gives its pixels for the edge.
      if (
        (x > 0 && rank[at - 1] > own && parted[own][rank[at - 1]]) ||
        (x + 1 < width && rank[at + 1] > own && parted[own][rank[at + 1]]) ||
        (y > 0 && rank[at - width] > own && parted[own][rank[at - width]]) ||
        (y + 1 < height && rank[at + width] > own && parted[own][rank[at + width]])
      )
        word = black;
      words[at] = word;
    }
  }
  if (within) outline(width, height, within, put, paper, line);
  canvas.width = width;
  canvas.height = height;
  canvas.getContext("2d").putImageData(image, 0, 0);
}

/** A line where a condition begins, with stripes on its side. */
function outline(width, height, within, put, paper, line) {
  const band = 7;
  const out = (x, y) => x >= 0 && y >= 0 && x < width && y < height && !within[y * width + x];
  for (let y = 0, at = 0; y < height; y++) {
    for (let x = 0; x < width; x++, at++) {
      if (!within[at]) continue;
      const near = (d) => out(x - d, y) || out(x + d, y) || out(x, y - d) || out(x, y + d);
      if (near(1)) put(at, line);
      else if (near(2)) put(at, paper);
      else if ((x + y) % 6 < 2) {
        for (let d = 3; d <= band; d++) {
          if (near(d)) {
            put(at, line);
            break;
          }
        }
      }
    }
  }
}
