// Any spiral at all, in f32: twin of family/any_spiral/table.rs. The outer bound is decided with an error bound; the order
// and the signs of the curvatures are exact, by index and because rounding keeps signs.

// offsets: first pair of the chunk, where axes 2 and 3 begin.
fn evaluate(index: vec4<u32>) -> u32 {
    // Unsigned differences are right even where the products wrap around.
    let pair = (index.x * params.shape.y + index.y - params.offsets.x) * PAIR_STRIDE;
    let sines = vec3<f32>(inputs[pair], inputs[pair + 1u], inputs[pair + 2u]);
    let side = inputs[pair + 3u];
    let usable = inputs[pair + 4u] > 0.0;
    let first = params.offsets.y + index.z * FIRST_STRIDE;
    let k1 = inputs[first];
    let k2 = inputs[params.offsets.z + index.w];
    if !usable || abs(k1) > MOST || abs(k2) > MOST {
        return UNDECIDED;
    }
    let falling = f32(index.w) < inputs[first + 1u];
    let rising = f32(index.w) >= inputs[first + 2u];
    let flags = select(0u, RISING, rising);
    // omega must have the sign of k2 - k1.
    if !(side > 0.0 && rising || side < 0.0 && falling) {
        return flags;
    }
    let any = any_spiral(sines, side * k1, side * k2, OUTER);
    if any == OPEN {
        return UNDECIDED;
    }
    let opposite = k1 < 0.0 && k2 > 0.0 || k1 > 0.0 && k2 < 0.0;
    return flags | select(0u, EXISTS, any == YES) | select(0u, INFLECTION, any == YES && opposite);
}
