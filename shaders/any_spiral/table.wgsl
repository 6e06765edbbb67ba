// Any spiral at all, in f32: twin of family/any_spiral/table.rs. The outer bound is decided with an error bound; the
// order and the signs of the curvatures are exact, by index and because rounding keeps signs.

// offsets: first pair of the chunk, where axes 2 and 3 begin.
fn evaluate(index: vec4<u32>) -> u32 {
    // Unsigned differences are right even where the products wrap around.
    let pair = read_pair((index.x * params.shape.y + index.y - params.offsets.x) * PAIR_WORDS);
    let first = read_first(params.offsets.y + index.z * FIRST_WORDS);
    let side = pair.side;
    let k1 = first.k1;
    let k2 = inputs[params.offsets.z + index.w];
    if !pair.usable || abs(k1) > MOST || abs(k2) > MOST {
        return UNDECIDED;
    }
    let falling = f32(index.w) < first.below;
    let rising = f32(index.w) >= first.upto;
    let flags = select(0u, RISING, rising);
    // omega must have the sign of k2 - k1.
    if !(side > 0.0 && rising || side < 0.0 && falling) {
        return flags;
    }
    let any = any_spiral(pair.sines, side * k1, side * k2, OUTER);
    if any == OPEN {
        return UNDECIDED;
    }
    let opposite = k1 < 0.0 && k2 > 0.0 || k1 > 0.0 && k2 < 0.0;
    return flags | select(0u, EXISTS, any == YES) | select(0u, INFLECTION, any == YES && opposite);
}
