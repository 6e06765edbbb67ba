// Twin of family/ph_quintic/truth.rs in f32: the code of a node.

// Solutions and spirals packed as counts, and the flags that follow; UNDECIDED where f32 proves none. `any`: whether a
// spiral is possible.
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
    // From the first knot on, as far at a time as a certificate reaches: no knots wait in memory, which registers
    // cannot index.
    let last = b;
    var solutions = 0u;
    var spirals = 0u;
    for (var knots = 0u; knots < 96u; knots += 1u) {
        let met = meets(a, b);
        var next = 0.0;
        if met == OPEN {
            let apart = b.t - a.t;
            if apart < a.t * 0.001 {
                return UNDECIDED;
            }
            // Not in the middle, where symmetric data have solutions.
            next = select(a.t + 0.469 * apart, sqrt(a.t) * sqrt(b.t) * 1.037, b.t > 1.2 * a.t);
        } else {
            if met == YES {
                solutions += 1u;
                if any {
                    let root = enclose(curves, a, b);
                    if !root.proved {
                        return UNDECIDED;
                    }
                    let verdict = spiral(curves, root);
                    if verdict == OPEN {
                        return UNDECIDED;
                    }
                    spirals += u32(verdict == YES);
                }
            }
            if b.t == last.t {
                let flags = select(0u, SOLVABLE, solutions > 0u) | select(0u, SPIRAL, spirals > 0u);
                return flags | (min(solutions, 7u) | (min(spirals, 7u) << 3u)) << 8u;
            }
            // Further than before.
            let ratio = b.t / a.t;
            next = b.t * ratio * ratio;
            a = b;
            if next * ratio > last.t {
                b = last;
                continue;
            }
        }
        b = knot(curves, next);
    }
    return UNDECIDED;
}

// offsets: first pair of the chunk, where axes 2 and 3 begin.
fn evaluate(index: vec4<u32>) -> u32 {
    // Unsigned differences are right even where the products wrap around.
    let pair = read_pair((index.x * params.shape.y + index.y - params.offsets.x) * PAIR_WORDS);
    let first = read_curvature(params.offsets.y + index.z * CURVATURE_WORDS);
    let second = read_curvature(params.offsets.z + index.w * CURVATURE_WORDS);
    if !pair.usable || abs(first.kappa) > MOST || abs(second.kappa) > MOST {
        return UNDECIDED;
    }
    var any = NO;
    if pair.rising {
        // Where the bound holds, kappa0 < kappa1 follows.
        any = any_spiral(pair.sines, first.kappa, second.kappa, OUTER);
    }
    if any == OPEN {
        return UNDECIDED;
    }
    let outer = select(0u, ANY_SPIRAL, any == YES);
    if first.kappa < 0.0 || second.kappa < 0.0 {
        return outer;
    }
    let scale = vec2<f32>(first.scale, second.scale);
    let bend = vec2<f32>(first.bend, second.bend) * pair.quarter;
    let code = count(curves_of(scale, bend, pair.cos, pair.right), any == YES);
    return select(code | outer, UNDECIDED, code == UNDECIDED);
}
