// Signs of a quintic in Bernstein form on [0, 1]; twin of num/bernstein.rs in f32.

// Most halvings of a piece. A piece of 2^-10 shows features that the error of f32 coefficients does not hide anyway.
const MOST_HALVINGS: u32 = 10u;

// YES, NO (negative somewhere), or OPEN, for coefficients that may each be off by `error`; each halving adds
// `rounding`: five steps of one addition, exactly halved.
fn positive(coefficients: array<f32, 6>, error: f32, rounding: f32) -> u32 {
    // Depth first with the right halves waiting: one a level, and the piece in hand.
    var waiting: array<array<f32, 6>, 12>;
    var levels: array<u32, 12>;
    waiting[0] = coefficients;
    levels[0] = 0u;
    var count = 1u;
    var answer = YES;
    loop {
        if count == 0u {
            break;
        }
        count -= 1u;
        var piece = waiting[count];
        let level = levels[count];
        let e = error + rounding * f32(level);
        // The outer coefficients are values of the quintic.
        if piece[0] < -e || piece[5] < -e {
            return NO;
        }
        var certain = 0u;
        var above = 0u;
        for (var i = 0u; i < 6u; i += 1u) {
            above += u32(piece[i] > e);
            certain += u32(abs(piece[i]) > e);
        }
        if above == 6u {
            continue;
        }
        if level == MOST_HALVINGS || certain == 0u {
            answer = OPEN;
            continue;
        }
        var left = piece;
        for (var step = 1u; step < 6u; step += 1u) {
            left[step - 1u] = piece[0];
            for (var i = 0u; i < 6u - step; i += 1u) {
                piece[i] = (piece[i] + piece[i + 1u]) * 0.5;
            }
        }
        left[5] = piece[0];
        waiting[count] = piece;
        levels[count] = level + 1u;
        waiting[count + 1u] = left;
        levels[count + 1u] = level + 1u;
        count += 2u;
    }
    return answer;
}
