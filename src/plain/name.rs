//! Names of an enum without data, and of the fields of a struct.

use serde::de::value::Error as Unread;
use serde::de::{Error, IntoDeserializer, Visitor};
use serde::{Deserialize, Deserializer, forward_to_deserialize_any};
use std::fmt;
use std::marker::PhantomData;

/// Reads one of the names of an enum without data. Derived readers of enums have no words for what is no text, and some
/// formats then call the whole text broken.
///
/// # Errors
/// With the names that there are, and what stands there.
pub fn name<'de, T: Deserialize<'de>, D: Deserializer<'de>>(from: D) -> Result<T, D::Error> {
    struct Name<T>(PhantomData<T>);

    impl<'de, T: Deserialize<'de>> Visitor<'de> for Name<T> {
        type Value = T;

        fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
            let names: Vec<String> = names::<T>().iter().map(|name| format!("\"{name}\"")).collect();
            write!(f, "one of {}", names.join(", "))
        }

        fn visit_str<E: Error>(self, text: &str) -> Result<T, E> {
            T::deserialize(text.into_deserializer())
        }
    }

    from.deserialize_str(Name(PhantomData))
}

/// The names that a derived reader knows: those of the fields of a struct or of the variants of an enum.
pub fn names<'de, T: Deserialize<'de>>() -> Vec<String> {
    let asked = T::deserialize(Asked).err().map(|names| names.to_string()).unwrap_or_default();
    asked.split_whitespace().map(str::to_owned).collect()
}

/// Gives a derived reader nothing to read, but an error that lists the names it asked for.
struct Asked;

impl<'de> Deserializer<'de> for Asked {
    type Error = Unread;

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &str,
        names: &'static [&'static str],
        _: V,
    ) -> Result<V::Value, Unread> {
        Err(Unread::custom(names.join(" ")))
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &str,
        names: &'static [&'static str],
        _: V,
    ) -> Result<V::Value, Unread> {
        Err(Unread::custom(names.join(" ")))
    }

    fn deserialize_any<V: Visitor<'de>>(self, _: V) -> Result<V::Value, Unread> {
        Err(Unread::custom(""))
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf option unit unit_struct
        newtype_struct seq tuple tuple_struct map identifier ignored_any
    }
}
