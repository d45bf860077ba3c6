//! Which postures to test in: dexterous, spread over the zones, and with a wrist that keeps K_C
//! small (Dumas et al., sections 3.1-3.2: θ2 and θ3 by the first criterion, θ4 and θ5 by the
//! second).

use nalgebra::Vector6;
use stiffarm_gap::dexterity::{DexterityError, Map, Peak, influence, inverse_condition};
use stiffarm_kernels::generic::Arm;

use super::zones::{Zone, statistics};

/// What to choose by.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// Postures in each zone.
    pub per_zone: usize,
    /// L of `1/κ_F(J_N)`, m.
    pub length: f64,
    /// The wrench of the tests, base axes at the tool origin.
    pub wrench: Vector6<f64>,
    /// The joints of the wrist that are chosen by K_C, from 0, and the values that each may take.
    pub wrist: Vec<(usize, Vec<f64>)>,
    /// A wrist must keep this part of the largest `1/κ_F(J_N)` that the wrists give.
    pub keep: f64,
}

/// A posture to test in.
#[derive(Clone, Debug, PartialEq)]
pub struct TestPosture {
    /// Name of its zone.
    pub zone: String,
    /// All joint values.
    pub joints: Vec<f64>,
    /// `1/κ_F(J_N)`.
    pub inverse_condition: f64,
    /// ν_p under the wrench.
    pub nu_p: f64,
}

/// `per_zone` postures in each zone, of the better half of the zone's cells: the best cell first,
/// then always the one farthest from those already chosen (in parts of the zone's width); fewer
/// where a zone has not as many cells. Each then gets the wrist with the smallest ν_p among those
/// that keep its dexterity.
///
/// # Errors
/// As [`inverse_condition`] and [`influence`].
pub fn choose(
    arm: &Arm,
    map: &Map,
    zones: &[Zone],
    choice: &Choice,
) -> Result<Vec<TestPosture>, DexterityError> {
    let mut chosen = Vec::new();
    for zone in zones {
        for cell in spread(map, zone, choice.per_zone) {
            let mut q = map.plane.posture.clone();
            q[map.plane.joints[0]] = cell.first;
            q[map.plane.joints[1]] = cell.second;
            chosen.push(with_wrist(arm, zone, q, choice)?);
        }
    }
    Ok(chosen)
}

/// Up to `count` cells of the better half of a zone, far apart.
fn spread(map: &Map, zone: &Zone, count: usize) -> Vec<Peak> {
    let mut cells: Vec<Peak> = map.cells().filter(|cell| zone.holds(cell)).collect();
    let Some(middle) = statistics(cells.iter().map(|cell| cell.value)) else { return Vec::new() };
    cells.retain(|cell| cell.value >= middle.median);
    let width = |[low, high]: [f64; 2]| if high > low { high - low } else { 1.0 };
    let apart = |a: &Peak, b: &Peak| {
        let (x, y) = (a.first - b.first, a.second - b.second);
        (x / width(zone.first)).hypot(y / width(zone.second))
    };
    let mut chosen: Vec<Peak> = Vec::new();
    while chosen.len() < count {
        let nearest = |cell: &Peak| {
            chosen.iter().map(|other| apart(cell, other)).fold(f64::INFINITY, f64::min)
        };
        let rank = |cell: &Peak| (nearest(cell), cell.value);
        let best = cells.iter().filter(|cell| nearest(cell) > 0.0).max_by(|a, b| {
            let ((far_a, value_a), (far_b, value_b)) = (rank(a), rank(b));
            far_a.total_cmp(&far_b).then(value_a.total_cmp(&value_b))
        });
        match best {
            Some(cell) => chosen.push(*cell),
            None => break,
        }
    }
    chosen
}

/// The posture with each combination of the wrist's values; the one with the smallest ν_p among
/// those that are dexterous enough.
fn with_wrist(
    arm: &Arm,
    zone: &Zone,
    q: Vec<f64>,
    choice: &Choice,
) -> Result<TestPosture, DexterityError> {
    let mut wrists = vec![q];
    for (joint, values) in &choice.wrist {
        wrists = wrists
            .iter()
            .flat_map(|q| {
                values.iter().map(|value| {
                    let mut turned = q.clone();
                    turned[*joint] = *value;
                    turned
                })
            })
            .collect();
    }
    let mut judged = Vec::new();
    for joints in wrists {
        let inverse_condition = inverse_condition(arm, &joints, choice.length)?;
        let nu_p = influence(arm, &joints, &choice.wrench)?.nu_p;
        judged.push(TestPosture { zone: zone.name.clone(), joints, inverse_condition, nu_p });
    }
    let best = judged.iter().map(|t| t.inverse_condition).fold(0.0, f64::max);
    judged.retain(|t| t.inverse_condition >= choice.keep * best);
    let least = judged.into_iter().min_by(|a, b| a.nu_p.total_cmp(&b.nu_p));
    let (what, expected) =
        ("the part of the dexterity to keep", "at most 1, and a value per wrist");
    least.ok_or(DexterityError::Setting { what, found: choice.keep, expected })
}
