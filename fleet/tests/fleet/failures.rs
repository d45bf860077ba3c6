//! What goes wrong is one sentence, and of a group a row.

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use stiffarm_fleet::session::Engine;

use crate::campaigns::{Campaign, campaigns, quoted, write};
use crate::diagnoses::{answers, query, table};

/// The program.
pub fn fleet(words: &[&str]) -> Output {
    let fleet = env!("CARGO_BIN_EXE_stiffarm-fleet");
    Command::new(fleet).args(words).stdin(Stdio::null()).output().unwrap()
}

/// What it says when it cannot: one line, and nothing else.
pub fn refused(output: &Output) -> String {
    assert_eq!(output.status.code(), Some(2), "{output:?}");
    assert!(output.stdout.is_empty(), "{output:?}");
    let said = String::from_utf8(output.stderr.clone()).unwrap();
    assert_eq!(said.lines().count(), 1, "{said}");
    said.strip_prefix("error: ").unwrap_or_else(|| panic!("{said}")).trim().to_owned()
}

fn runs(folder: &Path) -> String {
    format!("runs={}", folder.display())
}

/// One arm has two rows, one a robot that nobody knows: they have sentences, the other its diagnosis.
#[tokio::test]
async fn a_group_without_an_answer_is_a_row() {
    let folder = tempfile::tempdir().unwrap();
    let mut all = campaigns(&["kuka_kr240"], 3, 12);
    all[0].text = all[0].text.lines().take(3).map(|line| format!("{line}\n")).collect();
    all[1].robot = "kuka_kr241";
    write(folder.path(), &all);
    let sql = query(&all[0].columns());
    let engine = Engine { cluster: None, partitions: Some(2) };
    let got = answers(&engine, &[table(folder.path())], &sql).await;
    let said = |k: usize| {
        let [json, said] = &got[&all[k].arm];
        assert_eq!(*json, None);
        said.clone().unwrap()
    };
    assert!(said(0).contains("expected"), "{}", said(0));
    assert!(said(1).starts_with("found no robot `kuka_kr241`"), "{}", said(1));
    assert_eq!(got[&all[2].arm], [Some(all[2].diagnosed()), None]);
}

/// What a query may not ask of a machine that is not its own.
#[tokio::test]
async fn options_that_touch_files_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let all = campaigns(&["kuka_kr240"], 1, 6);
    write(folder.path(), &all);
    let engine = Engine::default();
    for options in ["--json /tmp/x", "--check=/etc/passwd", "/etc/passwd", "--write-robot x.toml"] {
        let columns = quoted(&all[0].columns());
        let sql = format!(
            "SELECT found['error'] AS said, '' AS b, '' AS c FROM (SELECT diagnose(robot || ' {options}', {columns}) AS found FROM runs)"
        );
        let got = answers(&engine, &[table(folder.path())], &sql).await;
        let (said, _) = got.first_key_value().unwrap();
        assert!(said.contains("expected an option: --set, --nuisance"), "{said}");
    }
}

fn one(folder: &Path) -> Vec<Campaign> {
    let all = campaigns(&["ur10"], 1, 6);
    write(folder, &all);
    all
}

#[test]
fn a_file_that_is_damaged_is_named() {
    let folder = tempfile::tempdir().unwrap();
    one(&folder.path().join("csv"));
    let parquet = folder.path().join("parquet");
    let copy = format!("COPY (SELECT * FROM runs) TO '{}/' STORED AS PARQUET", parquet.display());
    let made = fleet(&["sql", &copy, "--table", &runs(&folder.path().join("csv"))]);
    assert!(made.status.success(), "{made:?}");
    let file = fs::read_dir(&parquet).unwrap().next().unwrap().unwrap().path();
    let whole = fs::read(&file).unwrap();
    let name = file.file_name().unwrap().to_str().unwrap().to_owned();
    let ask =
        || fleet(&["sql", "SELECT * FROM runs", "--table", &runs(&parquet), "--format", "json"]);
    assert!(ask().status.success());
    // Cut short, its foot is gone; with other bytes within, a page is.
    fs::write(&file, &whole[..whole.len() - 8]).unwrap();
    let said = refused(&ask());
    assert!(said.contains("Parquet") || said.contains("parquet"), "{said}");
    assert!(said.contains(&name) || said.contains("runs"), "{said}");
    let mut spoilt = whole.clone();
    spoilt[4..whole.len() / 2].fill(0xff);
    fs::write(&file, &spoilt).unwrap();
    let said = refused(&ask());
    assert!(said.contains("arquet"), "{said}");
}

#[test]
fn what_cannot_be_read_or_written_is_named() {
    let folder = tempfile::tempdir().unwrap();
    one(&folder.path().join("csv"));
    let table = runs(&folder.path().join("csv"));
    let none = runs(&folder.path().join("none"));
    let said = refused(&fleet(&["sql", "SELECT 1", "--table", &none]));
    assert!(said.contains("cannot read") && said.contains("none"), "{said}");
    fs::create_dir(folder.path().join("empty")).unwrap();
    let said =
        refused(&fleet(&["sql", "SELECT 1", "--table", &runs(&folder.path().join("empty"))]));
    assert!(said.contains("found no file"), "{said}");
    let said = refused(&fleet(&["sql", "SELECT nothing FROM runs", "--table", &table]));
    assert!(said.contains("nothing"), "{said}");
    let out = folder.path().join("none").join("x.csv");
    let out = out.to_str().unwrap();
    let said = refused(&fleet(&["sql", "SELECT 1", "--format", "csv", "--out", out]));
    assert!(said.contains("cannot write") && said.contains("x.csv"), "{said}");
    // A query that ends in the middle leaves no file.
    let out = folder.path().join("x.csv");
    let failing = "SELECT pose('ur10', \"q1[rad]\", 1) FROM runs";
    let words = ["sql", failing, "--table", &table, "--format", "json", "--out"];
    refused(&fleet(&[&words[..], &[out.to_str().unwrap()]].concat()));
    assert!(!out.exists());
    let said = refused(&fleet(&["sql", "SELECT 1", "--cluster", "df://127.0.0.1:1"]));
    assert!(said.contains("127.0.0.1:1"), "{said}");
}

/// A full disk, as the system plays one.
#[test]
fn a_full_disk_is_said() {
    let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let fleet = env!("CARGO_BIN_EXE_stiffarm-fleet");
    let words = ["sql", "SELECT 1 AS one", "--format", "csv"];
    let output = Command::new(fleet).args(words).stdout(full).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(said.lines().count(), 1, "{said}");
    assert!(said.contains("No space left on device"), "{said}");
}

/// Cells of several values are no CSV.
#[test]
fn a_list_in_a_cell_is_refused_before_anything_is_written() {
    let said = refused(&fleet(&["sql", "SELECT [1, 2] AS pair", "--format", "csv"]));
    assert!(said.starts_with("column pair: found several values in one cell"), "{said}");
    let json = fleet(&["sql", "SELECT [1, 2] AS pair, NULL AS no", "--format", "json"]);
    assert_eq!(String::from_utf8(json.stdout).unwrap(), "{\"pair\":[1,2],\"no\":null}\n");
}
