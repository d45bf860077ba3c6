//! The head of a generated module: the table as constants, and its symbolic parameters.

use stiffarm_kernels::{Form, Output};

use super::super::asked;
use super::super::cells::{angle, stiffness, value, world};
use super::super::hash::provenance;
use super::super::legend::legend;
use super::RustOptions;
use super::style::Rust;
use crate::emit::lines::Lines;
use crate::ir::{Constants, Module};
use crate::robot::{
    Angle, CLOSED_FORM, ClosedForm, Convention, ELBOW_ANGLE, Entry, Joint, Motion, Quantity, Robot,
    Value,
};

/// Imports, name, number of joints, table.
pub(super) fn header(module: &Module, alone: bool, options: &RustOptions) -> String {
    let mut out = Lines::at(0);
    let robot = module.robot;
    let n = robot.dof();
    out.wrapped(&format!("{}. {}", robot.name, provenance(robot)), "// ");
    let fused = if options.fused { " --fused" } else { "" };
    let asked = asked(robot);
    out.code(&match alone {
        true => format!(
            "// Not to be edited: `stiffarm generate ROBOT{asked}{fused} --check FILE` compares it with the table."
        ),
        false => "// Not to be edited: a build script writes it, with functions of its own.".to_owned(),
    });
    out.wrapped(&legend(module), "// ");
    let outputs = robot.generated();
    let inverse = robot.inverse_kinematics.is_some();
    let stepped = module.functions().any(|function| function.name() == CLOSED_FORM);
    let searched = robot.inverse_kinematics.is_some_and(ClosedForm::is_search);
    let elbow = module.functions().any(|function| function.name() == ELBOW_ANGLE);
    let poses = outputs.iter().any(|o| matches!(o.form(), Form::Pose | Form::Poses));
    let uses = [
        (true, "Arm DhRow Error Kernels Motion Output Scalar fill has"),
        (robot.symbols().is_empty(), "Convention Numeric Row"),
        (robot.has_set_points(), "Elastic Gives"),
        (inverse, "Inverse JointValues Solutions Steps"),
        (poses || inverse, "Pose"),
        (outputs.iter().any(|o| o.is_fallible()), "Unstable"),
        (inverse && (stepped || searched), "unloaded"),
        (searched, "Axes"),
        (elbow, "ElbowAngle"),
    ];
    imports(&mut out, options, &uses);
    out.blank();
    out.doc("The arm's name.");
    out.code(&format!("pub const NAME: &str = {:?};", robot.name));
    out.blank();
    out.doc("Number of joints.");
    out.code(&format!("pub const N: usize = {n};"));
    out.blank();
    listed(&mut out, &outputs);
    out.blank();
    out.doc("The Denavit-Hartenberg table that every function of this module was derived from:");
    out.doc(match robot.convention {
        Convention::Standard => "each row is Rz(theta) Tz(d) Tx(a) Rx(alpha) Ry(beta).",
        Convention::Modified => "each row is Rx(alpha) Ry(beta) Tx(a) Rz(theta) Tz(d).",
    });
    out.doc("");
    out.doc("| joint | theta | d | a | alpha | beta | stiffness |");
    out.doc("|---|---|---|---|---|---|---|");
    for joint in &robot.joints {
        out.doc(&row(joint));
    }
    if let Some(world) = world(robot) {
        out.doc("");
        out.doc(&world);
    }
    beyond(&mut out, robot);
    out.within("pub const DH: [DhRow; N] = [", "];", |out| {
        for joint in &robot.joints {
            let motion = match joint.motion {
                Motion::Revolute => "Revolute",
                Motion::Prismatic => "Prismatic",
            };
            let stiffness = joint.stiffness.as_ref().map_or("rigid".to_string(), value);
            out.code(&format!(
                "DhRow {{ joint: {:?}, motion: Motion::{motion}, theta: {:?}, d: {:?}, a: {:?}, \
             alpha: {:?}, beta: {:?}, stiffness: {:?} }},",
                joint.name,
                angle(&joint.theta),
                value(&joint.d),
                value(&joint.a),
                angle(&joint.alpha),
                angle(&joint.beta),
                stiffness,
            ));
        }
    });
    out.finish()
}

/// What the arm does beyond the table.
fn beyond(out: &mut Lines, robot: &Robot) {
    if robot.effects.is_empty() {
        return;
    }
    out.doc("");
    out.doc("Beyond the table:");
    for effect in &robot.effects {
        let number = |entry: &Entry<Quantity>| match &entry.value {
            Quantity::Si(x) => format!(", {} = {x:?}", entry.key),
            Quantity::Text(text) => format!(", {} = {text}", entry.key),
        };
        let numbers: String = effect.numbers.iter().map(number).collect();
        out.doc(&format!(
            "- {} at {}{numbers}",
            effect.id.value.replace('_', " "),
            effect.place.value
        ));
    }
}

/// A row in the notation of the input: `q` stands where the joint moves.
fn row(joint: &Joint) -> String {
    let with_q = |offset: String| match offset.as_str() {
        "0" => "q".to_string(),
        offset if offset.starts_with('-') => format!("q - {}", &offset[1..]),
        offset => format!("q + {offset}"),
    };
    let (theta, d) = (angle(&joint.theta), value(&joint.d));
    let (theta, d) = match joint.motion {
        Motion::Revolute => (with_q(theta), d),
        Motion::Prismatic => (theta, with_q(d)),
    };
    let stiffness = stiffness(joint);
    let (a, alpha, beta) = (value(&joint.a), angle(&joint.alpha), angle(&joint.beta));
    format!("| {} | {theta} | {d} | {a} | {alpha} | {beta} | {stiffness} |", joint.name)
}

/// The struct of symbolic parameters.
pub(super) fn symbols(out: &mut Lines, robot: &Robot) {
    out.blank();
    out.doc("The table's symbolic link parameters.");
    out.code("#[allow(non_snake_case)]");
    out.code("#[derive(Clone, Copy, Debug, PartialEq)]");
    out.within("pub struct Parameters<S> {", "}", |out| {
        for symbol in robot.symbols() {
            out.doc(&format!("`{}` of the table, {}.", symbol.name, symbol.dimension.unit()));
            out.code(&format!("pub {}: S,", symbol.name));
        }
    });
}

/// The structs of symbolic parameters and of what is worked out from them once.
pub(super) fn parameters(robot: &Robot, constants: &Constants) -> String {
    let mut out = Lines::at(0);
    let style = Rust { fused: false, constants: "p" };
    symbols(&mut out, robot);
    out.blank();
    out.doc("What the functions need of the parameters, worked out once.");
    out.code("#[allow(non_snake_case)]");
    out.code("#[derive(Clone, Copy, Debug, PartialEq)]");
    out.within("pub struct Constants<S> {", "}", |out| {
        for field in constants.fields() {
            out.doc(&format!("`{}`", field.value.print(&style)));
            out.code(&format!("pub {}: S,", field.name));
        }
    });
    out.blank();
    out.within("impl<S: Scalar> Constants<S> {", "}", |out| {
        out.doc("Works the constants out.");
        out.within("pub fn new(p: &Parameters<S>) -> Self {", "}", |out| {
            out.within("Constants {", "}", |out| {
                for field in constants.fields() {
                    out.code(&format!("{}: {},", field.name, field.value.print(&style)));
                }
            });
        });
    });
    out.finish()
}

/// The table in numbers.
pub(super) fn numeric(out: &mut Lines, robot: &Robot, (generic, target): (&str, &str)) {
    let number = |value: &Value| format!("{:?}", value.or_zero());
    let three = |values: &[Value; 3]| format!("[{}]", values.each_ref().map(number).join(", "));
    let radians = |angle: &Angle| format!("{:?}", angle.or_zero());
    out.blank();
    out.within(&format!("impl{generic} Numeric<N> for {target} {{"), "}", |out| {
        out.code(&format!("const CONVENTION: Convention = Convention::{:?};", robot.convention));
        out.code(&format!("const GRAVITY: [f64; 3] = {};", three(&robot.gravity)));
        out.within("const ROWS: [Row; N] = [", "];", |out| {
            for joint in &robot.joints {
                let stiffness = joint.stiffness.as_ref();
                let stiffness =
                    stiffness.map_or("None".to_string(), |k| format!("Some({})", number(k)));
                out.code(&format!(
                    "Row {{ theta: {}, d: {}, a: {}, alpha: {}, stiffness: {stiffness}, mass: {}, \
                     com: {} }},",
                    radians(&joint.theta),
                    number(&joint.d),
                    number(&joint.a),
                    radians(&joint.alpha),
                    joint.mass.as_ref().map_or("0.0".to_string(), number),
                    three(&joint.com),
                ));
            }
        });
    });
}

/// What of the kernels is used, by names with spaces between them: in the order in which rustfmt has it.
pub(super) fn imports(out: &mut Lines, options: &RustOptions, uses: &[(bool, &str)]) {
    let used = uses.iter().filter(|(used, _)| *used);
    let mut names: Vec<&str> = used.flat_map(|(_, names)| names.split(' ')).collect();
    names.sort_unstable();
    out.code(&format!("use {}::{{{}}};", options.kernels, names.join(", ")));
}

/// The outputs of a module.
pub(super) fn listed(out: &mut Lines, outputs: &[Output]) {
    out.doc("What the module computes.");
    out.within(&format!("pub const OUTPUTS: [Output; {}] = [", outputs.len()), "];", |out| {
        outputs.iter().for_each(|output| out.code(&format!("Output::{output:?},")))
    });
}
