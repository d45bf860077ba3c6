//! The elbow manipulator's vertical deflection in closed form: the appendix of Lin, Chiang & Cui,
//! corrected.

/// The elbow manipulator's links and load (Table IV). Gravity is −z of the base; any one system of
/// units.
///
/// Corrected here, against the printed appendix:
///
/// * dy1, link 6: the printed `+A(…)` with `A = C234 C5 K` must read
///   `−K [C234 S5 l4 + d6 S234² C5²]`, where `K = (3 P d6² + W6 d6³)/6` and
///   `l4 = a2 C2 + 2 a3 C23 + 3 a4 C234 + 3 d6 C234 S5`.
/// * B: `W6 a4³` must read `W4 a4³`.
/// * C: `[P + (W6 d6/2) d6 a3 C a_234 S5` must read `[P + (W6 d6/2)] d6 a3 C234 S5`.
/// * dy2, link 4: `− P a4² d6 C234² S5/2` and `− W6 a4² d6² C234² S5/4` must have a plus.
/// * dy2, link 3: `W6 a3² a4 d6 C234 C3/2` must have `C23` for `C3`.
/// * `W_i` is the weight per unit length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElbowLinks {
    /// a2, a3, a4, d6: the lengths of links 2, 3, 4 and 6.
    pub lengths: [f64; 4],
    /// E I of links 2, 3, 4 and 6.
    pub rigidity: [f64; 4],
    /// Weights per unit length of links 2, 3, 4 and 6.
    pub weights: [f64; 4],
    /// P: the weight at the end-effector.
    pub load: f64,
}

/// What the joint values enter as.
struct Angles {
    c2: f64,
    c23: f64,
    c234: f64,
    s234: f64,
    c5: f64,
    s5: f64,
}

impl Angles {
    fn of(q: &[f64; 6]) -> Self {
        let (s234, c234) = (q[1] + q[2] + q[3]).sin_cos();
        let (s5, c5) = q[4].sin_cos();
        Self { c2: q[1].cos(), c23: (q[1] + q[2]).cos(), c234, s234, c5, s5 }
    }
}

impl ElbowLinks {
    /// dy1 by link 2, 3, 4 and 6, along z of the base: what the turn of each link's tip does
    /// through the joints before it (eqs. 33-36 and 42-46).
    pub fn angular_terms(&self, q: &[f64; 6]) -> [f64; 4] {
        let ([a2, a3, a4, d6], [w2, w3, w4, w6]) = (self.lengths, self.weights);
        let (p, Angles { c2, c23, c234, s234, c5, s5 }) = (self.load, Angles::of(q));
        let reach = d6 * c234 * s5;
        // Levers of equal turns of joints 2, of 2 and 3, and of 2, 3 and 4.
        let l2 = a2 * c2 + a3 * c23 + a4 * c234 + reach;
        let l3 = l2 + a3 * c23 + a4 * c234 + reach;
        let l4 = l3 + a4 * c234 + reach;
        let k = (3.0 * p * d6.powi(2) + w6 * d6.powi(3)) / 6.0;
        let b = (p + w6 * d6 / 2.0) * a4 * reach
            + (p + w6 * d6) * a4.powi(2) * c234 / 2.0
            + w4 * a4.powi(3) * c234 / 6.0;
        let c = (p + w6 * d6 / 2.0) * a3 * reach
            + (p + w4 * a4 / 2.0 + w6 * d6) * a3 * a4 * c234
            + (p + w4 * a4 + w6 * d6) * a3.powi(2) * c23 / 2.0
            + w3 * a3.powi(3) * c23 / 6.0;
        let d = (p + w6 * d6 / 2.0) * a2 * reach
            + (p + w6 * d6 + w4 * a4 / 2.0) * a2 * a4 * c234
            + (p + w6 * d6 + w4 * a4 + w3 * a3 / 2.0) * a2 * a3 * c23
            + (p + w6 * d6 + w4 * a4 + w3 * a3) * a2.powi(2) * c2 / 2.0
            + w2 * a2.powi(3) * c2 / 6.0;
        let link_6 = k * (c234 * s5 * l4 + d6 * s234.powi(2) * c5.powi(2));
        self.bent([d * l2, c * l3, b * l4, link_6])
    }

    /// dy2 by link 2, 3, 4 and 6, along z of the base: each link's own deflection (eqs. 18-29).
    pub fn link_terms(&self, q: &[f64; 6]) -> [f64; 4] {
        let ([a2, a3, a4, d6], [w2, w3, w4, w6]) = (self.lengths, self.weights);
        let (p, Angles { c2, c23, c234, s234, s5, .. }) = (self.load, Angles::of(q));
        // The force and the moment (about the horizontal axis) on each link's tip, tip to base.
        let (force_6, moment_6) = (p, 0.0);
        let (force_4, moment_4) = (p + w6 * d6, (p + w6 * d6 / 2.0) * d6 * c234 * s5);
        let (force_3, moment_3) =
            (force_4 + w4 * a4, moment_4 + (force_4 + w4 * a4 / 2.0) * a4 * c234);
        let (force_2, moment_2) =
            (force_3 + w3 * a3, moment_3 + (force_3 + w3 * a3 / 2.0) * a3 * c23);
        let own = |l: f64, c: f64, force: f64, moment: f64, w: f64| {
            (force * c * l.powi(3) / 3.0 + moment * l.powi(2) / 2.0 + w * c * l.powi(4) / 8.0) * c
        };
        let flat = (1.0 - s234.powi(2) * s5.powi(2)).sqrt();
        self.bent([
            own(a2, c2, force_2, moment_2, w2),
            own(a3, c23, force_3, moment_3, w3),
            own(a4, c234, force_4, moment_4, w4),
            own(d6, flat, force_6, moment_6, w6),
        ])
    }

    fn bent(&self, terms: [f64; 4]) -> [f64; 4] {
        std::array::from_fn(|k| -terms[k] / self.rigidity[k])
    }

    /// dy1, the paper's YD for this arm, negative downwards.
    pub fn angular(&self, q: &[f64; 6]) -> f64 {
        self.angular_terms(q).iter().sum()
    }

    /// dy2, the paper's YT for this arm, negative downwards.
    pub fn timoshenko(&self, q: &[f64; 6]) -> f64 {
        self.link_terms(q).iter().sum()
    }

    /// dy = dy1 + dy2, the paper's total, negative downwards. It counts the slopes of the links
    /// more than once: at the poses of Table V it is about twice the exact deflection.
    pub fn total(&self, q: &[f64; 6]) -> f64 {
        self.angular(q) + self.timoshenko(q)
    }
}
