//! The maps of Figs. 3 and 4 and the zones of Table 1.

use stiffarm_papers::methods::dumas;
use stiffarm_study::dexterity::{Map, Peak, Plane, influence, inverse_condition};

use super::{LENGTH, kr240};
use crate::near;

/// The three zones of Table 1 in θ2 and θ3, degrees.
pub const ZONES: [(&str, [f64; 2], [f64; 2]); 3] = [
    ("Z1c", [0.0, 110.0], [-245.0, -170.0]),
    ("Z2c", [0.0, 25.0], [0.0, 29.0]),
    ("Z3c", [100.0, 146.0], [0.0, 29.0]),
];

/// −245° to 29° ends on the limit, 0° to 146° too.
fn plane() -> Plane {
    dumas::plane(&kr240()).unwrap()
}

fn dexterity(length: f64) -> Map {
    let arm = kr240();
    plane().map(|q| inverse_condition(&arm, q, length)).unwrap()
}

/// In which zone a cell lies; those on a bound belong to it.
fn zone(cell: &Peak) -> Option<usize> {
    let within =
        |x: f64, [low, high]: [f64; 2]| (low - 1e-6..=high + 1e-6).contains(&x.to_degrees());
    ZONES.iter().position(|(_, a, b)| within(cell.first, *a) && within(cell.second, *b))
}

/// Smallest, middle and largest value of some cells.
fn statistics(map: &Map, keep: impl Fn(&Peak) -> bool) -> [f64; 3] {
    let mut values: Vec<f64> = map.cells().filter(keep).map(|cell| cell.value).collect();
    values.sort_by(f64::total_cmp);
    let n = values.len();
    [values[0], (values[(n - 1) / 2] + values[n / 2]) / 2.0, values[n - 1]]
}

#[test]
fn the_map_of_fig_3() {
    let map = dexterity(LENGTH);
    assert_eq!(map.values.shape(), (74, 138));
    let best = map.max().unwrap();
    near(best.value, 0.557, 6e-4);
    near(best.first.to_degrees(), 4.0, 1e-9);
    near(best.second.to_degrees(), 29.0, 1e-9);
    // The best cell of all is the corner of Z2c.
    let printed = [[0.382, 0.449, 0.522], [0.471, 0.525, 0.557], [0.442, 0.499, 0.553]];
    for (k, printed) in printed.into_iter().enumerate() {
        let found = statistics(&map, |cell| zone(cell) == Some(k));
        found.into_iter().zip(printed).for_each(|(found, printed)| near(found, printed, 6e-4));
    }
    near(statistics(&map, |_| true)[1], 0.369, 1e-3);
    near(statistics(&map, |cell| zone(cell).is_none())[1], 0.317, 1e-3);
    // A quarter of the cells lies in the zones, and of the best quarter three in four.
    let mut cells: Vec<Peak> = map.cells().collect();
    cells.sort_by(|a, b| b.value.total_cmp(&a.value));
    let inside = |cells: &[Peak]| cells.iter().filter(|cell| zone(cell).is_some()).count();
    let count = inside(&cells);
    near(count as f64 / cells.len() as f64, 0.26, 5e-3);
    near(inside(&cells[..count]) as f64 / count as f64, 0.72, 1e-2);
    // The dark line: near the outstretched arm the dexterity vanishes.
    assert!(map.min().unwrap().value < 0.01);
}

/// Spearman's rank correlation of two maps over the same cells.
fn rank_correlation(a: &Map, b: &Map) -> f64 {
    let ranks = |map: &Map| {
        let mut order: Vec<(usize, f64)> = map.values.iter().copied().enumerate().collect();
        order.sort_by(|x, y| x.1.total_cmp(&y.1));
        let mut ranks = vec![0.0; order.len()];
        order.iter().enumerate().for_each(|(rank, (cell, _))| ranks[*cell] = rank as f64);
        ranks
    };
    let squares: f64 = ranks(a).iter().zip(ranks(b)).map(|(x, y)| (x - y).powi(2)).sum();
    let n = a.values.len() as f64;
    1.0 - 6.0 * squares / (n * (n * n - 1.0))
}

/// "The condition number depends on L, but not the location of the zones": nearly so, the cells
/// keep their order the worse the farther L is from 0.682 m.
#[test]
fn the_zones_outlast_the_length() {
    let own = dexterity(LENGTH);
    for (length, want) in [(0.35, 0.95), (0.5, 0.98), (1.0, 0.97), (3.0, 0.83)] {
        let other = dexterity(length);
        near(rank_correlation(&own, &other), want, 0.01);
        let outside = statistics(&other, |cell| zone(cell).is_none())[1];
        let middle = |k: usize| statistics(&other, |cell| zone(cell) == Some(k))[1];
        assert!(length > 2.0 || (0..3).all(|k| middle(k) > outside), "{length}");
    }
    near(rank_correlation(&own, &own), 1.0, 0.0);
}

/// The oblique line of Fig. 3: the wrist centre on axis 1, where the dexterity vanishes too.
#[test]
fn the_oblique_line_is_the_shoulder_singularity() {
    let arm = kr240();
    let line = [(53.9, 29.0), (57.0, 15.0), (61.7, 0.0), (73.1, -30.0), (86.1, -60.0)];
    for (second, third) in line.into_iter().chain([(139.6, -170.0)]) {
        let mut q = plane().posture;
        q[1] = f64::to_radians(second);
        q[2] = f64::to_radians(third);
        let wrist = arm.frames(&q)[4].translation.vector;
        // The angles are rounded to 0.1°, the wrist is up to 2.5 m away.
        near(wrist.xy().norm(), 0.0, 2.5e-3);
        assert!(inverse_condition(&arm, &q, LENGTH).unwrap() < 0.005);
    }
}

/// Printed: ν_p ≤ 0.016 and ν_r ≤ 0.025°. With the stiffnesses of Table 2 both hold, by far. With the
/// set that Knapczyk & Ryska quote, read as MN·m/rad, ν_p comes close below the printed 0.016, at the
/// place of the weak joint 2.
#[test]
fn the_maps_of_fig_4() {
    let table_2 = kr240();
    let mut quoted = kr240();
    let softer = [1.41e6, 0.401e6, 0.935e6, 0.36e6, 0.37e6, 0.38e6];
    for (joint, stiffness) in quoted.joints.iter_mut().zip(softer) {
        joint.compliance = 1.0 / stiffness;
    }
    for (arm, nu_p, place, nu_r) in
        [(table_2, 0.00123, (90.0, -81.0), 7e-5), (quoted, 0.0141, (96.0, -105.0), 0.0071)]
    {
        let at = |q: &[f64]| influence(&arm, q, &dumas::WRENCH);
        let found = plane().map(|q| at(q).map(|i| i.nu_p)).unwrap().max().unwrap();
        near(found.value, nu_p, 0.01 * nu_p);
        near(found.first.to_degrees(), place.0, 1e-9);
        near(found.second.to_degrees(), place.1, 1e-9);
        let found = plane().map(|q| at(q).map(|i| i.nu_r)).unwrap().max().unwrap();
        near(found.value.to_degrees(), nu_r, 0.08 * nu_r);
    }
}
