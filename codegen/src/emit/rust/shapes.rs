//! How each form of output looks in Rust: its type, its places, its numbers in a row.

use stiffarm_kernels::{Form, Output};

/// How Rust indexes a matrix.
pub(super) const ORDER: &str = ", `[column][row]`";

/// The type that a function returns, without `Result`.
pub(super) fn ty(output: Output, n: usize) -> String {
    let (rows, columns) = output.shape(n);
    match output.form() {
        Form::Pose => "Pose<S>".to_string(),
        Form::Poses => format!("[Pose<S>; {n}]"),
        Form::Vector => format!("[S; {rows}]"),
        Form::Matrix => format!("[[S; {rows}]; {columns}]"),
    }
}

/// A value of the type with every entry `zero`.
pub(super) fn zero(output: Output, n: usize) -> String {
    let (rows, columns) = output.shape(n);
    let pose = "Pose { rotation: [[zero; 3]; 3], position: [zero; 3] }";
    match output.form() {
        Form::Pose => pose.to_string(),
        Form::Poses => format!("[{pose}; {n}]"),
        Form::Vector => format!("[zero; {rows}]"),
        Form::Matrix => format!("[[zero; {rows}]; {columns}]"),
    }
}

/// The place of column-major entry `entry`.
pub(super) fn place(output: Output, n: usize, entry: usize) -> String {
    let rows = output.shape(n).0;
    let (column, row) = (entry / rows, entry % rows);
    let pose = |column: usize| match column {
        3 => format!(".position[{row}]"),
        _ => format!(".rotation[{column}][{row}]"),
    };
    match output.form() {
        Form::Pose => pose(column),
        Form::Poses => format!("[{}]{}", column / 4, pose(column % 4)),
        Form::Vector => format!("[{row}]"),
        Form::Matrix => format!("[{column}][{row}]"),
    }
}

/// The numbers of `value` as one slice, column by column.
pub(super) fn flat(output: Output, value: &str) -> String {
    match output.form() {
        Form::Pose => format!("{value}.columns().as_flattened()"),
        Form::Poses => format!("{value}.map(Pose::columns).as_flattened().as_flattened()"),
        Form::Vector => format!("&{value}"),
        Form::Matrix => format!("{value}.as_flattened()"),
    }
}
