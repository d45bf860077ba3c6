//! Random tables: 1 to 9 joints, both conventions, prismatic joints, tools, masses, beams.

use proptest::prelude::*;
use stiffarm::kernels::Output;
use stiffarm_codegen::derive::{Passes, derive, derive_in, derive_with};
use stiffarm_codegen::robot::Robot;

use crate::compare::{CANCELLED, Draws, relative, terms};

fn angle() -> impl Strategy<Value = String> {
    prop_oneof![
        3 => (-4i32..=4).prop_map(|k| format!("\"{} deg\"", 90 * k)),
        1 => (-12i32..=12).prop_map(|k| format!("\"{k}*pi/12\"")),
        1 => (-3.0f64..3.0).prop_map(|x| format!("{x:.2}")),
    ]
}

fn length() -> impl Strategy<Value = String> {
    prop_oneof![
        2 => Just("0.0".to_string()),
        3 => (-900i32..=900).prop_map(|mm| format!("\"{mm} mm\"")),
    ]
}

fn beam(telescope: bool) -> impl Strategy<Value = String> {
    let section = prop_oneof![
        Just("{ shape = \"tube\", outer_diameter = 0.12, inner_diameter = 0.1 }"),
        Just("{ shape = \"box\", outer = [0.1, 0.14], inner = [0.09, 0.12] }"),
        Just("{ area = 2e-3, iy = 3e-6, iz = 5e-6, j = 4e-6 }"),
    ];
    (section, any::<bool>(), any::<bool>()).prop_map(move |(section, heavy, shear)| {
        let density = if heavy && !telescope { "density = 2700.0\n" } else { "" };
        let shear = if shear { "shear_coefficient = 0.5\n" } else { "" };
        format!(
            "[joint.beam]\nyoungs_modulus = 69e9\nshear_modulus = 26e9\nsection = {section}\n\
             {density}{shear}"
        )
    })
}

prop_compose! {
    fn joint()(prismatic in prop::bool::weighted(0.2))(
        prismatic in Just(prismatic),
        theta in angle(),
        alpha in angle(),
        a in length(),
        d in length(),
        stiffness in prop::option::weighted(0.8, 1u32..100),
        mass in prop::option::of((1u32..30, -300i32..300, -300i32..300, -300i32..300)),
        beam in prop::option::of(beam(prismatic)),
    ) -> String {
        let kind = if prismatic { "prismatic" } else { "revolute" };
        let mut text = format!(
            "[[joint]]\ntype = \"{kind}\"\ntheta = {theta}\nalpha = {alpha}\na = {a}\nd = {d}\n"
        );
        if let Some(k) = stiffness {
            text += &format!("stiffness = {k}e5\n");
        }
        if let Some((m, x, y, z)) = mass {
            text += &format!("mass = {m}\ncom = [\"{x} mm\", \"{y} mm\", \"{z} mm\"]\n");
        }
        // A chord of no length is refused by the validator.
        if let Some(beam) = beam.filter(|_| prismatic || a != "0.0" && a != "\"0 mm\"") {
            text += &beam;
        }
        text
    }
}

prop_compose! {
    fn robot()(
        standard in any::<bool>(),
        joints in prop::collection::vec(joint(), 1..=9),
        tool in prop::option::of((prop::array::uniform3(length()), prop::array::uniform3(angle()))),
        gravity in prop::array::uniform3(-10i32..=10),
    ) -> String {
        let convention = if standard { "standard" } else { "modified" };
        let [x, y, z] = gravity;
        let mut text = format!(
            "name = \"random\"\nconvention = \"{convention}\"\ngravity = [{x}.0, {y}.0, {z}.0]\n"
        );
        text += &joints.concat();
        if let Some((t, r)) = tool {
            text += &format!("[tool]\ntranslation = [{}]\nrotation = [{}]\n", t.join(", "), r.join(", "));
        }
        text
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, ..ProptestConfig::default() })]

    #[test]
    fn the_graph_agrees_with_the_textbook(text in robot(), seed in any::<u64>()) {
        let (robot, _) = Robot::from_toml(&text, "random").unwrap_or_else(|e| panic!("{e}\n{text}"));
        let arm = stiffarm_gap::robot::arm(&robot).unwrap();
        let mut draws = Draws::new(seed);
        let (q, wrench) = (draws.posture(&arm), draws.wrench(&arm));
        for output in Output::EACH {
            let Ok(expected) = arm.evaluate(output, &q, &wrench) else { continue };
            let program = derive(&robot, &[output]);
            let got = program.evaluate(&q, &wrench, |_| f64::NAN).unwrap();
            let worst = relative(&got[0], &expected, CANCELLED * terms(&arm, output, &q, &wrench));
            prop_assert!(worst <= 1e-11, "{} {worst:e}\n{text}", output.name());
        }
    }

    #[test]
    fn the_working_frame_does_not_matter(text in robot(), cut in 0usize..40, seed in any::<u64>()) {
        let (robot, _) = Robot::from_toml(&text, "random").unwrap();
        let arm = stiffarm_gap::robot::arm(&robot).unwrap();
        let mut draws = Draws::new(seed);
        let (q, wrench) = (draws.posture(&arm), draws.wrench(&arm));
        let cut = cut % (4 * robot.dof() + 1);
        let outputs = [Output::Jacobian, Output::ComplementaryStiffness, Output::Compliance];
        let there = derive_in(&robot, &outputs, cut).evaluate(&q, &wrench, |_| f64::NAN).unwrap();
        let base = derive_in(&robot, &outputs, 0).evaluate(&q, &wrench, |_| f64::NAN).unwrap();
        for ((a, b), output) in there.iter().zip(&base).zip(outputs) {
            let worst = relative(a, b, CANCELLED * terms(&arm, output, &q, &wrench));
            prop_assert!(worst <= 1e-11, "{worst:e}\n{text}");
        }
    }

    #[test]
    fn passes_change_nothing_but_the_cost(
        text in robot(), off in 0usize..5, output in 0..Output::EACH.len(), seed in any::<u64>()
    ) {
        let (robot, _) = Robot::from_toml(&text, "random").unwrap();
        let arm = stiffarm_gap::robot::arm(&robot).unwrap();
        let mut draws = Draws::new(seed);
        let (q, wrench) = (draws.posture(&arm), draws.wrench(&arm));
        let passes = match off {
            0 => Passes { frame: false, ..Passes::ALL },
            1 => Passes { sums: false, ..Passes::ALL },
            2 => Passes { runs: false, ..Passes::ALL },
            3 => Passes { parallel: false, ..Passes::ALL },
            _ => Passes::NONE,
        };
        let output = Output::EACH[output];
        let all = derive(&robot, &[output]).evaluate(&q, &wrench, |_| f64::NAN);
        let some = derive_with(&robot, &[output], passes).evaluate(&q, &wrench, |_| f64::NAN);
        if let (Ok(all), Ok(some)) = (all, some) {
            let floor = CANCELLED * terms(&arm, output, &q, &wrench);
            let worst = relative(&some[0], &all[0], floor);
            prop_assert!(worst <= 1e-11, "{} {passes:?} {worst:e}\n{text}", output.name());
        }
    }
}
