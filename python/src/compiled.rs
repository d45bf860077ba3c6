//! C that was printed for an arm, compiled by the machine's compiler, and loaded.
//!
//! The one place of this package that is not safe: whoever loads a library must trust what is in it. It is the text of
//! [`source`], whose functions have the one type that is asked for here.

use std::fmt::Write as _;
use std::path::Path;

use libloading::{Library as Loaded, Symbol};
use stiffarm_codegen::derive::{AnyBranch, Given, any_arm};
use stiffarm_codegen::emit::{COptions, Precision, Sines, c};
use stiffarm_codegen::robot::{Asked, Family, Robot};
use stiffarm_kernels::batch::{self, Wrenches};
use stiffarm_kernels::{Input, Output, Pose};

use crate::engine::{Engine, Engines, Poses, Unstable};

/// What every name in the text begins with.
const NAME: &str = "arm";

/// The inverse kinematics of the rigid arm and of the loaded one, behind the arm's name.
pub const INVERSE: [&str; 2] = ["inverse_kinematics", "set_points"];

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

/// Postures and a wrench at which compiled C is compared.
const POSES: usize = 8;
const LOAD: [f64; 6] = [3.0, -2.0, 5.0, 0.3, 0.2, -0.1];

/// Fractions of the golden ratio, spread evenly over half a turn either way.
fn spread(k: usize) -> f64 {
    3.0 * ((0.3 + 0.618_034 * k as f64).fract() - 0.5)
}

/// C that was loaded.
pub struct Library {
    // Dropped after the functions, which it holds.
    functions: Vec<(Asked, Function)>,
    /// [`INVERSE`], and how many branches they have.
    inverse: Option<([Function; 2], usize)>,
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

/// The robot with its inverse kinematics, where that is a function of readings and a pose alone, and with what that takes.
fn with_inverse(robot: &Robot) -> Robot {
    let form = robot.nearest_closed_form().ok();
    let inverse_kinematics = form.filter(|form| form.family != Family::ElbowAngle);
    let mut robot = Robot { inverse_kinematics, ..robot.clone() };
    if inverse_kinematics.is_some() && !robot.outputs.is_empty() {
        robot.outputs.extend([Output::Pose, Output::DeflectionWithGravity]);
    }
    robot
}

/// The text: the kernels as one source, and for each output and the inverse kinematics a loop over poses.
pub fn source(robot: &Robot) -> Result<String, String> {
    let robot = &with_inverse(robot);
    let options =
        COptions { name: NAME.to_owned(), precision: Precision::F64, sines: Sines::Polynomial };
    let files = c(robot, &options).map_err(|error| error.to_string())?;
    let include = format!("#include \"{NAME}.h\"");
    let mut text = files.source.replacen(&include, &files.header, 1);
    let takes = |argument: &str| files.header.contains(argument);
    let n = robot.dof();
    text.push_str("\n#include <stddef.h>\n#include <string.h>\n#ifdef _WIN32\n#define LOOP __declspec(dllexport) size_t\n#else\n#define LOOP size_t\n#endif\n");
    let sides = takes("double sides[").then(|| "given".to_owned());
    let given = sides.into_iter().chain(takes("double warming").then(|| format!("given[{n}]")));
    let given: Vec<String> = given.collect();
    for asked in compiled(robot) {
        let output = asked.output;
        let mut arguments = [&["q".to_owned()], &given[..]].concat();
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
        write_loop(&mut text, &name, [output.state(n), rows * columns], &step);
    }
    if let Some(form) = robot.inverse_kinematics {
        let given: String = given.iter().map(|each| format!(", {each}")).collect();
        for (name, wrench) in INVERSE.into_iter().zip(["", ", wrench"]) {
            let step = format!(
                "{NAME}_{name}_t found;\n        {NAME}_{name}(q{given}, q + {n}{wrench}, &found);\n        \
                 memcpy(out, &found, sizeof found);"
            );
            write_loop(&mut text, name, [n + 12, form.branches() * (n + 2)], &step);
        }
    }
    Ok(text)
}

/// A loop over poses, by so many numbers of each pose and of each result.
fn write_loop(text: &mut String, name: &str, [takes, gives]: [usize; 2], step: &str) {
    // Writing into a `String` cannot fail.
    let _ = write!(
        text,
        "\nLOOP loop_{name}(size_t n, const double *q, const double *wrench, size_t stride, const double *given, \
         double *out, size_t *first);\nLOOP loop_{name}(size_t n, const double *q, const double *wrench, size_t stride, const double \
         *given, double *out, size_t *first)\n{{\n    size_t k, failed = 0;\n    (void)wrench; (void)given; (void)first;\n    \
         for (k = 0; k < n; k++, q += {takes}, wrench += stride, out += {gives})\n    {{\n        {step}\n    \
         }}\n    return failed;\n}}\n",
    );
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
        let robot = with_inverse(robot);
        let function = |name: &str| {
            let name = format!("loop_{name}");
            // SAFETY: `source` writes every function of this type.
            let function: Result<Symbol<'_, Function>, _> = unsafe { loaded.get(name.as_bytes()) };
            function.map(|function| *function).map_err(|error| error.to_string())
        };
        let mut functions = Vec::new();
        for asked in compiled(&robot) {
            let found = function(&called(&asked))?;
            functions.push((asked, found));
        }
        let inverse = match robot.inverse_kinematics {
            Some(form) => {
                let [rigid, loaded] = INVERSE.map(function);
                Some(([rigid?, loaded?], form.branches()))
            }
            None => None,
        };
        Ok(Library { functions, inverse, dof: robot.dof(), _loaded: loaded })
    }

    /// Whether it computes an output.
    pub fn has(&self, asked: &Asked) -> bool {
        self.functions.iter().any(|(known, _)| known == asked)
    }

    /// Whether it has the inverse kinematics.
    pub fn has_inverse(&self) -> bool {
        self.inverse.is_some()
    }

    /// Writes the blocks of all poses.
    pub fn evaluate(&self, asked: &Asked, poses: Poses<'_>, out: &mut [f64]) -> Unstable {
        let (_, function) = self.functions.iter().find(|(known, _)| known == asked)?;
        let (rows, columns) = asked.output.shape(self.dof);
        self.call(*function, [asked.output.state(self.dof), rows * columns], poses, out)
    }

    /// What the inverse kinematics writes of a pose near readings, and the set-points under a wrench, where it has them.
    pub fn inverse(
        &self,
        (near, pose): (&[f64], &Pose<f64>),
        wrench: Option<&[f64; 6]>,
        given: &Given,
    ) -> Option<Vec<f64>> {
        let ([rigid, loaded], branches) = self.inverse?;
        let function = if wrench.is_some() { loaded } else { rigid };
        let states = &[near, pose.columns().as_flattened()].concat();
        let wrenches = Wrenches::One(wrench.unwrap_or(&[0.0; 6]));
        let mut out = vec![0.0; branches * (self.dof + 2)];
        let poses = Poses { count: 1, states, wrenches, given };
        // What does not bear its load is told as out of reach.
        let _ = self.call(function, [self.dof + 12, out.len()], poses, &mut out);
        Some(out)
    }

    #[allow(unsafe_code, reason = "a call to what was loaded")]
    fn call(
        &self,
        function: Function,
        [takes, gives]: [usize; 2],
        poses: Poses<'_>,
        out: &mut [f64],
    ) -> Unstable {
        let (wrench, stride): (&[f64], usize) = match poses.wrenches {
            Wrenches::One(wrench) => (wrench, 0),
            Wrenches::Each(each) => (each, 6),
        };
        assert_eq!(poses.states.len(), poses.count * takes);
        assert_eq!(out.len(), poses.count * gives);
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
        // Half of the digits: a wrong text or compiler is farther off, and what rounds is nearer, through the solution of
        // a system whose condition is 1e7, too.
        const HALF: f64 = 1.5e-8;
        let wrench = LOAD;
        let given = Given::default();
        let nominal = arm.robot().effects.is_empty();
        for (asked, _) in &self.functions {
            let output = asked.output;
            let known = arm.asked(output, asked.at.clone()).map_err(|no| no.message)?;
            let textbook = nominal && asked.at.is_none();
            let plain = if textbook { Engine::Textbook } else { Engine::Graph };
            let (size, (rows, columns)) = (output.state(self.dof), output.shape(self.dof));
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
        self.inverse_agrees(arm)
    }

    /// The same of the inverse kinematics: of branches that both bring to the pose. What C does not bring there counts for nothing.
    fn inverse_agrees(&self, arm: &Engines) -> Result<(), String> {
        // What steps leave of a pose at most, m and rad, and how far apart branches may be that leave it: of a Jacobian whose
        // condition is 1e4 too.
        const LEFT: f64 = 1e-10;
        const APART: f64 = 1e-6;
        let form = self.inverse.and_then(|_| arm.robot().nearest_closed_form().ok());
        let Some(form) = form else { return Ok(()) };
        let (plain, given) = (any_arm(arm.robot(), form), Given::default());
        let forward = arm.asked(Output::Pose, None).map_err(|no| no.message)?;
        for k in 0..2 * POSES {
            let near: Vec<f64> = (0..self.dof).map(|joint| spread(k * self.dof + joint)).collect();
            let poses =
                Poses { count: 1, states: &near, wrenches: Wrenches::One(&LOAD), given: &given };
            let mut at = [0.0; 12];
            arm.by(Engine::Graph, &forward, poses, &mut at).map_err(|error| error.to_string())?;
            let axis = |k: usize| core::array::from_fn(|row| at[3 * k + row]);
            let pose = Pose { rotation: [axis(0), axis(1), axis(2)], position: axis(3) };
            let wrench = (k >= POSES).then_some(&LOAD);
            let Some(ours) = self.inverse((&near, &pose), wrench, &given) else { return Ok(()) };
            let [ours, theirs] = [Some(&ours[..]), None]
                .map(|told| plain.branches(&given, &pose, &near, wrench, told));
            let reached = |branch: &AnyBranch| branch.distance.max(branch.tilt) <= LEFT;
            let mut both = ours.iter().zip(&theirs).filter(|(a, b)| reached(a) && reached(b));
            if both.any(|(a, b)| a.q.iter().zip(&b.q).any(|(a, b)| (a - b).abs() > APART)) {
                let name = INVERSE[usize::from(wrench.is_some())];
                return Err(format!("{name} as it was compiled is not what the graph gives"));
            }
        }
        Ok(())
    }
}
