//! Table V: what its eight configurations can and cannot deflect by. Its angles, Table VI and step 9 are
//! judged in the ledger, as are Tables I to III.

use super::arms::{Links, draws, elbow, printed_elbow, weight};
use super::printed::Printed;
use crate::near;

/// theta1 to theta6 in degrees, deflection in inches.
const TABLE_5: [([f64; 6], f64); 8] = [
    ([53.130, 58.612, -117.224, 148.612, 90.000, -143.130], 0.00329),
    ([53.130, -58.612, 117.224, 31.388, 90.000, -143.130], 0.00703),
    ([53.130, 86.824, -96.329, 279.505, -90.000, 36.870], 0.01538),
    ([53.130, -9.505, 96.329, 183.176, -90.000, 36.870], 0.05824),
    ([233.130, -121.388, -117.224, 328.612, 90.000, 36.870], 0.00686),
    ([233.130, 121.388, 117.224, -148.612, 90.000, 36.870], 0.00313),
    ([233.130, -170.495, -96.329, 176.824, -90.000, -143.130], 0.05828),
    ([233.130, 93.176, 96.329, 80.495, -90.000, -143.130], 0.01542),
];

/// The corrected appendix: dy1, what the turns of the links' tips do through the joints before them, and
/// dy2, the links' own deflections.
fn appendix(printed: &Printed, links: &Links<4>, degrees: [f64; 6]) -> [f64; 2] {
    let names = [("a2", 2), ("a3", 3), ("a4", 4), ("d6", 6)];
    let mut values = links.values(names, &degrees.map(f64::to_radians));
    for name in ["B", "C", "D"] {
        let value = printed.entries(&format!("App. {name}"), &values)[0];
        values.insert(name.into(), value);
    }
    ["dy_1", "dy_2"].map(|part| {
        let term = |(_, row): (_, usize)| format!("App. {part}, E_{row}I_{row} term");
        names.map(|link| printed.entries(&term(link), &values)[0]).iter().sum()
    })
}

/// All rows stand at one pose, so that C234 = 0 and C5 = 0, and only C2 and C23 enter, as squares and
/// as a product: for any lengths, loads, weights and stiffnesses rows 1, 2, 5 and 6 are equal, 3 = 8 and
/// 4 = 7.
#[test]
fn the_deflections_cannot_be_those_of_any_parameters() {
    let (printed, mut random) = (Printed::of("lin1991/equations.toml"), draws(4));
    for _ in 0..3 {
        let links = Links::drawn(&mut random);
        let found = TABLE_5.map(|(degrees, _)| appendix(&printed, &links, degrees));
        for y in [found.map(|[y, _]| y), found.map(|[_, y]| y), found.map(|[a, b]| a + b)] {
            let size = y.map(f64::abs).into_iter().fold(0.0, f64::max);
            // The angles are rounded to 0.0005°, 1e-5 rad, and a cosine enters at most squared.
            for (one, other) in [(0, 1), (0, 4), (0, 5), (2, 7), (3, 6)] {
                near(y[one], y[other], 1e-4 * size);
            }
        }
    }
    // Printed are two groups of what must be equal: no value is nearer to all four than this.
    let equal = [0, 1, 4, 5].map(|k: usize| TABLE_5[k].1);
    let (low, high) = equal.iter().fold((1.0_f64, 0.0_f64), |(l, h), &v| (l.min(v), h.max(v)));
    near((high - low) / 2.0, 0.00195, 1e-12);
    assert!(high / low > 2.2);
}

/// With the stated data and E = 10e6 psi, vertically: the appendix, corrected, and the exact
/// deflection of the clamped chain, of which it is about twice; for weightless links and for links
/// of 0.1 lb/in³ (the paper prints no density). Configurations 4 and 7, the worst of Table V, bend least
/// by either.
#[test]
fn the_deflections_of_the_stated_arm() {
    let printed = Printed::of("lin1991/equations.toml");
    // Rows 1, 2, 5 and 6; 3 and 8; 4 and 7.
    let of_row = [0, 0, 1, 2, 0, 0, 2, 1];
    let light = [(0.03934, 0.01851), (0.06164, 0.03461), (0.02442, 0.00980)];
    let heavy = [(0.05297, 0.02547), (0.07907, 0.04503), (0.03704, 0.01503)];
    for (links, expected) in [(printed_elbow(0.0), light), (printed_elbow(0.0596903), heavy)] {
        let arm = elbow(&links);
        for ((degrees, _), row) in TABLE_5.iter().zip(of_row) {
            let (total, exact) = expected[row];
            near(-appendix(&printed, &links, *degrees).iter().sum::<f64>(), total, 1e-5);
            let q = degrees.map(f64::to_radians);
            near(-arm.deflection_with_gravity(&q, &weight(2, 5.0)).unwrap().z, exact, 1e-5);
        }
        let least = |of: fn(&(f64, f64)) -> f64| expected.iter().map(of).fold(1.0, f64::min);
        assert_eq!(expected[2], (least(|e| e.0), least(|e| e.1)));
    }
}
