// Paths of PH quintics in f32: which solution bends least, and how; twin of curve/hodograph.rs, with one error bound
// for all coefficients of a piece. The fragment of a family adds `ends`. Guesses use / and sqrt. Proofs use + - * and
// comparisons, and / and sqrt only where a thousandth more covers them; they count roundings per term, so they hold
// with fused multiply-adds and reassociated sums.

// Pre-image; each coefficient is off by at most `error`.
struct Curve {
    w0: vec2<f32>,
    w1: vec2<f32>,
    w2: vec2<f32>,
    error: f32,
}

// A number and how far it may be off.
struct Near {
    value: f32,
    error: f32,
}

// Both ends of the solutions with one sign of w2, and the square root that adds to w1.
struct Ends {
    w0: vec2<f32>,
    w2: vec2<f32>,
    // Of either.
    error: f32,
    root: vec2<f32>,
    root_error: f32,
    usable: bool,
}

// An upper bound of a modulus.
fn modulus(z: vec2<f32>) -> f32 {
    return MODULUS * sqrt(dot(z, z)) + TINY;
}

// Re and Im of conj(a) b.
fn inner(a: vec2<f32>, b: vec2<f32>) -> f32 {
    return a.x * b.x + a.y * b.y;
}

fn outer(a: vec2<f32>, b: vec2<f32>) -> f32 {
    return a.x * b.y - a.y * b.x;
}

fn product(a: vec2<f32>, b: vec2<f32>) -> vec2<f32> {
    return vec2<f32>(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
}

fn complex_root(z: vec2<f32>) -> vec2<f32> {
    let size = sqrt(dot(z, z));
    let safe = sqrt(max(0.5 * (size + abs(z.x)), 1e-30));
    let other = 0.5 * z.y / safe;
    return select(vec2<f32>(other, safe), vec2<f32>(safe, other), z.x >= 0.0);
}

struct Jet {
    w: vec2<f32>,
    slope: vec2<f32>,
    bend: vec2<f32>,
}

fn jet(c: Curve, t: f32) -> Jet {
    let a = c.w0 * (1.0 - t) + c.w1 * t;
    let b = c.w1 * (1.0 - t) + c.w2 * t;
    let first = 2.0 * (c.w1 - c.w0);
    let last = 2.0 * (c.w2 - c.w1);
    return Jet(a * (1.0 - t) + b * t, first * (1.0 - t) + last * t, last - first);
}

// |curvature|, about.
fn bending(c: Curve, t: f32) -> f32 {
    let j = jet(c, t);
    let speed = max(dot(j.w, j.w), 1e-12);
    return min(2.0 * abs(outer(j.w, j.slope)) / (speed * speed), 1e30);
}

struct Peak {
    at: f32,
    most: f32,
}

// Where the curvature is greatest: even samples, the slowest places, then Newton's method as long as it climbs.
fn peak(c: Curve) -> Peak {
    let a = c.w2 - 2.0 * c.w1 + c.w0;
    let b = c.w1 - c.w0;
    let root = complex_root(product(b, b) - product(a, c.w0));
    let size = max(dot(a, a), 1e-20);
    let slow = clamp(vec2<f32>(inner(a, root - b), inner(a, -root - b)) / size, vec2<f32>(0.0), vec2<f32>(1.0));
    var best = Peak(0.0, bending(c, 0.0));
    for (var i = 1u; i <= 18u; i += 1u) {
        var t = f32(i) * 0.0625;
        if i == 17u {
            t = slow.x;
        } else if i == 18u {
            t = slow.y;
        }
        let k = bending(c, t);
        if k > best.most {
            best = Peak(t, k);
        }
    }
    var reach = 0.03125;
    for (var i = 0u; i < 14u; i += 1u) {
        let j = jet(c, best.at);
        let speed = dot(j.w, j.w);
        let rise = 2.0 * inner(j.w, j.slope);
        let turn = outer(j.w, j.slope);
        let bent = outer(j.w, j.bend);
        let side = sign(turn);
        let f = (speed * bent - 2.0 * turn * rise) * side;
        let lift = 2.0 * (dot(j.slope, j.slope) + inner(j.w, j.bend));
        let slope = (speed * outer(j.slope, j.bend) - rise * bent - 2.0 * turn * lift) * side;
        var step = reach * sign(f);
        if slope < -1e-30 {
            step = clamp(-f / slope, -reach, reach);
        }
        let next = clamp(best.at + step, 0.0, 1.0);
        let moved = abs(next - best.at);
        let value = bending(c, next);
        if moved < 1e-6 {
            break;
        }
        if value >= best.most {
            best = Peak(next, value);
        } else {
            reach = 0.25 * moved;
        }
    }
    return best;
}

// Besides YES, NO and OPEN: no halving decides.
const HOPELESS: u32 = 3u;

// Bernstein coefficients of degree 8: v sigma^2 - h and v sigma^2 + h.
struct Sides {
    minus: array<vec3<f32>, 3>,
    plus: array<vec3<f32>, 3>,
    // Of each, with w off by the curve's error and v by its own.
    error: f32,
    // h at the start.
    turn: f32,
}

fn sides(c: Curve, v: Near) -> Sides {
    let s0 = dot(c.w0, c.w0);
    let s1 = 4.0 * inner(c.w0, c.w1);
    let s2 = 4.0 * dot(c.w1, c.w1) + 2.0 * inner(c.w0, c.w2);
    let s3 = 4.0 * inner(c.w1, c.w2);
    let s4 = dot(c.w2, c.w2);
    let h0 = 4.0 * outer(c.w0, c.w1);
    let h1 = 4.0 * outer(c.w0, c.w2);
    let h2 = 4.0 * outer(c.w1, c.w2);
    let by0 = vec3<f32>(1.0, 0.125, 1.0 / 28.0);
    let by1 = vec3<f32>(1.0 / 56.0, 1.0 / 70.0, 1.0 / 56.0);
    let by2 = by0.zyx;
    let q0 = v.value * by0 * vec3<f32>(s0 * s0, 2.0 * s0 * s1, 2.0 * s0 * s2 + s1 * s1);
    let q1 = v.value * by1 * vec3<f32>(2.0 * (s0 * s3 + s1 * s2), 2.0 * (s0 * s4 + s1 * s3) + s2 * s2,
                                       2.0 * (s1 * s4 + s2 * s3));
    let q2 = v.value * by2 * vec3<f32>(2.0 * s2 * s4 + s3 * s3, 2.0 * s3 * s4, s4 * s4);
    let p0 = by0 * (h0 * vec3<f32>(1.0, 6.0, 15.0) + h1 * vec3<f32>(0.0, 1.0, 6.0) + h2 * vec3<f32>(0.0, 0.0, 1.0));
    let p1 = by1 * (h0 * vec3<f32>(20.0, 15.0, 6.0) + h1 * vec3<f32>(15.0, 20.0, 15.0)
                    + h2 * vec3<f32>(6.0, 15.0, 20.0));
    let p2 = by2 * (h0 * vec3<f32>(1.0, 0.0, 0.0) + h1 * vec3<f32>(6.0, 1.0, 0.0) + h2 * vec3<f32>(15.0, 6.0, 1.0));
    let m = max(modulus(c.w0), max(modulus(c.w1), modulus(c.w2)));
    let m2 = m * m;
    let slack = c.error * (FOURTH * v.value * m2 * m + TURN * m) + LIMIT * v.error * m2 * m2;
    let error = SIDE * (v.value * m2 * m2 + 4.0 * m2) + slack + TINY;
    // The factors hold for small errors.
    return Sides(
        array(q0 - p0, q1 - p1, q2 - p2),
        array(q0 + p0, q1 + p1, q2 + p2),
        select(1e30, error, c.error < FAR * m),
        h0,
    );
}

fn least(v: vec3<f32>) -> f32 {
    return min(v.x, min(v.y, v.z));
}

fn most(v: vec3<f32>) -> f32 {
    return max(v.x, max(v.y, v.z));
}

fn compared(c: Curve, v: Near, touching: bool) -> u32 {
    var s = sides(c, v);
    if touching {
        // Exactly 0.
        if s.turn > 0.0 {
            s.minus[0].x = 1e30;
        } else {
            s.plus[0].x = 1e30;
        }
    }
    let e = s.error;
    if min(min(s.minus[0].x, s.minus[2].z), min(s.plus[0].x, s.plus[2].z)) < -e {
        return NO;
    }
    let low = min(least(min(s.minus[0], min(s.minus[1], s.minus[2]))),
                  least(min(s.plus[0], min(s.plus[1], s.plus[2]))));
    if low > e {
        return YES;
    }
    let high = max(most(max(s.minus[1], s.minus[2])), most(max(s.plus[1], s.plus[2])));
    return select(HOPELESS, OPEN, high > e);
}

// Whether |curvature| stays below v; with `touching`, v is that at the start, where it may be equal.
fn below(whole: Curve, limit: Near, touching: bool) -> u32 {
    var waiting: array<Curve, 14>;
    var levels: array<u32, 14>;
    waiting[0] = whole;
    levels[0] = 0u;
    var count = 1u;
    var first = touching;
    for (var i = 0u; i < 80u; i += 1u) {
        if count == 0u {
            return YES;
        }
        count -= 1u;
        let c = waiting[count];
        let level = levels[count];
        let scale = 1.0 / f32(1u << level);
        // h of a piece shrinks with its width, a power of two.
        let found = compared(c, Near(limit.value * scale, limit.error * scale), first);
        if found == YES {
            first = false;
            continue;
        }
        if found != OPEN || level == 12u {
            return select(OPEN, NO, found == NO);
        }
        let left = 0.5 * (c.w0 + c.w1);
        let right = 0.5 * (c.w1 + c.w2);
        let middle = 0.5 * (left + right);
        let m = max(modulus(c.w0), max(modulus(c.w1), modulus(c.w2)));
        let error = c.error + 4.0 * UNIT * m;
        waiting[count] = Curve(middle, right, c.w2, error);
        levels[count] = level + 1u;
        waiting[count + 1u] = Curve(c.w0, left, middle, error);
        levels[count + 1u] = level + 1u;
        count += 2u;
    }
    return OPEN;
}

// h and sigma at a parameter that is a number of f32.
struct Point {
    turn: Near,
    speed: Near,
}

// w is a mean of means: each takes three roundings of numbers up to m, so six in all. w' is a mean of differences up to
// 4 m, which takes four roundings of these, and each difference is off by 4 errors of w. The products below are of
// upper bounds, so they hold the products of two errors too.
fn point(c: Curve, t: f32) -> Point {
    let j = jet(c, t);
    let m = max(modulus(c.w0), max(modulus(c.w1), modulus(c.w2)));
    let off = c.error + 12.0 * UNIT * m;
    let slope_off = 4.0 * c.error + 40.0 * UNIT * m;
    let w = modulus(j.w) + off;
    let slope = modulus(j.slope) + slope_off;
    let turn_error = 2.0 * (w * slope_off + slope * off) + 10.0 * UNIT * w * slope;
    return Point(
        Near(2.0 * outer(j.w, j.slope), COVER * turn_error + TINY),
        Near(dot(j.w, j.w), COVER * (2.0 * w * off + 6.0 * UNIT * w * w) + TINY),
    );
}

// Whether |curvature| exceeds v there; and whether it is less.
fn exceeds(p: Point, v: f32) -> bool {
    let speed = p.speed.value + p.speed.error;
    return abs(p.turn.value) - p.turn.error > ABOVE * v * speed * speed;
}

fn stays_under(p: Point, v: f32) -> bool {
    let speed = p.speed.value - p.speed.error;
    return speed > 0.0 && abs(p.turn.value) + p.turn.error < UNDER * v * speed * speed;
}
