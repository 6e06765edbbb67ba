// PH quintics with G2 Hermite ends in f32: these files are twins of those in family/ph_quintic, function by function.
// Constants (UNIT, TERM, HEIGHT, ...) and records are generated from shader.rs; factors.rs proves the factors. Proofs
// use + - * and comparisons; guesses, and quotients whose last bits do not matter, use / and sqrt, kept finite by
// clamps. Relative bounds count roundings, so they hold with fused multiply-adds and reassociation; the ranges of the
// constants and of z and t keep every term that matters above the denormals.

// The equations, scaled; vectors hold both ends.
struct Curves {
    scale: vec2<f32>,
    bend: vec2<f32>,
    cos: f32,
    right: vec2<f32>,
    flat: vec2<f32>,
    own: vec2<f32>,
    across: vec2<f32>,
    both: f32,
    last: vec2<f32>,
}

fn curves_of(scale: vec2<f32>, bend: vec2<f32>, cosine: f32, right: vec2<f32>) -> Curves {
    let c = 2.0 * cosine;
    return Curves(
        scale,
        bend,
        cosine,
        right,
        3.0 * c * scale * scale,
        3.0 * bend * scale,
        3.0 * c * bend * scale.yx,
        4.0 * bend.x * bend.y,
        2.0 * c * bend * bend,
    );
}

// A left-hand side at one t: c.x Z + c.y Z^2 + c.z Z^3, and each term times its power of t.
struct Cubic {
    c: vec3<f32>,
    j: vec3<f32>,
}

// A positive number and its relative error; 1 where nothing is known.
struct Near {
    value: f32,
    error: f32,
}

fn height(c: vec3<f32>, right: f32) -> Near {
    // Down from the least height that one term alone would need.
    let least = max(c, vec3<f32>(1e-20));
    var z = min(min(right / least.x, sqrt(right / least.y)), exp2(log2(right / least.z) * 0.33333333));
    z = clamp(z, LEAST_Z, MOST_Z);
    for (var i = 0u; i < 12u; i += 1u) {
        let rise = max((3.0 * c.z * z + 2.0 * c.y) * z + c.x, 1e-20);
        let step = (((c.z * z + c.y) * z + c.x) * z - right) / rise;
        z = clamp(z - step, LEAST_Z, MOST_Z);
        if abs(step) <= z * 1e-4 {
            break;
        }
    }
    let off = abs(((c.z * z + c.y) * z + c.x) * z - right);
    let relative = off / right * HEIGHT + TERM;
    // At the rim of the range nothing is known, nor where the residual is too large for the factor.
    return Near(z, select(1.0, relative, relative < FAR && z > LEAST_Z && z < MOST_Z));
}
