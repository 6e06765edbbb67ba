//! Several paths in one plane, with graphs beside them.

use super::axes::{draw_below, draw_left, label_below, label_left, width_left};
use super::comb::Comb;
use super::curve::{bounds, same_scales};
use super::drawing::Drawing;
use super::geometry::{Point, Rect};
use super::legend::Heading;
use super::palette::{GREY, GROWN, INK, LINES, OBSTACLE, RED};
use super::scale::Scale;
use super::slice::check_room;
use super::style::Style;
use crate::error::{Error, Result};

/// Graphs over a common axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Lines {
    /// What stands below.
    pub across: String,
    /// What stands beside.
    pub up: String,
    /// The graphs.
    pub lines: Vec<Vec<[f64; 2]>>,
}

/// What paths lead among.
#[derive(Debug, Clone, PartialEq)]
pub struct Backdrop {
    /// Polygons, filled.
    pub obstacles: Vec<Vec<[f64; 2]>>,
    /// The part within this distance of them is marked.
    pub grown: f64,
    /// A thin line.
    pub polyline: Vec<[f64; 2]>,
}

/// What [`draw_paths`] draws.
#[derive(Debug, Clone, PartialEq)]
pub struct PathsFigure {
    /// Heading.
    pub title: String,
    /// Small print below the heading; may be empty.
    pub note: String,
    /// Points of each path, in order; a dot marks the first.
    pub paths: Vec<Vec<[f64; 2]>>,
    /// Signed curvature at each point of the first path, positive to the left, for a comb; may be empty.
    pub comb: Vec<f64>,
    /// Thin lines below the paths: what they lead from and to.
    pub given: Vec<Vec<[f64; 2]>>,
    /// Graphs; where there is one for each path, in its colour.
    pub graph: Lines,
    /// A value of the graphs to mark with a line.
    pub level: Option<f64>,
    /// What the paths lead among; with it the graphs stand below, not on the right.
    pub backdrop: Option<Backdrop>,
}

/// Draws a figure of `size` (width, height) pixels: the paths, to one scale in both directions, and on the right of
/// them or below the graphs.
///
/// # Errors
/// [`Error::Domain`] when a number is not finite, there is nothing to draw or it has no extent, or the size is 0, too
/// large, or too small.
pub fn draw_paths(figure: &PathsFigure, size: (u32, u32)) -> Result<Drawing> {
    let mut canvas = Drawing::new(size)?;
    let finite = |lines: &[Vec<Point>]| lines.iter().flatten().flatten().all(|v| v.is_finite());
    let behind = figure.backdrop.iter().flat_map(|b| b.obstacles.iter().chain([&b.polyline])).chain(&figure.given);
    if !behind.flatten().flatten().all(|v| v.is_finite()) {
        return Err(Error::invalid("paths figure: what is behind must have points that are finite"));
    }
    if !figure.comb.iter().all(|k| k.is_finite()) {
        return Err(Error::invalid("paths figure: the curvatures of the comb must be finite"));
    }
    for (name, lines) in [("paths", &figure.paths), ("graphs", &figure.graph.lines)] {
        if lines.iter().all(Vec::is_empty) || !finite(lines) {
            return Err(Error::invalid(format!("paths figure: the {name} must have points, all finite")));
        }
    }
    let (style, sheet, heading) = Heading::of_figure(&canvas, &figure.title, &figure.note, size);
    let bottom = sheet.bottom - style.below() - style.px(1.6);
    let body = Rect { top: sheet.top + heading.height(style) + style.px(0.3), bottom, ..sheet };
    heading.draw(&mut canvas, style, sheet);
    let [paths, lines] = parts(body, style, figure.backdrop.is_some());
    plot_paths(&mut canvas, figure, style, paths)?;
    draw_lines(&mut canvas, figure, style, lines)?;
    Ok(canvas)
}

/// Where the paths and the graphs go.
fn parts(body: Rect, style: Style, below: bool) -> [Rect; 2] {
    if below {
        let middle = body.top + body.height() * 70 / 100;
        let axis = style.below() + style.px(1.6);
        return [Rect { bottom: middle - axis, ..body }, Rect { top: middle + style.px(0.8), ..body }];
    }
    let middle = body.left + body.width() * 54 / 100;
    [Rect { right: middle, ..body }, Rect { left: middle + style.px(1.2), ..body }]
}

/// Room for the numbers and the name on the left.
pub(super) fn narrowed(canvas: &mut Drawing, y: &Scale, style: Style, rect: Rect) -> Result<Rect> {
    let left = rect.left + width_left(canvas, y, style, rect.height()) + style.px(1.6);
    let rect = Rect { left, ..rect };
    check_room(canvas, rect)?;
    Ok(rect)
}

/// Axes and frame with their names.
pub(super) fn finish(canvas: &mut Drawing, [x, y]: [&Scale; 2], names: [&str; 2], style: Style, rect: Rect) {
    draw_below(canvas, x, style, rect, true);
    draw_left(canvas, y, style, rect, true);
    label_below(canvas, style, rect, style.below(), names[0]);
    let left = width_left(canvas, y, style, rect.height());
    label_left(canvas, style, rect, left, names[1]);
}

fn plot_paths(canvas: &mut Drawing, figure: &PathsFigure, style: Style, area: Rect) -> Result<()> {
    check_room(canvas, area)?;
    let grown = figure.backdrop.iter().flat_map(|b| {
        let sides = [-b.grown, b.grown];
        b.obstacles.iter().flatten().flat_map(move |p| sides.map(|by| [p[0] + by, p[1] + by]))
    });
    let comb = Comb::new(figure.paths.first().map_or(&[], |path| path), figure.comb.iter().copied());
    let all: Vec<Point> =
        figure.paths.iter().chain(&figure.given).flatten().chain(comb.tips()).copied().chain(grown).collect();
    let values = |i: usize| bounds(all.iter().map(|p| p[i]));
    let [_, y] = same_scales(values(0), values(1), area)?;
    let rect = narrowed(canvas, &y, style, area)?;
    let [x, y] = same_scales(values(0), values(1), rect)?;
    canvas.frame(rect, INK);
    let place = |p: &Point| rect.at(x.fraction(p[0]), y.fraction(p[1]));
    if let Some(backdrop) = &figure.backdrop {
        let pixels = (place(&[backdrop.grown, 0.0])[0] - place(&[0.0, 0.0])[0]).abs();
        draw_backdrop(canvas, backdrop, style, rect, (pixels, &place));
    }
    for line in &figure.given {
        canvas.cased(&line.iter().map(place).collect::<Vec<_>>(), style.em * 0.06, GREY, rect);
    }
    comb.draw(canvas, style, rect, place);
    // The first is on top, and starts are above all lines.
    let mut colored: Vec<_> = figure.paths.iter().zip(LINES.into_iter().cycle()).collect();
    colored.reverse();
    for (path, color) in &colored {
        canvas.cased(&path.iter().map(place).collect::<Vec<_>>(), style.em * 0.18, *color, rect);
    }
    for (first, color) in colored.iter().filter_map(|(path, color)| Some((place(path.first()?), color))) {
        canvas.cased(&[first, first], style.em * 0.6, *color, rect);
    }
    finish(canvas, [&x, &y], ["x", "y"], style, rect);
    Ok(())
}

/// Everything within a distance of a polygon is the polygon and a broad line around it.
fn draw_backdrop(
    canvas: &mut Drawing,
    backdrop: &Backdrop,
    style: Style,
    clip: Rect,
    (grown, place): (f64, &impl Fn(&Point) -> Point),
) {
    let places = |points: &[Point]| points.iter().map(place).collect::<Vec<_>>();
    let obstacles: Vec<Vec<Point>> = backdrop.obstacles.iter().map(|ring| places(ring)).collect();
    // First the edges, then what they go around: where two overlap there is none.
    for (more, color) in [(style.em * 0.14, GREY), (0.0, GROWN)] {
        for ring in &obstacles {
            let around: Vec<Point> = ring.iter().chain(ring.first()).copied().collect();
            canvas.line(&around, 2.0 * grown + more, color, clip);
        }
    }
    obstacles.iter().for_each(|ring| canvas.polygon(ring, OBSTACLE));
    canvas.cased(&places(&backdrop.polyline), style.em * 0.06, GREY, clip);
}

/// Whether graphs rise or fall so near to an end of their axis that the frame would hide it.
fn steep_at_an_end(lines: &[Vec<Point>], [from, to]: [f64; 2], height: f64) -> bool {
    let reach = 0.005 * (to - from);
    let steep = |near: &dyn Fn(f64) -> bool| {
        lines.iter().any(|line| {
            let (lo, hi) = bounds(line.iter().filter(|p| near(p[0])).map(|p| p[1]));
            hi - lo > 0.1 * height
        })
    };
    steep(&|x| x - from < reach) || steep(&|x| to - x < reach)
}

fn draw_lines(canvas: &mut Drawing, figure: &PathsFigure, style: Style, area: Rect) -> Result<()> {
    check_room(canvas, area)?;
    let Lines { across, up, lines } = &figure.graph;
    let (from, to) = bounds(lines.iter().flatten().map(|p| p[0]));
    let (lo, hi) = bounds(lines.iter().flatten().map(|p| p[1]).chain(figure.level));
    let beside = if steep_at_an_end(lines, [from, to], hi - lo) { 0.02 * (to - from) } else { 0.0 };
    let x = Scale::new(across, from - beside, to + beside, false)?;
    // A constant has no extent but rounding noise.
    let most = lo.abs().max(hi.abs());
    let flat = if most == 0.0 { 1.0 } else { most * 0.2 };
    let air = if hi - lo > 1e-9 * most { (hi - lo) * 0.07 } else { flat };
    let y = Scale::new(up, lo - air, hi + air, false)?;
    let rect = narrowed(canvas, &y, style, area)?;
    canvas.frame(rect, INK);
    let places =
        |points: &[Point]| points.iter().map(|p| rect.at(x.fraction(p[0]), y.fraction(p[1]))).collect::<Vec<_>>();
    // Under the graphs, so that one that touches it is seen to.
    if let Some(level) = figure.level {
        canvas.cased(&places(&[[from, level], [to, level]]), style.em * 0.16, RED, rect);
    }
    for (line, color) in lines.iter().zip(LINES.into_iter().cycle()) {
        canvas.cased(&places(line), style.em * 0.12, color, rect);
    }
    finish(canvas, [&x, &y], [across, up], style, rect);
    Ok(())
}
