use super::*;

fn angle(names: &[&str]) -> Angle {
    let mut angle = Angle::default();
    names.iter().for_each(|name| angle.add(name, 1));
    angle
}

#[test]
fn sums_of_angles_expand_and_squares_vanish() {
    let s = Polynomial::trig(Function::Sin, &angle(&["a", "b", "c"])).unwrap();
    let c = Polynomial::trig(Function::Cos, &angle(&["a", "b", "c"])).unwrap();
    let one = s.times(&s).unwrap().plus(&c.times(&c).unwrap(), Ratio::one()).unwrap();
    assert_eq!(one, Polynomial::one());
    let double = Polynomial::trig(Function::Sin, &angle(&["a", "a"])).unwrap();
    let (s, c) = (angle(&["a"]), angle(&["a"]));
    let s = Polynomial::trig(Function::Sin, &s).unwrap();
    let c = Polynomial::trig(Function::Cos, &c).unwrap();
    assert_eq!(double, s.times(&c).unwrap().times(&Polynomial::number(2.into())).unwrap());
}

#[test]
fn symbols_may_have_negative_powers() {
    let x = Polynomial::symbol("x");
    let inverse = x.reciprocal().unwrap();
    assert_eq!(x.times(&inverse).unwrap(), Polynomial::one());
    assert_eq!(x.times(&x).unwrap().root(), Some(x.clone()));
    assert_eq!(inverse.clone().limit(&["x".into()]), Some(Polynomial::default()));
    assert_eq!(x.clone().limit(&["x".into()]), None);
    let s = Polynomial::variable(Variable::Sin("a".into()));
    assert_eq!(s.reciprocal(), None);
    assert_eq!(x.plus(&inverse, Ratio::one()).unwrap().reciprocal(), None);
}

#[test]
fn integrals_undo_derivatives() {
    let x = Polynomial::symbol("x");
    let cube = x.power(3).unwrap();
    assert_eq!(cube.derivative("x").integral("x"), Some(cube.clone()));
    assert_eq!(x.reciprocal().unwrap().integral("x"), None);
    assert_eq!(cube.by_power("x")[&3], Polynomial::one());
}

#[test]
fn overflow_is_told() {
    let big = Polynomial::number(Ratio::from(i128::MAX));
    assert_eq!(big.times(&big), Err(TooLong));
}
