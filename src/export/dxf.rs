//! DXF, which programs for technical drawing read: each piece as an entity of the kind that it is.
//!
//! A cubic Bézier curve is a spline of degree 3 with its control points, and a PH quintic one of degree 5, both
//! exactly: their knots are 0 and 1, degree + 1 times each. Numbers have 12 decimals there.

use crate::curve::vector::{Vector, add, length, scale};
use crate::error::{Error, Result};
use crate::path::Course;
use crate::transition::{self, Piece};
use ::dxf::entities::{Arc, Entity, EntityType, Line, Spline};
use ::dxf::enums::AcadVersion;
use ::dxf::{Drawing, Point};
use chrono::{Local, TimeZone};
use std::f64::consts::{FRAC_PI_2, PI};

/// Shortest piece, and longest coordinate or radius: 12 decimals are 9 digits and more of the one, and a double has no
/// more than 12 decimals of the other.
const RANGE: [f64; 2] = [1e-3, 1e9];

/// One drawing of all paths, a layer `PATH_1`, `PATH_2`, .. for each, as a DXF file of the version R2000.
///
/// Lines and arcs are `LINE` and `ARC`; cubic curves and PH quintics are `SPLINE`. An arc's ends are met to 1e-14 of
/// its radius, everything else to 1e-12. The drawing's extents hold all of it, control points included. The bytes
/// depend on the paths alone.
///
/// # Errors
/// [`Error::Domain`] for no path, pieces shorter than 1e-3, coordinates or radii beyond 1e9, and pieces that DXF does
/// not have: involutes, trigonometric curves and clothoids.
pub fn dxf(paths: &[Course]) -> Result<Vec<u8>> {
    if paths.is_empty() {
        return Err(Error::invalid("there is no path; a drawing has one at least"));
    }
    let mut drawing = Drawing::new();
    timeless(&mut drawing);
    let (mut least, mut most) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for (i, path) in paths.iter().enumerate() {
        for (j, piece) in path.pieces().iter().enumerate() {
            let specific = entity(piece).map_err(|e| e.at(format!("paths[{i}].pieces[{j}]")))?;
            let mut entity = Entity::new(specific);
            entity.common.layer = format!("PATH_{}", i + 1);
            drawing.add_entity(entity);
            for at in extent(piece) {
                least = [0, 1].map(|k| least[k].min(at[k]));
                most = [0, 1].map(|k| most[k].max(at[k]));
            }
        }
    }
    drawing.header.minimum_drawing_extents = Point::new(least[0], least[1], 0.0);
    drawing.header.maximum_drawing_extents = Point::new(most[0], most[1], 0.0);
    let mut bytes = Vec::new();
    drawing.save(&mut bytes).map_err(|e| Error::invalid(format!("DXF: {e}")))?;
    Ok(bytes)
}

/// Takes out what would make each file another: times of making, and random names.
fn timeless(drawing: &mut Drawing) {
    let header = &mut drawing.header;
    header.version = AcadVersion::R2000;
    // Local times are written as clocks show them, so they are set by the clock.
    let clock = Local.with_ymd_and_hms(2000, 1, 1, 12, 0, 0).earliest().unwrap_or_default();
    (header.creation_date, header.update_date) = (clock, clock);
    (header.creation_date_universal, header.update_date_universal) = Default::default();
    header.fingerprint_guid = Default::default();
    header.version_guid = Default::default();
}

/// Points whose box holds a piece: control points, ends, and where an arc runs along an axis.
fn extent(piece: &Piece) -> Vec<Vector> {
    let mut all = piece.control_points().unwrap_or_else(|| vec![piece.start(), piece.end()]);
    if let Piece::Arc(transition::Arc { start_direction: from, curvature, length, .. }) = piece {
        let turned = curvature * length;
        let quarters = [*from, from + turned].map(|direction| direction / FRAC_PI_2);
        let [first, last] = [quarters[0].min(quarters[1]).ceil(), quarters[0].max(quarters[1]).floor()];
        // Four of them are all that differ.
        let along = (0..4).map(|n| first + f64::from(n)).filter(|quarter| *quarter <= last);
        all.extend(along.map(|quarter| piece.at((quarter * FRAC_PI_2 - from) / turned).point));
    }
    all
}

fn entity(piece: &Piece) -> Result<EntityType> {
    let long = piece.length();
    if long < RANGE[0] {
        return Err(Error::domain("its length", long, "at least 1e-3").or("choose a smaller unit of length"));
    }
    match piece {
        Piece::Line(line) => Ok(EntityType::Line(Line::new(point(line.start)?, point(line.end)?))),
        Piece::Arc(arc) if arc.curvature == 0.0 => {
            let end = add(arc.start, scale([arc.start_direction.cos(), arc.start_direction.sin()], arc.length));
            Ok(EntityType::Line(Line::new(point(arc.start)?, point(end)?)))
        }
        Piece::Arc(arc) => round(arc),
        Piece::Cubic(_) | Piece::PhQuintic(_) => spline(&piece.control_points().unwrap_or_default()),
        Piece::Involute(_) | Piece::TrigQuintic(_) | Piece::Clothoid(_) => Err(Error::invalid(format!(
            "it is of the kind `{}`, which DXF does not have; ask for a curve of the family cubic or ph-quintic",
            piece.kind().name()
        ))),
    }
}

/// An arc; in the file they all go counter-clockwise.
fn round(arc: &transition::Arc) -> Result<EntityType> {
    let radius = 1.0 / arc.curvature.abs();
    let side = FRAC_PI_2.copysign(arc.curvature);
    let to_centre = arc.start_direction + side;
    let centre = add(arc.start, scale([to_centre.cos(), to_centre.sin()], radius));
    // Seen from the centre.
    let (from, to) = (to_centre + PI, to_centre + PI + arc.curvature * arc.length);
    let [from, to] = if arc.curvature > 0.0 { [from, to] } else { [to, from] };
    let degrees = |angle: f64| angle.to_degrees().rem_euclid(360.0);
    if radius > RANGE[1] {
        return Err(Error::domain("its radius", radius, "at most 1e9").or("choose a larger unit, or a line"));
    }
    Ok(EntityType::Arc(Arc::new(point(centre)?, radius, degrees(from), degrees(to))))
}

/// A Bézier curve.
fn spline(points: &[Vector]) -> Result<EntityType> {
    let degree = points.len() - 1;
    Ok(EntityType::Spline(Spline {
        // Planar, with the plane's normal.
        flags: 8,
        degree_of_curve: degree as i32,
        knot_values: (0..2 * (degree + 1)).map(|i| if i <= degree { 0.0 } else { 1.0 }).collect(),
        control_points: points.iter().map(|p| point(*p)).collect::<Result<_>>()?,
        ..Default::default()
    }))
}

fn point(at: Vector) -> Result<Point> {
    if length(at) > RANGE[1] {
        let [x, y] = at;
        return Err(Error::invalid(format!(
            "the point {x}, {y} is beyond 1e9; move the path, or choose a larger unit"
        )));
    }
    Ok(Point::new(at[0], at[1], 0.0))
}
