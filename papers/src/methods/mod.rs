//! Methods that work out printed numbers which no formula gives, by the names that the data files
//! call them by.

pub mod bicchi;
pub mod dumas;
pub mod jweeg;
pub mod transport;

use stiffarm_codegen::robot::Robot;
use stiffarm_kernels::generic::Arm;

/// One value for each row, or why there are none.
type Column = Result<Vec<Option<f64>>, String>;

/// The column of a method; `None` where there is no method of that name.
pub fn column(name: &str) -> Option<Column> {
    let values = match name {
        "bicchi.force_error" => bicchi::case::force_error(bicchi::case::STATED),
        "bicchi.force_error, half EJ" => bicchi::case::force_error(bicchi::case::HALF),
        "bicchi.steps" => bicchi::case::steps(),
        "dumas.characteristic_length" => dumas::characteristic_length(),
        "dumas.influence" => dumas::influence(),
        "jweeg.p_y" => jweeg::published::p_y(),
        _ => return None,
    };
    Some(values.map(|values| values.into_iter().map(Some).collect()))
}

/// One of the arms that are built in, by its name.
///
/// # Errors
/// That there is none of this name; never of one that there is.
pub fn arm(id: &str) -> Result<Arm, String> {
    let known = stiffarm_robots::ARMS.iter().find(|arm| arm.id == id);
    let toml = known.ok_or_else(|| format!("there is no arm `{id}`"))?.toml;
    let (robot, _) = Robot::from_toml(toml, id).map_err(|error| error.to_string())?;
    stiffarm_gap::robot::arm(&robot).map_err(|error| error.to_string())
}
