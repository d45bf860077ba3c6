//! Dumas, Caro, Cherif, Garnier & Furet, "Joint stiffness identification of industrial serial
//! robots", Robotica 2011, on the KUKA KR 240-2 of the robot file: the campaign of section 4 simulated
//! and identified as any other, the maps and the postures of sections 2 and 3. What the paper prints
//! as an equation or a table is judged in the ledger.

mod dexterity;
mod identify;
mod links;
mod rig;
mod zones;

use stiffarm_kernels::generic::Arm;

/// L of the paper, m.
const LENGTH: f64 = 0.682;

/// The KR 240-2 with the stiffnesses of Table 2.
fn kr240() -> Arm {
    stiffarm_papers::methods::arm("kuka_kr240").unwrap()
}
