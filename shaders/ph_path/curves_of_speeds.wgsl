// Given end speeds: w0 and w2 as they are, and the root of Z = 120 - 15 w0^2 - 15 w2^2 + 10 w0 w2.

// offsets: first pair of the chunk, where the axes of l0 and l1 begin.
fn ends(index: vec4<u32>, other: bool) -> Ends {
    let units = read_units((index.x * params.shape.y + index.y - params.offsets.x) * UNITS_WORDS);
    let a = inputs[params.offsets.y + index.z];
    let b = inputs[params.offsets.z + index.w];
    let usable = units.usable && a > 0.0 && b > 0.0;
    let w0 = a * units.first;
    let w2 = select(b, -b, other) * units.last;
    // Two roundings of the factors, one of the product.
    let error = COVER * 3.0 * UNIT * max(a, b);
    let z = vec2<f32>(120.0, 0.0) - 15.0 * (product(w0, w0) + product(w2, w2)) + 10.0 * product(w0, w2);
    let size = 120.0 + 16.0 * (a * a + b * b) + 10.0 * a * b;
    let root = complex_root(z);
    let length = modulus(root);
    // y^2 - Z = (y - r)(y + r), and one of both factors is at least |y|. `length` is |y| times MODULUS at most, and
    // COVER is more than that. The terms of Z are off by 13 units: products of two w of three units each, and seven
    // roundings.
    let off = modulus(product(root, root) - z) + 24.0 * UNIT * size + 8.0 * UNIT * length * length;
    let root_error = COVER * off / max(length, 1e-10);
    return Ends(w0, w2, error, root, root_error, usable && root_error < 0.1 * length);
}
