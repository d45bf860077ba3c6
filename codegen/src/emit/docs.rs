//! What an output is, in sentences: the same for every language, from the table of outputs.

use stiffarm_kernels::{Form, Input, Output, Side};

/// What it is; what its rows and columns are, and their units; its formula and where that is printed.
/// `order` says how a language indexes a matrix.
pub(super) fn docs(output: Output, n: usize, order: &str) -> [String; 3] {
    let source = match output.source() {
        "" => String::new(),
        source => format!(" ({source})"),
    };
    [
        output.sentence().to_string(),
        shape(output, n, order),
        format!("{}{source}.", output.formula()),
    ]
}

/// Rows, columns and units.
fn shape(output: Output, n: usize, order: &str) -> String {
    let (rows, columns) = output.shape(n);
    let parts = output.rows().parts().iter().zip(output.units());
    let parts: Vec<String> = parts.map(|(part, unit)| format!("{part} in {unit}")).collect();
    let parts = parts.join(", ");
    match output.form() {
        Form::Vector => format!("A vector of {rows}: {parts}."),
        Form::Pose | Form::Poses => {
            format!("{rows}×{columns}: {}.", sides(&parts, output.columns()))
        }
        Form::Matrix => format!("{rows}×{columns}{order}: {}.", sides(&parts, output.columns())),
    }
}

fn sides(rows: &str, columns: Side) -> String {
    format!("rows {rows}; columns {}", columns.parts().join(", "))
}

/// What goes into a function, each input with its unit; the joint values as a `posture` or as they are.
pub(super) fn inputs(taken: impl IntoIterator<Item = Input>, posture: bool) -> String {
    let each = taken.into_iter().map(|input| match input {
        Input::Joints if posture => {
            "`posture`: sines and cosines of the joint values, displacements in m".to_string()
        }
        input => format!("`{}`: {}", input.name(), input.sentence()),
    });
    format!("{}.", each.collect::<Vec<_>>().join("; "))
}
