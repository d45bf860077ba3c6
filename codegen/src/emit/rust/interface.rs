//! A generated robot as a value: `Kernels`, behind a pointer, and `Arm`, for what is written against an arm.

use stiffarm_kernels::{Axes, Input, Output, Side, Steps};

use super::function::parameter;
use super::posture::INLINE;
use super::shapes::{flat, ty};
use super::table::numeric;
use crate::derive::{Held, steps};
use crate::emit::lines::Lines;
use crate::ir::{Extra, Group, Module};
use crate::robot::{
    CLOSED_FORM, ClosedForm, DEFLECTION, ELBOW_ANGLE, Family, GIVES, INVERSE_KINEMATICS, Motion,
    Robot,
};

/// The struct `Robot` and its traits.
pub(super) fn interface(
    module: &Module,
    Group { place, outputs, .. }: &Group,
    depth: usize,
) -> String {
    let mut out = Lines::at(depth);
    let (symbolic, extras, robot) = (module.is_symbolic(), &module.readings.extras, module.robot);
    definition(&mut out, symbolic, extras);
    let target = if symbolic || !extras.is_empty() { "Robot<S>" } else { "Robot" };
    kernels(&mut out, target, (symbolic, extras), outputs);
    arm(&mut out, target, module);
    if !symbolic && place.is_none() {
        let generic = if extras.is_empty() { "" } else { "<S: Scalar>" };
        numeric(&mut out, robot, (generic, target));
    }
    outputs.iter().for_each(|output| has(&mut out, target, (*output, robot.dof()), symbolic));
    if let Some(form) = robot.inverse_kinematics.filter(|_| place.is_none()) {
        inverse(&mut out, target, module, form);
    }
    out.finish()
}

fn definition(out: &mut Lines, symbolic: bool, extras: &[Extra]) {
    out.blank();
    if symbolic {
        out.doc("This arm with numbers for its parameters, as `Kernels`.");
        out.code("#[derive(Clone, Copy, Debug, PartialEq)]");
        out.within("pub struct Robot<S> {", "}", |out| {
            out.doc("What the functions need of the parameters.");
            out.code("pub constants: Constants<S>,");
        });
        out.blank();
        out.within("impl<S: Scalar> Robot<S> {", "}", |out| {
            out.doc("The arm with these parameters.");
            out.within("pub fn new(p: &Parameters<S>) -> Self {", "}", |out| {
                out.code("Robot { constants: Constants::new(p) }");
            });
        });
    } else if !extras.is_empty() {
        out.doc("This arm as `Kernels`, and what its functions take besides readings and load.");
        out.code("#[derive(Clone, Copy, Debug, PartialEq)]");
        out.within("pub struct Robot<S> {", "}", |out| {
            for extra in extras {
                out.doc(&format!("{}.", capital(extra.sentence())));
                match extra {
                    Extra::Sides => out.code("pub sides: [S; N],"),
                    Extra::Warming => out.code("pub warming: S,"),
                }
            }
        });
        out.blank();
        out.within("impl<S: Scalar> Default for Robot<S> {", "}", |out| {
            out.doc(
                "Of joints that came from unknown sides, as warm as when it is as its table says.",
            );
            let each = extras.iter().map(|extra| match extra {
                Extra::Sides => "sides: [S::lit(0.0); N]",
                Extra::Warming => "warming: S::lit(0.0)",
            });
            let each = each.collect::<Vec<_>>().join(", ");
            method(out, "fn default() -> Self {", &format!("Robot {{ {each} }}"));
        });
    } else {
        out.doc("This arm as `Kernels`.");
        out.code("#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]");
        out.code("pub struct Robot;");
    }
}

/// What of itself an arm hands on behind the readings.
fn own(extras: &[Extra]) -> String {
    let each = extras.iter().map(|extra| match extra {
        Extra::Sides => ", &self.sides",
        Extra::Warming => ", self.warming",
    });
    each.collect()
}

/// A sentence that begins as one.
fn capital(sentence: &str) -> String {
    let mut letters = sentence.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

fn kernels(
    out: &mut Lines,
    target: &str,
    (symbolic, extras): (bool, &[Extra]),
    outputs: &[Output],
) {
    out.blank();
    out.code(&format!("impl<S: Scalar> Kernels<S> for {target} {{"));
    out.indent();
    method(out, "fn name(&self) -> &'static str {", "NAME");
    method(out, "fn dof(&self) -> usize {", "N");
    method(out, "fn outputs(&self) -> &'static [Output] {", "&OUTPUTS");
    out.code("fn evaluate(");
    out.code("    &self,");
    out.code("    output: Output,");
    out.code("    state: &[S],");
    let wrench = outputs.iter().any(|output| output.takes(Input::Wrench));
    out.code(if wrench { "    wrench: &[S; 6]," } else { "    _wrench: &[S; 6]," });
    out.code("    out: &mut [S],");
    out.code(") -> Result<(), Error> {");
    out.indent();
    if symbolic {
        out.code("let constants = &self.constants;");
    }
    out.code("let (joints, []) = state.as_chunks::<N>() else { return Err(Error::Length) };");
    out.code("match (output, joints) {");
    out.indent();
    for output in outputs {
        let readings = format!("q{}", own(extras));
        let inputs = output.inputs().iter().map(|input| match input {
            Input::Joints => readings.as_str(),
            beside => beside.name(),
        });
        let inputs = inputs.collect::<Vec<_>>();
        let of_joints = output.inputs().iter().filter(|input| input.side() == Side::Joints);
        let of_joints = of_joints.map(|input| input.name()).collect::<Vec<_>>().join(", ");
        let first = if symbolic { "constants, " } else { "" };
        let question = if output.is_fallible() { "?" } else { "" };
        let call = format!("{}({first}{}){question}", output.name(), inputs.join(", "));
        let flat = flat(*output, &call);
        out.code(&format!("(Output::{output:?}, [{of_joints}]) => fill(out, {flat}),"));
    }
    out.code("_ if OUTPUTS.contains(&output) => Err(Error::Length),");
    out.code("_ => Err(Error::Absent),");
    for _ in 0..3 {
        out.dedent();
        out.code("}");
    }
}

fn arm(out: &mut Lines, target: &str, module: &Module) {
    out.blank();
    out.within(&format!("impl<S: Scalar> Arm<N, S> for {target} {{"), "}", |out| {
        out.code("const NAME: &'static str = NAME;");
        out.code("const DH: [DhRow; N] = DH;");
        let limits = module.robot.joints.iter().map(|joint| format!("{:?}", joint.limits));
        let limits = limits.collect::<Vec<_>>().join(", ");
        out.code(&format!("const LIMITS: [Option<[f64; 2]>; N] = [{limits}];"));
        out.code("type Posture = Posture<S>;");
        let constants = if module.posture.reads_constants() { "&self.constants, " } else { "" };
        out.code(INLINE);
        method(
            out,
            "fn posture(&self, q: &[S; N]) -> Posture<S> {",
            &format!("Posture::new({constants}q{})", own(&module.readings.extras)),
        );
    });
}

fn has(out: &mut Lines, target: &str, (output, n): (Output, usize), symbolic: bool) {
    out.blank();
    out.within(&format!("impl<S: Scalar> has::{output:?}<N, S> for {target} {{"), "}", |out| {
        let (name, mut ty) = (output.name(), ty(&Held::Output(output), n));
        if matches!(output.columns(), Side::Entries | Side::Moments) {
            out.code(&format!("type Columns = {ty};"));
            ty = "Self::Columns".to_string();
        }
        if output.is_fallible() {
            ty = format!("Result<{ty}, Unstable>");
        }
        let constants = if symbolic { "&self.constants, " } else { "" };
        let parameters: String = output
            .beside()
            .map(|input| format!(", {}", parameter(input.name(), Some(input.side().count(n)))))
            .collect();
        let arguments: String =
            output.beside().map(|input| format!(", {}", input.name())).collect();
        out.code(INLINE);
        let head = format!("fn {name}(&self, posture: &Posture<S>{parameters}) -> {ty} {{");
        method(out, &head, &format!("{name}::given({constants}posture{arguments})"));
    });
}

/// The inverse kinematics by the traits' names.
fn inverse(out: &mut Lines, target: &str, module: &Module, form: ClosedForm) {
    let constants = if module.is_symbolic() { "&self.constants, " } else { "" };
    let given = own(&module.readings.extras);
    let count = form.branches();
    joint_values(out, target, module);
    if form.is_search() {
        axes(out, module.robot);
    }
    out.blank();
    let number = if form.is_search() { "Scalar + Into<f64>" } else { "Scalar" };
    let of = |name: &str| format!("impl<S: {number}> {name}<N, {count}, S> for {target} {{");
    let head = |name: &str, beside: &str| {
        format!(
            "fn {name}(&self, pose: &Pose<S>, near: &[S; N]{beside}) -> Solutions<S, N, {count}> {{"
        )
    };
    let exact = module.functions().any(|function| function.name() == INVERSE_KINEMATICS);
    let elbow = form.family == Family::ElbowAngle;
    let whole = |closed: &str| match exact {
        true => closed.to_owned(),
        false => format!("unloaded(self, pose, {closed})"),
    };
    out.within(&of("Inverse"), "}", |out| {
        let Steps { unloaded, loaded, readings } = steps(module.robot, form);
        out.code(&format!(
            "const STEPS: Steps = Steps {{ unloaded: {unloaded}, loaded: {loaded}, \
             readings: {readings} }};"
        ));
        if let Some(joint) = form.given {
            out.code(&format!("const GIVEN: Option<usize> = Some({joint});"));
        }
        match form.family {
            Family::Search { third } => method(
                out,
                &head(CLOSED_FORM, ""),
                &format!("AXES.search(pose, &self.joints(near), ({:?}, {third}))", form.given),
            ),
            _ if elbow => method(
                out,
                &head(CLOSED_FORM, ""),
                "self.closed_form_at(pose, near, self.elbow_angle(near))",
            ),
            _ => called(out, &head(CLOSED_FORM, ""), module, ""),
        }
        method(out, &head(INVERSE_KINEMATICS, ""), &whole("self.closed_form(pose, near)"));
    });
    if elbow {
        out.blank();
        out.within(&of("ElbowAngle"), "}", |out| {
            let angle = format!("{ELBOW_ANGLE}({constants}q{given})");
            method(out, "fn elbow_angle(&self, q: &[S; N]) -> S {", &angle);
            called(out, &head("closed_form_at", ", elbow_angle: S"), module, ", elbow_angle");
            let at = whole("self.closed_form_at(pose, near, elbow_angle)");
            method(out, &head("inverse_kinematics_at", ", elbow_angle: S"), &at);
        });
    }
    if module.robot.has_set_points() {
        elastic(out, target, (module, constants));
    }
}

/// A method that calls the closed form's function.
fn called(out: &mut Lines, head: &str, module: &Module, beside: &str) {
    let constants = if module.is_symbolic() { "&self.constants, " } else { "" };
    let given = own(&module.readings.extras);
    let exact = module.functions().any(|function| function.name() == INVERSE_KINEMATICS);
    let (name, structure) = match exact {
        true => (INVERSE_KINEMATICS, "InverseKinematics"),
        false => (CLOSED_FORM, "ClosedForm"),
    };
    out.within(head, "}", |out| {
        out.code("let columns = pose.columns();");
        out.code(
            "let [target] = columns.as_flattened().as_chunks().0 else { ::core::unreachable!() };",
        );
        out.code(&format!(
            "let {name}::{structure} {{ q, distance, tilt }} = \
             {name}({constants}near{given}, target{beside});"
        ));
        let motion = motion(module.robot);
        out.code(&format!("Solutions {{ q, distance, tilt, motion: {motion} }}"));
    });
}

/// The axes by which solutions are searched for.
fn axes(out: &mut Lines, robot: &Robot) {
    fn text<const N: usize>(robot: &Robot) -> String {
        let Axes { lines, home } = robot.axes::<N>();
        format!("Axes {{ lines: {lines:?}, home: {home:?} }}")
    }
    let text = if robot.dof() == 7 { text::<7>(robot) } else { text::<6>(robot) };
    out.blank();
    out.doc("The inverse kinematics is a search, not a closed form: every solution by these axes, at most sixteen.");
    out.code(&format!("pub const AXES: Axes<N> = {text};"));
}

/// Which joints turn, as an array.
fn motion(robot: &Robot) -> String {
    let name = |motion: Motion| match motion {
        Motion::Revolute => "Motion::Revolute",
        Motion::Prismatic => "Motion::Prismatic",
    };
    let each: Vec<&str> = robot.joints.iter().map(|joint| name(joint.motion)).collect();
    let turns = robot.joints.iter().all(|joint| joint.motion == Motion::Revolute);
    match turns {
        true => format!("[{}; N]", name(Motion::Revolute)),
        false => format!("[{}]", each.join(", ")),
    }
}

/// Readings and joint values, where these are others.
fn joint_values(out: &mut Lines, target: &str, module: &Module) {
    out.blank();
    if !module.readings.moves {
        return out.code(&format!("impl<S: Scalar> JointValues<N, S> for {target} {{}}"));
    }
    let given = own(&module.readings.extras);
    out.within(&format!("impl<S: Scalar> JointValues<N, S> for {target} {{"), "}", |out| {
        out.code(INLINE);
        method(
            out,
            "fn joints(&self, readings: &[S; N]) -> [S; N] {",
            &format!("joints(readings{given})"),
        );
        out.code(INLINE);
        method(
            out,
            "fn at_joints(&self, joints: &[S; N]) -> Posture<S> {",
            &format!("Posture::at_joints(joints{given})"),
        );
    });
}

/// What gives in the arm at rest.
fn elastic(out: &mut Lines, target: &str, (module, constants): (&Module, &str)) {
    let links = module.functions().any(|function| {
        let tool = function.blocks().iter().find(|block| block.held.name() == "tool");
        function.name() == GIVES && tool.is_some_and(|b| b.entries.iter().any(|e| !e.is_zero()))
    });
    out.blank();
    out.code(&format!("impl<S: Scalar> Elastic<N, S> for {target} {{"));
    out.indent();
    out.code(&format!("const LINKS: bool = {links};"));
    let deflection = module
        .functions()
        .find(|function| function.place.is_none() && function.name() == DEFLECTION.name());
    let margin = deflection.and_then(|function| function.solves().find_map(|solve| solve.margin));
    let bears = margin.map(|margin| margin.map(|most| most.to_f64()));
    out.code(&format!("const BEARS: Option<[f64; 2]> = {bears:?};"));
    out.code(INLINE);
    out.code("fn gives(&self, posture: &Posture<S>, wrench: &[S; 6]) -> Gives<S, N> {");
    out.indent();
    let taken = module.functions().find(|function| function.name() == GIVES);
    let loaded = taken.is_some_and(|function| !function.arguments.is_empty());
    let wrench = if loaded { ", wrench" } else { "" };
    if !loaded {
        out.code("let _ = wrench;");
    }
    out.code(&format!(
        "let {GIVES}::Gives {{ joints, tool }} = {GIVES}::given({constants}posture{wrench});"
    ));
    out.code("Gives { joints, tool }");
    for _ in 0..2 {
        out.dedent();
        out.code("}");
    }
}

fn method(out: &mut Lines, signature: &str, body: &str) {
    out.within(signature, "}", |out| out.code(body));
}
