//! Axes, title and theme around the layers.

use super::layer::{Area, Layer};
use super::scale::{Scale, angle_ticks, number, ticks};
use super::svg::{escaped, label, px};

const WIDTH: f64 = 720.0;
const HEIGHT: f64 = 520.0;

/// Left, top, right, bottom of the area between the axes, px.
const EDGES: [f64; 4] = [72.0, 56.0, 592.0, 456.0];

/// About so many marks on an axis.
const TICKS: usize = 7;

/// Light by default and where the reader has a dark theme dark; what lies on colours is the same in
/// both.
const STYLE: &str = "\
.figure{--ink:#1b1b1f;--dim:#5b5b66;--paper:#ffffff;--grid:#d5d5dd;font:13px system-ui,sans-serif}
@media (prefers-color-scheme:dark){.figure{--ink:#ececf1;--dim:#a5a5b2;--paper:#17171c;\
--grid:#3c3c46}}
.figure .paper{fill:var(--paper)}
.figure text{fill:var(--ink)}
.figure .title{font-size:16px;font-weight:600}
.figure .tick,.figure .under{fill:var(--dim);font-size:12px}
.figure .axis{stroke:var(--ink);fill:none}
.figure .mark{stroke:var(--grid)}
.figure .line{fill:none;stroke:#000;stroke-opacity:.6;stroke-width:1}
.figure .point{fill:#fff;stroke:#000;stroke-width:1.5}
.figure .on{fill:#000;stroke:#fff;stroke-width:3;paint-order:stroke;font-size:12px}
";

/// An axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// What it is, with its unit.
    pub name: String,
    /// Its ends.
    pub domain: [f64; 2],
    /// Marked as degrees are: every 30, 45, 90.
    pub degrees: bool,
}

/// A plot.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Above it.
    pub title: String,
    /// Below the title: the circumstances.
    pub subtitle: String,
    /// What it shows, for those who do not see it.
    pub description: String,
    /// To the right.
    pub x: Axis,
    /// Upward.
    pub y: Axis,
    /// From below to above.
    pub layers: Vec<Layer>,
}

impl Figure {
    /// The whole plot as a self-contained SVG.
    pub fn svg(&self) -> String {
        let [left, top, right, bottom] = EDGES;
        let area = Area {
            x: Scale::new(self.x.domain, [left, right]),
            y: Scale::new(self.y.domain, [bottom, top]),
            edges: EDGES,
        };
        let mut text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"figure\" role=\"img\" \
             aria-labelledby=\"title desc\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" width=\"{WIDTH}\" \
             height=\"{HEIGHT}\">\n<title id=\"title\">{}</title>\n<desc id=\"desc\">{}</desc>\n\
             <style>\n{STYLE}</style>\n<rect class=\"paper\" width=\"{WIDTH}\" \
             height=\"{HEIGHT}\"/>\n",
            escaped(&self.title),
            escaped(&self.description)
        );
        text.push_str(&label("title", "start", [left, 26.0], &self.title));
        text.push_str(&label("under", "start", [left, 44.0], &self.subtitle));
        text.push_str(&self.marks(&area));
        let mut taken: Vec<[f64; 2]> =
            self.layers.iter().flat_map(|layer| layer.reserved(&area)).collect();
        for layer in &self.layers {
            text.push_str(&layer.svg(&area, &mut taken));
        }
        text.push_str(&format!(
            "<rect class=\"axis\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>\n",
            px(left),
            px(top),
            px(right - left),
            px(bottom - top)
        ));
        text.push_str(&self.names());
        for layer in &self.layers {
            if let Layer::Bands(bands) = layer {
                text.push_str(&bands.legend(&area));
            }
        }
        text.push_str("</svg>\n");
        text
    }

    /// Marks of both axes, with lines across where no layer covers them.
    fn marks(&self, area: &Area) -> String {
        let [left, top, right, bottom] = EDGES;
        let mut text = String::new();
        let mut line = |from: [f64; 2], to: [f64; 2]| {
            let [x1, y1, x2, y2] = [from[0], from[1], to[0], to[1]].map(px);
            text.push_str(&format!(
                "<line class=\"mark\" x1=\"{x1}\" y1=\"{y1}\" x2=\"{x2}\" y2=\"{y2}\"/>\n"
            ));
        };
        let mut labels = String::new();
        for tick in self.x.ticks() {
            let x = area.x.at(tick);
            line([x, top], [x, bottom + 5.0]);
            labels.push_str(&label("tick", "middle", [x, bottom + 19.0], &number(tick)));
        }
        for tick in self.y.ticks() {
            let y = area.y.at(tick);
            line([left - 5.0, y], [right, y]);
            labels.push_str(&label("tick", "end", [left - 9.0, y + 4.0], &number(tick)));
        }
        text + &labels
    }

    fn names(&self) -> String {
        let [left, top, right, bottom] = EDGES;
        let below = label("name", "middle", [(left + right) / 2.0, bottom + 42.0], &self.x.name);
        let beside = format!(
            "<text class=\"name\" text-anchor=\"middle\" transform=\"translate(20 {}) \
             rotate(-90)\">{}</text>\n",
            px((top + bottom) / 2.0),
            escaped(&self.y.name)
        );
        below + &beside
    }
}

impl Axis {
    fn ticks(&self) -> Vec<f64> {
        if self.degrees { angle_ticks(self.domain, TICKS) } else { ticks(self.domain, TICKS) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::{Bands, Line, Point};

    fn axis(name: &str) -> Axis {
        Axis { name: name.to_owned(), domain: [0.0, 2.0], degrees: false }
    }

    fn figure(values: Vec<f64>) -> Figure {
        Figure {
            title: "A < B".to_owned(),
            subtitle: "under & over".to_owned(),
            description: "Two rising bands".to_owned(),
            x: axis("x, mm"),
            y: axis("y, N"),
            layers: vec![
                Layer::Bands(Bands {
                    x: vec![0.0, 1.0, 2.0],
                    y: vec![0.0, 2.0],
                    values,
                    levels: vec![0.0, 1.0, 2.0],
                    name: "size, m".to_owned(),
                }),
                Layer::Line(Line {
                    lines: vec![vec![[0.0, 0.0], [2.0, 2.0]]],
                    label: String::new(),
                }),
                Layer::Points(vec![Point { at: [1.0, 1.0], label: "here".to_owned() }]),
            ],
        }
    }

    #[test]
    fn a_figure_is_well_formed_and_says_what_it_is() {
        let text = figure(vec![0.5, 1.5, 1.5, 0.5, f64::NAN, 9.0]).svg();
        let document = roxmltree::Document::parse(&text).unwrap();
        let root = document.root_element();
        let by_id = |id: &str| root.descendants().find(|n| n.attribute("id") == Some(id));
        assert_eq!(by_id("title").and_then(|n| n.text()), Some("A < B"));
        assert_eq!(by_id("desc").and_then(|n| n.text()), Some("Two rising bands"));
        let texts: Vec<&str> = root.descendants().filter_map(|n| n.text()).collect();
        for expected in ["under & over", "x, mm", "y, N", "size, m", "here", "0.4", "2"] {
            assert!(texts.contains(&expected), "{expected}");
        }
        assert!(text.contains("prefers-color-scheme:dark") && !text.contains("NaN"));
    }

    /// Neighbours of one band are one rectangle; what is no number is none.
    #[test]
    fn bands_are_runs() {
        let text = figure(vec![0.5, 1.5, 1.5, 0.5, f64::NAN, 9.0]).svg();
        let paths: Vec<&str> = text.lines().filter(|l| l.starts_with("<path fill")).collect();
        assert_eq!(paths.len(), 2);
        assert!(paths.iter().all(|path| path.matches('M').count() == 2), "{paths:?}");
        assert!(paths[1].contains("h390v200"), "{paths:?}");
    }
}
