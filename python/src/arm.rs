//! An arm that Python holds.

mod evaluate;
mod method;
mod methods;
mod single;

use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

use nalgebra::Vector6;
use numpy::{PyArrayMethods, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use stiffarm_cli::host::Host;
use stiffarm_cli::{RobotArgs, Source};
use stiffarm_codegen::derive::Given;
use stiffarm_codegen::robot::{Asked, Motion, Refused};
use stiffarm_gap::whole::{Situation, Whole};
use stiffarm_kernels::generic::Joint;
use stiffarm_kernels::{Input, Output, Side};

use crate::arrays::{self, numbers, shape};
use crate::compiled::{self, Library};
use crate::engine::Engines;
use crate::inverse::{Found, Inverse};
use crate::work;
use evaluate::Beside;

/// A joint and the link that it moves, as numbers of the table.
#[pyclass(frozen, get_all, module = "stiffarm._native")]
pub struct Row {
    /// Of its spring, N·m/rad (N/m); None of a rigid one.
    stiffness: Option<f64>,
    /// Mass of the link, kg.
    mass: f64,
    /// Its centre of mass in the row's frame, m.
    com: [f64; 3],
    /// Its tensor of inertia about that centre in the row's axes, kg·m².
    inertia: [[f64; 3]; 3],
    /// What turns with the motor, as the joint feels it, kg·m² (kg).
    armature: f64,
    /// Dry friction, N·m (N).
    coulomb: f64,
    /// Friction in proportion to the rate, N·m·s/rad (N·s/m).
    viscous: f64,
}

impl Row {
    fn of(joint: &Joint) -> Row {
        let drive = &joint.drive;
        Row {
            stiffness: (joint.compliance > 0.0).then(|| 1.0 / joint.compliance),
            mass: joint.mass,
            com: joint.com.into(),
            inertia: joint.inertia.into(),
            armature: drive.gear.powi(2) * drive.rotor_inertia,
            coulomb: drive.coulomb,
            viscous: drive.viscous,
        }
    }
}

/// An arm: its robot file, and what computes its outputs.
#[pyclass(frozen, subclass, module = "stiffarm._native")]
pub struct Arm {
    source: Source,
    text: String,
    engines: Engines,
    /// By what is given of seven joints.
    inverse: Mutex<HashMap<Option<String>, Arc<Inverse>>>,
}

#[pymethods]
impl Arm {
    /// `given`: a path, the id of a built-in robot, or any name of a `text`; `set`: numbers for symbolic parameters,
    /// NAME=VALUE each.
    #[new]
    fn new(
        py: Python<'_>,
        given: String,
        text: Option<Vec<u8>>,
        set: Vec<String>,
        hear: &Bound<'_, PyAny>,
    ) -> PyResult<Arm> {
        let files: HashMap<_, _> = text.map(|text| (given.clone(), text)).into_iter().collect();
        let host = Host::new(Vec::new(), files);
        let is_set = !set.is_empty();
        let (source, robot, table) = work::wait(
            py,
            &host,
            hear,
            |_, _| {},
            move |host| {
                host.run(|| {
                    let source = RobotArgs::named(&given).set(set).load(host)?;
                    let (robot, table) = (source.for_kernels()?, source.arm()?);
                    Ok((source, robot, table))
                })
            },
        )?;
        let id = (source.built_in && !is_set).then_some(source.given.as_str());
        let engines = Engines::new(robot, table, id.and_then(stiffarm_robots::arm));
        let text = if is_set { source.robot.to_toml() } else { source.text.clone() };
        Ok(Arm { source, text, engines, inverse: Mutex::default() })
    }

    /// The arm's name.
    #[getter]
    fn name(&self) -> &str {
        &self.source.robot.name
    }

    /// Number of joints.
    #[getter]
    fn dof(&self) -> usize {
        self.source.robot.dof()
    }

    /// As it was named: a path, an id, or a name.
    #[getter]
    fn given(&self) -> &str {
        &self.source.given
    }

    /// Whether it is one of the collection, as it is there.
    #[getter]
    fn built_in(&self) -> bool {
        self.source.built_in && self.text == self.source.text
    }

    /// The robot file (TOML).
    #[getter]
    fn toml(&self) -> &str {
        &self.text
    }

    /// The labels of the table's rows, base to tip.
    #[getter]
    fn joint_names(&self) -> Vec<&str> {
        self.source.robot.joints.iter().map(|joint| joint.name.as_str()).collect()
    }

    /// `revolute` or `prismatic`, base to tip.
    #[getter]
    fn joint_types(&self) -> Vec<&'static str> {
        let of = |motion| match motion {
            Motion::Revolute => "revolute",
            Motion::Prismatic => "prismatic",
        };
        self.source.robot.joints.iter().map(|joint| of(joint.motion)).collect()
    }

    /// What the table says of each joint and its link beyond geometry.
    #[getter]
    fn rows(&self) -> Vec<Row> {
        self.engines.table().joints.iter().map(Row::of).collect()
    }

    /// The joints' limits, rad (m); None where the file has none.
    #[getter]
    fn limits(&self) -> Vec<Option<[f64; 2]>> {
        self.source.robot.joints.iter().map(|joint| joint.limits).collect()
    }

    /// The effects that the file holds beyond its table: identifier and place of each.
    #[getter]
    fn effects(&self) -> Vec<(&'static str, String)> {
        let known = self.source.known.iter();
        known.map(|known| (known.effect.identifier(), known.spot.place.to_string())).collect()
    }

    /// The names of the file's frames and markers, at which outputs can be told.
    #[getter]
    fn places(&self) -> Vec<&str> {
        let robot = &self.source.robot;
        let frames = robot.frames.iter().map(|frame| frame.name.as_str());
        frames.chain(robot.markers.iter().map(|marker| marker.name.as_str())).collect()
    }

    /// What computes an output, of the tool or at a frame or marker: kernels, c, textbook or graph.
    #[pyo3(signature = (output, at=None))]
    fn engine(&self, output: &str, at: Option<String>) -> PyResult<&'static str> {
        Ok(self.engines.of(&self.asked(named(output)?, at)?).name())
    }

    /// The C that `load_c` takes when it is compiled to a shared library.
    fn c_source(&self) -> PyResult<String> {
        compiled::source(self.engines.robot()).map_err(PyValueError::new_err)
    }

    /// Takes compiled C for every output that it has, once it was compared with what computed them before.
    fn load_c(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        let taken = py.detach(|| {
            let library = Library::load(&path, self.engines.robot())?;
            self.engines.take(library)
        });
        taken.map_err(|error| PyValueError::new_err(format!("{}: {error}", path.display())))
    }

    /// Every branch of the inverse kinematics at one pose or many (4, 4), near readings `near`; of the loaded arm where there is a
    /// `wrench` (6,), base axes; `kept` is what is given of seven joints, `elbow_angle` that angle where it is not near's.
    #[pyo3(signature = (pose, near=None, wrench=None, sides=None, warming=None, kept=None, elbow_angle=None))]
    #[allow(clippy::too_many_arguments, reason = "they are those of the method in Python")]
    fn branches<'py>(
        &self,
        py: Python<'py>,
        pose: &Bound<'py, PyAny>,
        near: Option<&Bound<'py, PyAny>>,
        wrench: Option<[f64; 6]>,
        sides: Option<&Bound<'py, PyAny>>,
        warming: Option<f64>,
        kept: Option<String>,
        elbow_angle: Option<f64>,
    ) -> PyResult<Found<'py>> {
        let mut given = self.given_beside(py, sides, warming)?;
        given.elbow_angle = elbow_angle;
        let found = || -> Result<Arc<Inverse>, String> {
            let mut known = self.inverse.lock().unwrap_or_else(PoisonError::into_inner);
            if let Some(inverse) = known.get(&kept) {
                return Ok(Arc::clone(inverse));
            }
            let inverse = Arc::new(Inverse::new(self.engines.robot(), kept.as_deref())?);
            known.insert(kept.clone(), Arc::clone(&inverse));
            Ok(inverse)
        };
        let inverse = py.detach(found).map_err(PyValueError::new_err)?;
        inverse.found(py, pose, near, (wrench, &given))
    }

    /// An output at one pose or many.
    ///
    /// `inputs` are the arrays that it takes of the joints, `wrench` and `out` what they are called; `sides` (n,) and
    /// `warming` what a corrected arm may depend on; `at` the frame or marker that it is told of in the tool's place.
    #[pyo3(signature = (output, inputs, wrench=None, out=None, sides=None, warming=None, at=None))]
    #[allow(clippy::too_many_arguments, reason = "they are those of the methods in Python")]
    fn evaluate<'py>(
        &self,
        py: Python<'py>,
        output: &str,
        inputs: Vec<Bound<'py, PyAny>>,
        wrench: Option<&Bound<'py, PyAny>>,
        out: Option<&Bound<'py, PyAny>>,
        sides: Option<&Bound<'py, PyAny>>,
        warming: Option<f64>,
        at: Option<String>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let inputs: Vec<_> = inputs.iter().collect();
        self.tell(py, named(output)?, &inputs, wrench, Beside { out, sides, warming, at })
    }
}

impl Arm {
    fn asked(&self, output: Output, at: Option<String>) -> PyResult<Asked> {
        let refused = |no: Refused| PyValueError::new_err(format!("{}: {}", no.message, no.help));
        self.engines.asked(output, at).map_err(refused)
    }

    /// What is said beside posture and load: all that the arm's effects depend on.
    fn given_beside(
        &self,
        py: Python<'_>,
        sides: Option<&Bound<'_, PyAny>>,
        warming: Option<f64>,
    ) -> PyResult<Given> {
        if !warming.unwrap_or_default().is_finite() {
            return Err(PyValueError::new_err("warming: expected a finite number"));
        }
        let sides = match sides {
            None => Vec::new(),
            Some(sides) => {
                let (array, _) = numbers("sides", sides)?;
                if array.shape() != [self.dof()] {
                    let (found, n) = (shape(array.shape()), self.dof());
                    let text = format!("sides: found the shape {found}, expected ({n},)");
                    return Err(PyValueError::new_err(text));
                }
                let sides = array.try_readonly()?.as_slice()?.to_vec();
                if !sides.iter().all(|side| [-1.0, 0.0, 1.0].contains(side)) {
                    return Err(PyValueError::new_err("sides: expected -1, 0 or 1 for each joint"));
                }
                sides
            }
        };
        if !self.source.known.is_empty() {
            let at = Situation {
                direction: (!sides.is_empty()).then(|| sides.iter().map(|s| *s as i8).collect()),
                warming,
                ..Situation::under(Vector6::zeros())
            };
            let whole = Whole { arm: self.engines.table(), known: &self.source.known };
            let decided = self.source.refuse_undecided("evaluate", &whole, &at);
            decided.map_err(|failure| work::error(py, &failure))?;
        }
        Ok(Given { sides, warming: warming.unwrap_or_default(), ..Given::default() })
    }
}

/// The output of that name.
fn named(output: &str) -> PyResult<Output> {
    let found = Output::EACH.into_iter().find(|known| known.name() == output);
    found.ok_or_else(|| {
        let known: Vec<&str> = Output::EACH.iter().map(|known| known.name()).collect();
        let known = known.join(", ");
        PyValueError::new_err(format!("found the output `{output}`, expected one of {known}"))
    })
}

/// What an output is: name, sentence, formula, arguments of the joints, whether it takes a wrench, the shape and the
/// units of its result in words.
type Described = (String, String, String, Vec<(String, String)>, bool, String);

/// Every output.
#[pyfunction]
pub fn outputs() -> Vec<Described> {
    let of = |output: Output| {
        let joints = output.inputs().iter().filter(|input| input.side() == Side::Joints);
        let joints = joints.map(|input| (input.name().to_owned(), input.sentence().to_owned()));
        (
            output.name().to_owned(),
            output.sentence().to_owned(),
            output.formula().to_owned(),
            joints.collect(),
            output.takes(Input::Wrench),
            arrays::described(output),
        )
    };
    Output::EACH.into_iter().map(of).collect()
}

/// Identifiers of the built-in arms that have numbers for every parameter.
#[pyfunction]
pub fn robots() -> Vec<&'static str> {
    stiffarm_robots::ARMS.iter().map(|arm| arm.id).collect()
}
