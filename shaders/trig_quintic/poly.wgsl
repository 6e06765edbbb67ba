// Quintic trigonometric curves in f32: twin of family/trig_quintic/poly.rs. Constants and records are generated from
// shader.rs. Proofs use + - * and comparisons alone, and hold with or without fused multiply-adds, reassociated sums
// and flushed denormals (FLOOR covers those).

// Coefficients of the hodograph, forward and upward; the latter begin at number 3.
struct Hodograph {
    x: array<f32, 11>,
    y: array<f32, 8>,
}

// What sides 2, 3 and 4 add to the coefficients from number 3 on; u is 1 - q, v is 4 + q.
fn tail(s2: f32, s3: f32, s4: f32, u: f32, v: f32) -> array<f32, 8> {
    return array<f32, 8>(
        17.0 * s2,
        84.0 * s2,
        168.0 * s2 + 12.0 * s3,
        168.0 * s2 + 60.0 * s3,
        68.0 * s2 + 120.0 * s3 + 8.0 * (s4 * u),
        120.0 * s3 + 24.0 * (s4 * u),
        48.0 * s3 + s4 * (16.0 * u + 4.0 * v),
        4.0 * (s4 * v),
    );
}

// The shape of a node: p4 is 4 + p, p1 is 1 - p, and so for q.
fn hodograph(y: f32, last: f32, m: f32, p4: f32, p1: f32, q4: f32, q1: f32) -> Hodograph {
    let my = m * y;
    let s0 = 3.0 * (my * my);
    let s1 = 3.0 * (my * y);
    let s2 = y * (2.0 * y + m);
    let s3 = 3.0 * y;
    // Any factor will do, so the quotient's own error does not matter.
    let k = 1.0 / (s0 + s1 + s2 + s3 + 6.0);
    let a = k * s0;
    let b = k * s1;
    var x = array<f32, 11>(
        0.125 * (a * p4),
        a * (p1 + 0.25 * p4) + 3.0 * b,
        3.0 * (a * p1) + 15.0 * b,
        2.0 * (a * p1) + 30.0 * b,
        30.0 * b,
        12.0 * b,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
    );
    var forward = tail(k * s2, k * s3, k * last, q1, q4);
    for (var i = 0u; i < 8u; i += 1u) {
        x[i + 3u] += forward[i];
    }
    return Hodograph(x, tail(k * my, k * s3, k * 6.0, q1, q4));
}

// X2 .. X18, and the sums of absolute values of their terms.
struct Turning {
    value: array<f32, 17>,
    size: array<f32, 17>,
}

fn turning(h: Hodograph) -> Turning {
    var a = h;
    var t: Turning;
    for (var k = 0u; k < 17u; k += 1u) {
        let s = k + 3u;
        var value = 0.0;
        var size = 0.0;
        for (var j = max(s / 2u + 1u, 3u); j <= min(s, 10u); j += 1u) {
            let i = s - j;
            let forward = a.x[i] * a.y[j - 3u];
            var back = 0.0;
            if i >= 3u {
                back = a.x[j] * a.y[i - 3u];
            }
            let factor = f32(j - i);
            value += factor * (forward - back);
            size += factor * (forward + back);
        }
        t.value[k] = value;
        t.size[k] = size;
    }
    return t;
}

// D0 .. D20.
fn speed(h: Hodograph, square: f32) -> array<f32, 21> {
    var a = h;
    var d: array<f32, 21>;
    for (var k = 0u; k < 21u; k += 1u) {
        var forward = 0.0;
        var upward = 0.0;
        for (var i = max(k, 10u) - 10u; i <= k / 2u; i += 1u) {
            let j = k - i;
            let factor = select(2.0, 1.0, i == j);
            forward += factor * (a.x[i] * a.x[j]);
            if i >= 3u {
                upward += factor * (a.y[i - 3u] * a.y[j - 3u]);
            }
        }
        d[k] = forward + upward * square;
    }
    return d;
}

// COEFFICIENTS numbers, and two zeros.
alias Coefficients = array<vec4<f32>, 10>;

// Bernstein coefficients and how far each may be off.
struct Form {
    value: Coefficients,
    error: Coefficients,
    // It is certainly negative somewhere.
    dips: bool,
}

// Places where a numerator that is negative somewhere mostly is: at t/(1 - t) of these, and of one over these.
const DIPS: vec4<f32> = vec4<f32>(1.0, 1.6666666, 3.0, 7.0);
// One over these to the power 37, about: a common factor of values and sizes changes nothing.
const LEAST_POWERS: vec4<f32> = vec4<f32>(1.0, 6.2e-9, 2.2e-18, 5.4e-32);

fn numerator(h: Hodograph, square: f32) -> Form {
    var t = turning(h);
    var d = speed(h, square);
    var form = Form(Coefficients(), Coefficients(), false);
    // Sums of values and of sizes at DIPS, and at one over these; powers are kept within 1.
    var above = vec4<f32>();
    var above_size = vec4<f32>();
    var below = vec4<f32>();
    var below_size = vec4<f32>();
    var rising = LEAST_POWERS;
    var falling = vec4<f32>(1.0);
    // Sums of X D and (2i - 3j) X D, values and sizes, for this index, the one before and that before.
    var now = vec4<f32>();
    var before = vec4<f32>();
    var earlier = vec4<f32>();
    for (var s = 0u; s < COEFFICIENTS; s += 1u) {
        now = vec4<f32>();
        if s < 37u {
            for (var i = max(s, 20u) - 20u; i <= min(s, 16u); i += 1u) {
                let j = s - i;
                let factor = 2.0 * f32(i + 2u) - 3.0 * f32(j);
                let value = t.value[i] * d[j];
                let size = t.size[i] * d[j];
                now += vec4<f32>(value, factor * value, size, abs(factor) * size);
            }
        }
        let value = now.y + (2.0 * before.y + 24.0 * before.x) + (2.0 * earlier.y + 48.0 * earlier.x);
        let size = now.w + (2.0 * before.w + 24.0 * before.z) + (2.0 * earlier.w + 48.0 * earlier.z);
        above += value * rising;
        above_size += size * rising;
        below += value * falling;
        below_size += size * falling;
        rising *= DIPS;
        falling *= 1.0 / DIPS;
        let factor = inputs[s];
        form.value[s / 4u][s % 4u] = value * factor;
        form.error[s / 4u][s % 4u] = size * factor * ERROR + FLOOR;
        earlier = before;
        before = now;
    }
    // A power has up to 37 roundings, its product one and the sum 37; flushed denormals are far below FLOOR.
    let relative = COVER * (ERROR + 3.0 * f32(COEFFICIENTS) * UNIT);
    let floor = 2.0 * f32(COEFFICIENTS) * FLOOR;
    form.dips = any(above < -(above_size * relative + floor)) || any(below < -(below_size * relative + floor));
    return form;
}
