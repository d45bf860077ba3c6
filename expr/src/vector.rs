//! Three-component vectors of expressions.

use super::graph::{Expr, Graph};

/// Components along the axes of one frame.
pub type Vec3 = [Expr; 3];

/// A twist per unit of something: translation, rotation.
pub type Twist = (Vec3, Vec3);

impl Graph {
    /// `a + b`.
    pub fn add3(&mut self, a: Vec3, b: Vec3) -> Vec3 {
        core::array::from_fn(|k| self.add(a[k], b[k]))
    }

    /// `factor · v`.
    pub fn scale3(&mut self, factor: Expr, v: Vec3) -> Vec3 {
        v.map(|c| self.mul(factor, c))
    }

    /// `a·x + b·y`.
    pub fn combine3(&mut self, a: Expr, x: Vec3, b: Expr, y: Vec3) -> Vec3 {
        let (ax, by) = (self.scale3(a, x), self.scale3(b, y));
        self.add3(ax, by)
    }

    /// `a · b`.
    pub fn dot3(&mut self, a: Vec3, b: Vec3) -> Expr {
        self.products([(a[0], b[0]), (a[1], b[1]), (a[2], b[2])])
    }

    /// The sum of the products of these pairs.
    pub fn products(&mut self, pairs: impl IntoIterator<Item = (Expr, Expr)>) -> Expr {
        pairs.into_iter().fold(Expr::ZERO, |sum, (a, b)| {
            let product = self.mul(a, b);
            self.add(sum, product)
        })
    }

    /// The sum of some vectors.
    pub fn sum3(&mut self, parts: impl IntoIterator<Item = Vec3>) -> Vec3 {
        parts.into_iter().fold([Expr::ZERO; 3], |sum, part| self.add3(sum, part))
    }

    /// The vector of these components along some axes.
    pub fn along3(&mut self, components: Vec3, axes: [Vec3; 3]) -> Vec3 {
        let parts: [Vec3; 3] = core::array::from_fn(|k| self.scale3(components[k], axes[k]));
        self.sum3(parts)
    }

    /// `a × b`.
    pub fn cross3(&mut self, a: Vec3, b: Vec3) -> Vec3 {
        core::array::from_fn(|k| {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            let (first, second) = (self.mul(a[i], b[j]), self.mul(a[j], b[i]));
            self.sub(first, second)
        })
    }

    /// `R(θ) v` in the plane of the turn, of the sine and the cosine of θ.
    pub fn turn2(&mut self, (sine, cosine): (Expr, Expr), [x, y]: [Expr; 2]) -> [Expr; 2] {
        let products = [(cosine, x), (sine, y), (sine, x), (cosine, y)];
        let [cx, sy, sx, cy] = products.map(|(a, b)| self.mul(a, b));
        [self.sub(cx, sy), self.add(sx, cy)]
    }

    /// Names the three components of a vector `prefix` + x, y, z.
    pub fn name3(&mut self, v: Vec3, prefix: &str) {
        for (component, axis) in v.into_iter().zip(["x", "y", "z"]) {
            self.name(component, || format!("{prefix}{axis}"));
        }
    }
}

/// `-v`.
pub fn negate3(v: Vec3) -> Vec3 {
    v.map(|c| -c)
}

/// Whether two axes are the same line, known by their expressions being equal up to one sign.
pub fn parallel3(a: Vec3, b: Vec3) -> bool {
    a == b || a == negate3(b)
}

#[cfg(test)]
mod tests {
    use super::super::graph::Symbol;
    use super::*;

    #[test]
    fn the_cross_product_is_anticommutative_and_sparse() {
        let mut g = Graph::new();
        let v: Vec3 = core::array::from_fn(|k| g.symbol(Symbol::Wrench(k)));
        let z = [Expr::ZERO, Expr::ZERO, Expr::ONE];
        assert_eq!(g.cross3(z, v), [-v[1], v[0], Expr::ZERO]);
        assert_eq!(negate3(g.cross3(v, z)), g.cross3(z, v));
        assert_eq!(g.cross3(v, v), [Expr::ZERO; 3]);
        assert_eq!(g.dot3(z, v), v[2]);
        assert!(parallel3(v, negate3(v)) && !parallel3(v, z));
    }
}
