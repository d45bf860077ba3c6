//! C that was printed for an arm, compiled by the machine's compiler, and loaded.
//!
//! The one place of this package that is not safe: whoever loads a library must trust what is in it. It is the text of
//! [`source`], whose functions have the one type that is asked for here.

use std::fmt::Write as _;
use std::path::Path;

use libloading::{Library as Loaded, Symbol};
use stiffarm_codegen::derive::Given;
use stiffarm_codegen::emit::{COptions, Precision, Sines, c};
use stiffarm_codegen::robot::{Asked, Robot};
use stiffarm_kernels::Input;
use stiffarm_kernels::batch::{self, Wrenches};

use crate::engine::{Engine, Engines, Poses, Unstable};

/// What every name in the text begins with.
const NAME: &str = "arm";

/// Poses, their states and wrenches, from one wrench to the next, sides and warming, blocks, the first unstable
/// pose; how many there are.
type Function = unsafe extern "C" fn(
    usize,
    *const f64,
    *const f64,
    usize,
    *const f64,
    *mut f64,
    *mut usize,
) -> usize;

/// C that was loaded.
pub struct Library {
    // Dropped after the functions, which it holds.
    functions: Vec<(Asked, Function)>,
    dof: usize,
    _loaded: Loaded,
}

/// What there is C of: every output of the tool, and what the robot file asks for at its frames and markers.
fn compiled(robot: &Robot) -> Vec<Asked> {
    let tool = robot.generated().into_iter().map(|output| Asked { output, at: None });
    let places = robot.places().into_iter().flat_map(|(place, outputs)| {
        outputs.into_iter().map(move |output| Asked { output, at: Some(place.to_owned()) })
    });
    tool.chain(places).collect()
}

/// What its function is called behind the arm's name: `jacobian`, `at_elbow_jacobian`.
fn called(asked: &Asked) -> String {
    let at = asked.at.as_ref().map_or_else(String::new, |at| format!("at_{at}_"));
    format!("{at}{}", asked.output.name())
}

/// The text: the kernels as one source, and for each output a loop over poses.
pub fn source(robot: &Robot) -> Result<String, String> {
    let robot = &Robot { inverse_kinematics: None, ..robot.clone() };
    let options =
        COptions { name: NAME.to_owned(), precision: Precision::F64, sines: Sines::Polynomial };
    let files = c(robot, &options).map_err(|error| error.to_string())?;
    let include = format!("#include \"{NAME}.h\"");
    let mut text = files.source.replacen(&include, &files.header, 1);
    let takes = |argument: &str| files.header.contains(argument);
    let n = robot.dof();
    text.push_str("\n#include <stddef.h>\n#ifdef _WIN32\n#define LOOP __declspec(dllexport) size_t\n#else\n#define LOOP size_t\n#endif\n");
    for asked in compiled(robot) {
        let output = asked.output;
        let mut arguments = vec!["q".to_owned()];
        if takes("double sides[") {
            arguments.push("given".to_owned());
        }
        if takes("double warming") {
            arguments.push(format!("given[{n}]"));
        }
        for (k, input) in output.beside().enumerate() {
            arguments.push(match input {
                Input::Wrench => "wrench".to_owned(),
                _ => format!("q + {}", (k + 1) * n),
            });
        }
        arguments.push("out".to_owned());
        let (name, (rows, columns)) = (called(&asked), output.shape(n));
        let call = format!("{NAME}_{name}({})", arguments.join(", "));
        let step = match output.is_fallible() {
            true => format!("if ({call} != ARM_OK && failed++ == 0) {{ *first = k; }}"),
            false => format!("{call};"),
        };
        // Writing into a `String` cannot fail.
        let _ = write!(
            text,
            "\nLOOP loop_{name}(size_t n, const double *q, const double *wrench, size_t stride, const double *given, \
             double *out, size_t *first);\nLOOP loop_{name}(size_t n, const double *q, const double *wrench, size_t stride, const double \
             *given, double *out, size_t *first)\n{{\n    size_t k, failed = 0;\n    (void)wrench; (void)given; (void)first;\n    \
             for (k = 0; k < n; k++, q += {}, wrench += stride, out += {})\n    {{\n        {step}\n    \
             }}\n    return failed;\n}}\n",
            output.state(n),
            rows * columns,
        );
    }
    Ok(text)
}

impl Library {
    /// Loads what a compiler made of the text of [`source`] of this robot.
    #[allow(
        unsafe_code,
        reason = "loading runs what is in the library: kernels, and nothing before"
    )]
    pub fn load(path: &Path, robot: &Robot) -> Result<Library, String> {
        // SAFETY: the library was compiled of the text of `source`: it initialises nothing.
        let loaded = unsafe { Loaded::new(path) }.map_err(|error| error.to_string())?;
        let mut functions = Vec::new();
        for asked in compiled(robot) {
            let name = format!("loop_{}", called(&asked));
            // SAFETY: `source` writes every function of this type.
            let function: Symbol<'_, Function> =
                unsafe { loaded.get(name.as_bytes()) }.map_err(|error| error.to_string())?;
            functions.push((asked, *function));
        }
        Ok(Library { functions, dof: robot.dof(), _loaded: loaded })
    }

    /// Whether it computes an output.
    pub fn has(&self, asked: &Asked) -> bool {
        self.functions.iter().any(|(known, _)| known == asked)
    }

    /// Writes the blocks of all poses.
    #[allow(unsafe_code, reason = "a call to what was loaded")]
    pub fn evaluate(&self, asked: &Asked, poses: Poses<'_>, out: &mut [f64]) -> Unstable {
        let (_, function) = self.functions.iter().find(|(known, _)| known == asked)?;
        let output = asked.output;
        let (rows, columns) = output.shape(self.dof);
        let (wrench, stride): (&[f64], usize) = match poses.wrenches {
            Wrenches::One(wrench) => (wrench, 0),
            Wrenches::Each(each) => (each, 6),
        };
        assert_eq!(poses.states.len(), poses.count * output.state(self.dof));
        assert_eq!(out.len(), poses.count * rows * columns);
        assert!(wrench.len() >= 6 || poses.count == 0);
        let mut given = poses.given.sides.clone();
        given.resize(self.dof, 0.0);
        given.push(poses.given.warming);
        let mut first = 0;
        // SAFETY: the lengths are those that the text walks through, as was asserted; it writes to `out` and
        // `first` alone, and keeps nothing.
        let failed = unsafe {
            function(
                poses.count,
                poses.states.as_ptr(),
                wrench.as_ptr(),
                stride,
                given.as_ptr(),
                out.as_mut_ptr(),
                &raw mut first,
            )
        };
        (failed > 0).then_some((first, failed))
    }

    /// Whether it gives what the arm gives without it, at some postures under some load.
    pub fn agrees(&self, arm: &Engines) -> Result<(), String> {
        const POSES: usize = 8;
        // Half of the digits: a wrong text or compiler is farther off, and what rounds is nearer, through the solution of
        // a system whose condition is 1e7, too.
        const HALF: f64 = 1.5e-8;
        let wrench = [3.0, -2.0, 5.0, 0.3, 0.2, -0.1];
        let given = Given::default();
        let nominal = arm.robot().effects.is_empty();
        for (asked, _) in &self.functions {
            let output = asked.output;
            let known = arm.asked(output, asked.at.clone()).map_err(|no| no.message)?;
            let textbook = nominal && asked.at.is_none();
            let plain = if textbook { Engine::Textbook } else { Engine::Graph };
            let (size, (rows, columns)) = (output.state(self.dof), output.shape(self.dof));
            // Fractions of the golden ratio, spread evenly over half a turn either way.
            let spread = |k: usize| 3.0 * ((0.3 + 0.618_034 * k as f64).fract() - 0.5);
            let states: Vec<f64> = (0..POSES * size).map(spread).collect();
            let wrenches = Wrenches::One(&wrench);
            let poses = Poses { count: POSES, states: &states, wrenches, given: &given };
            let mut blocks = [vec![0.0; POSES * rows * columns], vec![0.0; POSES * rows * columns]];
            let [ours, theirs] = &mut blocks;
            let here = self.evaluate(asked, poses, ours);
            let there = match arm.by(plain, &known, poses, theirs) {
                Err(batch::Error::Unstable { first, count }) => Some((first, count)),
                _ => None,
            };
            let largest = theirs.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
            let near = |(a, b): (&f64, &f64)| (a - b).abs() <= HALF * largest;
            if here != there || !ours.iter().zip(theirs.iter()).all(near) {
                let (name, engine) = (called(asked), plain.name());
                return Err(format!("{name} as it was compiled is not what the {engine} gives"));
            }
        }
        Ok(())
    }
}
