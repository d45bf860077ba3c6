//! The tables of `docs/firmware.md`, between their marks.

use std::fs;
use std::path::Path;

use crate::Failure;
use crate::board::Board;
use crate::budget::Budgets;
use crate::figures::Figure;

const BEGIN: &str = "<!-- figures: written by tests/firmware/run -->\n";
const END: &str = "<!-- end of figures -->\n";

/// What a kernel is, in the table.
fn title(name: &str) -> &str {
    match name {
        "sines" => "six sines and cosines",
        "pose" => "pose",
        "jacobian" => "Jacobian",
        "pose_and_jacobian" => "**pose + Jacobian**",
        "with_compliance" => "pose + Jacobian + compliance",
        "joint_torque" => "joint torques Jᵀw",
        "deflection_first_order" => "deflection, first order",
        "deflection" => "deflection with K_C, 6×6 solve",
        "all" => "`all`: pose, J, K_C, torques, compliance, deflection",
        "control_period" => "a period of the control loop",
        "impedance_period" => "a period of impedance control, by the trait",
        "ur10_pose_and_jacobian" => "UR10: pose + Jacobian",
        "kuka_kr240_pose_and_jacobian" => "KR 240-2: pose + Jacobian",
        "kuka_kr240_deflection" => "KR 240-2: deflection with K_C",
        "iiwa14_pose_and_jacobian" => "iiwa 14 (7 joints): pose + Jacobian",
        "ur10_inverse_dynamics" => "**UR10: inverse dynamics**",
        "ur10_inverse_kinematics" => "UR10: inverse kinematics, eight branches",
        "kuka_kr240_inverse_kinematics" => "KR 240-2: inverse kinematics, eight branches",
        "ur10_bias" => "UR10: bias",
        "ur10_weight_torque" => "UR10: weights alone",
        "ur10_mass_matrix" => "UR10: mass matrix",
        "ur10_forward_dynamics" => "UR10: forward dynamics, 6×6 solve",
        "ur10_torque_regressor" => "UR10: regressor of the torques, 6×60, by `write`",
        "ur10_inverse_dynamics_by_joints" => "UR10: ∂τ/∂q, 6×6",
        "ur10_inverse_dynamics_by_rates" => "UR10: ∂τ/∂q̇, 6×6",
        "computed_torque_period" => "a period of computed torque on the UR10, by the trait",
        "panda_inverse_dynamics" => "Panda (7 joints): inverse dynamics",
        "panda_mass_matrix" => "Panda: mass matrix",
        "c_inverse_dynamics" => "C, UR10: inverse dynamics",
        "c_mass_matrix" => "C, UR10: mass matrix",
        "c_pose_and_jacobian" => "C: pose + Jacobian",
        "c_deflection" => "C: deflection with K_C, 6×6 solve",
        other => other,
    }
}

/// The table of a board.
pub fn table(board: Board, figures: &[Figure], budgets: &Budgets) -> String {
    let mut text = format!(
        "\n**{}**\n\n| kernel | instructions | at most | stack B | at most | flash B | at most | \
         branches |\n|---|---|---|---|---|---|---|---|\n",
        board.name
    );
    for figure in figures {
        let Figure { name, fewest, most, stack, flash, branches } = figure;
        let Some(budget) = budgets.get(board.key).and_then(|of| of.get(name)) else { continue };
        let instructions = match fewest == most {
            true => most.to_string(),
            false => format!("{fewest} to {most}"),
        };
        text.push_str(&format!(
            "| {} | {instructions} | {} | {stack} | {} | {flash} | {} | \
             {branches} |\n",
            title(name),
            budget.instructions,
            budget.stack,
            budget.flash
        ));
    }
    text
}

/// Puts the tables into the page.
pub fn write(page: &Path, tables: &str) -> Result<(), Failure> {
    let place = |e: &dyn std::fmt::Display| format!("{}: {e}", page.display());
    let text = fs::read_to_string(page).map_err(|e| place(&e))?;
    let new = between(&text, tables).ok_or_else(|| place(&"its marks for the figures are gone"))?;
    let beside = page.with_extension("md.new");
    fs::write(&beside, new).and_then(|()| fs::rename(&beside, page)).map_err(|e| place(&e))
}

fn between(text: &str, tables: &str) -> Option<String> {
    let (before, rest) = text.split_once(BEGIN)?;
    let (_, after) = rest.split_once(END)?;
    Some(format!("{before}{BEGIN}{tables}\n{END}{after}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_is_between_the_marks_changes() {
        let page = format!("a\n{BEGIN}old\n{END}z\n");
        let once = between(&page, "new").expect("marks");
        assert_eq!(once, format!("a\n{BEGIN}new\n{END}z\n"));
        assert_eq!(between(&once, "new").as_ref(), Some(&once));
        assert_eq!(between("no marks", "new"), None);
    }
}
