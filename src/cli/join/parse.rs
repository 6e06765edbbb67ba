//! Ends as they are typed, and as rows of a table have them.

use spiral_atlas::Result;
use spiral_atlas::recipe::{parse_angle, parse_curvature, parse_number};
use spiral_atlas::transition::Turn;
use spiral_atlas::transition::join::{End, State};

/// Columns, in the order of [`states`].
pub(crate) const COLUMNS: [&str; 8] = ["x0", "y0", "direction0", "curvature0", "x1", "y1", "direction1", "curvature1"];

/// The states of a row.
pub(crate) fn states(cells: &[&str]) -> Result<[State; 2]> {
    let number = |i: usize| parse_number(cells[i]).map_err(|e| e.at(COLUMNS[i]));
    let curvature = |i: usize| parse_curvature(cells[i]).map_err(|e| e.at(COLUMNS[i]));
    let angle = |i: usize| parse_angle(cells[i]).map_err(|e| e.at(COLUMNS[i]));
    let state = |i: usize| -> Result<State> {
        Ok(State { point: [number(i)?, number(i + 1)?], direction: angle(i + 2)?, curvature: curvature(i + 3)? })
    };
    Ok([state(0)?, state(4)?])
}

type Parsed<T> = std::result::Result<T, String>;

fn cells(text: &str) -> Vec<&str> {
    text.split(',').map(str::trim).collect()
}

fn number(cell: &str) -> Option<f64> {
    cell.parse().ok().filter(|x: &f64| x.is_finite())
}

fn angle(cell: &str) -> Parsed<f64> {
    parse_angle(cell).map_err(|e| e.to_string())
}

/// Point, direction and perhaps curvature.
pub(crate) fn state(text: &str) -> Parsed<End> {
    let wrong = || format!("{text:?} is no state `x,y,angle` or `x,y,angle,curvature` of finite numbers");
    let (x, y, direction, curvature) = match cells(text)[..] {
        [x, y, direction] => (x, y, direction, Some(0.0)),
        [x, y, direction, curvature] => (x, y, direction, parse_curvature(curvature).ok().filter(|k| k.is_finite())),
        _ => return Err(wrong()),
    };
    let (Some(x), Some(y), Some(curvature)) = (number(x), number(y), curvature) else { return Err(wrong()) };
    Ok(State { point: [x, y], direction: angle(direction)?, curvature }.into())
}

/// Point and direction.
pub(crate) fn line(text: &str) -> Parsed<End> {
    let wrong = || format!("{text:?} is no line `x,y,angle` of finite numbers");
    let [x, y, direction] = cells(text)[..] else { return Err(wrong()) };
    let (Some(x), Some(y)) = (number(x), number(y)) else { return Err(wrong()) };
    Ok(End::Line { point: [x, y], direction: angle(direction)? })
}

/// Centre, radius and side.
pub(crate) fn circle(text: &str) -> Parsed<End> {
    let wrong = || format!("{text:?} is no circle `x,y,radius,left` or `x,y,radius,right` of finite numbers");
    let [x, y, radius, side] = cells(text)[..] else { return Err(wrong()) };
    let turn = match &side.to_lowercase()[..] {
        "left" => Turn::Left,
        "right" => Turn::Right,
        _ => return Err(wrong()),
    };
    let (Some(x), Some(y), Some(radius)) = (number(x), number(y), number(radius)) else { return Err(wrong()) };
    Ok(End::Circle { centre: [x, y], radius, turn })
}
