//! Lines of one value through a grid of numbers: marching squares with linear interpolation.
//!
//! A cell with a corner that is not a number has no line. Where a cell's corners are high and low
//! in turn, the mean of the four decides which are joined.

use std::collections::HashMap;

/// The side of a cell on which a line crosses: the grid point it begins at, and whether it runs
/// along the first index.
type Side = (usize, usize, bool);

/// The lines of `level`, in units of the grid's indices. `value(i, j)` is the number at a grid
/// point, `i < columns`, `j < rows`. A closed line ends where it begins.
pub fn isolines(
    columns: usize,
    rows: usize,
    value: impl Fn(usize, usize) -> f64,
    level: f64,
) -> Vec<Vec<[f64; 2]>> {
    let mut joined: HashMap<Side, Vec<Side>> = HashMap::new();
    let mut order = Vec::new();
    let mut join = |a: Side, b: Side| {
        for (from, to) in [(a, b), (b, a)] {
            let others = joined.entry(from).or_insert_with(|| {
                order.push(from);
                Vec::new()
            });
            others.push(to);
        }
    };
    for j in 1..rows {
        for i in 1..columns {
            for [a, b] in crossed(i - 1, j - 1, &value, level) {
                join(a, b);
            }
        }
    }
    // Open lines begin at their ends, which have one neighbour; what is left then is closed.
    let mut starts: Vec<Side> = order.iter().copied().filter(|s| joined[s].len() == 1).collect();
    starts.extend(&order);
    let place = |side: &Side| place(side, &value, level);
    let mut lines = Vec::new();
    for start in starts {
        let mut line = vec![place(&start)];
        let mut at = start;
        while let Some(next) = joined.get_mut(&at).and_then(Vec::pop) {
            if let Some(back) = joined.get_mut(&next)
                && let Some(own) = back.iter().position(|side| *side == at)
            {
                back.swap_remove(own);
            }
            line.push(place(&next));
            at = next;
        }
        if line.len() > 1 {
            lines.push(line);
        }
    }
    lines
}

/// The lines within one cell, each from side to side.
fn crossed(i: usize, j: usize, value: &impl Fn(usize, usize) -> f64, level: f64) -> Vec<[Side; 2]> {
    let corners = [value(i, j), value(i + 1, j), value(i + 1, j + 1), value(i, j + 1)];
    if corners.iter().any(|corner| !corner.is_finite()) {
        return Vec::new();
    }
    let sides: [Side; 4] = [(i, j, true), (i + 1, j, false), (i, j + 1, true), (i, j, false)];
    let high = corners.map(|corner| corner >= level);
    let cut: Vec<Side> =
        (0..4).filter(|&k| high[k] != high[(k + 1) % 4]).map(|k| sides[k]).collect();
    match cut[..] {
        [a, b] => vec![[a, b]],
        [a, b, c, d] => {
            let middle = corners.iter().sum::<f64>() / 4.0 >= level;
            // Corner 0 lies between the last side and the first.
            if middle == high[0] { vec![[a, b], [c, d]] } else { vec![[d, a], [b, c]] }
        }
        _ => Vec::new(),
    }
}

/// Where on its side the level is met.
fn place(&(i, j, along): &Side, value: &impl Fn(usize, usize) -> f64, level: f64) -> [f64; 2] {
    let (from, to) = (value(i, j), if along { value(i + 1, j) } else { value(i, j + 1) });
    let part = ((level - from) / (to - from)).clamp(0.0, 1.0);
    let (x, y) = (i as f64, j as f64);
    if along { [x + part, y] } else { [x, y + part] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cone_has_circles() {
        let value = |i: usize, j: usize| (i as f64 - 10.0).hypot(j as f64 - 10.0);
        let lines = isolines(21, 21, value, 6.5);
        assert_eq!(lines.len(), 1);
        assert_eq!(lines[0].first(), lines[0].last());
        for [x, y] in &lines[0] {
            // The cone's curvature between two grid points: 1/(8 r) at most.
            assert!(((x - 10.0).hypot(y - 10.0) - 6.5).abs() < 0.02);
        }
        // A circle that leaves the grid is four arcs.
        let arcs = isolines(21, 21, value, 12.0);
        assert_eq!(arcs.len(), 4);
        for arc in &arcs {
            let on_border = |[x, y]: &[f64; 2]| [*x, *y].iter().any(|c| *c == 0.0 || *c == 20.0);
            assert!(on_border(&arc[0]) && on_border(arc.last().unwrap()), "{arc:?}");
        }
    }

    #[test]
    fn a_saddle_is_joined_by_its_middle() {
        let corners = |high: f64| move |i: usize, j: usize| if i == j { high } else { 0.0 };
        assert_eq!(isolines(2, 2, corners(1.0), 0.4).len(), 2);
        let below = isolines(2, 2, corners(1.0), 0.4);
        let above = isolines(2, 2, corners(1.0), 0.6);
        // Below the mean of 0.5 the high corners are joined: lines cut off the low ones.
        assert!(below.iter().all(|line| {
            let ([x, y], [u, v]) = (line[0], line[1]);
            (x - u).abs() == (y - v).abs() && ((x + u) / 2.0 - (y + v) / 2.0).abs() > 0.5
        }));
        assert!(above.iter().all(|line| {
            let ([x, y], [u, v]) = (line[0], line[1]);
            ((x + u) / 2.0 - (y + v) / 2.0).abs() < 1e-12
        }));
    }

    #[test]
    fn holes_end_lines() {
        let value = |i: usize, j: usize| if i == 5 { f64::NAN } else { j as f64 };
        let lines = isolines(11, 4, value, 1.5);
        assert_eq!(lines.len(), 2);
        assert_eq!(lines.iter().map(Vec::len).sum::<usize>(), 10);
        assert!(isolines(0, 0, |_, _| 0.0, 0.0).is_empty());
        assert!(isolines(3, 3, |_, _| 1.0, 2.0).is_empty());
    }
}
