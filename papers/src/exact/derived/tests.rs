use super::*;
use crate::exact::evaluate::Arithmetic;
use crate::exact::rational::Exact;
use crate::latex::parser::parse;

const ARM: &str = "name = \"x\"\nconvention = \"standard\"\n\
    [[joint]]\ntype = \"revolute\"\na = \"L1\"\nstiffness = \"k1\"\n\
    [[joint]]\ntype = \"revolute\"\na = \"L2\"\nstiffness = \"k2\"\n";

fn of(path: &str) -> Result<Matrix, String> {
    let robots = BTreeMap::from([("arm".to_owned(), Robot::from_toml(ARM, "x").unwrap().0)]);
    let setting = Setting {
        robot: Some("arm".into()),
        product: vec!["Rz(\\theta_1)".into(), "Tx(L_1)".into()],
        ..Setting::default()
    };
    derived(path, &setting, Shared { robots: &robots, notation: &Notation::default() })
}

fn exact(text: &str) -> Rational {
    let tree = parse(text, &Notation::default()).unwrap();
    Exact(&HashMap::new()).tree(&tree).unwrap()
}

#[test]
fn paths_name_entries() {
    let entry = |path: &str| of(path).unwrap().entries.remove(0);
    assert_eq!(entry("jacobian[1][2]"), exact("-L_2\\sin(\\theta_1+\\theta_2)"));
    assert_eq!(
        entry("arm: compliance[1][1] of joint 2"),
        exact("\\frac{L_2^2\\sin(\\theta_1+\\theta_2)^2}{k_2}")
    );
    assert_eq!(entry("product[2][4]"), exact("L_1\\sin\\theta_1"));
    assert_eq!(of("pose").unwrap().rows(), 3);
}

#[test]
fn what_cannot_be_derived_says_why() {
    let why = |path: &str| of(path).unwrap_err();
    assert!(why("jacobain[1][1]").contains("is none of"));
    assert!(why("jacobian[7][1]").contains("outside of 6×2"));
    assert!(why("jacobian[0][1]").contains("counted from 1"));
    assert!(why("other: pose").contains("no robot `other`"));
    assert!(why("product[1").contains("never closed"));
}
