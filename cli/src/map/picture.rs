//! A map as a picture.

use askama::Template;
use stiffarm_document::plot::{Scale, angle_ticks, isolines, number, ticks, viridis};
use stiffarm_document::text::short;
use stiffarm_study::dexterity::Map;

use super::quantity_of::Quantity;
use super::sweep::{Moved, Sweep};
use crate::input::source::Source;
use crate::terminal::failure::Failure;

/// About so many bands.
const BANDS: usize = 8;

/// Size of the picture, px.
const WIDTH: f64 = 720.0;
const HEIGHT: f64 = 520.0;

/// Edges of the area between the axes, px.
const LEFT: f64 = 72.0;
const TOP: f64 = 56.0;
const RIGHT: f64 = 592.0;
const BOTTOM: f64 = 456.0;

/// About so many marks on an axis.
const TICKS: usize = 7;

/// Labels of lines are at least so far apart, px.
const APART: f64 = 28.0;

/// Places on a line at which its label may stand.
const PLACES: usize = 24;

/// A map: bands of colour, lines between them, the lowest and the highest cell. It follows the reader's light or dark
/// theme; what lies on colours is the same in both.
#[derive(Template)]
#[template(path = "parts/map.svg")]
struct Picture {
    title: String,
    subtitle: String,
    description: String,
    width: f64,
    height: f64,
    left: f64,
    top: f64,
    right: f64,
    bottom: f64,
    /// Ends of the lines at the marks of both axes.
    marks: Vec<[String; 4]>,
    ticks: Vec<Label>,
    /// Colour and rectangles of each band.
    bands: Vec<(String, String)>,
    lines: Vec<(String, Option<Label>)>,
    points: Vec<(String, String, Label)>,
    /// Of the axes, and of the scale of colours.
    names: [String; 3],
    /// Colour, top and height of each band on the scale.
    scale: Vec<(String, String, String)>,
    levels: Vec<Label>,
}

/// A line of text.
#[derive(Template)]
#[template(
    source = "<text class=\"{{ class }}\" text-anchor=\"{{ anchor }}\" x=\"{{ x }}\" y=\"{{ y }}\">{{ text }}</text>\n",
    ext = "svg"
)]
struct Label {
    class: &'static str,
    anchor: &'static str,
    x: String,
    y: String,
    text: String,
}

/// From the map's numbers to pixels.
struct Area {
    x: Scale,
    y: Scale,
}

/// The map as a self-contained SVG.
pub fn svg(source: &Source, sweep: &Sweep, asked: &Quantity, map: &Map) -> Result<String, Failure> {
    let [first, second] = &sweep.axes;
    let x: Vec<f64> = map.plane.first.iter().map(|v| first.shown(*v)).collect();
    let y: Vec<f64> = map.plane.second.iter().map(|v| second.shown(*v)).collect();
    let area = Area {
        x: Scale::new([x[0], x[x.len() - 1]], [LEFT, RIGHT]),
        y: Scale::new([y[0], y[y.len() - 1]], [BOTTOM, TOP]),
    };
    let peaks = peaks(map);
    let range = [peaks[0].value, peaks[1].value];
    let levels = levels(range);
    let count = levels.len() - 1;
    let colour = |band: usize| viridis((band as f64 + 0.5) / count as f64);
    let points = ["lowest", "highest"].iter().zip(&peaks).map(|(name, peak)| {
        let at = area.at([first.shown(peak.first), second.shown(peak.second)]);
        beside(at, format!("{name} {}", short(peak.value)))
    });
    let (points, mut taken): (Vec<_>, Vec<_>) = points.unzip();
    let inner = levels.iter().skip(1).take(levels.len().saturating_sub(2));
    let lines = inner.map(|level| {
        let lines = isolines(x.len(), y.len(), |i, j| map.values[(i, j)], *level);
        let place = |[i, j]: [f64; 2]| area.at([between(&x, i), between(&y, j)]);
        let lines: Vec<Vec<[f64; 2]>> =
            lines.into_iter().map(|line| line.into_iter().map(place).collect()).collect();
        let label = roomy(&lines, &taken).map(|[x, y]| {
            taken.push([x, y]);
            label("on", "middle", [x, y + 4.0], number(*level))
        });
        (lines.iter().map(|line| path(line)).collect::<String>(), label)
    });
    let lines = lines.collect();
    let (marks, ticks) = marks(&area, [(first, &x), (second, &y)]);
    let height = (BOTTOM - TOP) / count as f64;
    let unit = if asked.unit().is_empty() { "" } else { &format!(", {}", asked.unit()) };
    let axis = |joint: &Moved| format!("{}, {}", joint.name, joint.unit);
    let others =
        if sweep.others.is_empty() { String::new() } else { format!("; {}", sweep.others) };
    let picture = Picture {
        title: format!("{}: {}", source.robot.name, asked.name()),
        subtitle: format!("{}{others}", asked.circumstances()),
        description: format!(
            "A map of the {} over {} and {}, with lines of equal value. It lies between {} and {}{}.",
            asked.name(),
            first.name,
            second.name,
            short(range[0]),
            short(range[1]),
            unit.replacen(',', "", 1)
        ),
        width: WIDTH,
        height: HEIGHT,
        left: LEFT,
        top: TOP,
        right: RIGHT,
        bottom: BOTTOM,
        marks,
        ticks,
        bands: bands(
            map,
            &levels,
            [edges(&x, &area.x, [LEFT, RIGHT]), edges(&y, &area.y, [BOTTOM, TOP])],
        )
        .into_iter()
        .enumerate()
        .map(|(band, d)| (colour(band), d))
        .collect(),
        lines,
        points,
        names: [axis(first), axis(second), format!("{}{unit}", asked.name())],
        scale: (0..count)
            .map(|band| (colour(band), px(BOTTOM - (band + 1) as f64 * height), px(height)))
            .collect(),
        levels: levels
            .iter()
            .enumerate()
            .map(|(k, level)| {
                let y = BOTTOM - k as f64 * height + 4.0;
                label("tick", "start", [RIGHT + 46.0, y], number(*level))
            })
            .collect(),
    };
    let drawn = picture.render().map(|svg| svg + "\n");
    drawn.map_err(|error| Failure::new(format!("cannot draw the map: {error}")))
}

impl Area {
    fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.x.at(x), self.y.at(y)]
    }
}

fn label(class: &'static str, anchor: &'static str, [x, y]: [f64; 2], text: String) -> Label {
    Label { class, anchor, x: px(x), y: px(y), text }
}

/// To a tenth of a pixel.
fn px(x: f64) -> String {
    let text = format!("{x:.1}");
    let short = text.strip_suffix(".0").unwrap_or(&text);
    if short == "-0" { "0".to_owned() } else { short.to_owned() }
}

/// The commands of a line through points.
fn path(points: &[[f64; 2]]) -> String {
    let letter = |k: usize| if k == 0 { 'M' } else { 'L' };
    let points = points.iter().enumerate();
    points.map(|(k, [x, y])| format!("{}{} {}", letter(k), px(*x), px(*y))).collect()
}

/// Lines across at the marks of both axes, and the numbers beside them.
fn marks(area: &Area, axes: [(&Moved, &[f64]); 2]) -> (Vec<[String; 4]>, Vec<Label>) {
    let [x, y] = axes.map(|(joint, grid)| {
        let domain = [grid[0], grid[grid.len() - 1]];
        if joint.turns() { angle_ticks(domain, TICKS) } else { ticks(domain, TICKS) }
    });
    let upright = x.iter().map(|tick| {
        let x = area.x.at(*tick);
        let text = label("tick", "middle", [x, BOTTOM + 19.0], number(*tick));
        ([x, TOP, x, BOTTOM + 5.0].map(px), text)
    });
    let level = y.iter().map(|tick| {
        let y = area.y.at(*tick);
        let text = label("tick", "end", [LEFT - 9.0, y + 4.0], number(*tick));
        ([LEFT - 5.0, y, RIGHT, y].map(px), text)
    });
    upright.chain(level).unzip()
}

/// Of each band between levels the rectangles, as wide as neighbouring cells agree; what is no number stays empty, and
/// the outermost bands hold what lies beyond.
fn bands(map: &Map, levels: &[f64], [xs, ys]: [Vec<f64>; 2]) -> Vec<String> {
    let mut paths = vec![String::new(); levels.len() - 1];
    let band = |value: f64| {
        let above = levels.iter().skip(1).take_while(|level| value >= **level).count();
        value.is_finite().then(|| above.min(levels.len() - 2))
    };
    for j in 0..ys.len() - 1 {
        let row: Vec<_> = (0..xs.len() - 1).map(|i| band(map.values[(i, j)])).collect();
        let mut i = 0;
        for run in row.chunk_by(|a, b| a == b) {
            let end = i + run.len();
            if let Some(band) = run[0] {
                let (w, h) = (px(xs[end] - xs[i]), px(ys[j] - ys[j + 1]));
                let (x, y) = (px(xs[i]), px(ys[j + 1]));
                paths[band].push_str(&format!("M{x} {y}h{w}v{h}h-{w}z"));
            }
            i = end;
        }
    }
    paths
}

/// Borders halfway between grid values; the outer ones are the area's.
fn edges(grid: &[f64], scale: &Scale, [first, last]: [f64; 2]) -> Vec<f64> {
    let inner = grid.windows(2).map(|pair| scale.at((pair[0] + pair[1]) / 2.0));
    let edges = std::iter::once(first).chain(inner).chain([last]);
    // To the tenth of a pixel at which they are written, so that neighbours share a border.
    edges.map(|x| (10.0 * x).round() / 10.0).collect()
}

/// The place on the longest line that is farthest from other labels; none if all are near.
fn roomy(lines: &[Vec<[f64; 2]>], taken: &[[f64; 2]]) -> Option<[f64; 2]> {
    let longest = lines.iter().max_by_key(|line| line.len()).filter(|line| line.len() >= 4)?;
    let room = |[x, y]: [f64; 2]| {
        let edge = (x - LEFT).min(RIGHT - x).min((y - TOP).min(BOTTOM - y) + 8.0);
        // A label is wider than it is high.
        let apart = |[u, v]: &[f64; 2]| ((x - u) / 2.0).hypot(y - v);
        taken.iter().map(apart).fold(2.0 * edge, f64::min).min(edge + 10.0)
    };
    let places = (1..PLACES).map(|k| longest[k * (longest.len() - 1) / PLACES]);
    let best = places.max_by(|a, b| room(*a).total_cmp(&room(*b)))?;
    (room(best) >= APART / 2.0).then_some(best)
}

/// A point with its label, toward the middle of the area, so that it is not cut off; and where that stands.
fn beside([x, y]: [f64; 2], text: String) -> ((String, String, Label), [f64; 2]) {
    let (anchor, aside) = if x > (LEFT + RIGHT) / 2.0 { ("end", -8.0) } else { ("start", 8.0) };
    let below = if y < (TOP + BOTTOM) / 2.0 { 14.0 } else { -6.0 };
    let at = [x + aside, y + below];
    ((px(x), px(y), label("on", anchor, at, text)), at)
}

/// The lowest and the highest cell among those that have a value.
fn peaks(map: &Map) -> [stiffarm_study::dexterity::Peak; 2] {
    let first = || map.cells().filter(|cell| cell.value.is_finite());
    let none = stiffarm_study::dexterity::Peak { value: 0.0, first: 0.0, second: 0.0 };
    [
        first().min_by(|a, b| a.value.total_cmp(&b.value)).unwrap_or(none),
        first().max_by(|a, b| a.value.total_cmp(&b.value)).unwrap_or(none),
    ]
}

/// Round numbers between which the bands lie: from below the lowest value to above the highest.
fn levels([low, high]: [f64; 2]) -> Vec<f64> {
    let mut levels = ticks([low, high], BANDS);
    let step = if levels.len() > 1 { levels[1] - levels[0] } else { 1.0 };
    if levels.first().is_none_or(|first| *first > low) {
        let first = levels.first().copied().unwrap_or(low);
        levels.insert(0, rounded(first - step, step));
    }
    if levels.last().is_none_or(|last| *last <= high) {
        let last = levels.last().copied().unwrap_or(high);
        levels.push(rounded(last + step, step));
    }
    levels
}

fn rounded(x: f64, step: f64) -> f64 {
    (x / step).round() * step + 0.0
}

/// A grid's value at a place between its indices.
fn between(grid: &[f64], at: f64) -> f64 {
    let low = (at.floor() as usize).min(grid.len().saturating_sub(2));
    grid[low] + (grid[low + 1] - grid[low]) * (at - low as f64)
}
