//! How the generated text grows with the number of joints: operations, bytes, how long the
//! generator takes and how long the compiler, and what it gains over the textbook.
//!
//! ```text
//! cargo bench -p stiffarm-growth --bench joints -- --svg docs
//! cargo bench -p stiffarm-growth --bench joints -- --most 10
//! ```
//!
//! The compiler is timed on the text with every output instantiated for f64: checked, compiled as it
//! is, and optimised. The arms have no two axes parallel, no two alike, and a spring in every
//! joint; arms that are built of right angles take less.

use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

use nalgebra::Vector6;
use stiffarm_codegen::derive::{Output, derive};
use stiffarm_codegen::emit::{RustOptions, rust};
use stiffarm_codegen::robot::{Robot, Source, parse_tokens};
use stiffarm_growth::alone;
use stiffarm_growth::chart::Chart;
use stiffarm_growth::compiler::Compiler;

const JOINTS: [usize; 10] = [2, 3, 4, 6, 7, 10, 15, 20, 30, 40];

/// Runs of the generator, of which the shortest counts.
const RUNS: usize = 3;

/// Poses that the textbook is timed at.
const POSES: usize = 256;

/// The load, N and N·m.
const WRENCH: [f64; 6] = [30.0, -20.0, -240.0, 4.0, -3.0, 2.0];

fn main() -> Result<(), Box<dyn Error>> {
    let most = alone::option("--most").unwrap_or(usize::MAX);
    let compiler = Compiler::new()?;
    println!(
        "        additions and multiplications          text                 compiler, s             \
         Jacobian, ns   deflection, ns\n\
         joints  pose  Jacobian   K_C  first  compl.    kB  made, ms  checked  plain  optimised   \
         own  textbook   own  textbook"
    );
    let mut lines = ["Jacobian, operations", "compliance, operations", "text, kB", "optimised, ms"]
        .map(|name| (name, Vec::new()));
    for joints in JOINTS.into_iter().filter(|joints| *joints <= most) {
        let robot = robot(joints)?;
        let each = [
            Output::Pose,
            Output::Jacobian,
            Output::ComplementaryStiffness,
            Output::DeflectionFirstOrder,
            Output::Compliance,
        ];
        let flops = each.map(|output| derive(&robot, &[output]).ops().flops());
        let (generated, text) = generate(&robot);
        let compiled = compiler.compile(&text)?;
        let arm = stiffarm_gap::robot::arm(&robot)?;
        let textbook = [
            textbook(joints, |q| arm.jacobian(q)),
            textbook(joints, |q| arm.deflection_first_order(q, &load())),
        ];
        println!(
            "{joints:>6} {:>5} {:>9} {:>5} {:>6} {:>7} {:>5.0} {:>9.1} {:>8.2} {:>6.2} {:>10.2} \
             {:>5.0} {:>9.0} {:>5.0} {:>9.0}",
            flops[0],
            flops[1],
            flops[2],
            flops[3],
            flops[4],
            1e-3 * text.len() as f64,
            1e3 * generated,
            compiled.checked,
            compiled.unoptimised,
            compiled.optimised,
            compiled.jacobian,
            textbook[0],
            compiled.deflection,
            textbook[1]
        );
        let counts = [f64::from(flops[1]), f64::from(flops[4])];
        let sizes = [1e-3 * text.len() as f64, 1e3 * compiled.optimised];
        for ((_, line), value) in lines.iter_mut().zip(counts.into_iter().chain(sizes)) {
            line.push([joints as f64, value]);
        }
    }
    let chart = Chart {
        title: "The generated text by the number of joints",
        subtitle: "no two axes parallel, a spring in every joint; operations without sines",
        description: "Operations, size and compile time of the generated text by joints.",
        x: "joints",
        y: "operations, kilobytes, milliseconds",
        lines: lines.into(),
    };
    Ok(chart.write("growth_joints.svg")?)
}

/// An arm with so many joints, none parallel to the next, each with a spring.
fn robot(joints: usize) -> Result<Robot, Box<dyn Error>> {
    let row = |i: usize| {
        let (d, a) = (100 + 10 * (i * 7 % 5), 200 + 10 * (i * 3 % 7));
        let (offset, twist) = (10 * (i % 7), 50 + 10 * (i % 3));
        format!("j{i} | q + {offset} deg | {d} mm | {a} mm | {twist} deg | 1e5\n")
    };
    let rows: String = (1..=joints).map(row).collect();
    let table = format!(
        "mod arm; convention: standard_dh;\njoint | theta | d | a | alpha | stiffness\n{rows}"
    );
    let tokens = table.parse().map_err(|_| "the table has no tokens")?;
    match parse_tokens(tokens).map(|invocation| invocation.source) {
        Ok(Source::Table(robot)) => Ok(*robot),
        _ => Err("the table is not valid".into()),
    }
}

/// Seconds, and the text.
fn generate(robot: &Robot) -> (f64, String) {
    let options = RustOptions { kernels: "::stiffarm_kernels".to_owned(), fused: false };
    let mut shortest = f64::INFINITY;
    let mut text = String::new();
    for _ in 0..RUNS {
        let begin = Instant::now();
        text = rust(robot, &options);
        shortest = shortest.min(begin.elapsed().as_secs_f64());
    }
    (shortest, text)
}

fn load() -> Vector6<f64> {
    Vector6::from_column_slice(&WRENCH)
}

/// Nanoseconds per pose of the textbook: the median of some rounds.
fn textbook<T>(joints: usize, f: impl Fn(&[f64]) -> T) -> f64 {
    let angle = |k: usize| 3.0 * (k as f64 * 0.618_033_988_749_895).fract() - 1.5;
    let q: Vec<f64> = (0..joints * POSES).map(angle).collect();
    let mut times: Vec<f64> = (0..9)
        .map(|_| {
            let begin = Instant::now();
            q.chunks_exact(joints).for_each(|q| drop(black_box(f(q))));
            1e9 * begin.elapsed().as_secs_f64() / POSES as f64
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}
