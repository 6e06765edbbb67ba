//! `query --ranges`, `--nearest` and `--boundary`: questions beyond yes and no.

use super::datum::Coordinates;
use super::output;
use super::{Outcome, numbers};
use clap::ArgGroup;
use spiral_atlas::family::Family;
use spiral_atlas::plain::count;
use spiral_atlas::plot::{Drawing, OutlinesFigure, draw_outlines, symbol};
use spiral_atlas::question::{Boundary, Nearest, Outline, Property, Ranges, boundary, nearest, ranges};
use spiral_atlas::recipe::parse_coordinate;
use spiral_atlas::{Error, Result};
use std::path::PathBuf;

/// What to find instead of the answer for the datum.
#[derive(clap::Args)]
#[command(next_help_heading = "Questions beyond yes and no")]
#[command(group(ArgGroup::new("question").args(["ranges", "nearest", "boundary"]).conflicts_with("points")))]
#[command(group(ArgGroup::new("looked").args(["ranges", "boundary"]).multiple(true)))]
pub(super) struct QuestionArgs {
    /// All intervals of this coordinate in which the property holds, the others being given.
    #[arg(long, value_name = "NAME")]
    ranges: Option<String>,
    /// The nearest datum that has the property.
    #[arg(long)]
    nearest: bool,
    /// The outline of the property over two coordinates, such as kappa0,kappa1, the others being given; as polylines.
    #[arg(long, value_name = "NAME,NAME", value_delimiter = ',')]
    boundary: Option<Vec<String>>,
    /// The flag that is asked for; the family's yes unless given.
    #[arg(long, value_name = "NAME", requires = "question")]
    property: Option<String>,
    /// With --ranges or --boundary: where to look, the least and the greatest value; once for each coordinate.
    #[arg(long, value_name = "FROM,TO", allow_hyphen_values = true, requires = "looked")]
    within: Vec<String>,
    /// With --nearest: weights of the coordinates in a distance, in the order of the axes; inf keeps one as it is.
    #[arg(long, value_name = "W,W,..", value_delimiter = ',', requires = "nearest")]
    #[arg(value_parser = numbers::number, allow_hyphen_values = true)]
    weights: Option<Vec<f64>>,
    /// With --boundary: cells along each side, a power of two.
    #[arg(long, value_name = "N", default_value_t = 256, requires = "boundary", allow_hyphen_values = true)]
    cells: usize,
    /// With --boundary: draw the outline.
    #[arg(long, value_name = "FILE.png|svg", requires = "boundary")]
    figure: Option<PathBuf>,
}

/// Dots along each side of a picture, where the property holds.
const DOTS: usize = 40;
const SIZE: (u32, u32) = (1000, 800);

impl QuestionArgs {
    /// Whether anything is asked.
    pub(super) fn any(&self) -> bool {
        self.ranges.is_some() || self.nearest || self.boundary.is_some()
    }

    /// The answer, printed.
    pub(super) fn run(&self, family: &'static dyn Family, coordinates: &Coordinates, json: bool) -> Result<Outcome> {
        output::check_figure(self.figure.as_deref())?;
        let pair = match self.boundary.as_deref() {
            None => None,
            Some([first, second]) if first != second => Some([&first[..], &second[..]]),
            Some(names) => super::refuse(&format!(
                "--boundary is {:?}; it takes the names of two different coordinates, such as kappa0,kappa1",
                names.join(",")
            )),
        };
        let free: Vec<&str> = self.ranges.as_deref().into_iter().chain(pair.into_iter().flatten()).collect();
        if self.within.len() > free.len() {
            super::refuse(&format!("--within is given more than once for each of {}", free.join(", ")));
        }
        let (axes, point) = coordinates.but(family, &free).unwrap_or_else(|what| super::refuse(&what));
        let property = Property::new(family.about().name, axes, self.property.as_deref())?;
        let place = |name: &str| axes.iter().position(|axis| *axis == name).unwrap_or_default();
        let yes = match (pair, &self.ranges) {
            (Some([first, second]), _) => {
                let within = [self.within(0, first)?, self.within(1, second)?];
                let sides = [place(first), place(second)];
                let found = boundary(&property, &point, sides, within, self.cells)?;
                if let Some(path) = &self.figure {
                    output::write_figure(path, &picture(&property, &point, sides, within, &found)?)?;
                }
                print(&found, json, |found| boundary_text([first, second], found))?;
                !found.outlines.is_empty()
            }
            (None, Some(name)) => {
                let found = ranges(&property, &point, place(name), self.within(0, name)?)?;
                print(&found, json, |found| ranges_text(&property, name, found))?;
                !found.ranges.is_empty()
            }
            (None, None) => {
                let ones = vec![1.0; axes.len()];
                let found = nearest(&property, &point, self.weights.as_deref().unwrap_or(&ones))?;
                print(&found, json, |found| nearest_text(&property, found))?;
                found.point.is_some()
            }
        };
        Ok(if yes { Outcome::Fine } else { Outcome::Bad })
    }

    /// Where to look along a coordinate.
    fn within(&self, i: usize, name: &str) -> Result<[f64; 2]> {
        let Some(text) = self.within.get(i) else {
            super::refuse(&format!("give --within FROM,TO for {name}, the interval to look in"));
        };
        let ends = text.split_once(',').ok_or_else(|| {
            Error::invalid(format!(
                "--within is {text:?}; it must be two values with a comma between them, such as 0,10"
            ))
        })?;
        Ok([parse_coordinate(name, ends.0)?, parse_coordinate(name, ends.1)?])
    }
}

/// The outline, and dots where the property holds.
fn picture(
    property: &Property,
    point: &[f64],
    sides: [usize; 2],
    within: [[f64; 2]; 2],
    found: &Boundary,
) -> Result<Drawing> {
    let axes = property.axes();
    let given = axes.iter().zip(point).enumerate().filter(|(i, _)| !sides.contains(i));
    let given: Vec<String> = given.map(|(_, (name, x))| format!("{} = {x:.6}", symbol(name))).collect();
    let mut inside = Vec::new();
    for i in 0..DOTS * DOTS {
        let share = [i % DOTS, i / DOTS].map(|k| (k as f64 + 0.5) / DOTS as f64);
        let at = [0, 1].map(|k| within[k][0] + (within[k][1] - within[k][0]) * share[k]);
        let mut all = point.to_vec();
        (all[sides[0]], all[sides[1]]) = (at[0], at[1]);
        if property.at(&all)? == Some(true) {
            inside.push(at);
        }
    }
    let ring = |outline: &Outline| -> Vec<[f64; 2]> {
        let first = outline.points.first().filter(|_| outline.closed);
        outline.points.iter().chain(first).copied().collect()
    };
    let figure = OutlinesFigure {
        title: format!("{}: {}", property.name(), given.join(", ")),
        note: "dots: it holds; grey: cells that are open".into(),
        names: sides.map(|side| symbol(axes[side])),
        within,
        inside,
        lines: found.outlines.iter().map(ring).collect(),
        open: found.open.clone(),
    };
    draw_outlines(&figure, SIZE)
}

fn print<T: serde::Serialize>(found: &T, json: bool, text: impl Fn(&T) -> String) -> Result<()> {
    if json { output::print_json(found) } else { output::print(&text(found)) }
}

fn ranges_text(property: &Property, name: &str, found: &Ranges) -> String {
    let mut text = String::new();
    for range in &found.ranges {
        let ([a, b], [c, d], [e, f]) = (range.ends, range.inner, range.outer);
        let searched = range.cut.map(|cut| if cut { " (end of the searched range)" } else { "" });
        text += &format!("{} holds for {name} from {a:?}{} to {b:?}{}\n", property.name(), searched[0], searched[1]);
        // Nothing is proved to fail beyond the end of the search, and beside what is not decided.
        let beside = |end: f64| found.open.iter().any(|[low, high]| end == *low || end == *high);
        let fails = match (range.cut[0] || beside(e), range.cut[1] || beside(f)) {
            (false, false) => format!(", and to fail beyond {e:?} and {f:?}"),
            (true, false) => format!(", and to fail beyond {f:?}"),
            (false, true) => format!(", and to fail below {e:?}"),
            (true, true) => String::new(),
        };
        text += &format!("  proved all over {c:?} to {d:?}{fails}\n");
    }
    if found.ranges.is_empty() && found.open.is_empty() {
        text += &format!("{} holds for no {name} there\n", property.name());
    }
    for [a, b] in &found.open {
        text += &format!("not decided for {name} from {a:?} to {b:?}\n");
    }
    text
}

fn nearest_text(property: &Property, found: &Nearest) -> String {
    let Nearest { point, distance, at_least, .. } = found;
    let (Some(point), Some(distance)) = (point, distance) else {
        return match at_least.is_finite() {
            true => format!("no datum with {} was found; any is farther than {at_least:?}\n", property.name()),
            false => format!(
                "no datum that was searched has {}: none with coordinates up to 1e6, of which those with an infinite \
                 weight stay as they are\n",
                property.name()
            ),
        };
    };
    let place: Vec<String> = property.axes().iter().zip(point).map(|(axis, x)| format!("{axis} = {x:?}")).collect();
    format!(
        "{} holds at {}, at a distance of {distance:?}; no datum with it is nearer than {at_least:?}\n",
        property.name(),
        place.join(", ")
    )
}

fn boundary_text([first, second]: [&str; 2], found: &Boundary) -> String {
    let mut text = String::new();
    for outline in &found.outlines {
        let kind = if outline.closed { "closed outline" } else { "outline from border to border" };
        text += &format!("{kind}, {} ({first}, {second}):\n", count(outline.points.len(), "point"));
        outline.points.iter().for_each(|[x, y]| text += &format!("  {x:?} {y:?}\n"));
    }
    let [dx, dy] = found.cell;
    let are = if found.open.len() == 1 { "is" } else { "are" };
    text + &format!("{} of {dx:?} by {dy:?} {are} open beside the outlines\n", count(found.open.len(), "cell"))
}
