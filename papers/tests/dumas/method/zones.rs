//! Rectangles of a map and how they compare with the rest (Dumas et al., Table 1).

use stiffarm_gap::dexterity::{Map, Peak};

/// Rounding of a bound, rad or m: cells on the bound belong to the zone.
const ON_BOUND: f64 = 1e-9;

/// A rectangle of the two joints of a map, bounds included.
#[derive(Clone, Debug, PartialEq)]
pub struct Zone {
    /// As it is called.
    pub name: String,
    /// Bounds of the first joint, rad or m.
    pub first: [f64; 2],
    /// Bounds of the second joint, rad or m.
    pub second: [f64; 2],
}

impl Zone {
    /// A zone with bounds in degrees.
    pub fn degrees(name: &str, first: [f64; 2], second: [f64; 2]) -> Zone {
        let radians = |bounds: [f64; 2]| bounds.map(f64::to_radians);
        Zone { name: name.to_owned(), first: radians(first), second: radians(second) }
    }

    /// Whether a cell lies in it.
    pub fn holds(&self, cell: &Peak) -> bool {
        let within = |x: f64, [low, high]: [f64; 2]| x >= low - ON_BOUND && x <= high + ON_BOUND;
        within(cell.first, self.first) && within(cell.second, self.second)
    }
}

/// The three zones of Table 1 in (θ2, θ3) of the KR 240-2.
pub fn table_1() -> [Zone; 3] {
    [
        Zone::degrees("Z1c", [0.0, 110.0], [-245.0, -170.0]),
        Zone::degrees("Z2c", [0.0, 25.0], [0.0, 29.0]),
        Zone::degrees("Z3c", [100.0, 146.0], [0.0, 29.0]),
    ]
}

/// Values of some cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Statistics {
    /// How many cells.
    pub cells: usize,
    /// Smallest value.
    pub min: f64,
    /// The one in the middle, or the mean of the two in the middle.
    pub median: f64,
    /// Largest value.
    pub max: f64,
}

/// How zones compare with the rest of their map.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// Of each zone; none where it holds no cell.
    pub zones: Vec<Option<Statistics>>,
    /// Of the cells outside all zones.
    pub outside: Option<Statistics>,
    /// Of all cells.
    pub all: Option<Statistics>,
    /// Part of the cells that lie in a zone.
    pub area: f64,
    /// Of the best cells, as many as lie in the zones, the part that lies in the zones: 1 if the
    /// zones are exactly the best cells, `area` if they were placed without regard to the map.
    pub hit: f64,
}

/// Statistics of some values; none of none.
pub fn statistics(values: impl Iterator<Item = f64>) -> Option<Statistics> {
    let mut sorted: Vec<f64> = values.collect();
    sorted.sort_by(f64::total_cmp);
    let (min, max) = (*sorted.first()?, *sorted.last()?);
    let cells = sorted.len();
    let median = (sorted[(cells - 1) / 2] + sorted[cells / 2]) / 2.0;
    Some(Statistics { cells, min, median, max })
}

/// Spearman's rank correlation of two maps over the same cells, from −1 to 1: 1 if both put all
/// cells in the same order, so that any zones of the one are zones of the other. Equal values keep
/// the order of their cells. None if the maps differ in shape or have fewer than two cells.
pub fn rank_correlation(a: &Map, b: &Map) -> Option<f64> {
    let count = a.values.len();
    if a.values.shape() != b.values.shape() || count < 2 {
        return None;
    }
    let ranks = |map: &Map| {
        let values: Vec<f64> = map.values.iter().copied().collect();
        let mut order: Vec<usize> = (0..count).collect();
        order.sort_by(|&x, &y| values[x].total_cmp(&values[y]));
        let mut ranks = vec![0.0; count];
        order.iter().enumerate().for_each(|(rank, &cell)| ranks[cell] = rank as f64);
        ranks
    };
    let squares: f64 = ranks(a).iter().zip(ranks(b)).map(|(x, y)| (x - y).powi(2)).sum();
    let n = count as f64;
    Some(1.0 - 6.0 * squares / (n * (n * n - 1.0)))
}

/// Compares the zones of a map with the rest of it.
pub fn compare(map: &Map, zones: &[Zone]) -> Comparison {
    let inside = |cell: &Peak| zones.iter().any(|zone| zone.holds(cell));
    let mut cells: Vec<Peak> = map.cells().collect();
    cells.sort_by(|a, b| b.value.total_cmp(&a.value));
    let count = cells.iter().filter(|cell| inside(cell)).count();
    let among_best = cells[..count].iter().filter(|cell| inside(cell)).count();
    let values = |keep: &dyn Fn(&Peak) -> bool| {
        statistics(cells.iter().filter(|cell| keep(cell)).map(|cell| cell.value))
    };
    let part = |some: usize, of: usize| if of == 0 { 0.0 } else { some as f64 / of as f64 };
    Comparison {
        zones: zones.iter().map(|zone| values(&|cell| zone.holds(cell))).collect(),
        outside: values(&|cell| !inside(cell)),
        all: values(&|_| true),
        area: part(count, cells.len()),
        hit: part(among_best, count),
    }
}
