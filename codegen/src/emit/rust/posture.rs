//! What enters a kernel: the posture as sines, cosines and displacements.

use stiffarm_kernels::Input;

use super::super::posture::{Needs, Pair, Plain, Posture};
use super::super::readings::{Extra, Stage};
use super::style::Rust;
use crate::emit::lines::Lines;
use crate::robot::Robot;

/// What a function is made of is joined to it, so that sines and cosines and all entries stay in
/// registers; the way through memory costs a quarter more.
pub(super) const INLINE: &str = "#[inline(always)]";

/// Whether an angle has a symbolic offset.
pub(super) fn needs_constants(posture: &Posture) -> bool {
    posture.angles.iter().any(|pair| pair.sum.contains("constants."))
}

/// The struct `Posture`: what of the joint values the functions of the module need.
pub(super) fn module(
    posture: &Posture,
    needs: &[Needs],
    (stage, style): (&Stage, &Rust),
    robot: &Robot,
) -> String {
    let n = robot.dof();
    let mut out = Lines::at(0);
    joints(&mut out, stage, style, n);
    out.blank();
    out.doc("The joint values as the kernels need them: sines, cosines, displacements.");
    out.code("#[derive(Clone, Copy, Debug, PartialEq)]");
    out.code("pub struct Posture<S> {");
    out.indent();
    for pair in &posture.angles {
        for field in pair.fields() {
            let word = if field.starts_with('s') { "sin" } else { "cos" };
            out.doc(&format!("`{word}({})`", pair.sum));
            out.code(&format!("pub {field}: S,"));
        }
    }
    for plain in &posture.plain {
        out.doc(&format!("`{}`, {}", plain.source(), plain.meaning(robot)));
        out.code(&format!("pub {}: S,", plain.field()));
    }
    out.dedent();
    out.code("}");
    out.blank();
    out.code("impl<S: Scalar> Posture<S> {");
    out.indent();
    out.doc("All sines and cosines at once.");
    let constants = if needs_constants(posture) { "constants: &Constants<S>, " } else { "" };
    out.code(INLINE);
    let extras = parameters(stage, n).concat();
    out.code(&format!("pub fn new({constants}q: &[S; {n}]{extras}) -> Self {{"));
    out.indent();
    values(&mut out, posture, (stage, style));
    out.code(&format!("Posture {{ {} }}", posture.fields().join(", ")));
    out.dedent();
    out.code("}");
    let fields = posture.fields();
    if needs.iter().any(|needs| needs.reads.len() < fields.len()) {
        out.blank();
        out.doc("Zeros, in the place of what a kernel does not need.");
        out.code(INLINE);
        out.code("fn unused() -> Self {");
        out.indent();
        out.code("let zero = S::lit(0.0);");
        let zeros: Vec<String> = fields.iter().map(|field| format!("{field}: zero")).collect();
        out.code(&format!("Posture {{ {} }}", zeros.join(", ")));
        out.dedent();
        out.code("}");
    }
    out.dedent();
    out.code("}");
    out.finish()
}

/// What stands behind `q` among the parameters of the arm's functions.
pub(super) fn parameters(stage: &Stage, n: usize) -> Vec<String> {
    let parameter = |extra: Extra| match extra {
        Extra::Sides => format!(", {}: &[S; {n}]", extra.name()),
        Extra::Warming => format!(", {}: S", extra.name()),
    };
    stage.extras().into_iter().map(parameter).collect()
}

/// The function from readings to joint values, where these are others.
fn joints(out: &mut Lines, stage: &Stage, style: &Rust, n: usize) {
    if !stage.moves {
        return;
    }
    let ops = stage.readings.ops();
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
    let extras = stage.extras().into_iter().zip(parameters(stage, n));
    let extras = extras.map(|(e, text)| text.replacen(", ", &format!(", {}", unread(&e)), 1));
    let extras: String = extras.collect();
    out.code(&format!("pub fn joints<S: Scalar>(q: &[S; {n}]{extras}) -> [S; {n}] {{"));
    out.indent();
    let angles = stage.angles();
    if !angles.is_empty() {
        let each = |letter: &str| {
            let names = angles.iter().map(|a| format!("{letter}{}", stage.suffix(*a)));
            names.collect::<Vec<_>>().join(", ")
        };
        let sums: Vec<String> = angles.iter().map(|a| stage.print(*a, style)).collect();
        out.code(&format!("let ([{}], [{}]) =", each("s"), each("c")));
        out.code(&format!("    S::sin_cos_all([{}]);", sums.join(", ")));
    }
    out.code("[");
    out.indent();
    for joint in &stage.readings.joints {
        out.code(&format!("{},", stage.print(*joint, style)));
    }
    out.dedent();
    out.code("]");
    out.dedent();
    out.code("}");
}

/// The documentation of readings and of what is given beside them.
pub(super) fn readings(stage: &Stage) -> String {
    let extras = stage.extras().into_iter().map(|e| format!("; `{}`: {}", e.name(), e.sentence()));
    let joints = Input::Joints.sentence();
    let readings = joints.replacen("joint values", "readings", usize::from(stage.moves));
    format!("`{}`: {readings}{}", Input::Joints.name(), extras.collect::<String>())
}

/// The fields as locals.
pub(super) fn values(out: &mut Lines, posture: &Posture, (stage, style): (&Stage, &Rust)) {
    let of_joints = |plain: &Plain| matches!(plain, Plain::Joint(_));
    if stage.moves && (!posture.angles.is_empty() || posture.plain.iter().any(of_joints)) {
        let extras = stage.extras().into_iter().map(|e| format!(", {}", e.name()));
        out.code(&format!("let q = joints(q{});", extras.collect::<String>()));
    }
    if !posture.angles.is_empty() {
        let name = |used: bool, letter: &str, pair: &Pair| match used {
            true => format!("{letter}{}", pair.suffix),
            false => "_".to_string(),
        };
        let sines: Vec<String> = posture.angles.iter().map(|a| name(a.sine, "s", a)).collect();
        let cosines: Vec<String> = posture.angles.iter().map(|a| name(a.cosine, "c", a)).collect();
        let mut sums = Vec::new();
        for pair in &posture.angles {
            if pair.sum.contains(' ') {
                out.code(&format!("let theta{} = {};", pair.suffix, pair.sum));
                sums.push(format!("theta{}", pair.suffix));
            } else {
                sums.push(pair.sum.clone());
            }
        }
        out.code(&format!("let ([{}], [{}]) =", sines.join(", "), cosines.join(", ")));
        out.code(&format!("    S::sin_cos_all([{}]);", sums.join(", ")));
    }
    for plain in &posture.plain {
        let source = match plain {
            Plain::Growth => stage.growth(style),
            plain => plain.source(),
        };
        out.code(&format!("let {} = {source};", plain.field()));
    }
}
