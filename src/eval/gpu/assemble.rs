//! Shaders are plain concatenation; errors are reported in the fragments' own lines.

use crate::error::{Error, Result};
use crate::family::Shader;
use std::ops::Range;
use wgpu::naga;

/// The frame of every shader, before the family's part.
const MAIN: (&str, &str) = ("lib/main.wgsl", include_str!("../../../shaders/lib/main.wgsl"));

/// A whole WGSL module, and where each part of it came from.
#[derive(Debug, Clone)]
pub struct Assembled {
    /// The module's text.
    pub source: String,
    /// Where the fragments lie in it.
    pub map: SourceMap,
}

/// Maps places in an assembled module back to fragments.
#[derive(Debug, Clone, Default)]
pub struct SourceMap {
    /// Name and first byte of each fragment, ascending.
    fragments: Vec<(String, usize)>,
}

/// Concatenates the frame `lib/main.wgsl`, the family's generated constants and its fragments.
pub fn assemble(shader: &Shader) -> Assembled {
    let mut assembled = Assembled { source: String::new(), map: SourceMap::default() };
    let constants = [("constants (generated)", shader.constants.as_str())];
    for (name, text) in [MAIN].into_iter().chain(constants).chain(shader.fragments.iter().copied()) {
        assembled.map.fragments.push((name.to_owned(), assembled.source.len()));
        assembled.source.push_str(text);
        if !text.ends_with('\n') {
            assembled.source.push('\n');
        }
    }
    assembled
}

/// Parses and validates a module as WebGPU's core language, without any GPU.
///
/// # Errors
/// [`Error::Gpu`], with `fragment:line:column` of each place that the parser or validator names.
pub fn validate(assembled: &Assembled) -> Result<()> {
    let source = &assembled.source;
    let module = naga::front::wgsl::parse_str(source).map_err(|e| {
        let places = e.labels().filter_map(|(span, label)| Some((span.to_range()?, label.to_owned())));
        assembled.error(e.message(), places, e.notes())
    })?;
    // No capability: nothing beyond what every WebGPU device offers.
    let mut validator =
        naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::empty());
    validator.validate(&module).map(drop).map_err(|e| {
        let places = e.spans().filter_map(|(span, label)| Some((span.to_range()?, label.clone())));
        let causes: Vec<String> = causes(e.as_inner()).collect();
        assembled.error(&e.as_inner().to_string(), places, causes.iter().map(String::as_str))
    })
}

impl Assembled {
    fn error<'a>(
        &self,
        message: &str,
        places: impl Iterator<Item = (Range<usize>, String)>,
        notes: impl Iterator<Item = &'a str>,
    ) -> Error {
        let mut text = format!("shader: {message}");
        for (range, label) in places {
            let (fragment, line, column) = self.map.locate(&self.source, range.start);
            let begin = self.source[..range.start].rfind('\n').map_or(0, |newline| newline + 1);
            let whole = self.source[begin..].lines().next().unwrap_or_default().trim();
            text += &format!("\n  {fragment}:{line}:{column}: {label}\n    {whole}");
        }
        for note in notes {
            text += &format!("\n  {note}");
        }
        Error::Gpu(text)
    }
}

impl SourceMap {
    /// Fragment, line and column (both from 1, in characters) of a byte offset in `source`.
    pub fn locate(&self, source: &str, offset: usize) -> (&str, usize, usize) {
        let fragment = self.fragments.partition_point(|(_, start)| *start <= offset).saturating_sub(1);
        let Some((name, start)) = self.fragments.get(fragment) else { return ("shader", 1, 1) };
        let before = source.get(*start..offset).unwrap_or_default();
        let column = before.rsplit('\n').next().unwrap_or_default().chars().count() + 1;
        (name, before.matches('\n').count() + 1, column)
    }
}

fn causes(error: &dyn std::error::Error) -> impl Iterator<Item = String> {
    std::iter::successors(error.source(), |e| e.source()).map(ToString::to_string)
}
