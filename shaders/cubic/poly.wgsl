// Twin of family/cubic/poly.rs in f32.

// B0, B1, B2 of poly.rs.
fn side(x: f32, y: f32, p: f32, g: f32, r: f32) -> vec3<f32> {
    let u = 3.0 - x;
    let u2 = u * u;
    let xu = x * u;
    let b0 = 2.0 * (p * u2) + g * (2.0 * xu + y * (3.0 * x - 10.0));
    let b1_p = 2.0 * (u * (2.0 * (u * (x + 3.0)) + y * (7.0 * x - 17.0)));
    let b1_g = (2.0 * xu) * (2.0 * x - 7.0 * y) + (y * y) * (22.0 - 9.0 * x);
    let b1 = p * b1_p + g * b1_g + 4.0 * (r * (u2 * u));
    let x5 = 5.0 * x;
    let b2_p = u * (x * (x5 + 3.0) - 6.0) + y * (x * (2.0 * x5 - 32.0) + 12.0);
    let b2_g = (x * x) * (x5 - 12.0) + y * (x * (12.0 - 2.0 * x5) + y * (x5 - 2.0));
    let b2 = p * b2_p + g * b2_g + r * (u2 * (x5 - 2.0));
    return vec3<f32>(b0, b1, b2);
}
