//! `stiffarm papers`.

use crate::support::{Folder, has, read, stiffarm};

#[test]
#[ignore = "needs time: all five papers"]
fn needs_time_the_built_in_ledger_names_the_misprints() {
    let out = stiffarm(&["papers"]).good();
    has(&out, &["Dumas", "Knapczyk", "Lin", "Jweeg", "Bicchi", "misprint", "reproduced"]);
}

#[test]
fn a_file_of_ones_own_is_judged_and_written() {
    let folder = Folder::new();
    let page = folder.name("ledger.html");
    let own = "papers/data/lin1991/equations.toml";
    assert_eq!(stiffarm(&["papers", own, "--html", &page]).good(), "");
    let html = std::fs::read_to_string(page).expect("written");
    assert!(html.contains("<html") && !html.contains("http://") && !html.contains("src=\"//"));
    assert!(stiffarm(&["papers", own, "--markdown"]).good().contains('|'));
    assert!(stiffarm(&["papers", own, "--json"]).json().is_array());
}

/// What is committed is what the command prints.
#[test]
fn the_growth_of_the_difference_is_a_table_and_a_picture() {
    let committed = |file: &str| read(&format!("docs/{file}"));
    let table = stiffarm(&["papers", "--figure", "growth"]).good();
    assert!(table.contains("| 0.01 | 1.00e-5 m | 2.00e-5 m | 5.00e-5 m | 100.00 % |"), "{table}");
    assert!(committed("papers.md").contains(&table));
    let folder = Folder::new();
    let file = folder.name("growth.svg");
    assert_eq!(stiffarm(&["papers", "--figure", "growth", "--svg", &file]).good(), "");
    let picture = std::fs::read_to_string(file).expect("written");
    assert_eq!(picture, committed("growth.svg"));
    assert!(picture.contains("prefers-color-scheme: dark") && picture.ends_with("</svg>\n"));
    assert_eq!(picture.matches("<circle class=\"dot\"").count(), 3 * 8);
}

#[test]
fn flexible_kinematics_of_any_arm_are_generated() {
    let of = |more: &[&str]| stiffarm(&[&["generate", "jweeg_two_link"], more].concat());
    let planar = ["--emit", "rust", "--kernels", "::stiffarm_kernels", "--flexible", "dx,dy,dphi"];
    let committed = "papers/tests/jweeg/closed_form.rs";
    let check = of(&[&planar[..], &["--check", committed]].concat()).good();
    assert!(check.contains("is what jweeg_two_link gives"), "{check}");
    let latex = of(&["--emit", "latex", "--flexible", "dx,dy,dphi"]).good();
    has(&latex, &["flexible pose, published", "\\delta x_{1}", "\\sin(q_{1}+q_{2}+d\\varphi_{1})"]);
    let whole = stiffarm(&["generate", "ur5", "--emit", "rust", "--flexible"]).good();
    assert!(whole.contains("pub fn first_order<S: Scalar>(") && whole.contains("\"dpsi7\""));
}
