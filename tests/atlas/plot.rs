//! Pictures: every node's colour at its place, errors for bad data, the same bytes each time. The pictures drawn here
//! lie in the target folder's `tmp` afterwards, to be looked at.

mod contrast;
mod curves;
mod svg;

use super::crude::{cubic_slice, spaced};
use spiral_atlas::Result;
use spiral_atlas::files::write_file;
use spiral_atlas::plot::*;
use std::path::Path;

fn slice_png(slice: &Slice, size: (u32, u32)) -> Result<Vec<u8>> {
    draw_slice(slice, size)?.png()
}

fn multiples_png(figure: &Multiples, size: (u32, u32)) -> Result<Vec<u8>> {
    draw_multiples(figure, size)?.png()
}

fn decode(png: &[u8]) -> image::RgbImage {
    image::load_from_memory(png).expect("a PNG").to_rgb8()
}

fn axis(name: &str, values: Vec<f64>, log: bool) -> AxisView {
    AxisView { name: name.into(), label: symbol(name), values, log }
}

fn spaced_log(lo: f64, hi: f64, count: usize) -> Vec<f64> {
    spaced(lo.ln(), hi.ln(), count).into_iter().map(f64::exp).collect()
}

fn save(name: &str, png: &[u8]) {
    write_file(&Path::new(env!("CARGO_TARGET_TMPDIR")).join(name), png).expect("the target folder is writable");
}

/// Two regions on axes of different length and spacing: all nodes, and an arbitrary set that no flip or turn keeps.
fn pattern() -> Slice {
    let x = axis("kappa0", vec![0.0, 1.0, 2.0, 6.0, 7.0, 11.0, 12.0], false);
    let y = axis("kappa1", vec![1.0, 2.0, 16.0, 64.0], true);
    let chosen = |k: usize| (k * k * 7 + k * 3) % 11 < 4;
    Slice {
        title: "Pattern".into(),
        regions: vec![
            Region::of_nodes("all", vec![true; 28]),
            Region::of_nodes("chosen", (0..28).map(chosen).collect()),
        ],
        outlines: Vec::new(),
        marks: Vec::new(),
        note: String::new(),
        counted: "node",
        x,
        y,
    }
}

/// The largest rectangle of the two colours: the plot, not the legend. (left, top, right, bottom), inclusive.
fn plot_rect(picture: &image::RgbImage, colors: &[[u8; 3]]) -> (u32, u32, u32, u32) {
    let ours = |x: u32, y: u32| colors.contains(&picture.get_pixel(x, y).0);
    let (w, h) = picture.dimensions();
    let full: Vec<u32> = (0..h).filter(|y| (0..w).filter(|x| ours(*x, *y)).count() as u32 > w / 2).collect();
    let (top, bottom) = (full[0], full[full.len() - 1]);
    let row: Vec<u32> = (0..w).filter(|x| ours(*x, (top + bottom) / 2)).collect();
    (row[0], top, row[row.len() - 1], bottom)
}

/// Number of nodes whose colour, a little inside all four edges of their cells, is not what the mask says.
fn wrong_nodes(png: &[u8], mask: &[bool]) -> (usize, usize) {
    let picture = decode(png);
    let colors = region_colors(2);
    let (left, top, right, bottom) = plot_rect(&picture, &colors);
    // Edges of the cells of `pattern` half way between nodes: in values along x, in powers of 2 along y.
    let x_edges = [-0.5, 0.5, 1.5, 4.0, 6.5, 9.0, 11.5, 12.5];
    let y_edges = [-0.5, 0.5, 2.5, 5.0, 7.0];
    let place = |edges: &[f64], i: usize, low: f64, high: f64| {
        let (first, last) = (edges[0], edges[edges.len() - 1]);
        [0.15, 0.5, 0.85].map(|part| {
            let value = edges[i] + (edges[i + 1] - edges[i]) * part;
            (low + (value - first) / (last - first) * (high - low)) as u32
        })
    };
    let (mut compared, mut wrong) = (0, 0);
    for j in 0..4 {
        for i in 0..7 {
            let expected = colors[usize::from(mask[j * 7 + i])];
            let xs = place(&x_edges, i, f64::from(left), f64::from(right + 1));
            let ys = place(&y_edges, j, f64::from(bottom + 1), f64::from(top));
            let seen = xs.iter().flat_map(|x| ys.iter().map(|y| picture.get_pixel(*x, *y).0));
            wrong += usize::from(seen.into_iter().any(|color| color != expected));
            compared += 1;
        }
    }
    (compared, wrong)
}

#[test]
fn every_node_has_its_colour_at_its_place() {
    let slice = pattern();
    let mask = &slice.regions[1].mask;
    for size in [(640, 480), (400, 700), (1111, 333)] {
        let png = slice_png(&slice, size).unwrap();
        assert_eq!(wrong_nodes(&png, mask), (28, 0), "{size:?}");
        // The comparison sees a flip in x, a flip in y, a transposition, and one changed node.
        let at = |f: &dyn Fn(usize, usize) -> usize| (0..28).map(|k| mask[f(k % 7, k / 7)]).collect::<Vec<_>>();
        assert!(wrong_nodes(&png, &at(&|i, j| j * 7 + 6 - i)).1 > 4);
        assert!(wrong_nodes(&png, &at(&|i, j| (3 - j) * 7 + i)).1 > 4);
        assert!(wrong_nodes(&png, &at(&|i, j| i * 4 + j)).1 > 4);
        let mut flipped = mask.clone();
        flipped[9] = !flipped[9];
        assert_eq!(wrong_nodes(&png, &flipped), (28, 1));
    }
}

#[test]
fn a_mark_lies_at_its_coordinates() {
    let mut slice = pattern();
    slice.regions[1].mask = vec![false; 28];
    let plain = decode(&slice_png(&slice, (640, 480)).unwrap());
    slice.marks = vec![Mark { x: 9.0, y: 4.0, label: String::new() }];
    let marked = decode(&slice_png(&slice, (640, 480)).unwrap());
    let (left, top, right, bottom) = plot_rect(&plain, &region_colors(2));
    let changed: Vec<(u32, u32)> =
        plain.enumerate_pixels().filter(|(x, y, p)| marked.get_pixel(*x, *y) != *p).map(|(x, y, _)| (x, y)).collect();
    assert!(changed.len() > 50, "nothing drawn");
    let mean =
        |pick: fn(&(u32, u32)) -> u32| changed.iter().map(|p| f64::from(pick(p))).sum::<f64>() / changed.len() as f64;
    let x = f64::from(left) + (9.0 + 0.5) / 13.0 * f64::from(right + 1 - left);
    let y = f64::from(bottom + 1) - (2.0 + 0.5) / 7.5 * f64::from(bottom + 1 - top);
    assert!((mean(|p| p.0) - x).abs() < 2.0 && (mean(|p| p.1) - y).abs() < 2.0, "{} {}", mean(|p| p.0), mean(|p| p.1));
    slice.marks[0].x = 1e9;
    assert_eq!(decode(&slice_png(&slice, (640, 480)).unwrap()), plain, "a mark outside is not drawn");
}

#[test]
fn an_outline_hides_no_cell() {
    let mut slice = pattern();
    let mask = slice.regions[1].mask.clone();
    let inverse: Vec<bool> = mask.iter().map(|inside| !inside).collect();
    slice.regions[1].mask = mask.clone();
    let before = slice_png(&slice, (900, 700)).unwrap();
    slice.outlines = vec![Region::of_nodes("the others", inverse)];
    let after = slice_png(&slice, (900, 700)).unwrap();
    assert_ne!(before, after);
    let (picture, colors) = (decode(&after), region_colors(2));
    let count = |color: [u8; 3]| picture.pixels().filter(|p| p.0 == color).count();
    let plain = decode(&before);
    for color in colors {
        let whole = plain.pixels().filter(|p| p.0 == color).count();
        assert!(count(color) * 2 > whole, "{} of {whole}", count(color));
    }
}

#[test]
fn bad_data_are_errors() {
    let size = (640, 480);
    type Spoil = fn(&mut Slice);
    let cases: [(Spoil, &str); 12] = [
        (|s| s.x.values.clear(), "no values"),
        (|s| s.y.values[0] = f64::NAN, "finite"),
        (|s| s.y.values[0] = 0.0, "above 0"),
        (|s| s.x.values[1] = f64::INFINITY, "finite"),
        (|s| s.x.values[2] = 1.0, "increase"),
        (|s| s.x.values.reverse(), "increase"),
        (|s| s.x.values = vec![-f64::MAX, -1.0, 0.0, 1.0, 2.0, 3.0, f64::MAX], "increase"),
        (|s| s.regions[1].mask.truncate(27), "27 nodes"),
        (|s| s.regions[0].mask.push(true), "29 nodes"),
        (|s| s.outlines.push(Region::of_nodes("o", vec![])), "0 nodes"),
        (|s| s.marks.push(Mark { x: f64::NAN, y: 1.0, label: "m".into() }), "mark `m`"),
        (|s| s.y.values.truncate(3), "28 nodes"),
    ];
    for (spoil, says) in cases {
        let mut slice = pattern();
        spoil(&mut slice);
        let message = slice_png(&slice, size).expect_err(says).to_string();
        assert!(message.contains(says), "{message}");
        let figure = Multiples {
            title: String::new(),
            note: String::new(),
            shape: [1, 1],
            columns: vec![],
            rows: vec![],
            panels: vec![slice],
        };
        assert!(multiples_png(&figure, size).is_err(), "{says}");
    }
    for size in [(0, 480), (640, 0), (1, 1), (60, 50), (u32::MAX, u32::MAX), (u32::MAX, 1)] {
        assert!(slice_png(&pattern(), size).is_err(), "{size:?}");
    }
    assert!(slice_png(&pattern(), size).is_ok());
}

#[test]
fn odd_but_legal_data_are_drawn() {
    let mut slice = pattern();
    slice.regions = vec![Region::of_nodes("only", vec![true])];
    for (x, y) in [(0.0, 1.0), (1e300, 1e-300), (-5e-324, 5e-324)] {
        slice.x.values = vec![x];
        slice.y.values = vec![y];
        slice_png(&slice, (300, 300)).unwrap();
    }
    slice.title = "a very long title, longer than the picture is wide ".repeat(9);
    slice.note = "漢字\n\u{0}\u{202e}".into();
    slice.x.label = "label".repeat(99);
    slice.regions = vec![Region::of_nodes("region".repeat(99), vec![true]); 9];
    slice_png(&slice, (500, 600)).unwrap();
    slice.regions.clear();
    slice.x.values = vec![1.0, 1.0 + f64::EPSILON];
    slice_png(&slice, (300, 300)).unwrap();
}

#[test]
fn region_colours_go_from_light_to_dark() {
    for count in 0..9 {
        let colors = region_colors(count);
        assert_eq!(colors.len(), count);
        let light = |c: &[u8; 3]| 0.2126 * f64::from(c[0]) + 0.7152 * f64::from(c[1]) + 0.0722 * f64::from(c[2]);
        let least = if count <= 4 { 25.0 } else { 5.0 };
        assert!(colors.windows(2).all(|w| light(&w[0]) - light(&w[1]) > least), "{colors:?}");
    }
}

#[test]
fn names_become_formulas() {
    let names = ["phi0", "phi1", "kappa0", "kappa1", "a", "k", "f1", "anything2", "", "7"];
    let symbols = ["φ₀", "φ₁", "κ₀", "κ₁", "a", "k", "f₁", "anything2", "", "7"];
    assert_eq!(names.map(symbol), symbols);
}

#[test]
fn files_are_written_whole() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.png");
    write_file(&path, b"first").unwrap();
    write_file(&path, b"second").unwrap();
    assert_eq!(std::fs::read(&path).unwrap(), b"second");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "nothing left beside it");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        let plain = folder.path().join("plain");
        std::fs::write(&plain, b"").unwrap();
        let mode = |p: &Path| std::fs::metadata(p).unwrap().permissions().mode();
        assert_eq!(mode(&path), mode(&plain), "readable like any other file");
    }
    let missing = folder.path().join("missing/a.png");
    let message = write_file(&missing, b"x").unwrap_err().to_string();
    assert!(message.contains("missing"), "{message}");
}

#[test]
fn a_real_slice() {
    let x = axis("kappa0", spaced(0.005, 0.705, 106), false);
    let y = axis("kappa1", spaced_log(0.8, 60.0, 81), true);
    let mut slice = cubic_slice(0.7, 1.4, x, y);
    slice.x.label = "κ₀ (start curvature × half chord)".into();
    slice.y.label = "κ₁ (end curvature × half chord)".into();
    slice.marks = vec![Mark { x: 0.4, y: 4.0, label: "the paper's example".into() }];
    let png = slice_png(&slice, (1200, 900)).unwrap();
    save("slice.png", &png);
    let small = slice_png(&slice, (480, 400)).unwrap();
    save("slice_small.png", &small);
    assert!(slice_png(&slice, (480, 400)).unwrap() == small, "the same data give the same bytes");
    slice.marks[0].x = 0.41;
    assert!(slice_png(&slice, (480, 400)).unwrap() != small, "so that the line above can fail");
    let counts: Vec<usize> = slice.regions.iter().map(|r| r.mask.iter().filter(|m| **m).count()).collect();
    assert!(counts.windows(2).all(|w| w[0] >= w[1]) && counts[3] > 0, "{counts:?}");
}

fn overview(columns: usize, rows: usize) -> Multiples {
    let p0 = spaced(0.2, 1.2, rows);
    let p1 = spaced(0.4, 1.5, columns);
    let panel = |p0: f64, p1: f64| {
        let x = axis("kappa0", spaced_log(0.01, 1.0, 30), true);
        let y = axis("kappa1", spaced_log(0.3, 300.0, 36), true);
        let mut slice = cubic_slice(p0, p1, x, y);
        slice.title.clear();
        slice.note.clear();
        if p0 == 0.2 && p1 == 1.5 {
            slice.marks = vec![Mark { x: 0.1, y: 100.0, label: "somewhere".into() }];
        }
        slice
    };
    Multiples {
        title: "Cubic spirals over all angles".into(),
        note: "Each panel: which end curvatures κ₀ (right) and κ₁ (up) can be joined.".into(),
        shape: [rows, columns],
        columns: vec![Caption { name: "φ₁ =".into(), values: p1.iter().map(|p| (format!("{p:.3}"), 1)).collect() }],
        rows: vec![Caption {
            name: "φ₀ =".into(), values: p0.iter().rev().map(|p| (format!("{p:.3}"), 1)).collect()
        }],
        panels: p0.iter().rev().flat_map(|p0| p1.iter().map(|p1| panel(*p0, *p1))).collect(),
    }
}

#[test]
fn multiples_share_axes_and_legend() {
    let figure = overview(4, 4);
    save("multiples_4x4.png", &multiples_png(&figure, (1200, 1100)).unwrap());
    assert!(
        multiples_png(&figure, (600, 500)).unwrap() == multiples_png(&figure, (600, 500)).unwrap(),
        "the same data give the same bytes"
    );
    save("multiples_8x6.png", &multiples_png(&overview(8, 6), (1600, 1200)).unwrap());
    let mut wrong = figure.clone();
    wrong.rows[0].values.pop();
    assert!(multiples_png(&wrong, (1200, 1100)).unwrap_err().to_string().contains("`φ₀ =` is about 3 of 4 rows"));
    let mut wrong = figure.clone();
    wrong.panels[3].regions[1].label = "other".into();
    assert!(multiples_png(&wrong, (1200, 1100)).unwrap_err().to_string().contains("panel 3"));
    let none = Multiples { shape: [0, 0], columns: vec![], rows: vec![], panels: vec![], ..figure };
    assert!(multiples_png(&none, (1200, 1100)).is_err());
}

/// What is true all over a plot has a line around it, and each of several its own.
#[test]
fn what_is_true_everywhere_is_outlined() {
    let drawn = |outlines: usize| {
        let mut slice = pattern();
        let mask = vec![true; 28];
        slice.outlines = (0..outlines).map(|i| Region::of_nodes(format!("o{i}"), mask.clone())).collect();
        slice.marks.clear();
        image::load_from_memory(&slice_png(&slice, (640, 480)).unwrap()).unwrap().to_rgb8()
    };
    let [none, one, two] = [0, 1, 2].map(drawn);
    // Colours of pixels in the upper half, above the legend, that are those of the picture before in no place.
    let colors = |picture: &image::RgbImage| -> std::collections::BTreeMap<[u8; 3], usize> {
        picture.enumerate_pixels().filter(|(_, y, _)| *y < 240).fold(Default::default(), |mut all, (_, _, pixel)| {
            *all.entry(pixel.0).or_insert(0) += 1;
            all
        })
    };
    let fresh = |before: &image::RgbImage, after: &image::RgbImage| {
        let known = colors(before);
        colors(after)
            .into_iter()
            .filter(|(color, _)| !known.contains_key(color))
            .map(|(_, count)| count)
            .max()
            .unwrap_or(0)
    };
    assert!(fresh(&none, &one) > 500 && fresh(&one, &two) > 500, "{} {}", fresh(&none, &one), fresh(&one, &two));
}

#[test]
fn multiples_with_their_own_axes() {
    let panel = |p0: f64, p1: f64, x: (f64, f64), y: (f64, f64), k: (f64, f64), log: bool| {
        let y = if log { spaced_log(y.0, y.1, 60) } else { spaced(y.0, y.1, 60) };
        let mut slice = cubic_slice(p0, p1, axis("kappa0", spaced(x.0, x.1, 70), false), axis("kappa1", y, log));
        slice.title = format!("φ₀ = {p0}, φ₁ = {p1}");
        let count = |i: usize| slice.regions[i].mask.iter().filter(|m| **m).count();
        slice.note = format!("exact: {:.1} times Theorem 3.1", count(1) as f64 / count(3) as f64);
        slice.marks = vec![Mark { x: k.0, y: k.1, label: "the paper's example".into() }];
        slice
    };
    let figure = Multiples {
        title: "The three cases of Fig. 2".into(),
        note: String::new(),
        shape: [1, 3],
        columns: vec![],
        rows: vec![],
        panels: vec![
            panel(0.7, 1.4, (0.005, 0.7), (0.8, 60.0), (0.4, 4.0), true),
            panel(0.1, 1.5, (0.001, 0.1), (3.0, 1000.0), (0.035, 100.0), true),
            panel(0.8, 0.9, (0.3, 0.75), (0.7, 1.5), (0.6, 0.874), false),
        ],
    };
    save("fig2.png", &multiples_png(&figure, (1500, 700)).unwrap());
}
