// Twin of family/ph_quintic/shape.rs in f32.

// The first three coefficients of the numerator of the curvature's derivative; with sign 1 instead of -1 the sums of
// the absolute values of their terms.
fn half_quintic(turn: vec3<f32>, speed: array<f32, 5>, sign: f32) -> vec3<f32> {
    return vec3<f32>(
        turn.y * speed[0] * 10.0 + turn.x * speed[0] * 30.0 + sign * (turn.x * speed[1] * 40.0),
        turn.x * speed[1] * 16.0 + turn.y * speed[0] * 14.0 + turn.z * speed[0] * 2.0
            + sign * (turn.x * speed[2] * 24.0 + turn.y * speed[1] * 8.0),
        turn.x * speed[2] * 6.0 + turn.y * speed[1] * 20.0 + turn.z * speed[0] * 4.0
            + sign * (turn.x * speed[3] * 12.0 + turn.y * speed[2] * 18.0),
    );
}

// Whether the solution's curvature rises throughout: YES, NO or OPEN.
fn spiral(curves: Curves, root: Root) -> u32 {
    let t = root.t.value;
    let z = root.z.value;
    let p = curves.scale.x;
    let q = curves.scale.y;
    let g = curves.cos;
    let t3 = t * t * t;
    let u = curves.bend.y * t3;
    let v = curves.bend.x;
    let square = u * (u + g * (2.0 * v)) + v * v;
    let speed = array<f32, 5>(
        p * p,
        z * (u + g * v) * p,
        // The number next to a third, off by less than a unit.
        (square * (z * z) * 2.0 + g * t * (p * q)) * 0.33333333,
        z * t * (v + g * u) * q,
        t * t * (q * q),
    );
    let backwards = array<f32, 5>(speed[4], speed[3], speed[2], speed[1], speed[0]);
    let turn = vec3<f32>(v * z * (2.0 * p), t * (p * q), u * t * z * (2.0 * q));
    let start = half_quintic(turn, speed, -1.0);
    let end = -half_quintic(turn.zyx, backwards, -1.0);
    let start_size = half_quintic(turn, speed, 1.0);
    let end_size = half_quintic(turn.zyx, backwards, 1.0);
    // t has the power 10 at most, Z the power 3.
    let relative = (10.0 * root.t.error + 3.0 * root.z.error) * POWERS + SHAPE;
    if !(relative < 0.25) {
        return OPEN;
    }
    let size = max(start_size, end_size);
    let largest = max(size.x, max(size.y, size.z));
    if !(largest < 1e30 && largest > 1e-15) {
        return OPEN;
    }
    // The outer coefficients are values of the quintic, and have smaller errors of their own.
    if start.x < -relative * start_size.x || end.x < -relative * end_size.x {
        return NO;
    }
    // The least and the greatest quintic: only one of them can answer.
    let low_start = start - relative * start_size;
    let low_end = end - relative * end_size;
    let rounding = 8.0 * UNIT * largest;
    if positive(Quintic(low_start, low_end), rounding, rounding) == YES {
        return YES;
    }
    let high_start = start + relative * start_size;
    let high_end = end + relative * end_size;
    if positive(Quintic(high_start, high_end), rounding, rounding) == NO {
        return NO;
    }
    return OPEN;
}
