//! How the difference between the flexible kinematics and its approximations grows with
//! flexibility: Jweeg & Al-Khafaji's conclusion ("with increasing the flexibility of links this
//! difference will be increase") as numbers.

use nalgebra::Vector2;

use super::small::{lag, versine};

/// How one link's tip is displaced in the frame of its undeformed tip (eq. 27).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bend {
    /// δx, along the link, m.
    pub dx: f64,
    /// δy, across it, m.
    pub dy: f64,
    /// dφ, rad.
    pub phi: f64,
}

/// Lengths of the two links.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoLink {
    /// a1, m.
    pub a1: f64,
    /// a2, m.
    pub a2: f64,
}

impl TwoLink {
    /// The approximate minus the flexible equation, m, without cancellation at any size:
    ///
    /// ```text
    /// Δpx = X (1 − cos f) − Y (f − sin f)      X = c12 (a2 + δx2) − s12 δy2
    /// Δpy = Y (1 − cos f) + X (f − sin f)      Y = s12 (a2 + δx2) + c12 δy2,  f = dφ1
    /// ```
    ///
    /// Neither δx1, δy1 nor dφ2 enters. It grows with the square of dφ1.
    pub fn difference(&self, theta: [f64; 2], bends: [Bend; 2]) -> Vector2<f64> {
        let (s12, c12) = (theta[0] + theta[1]).sin_cos();
        let (x, y) = (self.a2 + bends[1].dx, bends[1].dy);
        let arm = Vector2::new(c12 * x - s12 * y, s12 * x + c12 * y);
        let (square, cube) = (versine(bends[0].phi), lag(bends[0].phi));
        Vector2::new(arm.x * square - arm.y * cube, arm.y * square + arm.x * cube)
    }
}

/// One row of the two-link arm's table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoLinkGrowth {
    /// dφ1, rad.
    pub phi: f64,
    /// `|approximate − flexible|`, m: `ρ √((1 − cos f)² + (f − sin f)²)`.
    pub difference: f64,
    /// Its leading term `ρ dφ1²/2`, m.
    pub leading: f64,
}

/// The size of [`TwoLink::difference`] for each turn dφ1 in
/// `turns` (rad). `reach` is ρ = |(a2 + δx2, δy2)|, m; the posture does not matter.
pub fn two_link(reach: f64, turns: &[f64]) -> Vec<TwoLinkGrowth> {
    let row = |&phi: &f64| TwoLinkGrowth {
        phi,
        difference: reach * versine(phi).hypot(lag(phi)),
        leading: reach * phi * phi / 2.0,
    };
    turns.iter().map(row).collect()
}

/// A largest difference and where it stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Largest {
    /// m.
    pub size: f64,
    /// The joint angles, degrees, as the paper counts them.
    pub degrees: [f64; 2],
}

/// The largest differences in px and in py on the paper's grid of postures (θ1 from 4° by 5° to
/// 29°, θ2 from −35° by 5° to 60°), where a weight at the arm's tip turns the tip of the first
/// link, a cantilever, by `dφ1 = w (a1² cos θ1/2 + a1 a2 cos θ12)`. `w` is the weight over the
/// link's E I, 1/m²; `offset`, degrees, is added to θ1.
pub fn largest(two: TwoLink, w: f64, offset: f64) -> [Largest; 2] {
    let mut found = [Largest { size: 0.0, degrees: [0.0; 2] }; 2];
    for i in 0..6 {
        for j in 0..20 {
            let degrees = [4.0 + 5.0 * f64::from(i), -35.0 + 5.0 * f64::from(j)];
            let t = [(degrees[0] + offset).to_radians(), degrees[1].to_radians()];
            let bending = two.a1 * t[0].cos() / 2.0 + two.a2 * (t[0] + t[1]).cos();
            let bend = Bend { phi: w * two.a1 * bending, ..Bend::default() };
            let difference = two.difference(t, [bend, Bend::default()]);
            for (best, size) in found.iter_mut().zip(difference.iter()) {
                if size.abs() > best.size {
                    *best = Largest { size: size.abs(), degrees };
                }
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    /// a2 = 0.4 m: the difference to the digits that a table would print, and how long its leading
    /// term holds.
    #[test]
    fn the_table_of_the_two_link_arm() {
        let expected = [
            (1e-4, 2.0e-9),
            (1e-3, 2.0e-7),
            (1e-2, 2.0e-5),
            (0.03, 1.8e-4),
            (0.1, 2.0e-3),
            (0.2, 8.0e-3),
            (0.3, 1.80e-2),
        ];
        let turns: Vec<f64> = expected.iter().map(|row| row.0).collect();
        for (row, (phi, size)) in two_link(0.4, &turns).iter().zip(expected) {
            assert_eq!(row.phi, phi);
            assert!((row.difference / size - 1.0).abs() < 5e-3, "{row:?}");
            let least = if phi > 0.1 { 0.9975 } else { 0.9997 };
            let part = row.leading / row.difference;
            assert!((least - 5e-5..1.003).contains(&part), "{row:?} {part}");
        }
    }
}
