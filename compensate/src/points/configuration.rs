//! What a point says of the joint values with which its pose is reached.

use core::f64::consts::{FRAC_PI_2, PI, TAU};

use super::Unmoved;
use crate::program::{Cell, Change, Configuration};

/// Axes 1, 4 and 6.
const TOLD: [usize; 3] = [0, 3, 5];

/// 1 where an axis is negative.
fn sign(q: f64) -> i64 {
    i64::from(q < 0.0)
}

fn quarter(q: f64) -> i64 {
    (q / FRAC_PI_2).floor() as i64
}

fn turn(q: f64) -> i64 {
    ((q + PI) / TAU).floor() as i64
}

/// An axis so near to where its sign, quarter or turn changes may be told as on the other side, rad: a thousandth of
/// a degree, to which controllers show angles.
pub(super) const EDGE: f64 = 2e-5;

impl Configuration {
    /// Whether joint values have what is said here.
    pub(super) fn fits(&self, q: &[f64]) -> bool {
        let either = |q: f64, of: &dyn Fn(f64) -> i64, said: f64| {
            [q - EDGE, q + EDGE].into_iter().any(|q| of(q) as f64 == said)
        };
        match self {
            Configuration::Unsaid => true,
            Configuration::Signs { turn, .. } => {
                let bit = |k: usize| (turn.value as i64 >> k & 1) as f64;
                q.iter().take(6).enumerate().all(|(k, q)| either(*q, &sign, bit(k)))
            }
            Configuration::Quarters(said) => {
                TOLD.iter().zip(said).all(|(k, said)| either(q[*k], &quarter, said.value))
            }
            Configuration::Turns(said) => {
                TOLD.iter().zip(said).all(|(k, said)| either(q[*k], &turn, said.value))
            }
        }
    }
}

/// The configuration of the new joint values, where it differs from that of the old ones.
pub(super) fn configured(
    said: &Configuration,
    from: &[f64],
    to: &[f64],
) -> Result<Vec<Change>, Unmoved> {
    // Of an axis that stays at an edge, what is said is left: which side of it is rounding.
    let stays = |k: usize, edge: &dyn Fn(f64) -> i64| {
        let at_edge = |q: f64| edge(q - EDGE) != edge(q + EDGE);
        edge(from[k]) == edge(to[k]) || at_edge(from[k]) && at_edge(to[k])
    };
    if *said != Configuration::Unsaid && !stays(4, &sign) {
        return Err(Unmoved::Flipped);
    }
    let each = |said: &[Cell; 3], of: &dyn Fn(f64) -> i64| -> Vec<Change> {
        let differing = TOLD.iter().zip(said).filter(|(k, _)| !stays(**k, of));
        differing.filter_map(|(k, cell)| cell.whole(of(to[*k]))).collect()
    };
    Ok(match said {
        Configuration::Unsaid => Vec::new(),
        Configuration::Signs { turn: cell, binary } => {
            let differing = (0..to.len().min(6)).filter(|k| !stays(*k, &sign));
            let turns = differing.fold(cell.value as i64, |turns, k| turns ^ (1 << k));
            let text = |text| if *binary { format!("'B{turns:06b}'") } else { text };
            let change = cell.whole(turns);
            change.map(|c| Change { text: text(c.text), ..c }).into_iter().collect()
        }
        Configuration::Quarters(cells) => each(cells, &quarter),
        Configuration::Turns(cells) => each(cells, &turn),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cell(value: f64) -> Cell {
        Cell { value, unit: 1.0, span: 0..1 }
    }

    #[test]
    fn configurations_are_those_of_the_readings() {
        let from = [0.1, -0.2, 0.3, 1e-3, 0.5, -1e-7];
        let told = |binary| Configuration::Signs { turn: cell(2.0), binary };
        let signs = told(false);
        assert!(signs.fits(&from) && !signs.fits(&[0.1, 0.2, 0.3, 0.0, 0.5, 0.0]));
        let texts = |said: &Configuration, to: &[f64]| -> Vec<String> {
            let changes = configured(said, &from, to).expect("no flip");
            changes.into_iter().map(|change| change.text).collect()
        };
        // Axis 4 goes through zero, axis 6 stays there.
        let to = [0.1, -0.2, 0.3, -1e-4, 0.5, 1e-7];
        assert_eq!(texts(&signs, &to), ["10"]);
        assert_eq!(texts(&told(true), &to), ["'B001010'"]);
        assert!(texts(&signs, &from).is_empty());
        let quarters = Configuration::Quarters([0.0, 0.0, -1.0].map(cell));
        assert!(quarters.fits(&from));
        assert_eq!(texts(&quarters, &to), ["-1"]);
        let turns = Configuration::Turns([0.0; 3].map(cell));
        assert!(turns.fits(&from) && !turns.fits(&[3.2, 0.0, 0.0, 0.0, 0.0, 0.0]));
        assert_eq!(texts(&turns, &[3.2, -0.2, 0.3, 0.0, 0.5, 0.0]), ["1"]);
        let flipped = [0.1, -0.2, 0.3, 0.0, -0.1, 0.0];
        assert_eq!(configured(&signs, &from, &flipped), Err(Unmoved::Flipped));
        assert_eq!(configured(&Configuration::Unsaid, &from, &flipped), Ok(Vec::new()));
    }
}
