//! What a map is of.

use clap::ValueEnum;
use nalgebra::{Vector3, Vector6};
use stiffarm_gap::DiagnoseError;
use stiffarm_gap::measurement::Dimension;
use stiffarm_gap::whole::{Situation, Whole};
use stiffarm_kernels::generic::Arm;
use stiffarm_kernels::{Output, Unstable};
use stiffarm_study::dexterity::{
    DexterityError, Search, characteristic_length, influence, inverse_condition,
};

use super::learnt::Learnt;
use crate::input::quantity;
use crate::input::wrench::wrench;
use crate::terminal::failure::Failure;

/// A quantity by its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Of {
    /// 1/κ of the Jacobian: dexterity
    Condition,
    /// What K_C changes in the displacement, as a part of it
    #[value(name = "nu_p")]
    NuP,
    /// What K_C changes in the rotations, the largest of three
    #[value(name = "nu_r")]
    NuR,
    /// Length of the displacement
    Deflection,
    /// Force over displacement in its direction
    Stiffness,
    /// How much of the gap the findings of a diagnosis take away
    Shrink,
}

/// Why a posture has no value.
pub enum NoValue {
    /// The arm is not stable there.
    Unstable,
    /// Anything else, in words.
    Wrong(String),
}

impl From<DexterityError> for NoValue {
    fn from(error: DexterityError) -> Self {
        match error {
            DexterityError::Unstable(_) => Self::Unstable,
            error => Self::Wrong(error.to_string()),
        }
    }
}

impl From<Unstable> for NoValue {
    fn from(_: Unstable) -> Self {
        Self::Unstable
    }
}

impl From<DiagnoseError> for NoValue {
    fn from(error: DiagnoseError) -> Self {
        match error {
            DiagnoseError::Unstable { .. } => Self::Unstable,
            error => Self::Wrong(error.to_string()),
        }
    }
}

/// A quantity with what it depends on.
pub struct Quantity {
    of: Of,
    learnt: Option<Learnt>,
    wrench: Vector6<f64>,
    /// L of the condition number, m.
    pub length: f64,
}

impl Quantity {
    /// By the options of the command line.
    pub fn new(
        of: Of,
        load: Option<&str>,
        length: Option<&str>,
        arm: &Arm,
        learnt: Option<Learnt>,
    ) -> Result<Quantity, Failure> {
        if length.is_some() && of != Of::Condition {
            return Err(Failure::new("--length is for --of condition"));
        }
        if of == Of::Condition {
            if load.is_some() {
                return Err(Failure::new("--of condition does not depend on a --wrench"));
            }
            let length = match length {
                Some(text) => quantity::with_unit("--length", text, Dimension::Length)?,
                None => {
                    characteristic_length(arm, Search::default())
                        .map_err(|error| {
                            let help =
                                "give the length to compare translations with: --length 0.5m";
                            Failure::with_help(error.to_string(), help)
                        })?
                        .length
                }
            };
            return Ok(Quantity { of, wrench: Vector6::zeros(), length, learnt });
        }
        if let (Of::Shrink, None) = (of, load) {
            return Ok(Quantity { of, wrench: Vector6::zeros(), length: 1.0, learnt });
        }
        let Some(text) = load else {
            return Err(Failure::new("--wrench is missing: the quantity is that of a loaded arm"));
        };
        let wrench = wrench("--wrench", text)?;
        let force: Vector3<f64> = wrench.fixed_rows::<3>(0).into_owned();
        if of == Of::Stiffness && force.norm() == 0.0 {
            return Err(Failure::new(
                "--wrench: found no force, expected one: a stiffness is along it",
            ));
        }
        if wrench == Vector6::zeros() {
            return Err(Failure::new("--wrench: found no load, expected one"));
        }
        Ok(Quantity { of, wrench, length: 1.0, learnt })
    }

    /// At a posture, in [`Quantity::unit`].
    pub fn value(&self, whole: Whole<'_>, q: &[f64]) -> Result<f64, NoValue> {
        Ok(match self.of {
            Of::Condition => inverse_condition(whole, q, self.length)?,
            Of::NuP => 100.0 * influence(whole, q, &self.wrench)?.nu_p,
            Of::NuR => influence(whole, q, &self.wrench)?.nu_r.to_degrees(),
            Of::Deflection => 1e3 * self.displacement(whole, q)?.norm(),
            Of::Stiffness => {
                let force: Vector3<f64> = self.wrench.fixed_rows::<3>(0).into_owned();
                let along = self.displacement(whole, q)?.dot(&force) / force.norm();
                // A rigid direction has no finite stiffness, and no colour.
                if along > 0.0 { 1e-6 * force.norm() / along } else { f64::NAN }
            }
            Of::Shrink => match &self.learnt {
                Some(learnt) => 100.0 * learnt.expected(q, &self.wrench)?.shrink(),
                None => f64::NAN,
            },
        })
    }

    fn displacement(&self, whole: Whole<'_>, q: &[f64]) -> Result<Vector3<f64>, Unstable> {
        let deflection = whole.evaluate(Output::Deflection, q, &self.situation())?;
        Ok(deflection.map_or_else(Vector3::zeros, |d| Vector3::new(d[0], d[1], d[2])))
    }

    /// The load, and nothing else that is known.
    pub fn situation(&self) -> Situation {
        Situation::under(self.wrench)
    }

    /// Of [`Quantity::value`]; empty where it has none.
    pub fn unit(&self) -> &'static str {
        match self.of {
            Of::Condition => "",
            Of::NuP | Of::Shrink => "%",
            Of::NuR => "deg",
            Of::Deflection => "mm",
            Of::Stiffness => "N/µm",
        }
    }

    /// In words.
    pub fn name(&self) -> &'static str {
        match self.of {
            Of::Condition => "dexterity 1/κ(J)",
            Of::NuP => "influence of K_C on the displacement, ν_p",
            Of::NuR => "influence of K_C on the rotation, ν_r",
            Of::Deflection => "deflection",
            Of::Stiffness => "stiffness along the force",
            Of::Shrink => "expected shrink of the gap",
        }
    }

    /// As a column of a table.
    pub fn header(&self) -> &'static str {
        match self.of {
            Of::Condition => "condition",
            Of::NuP => "nu_p[%]",
            Of::NuR => "nu_r[deg]",
            Of::Deflection => "deflection[mm]",
            Of::Stiffness => "stiffness[N/um]",
            Of::Shrink => "shrink[%]",
        }
    }

    /// Under which circumstances.
    pub fn circumstances(&self) -> String {
        if self.of == Of::Condition {
            return format!("L = {:.3} m", self.length);
        }
        let w = self.wrench;
        let list = |at: usize| [w[at], w[at + 1], w[at + 2]].map(|x| x.to_string()).join(", ");
        let force = w.fixed_rows::<3>(0).norm() > 0.0;
        let moment = w.fixed_rows::<3>(3).norm() > 0.0;
        let learnt = self.learnt.as_ref().map(Learnt::name);
        let parts = [
            learnt,
            force.then(|| format!("force {} N", list(0))),
            moment.then(|| format!("moment {} N·m", list(3))),
        ];
        parts.into_iter().flatten().collect::<Vec<_>>().join(", ").replace('-', "−")
    }
}
