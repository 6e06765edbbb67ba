// The cubic's part of family/reach/poly.rs in f32: alpha u = 1, m = beta u^2 - 1.

fn invert(alpha: Near, beta: Near, g: f32) -> Shape {
    let u = 1.0 / alpha.value;
    let rho = (abs(alpha.value * u - 1.0) + alpha.error * u + 3.0 * UNIT) * LOOSE;
    let square = u * u;
    let sum = beta.value * square;
    let error = (beta.error * square + abs(sum) * rho * 2.0) * LOOSE + (abs(sum) + 1.0) * (4.0 * UNIT);
    return Shape(Near(u, rho), Near(sum - 1.0, error), true, false);
}

// c0 .. c5; with sign 1 instead of -1 the sums of the absolute values of their terms.
fn coefficients(m: f32, u: f32, g: f32, sign: f32) -> Quintic {
    let gu = g * u;
    let m3 = m * m * m;
    return Quintic(
        vec3<f32>(
            4.0 * u * (3.0 * g + sign * ((m + 4.0) * u)),
            4.0 * (gu * (4.0 * m + 5.0 * sign)) + 20.0 * sign * (m * u * u) + 12.0,
            2.0 * (13.0 * m + 2.0 * sign + 4.0 * (gu * m) * (m + 4.0 * sign)),
        ),
        vec3<f32>(
            m3,
            5.0 * m3,
            2.0 * m * (10.0 * m + 3.0 * sign + 4.0 * sign * (gu * m)),
        ),
    );
}
