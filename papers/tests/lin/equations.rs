//! What the paper's ways of adding the links' deflections come to, beside the exact deflection.

use std::f64::consts::PI;

use super::arms::{Links, draws, planar, weight};
use super::printed::Printed;
use crate::near;

/// Eq. 32 is the exact deflection of the clamped chain, as the textbook has it; eqs. 27 and 28 leave out
/// what the slope of link 1 does through link 2, and eq. 46 counts the slopes of the links again:
/// `YC = YT + A L2 C12/E1I1`, `YT + YD = YC + A L1 C1/E1I1 + B (L1 C1 + 2 L2 C12)/E2I2`.
#[test]
fn the_papers_total_counts_slopes_twice() {
    let (printed, mut random) = (Printed::of("lin1991/equations.toml"), draws(1));
    for _ in 0..20 {
        let (links, q) = (Links::<2>::drawn(&mut random), random.array::<2>(-PI, PI));
        let mut values = links.values([("L1", 1), ("L2", 2)], &q);
        let exact = planar(&links).deflection_with_gravity(&q, &weight(1, links.load)).unwrap().y;
        for (name, number) in
            [("A", "(35) A"), ("B", "(35) B"), ("dtheta1", "(35)"), ("dtheta2", "(36)")]
        {
            let value = printed.entries(number, &values)[0];
            values.insert(name.into(), value);
        }
        let [y2, y1, yc, yd] =
            ["(27)", "(28)", "(32)", "(46)"].map(|number| printed.entries(number, &values)[0]);
        let [a, b] = [0, 1].map(|k| values[["A", "B"][k]] / links.rigidity[k]);
        let (r1, r2) = (links.lengths[0] * q[0].cos(), links.lengths[1] * (q[0] + q[1]).cos());
        let size = 1e-11 * (yc.abs() + yd.abs());
        near(yc, exact, size);
        near(yc, y1 + y2 - a * r2, size);
        near(y1 + y2 + yd, yc - a * r1 - b * (r1 + 2.0 * r2), size);
    }
}
