// Given arc length: the end speed z and the root from Farouki et al., (10)-(13), as in curve/equal_length.rs.

// Rounding the sum adds one unit of it, and the error's own roundings, three, are within ABOVE.
fn plus(a: Near, b: Near) -> Near {
    let value = a.value + b.value;
    return Near(value, ABOVE * (a.error + b.error) + 4.0 * UNIT * (abs(a.value) + abs(b.value)));
}

fn times(a: Near, b: Near) -> Near {
    let value = a.value * b.value;
    return Near(value, ABOVE * (abs(a.value) * b.error + abs(b.value) * a.error + a.error * b.error)
                + 2.0 * UNIT * abs(value));
}

// a/b: with q as computed, a*/b* - q = (a* - q b*)/b*. The remainder is a - q b but for the rounding of the product.
fn over(a: Near, b: Near) -> Near {
    let least = b.value - b.error;
    if !(least > 1e-25) {
        return Near(0.0, 1e30);
    }
    let value = a.value / b.value;
    let rest = abs(a.value - value * b.value) + 3.0 * UNIT * abs(a.value);
    return Near(value, COVER * (rest + a.error + abs(value) * b.error) / least);
}

// |sqrt(x*) - r| <= |x* - r^2| / r for any r > 0.
fn root_of(x: Near) -> Near {
    let value = sqrt(max(x.value, 1e-25));
    let rest = abs(x.value - value * value) + 3.0 * UNIT * value * value;
    return Near(value, select(1e30, COVER * (rest + x.error) / value, x.value > x.error));
}

fn rounded(value: f32) -> Near {
    return Near(value, COVER * UNIT * abs(value));
}

// offsets: first pair of the chunk, where the axis of S begins.
fn ends(index: vec4<u32>, other: bool) -> Ends {
    let sums = read_sums((index.x * params.shape.y + index.y - params.offsets.x) * SUMS_WORDS);
    let last = select(1.0, -1.0, other) * sums.last;
    // Of sines, of cosines, and g.
    let forms = select(sums.forms, sums.other_forms, other);
    let lengths = read_lengths(params.offsets.y + index.z * LENGTHS_WORDS);
    let p0 = rounded(lengths.p0);
    let q0 = rounded(lengths.q0);
    let usable = sums.usable && p0.value > 0.0;
    // g comes from differences in f64.
    let g = Near(forms.z, COVER * UNIT * abs(forms.z) + 1e-13);
    let a = times(p0, rounded(forms.x));
    let b = times(q0, rounded(forms.y));
    let above = a.value >= b.value;
    let apart = plus(a, Near(-b.value, b.error));
    let excess = Near(abs(apart.value), apart.error);
    let both = times(p0, q0);
    let mixed = times(times(g, g), both);
    let root = root_of(plus(times(excess, excess), Near(4.0 * mixed.value, 4.0 * mixed.error)));
    let whole = plus(plus(a, b), root);
    let z = over(Near(2.0 * both.value, 2.0 * both.error), whole);
    var top = q0;
    if above {
        top = p0;
    }
    let safe = root_of(over(times(top, plus(excess, root)), whole));
    let rest = over(times(g, z), safe);
    let size = root_of(z);
    // Units are rounded once, and so is the product; the rest is for the square of both.
    let error = COVER * size.error + COVER * 2.0 * UNIT * size.value;
    var roots = vec2<f32>(rest.value, safe.value);
    if above {
        roots = roots.yx;
    }
    let root_error = safe.error + rest.error;
    let fits = root_error < 0.1 * safe.value && error < 0.1 * size.value && safe.value < 1e6;
    return Ends(size.value * sums.first, size.value * last, error, roots, root_error, usable && fits);
}
