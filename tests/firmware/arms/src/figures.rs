//! The kernels whose cost is counted, each one function that is called and not inlined.

use stiffarm::kernels::{Pose, Unstable};

use crate::Real;
use crate::computed_torque::{self, Gains, Target};
use crate::impedance::{Impedance, step};
use crate::robots::{
    iiwa14, kuka_kr240, kuka_kr240_inverse, kuka_kr240_lean, panda, ur5_lean, ur5_springs,
    ur10_inverse, ur10_lean, ur10_moving,
};
use crate::set_point::{Correction, Reading, Refusal, correct};

/// A function of joint values and a wrench that writes its result.
pub type Kernel<S, const N: usize, T> = fn(&[S; N], &[S; 6], &mut T);

/// Who counts.
pub trait Counter<S> {
    /// Counts what a call costs; `out` is any value of the result's type.
    fn count<const N: usize, T>(&mut self, name: &str, kernel: Kernel<S, N, T>, out: T);
}

/// Pose of the tool and Jacobian.
pub type PoseAndJacobian<S, const N: usize> = (Pose<S>, [[S; 6]; N]);

/// Pose and Jacobian by the same sines and cosines.
macro_rules! pose_and_jacobian {
    ($arm:ident, $q:ident) => {{
        let posture = $arm::Posture::new($q);
        ($arm::pose::given(&posture), $arm::jacobian::given(&posture))
    }};
}

macro_rules! kernels {
    ($($(#[$doc:meta])* $name:ident($q:ident: $n:literal, $w:pat $(, $place:ident)?) -> $out:ty
        $result:block from $initial:expr;)*) => {
        $(
            $(#[$doc])*
            #[inline(never)]
            pub fn $name<S: Real>($q: &[S; $n], $w: &[S; 6], out: &mut $out) {
                kernels!(@ out $($place)? $result);
            }
        )*

        /// Has every kernel counted.
        pub fn each<S: Real>(counter: &mut impl Counter<S>) {
            $(counter.count(stringify!($name), $name::<S>, $initial);)*
        }
    };
    (@ $out:ident $result:block) => { *$out = $result };
    // A result that the kernel itself writes.
    (@ $out:ident $place:ident $result:block) => {
        let $place = $out;
        $result
    };
}

kernels! {
    /// Sines and cosines that [`pose`] needs.
    sines(q: 6, _) -> ur5_lean::Posture<S> {
        ur5_lean::Posture::new(q)
    } from ur5_lean::Posture::new(&[S::of(0); 6]);
    /// Pose of the UR5-like arm.
    pose(q: 6, _) -> Pose<S> {
        ur5_springs::pose(q)
    } from ur5_springs::pose(&[S::of(0); 6]);
    /// Jacobian of the UR5-like arm.
    jacobian(q: 6, _) -> [[S; 6]; 6] {
        ur5_springs::jacobian(q)
    } from [[S::of(0); 6]; 6];
    /// Both, by the same sines and cosines.
    pose_and_jacobian(q: 6, _) -> PoseAndJacobian<S, 6> {
        pose_and_jacobian!(ur5_lean, q)
    } from (ur5_springs::pose(&[S::of(0); 6]), [[S::of(0); 6]; 6]);
    /// Both and the compliance.
    with_compliance(q: 6, _) -> (PoseAndJacobian<S, 6>, [[S; 6]; 6]) {
        use ur5_lean::{Posture, compliance, jacobian, pose};
        let posture = Posture::new(q);
        let both = (pose::given(&posture), jacobian::given(&posture));
        (both, compliance::given(&posture))
    } from ((ur5_springs::pose(&[S::of(0); 6]), [[S::of(0); 6]; 6]), [[S::of(0); 6]; 6]);
    /// Joint torques of the UR5-like arm.
    joint_torque(q: 6, w) -> [S; 6] {
        ur5_springs::joint_torque(q, w)
    } from [S::of(0); 6];
    /// Deflection of the UR5-like arm to first order in the load.
    deflection_first_order(q: 6, w) -> [S; 6] {
        ur5_springs::deflection_first_order(q, w)
    } from [S::of(0); 6];
    /// Deflection of the UR5-like arm with K_C, and its 6x6 solve.
    deflection(q: 6, w) -> Result<[S; 6], Unstable> {
        ur5_springs::deflection(q, w)
    } from Err(Unstable);
    /// Pose, Jacobian, K_C, joint torques, compliance and deflection of the UR5-like arm.
    all(q: 6, w) -> Result<ur5_springs::all::All<S>, Unstable> {
        ur5_springs::all(q, w)
    } from Err(Unstable);
    /// One period of the control loop on the UR5-like arm.
    control_period(q: 6, w) -> Result<Correction<S>, Refusal> {
        correct(&Reading { encoders: *q, wrench: *w }, q)
    } from Err(Refusal::NotFinite);
    /// One period of impedance control, written against the trait: towards the pose of the zero posture.
    impedance_period(q: 6, w) -> [S; 6] {
        let zero = S::of(0);
        let axis = |k: usize| core::array::from_fn(|i| S::of(i32::from(i == k)));
        let target = Pose { rotation: core::array::from_fn(axis), position: [zero; 3] };
        let impedance = Impedance { stiffness: *w, damping: [S::of(1); 6] };
        step(&ur5_lean::Robot, (q, &[zero; 6]), &target, &impedance)
    } from [S::of(0); 6];
    /// Pose and Jacobian of the UR10.
    ur10_pose_and_jacobian(q: 6, _) -> PoseAndJacobian<S, 6> {
        pose_and_jacobian!(ur10_lean, q)
    } from (ur10_lean::pose(&[S::of(0); 6]), [[S::of(0); 6]; 6]);
    /// Pose and Jacobian of the KR 240-2.
    kuka_kr240_pose_and_jacobian(q: 6, _) -> PoseAndJacobian<S, 6> {
        pose_and_jacobian!(kuka_kr240_lean, q)
    } from (kuka_kr240::pose(&[S::of(0); 6]), [[S::of(0); 6]; 6]);
    /// Deflection of the KR 240-2 with K_C, and its 6x6 solve.
    kuka_kr240_deflection(q: 6, w) -> Result<[S; 6], Unstable> {
        kuka_kr240::deflection(q, w)
    } from Err(Unstable);
    /// Pose and Jacobian of the iiwa 14.
    iiwa14_pose_and_jacobian(q: 7, _) -> PoseAndJacobian<S, 7> {
        pose_and_jacobian!(iiwa14, q)
    } from (iiwa14::pose(&[S::of(0); 7]), [[S::of(0); 6]; 7]);
    /// The eight branches of the UR10's inverse kinematics: joint values near which free joints stay, and a pose.
    ur10_inverse_kinematics(near: 18, _) -> [[S; 6]; 8] {
        let ([q, ..], target) = (near.as_chunks().0, &near[6..]) else { return };
        let Ok(target) = target.try_into() else { return };
        ur10_inverse::inverse_kinematics(q, target).q
    } from [[S::of(0); 6]; 8];
    /// The same of the KR 240-2.
    kuka_kr240_inverse_kinematics(near: 18, _) -> [[S; 6]; 8] {
        let ([q, ..], target) = (near.as_chunks().0, &near[6..]) else { return };
        let Ok(target) = target.try_into() else { return };
        kuka_kr240_inverse::inverse_kinematics(q, target).q
    } from [[S::of(0); 6]; 8];
    /// Torques of the UR10's motors for a motion.
    ur10_inverse_dynamics(state: 18, _) -> [S; 6] {
        let ([q, qd, qdd], _) = state.as_chunks() else { return };
        ur10_moving::inverse_dynamics(q, qd, qdd)
    } from [S::of(0); 6];
    /// The same where no joint accelerates.
    ur10_bias(state: 12, _) -> [S; 6] {
        let ([q, qd], _) = state.as_chunks() else { return };
        ur10_moving::bias(q, qd)
    } from [S::of(0); 6];
    /// The same of the UR10's weights alone, with the opposite sign.
    ur10_weight_torque(q: 6, _) -> [S; 6] {
        ur10_moving::weight_torque(q)
    } from [S::of(0); 6];
    /// Mass matrix of the UR10.
    ur10_mass_matrix(q: 6, _) -> [[S; 6]; 6] {
        ur10_moving::mass_matrix(q)
    } from [[S::of(0); 6]; 6];
    /// Accelerations of the UR10 under its motors' torques.
    ur10_forward_dynamics(state: 18, _) -> Result<[S; 6], Unstable> {
        let ([q, qd, tau], _) = state.as_chunks() else { return };
        ur10_moving::forward_dynamics(q, qd, tau)
    } from Err(Unstable);
    /// Regressor of the UR10's torques, written where it is to stand.
    ur10_torque_regressor(state: 18, _, place) -> [[S; 6]; 60] {
        let ([q, qd, qdd], _) = state.as_chunks() else { return };
        ur10_moving::torque_regressor::write(&ur10_moving::Posture::new(q), qd, qdd, place);
    } from [[S::of(0); 6]; 60];
    /// How the UR10's torques change with the joint values.
    ur10_inverse_dynamics_by_joints(state: 18, _) -> [[S; 6]; 6] {
        let ([q, qd, qdd], _) = state.as_chunks() else { return };
        ur10_moving::inverse_dynamics_by_joints(q, qd, qdd)
    } from [[S::of(0); 6]; 6];
    /// How they change with the rates.
    ur10_inverse_dynamics_by_rates(state: 12, _) -> [[S; 6]; 6] {
        let ([q, qd], _) = state.as_chunks() else { return };
        ur10_moving::inverse_dynamics_by_rates(q, qd)
    } from [[S::of(0); 6]; 6];
    /// One period of computed-torque control of the UR10, written against the trait.
    computed_torque_period(state: 30, _) -> [S; 6] {
        let ([q, qd, there, rates, accelerations], _) = state.as_chunks() else { return };
        let target = Target { q: *there, qd: *rates, qdd: *accelerations };
        let gains = Gains { stiffness: S::of(100), damping: S::of(20) };
        computed_torque::step(&ur10_moving::Robot, (q, qd), &target, &gains)
    } from [S::of(0); 6];
    /// Torques of the Panda's motors for a motion.
    panda_inverse_dynamics(state: 21, _) -> [S; 7] {
        let ([q, qd, qdd], _) = state.as_chunks() else { return };
        panda::inverse_dynamics(q, qd, qdd)
    } from [S::of(0); 7];
    /// Mass matrix of the Panda.
    panda_mass_matrix(q: 7, _) -> [[S; 7]; 7] {
        panda::mass_matrix(q)
    } from [[S::of(0); 7]; 7];
}
