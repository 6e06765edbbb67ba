//! The elements of an SVG file.

use crate::plot::geometry::{Point, Rect};
use crate::plot::palette::{Color, WHITE};
use crate::plot::shapes::DPI;
use crate::plot::shapes::Pen;
use quick_xml::Writer;
use quick_xml::writer::ElementWriter;
use std::io;

/// Verdana is as wide as the font of the pictures, and is where that is not.
const FONTS: &str = "DejaVu Sans, Verdana, sans-serif";

/// A file in the making.
pub(super) struct Page {
    out: Writer<Vec<u8>>,
    /// Rectangles that something was cut off at.
    clips: Vec<Rect>,
    names: usize,
}

/// A coordinate, to a hundredth of a pixel.
pub(super) fn number(x: f64) -> String {
    let text = format!("{x:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.into() }
}

/// A colour as CSS has it.
pub(super) fn color([r, g, b]: Color) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

impl Page {
    pub(super) fn new() -> Page {
        Page { out: Writer::new_with_indent(Vec::new(), b' ', 1), clips: Vec::new(), names: 0 }
    }

    pub(super) fn into_text(self) -> String {
        let text = String::from_utf8_lossy(&self.out.into_inner()).into_owned();
        format!("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n{text}\n")
    }

    /// A name that nothing has yet.
    pub(super) fn name(&mut self) -> String {
        self.names += 1;
        format!("n{}", self.names)
    }

    /// An element without content.
    pub(super) fn element(&mut self, name: &str, attributes: &[(&str, &str)]) -> io::Result<()> {
        with(&mut self.out, name, attributes).write_empty().map(drop)
    }

    /// An element around others.
    pub(super) fn around(
        &mut self,
        name: &str,
        attributes: &[(&str, &str)],
        inside: impl FnOnce(&mut Page) -> io::Result<()>,
    ) -> io::Result<()> {
        use quick_xml::events::{BytesEnd, BytesStart, Event};
        let start = BytesStart::new(name).with_attributes(attributes.iter().copied());
        self.out.write_event(Event::Start(start))?;
        inside(self)?;
        self.out.write_event(Event::End(BytesEnd::new(name)))
    }

    /// The outermost element, on white paper. Its size is that of so many dots per inch; CSS has 96 pixels per inch.
    pub(super) fn document(
        &mut self,
        (width, height): (u32, u32),
        dpi: u32,
        inside: impl FnOnce(&mut Page) -> io::Result<()>,
    ) -> io::Result<()> {
        let [w, h] = [width, height].map(|side| number(f64::from(side) * f64::from(DPI) / f64::from(dpi)));
        let attributes = [
            ("xmlns", "http://www.w3.org/2000/svg"),
            ("xmlns:xlink", "http://www.w3.org/1999/xlink"),
            ("width", &w),
            ("height", &h),
            ("viewBox", &format!("0 0 {width} {height}")),
            ("font-family", FONTS),
            ("stroke-linecap", "round"),
            ("stroke-linejoin", "round"),
        ];
        self.around("svg", &attributes, |page| {
            page.rect(Rect { left: 0, top: 0, right: width as i32, bottom: height as i32 }, &color(WHITE))?;
            inside(page)
        })
    }

    /// Another sheet with its corner at a place.
    pub(super) fn inset(
        &mut self,
        [x, y]: [&str; 2],
        (width, height): (u32, u32),
        inside: impl FnOnce(&mut Page) -> io::Result<()>,
    ) -> io::Result<()> {
        let [w, h] = [width, height].map(|side| side.to_string());
        self.around("svg", &[("x", x), ("y", y), ("width", &w), ("height", &h)], inside)
    }

    /// A filled rectangle.
    pub(super) fn rect(&mut self, rect: Rect, fill: &str) -> io::Result<()> {
        let [x, y, w, h] = [rect.left, rect.top, rect.width(), rect.height()].map(|v| v.max(i32::MIN + 1).to_string());
        if rect.width() <= 0 || rect.height() <= 0 {
            return Ok(());
        }
        self.element("rect", &[("x", &x), ("y", &y), ("width", &w), ("height", &h), ("fill", fill)])
    }

    /// A line along a path.
    pub(super) fn line(&mut self, path: &str, width: f64, stroke: Color, clip: Rect) -> io::Result<()> {
        let clip = self.clip(clip)?;
        let (stroke, width) = (color(stroke), number(width));
        let attributes =
            [("d", path), ("fill", "none"), ("stroke", &stroke), ("stroke-width", &width), ("clip-path", &clip)];
        self.element("path", &attributes)
    }

    pub(super) fn dot(&mut self, at: Point, radius: f64, fill: Color, clip: Rect) -> io::Result<()> {
        let clip = self.clip(clip)?;
        let ([x, y], r, fill) = (at.map(number), number(radius), color(fill));
        self.element("circle", &[("cx", &x), ("cy", &y), ("r", &r), ("fill", &fill), ("clip-path", &clip)])
    }

    /// What is inside of an odd number of closed lines.
    pub(super) fn area(&mut self, path: &str, fill: Color) -> io::Result<()> {
        self.element("path", &[("d", path), ("fill", &color(fill)), ("fill-rule", "evenodd")])
    }

    /// A text with the middle of its capitals level with `at`.
    pub(super) fn text(&mut self, at: Point, pen: Pen, text: &str) -> io::Result<()> {
        let (x, y) = if pen.up { (at[0] + pen.drop(), at[1]) } else { (at[0], at[1] + pen.drop()) };
        let ([x, y], em, fill, rim) = ([x, y].map(number), number(pen.em), color(pen.color), number(2.0 * pen.rim));
        let anchor = match pen.anchor {
            0.0 => "start",
            1.0 => "end",
            _ => "middle",
        };
        let turn = format!("rotate(-90 {x} {y})");
        let (white, mut attributes) =
            (color(WHITE), vec![("x", &x[..]), ("y", &y), ("font-size", &em), ("fill", &fill)]);
        attributes.push(("text-anchor", anchor));
        if pen.up {
            attributes.push(("transform", &turn));
        }
        if pen.rim > 0.0 {
            attributes.extend([("stroke", &white[..]), ("stroke-width", &rim), ("paint-order", "stroke")]);
        }
        // What XML cannot have even as a reference.
        let bad = |c: char| c.is_control() && !matches!(c, '\t' | '\n' | '\r') || matches!(c, '\u{fffe}' | '\u{ffff}');
        let text: String = text.chars().map(|c| if bad(c) { '\u{fffd}' } else { c }).collect();
        let text = quick_xml::events::BytesText::new(&text);
        with(&mut self.out, "text", &attributes).write_text_content(text).map(drop)
    }

    /// What cuts off at a rectangle; written where it is needed first.
    pub(super) fn clip(&mut self, rect: Rect) -> io::Result<String> {
        let (known, all) = (self.clips.iter().position(|other| *other == rect), self.clips.len());
        let name = format!("c{}", known.unwrap_or(all));
        if known.is_none() {
            self.clips.push(rect);
            self.around("clipPath", &[("id", &name)], |page| page.rect(rect, "#000"))?;
        }
        Ok(format!("url(#{name})"))
    }
}

fn with<'w>(out: &'w mut Writer<Vec<u8>>, name: &'w str, attributes: &[(&str, &str)]) -> ElementWriter<'w, Vec<u8>> {
    out.create_element(name).with_attributes(attributes.iter().copied())
}
