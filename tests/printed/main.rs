//! The printed text of random tables, compiled and run: Rust with plain and with fused products, C, CUDA C and Python,
//! against the textbook. Brackets, signs, and the splitting of long functions are tested where they break;
//! and the kernels' features by what they do to values.
//!
//! ```text
//! cargo test -p stiffarm --test printed                   # two arms; six with STIFFARM_THOROUGH=1
//! cargo test -p stiffarm --test printed -- --ignored      # hundreds
//! ```
//!
//! C is compiled by the `cc` that Rust links with; where it links with another, the tests that need it are
//! ignored.

mod batch;
#[path = "../parity/boundary.rs"]
mod boundary;
mod c;
#[macro_use]
#[allow(dead_code, unused_imports, unused_macros)]
#[path = "../parity/compare.rs"]
mod compare;
#[allow(dead_code, unused_imports, unused_macros)]
#[path = "../c/compiler.rs"]
mod compiler;
mod cuda;
#[path = "../c/program.rs"]
mod program;
mod python;
mod rust;
#[path = "../parity/tables.rs"]
mod tables;

use std::process::ExitCode;

use libtest_mimic::{Arguments, Failed, Trial};

use batch::{Batch, Case};

/// Batches of the full form.
const BATCHES: u64 = 24;

/// Joints of the arms of a batch; the long ones have functions in several parts.
const JOINTS: [usize; 12] = [1, 2, 3, 4, 5, 6, 7, 8, 9, 6, 13, 16];

/// Of the quick forms.
const SIX: [usize; 6] = [1, 2, 4, 6, 7, 16];
const TWO: [usize; 2] = [4, 7];

/// Features of the kernels, with what the compiler is told. Without any: the other tests.
const FEATURES: [(&str, &str); 4] =
    [("lanes", ""), ("dispatch", ""), ("libm", ""), ("fma", "-C target-feature=+fma")];

fn main() -> ExitCode {
    type Print = fn(&Batch) -> Vec<Vec<String>>;
    // What a form needs beside Rust is in the name of its test.
    let forms: [(&str, &str, Print, bool); 4] = [
        ("rust", "", |batch| rust::answers(batch, ("", "")), false),
        ("c", "", c::answers, cfg!(not(unix))),
        ("cuda", "", cuda::answers, cfg!(not(unix))),
        ("python", "_needs_numpy", python::answers, true),
    ];
    let mut trials = Vec::new();
    let (few, features) = stiffarm_draws::few_or_many((&TWO[..], 0), (&SIX[..], FEATURES.len()));
    for (form, needs, print, missing) in forms {
        let quick = move || check(form, &Batch::new(0, few), print);
        trials.push(Trial::test(format!("{form}_of_few{needs}"), quick).with_ignored_flag(missing));
        let full = move || {
            (1..=BATCHES).try_for_each(|seed| check(form, &Batch::new(seed, &JOINTS), print))
        };
        trials.push(Trial::test(format!("{form}_of_hundreds"), full).with_ignored_flag(true));
    }
    for (feature, flags) in FEATURES.into_iter().take(features) {
        let run = move || {
            check(feature, &Batch::new(25, &[6, 7]), |batch| rust::answers(batch, (feature, flags)))
        };
        let missing = !flags.is_empty() && !fuses();
        let trial = Trial::test(format!("rust_under_{feature}"), run);
        trials.push(trial.with_ignored_flag(missing));
    }
    let assembled = || Ok(cuda::assembled(&Batch::new(0, few))?);
    trials.push(Trial::test("cuda_needs_clang", assembled).with_ignored_flag(true));
    libtest_mimic::run(&Arguments::from_args(), trials).exit_code()
}

/// Whether this machine has the instruction that rounds a product and a sum once.
fn fuses() -> bool {
    #[cfg(target_arch = "x86_64")]
    return std::arch::is_x86_feature_detected!("fma");
    #[cfg(not(target_arch = "x86_64"))]
    return false;
}

/// Compares what the printed text of every arm says, line by line, in the order of the batch's questions.
fn check(
    form: &str,
    batch: &Batch,
    print: impl Fn(&Batch) -> Vec<Vec<String>>,
) -> Result<(), Failed> {
    for (case, lines) in batch.cases.iter().zip(print(batch)) {
        compare(case, &lines).map_err(|said| {
            format!("{form}, seed {}, {}: {said}\n{}", batch.seed, case.name, case.table.text)
        })?;
    }
    Ok(())
}

fn compare(case: &Case, lines: &[String]) -> Result<(), String> {
    let expected: Vec<_> = case.questions.iter().flat_map(|question| &question.answers).collect();
    if lines.is_empty() || !lines.len().is_multiple_of(expected.len()) {
        return Err(format!("{} lines for {} answers", lines.len(), expected.len()));
    }
    // Plain text, then fused.
    for (line, answer) in lines.iter().zip(expected.iter().cycle()) {
        answer.compare(line)?;
    }
    Ok(())
}
