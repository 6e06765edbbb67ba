//! What lies beside what in a drawn slice: each line and edge has at least 3 times the contrast of the Web Content
//! Accessibility Guidelines.

use super::{axis, decode, slice_png, spaced};
use spiral_atlas::plot::*;

const LEAST: f64 = 3.0;

fn contrast(a: [u8; 3], b: [u8; 3]) -> f64 {
    let luminance = |color: [u8; 3]| {
        let part = |c: u8| {
            let c = f64::from(c) / 255.0;
            if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
        };
        0.2126 * part(color[0]) + 0.7152 * part(color[1]) + 0.0722 * part(color[2]) + 0.05
    };
    let (a, b) = (luminance(a), luminance(b));
    a.max(b) / a.min(b)
}

/// Nested regions side by side in bands, so that each touches the next and, in the lower half, the paper; and outlines
/// across all.
fn bands(regions: usize, outlines: usize) -> Slice {
    let (columns, rows) = (2 * (regions + 1), 24);
    let region = |k: usize| {
        let inside = |node: usize| (node % columns) / 2 > k && !(node / columns).is_multiple_of(4);
        Region::of_nodes(format!("region {k}"), (0..columns * rows).map(inside).collect())
    };
    let outline = |k: usize| {
        let inside = |node: usize| (3 * k + 7..3 * k + 9).contains(&(node / columns));
        Region::of_nodes(format!("outline {k}"), (0..columns * rows).map(inside).collect())
    };
    Slice {
        title: "Bands".into(),
        x: axis("kappa0", spaced(0.0, 1.0, columns), false),
        y: axis("kappa1", spaced(0.0, 1.0, rows), false),
        regions: (0..regions).map(region).collect(),
        outlines: (0..outlines).map(outline).collect(),
        marks: Vec::new(),
        note: String::new(),
        counted: "node",
    }
}

/// All pairs of different colours of a list that lie beside each other in a picture's middle: letters around it have
/// rims of all shades.
fn neighbours(picture: &image::RgbImage, colors: &[[u8; 3]]) -> Vec<([u8; 3], [u8; 3])> {
    let (width, height) = picture.dimensions();
    let mut pairs = Vec::new();
    for y in height * 3 / 20..height * 13 / 20 {
        for x in width * 3 / 20..width * 18 / 20 {
            let here = picture.get_pixel(x, y).0;
            for there in [picture.get_pixel(x + 1, y).0, picture.get_pixel(x, y + 1).0] {
                if here != there && colors.contains(&here) && colors.contains(&there) && !pairs.contains(&(here, there))
                {
                    pairs.push((here, there));
                }
            }
        }
    }
    pairs
}

#[test]
fn regions_of_too_little_contrast_are_parted() {
    for (regions, size) in [(2, (900, 700)), (4, (900, 700)), (6, (1200, 900)), (9, (1500, 900)), (4, (2000, 1600))] {
        let picture = decode(&slice_png(&bands(regions, 0), size).unwrap());
        let fills = [region_colors(regions), vec![[255; 3]]].concat();
        for (a, b) in neighbours(&picture, &fills) {
            assert!(contrast(a, b) >= LEAST, "{regions} regions: {a:?} beside {b:?} have {:.2}", contrast(a, b));
        }
        let all = [fills.clone(), vec![[0; 3]]].concat();
        let edges = neighbours(&picture, &all).into_iter().filter(|(a, b)| *a == [0; 3] || *b == [0; 3]).count();
        assert!(edges >= 4, "edges are drawn");
    }
}

#[test]
fn outlines_stand_out_from_every_region() {
    for (outlines, size) in [(1, (900, 700)), (3, (900, 700)), (5, (1500, 1200))] {
        let picture = decode(&slice_png(&bands(4, outlines), size).unwrap());
        let (fills, lines) = (region_colors(4), [[210, 32, 32], [0, 90, 181], [0, 0, 0]][..outlines.min(3)].to_vec());
        let drawn = |color: &[u8; 3]| picture.pixels().filter(|p| p.0 == *color).count() > 500;
        assert!(lines.iter().all(drawn));
        let pairs = neighbours(&picture, &[fills, lines.clone(), vec![[255; 3]]].concat());
        let beside: Vec<_> = pairs.iter().filter(|(a, b)| lines.contains(a) != lines.contains(b)).collect();
        assert!(!beside.is_empty());
        for (a, b) in beside {
            assert!(contrast(*a, *b) >= LEAST, "{a:?} beside {b:?} have {:.2}", contrast(*a, *b));
        }
    }
}
