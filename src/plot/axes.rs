//! Axes beside a rectangle: ticks, numbers, labels.

use super::drawing::Drawing;
use super::geometry::Rect;
use super::palette::INK;
use super::scale::{Room, Scale, Tick};
use super::shapes::Pen;
use super::style::Style;
use super::{AxisView, short};

fn ticks_right(canvas: &Drawing, scale: &Scale, style: Style, length: i32) -> Vec<Tick> {
    let extent = |label: &str| canvas.text_width(style.numbers(), label);
    scale.ticks(&Room { length: length.into(), slack: style.slack, gap: style.em, extent: &extent })
}

fn ticks_up(scale: &Scale, style: Style, length: i32) -> Vec<Tick> {
    let extent = |_: &str| style.numbers();
    scale.ticks(&Room { length: length.into(), slack: style.slack, gap: style.em, extent: &extent })
}

/// Width of the ticks and numbers to the left of a rectangle of this height.
pub(super) fn width_left(canvas: &Drawing, scale: &Scale, style: Style, height: i32) -> i32 {
    let ticks = ticks_up(scale, style, height);
    let widest = ticks.iter().map(|t| canvas.text_width(style.numbers(), &t.label)).fold(0.0, f64::max);
    widest.ceil() as i32 + style.tick() + style.px(0.4)
}

/// Draws an axis below a rectangle; without numbers when they stand elsewhere.
pub(super) fn draw_below(canvas: &mut Drawing, scale: &Scale, style: Style, rect: Rect, numbers: bool) {
    let ticks = ticks_right(canvas, scale, style, rect.width());
    let minor = scale.minor_ticks().into_iter().map(|at| (at, style.tick() / 2));
    for (at, length) in ticks.iter().map(|t| (t.at, style.tick())).chain(minor) {
        let x = rect.at(at, 0.0)[0].floor() as i32;
        canvas.fill(Rect { left: x, right: x + 1, top: rect.bottom, bottom: rect.bottom + 1 + length }, INK);
    }
    for tick in ticks.iter().filter(|_| numbers) {
        let at = [rect.at(tick.at, 0.0)[0], f64::from(rect.bottom + style.tick()) + style.em * 0.85];
        canvas.text(at, Pen::new(style.numbers(), 0.5), &tick.label);
    }
}

/// Draws an axis to the left of a rectangle; without numbers when they stand elsewhere.
pub(super) fn draw_left(canvas: &mut Drawing, scale: &Scale, style: Style, rect: Rect, numbers: bool) {
    let ticks = ticks_up(scale, style, rect.height());
    let minor = scale.minor_ticks().into_iter().map(|at| (at, style.tick() / 2));
    for (at, length) in ticks.iter().map(|t| (t.at, style.tick())).chain(minor) {
        let y = rect.at(0.0, at)[1].ceil() as i32 - 1;
        canvas.fill(Rect { left: rect.left - 1 - length, right: rect.left, top: y, bottom: y + 1 }, INK);
    }
    for tick in ticks.iter().filter(|_| numbers) {
        let at = [f64::from(rect.left - style.tick() - style.px(0.3)), rect.at(0.0, tick.at)[1]];
        canvas.text(at, Pen::new(style.numbers(), 1.0), &tick.label);
    }
}

/// What an axis below a rectangle of this width is called: its label, with its ends where no numbers have room.
pub(super) fn named_below(canvas: &Drawing, axis: &AxisView, scale: &Scale, style: Style, width: i32) -> String {
    named(axis, ticks_right(canvas, scale, style, width).is_empty())
}

/// The same to the left of a rectangle of this height.
pub(super) fn named_left(axis: &AxisView, scale: &Scale, style: Style, height: i32) -> String {
    named(axis, ticks_up(scale, style, height).is_empty())
}

fn named(axis: &AxisView, bare: bool) -> String {
    match &axis.values[..] {
        [only] if bare => format!("{} = {}", axis.label, short(*only)),
        [first, .., last] if bare => format!("{}: {} to {}", axis.label, short(*first), short(*last)),
        _ => axis.label.clone(),
    }
}

/// Writes what the axis below `rect` is, centred, `below` pixels under it.
pub(super) fn label_below(canvas: &mut Drawing, style: Style, rect: Rect, below: i32, label: &str) {
    let label = canvas.fit(style.em, label, rect.width().into());
    let at = [rect.at(0.5, 0.0)[0], f64::from(rect.bottom + below) + style.em * 0.6];
    canvas.text(at, Pen::new(style.em, 0.5), &label);
}

/// Writes what the axis to the left of `rect` is, upwards, `left` pixels beside it.
pub(super) fn label_left(canvas: &mut Drawing, style: Style, rect: Rect, left: i32, label: &str) {
    let label = canvas.fit(style.em, label, rect.height().into());
    let at = [f64::from(rect.left - left) - style.em * 0.8, rect.at(0.0, 0.5)[1]];
    canvas.text(at, Pen { up: true, ..Pen::new(style.em, 0.5) }, &label);
}
