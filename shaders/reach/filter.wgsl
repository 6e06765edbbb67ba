// Reachable end points in f32: twin of family/reach/filter.rs, function by function; formulas in family/reach/poly.rs,
// whose twins poly_cubic.wgsl and poly_ph.wgsl add `invert` and `coefficients`. Constants (UNIT, SCALE, ...) are
// generated from shader.rs. Proofs use + - * and comparisons alone, and hold with or without fused multiply-adds,
// reassociated sums and flushed denormals (LEAST and FLOOR keep all terms that matter above them). Guesses use / and
// sqrt, kept finite by clamps.

// offsets: first angle of the chunk, where the axes of xi and eta begin.
fn angle_of(index: vec4<u32>) -> Angle {
    return read_angle((index.x - params.offsets.x) * ANGLE_WORDS);
}

// A number and how far it may be off.
struct Near {
    value: f32,
    error: f32,
}

// The segment of a case. The error of u is relative.
struct Shape {
    u: Near,
    m: Near,
    // (u, m) is proved to be the only candidate.
    found: bool,
    // There is proved to be no m > 0.
    none: bool,
}

fn scaled(x: Near, by: f32) -> Near {
    let value = x.value * by;
    return Near(value, abs(value) * SCALE + x.error * (COVER * by) + FLOOR);
}

fn find_shape(angle: Angle, a: Near, b: Near, none: bool) -> Shape {
    if none {
        return Shape(Near(1.0, 1.0), Near(0.0, 1.0), false, true);
    }
    let alpha = scaled(a, angle.to_alpha);
    let beta = scaled(b, angle.to_beta);
    if !(alpha.value > 1.0 / MOST_ALPHA && alpha.value < MOST_ALPHA && abs(beta.value) < MOST_BETA) {
        return Shape(Near(1.0, 1.0), Near(0.0, 1.0), false, false);
    }
    var shape = invert(alpha, beta, angle.g);
    let in_range = shape.u.value > LEAST_U && shape.u.value < MOST_U && shape.u.error < SMALL;
    let candidate = shape.found && in_range;
    shape.none = shape.none || (candidate && shape.m.value + shape.m.error < 0.0);
    shape.found = candidate && !shape.none && shape.m.value > shape.m.error;
    return shape;
}

// The four levels of a case as bits, or UNDECIDED.
fn levels(angle: Angle, shape: Shape) -> u32 {
    if shape.none {
        return 0u;
    }
    let m = shape.m.value;
    if !shape.found || !(shape.m.error < m * SMALL && m < MOST_M) {
        return UNDECIDED;
    }
    let value = coefficients(m, shape.u.value, angle.g, -1.0);
    let size = coefficients(m, shape.u.value, angle.g, 1.0);
    // The quotient is good to a hundredth, or nothing is said; COVER and what THROUGH_M leaves over are more.
    let inverse = 1.0 / m;
    if !(abs(inverse * m - 1.0) < 0.01) {
        return UNDECIDED;
    }
    let relative = shape.m.error * inverse * (COVER * THROUGH_M) + shape.u.error * THROUGH_U + COEFFICIENT;
    let error = Quintic(size.start * relative, size.end * relative);
    if value.start.x < -error.start.x {
        return EXISTS;
    }
    let end = value.start.x > error.start.x;
    if end && m - shape.m.error > DRAWN_ABOVE {
        return EXISTS | EXACT | THEOREM | PAPER;
    }
    let not_drawn = m + shape.m.error < DRAWN_BELOW;
    let middle = value.start.y > error.start.y && value.start.z > error.start.z && value.end.z > error.end.z;
    if end && middle {
        return select(UNDECIDED, EXISTS | EXACT | THEOREM, not_drawn);
    }
    // The least and the greatest quintic: only one of them can answer.
    // The binomials of degree 5, divided into 10.
    let factor = vec3<f32>(10.0, 2.0, 1.0);
    let low = Quintic((value.start - error.start) * factor, (value.end - error.end) * factor);
    let high = Quintic((value.start + error.start) * factor, (value.end + error.end) * factor);
    let sizes = max(max(abs(low.start), abs(low.end)), max(abs(high.start), abs(high.end)));
    let largest = max(sizes.x, max(sizes.y, sizes.z));
    let rounding = 5.0 * UNIT * largest;
    if positive(high, rounding, rounding) == NO {
        return EXISTS;
    }
    let not_theorem = value.start.y < -error.start.y || value.start.z < -error.start.z || value.end.z < -error.end.z;
    // What the theorem does not accept is not drawn either.
    if not_theorem && positive(low, rounding, rounding) == YES {
        return EXISTS | EXACT;
    }
    return UNDECIDED;
}

// Zero, or of a size at which nothing is flushed or overflows; what was clamped is not.
fn ordinary(x: f32) -> bool {
    return x == 0.0 || (abs(x) > LEAST && abs(x) < 1.0 / LEAST);
}

// The code of a node.
fn evaluate(index: vec4<u32>) -> u32 {
    let angle = angle_of(index);
    let xi = inputs[params.offsets.y + index.y];
    let eta = inputs[params.offsets.z + index.z];
    if !angle.usable || !ordinary(xi) || !ordinary(eta) {
        return UNDECIDED;
    }
    let east = xi * angle.sin;
    let north = eta * angle.cos;
    let h = Near(east - north, (abs(east) + abs(north)) * SIDE + FLOOR);
    var code = 0u;
    for (var case_index = 0u; case_index < 2u; case_index += 1u) {
        // Case 2 is the mirror image: its eta is the other's h.
        let mirrored = case_index == 1u;
        let flat = Near(eta, 0.0);
        var a = flat;
        var b = h;
        if mirrored {
            a = h;
            b = flat;
        }
        let none = select(eta <= 0.0, h.value < -h.error, mirrored);
        let found = levels(angle, find_shape(angle, a, b, none));
        if found == UNDECIDED {
            return UNDECIDED;
        }
        code |= found << (CASE_BITS * case_index);
    }
    return code;
}
