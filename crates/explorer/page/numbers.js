// Numbers as people write them: with units, as radii, in degrees.

/** Metres in each unit of length. */
export const UNITS = { m: 1, km: 1000, cm: 0.01, mm: 0.001, ft: 0.3048, in: 0.0254, yd: 0.9144, mi: 1609.344 };

const NUMBER = /^[+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?$/i;

function plain(text) {
  const cleaned = text.trim().replace(/\u2212/g, "-");
  if (!NUMBER.test(cleaned)) throw new Error(`“${text.trim()}” is no number`);
  const value = Number(cleaned);
  if (!Number.isFinite(value)) throw new Error(`“${text.trim()}” is beyond the range of numbers`);
  return value;
}

/** A number, and the unit of length after it. */
function split(text) {
  const match = /^(.*?)\s*([a-z]+)?$/i.exec(text.trim());
  const unit = match[2] && match[2].toLowerCase();
  if (unit && unit !== "e" && !(unit in UNITS))
    throw new Error(`“${match[2]}” is no unit; known are ${Object.keys(UNITS).join(", ")}`);
  return [plain(match[1]), unit];
}

/** A length in the page's unit. */
export function readLength(text, unit) {
  const [value, own] = split(text);
  return own && own !== unit ? (value * UNITS[own]) / UNITS[unit] : value;
}

/** A curvature in one over the page's unit: 0.04, 1/25, 1/25 m, or R 25 m. */
export function readCurvature(text, unit) {
  const radius = /^\s*([+-])?\s*(?:1\s*\/|r\s*=?)\s*(.+)$/i.exec(text.replace(/\u2212/g, "-"));
  if (radius) {
    const value = readLength(radius[2], unit);
    if (value === 0) throw new Error("a radius of 0 has no curvature");
    return (radius[1] === "-" ? -1 : 1) / value;
  }
  const match = /^(.*?)(?:\s*\/\s*([a-z]+)|\s*([a-z]+)\s*(?:\^-1|⁻¹))?$/i.exec(text.trim());
  const own = (match[2] || match[3] || unit).toLowerCase();
  if (!(own in UNITS)) throw new Error(`“${own}” is no unit of length`);
  return own === unit ? plain(match[1]) : (plain(match[1]) * UNITS[unit]) / UNITS[own];
}

/** A curvature from its radius: a length, or ∞. */
export function readRadius(text, unit) {
  if (/^\s*[+-]?\s*(∞|inf|infinity|straight|-)\s*$/i.test(text)) return 0;
  const radius = readLength(text, unit);
  if (radius === 0) throw new Error("a radius of 0 has no curvature; write ∞ for a straight end");
  return 1 / radius;
}

/** An angle in radians: degrees unless it says otherwise. */
export function readAngle(text) {
  const match = /^(.*?)\s*(°|deg|rad|gon)?$/i.exec(text.trim());
  const value = plain(match[1]);
  const unit = (match[2] || "°").toLowerCase();
  return unit === "rad" ? value : unit === "gon" ? (value / 200) * Math.PI : fromDegrees(value);
}

/** As the command line does it. */
export function fromDegrees(degrees) {
  return (degrees / 180) * Math.PI;
}

/** So many digits, and no more zeros than needed. */
export function show(value, digits = 6) {
  if (value === undefined || value === null || Number.isNaN(value)) return "–";
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
  const size = Math.abs(value);
  let text = Number(value.toPrecision(digits));
  text = size !== 0 && (size < 1e-4 || size >= 1e7) ? text.toExponential() : String(text);
  return text.replace("-", "\u2212");
}

export function showAngle(radians, digits = 6) {
  return show(Number(((radians * 180) / Math.PI).toPrecision(12)), digits) + "°";
}

/** An angle for a program: in degrees where that is the same double, else in radians. */
export function tellAngle(radians) {
  const degrees = Number(((radians * 180) / Math.PI).toPrecision(12));
  return fromDegrees(degrees) === radians ? `${degrees}deg` : String(radians);
}

/** Round steps for the ticks of an axis. */
export function ticks(from, to, count) {
  const rough = (to - from) / count;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= rough);
  const all = [];
  for (let i = Math.ceil(from / step); i * step <= to + 1e-9 * step; i++)
    all.push(Number((i * step).toPrecision(12)));
  return all;
}

/** The same for an axis of equal ratios. */
export function logTicks(from, to, count) {
  const decades = Math.log10(to / from);
  if (decades < 0.8) return ticks(from, to, count);
  const parts = decades > 3 ? [1] : decades > 1.6 ? [1, 3] : [1, 2, 5];
  const all = [];
  for (let power = Math.floor(Math.log10(from)); power <= Math.log10(to); power++) {
    for (const part of parts) {
      const value = Number((part * 10 ** power).toPrecision(6));
      if (value >= from && value <= to) all.push(value);
    }
  }
  const thin = Math.ceil(all.length / (count + 2));
  return all.filter((_, i) => i % thin === 0);
}
