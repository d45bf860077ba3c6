//! The arms whose bits are compared, with the kernels that the macro made of them.

use stiffarm::kernels::{DhRow, Error, Kernels, Output, Pose, Scalar};
use stiffarm_codegen::emit::{Precision, Sines};
use stiffarm_codegen::robot::Robot;
use stiffarm_robots::ARMS;

use crate::compiler::{Folder, compile};
use crate::program::{SIDES, WARMING, program};

stiffarm::robot! {
    /// Something of everything.
    pub mod various from "tests/c/arm.toml";
}
stiffarm::robot! {
    /// Places other than the tool.
    pub mod framed from "tests/c/framed.toml";
}

stiffarm::robot! {
    /// What is generated on request, beside what `all` needs.
    pub mod by_joints from "tests/c/arm.toml";
    outputs: pose, jacobian, complementary_stiffness, joint_torque, compliance, deflection, hessian,
             jacobian_rate, compliance_by_joints, deflection_by_joints, manipulability,
             manipulability_by_joints, inverse_dynamics_by_joints, inverse_dynamics_by_rates;
}

/// The outputs of the module above, as a robot file asks for them.
macro_rules! on_request {
    () => {
        "outputs = ['pose', 'jacobian', 'complementary_stiffness', 'joint_torque', 'compliance', 'deflection', \
         'hessian', 'jacobian_rate', 'compliance_by_joints', 'deflection_by_joints', 'manipulability', \
         'manipulability_by_joints', 'inverse_dynamics_by_joints', 'inverse_dynamics_by_rates']\n"
    };
}

stiffarm::robot! {
    /// Readings that are not the joint values, sides, warming, and what gives beyond the table.
    pub mod corrected from "tests/data/corrected_modified.toml";
}

/// What a fused function computes, output by output in its order, or that there is no equilibrium.
pub type All<S> = Result<Vec<Vec<S>>, Error>;

/// An arm with its kernels in one precision.
pub struct Arm<S: 'static> {
    pub id: &'static str,
    pub toml: &'static str,
    pub rows: &'static [DhRow],
    pub kernels: &'static dyn Kernels<S>,
    /// Those of its named frames and markers, in the order of the file.
    pub places: Vec<&'static dyn Kernels<S>>,
    pub all: fn(&[S], &[S; 6]) -> All<S>,
}

macro_rules! arm {
    ($id:ident, $($path:ident)::+, $toml:expr, $scalar:ty $(, $place:ident)*) => {
        arm!($id, $($path)::+, $toml, $scalar, &$($path)::+::Robot, []; $($place),*)
    };
    ($id:ident, $($path:ident)::+, $toml:expr, $scalar:ty, $robot:expr, [$($given:expr),*]; $($place:ident),*) => {
        Arm::<$scalar> {
            id: stringify!($id),
            toml: $toml,
            rows: &$($path)::+::DH,
            kernels: $robot,
            places: vec![$(&framed::at::$place::Robot),*],
            all: |q, wrench| {
                let q = q.try_into().map_err(|_| Error::Length)?;
                let all = $($path)::+::all(q, $($given,)* wrench)?;
                Ok(vec![
                    flat(all.pose),
                    all.jacobian.as_flattened().to_vec(),
                    all.complementary_stiffness.as_flattened().to_vec(),
                    all.joint_torque.to_vec(),
                    all.compliance.as_flattened().to_vec(),
                    all.deflection.to_vec(),
                ])
            },
        }
    };
}

macro_rules! arms {
    ($scalar:ty; $($id:ident),*) => {
        vec![
            $(arm!($id, stiffarm_robots::$id, toml(stringify!($id)), $scalar),)*
            arm!(various, various, include_str!("arm.toml"), $scalar),
            arm!(by_joints, by_joints, concat!(on_request!(), include_str!("arm.toml")), $scalar),
            arm!(framed, framed, include_str!("framed.toml"), $scalar, elbow, camera, smr1),
            arm!(
                corrected,
                corrected,
                include_str!("../data/corrected_modified.toml"),
                $scalar,
                Box::leak(Box::new(corrected::Robot { sides: sides(), warming: WARMING as $scalar })),
                [&sides(), WARMING as $scalar];
            ),
        ]
    };
}

pub fn doubles() -> Vec<Arm<f64>> {
    arms!(f64; lin_planar, ur5, ur10, kuka_kr240, iiwa14, stanford)
}

pub fn singles() -> Vec<Arm<f32>> {
    arms!(f32; lin_planar, ur5, ur10, kuka_kr240, iiwa14, stanford)
}

fn sides<S: Scalar>() -> [S; 5] {
    SIDES.map(S::lit)
}

fn flat<S: Copy>(pose: Pose<S>) -> Vec<S> {
    pose.columns().as_flattened().to_vec()
}

impl<S: Scalar> Arm<S> {
    /// Whether no joint gives, so that every load is borne.
    pub fn is_rigid(&self) -> bool {
        self.rows.iter().all(|row| row.stiffness == "rigid")
    }

    /// Every output, then those of the places, then those of the fused function; `None` where there is no
    /// equilibrium.
    pub fn outputs(&self, state: &[S], wrench: &[S; 6]) -> Vec<Option<Vec<S>>> {
        let single = |kernels: &dyn Kernels<S>, output: Output| {
            let (rows, columns) = output.shape(kernels.dof());
            let mut out = vec![S::lit(0.0); rows * columns];
            let state = &state[..output.state(kernels.dof())];
            kernels.evaluate(output, state, wrench, &mut out).is_ok().then_some(out)
        };
        let kernels = [self.kernels].into_iter().chain(self.places.iter().copied());
        let mut outputs: Vec<Option<Vec<S>>> = kernels
            .flat_map(|of| of.outputs().iter().map(move |output| single(of, *output)))
            .collect();
        match (self.all)(&state[..self.kernels.dof()], wrench) {
            Ok(all) => outputs.extend(all.into_iter().map(Some)),
            Err(_) => outputs.extend(Output::ALL.map(|_| None)),
        }
        outputs
    }
}

/// The file of a robot of the collection.
fn toml(id: &str) -> &'static str {
    ARMS.iter().find(|arm| arm.id == id).expect("an arm of the collection").toml
}

/// A robot of the collection.
pub fn robot(id: &str) -> Robot {
    Robot::from_toml(toml(id), id).expect("a valid file").0
}

/// Writes an arm's C and the program around it, and compiles both.
pub fn build<S: Scalar>(
    compiler: &str,
    folder: &Folder,
    arm: &Arm<S>,
    precision: Precision,
    flags: &[&str],
) {
    let (robot, _) = Robot::for_kernels(arm.toml, arm.id).expect("a valid file");
    let id = arm.id;
    folder.write_c(&robot, id, (precision, Sines::Polynomial));
    folder.write("main.c", &program(id, &robot, precision));
    let source = format!("{id}.c");
    compile(compiler, folder, &[flags, &["main.c", &source, "-o", id, "-lm"]].concat());
}
