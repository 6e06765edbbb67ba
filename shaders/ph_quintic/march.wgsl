// Twin of family/ph_quintic/march.rs in f32: which knots prove that the curves meet, and where.

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
    let gap = 2.0 * (z.x - z.y) / (z.x + z.y);
    return Knot(t, z, error, s, SLOPE * error + 4.0 * TERM, gap, GAP * error + GAP_ROUNDINGS);
}

// Whether the curves meet between two knots: march.rs has the two certificates.
fn meets(a: Knot, b: Knot) -> u32 {
    if abs(a.gap) <= a.gap_error || abs(b.gap) <= b.gap_error {
        return OPEN;
    }
    let same = (a.gap > 0.0) == (b.gap > 0.0);
    let errors = a.s_error + b.s_error;
    if same {
        let fall = select(b.s.x - a.s.x, b.s.y - a.s.y, a.gap > 0.0);
        let length = (b.t - a.t) / (sqrt(a.t) * sqrt(b.t)) * LENGTH;
        let reach = (abs(fall) + errors) * TENT * length;
        if abs(a.gap) - a.gap_error > reach && abs(b.gap) - b.gap_error > reach {
            return NO;
        }
    }
    if a.s.y - b.s.x > errors || a.s.x - b.s.y > errors {
        return select(YES, NO, same);
    }
    return OPEN;
}

// A knot's heights against the limits of both curves beyond it: `high` is that of one curve, `low`, if positive, that
// of the other. Both sides of a comparison are rounded five times at most.
fn clear_of(first: f32, second: f32, error: f32, high: Near, low: Near) -> bool {
    // A limit that is not known, because it is outside the range, is none to be above of.
    let above = first * (1.0 - error) > high.value * (1.0 + high.error) + 8.0 * UNIT * first;
    let over = second * (1.0 - error) > low.value * (1.0 + low.error) + 8.0 * UNIT * second;
    return (high.error < FAR && above) || (low.value > 0.0 && low.error < FAR && over);
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
    // The ends are rounded by two units; Z is that of the first curve, at most `around` away.
    let around = COVER * reach + 4.0 * UNIT;
    return Root(Near(at.t, around), Near(at.z.x, ALONG * around + HEIGHT * at.z_error),
                inside && (falls || rises) && reach < 0.02);
}
