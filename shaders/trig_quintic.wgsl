// Quintic trigonometric curves in f32: twin of family/trig_quintic/filter.rs, formulas in family/trig_quintic/poly.rs. Constants are
// generated from the same Rust. Proofs use + - * and comparisons alone, and hold with or without fused multiply-adds, reassociated
// sums and flushed denormals (FLOOR covers those).

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
}

fn numerator(h: Hodograph, square: f32) -> Form {
    var t = turning(h);
    var d = speed(h, square);
    var form = Form(Coefficients(), Coefficients());
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
        let factor = inputs[s];
        form.value[s / 4u][s % 4u] = value * factor;
        form.error[s / 4u][s % 4u] = size * factor * ERROR + FLOOR;
        earlier = before;
        before = now;
    }
    return form;
}

// Least, and largest in size.
fn least(c: Coefficients) -> f32 {
    let a = min(min(min(c[0], c[1]), min(c[2], c[3])), min(min(c[4], c[5]), min(c[6], min(c[7], c[8]))));
    return min(min(min(a.x, a.y), min(a.z, a.w)), min(c[9].x, c[9].y));
}

fn largest(c: Coefficients) -> f32 {
    let a = max(max(abs(c[0]), abs(c[1])), max(abs(c[2]), abs(c[3])));
    let b = max(max(abs(c[4]), abs(c[5])), max(abs(c[6]), abs(c[7])));
    let d = max(max(a, b), max(abs(c[8]), abs(c[9])));
    return max(max(d.x, d.y), max(d.z, d.w));
}

// One step of de Casteljau's algorithm, from a list and the same without its first.
fn mean(a: vec4<f32>, b: vec4<f32>) -> vec4<f32> {
    return 0.5 * (a + vec4<f32>(a.yzw, b.x));
}

fn step(c: Coefficients) -> Coefficients {
    return Coefficients(
        mean(c[0], c[1]),
        mean(c[1], c[2]),
        mean(c[2], c[3]),
        mean(c[3], c[4]),
        mean(c[4], c[5]),
        mean(c[5], c[6]),
        mean(c[6], c[7]),
        mean(c[7], c[8]),
        mean(c[8], c[9]),
        mean(c[9], vec4<f32>()),
    );
}

// Signs on [0, 1] as in num/bernstein.rs, for coefficients that are exact; each halving adds 37 roundings of the piece's largest.
//
// It is written with few iterations of loops, 38 for a halving, because lavapipe leaves all loops of an invocation after
// 65535 of them: some 4000 a node. There are 40 for a halving, and 700 before.
fn positive(coefficients: Coefficients) -> u32 {
    // Depth first with the right halves waiting: one a level, and the piece in hand.
    var waiting: array<Coefficients, MOST_LEVELS>;
    var levels: array<u32, MOST_LEVELS>;
    var errors: array<f32, MOST_LEVELS>;
    waiting[0] = coefficients;
    levels[0] = 0u;
    errors[0] = 0.0;
    var count = 1u;
    var halvings = 0u;
    var answer = POSITIVE;
    loop {
        if count == 0u {
            break;
        }
        count -= 1u;
        var piece = waiting[count];
        let level = levels[count];
        let e = errors[count];
        // The outer coefficients are values of the polynomial.
        if piece[0].x < -e || piece[9].y < -e {
            return NEGATIVE;
        }
        if least(piece) > e {
            continue;
        }
        let size = largest(piece);
        if level + 2u >= MOST_LEVELS || halvings >= MOST_HALVINGS || size <= e {
            answer = UNKNOWN;
            continue;
        }
        halvings += 1u;
        var left = Coefficients();
        var right = Coefficients();
        for (var i = 0u; i < COEFFICIENTS; i += 1u) {
            let j = COEFFICIENTS - 1u - i;
            left[i / 4u][i % 4u] = piece[0].x;
            right[j / 4u][j % 4u] = piece[j / 4u][j % 4u];
            piece = step(piece);
        }
        // What steps took from beyond the last coefficient has reached none of these.
        let after = e + 1.01 * f32(COEFFICIENTS - 1u) * UNIT * size;
        waiting[count] = right;
        levels[count] = level + 1u;
        errors[count] = after;
        waiting[count + 1u] = left;
        levels[count + 1u] = level + 1u;
        errors[count + 1u] = after;
        count += 2u;
    }
    return answer;
}

// The polynomial plus or minus its error.
fn shifted(form: Form, sign: f32) -> Coefficients {
    let v = form.value;
    let e = form.error;
    return Coefficients(
        v[0] + sign * e[0],
        v[1] + sign * e[1],
        v[2] + sign * e[2],
        v[3] + sign * e[3],
        v[4] + sign * e[4],
        v[5] + sign * e[5],
        v[6] + sign * e[6],
        v[7] + sign * e[7],
        v[8] + sign * e[8],
        v[9] + sign * e[9],
    );
}

// The greatest that the polynomial may be only can prove no, the least only yes.
fn spiral(form: Form) -> u32 {
    if positive(shifted(form, 1.0)) == NEGATIVE {
        return NEGATIVE;
    }
    if positive(shifted(form, -1.0)) == POSITIVE {
        return POSITIVE;
    }
    return UNKNOWN;
}

// The code of a node. The first index counts pairs of ratio and theta.
fn evaluate(index: vec4<u32>) -> u32 {
    let pair = COEFFICIENTS + (index.x - params.offsets.x) * PAIR_STRIDE;
    let at_q = params.offsets.w + index.w * Q_STRIDE;
    var flags = 0u;
    if inputs[at_q + 2u] > 0.0 {
        flags |= END_CURVATURE_AS_PRINTED;
    }
    if index.y < u32(inputs[pair + 3u]) {
        flags |= PRINTED_RATIO;
    }
    if index.w >= u32(inputs[pair + 4u]) {
        return flags;
    }
    flags |= END_RISES;
    let m = inputs[params.offsets.y + index.y];
    let at_p = params.offsets.z + index.z * P_STRIDE;
    let p4 = inputs[at_p];
    let q4 = inputs[at_q];
    // Words out of range are 0.
    if !(inputs[pair] > 0.0 && m > 0.0 && p4 > 0.0 && q4 > 0.0) {
        return UNDECIDED;
    }
    let a = hodograph(inputs[pair], inputs[pair + 1u], m, p4, inputs[at_p + 1u], q4, inputs[at_q + 1u]);
    let found = spiral(numerator(a, inputs[pair + 2u]));
    if found == UNKNOWN {
        return UNDECIDED;
    }
    return flags | select(0u, SPIRAL, found == POSITIVE);
}
