//! Reads requests by the names of their fields, and says where a mistake is, in plain words.

use crate::plain::{self, bare_angle, parse_angle};
use serde::de::value::MapAccessDeserializer;
use serde::de::{DeserializeOwned, MapAccess, Visitor};
use serde::{Deserialize, Deserializer};
use std::fmt;
use std::marker::PhantomData;

/// What a text in JSON says.
///
/// # Errors
/// What is wrong, after the path of where: `paths[1].start: ...`.
pub fn json<T: DeserializeOwned>(text: &str) -> Result<T, String> {
    let mut json = serde_json::Deserializer::from_str(text);
    let value = at_path(&mut json, plain::json)?;
    json.end().map_err(|e| plain::json("", &e))?;
    Ok(value)
}

/// What a format's reader gives, as an object; `blame` makes a sentence of a path and the mistake there.
///
/// # Errors
/// What `blame` makes.
pub fn at_path<'de, T: Deserialize<'de>, D: Deserializer<'de>>(
    from: D,
    blame: impl Fn(&str, &D::Error) -> String,
) -> Result<T, String> {
    let read: Result<Named<T>, _> = serde_path_to_error::deserialize(from);
    // A path ends with `?` where there is no key yet.
    read.map(|named| named.0).map_err(|e| blame(e.path().to_string().trim_end_matches(['.', '?']), e.inner()))
}

/// Objects in a list: [`Named`], each.
///
/// # Errors
/// Those of the format.
pub fn objects<'de, T: Deserialize<'de>, D: Deserializer<'de>>(from: D) -> Result<Vec<T>, D::Error> {
    Ok(Vec::deserialize(from)?.into_iter().map(|Named(object)| object).collect())
}

/// A struct that was written as an object. Derived readers take a list of its values too, where nothing shows that two
/// were exchanged.
#[derive(Debug)]
pub struct Named<T>(
    /// It.
    pub T,
);

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Named<T> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_map(Fields(PhantomData)).map(Named)
    }
}

struct Fields<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for Fields<T> {
    type Value = T;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "an object with the fields {}", plain::names::<T>().join(", "))
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<T, A::Error> {
        T::deserialize(MapAccessDeserializer::new(map))
    }
}

/// An angle: a number of radians up to a full turn, or text like `40deg`.
///
/// # Errors
/// Where it is neither.
pub fn angle<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    struct Angle;

    impl Visitor<'_> for Angle {
        type Value = f64;

        fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
            write!(f, "an angle, a number of radians or a text like \"40deg\"")
        }

        fn visit_f64<E: serde::de::Error>(self, x: f64) -> Result<f64, E> {
            bare_angle(x).map_err(E::custom)
        }

        fn visit_i64<E: serde::de::Error>(self, x: i64) -> Result<f64, E> {
            self.visit_f64(x as f64)
        }

        fn visit_u64<E: serde::de::Error>(self, x: u64) -> Result<f64, E> {
            self.visit_f64(x as f64)
        }

        fn visit_str<E: serde::de::Error>(self, text: &str) -> Result<f64, E> {
            parse_angle(text).map_err(E::custom)
        }
    }

    from.deserialize_any(Angle)
}
