//! ASAM OpenDRIVE: a path as a road whose reference line it is.
//!
//! Lines, arcs and clothoids are themselves there. A cubic Bézier curve is a `paramPoly3` in the parameter from 0 to 1,
//! exactly. A PH quintic has degree 5, and `paramPoly3` has 3: it is divided into n equal parts of its parameter, and
//! each becomes the cubic with the same ends and the same derivatives there. For p from [0, 1] to the plane, in any
//! direction u, Hermite's remainder on a part of width h = 1/n is
//!
//! ```text
//! |u (p - q)(t)| <= max |u p''''| h⁴ / 384
//! ```
//!
//! and p'''' = 120 Δ⁴b is linear, with its largest size at an end. So q is no further from p than
//! `120 max(|Δ⁴b0|, |Δ⁴b1|) / (384 n⁴)`, at the same parameter; n is the least that keeps the tolerance. Directions are
//! met at all joints. Curvatures differ there a little, and by how much is reported.

use crate::curve::vector::{Vector, add, cross, length, scale, sub};
use crate::curve::{PhQuintic, arc_length, casteljau};
use crate::error::{Error, Result, positive};
use crate::path::Course;
use crate::transition::{Arc, Clothoid, Cubic, Line, Piece};
use quick_xml::Writer;
use std::io;

/// Parts of one curve at most: with so many even a curve of 1e13 tolerances is met.
const MOST_PARTS: u32 = 2000;

/// How roads are written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OpenDrive {
    /// Width of the one driving lane, which lies to the right of the reference line; metres, above 0.
    pub lane_width: f64,
    /// How far a fitted curve may be from the true one; metres, above 0.
    pub tolerance: f64,
}

/// How well curves were fitted that OpenDRIVE does not have.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Fit {
    /// How many curves were fitted.
    pub curves: usize,
    /// Of how many cubics they are now.
    pub cubics: usize,
    /// None is further from the true curve than this: proved.
    pub error: f64,
    /// Greatest difference of the curvature at a joint from that of the true curve.
    pub curvature: f64,
}

/// One road for each path, as an OpenDRIVE 1.7 file, and how well its curves were fitted.
///
/// # Arguments
/// - `paths`: in metres. Each becomes a road, with the numbers from 1 on; no junctions are made.
///
/// # Errors
/// [`Error::Domain`] for no path, options that are not above 0, a curve whose direction at its start is not defined, a
/// PH quintic that would need more than 2,000 cubics, and pieces that OpenDRIVE does not have: involutes and
/// trigonometric curves.
pub fn opendrive(paths: &[Course], options: &OpenDrive) -> Result<(String, Fit)> {
    positive("the lane width", options.lane_width)?;
    positive("the tolerance", options.tolerance)?;
    if paths.is_empty() {
        return Err(Error::invalid("there is no path; a file has one road at least"));
    }
    let mut fit = Fit::default();
    let mut roads = Vec::with_capacity(paths.len());
    for (i, path) in paths.iter().enumerate() {
        roads.push(geometries(path, options.tolerance, &mut fit).map_err(|e| e.at(format!("paths[{i}]")))?);
    }
    let mut out = Writer::new_with_indent(Vec::new(), b' ', 2);
    write(&mut out, &roads, options.lane_width).map_err(|e| Error::invalid(format!("OpenDRIVE: {e}")))?;
    let text = String::from_utf8_lossy(&out.into_inner()).into_owned();
    Ok((format!("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n{text}\n"), fit))
}

/// One `geometry`.
struct Geometry {
    start: Vector,
    heading: f64,
    length: f64,
    shape: Primitive,
}

enum Primitive {
    Line,
    Arc {
        curvature: f64,
    },
    /// A clothoid, with the curvatures at its ends.
    Spiral([f64; 2]),
    /// The powers 1 to 3 of u and v; those of 0 are 0.
    Cubic {
        u: [f64; 3],
        v: [f64; 3],
    },
}

fn geometries(path: &Course, tolerance: f64, fit: &mut Fit) -> Result<Vec<Geometry>> {
    let mut all = Vec::new();
    for (i, piece) in path.pieces().iter().enumerate() {
        let blame = |what: String| Error::invalid(format!("pieces[{i}] {what}"));
        match piece {
            Piece::Line(Line { start, end }) => {
                let [x, y] = sub(*end, *start);
                all.push(Geometry { start: *start, heading: y.atan2(x), length: x.hypot(y), shape: Primitive::Line });
            }
            Piece::Arc(Arc { start, start_direction, curvature, length }) => {
                let shape = if *curvature == 0.0 { Primitive::Line } else { Primitive::Arc { curvature: *curvature } };
                all.push(Geometry { start: *start, heading: *start_direction, length: *length, shape });
            }
            Piece::Clothoid(Clothoid { start, start_direction, curvature, end_curvature, length }) => {
                let shape = Primitive::Spiral([*curvature, *end_curvature]);
                all.push(Geometry { start: *start, heading: *start_direction, length: *length, shape });
            }
            Piece::Cubic(Cubic { points, legs }) => all.push(cubic(points.p[0], *legs).map_err(blame)?),
            Piece::PhQuintic(curve) => all.extend(fitted(curve, tolerance, fit).map_err(blame)?),
            Piece::Involute(_) | Piece::TrigQuintic(_) => {
                return Err(blame(format!(
                    "is of the kind `{}`, which OpenDRIVE does not have; ask for a curve of the family cubic or \
                     ph-quintic",
                    piece.kind().name()
                )));
            }
        }
    }
    Ok(all)
}

/// A cubic from the sides of its polygon.
fn cubic(start: Vector, legs: [Vector; 3]) -> Result<Geometry, String> {
    let [first, second, third] = legs;
    let along = length(first);
    if along.is_nan() || along <= 0.0 {
        return Err("stands still at its start, so that it has no direction there".into());
    }
    let [c, s] = scale(first, 1.0 / along);
    // In the frame of the start.
    let own = |[x, y]: Vector| [c * x + s * y, c * y - s * x];
    let (second, third) = (own(second), own(third));
    let bend = [second[0] - along, second[1]];
    let last = [third[0] - 2.0 * second[0] + along, third[1] - 2.0 * second[1]];
    let polygon = legs.map(|leg| scale(leg, 3.0));
    let speed = |t: f64| length(casteljau(&mut polygon.clone(), t));
    Ok(Geometry {
        start,
        heading: s.atan2(c),
        length: arc_length(speed, 0.0, 1.0),
        shape: Primitive::Cubic { u: [3.0 * along, 3.0 * bend[0], last[0]], v: [0.0, 3.0 * bend[1], last[1]] },
    })
}

/// A PH quintic as cubics, near enough.
fn fitted(curve: &PhQuintic, tolerance: f64, fit: &mut Fit) -> Result<Vec<Geometry>, String> {
    // From the start as origin: far away points lose digits, and legs do not.
    let own = PhQuintic::new([0.0, 0.0], curve.preimage);
    let mut d = own.legs().to_vec();
    for _ in 0..3 {
        d = d.windows(2).map(|w| sub(w[1], w[0])).collect();
    }
    let bend = 120.0 * d.iter().fold(0.0, |most: f64, v| most.max(length(*v)));
    let parts = (bend / 384.0 / tolerance).powf(0.25).ceil().max(1.0);
    if parts.is_nan() || parts > f64::from(MOST_PARTS) {
        return Err(format!(
            "would be more cubics than {MOST_PARTS}, the most that are made; allow a larger tolerance than \
             {tolerance:?}"
        ));
    }
    let mut all = Vec::with_capacity(parts as usize);
    let mut from = own.jet(0.0);
    for i in 1..=parts as u32 {
        let to = own.jet(f64::from(i) / parts);
        let [first, last] = [from.first, to.first].map(|d| scale(d, 1.0 / (3.0 * parts)));
        let legs = [first, sub(sub(to.point, from.point), add(first, last)), last];
        all.push(cubic(add(curve.start, from.point), legs)?);
        let bends = [(legs[0], legs[1], legs[0]), (legs[1], legs[2], legs[2])];
        for ((a, b, end), at) in bends.into_iter().zip([&from, &to]) {
            // Of a cubic Bézier curve at an end.
            let curvature = 2.0 / 3.0 * cross(a, b) / length(end).powi(3);
            fit.curvature = fit.curvature.max((curvature - at.curvature()).abs());
        }
        from = to;
    }
    fit.curves += 1;
    fit.cubics += all.len();
    fit.error = fit.error.max(bend / 384.0 / parts.powi(4));
    Ok(all)
}

fn write(out: &mut Writer<Vec<u8>>, roads: &[Vec<Geometry>], width: f64) -> io::Result<()> {
    let number = |x: f64| format!("{x:?}");
    out.create_element("OpenDRIVE").write_inner_content(|out| {
        out.create_element("header")
            .with_attributes([("revMajor", "1"), ("revMinor", "7"), ("name", "spiral-atlas"), ("version", "1.00")])
            .write_empty()?;
        for (i, road) in roads.iter().enumerate() {
            let length: f64 = road.iter().map(|g| g.length).sum();
            out.create_element("road")
                .with_attributes([
                    ("name", &*format!("path {i}")),
                    ("length", &number(length)),
                    ("id", &(i + 1).to_string()),
                    ("junction", "-1"),
                    ("rule", "RHT"),
                ])
                .write_inner_content(|out| {
                    out.create_element("link").write_empty()?;
                    out.create_element("planView").write_inner_content(|out| plan_view(out, road))?;
                    out.create_element("elevationProfile").write_empty()?;
                    out.create_element("lateralProfile").write_empty()?;
                    out.create_element("lanes").write_inner_content(|out| lanes(out, width))?;
                    Ok(())
                })?;
        }
        Ok(())
    })?;
    Ok(())
}

fn plan_view(out: &mut Writer<Vec<u8>>, road: &[Geometry]) -> io::Result<()> {
    let mut station = 0.0;
    for Geometry { start, heading, length, shape } in road {
        let place = [("s", station), ("x", start[0]), ("y", start[1]), ("hdg", *heading), ("length", *length)];
        let place = place.map(|(name, x)| (name, format!("{x:?}")));
        out.create_element("geometry")
            .with_attributes(place.iter().map(|(name, x)| (*name, &x[..])))
            .write_inner_content(|out| {
                match shape {
                    Primitive::Line => out.create_element("line").write_empty()?,
                    Primitive::Arc { curvature } => out
                        .create_element("arc")
                        .with_attribute(("curvature", &*format!("{curvature:?}")))
                        .write_empty()?,
                    Primitive::Spiral([first, last]) => out
                        .create_element("spiral")
                        .with_attribute(("curvStart", &*format!("{first:?}")))
                        .with_attribute(("curvEnd", &*format!("{last:?}")))
                        .write_empty()?,
                    Primitive::Cubic { u, v } => {
                        let names = ["aU", "bU", "cU", "dU", "aV", "bV", "cV", "dV"];
                        let numbers = [0.0, u[0], u[1], u[2], 0.0, v[0], v[1], v[2]].map(|x| format!("{x:?}"));
                        out.create_element("paramPoly3")
                            .with_attributes(names.iter().zip(&numbers).map(|(name, x)| (*name, &x[..])))
                            .with_attribute(("pRange", "normalized"))
                            .write_empty()?
                    }
                };
                Ok(())
            })?;
        station += length;
    }
    Ok(())
}

fn lanes(out: &mut Writer<Vec<u8>>, width: f64) -> io::Result<()> {
    let lane = |id: &'static str, kind: &'static str| [("id", id), ("type", kind), ("level", "false")];
    out.create_element("laneSection").with_attribute(("s", "0.0")).write_inner_content(|out| {
        out.create_element("center").write_inner_content(|out| {
            out.create_element("lane").with_attributes(lane("0", "none")).write_empty()?;
            Ok(())
        })?;
        out.create_element("right").write_inner_content(|out| {
            out.create_element("lane").with_attributes(lane("-1", "driving")).write_inner_content(|out| {
                out.create_element("width")
                    .with_attributes([
                        ("sOffset", "0.0"),
                        ("a", &*format!("{width:?}")),
                        ("b", "0.0"),
                        ("c", "0.0"),
                        ("d", "0.0"),
                    ])
                    .write_empty()?;
                Ok(())
            })?;
            Ok(())
        })?;
        Ok(())
    })?;
    Ok(())
}
