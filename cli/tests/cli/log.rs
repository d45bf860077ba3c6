//! `stiffarm diagnose` of joint logs.

mod guide;
mod outcome;
mod real;

use std::fmt::Write as _;

use stiffarm_gap::rng::{Rng, Stream};

use crate::support::{Folder, Table, flat, has, list, number, read, run, stiffarm};

const PENDULUM: &str = include_str!("log/pendulum.toml");

/// Torque of a point mass of 3 kg at 0.8 m, with 2 N·m of Coulomb friction and 0.7 N·m·s/rad: rows at
/// 100 Hz under a header.
fn rows(header: &str) -> String {
    let mut rng = Rng::new(5, Stream::Noise);
    let mut text = format!("{header}\n");
    for k in 0..6000 {
        let t = 0.01 * f64::from(k);
        let waves = [(0.6, 1.1, 0.0), (0.4, 2.3, 1.0), (0.2, 3.7, 2.0)];
        let sum = |of: fn(f64, f64, f64) -> f64| {
            waves.iter().map(|(size, rate, phase)| of(*size, *rate, rate * t + phase)).sum::<f64>()
        };
        let q = sum(|size, _, at| size * at.sin());
        let v = sum(|size, rate, at| size * rate * at.cos());
        let a = sum(|size, rate, at| -size * rate * rate * at.sin());
        let weight = 3.0 * 0.8 * 9.80665 * q.cos();
        let torque = 3.0 * 0.64 * a + weight + 2.0 * v.signum() + 0.7 * v + 0.1 * rng.normal();
        writeln!(text, "{t:.2},{q:.7},{torque:.4}").expect("text");
    }
    text
}

const HEADER: &str = "t[s],q1[rad],tau1[N*m]";

#[test]
fn friction_is_told_with_its_numbers() {
    let folder = Folder::new();
    let robot = folder.file("pendulum.toml", PENDULUM);
    let log = folder.file("log.csv", rows(HEADER));
    let json = folder.name("log.json");
    let out = run(&format!("diagnose {robot} {log} --torque-side motor --json {json}")).good();
    has(&out, &["Coulomb friction at joint 1", "viscous friction at joint 1"]);
    assert!(out.contains("torque scale at every joint: with free masses"), "{out}");
    assert!(out.lines().all(|line| line.chars().count() <= 100), "{out}");
    let text = read(&json);
    let found = crate::support::json(&text);
    let value = |effect: &str| {
        let finding = list(&found["findings"]).iter().find(|f| f["effect"] == effect);
        number(&finding.expect("found")["parameters"][0]["value"])
    };
    // The noise of 0.1 N·m over some hundred independent numbers.
    assert!((value("coulomb_friction") - 2.0).abs() < 0.03, "{text}");
    assert!((value("viscous_friction") - 0.7).abs() < 0.03, "{text}");
    assert_eq!(found["torque_side"], "motor");
    // Of one joint the whole is its own.
    let (shrink, gap) = (&found["shrink"], &found["gap"][0]);
    let part = 1.0 - number(&gap["after"]) / number(&gap["before"]);
    let [low, high] = [0, 1].map(|end| number(&shrink["shrink_ci95"][end]));
    assert!((number(&shrink["shrink"]) - part).abs() < 1e-12, "{text}");
    assert!(low < part && part < high && high - low < 0.2, "{text}");
    let [part, low, high] = [part, low, high].map(|x| (100.0 * x).round());
    let told = flat(&out);
    assert!(told.contains(&format!("{part} % less [{low} to {high}]")), "{out}");
}

#[test]
fn others_names_and_damaged_rows_are_read() {
    let folder = Folder::new();
    let robot = folder.file("pendulum.toml", PENDULUM);
    let mut text = rows("timestamp,actual_q_0,actual_current_0");
    text.push_str("60.00,1e306,1\n60.01,0.1\n");
    let log = folder.file("rtde.csv", text);
    let run = stiffarm(&["diagnose", &robot, &log, "--map", "rtde"]).ended(0);
    has(&run.err, &["2 of 6002 rows are damaged and left out: line 6002, 6003"]);
    // A column of currents says itself what it is; its friction is in ampere.
    assert!(run.out.contains("torques, current") && run.out.contains("] A\n"), "{}", run.out);
}

/// The search that has not seen a block leaves at least what the fit of all findings leaves, and of two
/// effects that are a hundred times their noise not much more.
#[test]
fn the_search_is_held_out_where_that_is_asked_for() {
    let folder = Folder::new();
    let robot = folder.file("pendulum.toml", PENDULUM);
    let log = folder.file("log.csv", rows(HEADER));
    let json = folder.name("log.json");
    let only = "--torque-side motor --effects coulomb_friction,viscous_friction,rotor_inertia";
    let page = folder.name("log.html");
    let written = format!("--json {json} --report {page}");
    let out = run(&format!("diagnose {robot} {log} {only} --nested {written}")).good();
    assert!(out.contains("search repeated") && out.contains("With the search repeated"), "{out}");
    let page = read(&page);
    assert!(page.contains("<th scope=\"col\">search repeated</th>"), "{page}");
    let found = crate::support::json(&read(&json));
    let of = |name: &str| number(&found["gap"][0][name]);
    assert!((0.99..1.1).contains(&(of("nested") / of("after"))), "{}", found["gap"]);
    assert!(!run(&format!("diagnose {robot} {log} {only}")).good().contains("search repeated"));
}

#[test]
fn degrees_and_slow_logs_are_told() {
    let folder = Folder::new();
    let robot = folder.file("pendulum.toml", PENDULUM);
    let all = Table::of(&rows(HEADER)).all();
    let file = |name: &str, every: usize, factor: f64| {
        let told = |r: &Vec<f64>| format!("{},{},{}\n", r[0], factor * r[1], r[2]);
        let lines: String = all.iter().step_by(every).map(told).collect();
        folder.file(name, format!("# torque_side = motor\n{HEADER}\n{lines}"))
    };
    let few = |log: String, more: &str| {
        run(&format!("diagnose {robot} {log} --effects coulomb_friction,latency,presliding {more}"))
    };
    let told = few(file("degrees.csv", 1, 180.0 / core::f64::consts::PI), "");
    assert!(told.err.contains("are they in degrees? write q1[deg]"), "{}", told.err);
    let out = few(file("slow.csv", 10, 1.0), "").good();
    assert!(out.contains("latency at the interface: a sample every 100 ms is held"), "{out}");
    assert!(out.contains("presliding at joint 1: its reversals are over in"), "{out}");
    let out = few(file("fast.csv", 1, 1.0), "--band 20Hz").good();
    assert!(!out.contains("its reversals are over in"), "{out}");
}
