//! Characters in the standard fonts that every reader of PDF has.
//!
//! Widths are those of Adobe's metrics of Helvetica and Symbol, thousandths of the size of the letters.

/// A font of the page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Font {
    /// Helvetica, in Windows' encoding.
    Plain,
    /// The same, bold.
    Bold,
    /// Symbol: arrows, Greek, the minus sign.
    Symbol,
}

/// Widths of the characters from the space to the tilde.
const PLAIN: [u16; 95] = [
    278, 278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333, 278, 278, 556, 556, 556,
    556, 556, 556, 556, 556, 556, 556, 278, 278, 584, 584, 584, 556, 1015, 667, 667, 722, 722, 667,
    611, 778, 722, 278, 500, 667, 556, 833, 722, 778, 667, 778, 722, 667, 611, 722, 667, 944, 667,
    667, 611, 278, 278, 278, 469, 556, 333, 556, 556, 500, 556, 556, 278, 556, 556, 222, 222, 500,
    222, 833, 556, 556, 556, 556, 333, 500, 278, 556, 500, 722, 500, 500, 500, 334, 260, 334, 584,
];

/// The same of the bold letters.
const BOLD: [u16; 95] = [
    278, 333, 474, 556, 556, 889, 722, 238, 333, 333, 389, 584, 278, 333, 278, 278, 556, 556, 556,
    556, 556, 556, 556, 556, 556, 556, 333, 333, 584, 584, 584, 611, 975, 722, 722, 722, 722, 667,
    611, 778, 722, 278, 556, 722, 611, 833, 722, 778, 667, 778, 722, 667, 611, 722, 667, 944, 667,
    667, 611, 333, 278, 333, 584, 556, 333, 556, 611, 556, 611, 556, 333, 611, 611, 278, 278, 556,
    278, 889, 611, 611, 611, 611, 389, 556, 333, 611, 556, 778, 556, 556, 500, 389, 280, 389, 584,
];

/// Other characters of Helvetica: their codes in Windows' encoding, their widths.
const MARKS: [(char, u8, u16); 17] = [
    ('…', 0x85, 1000),
    ('‘', 0x91, 222),
    ('’', 0x92, 222),
    ('“', 0x93, 333),
    ('”', 0x94, 333),
    ('–', 0x96, 556),
    ('—', 0x97, 1000),
    ('\u{a0}', 0xa0, 278),
    ('°', 0xb0, 400),
    ('±', 0xb1, 584),
    ('²', 0xb2, 333),
    ('³', 0xb3, 333),
    ('µ', 0xb5, 556),
    ('·', 0xb7, 278),
    ('×', 0xd7, 584),
    ('ß', 0xdf, 611),
    ('÷', 0xf7, 584),
];

/// Characters of Symbol.
const SYMBOLS: [(char, u8, u16); 16] = [
    ('−', 0x2d, 549),
    ('α', 0x61, 631),
    ('β', 0x62, 549),
    ('δ', 0x64, 494),
    ('θ', 0x71, 521),
    ('σ', 0x73, 603),
    ('τ', 0x74, 439),
    ('ω', 0x77, 686),
    ('Δ', 0x44, 612),
    ('≤', 0xa3, 549),
    ('∞', 0xa5, 713),
    ('→', 0xae, 987),
    ('≥', 0xb3, 549),
    ('∂', 0xb6, 494),
    ('≈', 0xbb, 549),
    ('√', 0xd6, 549),
];

/// Font, code and width of a character; what no font has is a question mark.
pub(super) fn letter(c: char, font: Font) -> (Font, u8, u16) {
    let widths = if font == Font::Bold { &BOLD } else { &PLAIN };
    if let (' '..='~', Ok(code)) = (c, u8::try_from(c)) {
        return (font, code, widths[usize::from(code - b' ')]);
    }
    let of = |all: &[(char, u8, u16)], font| {
        let found = all.iter().find(|(other, ..)| *other == c);
        found.map(|(_, code, width)| (font, *code, *width))
    };
    // Letters with accents have the width of those without, give or take a few thousandths.
    let latin = || match u8::try_from(c) {
        Ok(code) if code >= 0xc0 => Some((font, code, if c.is_uppercase() { 722 } else { 556 })),
        _ => None,
    };
    let known = of(&MARKS, font).or_else(|| of(&SYMBOLS, Font::Symbol)).or_else(latin);
    known.unwrap_or((font, b'?', widths[usize::from(b'?' - b' ')]))
}

/// Width of a text in units of the size of its letters.
pub(super) fn width(text: &str, font: Font) -> f32 {
    text.chars().map(|c| f32::from(letter(c, font).2)).sum::<f32>() / 1000.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn characters_are_found() {
        assert_eq!(letter('A', Font::Plain), (Font::Plain, b'A', 667));
        assert_eq!(letter('~', Font::Bold), (Font::Bold, b'~', 584));
        assert_eq!(letter('→', Font::Bold), (Font::Symbol, 0xae, 987));
        assert_eq!(letter('ü', Font::Plain), (Font::Plain, 0xfc, 556));
        assert_eq!(letter('漢', Font::Plain), (Font::Plain, b'?', 556));
        assert!((width("0.1 µm", Font::Plain) - 3.057).abs() < 1e-6);
    }
}
