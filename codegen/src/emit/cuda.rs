//! The printer of CUDA C: the C printer's functions as a GPU's, and for each a kernel with one posture a thread.

use super::c::comment::{FOR_CPP, harmless, plain};
use super::c::header::{sentences, structures};
use super::c::set_points;
use super::c::source::systems;
use super::c::{COptions, Module, Precision, Sines};
use super::cells::world;
use super::hash::provenance;
use super::legend::legend;
use super::lines::Lines;
use super::{NotWritten, asked};
use crate::derive::Program;
use crate::ir::{Extra, Function};
use crate::robot::Robot;

/// How the CUDA text is to be.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CudaOptions {
    /// What every name begins with: see [`c_name`](super::c_name).
    pub name: String,
    /// The numbers' type.
    pub precision: Precision,
}

/// The kernels of a robot as one file of CUDA C. The same table and options always give the same bytes.
///
/// # Errors
/// [`NotWritten`] where a cell of the table is no number.
pub fn cuda(robot: &Robot, options: &CudaOptions) -> Result<String, NotWritten> {
    cuda_with(robot, &[], options)
}

/// The same with functions of one's own.
pub(crate) fn cuda_with(
    robot: &Robot,
    own: &[&Program],
    CudaOptions { name, precision }: &CudaOptions,
) -> Result<String, NotWritten> {
    let options = COptions { name: name.clone(), precision: *precision, sines: Sines::Math };
    let module = Module::new(robot, own, &options, true)?;
    let mut body = Lines::default();
    if module.ir.readings.moves {
        module.joints(&mut body);
    }
    for function in module.functions() {
        function.write_by_posture(&mut body);
        function.write_by_joints(&mut body);
        kernel(&module, &Batch::of(&module, function.of), &mut body);
    }
    set_points::written(&module, &mut body);
    for (name, takes, branches) in set_points::functions(&module) {
        kernel(&module, &Batch::of_set_points(&module, name, takes, branches), &mut body);
    }
    let body = body.finish();
    let mut out = Lines::default();
    head(&module, *precision, &mut out);
    systems(&module, &body, &mut out);
    out.verbatim(&body);
    out.blank();
    out.verbatim(FOR_CPP[1]);
    Ok(out.finish())
}

fn head(module: &Module, precision: Precision, out: &mut Lines) {
    let (name, robot) = (module.name(), module.ir.robot);
    let precision = match precision {
        Precision::F32 => "f32",
        Precision::F64 => "f64",
    };
    let said = [
        format!("{}: closed-form kernels, CUDA C. {}", harmless(&robot.name), provenance(robot)),
        "Not to be edited; to compare this file with a table:".to_owned(),
        format!(
            "stiffarm generate ROBOT --emit cuda --name {name} --precision {precision}{} --check FILE",
            asked(robot)
        ),
        String::new(),
        "A kernel computes one posture a thread: start it with count threads or more. Number k of posture i stands at \
         x[k * count + i], in what is given and in what is written, so that the threads of a warp read neighbours. \
         A result is column-major: its number k is entry (k % ROWS, k / ROWS). Joint values are in rad (m), a wrench \
         in N and N*m at the tool's origin."
            .to_owned(),
        "Where status is not 0, the load leaves no stable equilibrium, or a joint moves no mass: what depends on it \
         is not written."
            .to_owned(),
        plain(&legend(&module.ir)),
    ];
    let world = world(robot).map(|world| plain(&world));
    out.comment(&said.into_iter().chain(world).collect::<Vec<_>>());
    out.blank();
    out.verbatim(FOR_CPP[0]);
    out.blank();
    let n = robot.dof();
    let define = |out: &mut Lines, name: &str, value: usize| {
        out.code(&format!("#define {} {value}U", module.constant(name)));
    };
    define(out, "JOINTS", n);
    for function in module.ir.functions() {
        let name = function.full_name().to_uppercase();
        for block in function.blocks() {
            let (rows, columns) = block.held.shape(n);
            let name = match (function.blocks(), function.own()) {
                ([_], _) => name.clone(),
                (_, Some(_)) => format!("{name}_{}", block.held.name().to_uppercase()),
                // Those of `all` are those of the functions by themselves.
                (_, None) => continue,
            };
            define(out, &format!("{name}_ROWS"), rows);
            define(out, &format!("{name}_SIZE"), rows * columns);
        }
    }
    out.blank();
    structures(module, out);
    set_points::declared(module, out);
}

/// What a kernel takes and writes.
struct Batch {
    name: String,
    said: Vec<String>,
    /// Name, how many numbers a posture has (none: one that is no array), whether all postures share it.
    given: Vec<(&'static str, Option<usize>, bool)>,
    arguments: Vec<(String, Option<usize>)>,
    /// Name, how many numbers, whether the load decides on them.
    written: Vec<(String, usize, bool)>,
    fallible: bool,
}

impl Batch {
    fn of(module: &Module, of: &Function) -> Batch {
        let n = module.ir.robot.dof();
        let written = of.blocks().iter().map(|block| {
            let (rows, columns) = block.held.shape(n);
            let name = if of.blocks().len() > 1 { block.held.name() } else { "out" };
            (name.to_owned(), rows * columns, super::c::may_fail(block))
        });
        Batch {
            name: of.full_name(),
            said: sentences(module, of),
            given: given(module),
            arguments: of.arguments.iter().map(|a| (a.name.clone(), a.size)).collect(),
            written: written.collect(),
            fallible: of.fallible(),
        }
    }

    /// Of the arm as it is.
    fn of_set_points(
        module: &Module,
        name: &str,
        takes: Vec<(&str, usize)>,
        branches: usize,
    ) -> Batch {
        let q = ("q", module.ir.robot.dof() * branches);
        let written = [q, ("distance", branches), ("tilt", branches)];
        Batch {
            name: name.to_owned(),
            said: vec!["Every branch of the arm as it is.".to_owned()],
            given: given(module),
            arguments: takes.into_iter().map(|(a, size)| (a.to_owned(), Some(size))).collect(),
            written: written.map(|(name, size)| (name.to_owned(), size, false)).to_vec(),
            fallible: false,
        }
    }
}

/// Readings, and what is given beside them.
fn given(module: &Module) -> Vec<(&'static str, Option<usize>, bool)> {
    let n = module.ir.robot.dof();
    let extras = module.ir.readings.extras.iter().map(|extra| match extra {
        Extra::Sides => (extra.name(), Some(n), false),
        Extra::Warming => (extra.name(), None, true),
    });
    core::iter::once(("q", Some(n), false)).chain(extras).collect()
}

/// Each thread takes its posture out of the arrays and puts its result into them.
fn kernel(module: &Module, of: &Batch, out: &mut Lines) {
    let (robot, name, real) = (module.name(), &of.name, module.language.real());
    let own = of.arguments.iter().map(|(name, size)| (name.as_str(), *size, false));
    let given: Vec<_> = of.given.iter().copied().chain(own).collect();
    let single = of.written.len() == 1;
    let mut parameters = vec!["unsigned long long count".to_owned()];
    parameters.extend(given.iter().map(|(name, _, shared)| match shared {
        true => format!("{real} {name}"),
        false => format!("const {real} *{name}"),
    }));
    parameters.extend(of.written.iter().map(|(to, ..)| format!("{real} *{to}_of")));
    if of.fallible {
        parameters.push("unsigned char *status_of".to_owned());
    }
    out.blank();
    out.comment(&of.said);
    out.code(&format!("__global__ void {robot}_{name}_batch({})", parameters.join(", ")));
    out.braces(|out| {
        out.code("const unsigned long long at =");
        out.code("    (unsigned long long)blockIdx.x * blockDim.x + threadIdx.x;");
        for (name, size, _) in given.iter().filter(|(.., shared)| !shared) {
            out.code(&format!("{real} {name}_at[{}];", size.unwrap_or(1)));
        }
        match single {
            true => out.code(&format!("{real} result[{}];", of.written[0].1)),
            false => out.code(&format!("{robot}_{name}_t result;")),
        }
        out.code("unsigned int k;");
        out.blank();
        out.code("if (at >= count)");
        out.braces(|out| out.code("return;"));
        let each = |out: &mut Lines, size: usize, text: &str| {
            out.code(&format!("for (k = 0U; k < {size}U; k++)"));
            out.braces(|out| out.code(text));
        };
        for (name, size, _) in given.iter().filter(|(.., shared)| !shared) {
            each(out, size.unwrap_or(1), &format!("{name}_at[k] = {name}[k * count + at];"));
        }
        let arguments = given.iter().map(|(name, size, shared)| match (shared, size) {
            (true, _) => (*name).to_owned(),
            (false, None) => format!("{name}_at[0]"),
            (false, Some(_)) => format!("{name}_at"),
        });
        let result = if single { "result" } else { "&result" };
        let arguments = arguments.chain([result.to_owned()]).collect::<Vec<_>>().join(", ");
        let call = format!("{robot}_{name}({arguments})");
        let put = |out: &mut Lines, load: bool| {
            for (to, size, _) in of.written.iter().filter(|(.., fails)| *fails == load) {
                let from = if single { "result".to_owned() } else { format!("result.{to}") };
                each(out, *size, &format!("{to}_of[k * count + at] = {from}[k];"));
            }
        };
        if of.fallible {
            out.code(&format!("status_of[at] = (unsigned char){call};"));
            put(out, false);
            out.code("if (status_of[at] == 0U)");
            out.braces(|out| put(out, true));
        } else {
            out.code(&format!("{call};"));
            put(out, false);
        }
    });
}
