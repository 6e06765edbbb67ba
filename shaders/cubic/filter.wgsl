// Twin of family/cubic/filter.rs in f32, function by function: formulas and bounds are derived there. The constants
// (UNIT, THIRD, ...) and the record Pair, with the bounds of each pair, are generated from shader.rs.
// Proofs use + - * and comparisons alone, and hold with or without fused multiply-adds, reassociation of sums, and
// flushed denormals (every bound has a part above 2^-110). Guesses use / and sqrt, kept finite by clamps; curvatures
// are limited, so that no product overflows.

// offsets: first pair of the chunk, where axes 2 and 3 begin, 1 for the normalised chart.
fn pair_of(index: vec4<u32>) -> Pair {
    // Unsigned differences are right even where the products wrap around.
    return read_pair((index.x * params.shape.y + index.y - params.offsets.x) * PAIR_WORDS);
}

fn datum_of(index: vec4<u32>, pair: Pair) -> Datum {
    let third = inputs[params.offsets.y + index.z];
    let fourth = inputs[params.offsets.z + index.w];
    if params.offsets.w == 1u {
        return Datum(third, fourth, third * pair.curve0, fourth * pair.curve1);
    }
    return Datum(third * pair.curve0, fourth * pair.curve1, third, fourth);
}

struct Half {
    theorem: u32,
    bad_end: bool,
}

// B0 >= 0, B2 >= 0, B1 + sqrt(8 w B0 B2) >= 0.
fn half_theorem(b: vec3<f32>, e: vec3<f32>, w: f32, delta: f32) -> Half {
    let product = b.x * b.z;
    let over = 8.0 * (product * w) - b.y * b.y;
    let error = ((abs(b.x) * e.z + abs(b.z) * e.x + e.x * e.z) * (w + delta) + abs(product) * delta) * THROUGH
        + (2.0 * abs(b.y) + e.y) * e.y
        + (8.0 * (abs(product) * w) + b.y * b.y) * ROUNDINGS;
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
    ) * COVER + 4.0 * UNIT * abs(c);
    return max(errors.x, max(errors.y, errors.z));
}

fn spiral(b: vec3<f32>, e0: vec3<f32>, c: vec3<f32>, e1: vec3<f32>, root: Root) -> u32 {
    let start = vec3<f32>(5.0 * (root.y * root.y) * b.x, root.y * b.y, root.y * b.z);
    let end = vec3<f32>(5.0 * (root.x * root.x) * c.x, root.x * c.y, root.x * c.z);
    let error = max(half_error(b, e0, start, root.y, root.delta), half_error(c, e1, end, root.x, root.delta));
    let sizes = max(abs(start), abs(end));
    let largest = max(sizes.x, max(sizes.y, sizes.z));
    return positive(Quintic(start, end), error, 5.0 * UNIT * (largest + error));
}

// The code of a node.
fn evaluate(index: vec4<u32>) -> u32 {
    let pair = pair_of(index);
    if !pair.usable {
        return UNDECIDED;
    }
    let d = datum_of(index, pair);
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
            // With k > 1/3 the first root is the smaller positive one of Habib & Sakai, (A.10).
            flags |= select(0u, THEOREM31, slot == 0u && solvable);
            continue;
        }
        if at_start.bad_end || at_end.bad_end {
            continue;
        }
        let sign = spiral(b, e0, c, e1, root);
        if sign == NO {
            continue;
        }
        // Theorem 3.1 must be certain too, unless there is no spiral.
        if sign == OPEN || !(at_start.theorem == NO || at_end.theorem == NO) {
            return UNDECIDED;
        }
        spirals += 1u;
        flags |= SPIRAL;
    }
    return flags | ((roots | (spirals << 2u)) << 8u);
}
