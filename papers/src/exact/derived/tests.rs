use super::*;
use crate::exact::evaluate::Arithmetic;
use crate::exact::rational::Exact;
use crate::latex::parser::parse;

const ARM: &str = "name = \"x\"\nconvention = \"standard\"\n\
    [[joint]]\ntype = \"revolute\"\na = \"L1\"\nstiffness = \"k1\"\n\
    [[joint]]\ntype = \"revolute\"\na = \"L2\"\nstiffness = \"k2\"\n";

fn setting() -> Setting {
    let robot = Robot::from_toml(ARM, "x").unwrap().0;
    Setting {
        robots: BTreeMap::from([("arm".to_owned(), robot)]),
        robot: Some("arm".into()),
        product: vec!["Rz(\\theta_1)".into(), "Tx(L_1)".into()],
        ..Setting::default()
    }
}

fn exact(text: &str) -> Rational {
    let tree = parse(text, &Notation::default()).unwrap();
    Exact(&HashMap::new()).tree(&tree).unwrap()
}

#[test]
fn paths_name_entries() {
    let of = |path: &str| derived(path, &setting()).unwrap().entries.remove(0);
    assert_eq!(of("jacobian[1][2]"), exact("-L_2\\sin(\\theta_1+\\theta_2)"));
    assert_eq!(
        of("arm: compliance[1][1] of joint 2"),
        exact("\\frac{L_2^2\\sin(\\theta_1+\\theta_2)^2}{k_2}")
    );
    assert_eq!(of("product[2][4]"), exact("L_1\\sin\\theta_1"));
    assert_eq!(derived("pose", &setting()).unwrap().rows(), 3);
}

#[test]
fn what_cannot_be_derived_says_why() {
    let why = |path: &str| derived(path, &setting()).unwrap_err();
    assert!(why("jacobain[1][1]").contains("is none of"));
    assert!(why("jacobian[7][1]").contains("outside of 6×2"));
    assert!(why("jacobian[0][1]").contains("counted from 1"));
    assert!(why("other: pose").contains("no robot `other`"));
    assert!(why("product[1").contains("never closed"));
}
