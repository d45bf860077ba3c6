//! What is drawn between the axes.

use super::colour::viridis;
use super::scale::{Scale, number};
use super::svg::{escaped, label, path, px};

/// One layer; later ones lie above earlier ones.
#[derive(Clone, Debug, PartialEq)]
pub enum Layer {
    /// Bands of colour over a grid.
    Bands(Bands),
    /// A line, or several that belong together.
    Line(Line),
    /// Marked points.
    Points(Vec<Point>),
}

/// A quantity over a grid, coloured in bands between levels.
#[derive(Clone, Debug, PartialEq)]
pub struct Bands {
    /// Grid values along x, ascending.
    pub x: Vec<f64>,
    /// Grid values along y, ascending.
    pub y: Vec<f64>,
    /// Row by row (all x of the first y first); what is not a number stays empty.
    pub values: Vec<f64>,
    /// Ascending, one more than there are bands.
    pub levels: Vec<f64>,
    /// What it is, with its unit: the heading of the scale of colours.
    pub name: String,
}

/// Lines that belong together.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Each through its points.
    pub lines: Vec<Vec<[f64; 2]>>,
    /// Stands on the longest of them; empty for none.
    pub label: String,
}

/// A marked point.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Where.
    pub at: [f64; 2],
    /// Beside it; empty for none.
    pub label: String,
}

/// The scales of the two axes.
pub(super) struct Area {
    pub(super) x: Scale,
    pub(super) y: Scale,
    /// Left, top, right, bottom, px.
    pub(super) edges: [f64; 4],
}

impl Area {
    fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.x.at(x), self.y.at(y)]
    }
}

/// Labels of lines are at least so far apart, px.
const APART: f64 = 28.0;

/// Places on a line at which its label may stand.
const PLACES: usize = 24;

impl Layer {
    /// `taken` are the places of labels, to which this layer's are added.
    pub(super) fn svg(&self, area: &Area, taken: &mut Vec<[f64; 2]>) -> String {
        match self {
            Layer::Bands(bands) => bands.svg(area),
            Layer::Line(line) => line.svg(area, taken),
            Layer::Points(points) => points.iter().map(|point| point.svg(area)).collect(),
        }
    }

    /// Where its labels must stand, whatever else there is.
    pub(super) fn reserved(&self, area: &Area) -> Vec<[f64; 2]> {
        match self {
            Layer::Points(points) => points.iter().map(|point| point.label_at(area).0).collect(),
            Layer::Bands(_) | Layer::Line(_) => Vec::new(),
        }
    }
}

impl Bands {
    fn count(&self) -> usize {
        self.levels.len().saturating_sub(1)
    }

    /// The band of a value; the outermost hold what lies beyond.
    fn band(&self, value: f64) -> Option<usize> {
        let above = self.levels.iter().skip(1).take_while(|level| value >= **level).count();
        value.is_finite().then(|| above.min(self.count().saturating_sub(1)))
    }

    pub(super) fn colour(&self, band: usize) -> String {
        viridis((band as f64 + 0.5) / self.count().max(1) as f64)
    }

    /// One path per band, of rectangles as wide as neighbouring cells agree.
    fn svg(&self, area: &Area) -> String {
        let [left, top, right, bottom] = area.edges;
        let xs = edges(&self.x, &area.x, [left, right]);
        let ys = edges(&self.y, &area.y, [bottom, top]);
        let mut paths = vec![String::new(); self.count()];
        for (j, row) in self.values.chunks(self.x.len().max(1)).enumerate() {
            let (y, height) = (ys[j + 1], ys[j] - ys[j + 1]);
            let mut i = 0;
            while i < row.len() {
                let band = self.band(row[i]);
                let end = i + row[i..].iter().take_while(|v| self.band(**v) == band).count();
                if let Some(band) = band {
                    let (x, width) = (xs[i], xs[end] - xs[i]);
                    let (w, h) = (px(width), px(height));
                    paths[band].push_str(&format!("M{} {}h{w}v{h}h-{w}z", px(x), px(y)));
                }
                i = end;
            }
        }
        let filled = paths
            .iter()
            .enumerate()
            .filter(|(_, d)| !d.is_empty())
            .map(|(band, d)| format!("<path fill=\"{}\" d=\"{d}\"/>\n", self.colour(band)));
        format!("<g shape-rendering=\"crispEdges\">\n{}</g>\n", filled.collect::<String>())
    }

    /// The scale of colours, to the right of the area.
    pub(super) fn legend(&self, area: &Area) -> String {
        let [_, top, right, bottom] = area.edges;
        let (x, width) = (right + 24.0, 16.0);
        let height = (bottom - top) / self.count().max(1) as f64;
        let mut text = format!(
            "<text class=\"name\" text-anchor=\"middle\" transform=\"translate({} {}) \
             rotate(-90)\">{}</text>\n",
            px(x + width + 62.0),
            px((top + bottom) / 2.0),
            escaped(&self.name)
        );
        for band in 0..self.count() {
            let y = bottom - (band + 1) as f64 * height;
            text.push_str(&format!(
                "<rect fill=\"{}\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>\n",
                self.colour(band),
                px(x),
                px(y),
                px(width),
                px(height)
            ));
        }
        for (k, level) in self.levels.iter().enumerate() {
            let y = bottom - k as f64 * height + 4.0;
            text.push_str(&label("tick", "start", [x + width + 6.0, y], &number(*level)));
        }
        text
    }
}

/// Borders halfway between grid values; the outer ones are the area's.
fn edges(grid: &[f64], scale: &Scale, [first, last]: [f64; 2]) -> Vec<f64> {
    let mut edges = vec![first];
    edges.extend(grid.windows(2).map(|pair| scale.at((pair[0] + pair[1]) / 2.0)));
    edges.push(last);
    // To the tenth of a pixel at which they are written, so that neighbours share a border.
    edges.iter().map(|x| (10.0 * x).round() / 10.0).collect()
}

impl Line {
    fn svg(&self, area: &Area, taken: &mut Vec<[f64; 2]>) -> String {
        let d: String =
            self.lines.iter().map(|line| path(line.iter().map(|p| area.at(*p)))).collect();
        let mut text = format!("<path class=\"line\" d=\"{d}\"/>\n");
        if let Some([x, y]) = self.label_at(area, taken) {
            taken.push([x, y]);
            text.push_str(&label("on", "middle", [x, y + 4.0], &self.label));
        }
        text
    }

    /// The place on its longest line that is farthest from other labels; none if all are near.
    fn label_at(&self, area: &Area, taken: &[[f64; 2]]) -> Option<[f64; 2]> {
        let longest = self.lines.iter().max_by_key(|line| line.len())?;
        if self.label.is_empty() || longest.len() < 4 {
            return None;
        }
        let room = |[x, y]: [f64; 2]| {
            let [left, top, right, bottom] = area.edges;
            let edge = (x - left).min(right - x).min((y - top).min(bottom - y) + 8.0);
            // A label is wider than it is high.
            let apart = |[u, v]: &[f64; 2]| ((x - u) / 2.0).hypot(y - v);
            taken.iter().map(apart).fold(2.0 * edge, f64::min).min(edge + 10.0)
        };
        let places = (1..PLACES).map(|k| area.at(longest[k * (longest.len() - 1) / PLACES]));
        let best = places.max_by(|a, b| room(*a).total_cmp(&room(*b)))?;
        (room(best) >= APART / 2.0).then_some(best)
    }
}

impl Point {
    /// Where the label stands, and on which side.
    fn label_at(&self, area: &Area) -> ([f64; 2], &'static str) {
        let [x, y] = area.at(self.at);
        // Toward the middle of the area, so that it is not cut off.
        let [left, top, right, bottom] = area.edges;
        let (anchor, aside) = if x > (left + right) / 2.0 { ("end", -8.0) } else { ("start", 8.0) };
        let below = if y < (top + bottom) / 2.0 { 14.0 } else { -6.0 };
        ([x + aside, y + below], anchor)
    }

    fn svg(&self, area: &Area) -> String {
        let [x, y] = area.at(self.at);
        let mut text =
            format!("<circle class=\"point\" cx=\"{}\" cy=\"{}\" r=\"4\"/>\n", px(x), px(y));
        if !self.label.is_empty() {
            let (at, anchor) = self.label_at(area);
            text.push_str(&label("on", anchor, at, &self.label));
        }
        text
    }
}
