// Signs of a quintic in Bernstein form on [0, 1]; twin of num/bernstein.rs in f32.

// Coefficients 0, 1, 2, and from the other end 5, 4, 3.
struct Quintic {
    start: vec3<f32>,
    end: vec3<f32>,
}

// Most halvings of a piece. A piece of 2^-10 shows features that the error of f32 coefficients does not hide anyway.
const MOST_HALVINGS: u32 = 10u;

// Halvings and looks in all; what needs more is left to f64.
const MOST_ROUNDS: u32 = 200u;

// The left or the right half of a piece, by de Casteljau's algorithm. Each coefficient comes of up to five steps.
fn half_of(c: Quintic, right: bool) -> Quintic {
    let a = c.start;
    let f = c.end;
    // A row a step, each entry by its distance from the start.
    let r1 = 0.5 * (a + vec3<f32>(a.yz, f.z));
    let s1 = 0.5 * (f.xy + f.yz);
    let r2 = 0.5 * (r1 + vec3<f32>(r1.yz, s1.y));
    let s2 = 0.5 * (s1.x + s1.y);
    let r3 = 0.5 * (r2 + vec3<f32>(r2.yz, s2));
    let r4 = 0.5 * (r3.xy + r3.yz);
    let r5 = 0.5 * (r4.x + r4.y);
    return Quintic(
        select(vec3<f32>(a.x, r1.x, r2.x), vec3<f32>(r5, r4.y, r3.z), right),
        select(vec3<f32>(r5, r4.x, r3.x), vec3<f32>(f.x, s1.x, s2), right),
    );
}

// YES, NO (negative somewhere), or OPEN, for coefficients that may each be off by `error`; each halving adds
// `rounding`: five steps of one addition, exactly halved.
//
// Pieces are looked at from left to right. None waits in memory, which registers cannot index: the next one is made
// anew from the whole, a halving a round, as the digits of its place say.
fn positive(whole: Quintic, error: f32, rounding: f32) -> u32 {
    var answer = YES;
    var piece = whole;
    var depth = 0u;
    // The piece to be looked at: number `place` of 2^level.
    var level = 0u;
    var place = 0u;
    for (var round = 0u; round < MOST_ROUNDS; round += 1u) {
        if depth < level {
            depth += 1u;
            piece = half_of(piece, ((place >> (level - depth)) & 1u) == 1u);
        }
        if depth == level {
            let e = error + rounding * f32(level);
            // The outer coefficients are values of the quintic.
            if piece.start.x < -e || piece.end.x < -e {
                return NO;
            }
            let lowest = min(piece.start, piece.end);
            let certain = max(abs(piece.start), abs(piece.end));
            let above = min(lowest.x, min(lowest.y, lowest.z)) > e;
            let split = level < MOST_HALVINGS && max(certain.x, max(certain.y, certain.z)) > e;
            if !above && split {
                level += 1u;
                place *= 2u;
                continue;
            }
            answer = select(OPEN, answer, above);
            // On to the next piece, as large as it may be.
            place += 1u;
            let wider = firstTrailingBit(place);
            place >>= wider;
            level -= wider;
            if level == 0u {
                return answer;
            }
            piece = whole;
            depth = 0u;
        }
    }
    return OPEN;
}
