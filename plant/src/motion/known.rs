//! What a robot file says of the arm in motion beyond its table, as the plant has it.

use stiffarm_kernels::generic::Arm;
use stiffarm_table::robot::{Effect, Quantity};

use super::truth::MotionTruth;
use super::{Law, Logged};
use crate::TruthError;

/// The `[[effect]]` tables of motion that act where so much is logged, of an arm that is moved in so many
/// runs.
///
/// # Errors
/// [`TruthError`]: a table that the plant has no law for, or that this arm cannot have.
pub fn known(
    tables: &[Effect],
    arm: &Arm,
    runs: usize,
    logged: Logged,
) -> Result<Vec<MotionTruth>, TruthError> {
    let acts = |table: &&Effect| {
        Law::named(&table.id.value).is_none_or(|law| law.rows.contains(&logged.rows()))
    };
    let read = |table: &Effect| {
        let numbers = table.numbers.iter().map(|entry| match &entry.value {
            Quantity::Si(value) => format!("{}={value:e}", entry.key),
            Quantity::Text(text) => format!("{}={text}", entry.key),
        });
        let numbers: Vec<String> = numbers.collect();
        let text = format!("{}@{}:{}", table.id.value, table.place.value, numbers.join(","));
        MotionTruth::parse(&text, arm, runs)
    };
    tables.iter().filter(acts).map(read).collect()
}
