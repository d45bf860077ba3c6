//! How long the macro makes the compiler wait, and how much text it hands over: per robot of the
//! collection, and for arms of 2 to 40 joints.
//!
//! ```text
//! cargo bench -p stiffarm --bench expansion
//! cargo bench -p stiffarm --bench expansion --profile dev    # the generator as an unoptimised build has it
//! ```

use std::path::Path;
use std::time::{Duration, Instant};

use proc_macro2::TokenStream;
use stiffarm_codegen::emit::{RustOptions, rust};
use stiffarm_codegen::expand;
use stiffarm_codegen::robot::Robot;

const RUNS: usize = 5;

/// The shortest of a few runs.
fn shortest<T>(run: impl Fn() -> T) -> (Duration, T) {
    let timed = || {
        let start = Instant::now();
        let value = run();
        (start.elapsed(), value)
    };
    let runs = (0..RUNS).map(|_| timed());
    runs.min_by_key(|(time, _)| *time).expect("at least one run")
}

fn line(name: &str, joints: usize, robot: &Robot, invocation: &str) {
    let input: TokenStream = invocation.parse().expect("tokens");
    let (text_time, text) = shortest(|| rust(robot, &RustOptions::default()));
    let (time, _) = shortest(|| expand(input.clone(), Path::new(".")));
    let ms = |time: Duration| 1e3 * time.as_secs_f64();
    let (kilobytes, lines) = (text.len() / 1000, text.lines().count());
    println!(
        "{name:<22} {joints:>6} {:>8.1} ms {:>8.1} ms {kilobytes:>6} kB {lines:>7}",
        ms(text_time),
        ms(time)
    );
}

/// An arm with so many joints, none parallel to the next, each with a spring and a mass.
fn table(joints: usize) -> String {
    let row = |i: usize| {
        let (offset, twist) = (10 * (i % 7), 50 + 10 * (i % 3));
        format!(
            "j{i} | q + {offset} deg | 0.1 | 0.2 | {twist} deg | 1e5 | 2 | [-0.1, 0.01, 0.02]\n"
        )
    };
    let rows: String = (1..=joints).map(row).collect();
    let header = "joint | theta | d | a | alpha | stiffness | mass | com";
    format!("mod arm; convention: standard_dh;\n{header}\n{rows}")
}

fn main() {
    println!("{:<22} joints         text   expansion      size   lines", "robot");
    let arms = stiffarm_robots::ARMS.iter().map(|arm| (arm.id, arm.toml));
    let symbolic = stiffarm_robots::SYMBOLIC.iter().map(|arm| (arm.id, arm.toml));
    for (id, toml) in arms.chain(symbolic) {
        let (robot, _) = Robot::from_toml(toml, id).expect("a valid file");
        let invocation = format!("mod arm from \"robots/arms/{id}.toml\";");
        line(id, robot.dof(), &robot, &invocation);
    }
    for joints in [2, 4, 6, 7, 10, 15, 20, 30, 40] {
        let input = table(joints);
        let parsed = stiffarm_codegen::robot::parse_tokens(input.parse().expect("tokens"));
        let Ok(stiffarm_codegen::robot::Source::Table(robot)) = parsed.map(|i| i.source) else {
            panic!("the table is valid");
        };
        line("oblique, heavy", joints, &robot, &input);
    }
}
