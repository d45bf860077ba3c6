//! docs/workbench.md: every command on the page prints what the page shows and writes the files
//! that stand beside it. With STIFFARM_WRITE_DOCS set the page and the files are written anew.

use std::path::Path;

use crate::support::{Folder, REPOSITORY, Table, arm_of, moved, read, stiffarm, text};

const PAGE: &str = "docs/workbench.md";

/// Options behind which the name of a file stands that the command writes.
const WRITES: [&str; 5] = ["--csv", "--svg", "--out", "--toml", "--write-robot"];

/// The fenced blocks of a page: their language and their lines.
fn blocks(page: &str) -> Vec<(String, String)> {
    let mut found: Vec<(String, String)> = Vec::new();
    let mut open = false;
    for line in page.lines() {
        match (line.strip_prefix("```"), open) {
            (Some(language), false) => {
                found.push((language.to_owned(), String::new()));
                open = true;
            }
            (Some(_), true) => open = false,
            (None, true) => {
                if let Some((_, content)) = found.last_mut() {
                    content.push_str(line);
                    content.push('\n');
                }
            }
            (None, false) => {}
        }
    }
    found
}

fn write_anew() -> bool {
    std::env::var_os("STIFFARM_WRITE_DOCS").is_some()
}

/// A committed file is what was made; with STIFFARM_WRITE_DOCS set it is written first.
#[track_caller]
pub fn same(committed: &str, made: &str) {
    if write_anew() {
        std::fs::write(Path::new(REPOSITORY).join(committed), made)
            .expect("the folder can be written to");
    }
    let kept = read(committed);
    assert!(kept == made, "{committed} is not what its command writes:\n{made}");
}

#[test]
fn the_page_shows_what_the_commands_do() {
    let page = read(PAGE);
    let folder = Folder::new();
    let blocks = blocks(&page);
    let mut commands = 0;
    for (k, (_, block)) in blocks.iter().enumerate().filter(|(_, (lang, _))| lang == "sh") {
        let joined = block.replace("\\\n", " ");
        let mut words: Vec<String> = joined.split_whitespace().skip(1).map(str::to_owned).collect();
        let mut files = Vec::new();
        for at in 1..words.len() {
            if WRITES.contains(&words[at - 1].as_str()) {
                let made = text(&folder.path(&format!("made{at}")));
                files.push((core::mem::replace(&mut words[at], made.clone()), made));
            }
        }
        let run = stiffarm(&words);
        let (language, shown) = &blocks[k + 1];
        assert_eq!(language, "text", "what {words:?} prints");
        let printed = format!("{}{}", run.out, run.err);
        if write_anew() {
            let behind = |shown: &str| format!("```sh\n{block}```\n\n```text\n{shown}```\n");
            let page = read(PAGE);
            let page = page.replacen(&behind(shown), &behind(&printed), 1);
            std::fs::write(Path::new(REPOSITORY).join(PAGE), page)
                .expect("the page can be written to");
        } else {
            assert_eq!(*shown, printed, "{words:?}");
        }
        for (committed, made) in files {
            same(&committed, &std::fs::read_to_string(made).expect("written"));
        }
        commands += 1;
    }
    let all = "import, poses, identify, simulate, diagnose, compensate, measurements";
    assert_eq!(commands, 7, "{all}");
}

/// Errors of 20 µm that look like any: sines of large multiples, three added.
fn jitter(row: usize, component: usize) -> f64 {
    let part = |k: usize| (12.9898 * (3 * row + component + 1) as f64 * k as f64 + 0.7).sin();
    2e-5 * (part(78) + part(431) + part(937)) * (2.0_f64 / 3.0).sqrt()
}

/// The measured file is the plan, filled in by the simulator: joint 2 has little more than half of its file's stiffness.
#[test]
fn the_measurements_of_the_page_are_the_plan_filled_in() {
    let mut arm = arm_of(&read("docs/workbench/arm.toml"));
    let stiffness = [3.5e6, 3.6e6, 4.1e6, 5.2e5, 6.9e5, 4.4e5];
    arm.joints.iter_mut().zip(stiffness).for_each(|(joint, k)| joint.compliance = 1.0 / k);
    let plan = read("docs/workbench/plan.csv");
    let filled = Table::of(&plan).filled(|row, q, load| {
        let moved = moved(&arm, q, load);
        [0, 1, 2].map(|k| format!("{:.3}", 1e3 * (moved[k] + jitter(row + 1, k))))
    });
    let remark = "# The plan, measured: simulated, with errors of 0.02 mm.\n";
    same("docs/workbench/run.csv", &(remark.to_owned() + &filled));
}
