//! The printer of CUDA C: the C printer's functions as a GPU's, and for each a kernel with one posture a thread.

use super::asked;
use super::c::comment::{FOR_CPP, harmless, plain};
use super::c::header::{sentences, structures};
use super::c::source::systems;
use super::c::{COptions, Module, Precision, Sines, SymbolicTable};
use super::cells::world;
use super::hash::provenance;
use super::legend::legend;
use super::lines::Lines;
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
/// [`SymbolicTable`] where a cell of the table is no number.
pub fn cuda(robot: &Robot, options: &CudaOptions) -> Result<String, SymbolicTable> {
    cuda_with(robot, &[], options)
}

/// The same with functions of one's own.
pub(crate) fn cuda_with(
    robot: &Robot,
    own: &[&Program],
    CudaOptions { name, precision }: &CudaOptions,
) -> Result<String, SymbolicTable> {
    let options = COptions { name: name.clone(), precision: *precision, sines: Sines::Math };
    let module = Module::new(robot, own, &options, true)?;
    let mut body = Lines::default();
    if module.ir.readings.moves {
        module.joints(&mut body);
    }
    for function in module.functions() {
        function.write_by_posture(&mut body);
        function.write_by_joints(&mut body);
        kernel(&module, function.of, &mut body);
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
}

/// The kernel of a function: each thread takes its posture out of the arrays and puts its result into them.
fn kernel(module: &Module, of: &Function, out: &mut Lines) {
    let (robot, name, real) = (module.name(), of.full_name(), module.language.real());
    let n = module.ir.robot.dof();
    // Name, how many numbers a posture has, whether all postures share it.
    let mut given = vec![("q", n, false)];
    given.extend(module.ir.readings.extras.iter().map(|extra| match extra {
        Extra::Sides => (extra.name(), n, false),
        Extra::Warming => (extra.name(), 1, true),
    }));
    let scalars: Vec<&str> =
        of.arguments.iter().filter(|a| a.size.is_none()).map(|a| &*a.name).collect();
    given.extend(of.arguments.iter().map(|a| (a.name.as_str(), a.size.unwrap_or(1), false)));
    let size = |block: &crate::derive::Block| {
        let (rows, columns) = block.held.shape(n);
        rows * columns
    };
    let written: Vec<(&str, String, usize)> = match of.blocks() {
        [block] => vec![("out", "result".to_owned(), size(block))],
        blocks => blocks
            .iter()
            .map(|block| (block.held.name(), format!("result.{}", block.held.name()), size(block)))
            .collect(),
    };
    let mut parameters = vec!["unsigned long long count".to_owned()];
    parameters.extend(given.iter().map(|(name, _, shared)| match shared {
        true => format!("{real} {name}"),
        false => format!("const {real} *{name}"),
    }));
    parameters.extend(written.iter().map(|(to, ..)| format!("{real} *{to}_of")));
    if of.fallible() {
        parameters.push("unsigned char *status_of".to_owned());
    }
    out.blank();
    out.comment(&sentences(module, of));
    out.code(&format!("__global__ void {robot}_{name}_batch({})", parameters.join(", ")));
    out.braces(|out| {
        out.code("const unsigned long long at =");
        out.code("    (unsigned long long)blockIdx.x * blockDim.x + threadIdx.x;");
        for (name, size, _) in given.iter().filter(|(.., shared)| !shared) {
            out.code(&format!("{real} {name}_at[{size}];"));
        }
        match of.blocks() {
            [_] => out.code(&format!("{real} result[{}];", written[0].2)),
            _ => out.code(&format!("{robot}_{name}_t result;")),
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
            each(out, *size, &format!("{name}_at[k] = {name}[k * count + at];"));
        }
        let arguments =
            given.iter().map(|(name, _, shared)| match (shared, scalars.contains(name)) {
                (true, _) => (*name).to_owned(),
                (false, true) => format!("{name}_at[0]"),
                (false, false) => format!("{name}_at"),
            });
        let result = if of.blocks().len() > 1 { "&result" } else { "result" };
        let arguments = arguments.chain([result.to_owned()]).collect::<Vec<_>>().join(", ");
        let call = format!("{robot}_{name}({arguments})");
        let put = |out: &mut Lines, fails: bool| {
            let blocks = of.blocks().iter().zip(&written);
            for (_, (to, from, size)) in
                blocks.filter(|(block, _)| super::c::may_fail(block) == fails)
            {
                each(out, *size, &format!("{to}_of[k * count + at] = {from}[k];"));
            }
        };
        if of.fallible() {
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
