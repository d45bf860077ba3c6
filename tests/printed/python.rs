//! The text as Python: a program for each arm, which computes all questions as one batch.

use std::process::Command;

use stiffarm::kernels::{Form, Output, Side};
use stiffarm_codegen::emit::python;

use crate::batch::{Batch, Case};
use crate::compiler::{Folder, spoken};

const MAIN: &str = r#"import struct
import sys

import arm
import numpy as np


def number(word):
    return struct.unpack("<d", int(word, 16).to_bytes(8, "little"))[0]


def columns(array):
    """Column by column, matrix by matrix; of a pose without its last row."""
    if array.ndim > 2:
        array = array.swapaxes(-1, -2)
    return array.reshape(len(array), -1)


x = np.array([[number(word) for word in line.split()] for line in sys.stdin])
found = []
OUTPUTS
for row in zip(*found):
    for numbers in row:
        bits = [format(struct.unpack("<Q", struct.pack("<d", y))[0], "x") for y in numbers]
        print("1" if np.isnan(numbers).any() else " ".join(["0", *bits]))
"#;

/// For every arm the answers to all questions.
pub fn answers(batch: &Batch) -> Vec<Vec<String>> {
    batch.cases.iter().map(|case| of(case, batch.seed)).collect()
}

fn of(case: &Case, seed: u64) -> Vec<String> {
    let robot = case.table.robot();
    let folder = Folder::new(&format!("python-{seed}-{}", case.name));
    let symbols = robot.symbols();
    let value = |name: &str| format!("{name}={:?}", case.table.value(name).expect("a value"));
    let values: Vec<String> = symbols.iter().map(|symbol| value(&symbol.name)).collect();
    let constants = if symbols.is_empty() { "" } else { "constants, " };
    let n = robot.dof();
    let mut calls = String::new();
    if !symbols.is_empty() {
        calls = format!("constants = arm.Constants({})\n", values.join(", "));
    }
    let rows = |output: &Output| match output.form() {
        Form::Pose | Form::Poses => "[..., :3, :]",
        _ => "",
    };
    for output in robot.generated() {
        let beside = output.beside().enumerate().map(|(k, input)| match input.side() {
            Side::Joints => format!(", x[:, {}:{}]", (k + 1) * n, (k + 2) * n),
            _ => ", x[:, -6:]".to_owned(),
        });
        let (name, beside) = (output.name(), beside.collect::<String>());
        let call = format!("arm.{name}({constants}x[:, :{n}]{beside}){}", rows(&output));
        calls.push_str(&format!("found.append(columns({call}))\n"));
    }
    calls.push_str(&format!("together = arm.all({constants}x[:, :{n}], x[:, -6:])\n"));
    for output in Output::ALL {
        let array = format!("together[\"{}\"]{}", output.name(), rows(&output));
        calls.push_str(&format!("found.append(columns({array}))\n"));
    }
    folder.write("arm.py", &python(&robot));
    folder.write("main.py", &MAIN.replace("OUTPUTS\n", &calls));
    let mut python = Command::new("python3");
    python.arg("main.py").current_dir(folder.path());
    spoken(python, &case.input()).lines().map(str::to_owned).collect()
}
