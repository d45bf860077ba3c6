//! How each form of output looks in Rust: its type, its places, its numbers in a row.

use stiffarm_kernels::{Form, Output};

use crate::derive::{Held, Size};

/// How Rust indexes a matrix.
pub(super) const ORDER: &str = ", `[column][row]`";

/// The arrangement of what a function returns.
#[derive(Clone, Copy)]
enum Shape {
    Pose,
    Poses(usize),
    Scalar,
    Vector(usize),
    Matrix(usize, usize),
    /// Rows, columns of each, how many.
    Stack(usize, usize, usize),
}

fn shape(held: &Held, n: usize) -> Shape {
    let (rows, columns) = held.shape(n);
    match held {
        Held::Output(output) => match output.form() {
            Form::Pose => Shape::Pose,
            Form::Poses => Shape::Poses(n),
            Form::Vector => Shape::Vector(rows),
            Form::Matrix => Shape::Matrix(rows, columns),
            Form::Stack => Shape::Stack(rows, output.columns().each().count(n), n),
        },
        Held::Own(quantity) => match quantity.size {
            Size::Scalar => Shape::Scalar,
            Size::Vector(rows) => Shape::Vector(rows),
            Size::Matrix { .. } => Shape::Matrix(rows, columns),
        },
    }
}

/// Poses and numbers as they are written, in their arrangement.
fn arranged(held: &Held, n: usize, [pose, number]: [&str; 2]) -> String {
    match shape(held, n) {
        Shape::Pose => pose.to_string(),
        Shape::Poses(n) => format!("[{pose}; {n}]"),
        Shape::Scalar => number.to_string(),
        Shape::Vector(rows) => format!("[{number}; {rows}]"),
        Shape::Matrix(rows, columns) => format!("[[{number}; {rows}]; {columns}]"),
        Shape::Stack(rows, columns, n) => format!("[[[{number}; {rows}]; {columns}]; {n}]"),
    }
}

/// The type that a function returns, without `Result`.
pub(super) fn ty(held: &Held, n: usize) -> String {
    arranged(held, n, ["Pose<S>", "S"])
}

/// A value of the type with every entry `zero`.
pub(super) fn zero(held: &Held, n: usize) -> String {
    arranged(held, n, ["Pose { rotation: [[zero; 3]; 3], position: [zero; 3] }", "zero"])
}

/// The place of column-major entry `entry`.
pub(super) fn place(held: &Held, n: usize, entry: usize) -> String {
    let rows = held.shape(n).0;
    let (column, row) = (entry / rows, entry % rows);
    let pose = |column: usize| match column {
        3 => format!(".position[{row}]"),
        _ => format!(".rotation[{column}][{row}]"),
    };
    match shape(held, n) {
        Shape::Pose => pose(column),
        Shape::Poses(_) => format!("[{}]{}", column / 4, pose(column % 4)),
        Shape::Scalar => String::new(),
        Shape::Vector(_) => format!("[{row}]"),
        Shape::Matrix(..) => format!("[{column}][{row}]"),
        Shape::Stack(_, each, _) => format!("[{}][{}][{row}]", column / each, column % each),
    }
}

/// The numbers of `value` as one slice, column by column.
pub(super) fn flat(output: Output, value: &str) -> String {
    match output.form() {
        Form::Pose => format!("{value}.columns().as_flattened()"),
        Form::Poses => format!("{value}.map(Pose::columns).as_flattened().as_flattened()"),
        Form::Vector => format!("&{value}"),
        Form::Matrix => format!("{value}.as_flattened()"),
        Form::Stack => format!("{value}.as_flattened().as_flattened()"),
    }
}
