//! The text as C, one program for each arm.

use stiffarm_codegen::emit::{Precision, Sines};

use crate::batch::{Batch, Case, level};
use crate::compiler::{Folder, compile, run};
use crate::program::program;

/// For every arm the answers to all questions.
pub fn answers(batch: &Batch) -> Vec<Vec<String>> {
    batch.cases.iter().map(|case| of(case, batch.seed)).collect()
}

fn of(case: &Case, seed: u64) -> Vec<String> {
    let (name, robot) = (&case.name, case.table.numeric());
    let folder = Folder::new(&format!("printed-{seed}-{name}"));
    folder.write_c(&robot, name, (Precision::F64, Sines::Polynomial));
    folder.write("main.c", &program(name, &robot, Precision::F64));
    compile("cc", &folder, &[level(seed), "main.c", &format!("{name}.c"), "-o", name, "-lm"]);
    run(&folder, name, &case.input()).lines().map(str::to_owned).collect()
}
