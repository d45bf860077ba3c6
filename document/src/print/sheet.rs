//! A sheet that is written from the top down.

use pdf_writer::{Content, Name, Str};

use super::letters::{Font, letter, width};

/// A4, pt.
pub(super) const WIDTH: f32 = 595.0;
pub(super) const HEIGHT: f32 = 842.0;

/// pt, on all sides.
const MARGIN: f32 = 50.0;

/// From line to line, in sizes of the letters.
const LEADING: f32 = 1.35;

/// Where the value of a fact stands, in sizes of the letters.
const VALUES: f32 = 17.0;

/// A page of text and bars.
pub(super) struct Sheet {
    content: Content,
    /// Of the letters, pt.
    size: f32,
    /// Base line of the next line, from the bottom, pt.
    y: f32,
}

impl Font {
    pub(super) fn name(self) -> &'static [u8] {
        match self {
            Font::Plain => b"F1",
            Font::Bold => b"F2",
            Font::Symbol => b"F3",
        }
    }

    pub(super) fn base(self) -> &'static [u8] {
        match self {
            Font::Plain => b"Helvetica",
            Font::Bold => b"Helvetica-Bold",
            Font::Symbol => b"Symbol",
        }
    }
}

impl Sheet {
    pub(super) fn new(size: f32) -> Sheet {
        Sheet { content: Content::new(), size, y: HEIGHT - MARGIN - 2.0 * size }
    }

    pub(super) fn size(&self) -> f32 {
        self.size
    }

    /// Whether nothing stands below the margin.
    pub(super) fn fits(&self) -> bool {
        self.y + self.size * LEADING >= MARGIN
    }

    pub(super) fn content(self) -> Vec<u8> {
        self.content.finish().to_vec()
    }

    pub(super) fn next(&mut self) {
        self.y -= self.size * LEADING;
    }

    /// Some lines of nothing.
    pub(super) fn space(&mut self, lines: f32) {
        self.y -= lines * self.size * LEADING;
    }

    /// A line of larger letters.
    pub(super) fn line(&mut self, text: &str, font: Font, scale: f32) {
        self.put(text, font, 0.0, scale * self.size);
        self.y -= scale * self.size * LEADING;
    }

    /// A line across the sheet.
    pub(super) fn rule(&mut self) {
        let y = self.y + self.size;
        self.content.set_line_width(0.6).move_to(MARGIN, y).line_to(WIDTH - MARGIN, y).stroke();
        self.space(0.2);
    }

    pub(super) fn heading(&mut self, heading: &str, remark: &str) {
        self.put(heading, Font::Bold, 0.0, self.size);
        let behind = (width(heading, Font::Bold) + 1.0) * self.size;
        self.put(remark, Font::Plain, behind, self.size);
        self.next();
    }

    /// Text in as many lines as it takes, moved right by `indent` sizes of its letters.
    pub(super) fn paragraph(&mut self, text: &str, indent: f32) {
        self.wrapped(text, Font::Plain, indent * self.size);
    }

    pub(super) fn bold_paragraph(&mut self, text: &str) {
        self.wrapped(text, Font::Bold, 0.0);
    }

    pub(super) fn fact(&mut self, name: &str, value: &str) {
        self.left(name, 0.0);
        self.paragraph(value, VALUES);
    }

    fn wrapped(&mut self, text: &str, font: Font, indent: f32) {
        let room = (WIDTH - 2.0 * MARGIN - indent) / self.size;
        let mut line = String::new();
        // A word that is wider than the sheet is broken where it ends.
        let pieces = text.split(' ').flat_map(|word| broken(word, font, room));
        for word in pieces {
            let longer = match line.is_empty() {
                true => word.clone(),
                false => format!("{line} {word}"),
            };
            if width(&longer, font) > room && !line.is_empty() {
                self.put(&line, font, indent, self.size);
                self.next();
                line = word;
            } else {
                line = longer;
            }
        }
        if !line.is_empty() {
            self.put(&line, font, indent, self.size);
            self.next();
        }
    }

    /// Text that begins at `x` from the margin.
    pub(super) fn left(&mut self, text: &str, x: f32) {
        self.put(text, Font::Plain, x, self.size);
    }

    /// Text that ends there.
    pub(super) fn right(&mut self, text: &str, x: f32) {
        let begin = x - width(text, Font::Plain) * self.size;
        self.put(text, Font::Plain, begin, self.size);
    }

    /// A bar of `[whole, filled]` parts of a width: outlined, and filled with grey.
    pub(super) fn bar(&mut self, x: f32, wide: f32, [whole, filled]: [f64; 2]) {
        let (x, y, high) = (MARGIN + x, self.y - 0.1 * self.size, 0.7 * self.size);
        let part = |part: f64| part.clamp(0.0, 1.0) as f32 * wide;
        self.content.set_fill_gray(0.45).rect(x, y, part(filled), high).fill_nonzero();
        self.content.set_line_width(0.4).rect(x, y, part(whole), high).stroke();
        self.content.set_fill_gray(0.0);
    }

    /// Runs of letters of one font each.
    fn put(&mut self, text: &str, font: Font, x: f32, size: f32) {
        let letters: Vec<(Font, u8, u16)> = text.chars().map(|c| letter(c, font)).collect();
        let mut at = MARGIN + x;
        for run in letters.chunk_by(|a, b| a.0 == b.0) {
            let bytes: Vec<u8> = run.iter().map(|(_, code, _)| *code).collect();
            self.content
                .begin_text()
                .set_font(Name(run[0].0.name()), size)
                .next_line(at, self.y)
                .show(Str(&bytes))
                .end_text();
            at += run.iter().map(|(.., width)| f32::from(*width)).sum::<f32>() / 1000.0 * size;
        }
    }
}

/// A word in pieces that fit into the room.
fn broken(word: &str, font: Font, room: f32) -> Vec<String> {
    let mut pieces = vec![String::new()];
    for c in word.chars() {
        let last = pieces.last().map_or("", String::as_str);
        if width(last, font) + width(c.encode_utf8(&mut [0; 4]), font) > room && !last.is_empty() {
            pieces.push(String::new());
        }
        if let Some(last) = pieces.last_mut() {
            last.push(c);
        }
    }
    pieces
}
