// The question of family/ph_path/truth.rs in f32.

// Whether h keeps its sign.
fn keeps_sign(c: Curve) -> u32 {
    let m = max(modulus(c.w0), max(modulus(c.w1), modulus(c.w2)));
    // Each is rounded twice, of terms up to 4 m^2. The curve stayed below a limit, so its error is below FAR m.
    let error = TURN * c.error * m + 16.0 * UNIT * m * m + TINY;
    let h0 = 4.0 * outer(c.w0, c.w1);
    let h1 = 2.0 * outer(c.w0, c.w2);
    let h2 = 4.0 * outer(c.w1, c.w2);
    if abs(h0) <= error || abs(h2) <= error {
        return OPEN;
    }
    if (h0 > 0.0) != (h2 > 0.0) {
        return NO;
    }
    let middle = h1 * sign(h0);
    if middle > error {
        return YES;
    }
    // Below 0 it must stay within the geometric mean.
    let size = max(abs(middle), max(abs(h0), abs(h2)));
    let gap = h0 * h2 - h1 * h1;
    let gap_error = GAP * error * size + 6.0 * UNIT * size * size;
    if gap > gap_error {
        return YES;
    }
    return select(OPEN, NO, gap < -gap_error && middle < -error);
}

fn reversed(c: Curve) -> Curve {
    return Curve(c.w2, c.w1, c.w0, c.error);
}

// Whether |curvature| is greatest strictly inside.
fn peak_inside(c: Curve, p: Peak) -> u32 {
    let ends = vec2<f32>(bending(c, 0.0), bending(c, 1.0));
    let end = max(ends.x, ends.y);
    if p.at > 0.0 && p.at < 1.0 && p.most > end {
        let v = sqrt(p.most * end);
        if exceeds(point(c, p.at), v) && stays_under(point(c, 0.0), v) && stays_under(point(c, 1.0), v) {
            return YES;
        }
        return OPEN;
    }
    var turned = c;
    if ends.y > ends.x {
        turned = reversed(c);
    }
    let start = point(turned, 0.0);
    let value = bending(turned, 0.0);
    // How far the quotient is off: any guess would do that the comparisons below accept.
    let speed = start.speed.value;
    let relative = start.turn.error / max(abs(start.turn.value), 1e-30) + 2.1 * start.speed.error / max(speed, 1e-30)
        + 1e-5;
    let error = value * min(relative, 1.0);
    if !(relative < 0.1 && exceeds(start, value - error) && stays_under(start, value + error)) {
        return OPEN;
    }
    return select(OPEN, NO, below(turned, Near(value, error), true) == YES);
}

// The code of a node.
fn evaluate(index: vec4<u32>) -> u32 {
    var curves: array<Curve, 4>;
    var peaks: array<Peak, 4>;
    for (var i = 0u; i < 4u; i += 1u) {
        let e = ends(index, i >= 2u);
        if !e.usable {
            return UNDECIDED;
        }
        let side = select(0.25, -0.25, (i & 1u) == 1u);
        let w1 = side * e.root - 0.75 * (e.w0 + e.w2);
        let size = modulus(e.root) + 3.0 * (modulus(e.w0) + modulus(e.w2));
        let error = max(e.error, QUARTER * e.root_error + ENDS * e.error + 3.0 * UNIT * size);
        curves[i] = Curve(e.w0, w1, e.w2, error);
        peaks[i] = peak(curves[i]);
    }
    var best = 0u;
    for (var i = 1u; i < 4u; i += 1u) {
        if peaks[i].most < peaks[best].most {
            best = i;
        }
    }
    let least_most = peaks[best].most;
    var next = 4.0 * least_most;
    for (var i = 0u; i < 4u; i += 1u) {
        if i != best {
            next = min(next, peaks[i].most);
        }
    }
    // It stays below a curvature that all others exceed.
    let limit = sqrt(least_most * next);
    if !(limit > 1e-6 && limit < 1e9) {
        return UNDECIDED;
    }
    for (var i = 0u; i < 4u; i += 1u) {
        if i != best && !exceeds(point(curves[i], peaks[i].at), limit) {
            return UNDECIDED;
        }
    }
    let winner = curves[best];
    if below(winner, Near(limit, 0.0), false) != YES {
        return UNDECIDED;
    }
    let way = keeps_sign(winner);
    let inside = peak_inside(winner, peaks[best]);
    if way == OPEN || inside == OPEN {
        return UNDECIDED;
    }
    return REGULAR | select(0u, ONE_WAY, way == YES) | select(0u, PEAK_INSIDE, inside == YES)
        | select(0u, PAPER, best < 2u);
}
