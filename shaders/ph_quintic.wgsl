// PH quintics with G2 Hermite ends in f32: twin of family/ph_quintic (curves.rs, march.rs, shape.rs), function by function. Constants
// (UNIT, TERM, ...) are generated from Rust. Proofs use + - * and comparisons; guesses, and quotients whose last bits do not matter,
// use / and sqrt, kept finite by clamps. Relative bounds count roundings, so they hold with fused multiply-adds and reassociation;
// the ranges of the constants and of z and t keep every term that matters above the denormals.

// The equations, scaled; vectors hold both ends.
struct Curves {
    scale: vec2<f32>,
    bend: vec2<f32>,
    cos: f32,
    right: vec2<f32>,
    flat: vec2<f32>,
    own: vec2<f32>,
    across: vec2<f32>,
    both: f32,
    last: vec2<f32>,
}

fn curves_of(scale: vec2<f32>, bend: vec2<f32>, cosine: f32, right: vec2<f32>) -> Curves {
    let c = 2.0 * cosine;
    return Curves(
        scale,
        bend,
        cosine,
        right,
        3.0 * c * scale * scale,
        3.0 * bend * scale,
        3.0 * c * bend * scale.yx,
        4.0 * bend.x * bend.y,
        2.0 * c * bend * bend,
    );
}

// A left-hand side at one t: c.x Z + c.y Z^2 + c.z Z^3, and each term times its power of t.
struct Cubic {
    c: vec3<f32>,
    j: vec3<f32>,
}

// A positive number and its relative error.
struct Near {
    value: f32,
    error: f32,
}

fn height(c: vec3<f32>, right: f32) -> Near {
    // Down from the least height that one term alone would need.
    let least = max(c, vec3<f32>(1e-20));
    var z = min(min(right / least.x, sqrt(right / least.y)), exp2(log2(right / least.z) * 0.33333333));
    z = clamp(z, LEAST_Z, MOST_Z);
    for (var i = 0u; i < 12u; i += 1u) {
        let rise = max((3.0 * c.z * z + 2.0 * c.y) * z + c.x, 1e-20);
        let step = (((c.z * z + c.y) * z + c.x) * z - right) / rise;
        z = clamp(z - step, LEAST_Z, MOST_Z);
        if abs(step) <= z * 1e-4 {
            break;
        }
    }
    // d ln F / d ln Z >= 1.
    let off = abs(((c.z * z + c.y) * z + c.x) * z - right);
    let relative = off / right * 1.05 + TERM;
    // At the rim of the range nothing is known.
    return Near(z, select(1.0, relative, z > LEAST_Z && z < MOST_Z));
}

struct Knot {
    t: f32,
    z: vec2<f32>,
    // Relative.
    z_error: f32,
    s: vec2<f32>,
    s_error: f32,
    gap: f32,
    gap_error: f32,
}

fn slope(cubic: Cubic, z: f32) -> f32 {
    let rise = max((3.0 * cubic.c.z * z + 2.0 * cubic.c.y) * z + cubic.c.x, 1e-30);
    return ((cubic.j.z * z + cubic.j.y) * z + cubic.j.x) / rise;
}

fn knot(curves: Curves, t: f32) -> Knot {
    let t2 = t * t;
    let t3 = t2 * t;
    let first = curves.scale.x * curves.scale.y * t;
    let fourth = curves.own.y * (t2 * t2);
    let second = curves.own.x + fourth;
    let level = curves.flat.y * t2;
    let bent = curves.across.x * t;
    let both = curves.both * t3;
    let bent_end = curves.across.y * t3;
    let sixth = curves.last.y * (t3 * t3);
    let start = Cubic(
        vec3<f32>(first + level, second + bent, both + curves.last.x),
        vec3<f32>(first + 2.0 * level, 4.0 * fourth + bent, 3.0 * both),
    );
    let end = Cubic(
        vec3<f32>(first + curves.flat.x, second + bent_end, both + sixth),
        vec3<f32>(first, 4.0 * fourth + 3.0 * bent_end, 3.0 * both + 6.0 * sixth),
    );
    let z0 = height(start.c, curves.right.x);
    let z1 = height(end.c, curves.right.y);
    let z = vec2<f32>(z0.value, z1.value);
    let error = max(z0.error, z1.error);
    let s = vec2<f32>(slope(start, z.x), slope(end, z.y));
    // |ds / d ln Z| <= 1, s <= 2; and the gap moves by no more than ln Z0 and ln Z1.
    let gap = 2.0 * (z.x - z.y) / (z.x + z.y);
    return Knot(t, z, error, s, 1.1 * error + 4.0 * TERM, gap, 2.1 * error + 8.0 * UNIT);
}

const APART: u32 = 0u;
const ONCE: u32 = 1u;
const UNCLEAR: u32 = 2u;

// Whether the curves meet between two knots: march.rs has the two certificates.
fn meets(a: Knot, b: Knot) -> u32 {
    if abs(a.gap) <= a.gap_error || abs(b.gap) <= b.gap_error {
        return UNCLEAR;
    }
    let same = (a.gap > 0.0) == (b.gap > 0.0);
    let errors = a.s_error + b.s_error;
    if same {
        let fall = select(b.s.x - a.s.x, b.s.y - a.s.y, a.gap > 0.0);
        let length = (b.t - a.t) / (sqrt(a.t) * sqrt(b.t)) * 1.001;
        let reach = (abs(fall) + errors) * 0.2501 * length;
        if abs(a.gap) - a.gap_error > reach && abs(b.gap) - b.gap_error > reach {
            return APART;
        }
    }
    if a.s.y - b.s.x > errors || a.s.x - b.s.y > errors {
        return select(ONCE, APART, same);
    }
    return UNCLEAR;
}

// A knot's heights against the limits of both curves beyond it: `high` is that of one curve, `low`, if positive, that of the other.
fn clear_of(first: f32, second: f32, error: f32, high: Near, low: Near) -> bool {
    return first * (1.0 - error) > high.value * (1.0 + high.error) + 8.0 * UNIT * first
        || (low.value > 0.0 && second * (1.0 - error) > low.value * (1.0 + low.error) + 8.0 * UNIT * second);
}

// The limit of the curve without flat end, if it has one.
fn low_limit(curves: Curves, end: u32) -> Near {
    if curves.bend[end] > 0.0 {
        return height(vec3<f32>(0.0, curves.own[end], curves.last[end]), curves.right[end]);
    }
    return Near(0.0, 0.0);
}

fn high_limit(curves: Curves, end: u32) -> Near {
    return height(vec3<f32>(curves.flat[end], curves.own[end], 0.0), curves.right[1u - end]);
}

// A solution: relative errors of t and Z.
struct Root {
    t: Near,
    z: Near,
    proved: bool,
}

fn enclose(curves: Curves, a: Knot, b: Knot) -> Root {
    var low = a.t;
    var high = b.t;
    let side = a.gap > 0.0;
    var at = knot(curves, sqrt(low) * sqrt(high));
    for (var i = 0u; i < 12u; i += 1u) {
        if (at.gap > 0.0) == side {
            low = at.t;
        } else {
            high = at.t;
        }
        let turn = at.s.y - at.s.x;
        let step = clamp(at.gap / select(min(turn, -1e-6), max(turn, 1e-6), turn > 0.0), -0.9, 0.9);
        let newton = at.t - at.t * step;
        let next = select(sqrt(low) * sqrt(high), newton, newton > low && newton < high);
        let moved = abs(next - at.t);
        at = knot(curves, next);
        if moved <= 1e-5 * next {
            break;
        }
    }
    let turn = max(abs(at.s.y - at.s.x), 1e-6);
    // Any reach would do that the signs accept.
    let reach = min((abs(at.gap) + at.gap_error) * 2.0 / turn + 16.0 * UNIT, 0.1);
    let left = knot(curves, at.t - at.t * reach);
    let right = knot(curves, at.t + at.t * reach);
    let inside = left.t > a.t && right.t < b.t;
    let falls = left.gap > left.gap_error && right.gap < -right.gap_error && side;
    let rises = left.gap < -left.gap_error && right.gap > right.gap_error && !side;
    let around = 1.01 * reach + 4.0 * UNIT;
    return Root(Near(at.t, around), Near(at.z.x, 2.1 * around + 1.05 * at.z_error), inside && (falls || rises) && reach < 0.02);
}

// The first three coefficients of the numerator of the curvature's derivative; with sign 1 instead of -1 the sums of the absolute
// values of their terms.
fn half_quintic(turn: vec3<f32>, speed: array<f32, 5>, sign: f32) -> vec3<f32> {
    return vec3<f32>(
        turn.y * speed[0] * 10.0 + turn.x * speed[0] * 30.0 + sign * (turn.x * speed[1] * 40.0),
        turn.x * speed[1] * 16.0 + turn.y * speed[0] * 14.0 + turn.z * speed[0] * 2.0
            + sign * (turn.x * speed[2] * 24.0 + turn.y * speed[1] * 8.0),
        turn.x * speed[2] * 6.0 + turn.y * speed[1] * 20.0 + turn.z * speed[0] * 4.0
            + sign * (turn.x * speed[3] * 12.0 + turn.y * speed[2] * 18.0),
    );
}

// Whether the solution's curvature rises throughout: POSITIVE, NEGATIVE or UNKNOWN.
fn spiral(curves: Curves, root: Root) -> u32 {
    let t = root.t.value;
    let z = root.z.value;
    let p = curves.scale.x;
    let q = curves.scale.y;
    let g = curves.cos;
    let t3 = t * t * t;
    let u = curves.bend.y * t3;
    let v = curves.bend.x;
    let square = u * (u + g * (2.0 * v)) + v * v;
    let speed = array<f32, 5>(
        p * p,
        z * (u + g * v) * p,
        // A third; the quotient is rounded once, but may be less good.
        (square * (z * z) * 2.0 + g * t * (p * q)) * 0.33333333,
        z * t * (v + g * u) * q,
        t * t * (q * q),
    );
    let backwards = array<f32, 5>(speed[4], speed[3], speed[2], speed[1], speed[0]);
    let turn = vec3<f32>(v * z * (2.0 * p), t * (p * q), u * t * z * (2.0 * q));
    let start = half_quintic(turn, speed, -1.0);
    let end = -half_quintic(turn.zyx, backwards, -1.0);
    let start_size = half_quintic(turn, speed, 1.0);
    let end_size = half_quintic(turn.zyx, backwards, 1.0);
    // t has the power 10 at most, Z the power 3; powers of a number known to a thirtieth grow by less than 1.4.
    let relative = (10.0 * root.t.error + 3.0 * root.z.error) * 1.4 + SHAPE;
    if !(relative < 0.25) {
        return UNKNOWN;
    }
    let size = max(start_size, end_size);
    let largest = max(size.x, max(size.y, size.z));
    if !(largest < 1e30 && largest > 1e-15) {
        return UNKNOWN;
    }
    // The outer coefficients are values of the quintic, and have smaller errors of their own.
    if start.x < -relative * start_size.x || end.x < -relative * end_size.x {
        return NEGATIVE;
    }
    // The least and the greatest quintic: only one of them can answer.
    let low_start = start - relative * start_size;
    let low_end = end - relative * end_size;
    let rounding = 8.0 * UNIT * largest;
    let low = array<f32, 6>(low_start.x, low_start.y, low_start.z, low_end.z, low_end.y, low_end.x);
    if positive(low, rounding, rounding) == POSITIVE {
        return POSITIVE;
    }
    let high_start = start + relative * start_size;
    let high_end = end + relative * end_size;
    let high = array<f32, 6>(high_start.x, high_start.y, high_start.z, high_end.z, high_end.y, high_end.x);
    if positive(high, rounding, rounding) == NEGATIVE {
        return NEGATIVE;
    }
    return UNKNOWN;
}

const DEPTH: u32 = 20u;

// Solutions and spirals packed as counts, and the flags that follow; UNDECIDED where f32 cannot tell. `any`: whether a spiral is possible.
fn count(curves: Curves, any: bool) -> u32 {
    // Knots before and behind which there is no solution.
    var a = knot(curves, 0.0625);
    var b = knot(curves, 16.0);
    let below = low_limit(curves, 0u);
    let above = high_limit(curves, 0u);
    var tries = 0u;
    while !clear_of(a.z.x, a.z.y, a.z_error, above, below) {
        tries += 1u;
        if tries == 4u {
            return UNDECIDED;
        }
        a = knot(curves, a.t * 0.0625);
    }
    let below_end = low_limit(curves, 1u);
    let above_end = high_limit(curves, 1u);
    tries = 0u;
    while !clear_of(b.t * b.t * b.z.y, b.t * b.t * b.z.x, b.z_error, above_end, below_end) {
        tries += 1u;
        if tries == 4u {
            return UNDECIDED;
        }
        b = knot(curves, b.t * 16.0);
    }
    var waiting: array<Knot, DEPTH>;
    waiting[0] = b;
    var depth = 1u;
    var solutions = 0u;
    var spirals = 0u;
    for (var knots = 0u; knots < 96u; knots += 1u) {
        b = waiting[depth - 1u];
        let met = meets(a, b);
        if met == UNCLEAR {
            let apart = b.t - a.t;
            if depth == DEPTH || apart < a.t * 0.001 {
                return UNDECIDED;
            }
            // Not in the middle, where symmetric data have solutions.
            let between = select(a.t + 0.469 * apart, sqrt(a.t) * sqrt(b.t) * 1.037, b.t > 1.2 * a.t);
            waiting[depth] = knot(curves, between);
            depth += 1u;
            continue;
        }
        if met == ONCE {
            solutions += 1u;
            if any {
                let root = enclose(curves, a, b);
                if !root.proved {
                    return UNDECIDED;
                }
                let verdict = spiral(curves, root);
                if verdict == UNKNOWN {
                    return UNDECIDED;
                }
                spirals += u32(verdict == POSITIVE);
            }
        }
        a = b;
        depth -= 1u;
        if depth == 0u {
            let flags = select(0u, SOLVABLE, solutions > 0u) | select(0u, SPIRAL, spirals > 0u);
            return flags | (min(solutions, 7u) | (min(spirals, 7u) << 3u)) << 8u;
        }
    }
    return UNDECIDED;
}

// offsets: first pair of the chunk, where axes 2 and 3 begin.
fn evaluate(index: vec4<u32>) -> u32 {
    // Unsigned differences are right even where the products wrap around.
    let pair = (index.x * params.shape.y + index.y - params.offsets.x) * PAIR_STRIDE;
    let first = params.offsets.y + index.z * AXIS_STRIDE;
    let second = params.offsets.z + index.w * AXIS_STRIDE;
    let kappa0 = inputs[first];
    let kappa1 = inputs[second];
    if !(inputs[pair + 8u] > 0.0) || abs(kappa0) > MOST || abs(kappa1) > MOST {
        return UNDECIDED;
    }
    var any = NO;
    if inputs[pair + 7u] > 0.0 {
        // Where the bound holds, kappa0 < kappa1 follows.
        any = any_spiral(vec3<f32>(inputs[pair + 4u], inputs[pair + 5u], inputs[pair + 6u]), kappa0, kappa1, OUTER);
    }
    if any == OPEN {
        return UNDECIDED;
    }
    let outer = select(0u, ANY_SPIRAL, any == YES);
    if kappa0 < 0.0 || kappa1 < 0.0 {
        return outer;
    }
    let scale = vec2<f32>(inputs[first + 1u], inputs[second + 1u]);
    let bend = vec2<f32>(inputs[first + 2u], inputs[second + 2u]) * inputs[pair + 3u];
    let right = vec2<f32>(inputs[pair + 1u], inputs[pair + 2u]);
    let code = count(curves_of(scale, bend, inputs[pair], right), any == YES);
    return select(code | outer, UNDECIDED, code == UNDECIDED);
}
