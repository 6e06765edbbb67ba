//! The font of all pictures: which letters it has, and how wide texts are.

use crate::error::{Error, Result};
use ab_glyph::{Font, FontRef, Glyph, GlyphId, OutlinedGlyph, PxScale, ScaleFont, point};

static FONT: &[u8] = include_bytes!("../../assets/DejaVuSans-subset.ttf");

/// The first letter of a text that the font of all pictures lacks.
pub fn missing_letter(text: &str) -> Option<char> {
    let font = FontRef::try_from_slice(FONT).ok()?;
    text.chars().find(|c| !c.is_whitespace() && font.glyph_id(*c).0 == 0)
}

/// The font.
#[derive(Clone)]
pub(super) struct Letters(FontRef<'static>);

impl Letters {
    pub(super) fn new() -> Result<Letters> {
        FontRef::try_from_slice(FONT).map(Letters).map_err(|e| Error::invalid(format!("the built-in font: {e}")))
    }

    /// Width of a text in pixels.
    pub(super) fn text_width(&self, em: f64, text: &str) -> f64 {
        self.glyphs(em, text).1
    }

    /// The text, or as much of it as fits in `width`, with an ellipsis.
    pub(super) fn fit(&self, em: f64, text: &str, width: f64) -> String {
        let (glyphs, whole) = self.glyphs(em, text);
        if whole <= width {
            return text.to_owned();
        }
        let room = width - self.text_width(em, "…");
        // Kept: the characters before the last that begins within the room.
        let kept = glyphs.partition_point(|glyph| f64::from(glyph.position.x) <= room).saturating_sub(1);
        if room < 0.0 {
            String::new()
        } else {
            text.chars().take(kept).collect::<String>().trim_end().to_owned() + "…"
        }
    }

    /// The text in lines of at most `width`, broken at spaces.
    pub(super) fn wrap(&self, em: f64, text: &str, width: f64) -> Vec<String> {
        let mut lines: Vec<String> = Vec::new();
        for word in text.split_whitespace() {
            match lines.last_mut() {
                Some(line) if self.text_width(em, &format!("{line} {word}")) <= width => {
                    line.push(' ');
                    line.push_str(word);
                }
                _ => lines.push(word.to_owned()),
            }
        }
        lines.iter().map(|line| self.fit(em, line, width)).collect()
    }

    /// The outline of a glyph; none for a space.
    pub(super) fn outline(&self, glyph: Glyph) -> Option<OutlinedGlyph> {
        self.0.outline_glyph(glyph)
    }

    /// The glyphs of a text, placed from the start of its base line, and its width.
    pub(super) fn glyphs(&self, em: f64, text: &str) -> (Vec<Glyph>, f64) {
        // ab_glyph's scale is the height of a line, not the em.
        let height = self.0.units_per_em().map_or(1.0, |units| self.0.height_unscaled() / units);
        let scale = PxScale::from(em as f32 * height);
        let font = self.0.as_scaled(scale);
        let mut x = 0.0;
        let mut last: Option<GlyphId> = None;
        let mut place = |c: char| {
            let id = font.glyph_id(c);
            x += last.map_or(0.0, |last| font.kern(last, id));
            last = Some(id);
            let glyph = id.with_scale_and_position(scale, point(x, 0.0));
            x += font.h_advance(id);
            glyph
        };
        let glyphs = text.chars().map(&mut place).collect();
        (glyphs, f64::from(x))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_font_has_what_labels_need() {
        assert_eq!(missing_letter("φκωπ₀₁₂⁻⁰¹²³⁴⁵⁶⁷⁸⁹−×≤≥√∞′·…°⊂–’aA0%"), None);
        assert_eq!(missing_letter("a漢"), Some('漢'), "so that the line above can fail");
    }

    #[test]
    fn long_texts_are_shortened_and_wrapped() {
        let letters = Letters::new().unwrap();
        let text = "monotone curvature between two ends";
        let whole = letters.text_width(16.0, text);
        assert_eq!(letters.fit(16.0, text, whole), text);
        let short = letters.fit(16.0, text, whole / 2.0);
        assert!(short.ends_with('…') && letters.text_width(16.0, &short) <= whole / 2.0 && short.len() > 9, "{short}");
        let lines = letters.wrap(16.0, text, whole / 2.0);
        assert!(lines.len() >= 2 && lines.join(" ") == text, "{lines:?}");
    }
}
