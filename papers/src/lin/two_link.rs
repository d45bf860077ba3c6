//! The planar two-link arm of Lin, Chiang & Cui in closed form: eqs. 15-17, 27-29, 32, 35, 36, 46.

/// Two links in the vertical x-y plane, gravity and load along −y. Any one system of units; angles
/// in rad, link 1 against the horizontal, link 2 against link 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoLink {
    /// L1, L2.
    pub lengths: [f64; 2],
    /// E1 I1, E2 I2.
    pub rigidity: [f64; 2],
    /// W1, W2: the links' weights per unit length.
    pub weights: [f64; 2],
    /// P: the weight at the end-effector.
    pub load: f64,
}

impl TwoLink {
    /// Horizontal extents of the links: L1 C1, L2 C12.
    fn extents(&self, q: [f64; 2]) -> [f64; 2] {
        [self.lengths[0] * q[0].cos(), self.lengths[1] * (q[0] + q[1]).cos()]
    }

    /// `⁰d_1y`, eq. 28 with `C1²` for the printed `C1³`: link 1's own deflection, vertically.
    pub fn link_1(&self, q: [f64; 2]) -> f64 {
        let ([r1, r2], [l1, l2], [w1, w2]) = (self.extents(q), self.lengths, self.weights);
        let p = self.load;
        -(8.0 * p * l1 * r1 * r1
            + 12.0 * p * l1 * r1 * r2
            + 8.0 * w2 * l1 * l2 * r1 * r1
            + 6.0 * w2 * l1 * l2 * r1 * r2
            + 3.0 * w1 * l1 * l1 * r1 * r1)
            / (24.0 * self.rigidity[0])
    }

    /// `⁰d_2y`, eq. 27: link 2's own deflection, vertically.
    pub fn link_2(&self, q: [f64; 2]) -> f64 {
        let ([_, r2], [_, l2], [_, w2]) = (self.extents(q), self.lengths, self.weights);
        -l2 * r2 * r2 * (8.0 * self.load + 3.0 * w2 * l2) / (24.0 * self.rigidity[1])
    }

    /// YT, eq. 29: the vertical deflection by Timoshenko's beams, negative downwards.
    pub fn timoshenko(&self, q: [f64; 2]) -> f64 {
        self.link_1(q) + self.link_2(q)
    }

    /// YC, eq. 32: the vertical deflection by Castigliano's second theorem, negative downwards.
    pub fn castigliano(&self, q: [f64; 2]) -> f64 {
        let ([r1, r2], [l1, l2], [w1, w2]) = (self.extents(q), self.lengths, self.weights);
        let first = self.load * l1 * (8.0 * r1 * r1 + 24.0 * r1 * r2 + 24.0 * r2 * r2)
            + w2 * l1 * l2 * (8.0 * r1 * r1 + 18.0 * r1 * r2 + 12.0 * r2 * r2)
            + w1 * l1 * l1 * (3.0 * r1 * r1 + 4.0 * r1 * r2);
        self.link_2(q) - first / (24.0 * self.rigidity[0])
    }

    /// A and B of eq. 35: the integrals of the bending moments along the links. `A/E1I1` and
    /// `B/E2I2` are how much each link's tip turns.
    pub fn moments(&self, q: [f64; 2]) -> [f64; 2] {
        let ([r1, r2], [l1, l2], [w1, w2]) = (self.extents(q), self.lengths, self.weights);
        let p = self.load;
        [
            p * l1 * (r2 + r1 / 2.0) + w1 * l1 * l1 * r1 / 6.0 + w2 * l1 * l2 * (r1 + r2) / 2.0,
            p * r2 * l2 / 2.0 + w2 * l2 * l2 * r2 / 6.0,
        ]
    }

    /// dθ1 and dθ2 of eqs. 35 and 36, rad. In the clamped chain of eq. 32 dθ1 is how much the
    /// chain's tip turns, and dθ2 how much link 2 turns.
    pub fn joint_angles(&self, q: [f64; 2]) -> [f64; 2] {
        let [a, b] = self.moments(q);
        let [first, second] = [a / self.rigidity[0], b / self.rigidity[1]];
        [-first - second, -second]
    }

    /// YD, eq. 46: the vertical deflection by the joints' angles, negative downwards.
    pub fn angular(&self, q: [f64; 2]) -> f64 {
        let ([r1, r2], [first, second]) = (self.extents(q), self.joint_angles(q));
        r1 * first + r2 * (first + second)
    }

    /// `YC − YT = −A L2 C12/E1I1`: the turn of link 1's tip on the lever of link 2. It is contained
    /// in YD too, so that YT + YD already has it and YC + YD has it twice.
    pub fn carried(&self, q: [f64; 2]) -> f64 {
        -self.moments(q)[0] * self.extents(q)[1] / self.rigidity[0]
    }

    /// `YT + YD − YC = −[A L1 C1/E1I1 + B (L1 C1 + 2 L2 C12)/E2I2]`: what the paper's total has
    /// beyond the clamped elastic chain.
    pub fn counted_again(&self, q: [f64; 2]) -> f64 {
        let ([r1, r2], [a, b]) = (self.extents(q), self.moments(q));
        -a * r1 / self.rigidity[0] - b * (r1 + 2.0 * r2) / self.rigidity[1]
    }

    /// `⁰m_z` of eq. 17: the moment about joint 1.
    pub fn base_moment(&self, q: [f64; 2]) -> f64 {
        let ([r1, r2], [l1, l2], [w1, w2]) = (self.extents(q), self.lengths, self.weights);
        -self.load * (r1 + r2) - 0.5 * w1 * l1 * r1 - w2 * l2 * (r1 + 0.5 * r2)
    }
}
