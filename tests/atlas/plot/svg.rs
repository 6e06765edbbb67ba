//! SVG pictures: they are XML, their texts are the labels, and their lines and areas are where the data are.

use super::super::crude::curve_figure;
use super::pattern;
use quick_xml::Reader;
use quick_xml::events::Event;
use spiral_atlas::plot::*;
use std::collections::BTreeMap;
use std::path::Path;

/// An element: its name, its attributes, its text.
type Element = (String, BTreeMap<String, String>, String);

/// All elements in order; the text of each is what stands in it before any other.
fn elements(svg: &str) -> Vec<Element> {
    let (mut reader, mut all, mut depth) = (Reader::from_str(svg), Vec::<Element>::new(), 0);
    let mut begun = false;
    loop {
        let event = reader.read_event().expect("XML");
        match &event {
            Event::Start(e) | Event::Empty(e) => {
                begun = matches!(event, Event::Start(_));
                depth += i32::from(begun);
                let attributes = e.attributes().map(|a| {
                    let a = a.expect("an attribute");
                    let value = a.normalized_value(quick_xml::XmlVersion::Implicit1_0).expect("a value").into_owned();
                    (a.key.as_ref().to_owned(), value)
                });
                all.push((e.name().as_ref().to_owned(), attributes.collect(), String::new()));
            }
            Event::Text(text) if begun => all.last_mut().unwrap().2 += text,
            Event::GeneralRef(name) => {
                let entity = quick_xml::escape::resolve_predefined_entity(name).expect("one of the five");
                all.last_mut().unwrap().2 += entity;
            }
            Event::End(_) => (depth, begun) = (depth - 1, false),
            Event::Eof => break,
            _ => {}
        }
    }
    assert_eq!(depth, 0, "each element ends");
    all
}

fn texts(svg: &str) -> Vec<String> {
    elements(svg).into_iter().filter(|(name, ..)| name == "text").map(|(_, _, text)| text).collect()
}

/// The lines of path data that has M, L, H, V and Z alone, with absolute numbers.
fn lines(data: &str) -> Vec<Vec<[f64; 2]>> {
    let mut all: Vec<Vec<[f64; 2]>> = Vec::new();
    let parts = data.char_indices().filter(|(_, c)| c.is_ascii_alphabetic()).map(|(i, _)| i).collect::<Vec<_>>();
    for (i, start) in parts.iter().enumerate() {
        let rest = &data[start + 1..parts.get(i + 1).copied().unwrap_or(data.len())];
        let numbers: Vec<f64> = rest.split_whitespace().map(|n| n.parse().expect("a number")).collect();
        let last = all.last().and_then(|line| line.last()).copied();
        match (&data[*start..=*start], &numbers[..]) {
            ("M", [x, y]) => all.push(vec![[*x, *y]]),
            ("L", [x, y]) => all.last_mut().unwrap().push([*x, *y]),
            ("H", [x]) => all.last_mut().unwrap().push([*x, last.unwrap()[1]]),
            ("V", [y]) => all.last_mut().unwrap().push([last.unwrap()[0], *y]),
            ("Z", []) => {}
            other => panic!("{other:?}"),
        }
    }
    all
}

/// Whether a place is inside of an odd number of closed lines.
fn inside(rings: &[Vec<[f64; 2]>], [x, y]: [f64; 2]) -> bool {
    let sides = rings.iter().flat_map(|ring| ring.iter().zip(ring.iter().cycle().skip(1)));
    sides.filter(|(a, b)| (a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])).count() % 2
        == 1
}

/// From the numbers of an axis to places: the line through its first and its last tick.
fn axis_of<'t>(ticks: impl Iterator<Item = (f64, &'t str)>) -> impl Fn(f64) -> f64 {
    let all: Vec<(f64, f64)> =
        ticks.filter_map(|(at, text)| Some((text.replace('−', "-").parse().ok()?, at))).collect();
    let ((from, a), (to, b)) = (all[0], all[all.len() - 1]);
    move |value| a + (value - from) / (to - from) * (b - a)
}

#[test]
fn a_curve_is_where_its_axes_say() {
    let figure = curve_figure(0.7, 1.4, (0.4, 4.0), (1.66010274767, 0.76985066613));
    let drawing = draw_curve(&figure, (1200, 700)).unwrap();
    let svg = drawing.svg();
    assert!(svg == draw_curve(&figure, (1200, 700)).unwrap().svg(), "the same data give the same bytes");
    let all = elements(&svg);
    let number = |e: &Element, name: &str| e.1[name].parse::<f64>().unwrap();
    let labels: Vec<&Element> = all.iter().filter(|e| e.0 == "text").collect();
    // The plot of the curve is the left one: its frame ends before the middle.
    let across = labels.iter().filter(|e| e.1["text-anchor"] == "middle" && number(e, "x") < 640.0);
    let x = axis_of(across.map(|e| (number(e, "x"), &e.2[..])));
    let up = labels.iter().filter(|e| e.1["text-anchor"] == "end" && number(e, "x") < 300.0);
    // Base lines are below the middle of the numbers.
    let y = axis_of(up.map(|e| (number(e, "y") - 0.365 * number(e, "font-size"), &e.2[..])));
    let ink = |e: &&Element| e.0 == "path" && e.1.get("stroke").is_some_and(|s| s == "#222222");
    let drawn = &lines(&all.iter().find(ink).unwrap().1["d"])[0];
    for (point, seen) in [(figure.curve[0], drawn[0]), (*figure.curve.last().unwrap(), *drawn.last().unwrap())] {
        let off = [x(point[0]) - seen[0], y(point[1]) - seen[1]];
        assert!(off.iter().all(|d| d.abs() < 0.05), "{point:?} is at {seen:?}, off by {off:?}");
    }
    let told = |text: &str| labels.iter().filter(|e| e.2 == text).count();
    for text in [&figure.title[..], "x", "y", &figure.parameter, &figure.curvature.label, &figure.circles[1].label] {
        assert!(told(text) >= 1, "{text}");
    }
}

#[test]
fn every_node_is_in_its_area() {
    let mut slice = pattern();
    slice.outlines = vec![slice.regions[1].clone()];
    let svg = draw_slice(&slice, (640, 480)).unwrap().svg();
    let all = elements(&svg);
    let clip = all.iter().position(|e| e.0 == "clipPath").unwrap();
    let rect = ["x", "y", "width", "height"].map(|name| all[clip + 1].1[name].parse::<f64>().unwrap());
    let shared: Vec<_> = all.iter().filter(|e| e.0 == "path" && e.1.contains_key("id")).collect();
    assert_eq!(shared.len(), 3, "two fills and an outline");
    // Nodes in steps of half a cell of the axes: see `pattern`.
    let x = |i: usize| rect[0] + (slice.x.values[i] + 0.5) / 13.0 * rect[2];
    let y = |j: usize| rect[1] + rect[3] - (slice.y.values[j].log2() + 0.5) / 7.5 * rect[3];
    for (path, region) in shared.iter().zip([&slice.regions[0], &slice.regions[1], &slice.outlines[0]]) {
        let rings = lines(&path.1["d"]);
        for (at, mask) in region.mask.iter().enumerate() {
            assert_eq!(inside(&rings, [x(at % 7), y(at / 7)]), *mask, "node {at} of {}", region.label);
        }
    }
}

#[test]
fn texts_are_the_labels_and_harm_nothing() {
    let mut slice = pattern();
    slice.title = "<script>alert(\"1 & 2\")</script>".into();
    slice.note = "a 'note' ]]> <!-- &amp;".into();
    slice.regions[0].label = "all < & \" >".into();
    slice.marks = vec![Mark { x: 9.0, y: 4.0, label: "here\u{1}\u{b}</text>".into() }];
    let svg = draw_slice(&slice, (900, 600)).unwrap().svg();
    let found = texts(&svg);
    let expected = ["<script>alert(\"1 & 2\")</script>", "a 'note' ]]> <!-- &amp;", "all < & \" >: 28 nodes (100.0 %)"];
    for text in expected.into_iter().chain(["here\u{fffd}\u{fffd}</text>", "κ₀", "κ₁"]) {
        assert_eq!(found.iter().filter(|t| *t == text).count(), 1, "{text:?} in {found:?}");
    }
    assert!(elements(&svg).iter().all(|e| e.0 != "script"));
    // Ticks, and nothing else but what is named above and the second region.
    let numbers = found.iter().filter(|t| t.replace('−', "-").parse::<f64>().is_ok()).count();
    assert_eq!(found.len(), numbers + 7, "{found:?}");
}

#[test]
fn several_sheets_are_one_and_keep_their_size_on_paper() {
    let sheet = Sheet { size: (1200, 600), dpi: 300 };
    let svg = draw_montage("both", &[pattern(), pattern()], 2, sheet).unwrap().svg();
    let all = elements(&svg);
    let outer = &all[0].1;
    assert_eq!([&outer["width"], &outer["height"], &outer["viewBox"]], ["384", "192", "0 0 1200 600"]);
    assert_eq!(all.iter().filter(|e| e.0 == "svg").count(), 3);
    let names: Vec<&String> = all.iter().filter_map(|e| e.1.get("id")).collect();
    let unique: std::collections::BTreeSet<_> = names.iter().collect();
    assert!(names.len() > 4 && unique.len() == names.len(), "{names:?}");
}

#[test]
fn names_tell_the_format() {
    let of = |name: &str| Format::of(Path::new(name));
    assert_eq!([of("a.svg").unwrap(), of("b/c.PNG").unwrap()], [Format::Svg, Format::Png]);
    for name in ["a.jpg", "svg", "a.svg.gz", ""] {
        let message = of(name).unwrap_err().to_string();
        assert!(message.contains(".png or .svg") && message.contains(name), "{message}");
    }
}
