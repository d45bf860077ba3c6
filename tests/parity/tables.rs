//! Random tables: both conventions, prismatic joints, tilted rows, bases, tools, symbols, masses, beams.

use core::ops::RangeInclusive;

use proptest::prelude::*;
use stiffarm::kernels::generic::Arm;
use stiffarm_codegen::robot::Robot;

/// A robot file, and numbers for its symbols.
#[derive(Clone, Debug, Default)]
pub struct Table {
    pub text: String,
    pub values: Vec<(String, f64)>,
}

impl Table {
    pub fn robot(&self) -> Robot {
        let read = Robot::from_toml(&self.text, "random");
        read.unwrap_or_else(|e| panic!("{e}\n{}", self.text)).0
    }

    pub fn value(&self, symbol: &str) -> Option<f64> {
        self.values.iter().find(|(name, _)| name == symbol).map(|(_, value)| *value)
    }

    /// The table with numbers only.
    pub fn numeric(&self) -> Robot {
        self.robot().with_parameters(|name| self.value(name)).expect("every symbol has a value")
    }

    /// What the textbook makes of it.
    pub fn arm(&self) -> Arm {
        stiffarm_gap::robot::arm(&self.numeric()).expect("numbers only")
    }
}

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

/// A rotation vector: angles as a person writes them, or a tilt of any size.
fn rotation() -> impl Strategy<Value = [String; 3]> {
    let tilt = (-9.0f64..0.0, prop::array::uniform3(-1.0f64..1.0));
    prop_oneof![
        prop::array::uniform3(angle()),
        tilt.prop_map(|(size, direction)| direction.map(|x| format!("{:e}", x * 10f64.powf(size)))),
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

/// The tensor of inertia of some body: its mass spread along three directions.
fn inertia() -> impl Strategy<Value = [f64; 6]> {
    prop::array::uniform3(prop::array::uniform3(-0.4f64..0.4)).prop_map(|spread| {
        let moment =
            |i: usize, j: usize| spread.iter().map(|along| along[i] * along[j]).sum::<f64>();
        let trace = moment(0, 0) + moment(1, 1) + moment(2, 2);
        let diagonal = |k| trace - moment(k, k);
        [diagonal(0), -moment(0, 1), -moment(0, 2), diagonal(1), -moment(1, 2), diagonal(2)]
    })
}

/// Symbols for some of a row's cells, with their numbers; `@` stands for the row.
fn symbols() -> impl Strategy<Value = Vec<(&'static str, f64)>> {
    let numbers = (-0.5f64..0.9, 0.05f64..0.9, -3.0f64..3.0, 1e5f64..1e7, 1.0f64..30.0);
    (any::<[bool; 5]>(), numbers).prop_map(|(chosen, (d, a, alpha, k, mass))| {
        let all = [("d", d), ("a", a), ("alpha", alpha), ("stiffness", k), ("mass", mass)];
        all.into_iter().zip(chosen).filter(|(_, chosen)| *chosen).map(|(cell, _)| cell).collect()
    })
}

prop_compose! {
    fn joint()(prismatic in prop::bool::weighted(0.2))(
        prismatic in Just(prismatic),
        theta in angle(),
        alpha in angle(),
        beta in prop::option::weighted(0.3, angle()),
        a in length(),
        d in length(),
        stiffness in prop::option::weighted(0.8, 1u32..100),
        mass in prop::option::of((1u32..30, -300i32..300, -300i32..300, -300i32..300)),
        moves in prop::option::of((inertia(), prop::array::uniform4(0u32..20))),
        beam in prop::option::of(beam(prismatic)),
        symbols in prop::option::weighted(0.2, symbols()),
    ) -> Table {
        let symbols = symbols.unwrap_or_default();
        let cell = |name: &str, number: String| match symbols.iter().any(|(s, _)| *s == name) {
            true => format!("{name} = \"{name}@\"\n"),
            false => format!("{name} = {number}\n"),
        };
        let kind = if prismatic { "prismatic" } else { "revolute" };
        let mut text = format!("[[joint]]\ntype = \"{kind}\"\ntheta = {theta}\n");
        // A chord of no length is refused by the validator.
        let chord = prismatic || a != "0.0" && a != "\"0 mm\"" || symbols.iter().any(|(s, _)| *s == "a");
        text += &[cell("alpha", alpha), cell("a", a), cell("d", d)].concat();
        text += &beta.map(|beta| format!("beta = {beta}\n")).unwrap_or_default();
        if let Some(k) = stiffness {
            text += &cell("stiffness", format!("{k}e5"));
        }
        if let Some((m, x, y, z)) = mass {
            text += &cell("mass", m.to_string());
            text += &format!("com = [\"{x} mm\", \"{y} mm\", \"{z} mm\"]\n");
            if let Some((inertia, [gear, rotor, coulomb, viscous])) = moves {
                text += &format!("inertia = {inertia:?}\ngear = {}\nrotor_inertia = {rotor}e-3\n", gear + 1);
                text += &format!("coulomb = {coulomb}\nviscous = {viscous}\n");
            }
        }
        text += &beam.filter(|_| chord).unwrap_or_default();
        let values = symbols.into_iter().map(|(name, x)| (format!("{name}@"), x)).collect();
        Table { text, values }
    }
}

prop_compose! {
    /// A table with so many rows.
    pub fn table(rows: RangeInclusive<usize>)(
        standard in any::<bool>(),
        joints in prop::collection::vec(joint(), rows),
        frames in prop::array::uniform2(prop::option::of((prop::array::uniform3(length()), rotation()))),
        gravity in prop::array::uniform3(-10i32..=10),
    ) -> Table {
        let convention = if standard { "standard" } else { "modified" };
        let [x, y, z] = gravity;
        let mut text = format!(
            "name = \"random\"\nconvention = \"{convention}\"\ngravity = [{x}.0, {y}.0, {z}.0]\n"
        );
        let mut values = Vec::new();
        for (k, joint) in joints.into_iter().enumerate() {
            let row = (k + 1).to_string();
            text += &joint.text.replace('@', &row);
            values.extend(joint.values.into_iter().map(|(name, x)| (name.replace('@', &row), x)));
        }
        for (name, (t, r)) in ["base", "tool"].into_iter().zip(frames).filter_map(|(n, f)| Some((n, f?))) {
            text += &format!("[{name}]\ntranslation = [{}]\nrotation = [{}]\n", t.join(", "), r.join(", "));
        }
        Table { text, values }
    }
}
