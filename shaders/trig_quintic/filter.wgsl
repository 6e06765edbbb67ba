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

// One step of de Casteljau's algorithm on coefficients i to i + 3 of a list, where the next is `after`; those from
// number `last` on stay.
fn mean(a: vec4<f32>, after: f32, first: i32, last: i32) -> vec4<f32> {
    return select(a, 0.5 * (a + vec4<f32>(a.yzw, after)), vec4<i32>(first) + vec4<i32>(0, 1, 2, 3) < vec4<i32>(last));
}

// The list from its other end.
fn reversed(c: Coefficients) -> Coefficients {
    return Coefficients(
        vec4<f32>(c[9].yx, c[8].wz),
        vec4<f32>(c[8].yx, c[7].wz),
        vec4<f32>(c[7].yx, c[6].wz),
        vec4<f32>(c[6].yx, c[5].wz),
        vec4<f32>(c[5].yx, c[4].wz),
        vec4<f32>(c[4].yx, c[3].wz),
        vec4<f32>(c[3].yx, c[2].wz),
        vec4<f32>(c[2].yx, c[1].wz),
        vec4<f32>(c[1].yx, c[0].wz),
        vec4<f32>(c[0].yx, 0.0, 0.0),
    );
}

// The right half of a piece. Its number i comes of 37 - i steps.
fn right_half(whole: Coefficients) -> Coefficients {
    var c = whole;
    for (var last = i32(COEFFICIENTS) - 1; last > 0; last -= 1) {
        c = Coefficients(
            mean(c[0], c[1].x, 0, last),
            mean(c[1], c[2].x, 4, last),
            mean(c[2], c[3].x, 8, last),
            mean(c[3], c[4].x, 12, last),
            mean(c[4], c[5].x, 16, last),
            mean(c[5], c[6].x, 20, last),
            mean(c[6], c[7].x, 24, last),
            mean(c[7], c[8].x, 28, last),
            mean(c[8], c[9].x, 32, last),
            mean(c[9], 0.0, 36, last),
        );
    }
    return c;
}

// Signs on [0, 1] as in num/bernstein.rs, for coefficients that are exact; each halving adds 37 roundings of the
// whole's largest.
//
// Pieces are looked at from left to right, as in lib/bernstein.wgsl. A halving takes 37 iterations of a loop:
// lavapipe leaves all loops of an invocation after 65535 of them, some 4000 a node, and of these halvings there are
// 32 at most, twice.
fn positive(whole: Coefficients) -> u32 {
    let size = largest(whole);
    var answer = YES;
    var piece = whole;
    var depth = 0u;
    // The piece to be looked at: number `place` of 2^level.
    var level = 0u;
    var place = 0u;
    for (var round = 0u; round < MOST_HALVINGS; round += 1u) {
        if depth < level {
            depth += 1u;
            let right = ((place >> (level - depth)) & 1u) == 1u;
            if !right {
                piece = reversed(piece);
            }
            piece = right_half(piece);
            if !right {
                piece = reversed(piece);
            }
        }
        if depth == level {
            let e = COVER * f32((COEFFICIENTS - 1u) * level) * UNIT * size;
            // The outer coefficients are values of the polynomial.
            if piece[0].x < -e || piece[9].y < -e {
                return NO;
            }
            let above = least(piece) > e;
            if !above && level < MOST_LEVELS && largest(piece) > e {
                level += 1u;
                place *= 2u;
                continue;
            }
            answer = select(OPEN, answer, above);
            // On to the next piece, as large as it may be.
            place += 1u;
            let wider = firstTrailingBit(place);
            place >>= wider;
            level -= wider;
            if level == 0u {
                return answer;
            }
            piece = whole;
            depth = 0u;
        }
    }
    return OPEN;
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
    if form.dips {
        return NO;
    }
    // One call site: drivers inline `positive`, which is large.
    for (var sign = -1.0; sign < 2.0; sign += 2.0) {
        let found = positive(shifted(form, sign));
        if found == select(NO, YES, sign < 0.0) {
            return found;
        }
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
