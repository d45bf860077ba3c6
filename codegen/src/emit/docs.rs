//! What an output is, in sentences: the same for every language, from the table of outputs.

use stiffarm_kernels::{Form, Input, Output, Side};

use crate::derive::{Held, Own, Quantity, Size};

/// Of a function that computes nothing for this arm.
pub(super) const ALL_ZERO: &str = "Every entry is zero for this table.";

/// What it is; what its rows and columns are, and their units; of an output its formula and where that is
/// printed. `order` says how a language indexes a matrix.
pub(super) fn docs(held: &Held, n: usize, order: &str) -> Vec<String> {
    match held {
        Held::Output(output) => of_output(*output, n, order).into(),
        Held::Own(quantity) => of_own(quantity, order).into(),
    }
}

fn of_own(Quantity { unit, sentence, size, .. }: &Quantity, order: &str) -> [String; 2] {
    let shape = match size {
        Size::Scalar => format!("A number, in {unit}."),
        Size::Vector(rows) => format!("A vector of {rows}, in {unit}."),
        Size::Matrix { rows, columns } => format!("{rows}×{columns}{order}, in {unit}."),
    };
    [format!("{}.", sentence.trim_end_matches('.')), shape]
}

fn of_output(output: Output, n: usize, order: &str) -> [String; 3] {
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
        Form::Stack => {
            let each = output.columns().each().count(n);
            let order = order.replace("[column]", "[joint][column]");
            format!("{n} of {rows}×{each}{order}: {}.", sides(&parts, output.columns()))
        }
    }
}

fn sides(rows: &str, columns: Side) -> String {
    format!("rows {rows}; columns {}", columns.parts().join(", "))
}

/// What goes into a function, each input with its unit.
pub(super) fn inputs(taken: impl IntoIterator<Item = Input>, own: Option<&Own>) -> String {
    let own = own.into_iter().flat_map(|own| &own.inputs);
    let own = own.map(|input| format!("`{}`: {}, in {}", input.name, input.sentence, input.unit));
    let each = taken.into_iter().map(|input| format!("`{}`: {}", input.name(), input.sentence()));
    format!("{}.", each.chain(own).collect::<Vec<_>>().join("; "))
}
