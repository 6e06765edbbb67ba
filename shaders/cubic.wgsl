// The cubic family in f32: twin of family/cubic/filter.rs, function by function. Formulas and bounds are derived there and
// in poly.rs; the constants (UNIT, THIRD, ...) and each pair's bounds are generated from the same Rust, for f32.
// Proofs use + - * and comparisons alone, and hold with or without fused multiply-adds, reassociation of sums, and
// flushed denormals (every bound has a part above 2^-110). Guesses use / and sqrt, kept finite by clamps; curvatures are
// limited, so that no product overflows.

struct Pair {
    p: f32,
    r: f32,
    g0: f32,
    g1: f32,
    // a / kappa0 and k / kappa1; in the normalised chart their inverses.
    curve0: f32,
    curve1: f32,
    sin0: f32,
    sin1: f32,
    sin2_half: f32,
    // phi0 < phi1
    rising: bool,
    // The constants fit f32.
    usable: bool,
    rounding0: vec3<f32>,
    rounding1: vec3<f32>,
    slope0: vec3<f32>,
    slope1: vec3<f32>,
}

fn read3(at: u32) -> vec3<f32> {
    return vec3<f32>(inputs[at], inputs[at + 1u], inputs[at + 2u]);
}

// offsets: first pair of the chunk, where axes 2 and 3 begin, 1 for the normalised chart.
fn read_pair(index: vec4<u32>) -> Pair {
    // Unsigned differences are right even where the products wrap around.
    let at = (index.x * params.shape.y + index.y - params.offsets.x) * PAIR_STRIDE;
    return Pair(
        inputs[at], inputs[at + 1u], inputs[at + 2u], inputs[at + 3u], inputs[at + 4u], inputs[at + 5u], inputs[at + 6u],
        inputs[at + 7u], inputs[at + 8u], inputs[at + 9u] > 0.0, inputs[at + 10u] > 0.0,
        read3(at + 11u), read3(at + 14u), read3(at + 17u), read3(at + 20u),
    );
}

struct Datum {
    a: f32,
    k: f32,
    kappa0: f32,
    kappa1: f32,
}

fn read_datum(index: vec4<u32>, pair: Pair) -> Datum {
    let third = inputs[params.offsets.y + index.z];
    let fourth = inputs[params.offsets.z + index.w];
    if params.offsets.w == 1u {
        return Datum(third, fourth, third * pair.curve0, fourth * pair.curve1);
    }
    return Datum(third * pair.curve0, fourth * pair.curve1, third, fourth);
}

// B0, B1, B2 of poly.rs.
fn side(x: f32, y: f32, p: f32, g: f32, r: f32) -> vec3<f32> {
    let u = 3.0 - x;
    let u2 = u * u;
    let xu = x * u;
    let b0 = 2.0 * (p * u2) + g * (2.0 * xu + y * (3.0 * x - 10.0));
    let b1_p = 2.0 * (u * (2.0 * (u * (x + 3.0)) + y * (7.0 * x - 17.0)));
    let b1_g = (2.0 * xu) * (2.0 * x - 7.0 * y) + (y * y) * (22.0 - 9.0 * x);
    let b1 = p * b1_p + g * b1_g + 4.0 * (r * (u2 * u));
    let x5 = 5.0 * x;
    let b2_p = u * (x * (x5 + 3.0) - 6.0) + y * (x * (2.0 * x5 - 32.0) + 12.0);
    let b2_g = (x * x) * (x5 - 12.0) + y * (x * (12.0 - 2.0 * x5) + y * (x5 - 2.0));
    let b2 = p * b2_p + g * b2_g + r * (u2 * (x5 - 2.0));
    return vec3<f32>(b0, b1, b2);
}

// F = 3 - x - k y^2, its error, y = 3 - a x^2, F' = 4akxy - 1.
struct Residual {
    f: f32,
    error: f32,
    y: f32,
    slope: f32,
}

fn residual(d: Datum, x: f32) -> Residual {
    let v = d.a * x * x;
    let y = 3.0 - v;
    let wide = abs(y) + ETA;
    let kw = d.k * wide;
    let error = (kw * wide + 2.0 * (kw * (v + wide))) * RESIDUAL + RESIDUAL_FLOOR;
    let slope = 4.0 * (d.a * x * (d.k * y)) - 1.0;
    return Residual((3.0 - x) - d.k * (y * y), error, y, slope);
}

struct Root {
    x: f32,
    y: f32,
    delta: f32,
    low: f32,
    high: f32,
    proved: bool,
}

// A slope to divide by: never so small that the quotient leaves the range.
fn steep(slope: f32) -> f32 {
    return select(min(slope, -1e-6), max(slope, 1e-6), slope > 0.0);
}

fn find_root(d: Datum, start: f32) -> Root {
    var x = start;
    for (var i = 0u; i < 24u; i += 1u) {
        let r = residual(d, x);
        let step = r.f / steep(r.slope);
        let next = clamp(x - step, 0.0, 3.0);
        let moved = abs(next - x);
        x = next;
        if moved < x * 6e-5 {
            break;
        }
    }
    let r = residual(d, x);
    // Near a double root delta may come out large; it then fails the test for `small`.
    let delta = min(2.5 * r.error / abs(steep(r.slope)) + 4.0 * UNIT * x, 3.0);
    let low = x - delta;
    let high = x + delta;
    let at_low = residual(d, low);
    let at_high = residual(d, high);
    let falls = at_low.f > at_low.error && at_high.f < -at_high.error;
    let rises = at_low.f < -at_low.error && at_high.f > at_high.error;
    let inside = low > 0.0 && high <= 3.0 && at_high.y > ETA;
    let small = delta * 64.0 < x;
    // The root lies between the rounded ends; see root.rs.
    let reach = 1.01 * delta + 4.0 * UNIT;
    let delta_y = 2.1 * (d.a * x * reach) + ETA;
    return Root(x, r.y, max(reach, delta_y), low, high, (falls || rises) && inside && small);
}

struct Half {
    theorem: u32,
    bad_end: bool,
}

// B0 >= 0, B2 >= 0, B1 + sqrt(8 w B0 B2) >= 0.
fn half_theorem(b: vec3<f32>, e: vec3<f32>, w: f32, delta: f32) -> Half {
    let product = b.x * b.z;
    let over = 8.0 * (product * w) - b.y * b.y;
    let error = ((abs(b.x) * e.z + abs(b.z) * e.x + e.x * e.z) * (w + delta) + abs(product) * delta) * 8.1
        + (2.0 * abs(b.y) + e.y) * e.y
        + (8.0 * (abs(product) * w) + b.y * b.y) * (16.0 * UNIT);
    let middle_yes = b.y > e.y || over > error;
    let middle_no = b.y < -e.y && over < -error;
    let bad_end = b.x < -e.x;
    if b.x > e.x && b.z > e.z && middle_yes {
        return Half(YES, bad_end);
    }
    if bad_end || b.z < -e.z || middle_no {
        return Half(NO, bad_end);
    }
    return Half(OPEN, bad_end);
}

// Coefficients (5 w^2 b0, w b1, w b2) and the largest error of one.
fn half_error(b: vec3<f32>, e: vec3<f32>, c: vec3<f32>, w: f32, delta: f32) -> f32 {
    let near = w + delta;
    let errors = vec3<f32>(
        5.0 * (near * near * e.x + (w + near) * delta * abs(b.x)),
        near * e.y + delta * abs(b.y),
        near * e.z + delta * abs(b.z),
    ) * 1.01 + 4.0 * UNIT * abs(c);
    return max(errors.x, max(errors.y, errors.z));
}

fn spiral(b: vec3<f32>, e0: vec3<f32>, c: vec3<f32>, e1: vec3<f32>, root: Root) -> u32 {
    let start = vec3<f32>(5.0 * (root.y * root.y) * b.x, root.y * b.y, root.y * b.z);
    let end = vec3<f32>(5.0 * (root.x * root.x) * c.x, root.x * c.y, root.x * c.z);
    let error = max(half_error(b, e0, start, root.y, root.delta), half_error(c, e1, end, root.x, root.delta));
    let sizes = max(abs(start), abs(end));
    let largest = max(sizes.x, max(sizes.y, sizes.z));
    let quintic = array<f32, 6>(start.x, start.y, start.z, end.z, end.y, end.x);
    return positive(quintic, error, 5.0 * UNIT * (largest + error));
}

// The code of a node.
fn evaluate(index: vec4<u32>) -> u32 {
    let pair = read_pair(index);
    if !pair.usable {
        return UNDECIDED;
    }
    let d = read_datum(index, pair);
    if abs(d.kappa0) > KAPPA_MOST || abs(d.kappa1) > KAPPA_MOST {
        return UNDECIDED;
    }
    let sines = vec3<f32>(pair.sin0, pair.sin1, pair.sin2_half);
    // Without phi0 < phi1 there is no spiral.
    var any = NO;
    if pair.rising {
        any = any_spiral(sines, d.kappa0, d.kappa1, OUTER);
    }
    let rootless = d.kappa0 <= 0.0 || d.kappa1 <= 0.0;
    if rootless {
        return select(select(0u, ANY_SPIRAL, any == YES), UNDECIDED, any == OPEN);
    }
    if any == OPEN || d.a < LEAST || d.a > MOST || d.k < LEAST || d.k > MOST {
        return UNDECIDED;
    }

    // How many roots: the signs of 3k - 1, 3a - 1 and of 768a^2k^2 - 256ak(a+k) + 96ak - 1.
    let k_above = 3.0 * d.k > 1.0 + THIRD;
    let a_above = 3.0 * d.a > 1.0 + THIRD;
    if !(k_above || 3.0 * d.k < 1.0 - THIRD) || !(a_above || 3.0 * d.a < 1.0 - THIRD) {
        return UNDECIDED;
    }
    let ak = d.a * d.k;
    let square = 768.0 * ak;
    let sum = 256.0 * (d.a + d.k);
    let discriminant = ak * (square - sum + 96.0) - 1.0;
    let error = (ak * (square + sum + 96.0) + 1.0) * DISCRIMINANT;
    let real = discriminant > error;
    if !(k_above && a_above) && !real && !(discriminant < -error) {
        return UNDECIDED;
    }
    var roots = 0u;
    if k_above && a_above {
        roots = 1u;
    } else if k_above || a_above {
        roots = select(0u, 2u, real);
    } else {
        roots = select(1u, 3u, real);
    }
    let solvable = k_above && roots > 0u;
    var flags = select(0u, SOLVABLE, solvable);
    if any == NO {
        return flags | (roots << 8u);
    }
    flags |= ANY_SPIRAL;

    // Where Newton's method is monotone: left end, inflection of F, right end.
    let middle = min(1.0 / sqrt(d.a), 3.0);
    var start = middle;
    if !k_above {
        let lone_right = roots == 1u && residual(d, middle).f > 0.0;
        start = select(0.0, 3.0, lone_right);
    }
    var spirals = 0u;
    var below = 0.0;
    for (var slot = 0u; slot < roots; slot += 1u) {
        if slot == 1u {
            start = select(middle, 3.0, k_above);
        } else if slot == 2u {
            start = 3.0;
        }
        let root = find_root(d, start);
        if !root.proved || root.low <= below {
            return UNDECIDED;
        }
        below = root.high;
        let b = side(root.x, root.y, pair.p, pair.g0, pair.r);
        let c = -side(root.y, root.x, pair.r, pair.g1, pair.p);
        let e0 = pair.slope0 * root.delta + pair.rounding0;
        let e1 = pair.slope1 * root.delta + pair.rounding1;
        let at_start = half_theorem(b, e0, root.y, root.delta);
        let at_end = half_theorem(c, e1, root.x, root.delta);
        if at_start.theorem == YES && at_end.theorem == YES {
            spirals += 1u;
            flags |= SPIRAL | THEOREM31_ANY;
            // With k > 1/3 the first root is the smaller positive one of (A.10).
            flags |= select(0u, THEOREM31, slot == 0u && solvable);
            continue;
        }
        if at_start.bad_end || at_end.bad_end {
            continue;
        }
        let sign = spiral(b, e0, c, e1, root);
        if sign == NEGATIVE {
            continue;
        }
        // Theorem 3.1 must be certain too, unless there is no spiral.
        if sign == UNKNOWN || !(at_start.theorem == NO || at_end.theorem == NO) {
            return UNDECIDED;
        }
        spirals += 1u;
        flags |= SPIRAL;
    }
    return flags | ((roots | (spirals << 2u)) << 8u);
}
