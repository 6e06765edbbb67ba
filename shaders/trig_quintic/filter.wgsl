// Twin of family/trig_quintic/filter.rs in f32.

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

// Signs on [0, 1] as in num/bernstein.rs, for coefficients that are exact; each halving adds 37 roundings of the
// piece's largest.
//
// It is written with few iterations of loops, 38 for a halving, because lavapipe leaves all loops of an invocation
// after 65535 of them: some 4000 a node. There are 40 for a halving, and 700 before.
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
    var answer = YES;
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
            return NO;
        }
        if least(piece) > e {
            continue;
        }
        let size = largest(piece);
        if level + 2u >= MOST_LEVELS || halvings >= MOST_HALVINGS || size <= e {
            answer = OPEN;
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
        let after = e + COVER * f32(COEFFICIENTS - 1u) * UNIT * size;
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
    if positive(shifted(form, 1.0)) == NO {
        return NO;
    }
    if positive(shifted(form, -1.0)) == YES {
        return YES;
    }
    return OPEN;
}

// The code of a node. The first index counts pairs of ratio and theta.
fn evaluate(index: vec4<u32>) -> u32 {
    let pair = read_pair(COEFFICIENTS + (index.x - params.offsets.x) * PAIR_WORDS);
    let q = read_end(params.offsets.w + index.w * END_WORDS);
    var flags = select(0u, END_CURVATURE_AS_PRINTED, q.as_printed);
    if index.y < u32(pair.printed) {
        flags |= PRINTED_RATIO;
    }
    if index.w >= u32(pair.rising) {
        return flags;
    }
    flags |= END_RISES;
    let m = inputs[params.offsets.y + index.y];
    let p = read_end(params.offsets.z + index.z * END_WORDS);
    // Words out of range are 0.
    if !(pair.y > 0.0 && m > 0.0 && p.over > 0.0 && q.over > 0.0) {
        return UNDECIDED;
    }
    let a = hodograph(pair.y, pair.last, m, p.over, p.less, q.over, q.less);
    let found = spiral(numerator(a, pair.square));
    if found == OPEN {
        return UNDECIDED;
    }
    return flags | select(0u, SPIRAL, found == YES);
}
