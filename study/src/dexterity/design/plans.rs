//! Plans that the tests of this crate and of `tests/study` share.

use nalgebra::Vector6;
use stiffarm_kernels::generic::Arm;

use crate::dexterity::DexterityError;
use crate::dexterity::design::{self, Design, Plan, Purpose, Suspect};
use crate::effects::Catalogue;
use crate::whole::Whole;

pub fn kr240() -> Arm {
    crate::fixture::kr240([0.1, 0.0, 0.15])
}

pub fn design<'a>(whole: impl Into<Whole<'a>>, plan: &Plan) -> Result<Design, DexterityError> {
    design::design(whole, plan, &|part| assert!((0.0..=1.0).contains(&part)))
}

pub fn plan(purpose: Purpose) -> Plan {
    let pull = |x: f64, y: f64, z: f64| Vector6::new(x, y, z, 0.0, 0.0, 0.0);
    Plan {
        bench: Vec::new(),
        plates: Vec::new(),
        count: 8,
        purpose,
        along: vec![],
        loads: vec![pull(0.0, 0.0, -1000.0), pull(1000.0, 0.0, 0.0), pull(0.0, -1000.0, 0.0)],
        noise_position: 3e-5,
        noise_rotation: None,
        seed: 1,
    }
}

pub fn separate(arm: &Arm, texts: [&str; 2]) -> Plan {
    let pair = texts.map(|text| Suspect::parse(text, arm, &Catalogue::default()).unwrap());
    plan(Purpose::Separate(pair))
}
