//! What the printed equations of a paper should say, as functions of their symbols: the ledger holds
//! each exactly against what is printed, or against its correction.

use std::collections::HashMap;

use stiffarm_papers::{Paper, ledger, read};

/// The equations of a data file.
pub struct Printed(Paper);

impl Printed {
    pub fn of(file: &str) -> Printed {
        let path = format!("{}/data/{file}", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(&path).expect("a data file");
        Printed(read(&text, file).unwrap_or_else(|error| panic!("{error}")))
    }

    /// The entries of an equation, row by row, by the values of its symbols.
    pub fn entries(&self, number: &str, values: &HashMap<String, f64>) -> Vec<f64> {
        let equation = self.0.equations.iter().find(|equation| equation.number == number);
        let truth = ledger::truth(&self.0, equation.expect(number)).expect(number);
        let plain = |name: &str| values.get(name).copied();
        let value = |entry: &_| truth.form(*entry).real(plain).expect(number);
        truth.entries.iter().map(value).collect()
    }
}
