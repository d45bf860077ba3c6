//! Cross-sections from their shapes: area, second moments and torsion constant.

use core::f64::consts::PI;

use super::decimal::recip;
use super::model::{Section, Value};
use crate::number::Number;

impl Section {
    /// A round tube, or a bar where `inner_diameter` is zero; diameters in metres.
    ///
    /// A = π/4 (D² − d²), I = π/64 (D⁴ − d⁴), J = 2 I, all exact for a circle.
    ///
    /// `None` unless 0 ≤ inner < outer and the constants are finite and above zero.
    pub fn tube(outer_diameter: Number, inner_diameter: Number) -> Option<Section> {
        if inner_diameter.is_negative() {
            return None;
        }
        let (outer, inner) = (power(outer_diameter, 2), power(inner_diameter, 2));
        let pi = Number::Rounded(PI);
        let area = pi * Number::ratio(1, 4) * (outer + -inner);
        let bending = pi * Number::ratio(1, 64) * (power(outer, 2) + -power(inner, 2));
        constants(area, bending, bending, bending + bending)
    }

    /// A rectangular box of `[b, h]`, b along the beam's y and h along its z, in metres; solid
    /// where `inner` is `None`.
    ///
    /// A = b h − bᵢ hᵢ, I_y = (b h³ − bᵢ hᵢ³)/12, I_z = (h b³ − hᵢ bᵢ³)/12. The torsion constant of
    /// a hollow box is Bredt's, for thin walls: 4 A_m² / ∮ ds/t on the walls' mid-line. That of a
    /// solid one is Saint-Venant's series.
    ///
    /// `None` unless each inner side lies between zero and its outer side, and the constants are
    /// finite and above zero.
    pub fn rectangle(outer: [Number; 2], inner: Option<[Number; 2]>) -> Option<Section> {
        let [b, h] = outer;
        let [bi, hi] = inner.unwrap_or([Number::ZERO; 2]);
        let bad = |n: Number| n.is_negative() || n.is_zero();
        if bad(b) || bad(h) || inner.is_some() && (bad(bi) || bad(hi)) {
            return None;
        }
        let twelfth = Number::ratio(1, 12);
        let area = b * h + -(bi * hi);
        let iy = twelfth * (b * power(h, 3) + -(bi * power(hi, 3)));
        let iz = twelfth * (h * power(b, 3) + -(hi * power(bi, 3)));
        let torsion = match inner {
            Some(_) => bredt(outer, [bi, hi])?,
            None => saint_venant(b.to_f64(), h.to_f64())?,
        };
        constants(area, iy, iz, torsion)
    }
}

/// J = 4 A_m² / ∮ ds/t = 2 b_m² h_m² / (b_m/t_b + h_m/t_h), where the walls along b have thickness
/// t_b = (h − hᵢ)/2 and those along h have t_h = (b − bᵢ)/2.
fn bredt([b, h]: [Number; 2], [bi, hi]: [Number; 2]) -> Option<Number> {
    let half = Number::ratio(1, 2);
    let (wall_b, wall_h) = (half * (h + -hi), half * (b + -bi));
    if wall_b.is_negative() || wall_h.is_negative() {
        return None;
    }
    let (mid_b, mid_h) = (half * (b + bi), half * (h + hi));
    let circulation = mid_b * recip(wall_b)? + mid_h * recip(wall_h)?;
    Some(Number::integer(2) * power(mid_b * mid_h, 2) * recip(circulation)?)
}

/// J = a c³ (1/3 − 64/π⁵ · c/a · Σ tanh(kπa/2c)/k⁵), k odd, a the long side and c the short one.
fn saint_venant(b: f64, h: f64) -> Option<Number> {
    let (long, short) = (b.max(h), b.min(h));
    let ratio = short / long;
    let series: f64 = (0..40)
        .map(|i| f64::from(2 * i + 1))
        .map(|k| libm::tanh(k * PI / (2.0 * ratio)) / libm::pow(k, 5.0))
        .sum();
    let j = long * libm::pow(short, 3.0) * (1.0 / 3.0 - 64.0 / libm::pow(PI, 5.0) * ratio * series);
    j.is_finite().then_some(Number::Rounded(j))
}

fn power(x: Number, exponent: u32) -> Number {
    (0..exponent).fold(Number::ONE, |product, _| product * x)
}

fn constants(area: Number, iy: Number, iz: Number, j: Number) -> Option<Section> {
    let usable = |n: Number| n.to_f64().is_finite() && n.to_f64() > 0.0;
    [area, iy, iz, j].into_iter().all(usable).then_some(Section {
        area: Value::Number(area),
        iy: Value::Number(iy),
        iz: Value::Number(iz),
        j: Value::Number(j),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn n(text: &str) -> Number {
        Number::from_decimal(text).unwrap()
    }

    fn numbers(section: &Section) -> [f64; 4] {
        [&section.area, &section.iy, &section.iz, &section.j].map(|v| v.number().unwrap().to_f64())
    }

    fn close(found: [f64; 4], expected: [f64; 4]) {
        for (f, e) in found.iter().zip(expected) {
            assert!((f - e).abs() <= 1e-12 * e, "{found:?} is not {expected:?}");
        }
    }

    #[test]
    fn a_tube_is_exact() {
        let [o, i] = [0.2_f64, 0.18];
        let bending = PI / 64.0 * (o.powi(4) - i.powi(4));
        let tube = Section::tube(n("0.2"), n("0.18")).unwrap();
        let area = PI / 4.0 * (o * o - i * i);
        close(numbers(&tube), [area, bending, bending, 2.0 * bending]);
    }

    #[test]
    fn a_hollow_box_bends_exactly_and_twists_as_bredt_says() {
        let section =
            Section::rectangle([n("0.2"), n("0.1")], Some([n("0.19"), n("0.092")])).unwrap();
        let (mid_b, mid_h) = (0.195_f64, 0.096_f64);
        let j = 4.0 * (mid_b * mid_h).powi(2) / (2.0 * mid_b / 0.004 + 2.0 * mid_h / 0.005);
        close(
            numbers(&section),
            [
                0.2 * 0.1 - 0.19 * 0.092,
                (0.2 * 0.1_f64.powi(3) - 0.19 * 0.092_f64.powi(3)) / 12.0,
                (0.1 * 0.2_f64.powi(3) - 0.092 * 0.19_f64.powi(3)) / 12.0,
                j,
            ],
        );
    }

    #[test]
    fn solid_bars_twist_as_tabulated() {
        // Timoshenko and Goodier, k1 of bars 1:1, 1:2, 1:10 to their four or three digits.
        for (side, k1, digits) in [("1", 0.1406, 5e-5), ("2", 0.2287, 1e-4), ("10", 0.3123, 5e-4)] {
            let wide = Section::rectangle([n(side), Number::ONE], None).unwrap();
            let tall = Section::rectangle([Number::ONE, n(side)], None).unwrap();
            let j = numbers(&wide)[3];
            assert!((j / n(side).to_f64() - k1).abs() < digits, "1:{side} {j}");
            assert_eq!(numbers(&tall)[3], j);
        }
    }

    #[test]
    fn impossible_shapes_are_none() {
        assert_eq!(Section::tube(n("0.1"), n("0.1")), None);
        assert_eq!(Section::tube(n("0.1"), n("0.2")), None);
        assert_eq!(Section::tube(n("0.1"), -n("0.05")), None);
        assert_eq!(Section::tube(Number::ZERO, Number::ZERO), None);
        assert_eq!(Section::tube(n("1e200"), Number::ZERO), None);
        let outer = [n("0.2"), n("0.1")];
        assert_eq!(Section::rectangle(outer, Some([n("0.1"), n("0.1")])), None);
        assert_eq!(Section::rectangle(outer, Some([n("0.3"), n("0.05")])), None);
        assert_eq!(Section::rectangle(outer, Some([n("0.1"), Number::ZERO])), None);
        let tiny = [n("1e-310"); 2];
        assert_eq!(Section::rectangle(tiny, Some([n("5e-311"); 2])), None);
        assert_eq!(Section::rectangle([n("0.2"), Number::ZERO], None), None);
        assert_eq!(Section::rectangle([n("0.2"), -n("0.1")], None), None);
    }
}
