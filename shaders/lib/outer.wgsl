// The outer bound of every spiral region; twin of family/outer.rs in f32. `error` is as there.

// (sin phi0 - kappa0)(kappa1 - sin phi1) > sin^2((phi1 - phi0)/2), both factors positive; `sines` in this order.
fn any_spiral(sines: vec3<f32>, kappa0: f32, kappa1: f32, error: f32) -> u32 {
    let room0 = sines.x - kappa0;
    let room1 = kappa1 - sines.y;
    let error0 = (abs(sines.x) + abs(kappa0)) * error;
    let error1 = (abs(sines.y) + abs(kappa1)) * error;
    let product = room0 * room1;
    let over = product - sines.z;
    let whole = abs(room0) * error1 + abs(room1) * error0 + error0 * error1 + (abs(product) + sines.z) * error;
    if over > whole && room0 > 0.0 {
        return YES;
    }
    if over < -whole || room0 < -error0 || room1 < -error1 {
        return NO;
    }
    return OPEN;
}
