//! The text as Rust: a crate of its own beside the kernels of this workspace, built and run.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::Command;

use stiffarm::kernels::{Form, Output};
use stiffarm_codegen::emit::{RustOptions, rust};

use crate::batch::{Batch, Case};
use crate::compiler::spoken;

/// The manifest: a workspace by itself, so that it takes features of nobody.
const MANIFEST: &str = r#"[package]
name = "printed"
version = "0.0.0"
edition = "2024"

[dependencies]
stiffarm-kernels = { path = "KERNELS" }

[features]
dispatch = ["stiffarm-kernels/dispatch"]
fma = ["stiffarm-kernels/fma"]
lanes = ["stiffarm-kernels/lanes"]
libm = ["stiffarm-kernels/libm"]

[workspace]

[profile.dev]
debug = false
"#;

const MAIN: &str = r#"#![deny(warnings)]
#![allow(dead_code)]

use std::fmt::Write as _;
use std::io::BufRead as _;

use stiffarm_kernels::{Kernels, Output, Pose};

type Answers = Vec<Option<Vec<f64>>>;

fn flat(pose: Pose<f64>) -> Vec<f64> {
    pose.columns().as_flattened().to_vec()
}

fn by_output(robot: &dyn Kernels<f64>, state: &[f64], wrench: &[f64; 6]) -> Answers {
    let one = |output: Output| {
        let (rows, columns) = output.shape(robot.dof());
        let mut out = vec![0.0; rows * columns];
        let state = &state[..output.state(robot.dof())];
        robot.evaluate(output, state, wrench, &mut out).ok().map(|()| out)
    };
    robot.outputs().iter().copied().map(one).collect()
}

fn main() {
    for line in std::io::stdin().lock().lines() {
        let line = line.expect("a line");
        let mut words = line.split_whitespace();
        let arm = words.next().expect("an arm");
        let read = |word| f64::from_bits(u64::from_str_radix(word, 16).expect("bits"));
        let mut q: Vec<f64> = words.map(read).collect();
        let wrench = q.split_off(q.len() - 6).try_into().expect("six");
        let mut out = String::new();
        for answer in answers(arm, &q, &wrench) {
            match answer {
                Some(numbers) => {
                    out.push('0');
                    numbers.iter().for_each(|x| write!(out, " {:x}", x.to_bits()).expect("written"));
                }
                None => out.push('1'),
            }
            out.push('\n');
        }
        print!("{out}");
    }
}
"#;

/// For every arm the answers of the plain text to all questions, then those of the fused one; with a
/// feature of the kernels, and what the compiler is told.
pub fn answers(batch: &Batch, (feature, flags): (&str, &str)) -> Vec<Vec<String>> {
    // Batches that run side by side differ by one or the other; those that follow each other find the kernels compiled.
    let name = format!("printed-{}-{feature}", batch.cases.len());
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let source = folder.join("src");
    fs::create_dir_all(&source).expect("a folder");
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let kernels = root.join("kernels");
    let manifest = MANIFEST.replace("KERNELS", kernels.to_str().expect("UTF-8"));
    fs::write(folder.join("Cargo.toml"), manifest).expect("written");
    fs::copy(root.join("Cargo.lock"), folder.join("Cargo.lock")).expect("the versions in use");

    let mut main = String::from(MAIN);
    let mut arms =
        String::from("fn answers(arm: &str, q: &[f64], wrench: &[f64; 6]) -> Answers {\n");
    arms.push_str("    match arm {\n");
    for case in &batch.cases {
        for (fused, suffix) in [(false, ""), (true, "_fused")] {
            let module = format!("{}{suffix}", case.name);
            let options = RustOptions { kernels: "::stiffarm_kernels".to_owned(), fused };
            let text = rust(&case.table.robot(), &options);
            fs::write(source.join(&module).with_extension("rs"), text).expect("written");
            main.push_str(&glue(case, &module));
            let _ = writeln!(arms, "        \"{module}\" => of_{module}(q, wrench),");
        }
    }
    arms.push_str("        _ => unreachable!(\"no such arm\"),\n    }\n}\n");
    fs::write(source.join("main.rs"), main + &arms).expect("written");
    let mut cargo = Command::new(env!("CARGO"));
    // Not `--offline`: `dispatch` needs a package that nothing else of the workspace has fetched.
    cargo.args(["build", "--quiet", "--features", feature, "--target-dir", "target"]);
    cargo.env("RUSTFLAGS", flags).current_dir(&folder);
    let built = cargo.output().expect("cargo starts");
    let said = String::from_utf8_lossy(&built.stderr);
    assert!(built.status.success(), "seed {}, {}:\n{said}", batch.seed, folder.display());
    let program = folder.join("target/debug/printed");
    batch.cases.iter().map(|case| run(&program, case)).collect()
}

/// The function that asks one module.
fn glue(case: &Case, module: &str) -> String {
    let robot = case.table.robot();
    let symbols: Vec<String> = robot.symbols().into_iter().map(|symbol| symbol.name).collect();
    let (setting, kernels, constants) = match symbols.is_empty() {
        true => (String::new(), format!("{module}::Robot"), ""),
        false => {
            let value =
                |name: &String| format!("{name}: {:?}", case.table.value(name).expect("a value"));
            let fields: Vec<String> = symbols.iter().map(value).collect();
            let setting = format!(
                "    let parameters = {module}::Parameters {{ {} }};\n    \
                 let constants = &{module}::Constants::new(&parameters);\n",
                fields.join(", ")
            );
            (setting, format!("{module}::Robot::new(&parameters)"), "constants, ")
        }
    };
    let field = |output: &Output| match output.form() {
        Form::Pose => "flat(all.pose)".to_owned(),
        Form::Vector => format!("all.{}.to_vec()", output.name()),
        Form::Poses | Form::Matrix => {
            format!("all.{}.as_flattened().to_vec()", output.name())
        }
        Form::Stack => format!("all.{}.as_flattened().as_flattened().to_vec()", output.name()),
    };
    let fields: Vec<String> = Output::ALL.iter().map(field).collect();
    format!(
        "
mod {module};

fn of_{module}(q: &[f64], wrench: &[f64; 6]) -> Answers {{
{setting}    let mut answers = by_output(&{kernels}, q, wrench);
    let q = &q[..{module}::N];
    let together = {module}::all({constants}q.try_into().expect(\"as many as joints\"), wrench);
    match together {{
        Ok(all) => answers.extend([{}].map(Some)),
        Err(_) => answers.extend([const {{ None }}; {}]),
    }}
    answers
}}
",
        fields.join(", "),
        Output::ALL.len()
    )
}

fn run(program: &Path, case: &Case) -> Vec<String> {
    let mut input = String::new();
    for suffix in ["", "_fused"] {
        for question in &case.questions {
            let words = question.q.iter().chain(&question.wrench);
            let _ = write!(input, "{}{suffix}", case.name);
            words.for_each(|x| input.push_str(&format!(" {:x}", x.to_bits())));
            input.push('\n');
        }
    }
    spoken(Command::new(program), &input).lines().map(str::to_owned).collect()
}
