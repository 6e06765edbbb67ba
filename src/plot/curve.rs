//! A curve with its curvature comb, control polygon and end circles, its curvature, and the derivative of that.

use super::axes::{draw_below, draw_left, label_below, label_left, width_left};
use super::comb::Comb;
use super::drawing::Drawing;
use super::geometry::{Point, Rect};
use super::legend::{Entry, Heading, Key, Legend};
use super::palette::{GREY, INK, LINES, PALE, RED};
use super::scale::Scale;
use super::slice::check_room;
use super::style::Style;
use crate::error::{Error, Result};

/// From this ratio of largest to smallest on, positive values get a logarithmic axis.
const LOG_RATIO: f64 = 300.0;

/// A circle of curvature at an end of a curve; a straight line for curvature 0.
#[derive(Debug, Clone, PartialEq)]
pub struct EndCircle {
    /// The point where it touches the curve.
    pub at: [f64; 2],
    /// Direction of the curve there; any length but 0.
    pub direction: [f64; 2],
    /// Signed curvature in the plane of the picture, positive to the left.
    pub curvature: f64,
    /// What the legend says.
    pub label: String,
}

/// A sampled function of the curve's parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Graph {
    /// What stands beside its axis.
    pub label: String,
    /// Parameter and value, by increasing parameter.
    pub points: Vec<[f64; 2]>,
}

/// What [`draw_curve`] draws.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveFigure {
    /// Heading.
    pub title: String,
    /// Small print below the heading; may be empty.
    pub note: String,
    /// Points of the curve, in order, as dense as it should look smooth.
    pub curve: Vec<[f64; 2]>,
    /// Its control points; may be empty.
    pub control: Vec<[f64; 2]>,
    /// Circles of curvature.
    pub circles: Vec<EndCircle>,
    /// What the parameter of the two graphs is.
    pub parameter: String,
    /// Signed curvature at each point of `curve`, positive to the left.
    pub curvature: Graph,
    /// Derivative of the curvature, drawn red where it goes against the change from one end to the other.
    pub derivative: Graph,
    /// Parameters, increasing, that part it into curves with a change of their own; usually none.
    pub joints: Vec<f64>,
}

/// Draws a curve figure of `size` (width, height) pixels: the curve on the left, to one scale in both directions, its
/// curvature and the derivative of that on the right. Values that are all positive and spread over more than a factor
/// of 300 get a logarithmic axis.
///
/// # Errors
/// [`Error::Domain`] when a number is not finite, the curve or a graph has fewer than two points or no extent, a
/// direction is 0, or the size is 0, too large, or too small for plots beside their labels.
pub fn draw_curve(figure: &CurveFigure, size: (u32, u32)) -> Result<Drawing> {
    let mut canvas = Drawing::new(size)?;
    check(figure)?;
    let (style, sheet, heading) = Heading::of_figure(&canvas, &figure.title, &figure.note, size);
    let entries = entries(figure);
    let legend = Legend::new(&canvas, &entries, style, sheet.width());
    let body = Rect {
        top: sheet.top + heading.height(style) + style.px(0.3),
        bottom: sheet.bottom - legend.height(style) - style.px(0.6),
        ..sheet
    };
    let middle = body.left + body.width() * 54 / 100;
    let half = body.top + body.height() / 2;
    heading.draw(&mut canvas, style, sheet);
    plot_curve(&mut canvas, figure, style, Rect { right: middle, ..body })?;
    let right = Rect { left: middle + style.px(1.2), ..body };
    draw_graphs(
        &mut canvas,
        figure,
        style,
        [Rect { bottom: half, ..right }, Rect { top: half + style.px(0.6), ..right }],
    )?;
    legend.draw(&mut canvas, style, (sheet.left, sheet.bottom - legend.height(style)));
    Ok(canvas)
}

fn check(figure: &CurveFigure) -> Result<()> {
    let fail = |what: String| Err(Error::invalid(format!("curve figure: {what}")));
    let finite = |points: &[Point]| points.iter().flatten().all(|v| v.is_finite());
    let lists = [
        ("curve", &figure.curve),
        ("curvature", &figure.curvature.points),
        ("derivative of the curvature", &figure.derivative.points),
    ];
    for (name, points) in lists {
        if points.len() < 2 {
            return fail(format!("`{name}` has {} points; it must have at least 2", points.len()));
        }
        if !finite(points) {
            return fail(format!("the {name} leaves the range of doubles somewhere, so it cannot be drawn"));
        }
    }
    let (points, values) = (figure.curve.len(), figure.curvature.points.len());
    if points != values {
        return fail(format!("there are {values} curvatures for {points} points of the curve; there must be as many"));
    }
    for graph in [&figure.curvature, &figure.derivative] {
        let (lo, hi) = bounds(graph.points.iter().map(|p| p[0]));
        if lo >= hi {
            return fail(format!("`{}` has the one parameter {lo}; it must have a range", graph.label));
        }
    }
    if !finite(&figure.control) {
        return fail("a control point is not finite".into());
    }
    for circle in &figure.circles {
        let length = circle.direction[0].hypot(circle.direction[1]);
        if !(finite(&[circle.at]) && circle.curvature.is_finite() && length.is_finite() && length > 0.0) {
            let (label, at, direction, curvature) = (&circle.label, circle.at, circle.direction, circle.curvature);
            return fail(format!(
                "circle `{label}` at {at:?} has direction {direction:?} and curvature {curvature}; all must be finite, \
                 the direction not 0"
            ));
        }
    }
    Ok(())
}

fn entries(figure: &CurveFigure) -> Vec<Entry> {
    let mut entries = vec![Entry { key: Key::Line(INK, 0.2), text: "curve".into() }];
    entries.push(Entry { key: Key::Line(PALE, 0.08), text: "comb: curvature".into() });
    if !figure.control.is_empty() {
        entries.push(Entry { key: Key::Line(GREY, 0.09), text: "control polygon".into() });
    }
    for (circle, color) in figure.circles.iter().zip(LINES.into_iter().cycle()) {
        entries.push(Entry { key: Key::Line(color, 0.1), text: circle.label.clone() });
    }
    let wrong = turns_back(figure);
    if figure.derivative.points.iter().any(|p| wrong(*p)) {
        entries.push(Entry { key: Key::Line(RED, 0.16), text: "curvature turns back".into() });
    }
    entries
}

/// Which points of the derivative go against the change of curvature from the first point of their curve to its last;
/// rounding noise does not.
fn turns_back(figure: &CurveFigure) -> impl Fn(Point) -> bool {
    let noise = figure.derivative.points.iter().fold(0.0, |most: f64, p| most.max(p[1].abs())) * 1e-9;
    let limits: Vec<f64> =
        [f64::NEG_INFINITY].into_iter().chain(figure.joints.iter().copied()).chain([f64::INFINITY]).collect();
    let change = |limits: &[f64]| {
        let mut inside = figure.curvature.points.iter().filter(|p| (limits[0]..=limits[1]).contains(&p[0]));
        let first = inside.next();
        first.zip(inside.next_back()).map_or(0.0, |(first, last)| (last[1] - first[1]).signum())
    };
    let curves: Vec<(f64, f64)> = limits.windows(2).map(|limits| (limits[1], change(limits))).collect();
    move |[at, derivative]| curves.iter().find(|(to, _)| at <= *to).is_some_and(|(_, sign)| derivative * sign < -noise)
}

/// Least and greatest of some numbers.
pub(super) fn bounds(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), v| (lo.min(v), hi.max(v)))
}

fn plot_curve(canvas: &mut Drawing, figure: &CurveFigure, style: Style, area: Rect) -> Result<()> {
    let mut rect = Rect { bottom: area.bottom - style.below() - style.px(1.6), ..area };
    check_room(canvas, rect)?;
    let comb = Comb::new(&figure.curve, figure.curvature.points.iter().map(|p| p[1]));
    let [_, y] = window(figure, &comb, rect)?;
    rect.left += width_left(canvas, &y, style, rect.height()) + style.px(1.6);
    check_room(canvas, rect)?;
    let [x, y] = window(figure, &comb, rect)?;
    let to_sheet = |points: &[Point]| -> Vec<Point> {
        points.iter().map(|p| rect.at(x.fraction(p[0]), y.fraction(p[1]))).collect()
    };
    canvas.frame(rect, INK);
    comb.draw(canvas, style, rect, |p| rect.at(x.fraction(p[0]), y.fraction(p[1])));
    let em = style.em;
    let diagonal = f64::from(rect.width() + rect.height()) / unit(&x, rect);
    for (circle, color) in figure.circles.iter().zip(LINES.into_iter().cycle()) {
        canvas.cased(&to_sheet(&arc(circle, diagonal)), em * 0.1, color, rect);
    }
    let control = to_sheet(&figure.control);
    canvas.cased(&control, em * 0.09, GREY, rect);
    canvas.cased(&to_sheet(&figure.curve), em * 0.2, INK, rect);
    for point in control {
        canvas.cased(&[point, point], em * 0.55, GREY, rect.grown(style.px(0.3)));
    }
    draw_below(canvas, &x, style, rect, true);
    draw_left(canvas, &y, style, rect, true);
    label_below(canvas, style, rect, style.below(), "x");
    let left = width_left(canvas, &y, style, rect.height());
    label_left(canvas, style, rect, left, "y");
    Ok(())
}

/// Pixels for one unit of an axis to the right.
fn unit(x: &Scale, rect: Rect) -> f64 {
    (x.fraction(1.0) - x.fraction(0.0)) * f64::from(rect.width())
}

/// The axes of the curve's plot: all of the curve, its comb and its polygon, whole end circles as long as they are not
/// much larger than these, and the same scale in both directions.
fn window(figure: &CurveFigure, comb: &Comb, rect: Rect) -> Result<[Scale; 2]> {
    let points = || figure.curve.iter().chain(&figure.control).chain(comb.tips());
    let (mut x, mut y) = (bounds(points().map(|p| p[0])), bounds(points().map(|p| p[1])));
    let extent = (x.1 - x.0).hypot(y.1 - y.0);
    for circle in &figure.circles {
        let radius = 1.0 / circle.curvature;
        if radius.abs() <= extent {
            let [tx, ty] = unit_vector(circle.direction);
            let centre = [circle.at[0] - radius * ty, circle.at[1] + radius * tx];
            x = bounds([x.0, x.1, centre[0] - radius.abs(), centre[0] + radius.abs()].into_iter());
            y = bounds([y.0, y.1, centre[1] - radius.abs(), centre[1] + radius.abs()].into_iter());
        }
    }
    same_scales(x, y, rect)
}

/// Axes that hold these bounds, the same scale in both directions.
pub(super) fn same_scales(x: (f64, f64), y: (f64, f64), rect: Rect) -> Result<[Scale; 2]> {
    let (width, height) = (f64::from(rect.width()), f64::from(rect.height()));
    // Length of a pixel, with some air around.
    let pixel = 1.1 * ((x.1 - x.0) / width).max((y.1 - y.0) / height);
    let scale = |name, (lo, hi): (f64, f64), pixels: f64| {
        let centre = lo / 2.0 + hi / 2.0;
        Scale::new(name, centre - pixel * pixels / 2.0, centre + pixel * pixels / 2.0, false)
    };
    Ok([scale("x", x, width)?, scale("y", y, height)?])
}

fn unit_vector([x, y]: Point) -> Point {
    let length = x.hypot(y);
    [x / length, y / length]
}

/// Points of an end circle up to an arc length of `reach` on both sides of its point: on a large circle, nothing
/// farther can be in a window of that size.
fn arc(circle: &EndCircle, reach: f64) -> Vec<Point> {
    let k = circle.curvature;
    let most = if k == 0.0 { 3.0 * reach } else { (std::f64::consts::PI / k.abs()).min(3.0 * reach) };
    let [tx, ty] = unit_vector(circle.direction);
    let point = |i: i32| {
        let s = most * f64::from(i) / 180.0;
        // Half the chord's turn: along = s sinc, across = s sin(half) sinc, regular at k = 0.
        let half = k * s / 2.0;
        let sinc = if half == 0.0 { 1.0 } else { half.sin() / half };
        let (along, across) = (s * sinc * half.cos(), s * sinc * half.sin());
        [circle.at[0] + along * tx - across * ty, circle.at[1] + along * ty + across * tx]
    };
    (-180..=180).map(point).collect()
}

/// Curvature and its derivative, each in its own area, with their left sides in one line.
fn draw_graphs(canvas: &mut Drawing, figure: &CurveFigure, style: Style, areas: [Rect; 2]) -> Result<()> {
    let graphs = [&figure.curvature, &figure.derivative];
    let scales = [value_scale(graphs[0])?, value_scale(graphs[1])?];
    let mut rects = areas.map(|area| Rect { bottom: area.bottom - style.below() - style.px(1.6), ..area });
    let lefts = [0, 1].map(|i| width_left(canvas, &scales[i], style, rects[i].height()));
    let left = lefts[0].max(lefts[1]);
    let turns_back = turns_back(figure);
    let (lo, hi) = bounds(graphs.iter().flat_map(|g| &g.points).map(|p| p[0]));
    let x = Scale::new(&figure.parameter, lo, hi, false)?;
    for (i, rect) in rects.iter_mut().enumerate() {
        rect.left += left + style.px(1.6);
        check_room(canvas, *rect)?;
        draw_graph(canvas, graphs[i], [x, scales[i]], style, *rect, &|p| i == 1 && turns_back(p));
        label_below(canvas, style, *rect, style.below(), &figure.parameter);
        label_left(canvas, style, *rect, left, &graphs[i].label);
    }
    Ok(())
}

fn draw_graph(
    canvas: &mut Drawing,
    graph: &Graph,
    [x, y]: [Scale; 2],
    style: Style,
    rect: Rect,
    wrong: &dyn Fn(Point) -> bool,
) {
    let zero = y.fraction(0.0);
    if (0.0..1.0).contains(&zero) {
        canvas.line(&[rect.at(0.0, zero), rect.at(1.0, zero)], 1.0, PALE, rect);
    }
    canvas.frame(rect, INK);
    let places: Vec<Point> = graph.points.iter().map(|p| rect.at(x.fraction(p[0]), y.fraction(p[1]))).collect();
    canvas.line(&places, style.em * 0.16, INK, rect);
    // Points that are not finite interrupt a line.
    let only_wrong = |(p, place): (&Point, &Point)| if wrong(*p) { *place } else { [f64::NAN; 2] };
    let wrong: Vec<Point> = graph.points.iter().zip(&places).map(only_wrong).collect();
    canvas.line(&wrong, style.em * 0.24, RED, rect);
    draw_below(canvas, &x, style, rect, true);
    draw_left(canvas, &y, style, rect, true);
}

/// The axis of a graph's values, with some air; from 0 when that is near.
fn value_scale(graph: &Graph) -> Result<Scale> {
    let (lo, hi) = bounds(graph.points.iter().map(|p| p[1]));
    if lo > 0.0 && hi / lo > LOG_RATIO {
        let air = (hi / lo).powf(0.05);
        return Scale::new(&graph.label, lo / air, hi * air, true);
    }
    let most = lo.abs().max(hi.abs());
    // A constant has no extent but rounding noise.
    if hi - lo <= 1e-9 * most || most == 0.0 {
        let air = if most == 0.0 { 1.0 } else { most * 0.2 };
        return Scale::new(&graph.label, lo - air, hi + air, false);
    }
    let (lo, hi) = (if lo > 0.0 && lo < 0.5 * hi { 0.0 } else { lo }, if hi < 0.0 && hi > 0.5 * lo { 0.0 } else { hi });
    let air = (hi - lo) * 0.07;
    Scale::new(&graph.label, lo - air, hi + air, false)
}
