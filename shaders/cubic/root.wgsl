// Twin of family/cubic/root.rs in f32: guesses by Newton's method, and what proves them.

struct Datum {
    a: f32,
    k: f32,
    kappa0: f32,
    kappa1: f32,
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
    let delta = min(TRIED * r.error / abs(steep(r.slope)) + 4.0 * UNIT * x, 3.0);
    let low = x - delta;
    let high = x + delta;
    let at_low = residual(d, low);
    let at_high = residual(d, high);
    let falls = at_low.f > at_low.error && at_high.f < -at_high.error;
    let rises = at_low.f < -at_low.error && at_high.f > at_high.error;
    let inside = low > 0.0 && high <= 3.0 && at_high.y > ETA;
    let small = delta * SMALL < x;
    // The root lies between the rounded ends; see root.rs.
    let reach = COVER * delta + ENDS;
    let delta_y = THROUGH_X * (d.a * x * reach) + ETA;
    return Root(x, r.y, max(reach, delta_y), low, high, (falls || rises) && inside && small);
}
