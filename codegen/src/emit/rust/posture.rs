//! What enters a kernel: the posture as sines, cosines and displacements.

use stiffarm_kernels::Input;

use super::statements::sin_cos;
use super::style::Rust;
use crate::emit::lines::Lines;
use crate::ir::{Extra, Module, Plain, Posture, Readings};

/// What a function is made of is joined to it, so that sines and cosines and all entries stay in
/// registers; the way through memory costs a quarter more.
pub(super) const INLINE: &str = "#[inline(always)]";

/// The struct `Posture`: what of the joint values the functions of the module need.
pub(super) fn module(module: &Module, style: &Rust) -> String {
    let Module { robot, readings: stage, posture, .. } = module;
    let n = robot.dof();
    let mut out = Lines::at(0);
    joints(&mut out, stage, style, n);
    out.blank();
    out.doc("The joint values as the kernels need them: sines, cosines, displacements.");
    out.code("#[derive(Clone, Copy, Debug, PartialEq)]");
    out.within("pub struct Posture<S> {", "}", |out| {
        for angle in &posture.angles {
            for field in angle.needed() {
                let word = if field.starts_with('s') { "sin" } else { "cos" };
                out.doc(&format!("`{word}({})`", angle.sum.print(style)));
                out.code(&format!("pub {field}: S,"));
            }
        }
        for plain in &posture.plain {
            out.doc(&format!("`{}`, {}", plain.source().print(style), plain.meaning(robot)));
            out.code(&format!("pub {}: S,", plain.field()));
        }
    });
    out.blank();
    out.within("impl<S: Scalar> Posture<S> {", "}", |out| {
        out.doc("All sines and cosines at once.");
        let constants = if posture.reads_constants() { "constants: &Constants<S>, " } else { "" };
        out.code(INLINE);
        let extras = parameters(stage, n).concat();
        let mut head = format!("pub fn new({constants}q: &[S; {n}]{extras}) -> Self {{");
        let apart = stage.moves && robot.inverse_kinematics.is_some();
        if apart {
            let names = stage.handed_on();
            let joints = format!("Self::at_joints(&joints(q{names}){names})");
            out.within(&head, "}", |out| out.code(&joints));
            out.blank();
            out.doc("The same at joint values, not at readings.");
            out.code("#[allow(unused_variables)]");
            out.code(INLINE);
            head = format!("pub fn at_joints(q: &[S; {n}]{extras}) -> Self {{");
        }
        out.within(&head, "}", |out| {
            values(out, posture, (stage, style), !apart);
            out.code(&format!("Posture {{ {} }}", posture.fields().join(", ")));
        });
        let fields = posture.fields();
        if module.functions().any(|function| function.reads.len() < fields.len()) {
            out.blank();
            out.doc("Zeros, in the place of what a kernel does not need.");
            out.code(INLINE);
            out.within("fn unused() -> Self {", "}", |out| {
                out.code("let zero = S::lit(0.0);");
                let zeros: Vec<String> =
                    fields.iter().map(|field| format!("{field}: zero")).collect();
                out.code(&format!("Posture {{ {} }}", zeros.join(", ")));
            });
        }
    });
    out.finish()
}

/// What stands behind `q` among the parameters of the arm's functions.
pub(super) fn parameters(stage: &Readings, n: usize) -> Vec<String> {
    let parameter = |extra: Extra| match extra {
        Extra::Sides => format!(", {}: &[S; {n}]", extra.name()),
        Extra::Warming => format!(", {}: S", extra.name()),
    };
    stage.extras.iter().copied().map(parameter).collect()
}

/// The function from readings to joint values, where these are others.
fn joints(out: &mut Lines, stage: &Readings, style: &Rust, n: usize) {
    if !stage.moves {
        return;
    }
    let ops = stage.ops;
    out.blank();
    out.doc("The joint values that readings mean, base to tip, in rad (prismatic joint: m).");
    out.doc("");
    out.doc("What is told by joint in this module is told of these values, not of the readings.");
    out.doc("");
    out.doc(&format!("{}.", readings(stage)));
    out.doc("");
    out.doc(&format!(
        "{} additions, {} multiplications, {} pairs of sine and cosine, beyond those of the functions.",
        ops.add, ops.mul, ops.sin_cos
    ));
    out.code(INLINE);
    let unread = |extra: &Extra| if stage.reads(*extra) { "" } else { "_" };
    let extras = stage.extras.iter().zip(parameters(stage, n));
    let extras = extras.map(|(e, text)| text.replacen(", ", &format!(", {}", unread(e)), 1));
    let extras: String = extras.collect();
    out.within(
        &format!("pub fn joints<S: Scalar>(q: &[S; {n}]{extras}) -> [S; {n}] {{"),
        "}",
        |out| {
            if !stage.angles.is_empty() {
                let sums: Vec<String> = stage.angles.iter().map(|a| a.sum.print(style)).collect();
                let [pattern, call] = sin_cos(&stage.angles, &sums);
                out.code(&pattern);
                out.code(&format!("    {call}"));
            }
            out.within("[", "]", |out| {
                for joint in &stage.joints {
                    out.code(&format!("{},", joint.print(style)));
                }
            });
        },
    );
}

/// The documentation of readings and of what is given beside them.
pub(super) fn readings(stage: &Readings) -> String {
    let extras = stage.extras.iter().map(|e| format!("; `{}`: {}", e.name(), e.sentence()));
    let joints = Input::Joints.sentence();
    let readings = joints.replacen("joint values", "readings", usize::from(stage.moves));
    format!("`{}`: {readings}{}", Input::Joints.name(), extras.collect::<String>())
}

/// The fields as locals, of readings or of the joint values that these mean.
pub(super) fn values(
    out: &mut Lines,
    posture: &Posture,
    (stage, style): (&Readings, &Rust),
    of_readings: bool,
) {
    if of_readings && stage.moves && posture.reads_joints() {
        out.code(&format!("let q = joints(q{});", stage.handed_on()));
    }
    if !posture.angles.is_empty() {
        let mut sums = Vec::new();
        for angle in &posture.angles {
            let sum = angle.sum.print(style);
            if sum.contains(' ') {
                out.code(&format!("let theta{} = {sum};", angle.suffix));
                sums.push(format!("theta{}", angle.suffix));
            } else {
                sums.push(sum);
            }
        }
        let [pattern, call] = sin_cos(&posture.angles, &sums);
        out.code(&pattern);
        out.code(&format!("    {call}"));
    }
    for plain in &posture.plain {
        let source = if *plain == Plain::Growth { &stage.growth } else { &plain.source() };
        out.code(&format!("let {} = {};", plain.field(), source.print(style)));
    }
}
