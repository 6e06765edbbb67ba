//! Pieces as JSON has them: one flat object for all kinds, so that a mistake is reported by the name of its field.

use super::{Arc, Cubic, InvoluteBetween, Kind, Line, Piece, TrigPart};
use crate::curve::vector::{add, length, sub};
use crate::curve::{CubicBezier, PhQuintic, TrigBezier};
use crate::error::{Error, Result, above_zero};
use crate::plain::count;
use crate::transition::{Clothoid, Ends};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

/// A given end may miss the end of the curve by this share of the curve's size and place, for roundings of whoever
/// wrote it.
const NEAR: f64 = 1e-10;

type Points<const N: usize> = [[f64; 2]; N];

/// All fields of all kinds.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(rename = "piece", deny_unknown_fields)]
struct RawPiece {
    #[serde(deserialize_with = "crate::plain::name")]
    kind: Kind,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    start: Option<[f64; 2]>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    end: Option<[f64; 2]>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    start_direction: Option<f64>,
    /// Of a line or an arc, at its start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    direction: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    end_direction: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    start_curvature: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    end_curvature: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    turns: Option<[u32; 2]>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    curvature: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    preimage: Option<[[f64; 2]; 3]>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    p: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    q: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    from: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    to: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    legs: Option<Vec<[f64; 2]>>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    control_points: Option<Vec<[f64; 2]>>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    length: Option<f64>,
}

impl Serialize for Piece {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        RawPiece::of(self).serialize(serializer)
    }
}

impl Serialize for PhQuintic {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        Piece::PhQuintic(*self).serialize(serializer)
    }
}

impl RawPiece {
    fn of(piece: &Piece) -> RawPiece {
        let of = |kind: Kind| RawPiece {
            kind,
            start: None,
            end: None,
            start_direction: None,
            direction: None,
            end_direction: None,
            start_curvature: None,
            end_curvature: None,
            turns: None,
            curvature: None,
            preimage: None,
            p: None,
            q: None,
            from: None,
            to: None,
            legs: None,
            control_points: piece.control_points(),
            length: Some(piece.length()),
        };
        match piece {
            Piece::Cubic(cubic) => RawPiece { legs: Some(cubic.legs.to_vec()), ..of(Kind::Cubic) },
            Piece::PhQuintic(PhQuintic { start, end, preimage }) => {
                RawPiece { start: Some(*start), end: Some(*end), preimage: Some(*preimage), ..of(Kind::PhQuintic) }
            }
            Piece::TrigQuintic(TrigPart { curve, from, to }) => RawPiece {
                p: Some(curve.p),
                q: Some(curve.q),
                from: Some(*from),
                to: Some(*to),
                legs: Some(curve.sides.to_vec()),
                ..of(Kind::TrigQuintic)
            },
            Piece::Involute(InvoluteBetween { ends, turns, .. }) => {
                let Ends { start, end, start_direction, end_direction, start_curvature, end_curvature } = *ends;
                RawPiece {
                    start: Some(start),
                    end: Some(end),
                    start_direction: Some(start_direction),
                    end_direction: Some(end_direction),
                    start_curvature: Some(start_curvature),
                    end_curvature: Some(end_curvature),
                    turns: Some(*turns),
                    ..of(Kind::Involute)
                }
            }
            Piece::Line(Line { start, end }) => RawPiece {
                start: Some(*start),
                end: Some(*end),
                direction: Some(piece.at(0.0).heading),
                curvature: Some(0.0),
                ..of(Kind::Line)
            },
            Piece::Arc(Arc { start, start_direction, curvature, .. }) => RawPiece {
                start: Some(*start),
                end: Some(piece.end()),
                direction: Some(*start_direction),
                curvature: Some(*curvature),
                ..of(Kind::Arc)
            },
            Piece::Clothoid(Clothoid { start, start_direction, curvature, end_curvature, .. }) => RawPiece {
                start: Some(*start),
                end: Some(piece.end()),
                direction: Some(*start_direction),
                curvature: Some(*curvature),
                end_curvature: Some(*end_curvature),
                ..of(Kind::Clothoid)
            },
        }
    }

    /// A field that the kind needs.
    fn needs<T>(&self, name: &str, field: Option<T>) -> Result<T> {
        field.ok_or_else(|| Error::invalid(format!("a piece of the kind `{}` needs `{name}`", self.kind.name())))
    }

    /// So many points of a list.
    fn all<const N: usize>(&self, name: &str, list: &[[f64; 2]]) -> Result<Points<N>> {
        let wrong = |_| {
            Error::invalid(format!(
                "`{name}` has {}; a piece of the kind `{}` has {N}",
                count(list.len(), "point"),
                self.kind.name()
            ))
        };
        list.try_into().map_err(wrong)
    }

    /// Control points, and the sides between them as given or else their differences.
    fn polygon<const N: usize, const M: usize>(&self) -> Result<(Points<N>, Points<M>)> {
        let points: [_; N] = self.all("control_points", &self.needs("control_points", self.control_points.clone())?)?;
        let legs = match &self.legs {
            Some(legs) => self.all("legs", legs)?,
            None => std::array::from_fn(|i| sub(points[i + 1], points[i])),
        };
        near(
            "`legs` lead",
            legs.iter().fold(points[0], |at, leg| add(at, *leg)),
            "`control_points` end at",
            points[N - 1],
            &points,
        )?;
        Ok((points, legs))
    }

    fn piece(&self) -> Result<Piece> {
        let RawPiece { start, end, start_direction, curvature, .. } = *self;
        let numbers = [self.p, self.q, self.from, self.to, start_direction, self.end_direction, self.start_curvature];
        let more = [self.end_curvature, self.direction, curvature, self.length];
        let points = [start, end].into_iter().flatten().chain(self.preimage.into_iter().flatten());
        let lists = self.legs.iter().flatten().chain(self.control_points.iter().flatten()).copied();
        let all = numbers.into_iter().chain(more).flatten().chain(points.chain(lists).flatten());
        if let Some(x) = all.into_iter().find(|x| !x.is_finite()) {
            return Err(Error::invalid(format!("{x:?} is no number of a `{}`; all must be finite", self.kind.name())));
        }
        match self.kind {
            Kind::Cubic => {
                let (points, legs) = self.polygon()?;
                Ok(Piece::Cubic(Cubic { points: CubicBezier { p: points }, legs }))
            }
            Kind::PhQuintic => {
                ph(self.needs("start", start)?, end, self.needs("preimage", self.preimage)?).map(Piece::PhQuintic)
            }
            Kind::TrigQuintic => {
                let (points, sides) = self.polygon()?;
                let (p, q) = (self.needs("p", self.p)?, self.needs("q", self.q)?);
                let (from, to) = (self.from.unwrap_or(0.0), self.to.unwrap_or(1.0));
                if !(0.0 <= from && from < to && to <= 1.0) {
                    let what = format!(
                        "`from` is {from:?} and `to` is {to:?}; they must be 0 to 1, the first below the second"
                    );
                    return Err(Error::invalid(what));
                }
                let curve = TrigBezier { sides, ..TrigBezier::new(points, p, q)? };
                Ok(Piece::TrigQuintic(TrigPart { curve, from, to }))
            }
            Kind::Involute => {
                let ends = Ends {
                    start: self.needs("start", start)?,
                    end: self.needs("end", end)?,
                    start_direction: self.needs("start_direction", start_direction)?,
                    end_direction: self.needs("end_direction", self.end_direction)?,
                    start_curvature: self.needs("start_curvature", self.start_curvature)?,
                    end_curvature: self.needs("end_curvature", self.end_curvature)?,
                };
                InvoluteBetween::new(&ends, self.turns.unwrap_or_default()).map(Piece::Involute)
            }
            Kind::Line => {
                let (start, end) = (self.needs("start", start)?, self.needs("end", end)?);
                if start == end {
                    return Err(Error::invalid(format!(
                        "`start` and `end` are both {start:?}; a line has two different ends"
                    )));
                }
                Ok(Piece::Line(Line { start, end }))
            }
            Kind::Arc => {
                let (start, start_direction) = (self.needs("start", start)?, self.needs("direction", self.direction)?);
                let (curvature, length) = (self.needs("curvature", curvature)?, self.needs("length", self.length)?);
                above_zero("`length` of an arc", length)?;
                let piece = Piece::Arc(Arc { start, start_direction, curvature, length });
                let reached = piece.end();
                near("the arc leads", reached, "`end` is", end.unwrap_or(reached), &[start, [length, length]])?;
                Ok(piece)
            }
            Kind::Clothoid => {
                let (start, start_direction) = (self.needs("start", start)?, self.needs("direction", self.direction)?);
                let (curvature, length) = (self.needs("curvature", curvature)?, self.needs("length", self.length)?);
                let end_curvature = self.needs("end_curvature", self.end_curvature)?;
                above_zero("`length` of a clothoid", length)?;
                let clothoid = Clothoid { start, start_direction, curvature, end_curvature, length };
                let (angle, most) = (clothoid.angle_bound(), Clothoid::MOST_ANGLE);
                if angle > most {
                    let what = "the length of a clothoid times its greater curvature";
                    let way_out = "divide it into shorter ones";
                    return Err(Error::domain(what, angle, format!("at most {most}")).or(way_out));
                }
                let piece = Piece::Clothoid(clothoid);
                let reached = piece.end();
                near("the clothoid leads", reached, "`end` is", end.unwrap_or(reached), &[start, [length, length]])?;
                Ok(piece)
            }
        }
    }
}

impl<'de> Deserialize<'de> for Piece {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> std::result::Result<Piece, D::Error> {
        RawPiece::deserialize(deserializer)?.piece().map_err(de::Error::custom)
    }
}

/// With the end as given, if the pre-image leads there.
fn ph(start: [f64; 2], end: Option<[f64; 2]>, preimage: [[f64; 2]; 3]) -> Result<PhQuintic> {
    let curve = PhQuintic::new(start, preimage);
    if !curve.is_finite() {
        return Err(Error::invalid(format!(
            "it is not finite: it starts at {start:?} with the pre-image {preimage:?}"
        )));
    }
    let Some(end) = end else { return Ok(curve) };
    let size = preimage.iter().flatten().map(|x| x * x).sum::<f64>();
    near("the pre-image leads", curve.end, "`end` is", end, &[start, [size, 0.0]])?;
    Ok(PhQuintic::between(start, end, preimage))
}

/// Refuses an end that is not where the curve leads.
fn near(way: &str, reached: [f64; 2], name: &str, given: [f64; 2], sizes: &[[f64; 2]]) -> Result<()> {
    let size = sizes.iter().flatten().fold(0.0f64, |most, x| most.max(x.abs()));
    if length(sub(reached, given)) <= NEAR * size {
        return Ok(());
    }
    Err(Error::invalid(format!("{name} {given:?}, but {way} to {reached:?}")))
}
