//! Every output of every arm, through the functions of its module.

use stiffarm::kernels::{Output, Unstable};

use crate::robots::{iiwa14, kuka_kr240, panda, ur5_springs, ur10, ur10_moving, various};
use crate::{Real, draw::draw};

/// What the function `all` gives, after the outputs one by one.
pub const OF_ALL: [&str; 6] = [
    "all.pose",
    "all.jacobian",
    "all.complementary_stiffness",
    "all.joint_torque",
    "all.compliance",
    "all.deflection",
];

/// How many outputs every arm has: those of dynamics stand at the end.
pub const EACH: usize = Output::InverseDynamics as usize;

/// Outputs of one draw of one arm, those of `all` counted singly.
pub const OUTPUTS: usize = EACH + OF_ALL.len();

/// The arms, in the order in which [`visit`] calls them.
pub const ARMS: [&str; 5] = ["ur10", "kuka_kr240", "iiwa14", "ur5_springs", "various"];

/// The arms that say how their mass is spread, in the order in which [`visit`] calls them after all others.
pub const MOVING: [&str; 2] = ["ur10", "panda"];

/// Their equations of motion.
pub const OF_MOTION: [Output; 7] = [
    Output::InverseDynamics,
    Output::Bias,
    Output::MassMatrix,
    Output::ForwardDynamics,
    Output::TorqueRegressor,
    Output::InverseDynamicsByJoints,
    Output::InverseDynamicsByRates,
];

/// Results of one draw.
pub const RESULTS: usize = ARMS.len() * OUTPUTS + MOVING.len() * OF_MOTION.len();

/// The output and the arm of result number `index` of a draw.
pub fn name(index: usize) -> (&'static str, &'static str) {
    match index.checked_sub(ARMS.len() * OUTPUTS) {
        Some(index) => (OF_MOTION[index % OF_MOTION.len()].name(), MOVING[index / OF_MOTION.len()]),
        None => match index % OUTPUTS {
            at @ ..EACH => (Output::EACH[at].name(), ARMS[index / OUTPUTS]),
            at => (OF_ALL[at - EACH], ARMS[index / OUTPUTS]),
        },
    }
}

macro_rules! arm {
    ($arm:ident) => {
        /// Every output of this arm at draw `k`.
        #[inline(never)]
        fn $arm<S: Real>(k: u32, mut see: impl FnMut(Result<&[S], Unstable>)) {
            let (q, w) = draw::<S, { $arm::N }>(k);
            see(Ok($arm::pose(&q).columns().as_flattened()));
            see(Ok($arm::frames(&q).map(|f| f.columns()).as_flattened().as_flattened()));
            see(Ok($arm::jacobian(&q).as_flattened()));
            see(Ok($arm::jacobian_tool(&q).as_flattened()));
            see(Ok($arm::jacobian_spatial(&q).as_flattened()));
            see(Ok($arm::complementary_stiffness(&q, &w).as_flattened()));
            see(Ok(&$arm::joint_torque(&q, &w)));
            see(Ok(&$arm::weight_torque(&q)));
            see(Ok($arm::weight_stiffness(&q).as_flattened()));
            see(Ok($arm::compliance(&q).as_flattened()));
            see(Ok(&$arm::deflection_first_order(&q, &w)));
            see($arm::deflection(&q, &w).as_ref().map(<[S; 6]>::as_slice).map_err(|e| *e));
            see($arm::deflection_with_gravity(&q, &w)
                .as_ref()
                .map(<[S; 6]>::as_slice)
                .map_err(|e| *e));
            see(Ok($arm::parameter_jacobian(&q).as_flattened()));
            see(Ok($arm::compliance_regressor(&q, &w).as_flattened()));
            let all = $arm::all(&q, &w);
            let all = all.as_ref().map_err(|e| *e);
            see(all.map(|a| a.pose.columns()).as_ref().map(|p| p.as_flattened()).map_err(|e| *e));
            see(all.map(|a| a.jacobian.as_flattened()));
            see(all.map(|a| a.complementary_stiffness.as_flattened()));
            see(all.map(|a| a.joint_torque.as_slice()));
            see(all.map(|a| a.compliance.as_flattened()));
            see(all.map(|a| a.deflection.as_slice()));
        }
    };
}

arm!(ur10);
arm!(kuka_kr240);
arm!(iiwa14);
arm!(ur5_springs);
arm!(various);

macro_rules! moving {
    ($name:ident: $arm:ident) => {
        /// The equations of motion of this arm at draw `k`.
        #[inline(never)]
        fn $name<S: Real>(k: u32, mut see: impl FnMut(Result<&[S], Unstable>)) {
            let (state, _) = draw::<S, { 3 * $arm::N }>(k);
            // The last are accelerations or torques.
            let ([q, qd, last], _) = state.as_chunks() else { return };
            see(Ok(&$arm::inverse_dynamics(q, qd, last)));
            see(Ok(&$arm::bias(q, qd)));
            see(Ok($arm::mass_matrix(q).as_flattened()));
            let accelerations = $arm::forward_dynamics(q, qd, last);
            see(accelerations.as_ref().map(<[S; $arm::N]>::as_slice).map_err(|e| *e));
            see(Ok($arm::torque_regressor(q, qd, last).as_flattened()));
            see(Ok($arm::inverse_dynamics_by_joints(q, qd, last).as_flattened()));
            see(Ok($arm::inverse_dynamics_by_rates(q, qd).as_flattened()));
        }
    };
}

moving!(ur10_moves: ur10_moving);
moving!(panda_moves: panda);

/// Calls every output of every arm at draw `k` and shows the result, column by column, or that
/// there is none, [`RESULTS`] times: arm by arm, then the equations of motion arm by arm.
pub fn visit<S: Real>(k: u32, mut see: impl FnMut(Result<&[S], Unstable>)) {
    ur10(k, &mut see);
    kuka_kr240(k, &mut see);
    iiwa14(k, &mut see);
    ur5_springs(k, &mut see);
    various(k, &mut see);
    ur10_moves(k, &mut see);
    panda_moves(k, &mut see);
}
