//! The elbow manipulator's appendix, term by term, against the general functions.

use stiffarm_draws::Draws;
use stiffarm_papers::lin::{ElbowLinks, deflections};

use crate::arms::{Links, elbow, near, weight};

/// Rows of the table that the four terms belong to.
const ROWS: [usize; 4] = [2, 3, 4, 6];

fn cases() -> impl Iterator<Item = (ElbowLinks, [f64; 6])> {
    let mut random = Draws::new(2);
    (0..300).map(move |_| (random.elbow(), random.array(-3.1, 3.1)))
}

/// dy2 of links 2, 3, 4 and 6 as the appendix prints it.
fn printed_dy2(links: &ElbowLinks, q: &[f64; 6]) -> [f64; 4] {
    let ([a2, a3, a4, d6], [w2, w3, w4, w6]) = (links.lengths, links.weights);
    let (p, c2, c3, c23) = (links.load, q[1].cos(), q[2].cos(), (q[1] + q[2]).cos());
    let ((s234, c234), s5) = ((q[1] + q[2] + q[3]).sin_cos(), q[4].sin());
    let link_6 = p * d6.powi(3) / 3.0 - p * d6.powi(3) * s234.powi(2) * s5.powi(2) / 3.0
        + w6 * d6.powi(4) / 8.0
        - w6 * d6.powi(4) * s234.powi(2) * s5.powi(2) / 8.0;
    let link_4 = p * a4.powi(3) * c234.powi(2) / 3.0
        - p * a4.powi(2) * d6 * c234.powi(2) * s5 / 2.0
        + w6 * a4.powi(3) * d6 * c234.powi(2) / 3.0
        - w6 * a4.powi(2) * d6.powi(2) * c234.powi(2) * s5 / 4.0
        + w4 * a4.powi(4) * c234.powi(2) / 8.0;
    let link_3 = p * a3.powi(3) * c23.powi(2) / 3.0
        + p * a3.powi(2) * a4 * c234 * c23 / 2.0
        + p * a3.powi(2) * d6 * c234 * c23 * s5 / 2.0
        + w6 * a3.powi(3) * d6 * c23.powi(2) / 3.0
        + w6 * a3.powi(2) * a4 * d6 * c234 * c3 / 2.0
        + w6 * a3.powi(2) * d6.powi(2) * c234 * c23 * s5 / 4.0
        + w4 * a3.powi(3) * a4 * c23.powi(2) / 3.0
        + w4 * a3.powi(2) * a4.powi(2) * c234 * c23 / 4.0
        + w3 * a3.powi(4) * c23.powi(2) / 8.0;
    let link_2 = p * a2.powi(3) * c2.powi(2) / 3.0
        + p * a2.powi(2) * a3 * c23 * c2 / 2.0
        + p * a2.powi(2) * a4 * c234 * c2 / 2.0
        + p * a2.powi(2) * d6 * c234 * c2 * s5 / 2.0
        + w6 * a2.powi(3) * d6 * c2.powi(2) / 3.0
        + w6 * a2.powi(2) * a3 * d6 * c23 * c2 / 2.0
        + w6 * a2.powi(2) * a4 * d6 * c234 * c2 / 2.0
        + w6 * a2.powi(2) * d6.powi(2) * c234 * c2 * s5 / 4.0
        + w4 * a2.powi(3) * a4 * c2.powi(2) / 3.0
        + w4 * a2.powi(2) * a3 * a4 * c23 * c2 / 2.0
        + w4 * a2.powi(2) * a4.powi(2) * c234 * c2 / 4.0
        + w3 * a2.powi(3) * a3 * c2.powi(2) / 3.0
        + w3 * a2.powi(2) * a3.powi(2) * c23 * c2 / 4.0
        + w2 * a2.powi(4) * c2.powi(2) / 8.0;
    let terms = [link_2, link_3, link_4, link_6];
    std::array::from_fn(|k| -terms[k] / links.rigidity[k])
}

/// The printed dy1 of link 6: `+A(…)/E6I6`.
fn printed_dy1_link_6(links: &ElbowLinks, q: &[f64; 6]) -> f64 {
    let ([a2, a3, a4, d6], w6, p) = (links.lengths, links.weights[3], links.load);
    let (c2, c23, c234) = (q[1].cos(), (q[1] + q[2]).cos(), (q[1] + q[2] + q[3]).cos());
    let (s5, c5) = q[4].sin_cos();
    let s2345 = (q[1] + q[2] + q[3] + q[4]).sin();
    let a = c234 * c5 * (3.0 * p * d6.powi(2) + w6 * d6.powi(3)) / 6.0;
    let lever = a2 * c2 + 2.0 * a3 * c23 + 3.0 * a4 * c234 + 2.0 * d6 * c234 * s5 + d6 * s2345;
    a * lever / links.rigidity[3]
}

/// dy2, corrected, is each link's own deflection, vertically.
#[test]
fn the_links_own_deflections() {
    for (links, q) in cases() {
        let all = deflections(&elbow(&links), &q, &weight(2, links.load)).unwrap();
        let terms = links.link_terms(&q);
        for ((link, term), row) in all.links.iter().zip(terms).zip(ROWS) {
            assert_eq!(link.row, row);
            near(link.twist.z, term, 1e-12 * link.twist.norm());
        }
        near(all.timoshenko.z, links.timoshenko(&q), 1e-12 * all.timoshenko.norm());
    }
}

/// Of the printed dy2 links 2 and 6 agree; two signs of link 4 and an index of link 3 do not.
#[test]
fn the_printed_links() {
    let mut apart = [0.0_f64; 4];
    for (links, q) in cases() {
        let ([_, a3, a4, d6], [_, _, _, w6]) = (links.lengths, links.weights);
        let (printed, right) = (printed_dy2(&links, &q), links.link_terms(&q));
        for k in 0..4 {
            let scale: f64 = links.lengths.iter().sum::<f64>().powi(3) / links.rigidity[k];
            apart[k] = apart[k].max((printed[k] - right[k]).abs() / scale);
        }
        // The difference is exactly that of the corrections.
        let (c3, c23) = (q[2].cos(), (q[1] + q[2]).cos());
        let (c234, s5) = ((q[1] + q[2] + q[3]).cos(), q[4].sin());
        let index = -w6 * a3.powi(2) * a4 * d6 * c234 * (c23 - c3) / 2.0 / links.rigidity[1];
        near(right[1] - printed[1], index, 1e-11 * right[1].abs() + 1e-13);
        let signs = links.load * a4.powi(2) * d6 + w6 * a4.powi(2) * d6.powi(2) / 2.0;
        let signs = -signs * c234.powi(2) * s5 / links.rigidity[2];
        near(right[2] - printed[2], signs, 1e-11 * right[2].abs() + 1e-13);
    }
    assert!(apart[0] < 1e-14 && apart[3] < 1e-14, "{apart:?}");
    assert!(apart[1] > 1e-3 && apart[2] > 1e-3, "{apart:?}");
}

/// dy1, corrected, is the general YD, vertically, and link by link.
#[test]
fn the_angular_deflections() {
    for (links, q) in cases() {
        let arm = elbow(&links);
        let all = deflections(&arm, &q, &weight(2, links.load)).unwrap();
        near(all.angular.z, links.angular(&q), 1e-12 * all.angular.norm());
        for (k, term) in links.angular_terms(&q).into_iter().enumerate() {
            let mut alone = arm.clone();
            for row in &mut alone.joints {
                if let Some(beam) = &mut row.beam {
                    (beam.iy, beam.iz, beam.j) = (1e20, 1e20, 1e20);
                }
            }
            alone.joints[ROWS[k] - 1].beam = arm.joints[ROWS[k] - 1].beam.clone();
            let yd = deflections(&alone, &q, &weight(2, links.load)).unwrap().angular;
            near(yd.z, term, 1e-11 * yd.norm());
        }
    }
}

/// dθ of link 6 by eqs. 33-36: `−K C234 S5/E6I6` at joints 2, 3 and 4, `−K S234 C5/E6I6` at joint
/// 5, nothing at joints 1 and 6.
#[test]
fn the_angles_by_link_6() {
    let mut apart: f64 = 0.0;
    for (mut links, q) in cases() {
        links.rigidity[..3].fill(1e30);
        let all = deflections(&elbow(&links), &q, &weight(2, links.load)).unwrap();
        let (d6, w6) = (links.lengths[3], links.weights[3]);
        let k = (3.0 * links.load * d6.powi(2) + w6 * d6.powi(3)) / 6.0 / links.rigidity[3];
        let ((s234, c234), (s5, c5)) = ((q[1] + q[2] + q[3]).sin_cos(), q[4].sin_cos());
        let upper = -k * c234 * s5;
        let expected = [0.0, upper, upper, upper, -k * s234 * c5, 0.0];
        for (found, expected) in all.joint_angles.iter().zip(expected) {
            near(*found, expected, 1e-12 * k);
        }
        let right = links.angular_terms(&q)[3];
        apart = apart.max((printed_dy1_link_6(&links, &q) - right).abs() / right.abs());
    }
    assert!(apart > 1.0, "{apart}");
}
