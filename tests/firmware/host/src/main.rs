//! The full form of the proof; `tests/firmware/run` calls it.

use std::env;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Instant;

use stiffarm_firmware_arms::Real;
use stiffarm_firmware_host::bits::Results;
use stiffarm_firmware_host::board::Board;
use stiffarm_firmware_host::c::{self, Contraction};
use stiffarm_firmware_host::tools::{Tools, refused};
use stiffarm_firmware_host::{Failure, budget, docs, figures};

const USAGE: &str = "usage: proof [--check]
  Images for both boards, run in the emulator; writes the figures into docs/firmware.md.
  --check  does not write
  With STIFFARM_FIRMWARE_PREFIX set, the tools of that folder; otherwise those on the path.";

fn main() -> ExitCode {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let done = match words[..] {
        [] => full(true),
        ["--check"] => full(false),
        _ => Err(USAGE.to_owned()),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("error: {failure}");
            ExitCode::FAILURE
        }
    }
}

/// Says what is done, and how long it took.
fn step<T>(what: &str, work: impl FnOnce() -> Result<T, Failure>) -> Result<T, Failure> {
    let start = Instant::now();
    let done = work().map_err(|failure| format!("{what}: {failure}"))?;
    println!("{what}: {:.0} s", start.elapsed().as_secs_f64());
    Ok(done)
}

fn full(write: bool) -> Result<(), Failure> {
    let prefix = env::var_os("STIFFARM_FIRMWARE_PREFIX").map(PathBuf::from);
    let tools = Tools::new(prefix)?;
    let budgets = budget::read(&tools.workspace.join("budgets.toml"))?;
    let mut tables = String::new();
    for program in ["rustc", "arm-none-eabi-gcc", "qemu-system-arm"] {
        let version = tools.version(program)?;
        println!("{version}");
        tables.push_str(&format!("- {version}\n"));
    }
    let mut faults = Vec::new();
    let each = [(Board::M4, prove::<f32> as Proof, true), (Board::M7, prove::<f64>, false)];
    for (board, prove, in_c) in each {
        println!("\n{}", board.name);
        let figures = prove(&tools, board, in_c)?;
        let table = docs::table(board, &figures, &budgets);
        println!("{table}");
        tables.push_str(&table);
        let of_board = budgets.get(board.key).cloned().unwrap_or_default();
        faults.extend(budget::exceeded(board.name, &figures, &of_board));
    }
    if write {
        docs::write(&tools.workspace.join("../../docs/firmware.md"), &tables)?;
    }
    match faults.is_empty() {
        true => Ok(()),
        false => Err(faults.join("\n       ")),
    }
}

/// What [`prove`] is for the numbers of a board.
type Proof = fn(&Tools, Board, bool) -> Result<Vec<figures::Figure>, Failure>;

/// Everything about one board; in C too where asked.
fn prove<S: Real>(
    tools: &Tools,
    board: Board,
    in_c: bool,
) -> Result<Vec<figures::Figure>, Failure> {
    let image = step("links without a panic and without alloc", || {
        tools.build(board, "bits", &[], &[], "bits")
    })?;
    step("control: one indexed access does not link", || {
        let built = tools.build(board, "bits", &["control-panic"], &[], "control");
        refused(built, &["a_panic_can_be_reached"])
    })?;
    step("control: an allocator does not build", || {
        let built = tools.build(board, "bits", &["control-alloc"], &[], "control");
        refused(built, &["E0463", "no global memory allocator"])
    })?;
    let expected = Results::<S>::of_the_host();
    step(&format!("{} numbers have the host's bits", expected.count()), || {
        compare(&tools.emulate(board, &image)?, &expected, true)
    })?;
    let (mut objects, mut features) = (Vec::new(), &[][..]);
    if in_c {
        features = &["c"];
        let expected = expected.of_kernels();
        let compared = |objects: &[PathBuf]| {
            let image = tools.build(board, "c_bits", features, objects, "c_bits")?;
            compare(&tools.emulate(board, &image)?, &expected, false)
        };
        objects = step(&format!("{} numbers by C have the host's bits", expected.count()), || {
            let objects = c::objects(tools, Contraction::Off)?;
            compared(&objects).map(|()| objects)
        })?;
        step("control: C with contracted products has not", || {
            let objects = c::objects(tools, Contraction::Fast)?;
            refused(compared(&objects), &["host and board differ"])
        })?;
    }
    step("instructions, stack and flash are counted", || {
        let image = tools.build(board, "figures", features, &objects, "figures")?;
        figures::read(&tools.emulate(board, &image)?, &image)
    })
}

/// The same bits; and a reference with one bit turned over is found out.
fn compare<S: Real>(sent: &[u8], expected: &Results<S>, with_loops: bool) -> Result<(), Failure> {
    expected.are_whole(with_loops)?;
    let found = Results::<S>::read(sent)?;
    if let Some(difference) = expected.difference(&found) {
        return Err(format!("host and board differ: {difference}"));
    }
    match expected.tampered().difference(&found) {
        Some(_) => Ok(()),
        None => Err("a reference with one bit turned over was not found out".to_owned()),
    }
}
