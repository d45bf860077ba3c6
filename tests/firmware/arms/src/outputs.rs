//! Every output of every arm, through the functions of its module.

use stiffarm::kernels::{Output, Unstable};

use crate::robots::{iiwa14, kuka_kr240, ur5_springs, ur10, various};
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

/// The name of output number `index`.
pub fn name(index: usize) -> &'static str {
    match index.checked_sub(EACH) {
        None => Output::EACH[index].name(),
        Some(of_all) => OF_ALL[of_all],
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

/// Calls every output of every arm at draw `k` and shows the result, column by column, or that
/// there is no stable equilibrium: arm by arm, [`OUTPUTS`] times each.
pub fn visit<S: Real>(k: u32, mut see: impl FnMut(Result<&[S], Unstable>)) {
    ur10(k, &mut see);
    kuka_kr240(k, &mut see);
    iiwa14(k, &mut see);
    ur5_springs(k, &mut see);
    various(k, &mut see);
}
