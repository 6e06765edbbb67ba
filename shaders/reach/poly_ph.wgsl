// The PH quintic's part of family/reach/poly.rs in f32: G(u) = 2(3+m)u + 2 + 3m + 3m^2 - beta u^3 = 0 with m = alpha
// u^2 - 24gu - 3.

fn shape_at(alpha: Near, g: f32, u: f32) -> Near {
    let m = u * (alpha.value * u - 24.0 * g) - 3.0;
    let terms = (alpha.value * u + 24.0 * g) * u + 3.0;
    return Near(m, alpha.error * (u * u) + terms * SHAPE);
}

fn residual(beta: Near, m: Near, u: f32) -> Near {
    let left = 2.0 * ((m.value + 3.0) * u) + 3.0 * (m.value * (m.value + 1.0)) + 2.0;
    let right = beta.value * (u * u) * u;
    let size = abs(m.value);
    let terms = 2.0 * ((size + 3.0) * u) + 3.0 * (size * (size + 1.0)) + 2.0 + abs(right);
    let through_m = (2.0 * u + 6.0 * size + 3.0 + 3.0 * m.error) * m.error;
    return Near(left - right, (through_m + beta.error * (u * u * u)) * COVER + terms * RESIDUAL);
}

// u G' - 3G, which is positive; for guesses, so never too small to divide by.
fn slope_at(alpha: Near, beta: Near, g: f32, m: f32, value: f32, u: f32) -> f32 {
    let m_slope = u * 2.0 * (alpha.value * u - 12.0 * g);
    let right = beta.value * (u * u) * u;
    let slope = 2.0 * ((m + 3.0) * u) - 3.0 * right + (2.0 * u + 6.0 * m + 3.0) * m_slope - 3.0 * value;
    return max(slope, 1e-6);
}

fn monotone(m: Near) -> bool {
    return m.value - m.error > MONOTONE_M;
}

fn invert(alpha: Near, beta: Near, g: f32) -> Shape {
    let guess = (12.0 * g + sqrt(144.0 * g * g + alpha.value * (3.0 + LEAST_M))) / alpha.value;
    let start = clamp(guess, LEAST_U, MOST_U);
    let m_start = shape_at(alpha, g, start);
    let g_start = residual(beta, m_start, start);
    if monotone(m_start) && m_start.value + m_start.error < 0.0 && g_start.value > g_start.error {
        return Shape(Near(1.0, 1.0), Near(0.0, 1.0), false, true);
    }
    var u = start;
    for (var i = 0u; i < 16u; i += 1u) {
        let m = shape_at(alpha, g, u);
        let value = residual(beta, m, u).value;
        let step = u * clamp(value / slope_at(alpha, beta, g, m.value, value, u), -1e6, 1e6);
        let next = clamp(u - step, start, MOST_U);
        let moved = abs(next - u);
        u = next;
        if moved < u * 6e-5 {
            break;
        }
    }
    let m = shape_at(alpha, g, u);
    let value = residual(beta, m, u);
    // Any delta would do that the proof accepts.
    let wide = TRIED * value.error / slope_at(alpha, beta, g, m.value, value.value, u) + 4.0 * UNIT;
    let rho = min(wide, 0.5);
    let low = u - rho * u;
    let high = u + rho * u;
    let m_low = shape_at(alpha, g, low);
    let g_low = residual(beta, m_low, low);
    let g_high = residual(beta, shape_at(alpha, g, high), high);
    let crossing = g_low.value < -g_low.error && g_high.value > g_high.error;
    // The ends are rounded, and the root lies between them.
    let around = rho * COVER + 4.0 * UNIT;
    let error = m.error + (alpha.value * u + 12.0 * g) * u * THROUGH_U * around;
    return Shape(Near(u, around), Near(m.value, error), crossing && monotone(m_low), false);
}

// c0 .. c5; with sign 1 instead of -1 the sums of the absolute values of their terms.
fn coefficients(m: f32, u: f32, g: f32, sign: f32) -> Quintic {
    let gu = g * u;
    let m2 = m * m;
    return Quintic(
        vec3<f32>(
            16.0 * gu * (sign * ((m + 6.0) * u) + 2.0),
            16.0 * (gu * (3.0 * m + 4.0 * sign) + 7.0 * sign * (m * u * gu) + 1.0),
            4.0 * (9.0 * m + 2.0 * sign + 6.0 * (gu * m) * (m + 4.0 * sign)),
        ),
        vec3<f32>(
            m2 * m,
            m2 * (7.0 * m + 2.0 * sign),
            4.0 * m * (7.0 * m + 3.0 * sign + 6.0 * sign * (gu * m)),
        ),
    );
}
