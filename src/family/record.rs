//! Records that Rust packs and a shader reads, each from one list of fields: so the two cannot drift apart.

/// A kind of field.
pub(super) trait Field: Copy {
    /// Its type in WGSL.
    const WGSL: &'static str;
    /// How many f32 words it takes.
    const WORDS: usize;

    /// Appends its words.
    fn push(self, words: &mut Vec<f32>);

    /// The WGSL expression that makes it of its words, which are expressions too.
    fn read(words: &[String]) -> String;
}

impl Field for f32 {
    const WGSL: &'static str = "f32";
    const WORDS: usize = 1;

    fn push(self, words: &mut Vec<f32>) {
        words.push(self);
    }

    fn read(words: &[String]) -> String {
        words[0].clone()
    }
}

impl Field for bool {
    const WGSL: &'static str = "bool";
    const WORDS: usize = 1;

    fn push(self, words: &mut Vec<f32>) {
        words.push(f32::from(u8::from(self)));
    }

    fn read(words: &[String]) -> String {
        format!("{} > 0.0", words[0])
    }
}

macro_rules! vector {
    ($count:literal, $wgsl:literal) => {
        impl Field for [f32; $count] {
            const WGSL: &'static str = $wgsl;
            const WORDS: usize = $count;

            fn push(self, words: &mut Vec<f32>) {
                words.extend(self);
            }

            fn read(words: &[String]) -> String {
                format!("{}({})", $wgsl, words.join(", "))
            }
        }
    };
}
vector!(2, "vec2<f32>");
vector!(3, "vec3<f32>");

/// A record: [`record!`](super::record::record) makes them.
pub(super) trait Record {
    /// Appends its words, in the order of its fields.
    fn push(&self, words: &mut Vec<f32>);

    /// Its words.
    fn words(&self) -> Vec<f32> {
        let mut words = Vec::new();
        self.push(&mut words);
        words
    }

    /// The struct `Name` in WGSL, `NAME_WORDS`, and `read_name(at)`, which reads one at a place of `inputs`.
    fn wgsl() -> String;
}

/// A field of a record in WGSL: its name, its type, the number of its words, and what makes it of them.
pub(super) type FieldText = (&'static str, &'static str, usize, fn(&[String]) -> String);

/// The text of [`Record::wgsl`].
pub(super) fn wgsl(name: &str, fields: &[FieldText]) -> String {
    let mut members = String::new();
    let mut reads = Vec::new();
    let mut at = 0;
    for (field, kind, words, read) in fields {
        members += &format!("    {field}: {kind},\n");
        let place = |i: usize| if i == 0 { "inputs[at]".to_owned() } else { format!("inputs[at + {i}u]") };
        reads.push(read(&(at..at + words).map(place).collect::<Vec<_>>()));
        at += words;
    }
    let (upper, lower, reads) = (name.to_uppercase(), name.to_lowercase(), reads.join(", "));
    format!(
        "struct {name} {{\n{members}}}\n\nconst {upper}_WORDS: u32 = {at}u;\n\n\
         fn read_{lower}(at: u32) -> {name} {{\n    return {name}({reads});\n}}\n\n"
    )
}

/// Declares a struct whose fields are f32, bool or short arrays of f32, and makes it a [`Record`].
macro_rules! record {
    ($(#[$doc:meta])* $name:ident { $($(#[$of:meta])* $field:ident: $kind:ty,)+ }) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, Default, PartialEq)]
        struct $name {
            $($(#[$of])* $field: $kind,)+
        }

        impl $crate::family::record::Record for $name {
            fn push(&self, words: &mut Vec<f32>) {
                $($crate::family::record::Field::push(self.$field, words);)+
            }

            fn wgsl() -> String {
                use $crate::family::record::{Field, wgsl};
                wgsl(
                    stringify!($name),
                    &[$((
                        stringify!($field),
                        <$kind as Field>::WGSL,
                        <$kind as Field>::WORDS,
                        <$kind as Field>::read,
                    )),+],
                )
            }
        }
    };
}
pub(super) use record;

#[cfg(test)]
mod tests {
    use super::*;

    record! {
        /// One of each kind.
        Sample {
            one: f32,
            pair: [f32; 2],
            flag: bool,
        }
    }

    #[test]
    fn words_and_text_have_one_order() {
        assert_eq!(Sample { one: 3.0, pair: [4.0, 5.0], flag: true }.words(), [3.0, 4.0, 5.0, 1.0]);
        let text = Sample::wgsl();
        assert!(text.contains("const SAMPLE_WORDS: u32 = 4u;"), "{text}");
        assert!(
            text.contains(
                "return Sample(inputs[at], vec2<f32>(inputs[at + 1u], inputs[at + 2u]), inputs[at + 3u] > 0.0);"
            ),
            "{text}"
        );
    }
}
