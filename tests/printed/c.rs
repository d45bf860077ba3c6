//! The text as C, one program for each arm.

use stiffarm_codegen::emit::{COptions, Precision, Sines, c};

use crate::batch::{Batch, Case};
use crate::compiler::{Folder, compile, run};
use crate::program::program;

/// For every arm the answers to all questions.
pub fn answers(batch: &Batch) -> Vec<Vec<String>> {
    batch.cases.iter().map(|case| of(case, batch.seed)).collect()
}

fn of(case: &Case, seed: u64) -> Vec<String> {
    let (name, robot) = (&case.name, case.table.numeric());
    let folder = Folder::new(&format!("printed-{seed}-{name}"));
    let (precision, sines) = (Precision::F64, Sines::Polynomial);
    let files =
        c(&robot, &COptions { name: name.clone(), precision, sines }).expect("numbers only");
    folder.write(&format!("{name}.h"), &files.header);
    folder.write(&format!("{name}.c"), &files.source);
    folder.write("main.c", &program(name, &robot, precision));
    compile("cc", &folder, &["-O1", "main.c", &format!("{name}.c"), "-o", name, "-lm"]);
    run(&folder, name, &case.input()).lines().map(str::to_owned).collect()
}
