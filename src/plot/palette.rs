//! All colours of the pictures, chosen by two rules that the tests check.
//!
//! Contrast is that of the Web Content Accessibility Guidelines 2.2: the ratio of the relative luminances, each plus
//! 0.05. It runs from 1 to 21. Lines, edges and signs have at least 3 to what is beside them (guideline 1.4.11), text
//! has at least 4.5 (1.4.3). The lines of curves and paths have a white casing, so white is what is beside them
//! wherever they lie.
//!
//! Colours that stand side by side in a legend also look different to readers without one kind of cones.

/// Red, green, blue.
pub(super) type Color = [u8; 3];

/// The paper.
pub(super) const WHITE: Color = [255, 255, 255];
/// Edges between regions that are both light.
const BLACK: Color = [0, 0, 0];
/// Text, axes, frames, signs, curves.
pub(super) const INK: Color = [34, 34, 34];
/// Small print, control polygons.
pub(super) const GREY: Color = [110, 110, 110];
/// The line at 0 in a graph.
pub(super) const PALE: Color = [140, 140, 140];
/// What goes wrong, and limits.
pub(super) const RED: Color = [210, 32, 32];
/// Polygons that paths lead among.
pub(super) const OBSTACLE: Color = [128, 128, 128];
/// What lies within the clearance of them.
pub(super) const GROWN: Color = [238, 228, 208];

/// Lines beside each other: the four of Okabe and Ito (2008) that are dark enough for white paper, then three darker
/// ones.
pub(super) const LINES: [Color; 7] =
    [[0, 114, 178], [213, 94, 0], [0, 158, 115], [204, 121, 167], [51, 34, 136], [120, 40, 0], INK];

/// Outlines of regions, in turn.
pub(super) const OUTLINES: [Color; 3] = [RED, [0, 90, 181], BLACK];

/// The least contrast of lines, edges and signs.
const LEAST: f64 = 3.0;

/// The colours of `count` nested regions, largest first: from light to dark, so that they stay apart without colour
/// and for colour-blind readers.
pub fn region_colors(count: usize) -> Vec<[u8; 3]> {
    const RAMP: [Color; 4] = [[226, 226, 226], [242, 188, 60], [38, 137, 152], [54, 26, 92]];
    // Left out of the way along the ramp: beside some darker colours, these would need an edge that neither black nor
    // white can be.
    const GAP: [f64; 2] = [1.28, 1.74];
    let picked: &[usize] = match count {
        0..=1 => &[2],
        2 => &[0, 1],
        3 => &[0, 1, 3],
        _ => &[0, 1, 2, 3],
    };
    if count <= 4 {
        return picked.iter().take(count).map(|&i| RAMP[i]).collect();
    }
    let mixed = |i: usize| {
        let at = (3.0 - (GAP[1] - GAP[0])) * i as f64 / (count - 1) as f64;
        let at = if at <= GAP[0] { at } else { at + GAP[1] - GAP[0] };
        let low = (at as usize).min(2);
        let mix = |c: usize| {
            let (a, b) = (f64::from(RAMP[low][c]), f64::from(RAMP[low + 1][c]));
            (a + (b - a) * (at - low as f64)).round() as u8
        };
        [mix(0), mix(1), mix(2)]
    };
    (0..count).map(mixed).collect()
}

/// The colour of the line that parts two fills of too little contrast; `None` where they have enough.
pub(super) fn edge(a: Color, b: Color) -> Option<Color> {
    let worse = |edge: Color| contrast(edge, a).min(contrast(edge, b));
    let clear = contrast(a, b) >= LEAST;
    (!clear).then(|| if worse(BLACK) >= worse(WHITE) { BLACK } else { WHITE })
}

/// The contrast of two colours, 1 to 21.
fn contrast(a: Color, b: Color) -> f64 {
    let [a, b] = [a, b].map(|c| luminance(c) + 0.05);
    a.max(b) / a.min(b)
}

/// Relative luminance of sRGB, 0 to 1.
fn luminance(color: Color) -> f64 {
    let [r, g, b] = color.map(linear);
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

fn linear(part: u8) -> f64 {
    let part = f64::from(part) / 255.0;
    if part <= 0.040_45 { part / 12.92 } else { ((part + 0.055) / 1.055).powf(2.4) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Most regions that a picture can tell apart: its levels may be more, but not usefully.
    const MOST_REGIONS: usize = 64;

    /// The least contrast over pairs of what is drawn and what is beside it, printed when too small.
    fn least(what: &str, bound: f64, pairs: impl IntoIterator<Item = (Color, Color)>) {
        let (ratio, pair) =
            pairs.into_iter().map(|pair| (contrast(pair.0, pair.1), pair)).min_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
        println!("{what}: {ratio:.2} of {pair:?}");
        assert!(ratio >= bound, "{what}: {pair:?} have the contrast {ratio:.3}, less than {bound}");
    }

    fn beside(drawn: &[Color], under: &[Color]) -> Vec<(Color, Color)> {
        drawn.iter().flat_map(|a| under.iter().map(|b| (*a, *b))).collect()
    }

    #[test]
    fn contrast_is_that_of_the_guidelines() {
        assert_eq!(contrast(BLACK, WHITE), 21.0);
        // Known value: #767676 is the lightest grey for text on white.
        assert!((contrast([0x76; 3], WHITE) - 4.54).abs() < 0.005);
        assert_eq!(contrast(RED, RED), 1.0);
    }

    #[test]
    fn text_is_legible() {
        least("text on paper", 4.5, beside(&[INK, GREY], &[WHITE]));
    }

    /// Lines and stripes of outlines, curves, paths, graphs and stars lie on white only: they bring it with them.
    #[test]
    fn lines_stand_out() {
        least("outlines in their casing", LEAST, beside(&OUTLINES, &[WHITE]));
        least("paths, graphs and circles in their casing", LEAST, beside(&LINES, &[WHITE]));
        least("curves, polygons and limits in their casing", LEAST, beside(&[INK, GREY, RED], &[WHITE]));
        least("frames, ticks and the line at 0 on paper", LEAST, beside(&[INK, PALE], &[WHITE]));
        // Where the curvature turns back, the red goes on from the black line of the graph.
        least("red after black", LEAST, beside(&[RED], &[INK]));
        least("curves and graphs across the line at 0", LEAST, beside(&[INK], &[PALE]));
    }

    /// Casing and line together are seen on what they lie on, too: one of them has the contrast. (Of more than four
    /// regions some are so middling that neither has; the line still stands out from its casing.)
    #[test]
    fn cased_lines_stand_out_from_what_is_under_them() {
        let regions: Vec<Color> = (0..=4).flat_map(region_colors).chain([WHITE]).collect();
        // Only the first path leads among obstacles, over the line that shows the way.
        let among = beside(&[LINES[0], GREY], &[WHITE, GROWN, OBSTACLE]);
        for (line, under) in beside(&OUTLINES, &regions).into_iter().chain(beside(&LINES, &[WHITE])).chain(among) {
            let best = contrast(line, under).max(contrast(WHITE, under));
            assert!(best >= LEAST, "{line:?} with a white casing on {under:?}: {best:.3}");
        }
    }

    /// Fills that may touch differ enough, or an edge parts them that differs from both.
    #[test]
    fn fills_are_parted() {
        let mut edged = 0;
        for count in 1..=MOST_REGIONS {
            let fills = [vec![WHITE], region_colors(count)].concat();
            for (i, a) in fills.iter().enumerate() {
                for b in &fills[..i] {
                    let ratio = edge(*a, *b).map_or(contrast(*a, *b), |e| contrast(e, *a).min(contrast(e, *b)));
                    assert!(ratio >= LEAST, "{a:?} beside {b:?} of {count} regions: {ratio:.3}");
                    // A last bit of `powf`, which may differ between machines, decides nothing.
                    assert!(count > 8 || (contrast(*a, *b) - LEAST).abs() > 1e-6);
                    edged += usize::from(edge(*a, *b).is_some());
                }
            }
        }
        assert!(edged > 0);
        least("obstacles and frames beside the clearance and paper", LEAST, beside(&[OBSTACLE, GREY], &[WHITE, GROWN]));
        // A frame on a dark fill is not needed: the fill itself ends at the paper.
        for fill in (1..=MOST_REGIONS).flat_map(region_colors) {
            assert!(contrast(INK, fill).max(contrast(fill, WHITE)) >= LEAST, "{fill:?}");
        }
    }

    /// How a colour looks to readers without one kind of cones (Machado, Oliveira & Fernandes 2009, severity 1), as CIE
    /// L*a*b*.
    fn lab(color: Color, cones: &[[f64; 3]; 3]) -> [f64; 3] {
        let [r, g, b] = color.map(linear);
        let seen = cones.map(|row| (row[0] * r + row[1] * g + row[2] * b).clamp(0.0, 1.0));
        let to_xyz = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]];
        let white = [0.950_47, 1.0, 1.088_83];
        let f = |i: usize| {
            let t = to_xyz[i].iter().zip(seen).map(|(m, c)| m * c).sum::<f64>() / white[i];
            if t > 0.008_856 { t.cbrt() } else { 7.787 * t + 16.0 / 116.0 }
        };
        [116.0 * f(1) - 16.0, 500.0 * (f(0) - f(1)), 200.0 * (f(1) - f(2))]
    }

    #[test]
    fn colour_blind_readers_tell_lines_apart() {
        let readers = [
            [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            [
                [0.152_286, 1.052_583, -0.204_868],
                [0.114_503, 0.786_281, 0.099_216],
                [-0.003_882, -0.048_116, 1.051_998],
            ],
            [[0.367_322, 0.860_646, -0.227_968], [0.280_085, 0.672_501, 0.047_413], [-0.011_820, 0.042_940, 0.968_881]],
            [
                [1.255_528, -0.076_749, -0.178_779],
                [-0.078_411, 0.930_809, 0.147_602],
                [0.004_733, 0.691_367, 0.303_900],
            ],
        ];
        for (what, colors) in [("lines", &LINES[..]), ("outlines", &OUTLINES), ("regions", &region_colors(4))] {
            for (i, a) in colors.iter().enumerate() {
                for b in &colors[..i] {
                    for cones in &readers {
                        let (p, q) = (lab(*a, cones), lab(*b, cones));
                        let apart = p.iter().zip(q).map(|(x, y)| (x - y).powi(2)).sum::<f64>().sqrt();
                        // Okabe and Ito's own eight colours come as near as 16; 2 is what a trained eye just tells
                        // apart.
                        assert!(apart > 16.0, "{what}: {a:?} and {b:?} are {apart:.1} apart");
                    }
                }
            }
        }
    }
}
