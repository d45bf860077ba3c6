//! A map as a picture.

use stiffarm_gap::dexterity::Map;

use super::quantity_of::Quantity;
use super::sweep::{Moved, Sweep};
use crate::input::source::Source;
use crate::plot::{Axis, Bands, Figure, Layer, Line, Point, isolines, number, ticks};
use crate::terminal::text::short;

/// About so many bands.
const BANDS: usize = 8;

/// Bands of colour, lines between them, the lowest and the highest cell.
pub fn figure(source: &Source, sweep: &Sweep, asked: &Quantity, map: &Map) -> Figure {
    let [first, second] = &sweep.axes;
    let plane = &map.plane;
    let x: Vec<f64> = plane.first.iter().map(|v| first.shown(*v)).collect();
    let y: Vec<f64> = plane.second.iter().map(|v| second.shown(*v)).collect();
    let (columns, rows) = (x.len(), y.len());
    let peaks = peaks(map);
    let range = [peaks[0].value, peaks[1].value];
    let levels = levels(range);
    let unit = match asked.unit() {
        "" => String::new(),
        unit => format!(", {unit}"),
    };
    let mut layers = vec![Layer::Bands(Bands {
        values: (0..rows).flat_map(|j| (0..columns).map(move |i| map.values[(i, j)])).collect(),
        levels: levels.clone(),
        name: format!("{}{unit}", asked.name()),
        x: x.clone(),
        y: y.clone(),
    })];
    let inner = levels.iter().skip(1).take(levels.len().saturating_sub(2));
    layers.extend(inner.map(|level| {
        let lines = isolines(columns, rows, |i, j| map.values[(i, j)], *level);
        let place = |[i, j]: [f64; 2]| [between(&x, i), between(&y, j)];
        let lines = lines.into_iter().map(|line| line.into_iter().map(place).collect()).collect();
        Layer::Line(Line { lines, label: number(*level) })
    }));
    let names = ["lowest", "highest"];
    let points = peaks.iter().zip(names).map(|(peak, name)| Point {
        at: [first.shown(peak.first), second.shown(peak.second)],
        label: format!("{name} {}", short(peak.value)),
    });
    layers.push(Layer::Points(points.collect()));
    let others =
        if sweep.others.is_empty() { String::new() } else { format!("; {}", sweep.others) };
    let circumstances = asked.circumstances();
    Figure {
        title: format!("{}: {}", source.robot.name, asked.name()),
        subtitle: format!("{circumstances}{others}"),
        description: format!(
            "A map of the {} over {} and {}, with lines of equal value. It lies between {} and \
             {}{}.",
            asked.name(),
            first.name,
            second.name,
            short(range[0]),
            short(range[1]),
            if unit.is_empty() { String::new() } else { format!(" {}", asked.unit()) }
        ),
        x: axis(first, &x),
        y: axis(second, &y),
        layers,
    }
}

fn axis(joint: &Moved, grid: &[f64]) -> Axis {
    Axis {
        name: format!("{}, {}", joint.name, joint.unit),
        domain: [grid[0], grid[grid.len() - 1]],
        degrees: joint.turns(),
    }
}

/// The lowest and the highest cell among those that have a value.
fn peaks(map: &Map) -> [stiffarm_gap::dexterity::Peak; 2] {
    let first = || map.cells().filter(|cell| cell.value.is_finite());
    let none = stiffarm_gap::dexterity::Peak { value: 0.0, first: 0.0, second: 0.0 };
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
