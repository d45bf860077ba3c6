//! Campaigns by GROUP BY against the command on each one's own file.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use arrow::array::{Array, AsArray};
use arrow::compute::cast;
use arrow::datatypes::DataType;
use datafusion::prelude::SessionContext;
use stiffarm_fleet::arms::Arms;
use stiffarm_fleet::session::{Engine, Table};

use crate::campaigns::{Campaign, OPTIONS, campaigns, quoted, run, write};

pub fn table(folder: &Path) -> Table {
    Table { name: "runs".to_owned(), location: folder.display().to_string() }
}

/// The diagnosis of each arm: JSON and sentence.
pub fn query(columns: &[String]) -> String {
    format!(
        "SELECT CAST(arm AS VARCHAR) AS arm, found['json'] AS json, found['error'] AS error FROM (SELECT arm, \
         diagnose(robot || ' {OPTIONS}', {}) AS found FROM runs GROUP BY arm, campaign)",
        quoted(columns)
    )
}

/// Rows of three texts, by the first.
pub async fn answers(
    engine: &Engine,
    tables: &[Table],
    sql: &str,
) -> BTreeMap<String, [Option<String>; 2]> {
    asked(&engine.session(&Arc::new(Arms::default()), tables).await.unwrap(), sql).await
}

/// The same of a session that is there.
pub async fn asked(session: &SessionContext, sql: &str) -> BTreeMap<String, [Option<String>; 2]> {
    let mut answers = BTreeMap::new();
    for batch in session.sql(sql).await.unwrap().collect().await.unwrap() {
        let columns: Vec<_> =
            batch.columns().iter().map(|c| cast(c, &DataType::Utf8).unwrap()).collect();
        for row in 0..batch.num_rows() {
            let text = |k: usize| {
                let column = columns[k].as_string::<i32>();
                column.is_valid(row).then(|| column.value(row).to_owned())
            };
            let was = answers.insert(text(0).unwrap(), [text(1), text(2)]);
            assert!(was.is_none(), "an arm twice");
        }
    }
    answers
}

pub fn same(campaigns: &[Campaign], answers: &BTreeMap<String, [Option<String>; 2]>) {
    assert_eq!(answers.len(), campaigns.len());
    for campaign in campaigns {
        let want = campaign.diagnosed();
        assert!(want.contains("\"findings\": [\n    {"), "{}: nothing is found", campaign.arm);
        assert_eq!(answers[&campaign.arm], [Some(want), None], "{}", campaign.arm);
    }
}

fn here(partitions: usize) -> Engine {
    Engine { cluster: None, partitions: Some(partitions) }
}

/// However the rows are spread, in whatever format: the bytes of the command on the arm's own file.
#[tokio::test(flavor = "multi_thread")]
async fn a_group_is_its_file() {
    let folder = tempfile::tempdir().unwrap();
    let campaigns = campaigns(&["kuka_kr240", "ur10"], 2, 12);
    write(&folder.path().join("csv"), &campaigns);
    let (csv, parquet) = (folder.path().join("csv"), folder.path().join("parquet"));
    let sql = query(&campaigns[0].columns());
    for partitions in [1, 3] {
        same(&campaigns, &answers(&here(partitions), &[table(&csv)], &sql).await);
    }
    let session = here(2).session(&Arc::new(Arms::default()), &[table(&csv)]).await.unwrap();
    let copy = format!(
        "COPY (SELECT * FROM runs) TO '{}/' STORED AS PARQUET PARTITIONED BY (arm)",
        parquet.display()
    );
    session.sql(&copy).await.unwrap().collect().await.unwrap();
    same(&campaigns, &answers(&here(3), &[table(&parquet)], &sql).await);
}

/// A table's files are those of all its folders.
#[tokio::test]
async fn folders_within_folders_are_read() {
    let folder = tempfile::tempdir().unwrap();
    for (within, rows) in [("a/b", "1\n2\n"), ("a", "3\n"), ("c", "4.5\n5\n6\n")] {
        let within = folder.path().join(within);
        std::fs::create_dir_all(&within).unwrap();
        std::fs::write(within.join("x.csv"), format!("x\n{rows}")).unwrap();
    }
    std::fs::write(folder.path().join("_SUCCESS"), "").unwrap();
    let sql = "SELECT CAST(sum(x) AS VARCHAR), CAST(count(*) AS VARCHAR), '' FROM runs";
    let got = answers(&here(2), &[table(folder.path())], sql).await;
    assert_eq!(got["21.5"][0].as_deref(), Some("6"));
    std::fs::write(folder.path().join("notes.txt"), "x\n7\n").unwrap();
    let session = here(1).session(&Arc::new(Arms::default()), &[table(folder.path())]).await;
    let said = stiffarm_fleet::sentence::of_engine(&session.err().unwrap());
    assert!(said.contains("notes.txt beside"), "{said}");
}

/// `measurements` is the file itself, and without `row` a file in an order of its own.
#[tokio::test]
async fn the_file_comes_back() {
    let folder = tempfile::tempdir().unwrap();
    let campaigns = campaigns(&["ur10"], 1, 6);
    write(folder.path(), &campaigns);
    let columns = quoted(&campaigns[0].columns());
    let sql = |columns: &str| {
        format!("SELECT CAST(arm AS VARCHAR), measurements({columns}), '' FROM runs GROUP BY arm")
    };
    let got = answers(&here(3), &[table(folder.path())], &sql(&columns)).await;
    assert_eq!(got[&campaigns[0].arm][0].as_ref(), Some(&campaigns[0].text));
    let unordered = columns.trim_start_matches("row, ");
    let got = answers(&here(3), &[table(folder.path())], &sql(unordered)).await;
    let again = answers(&here(1), &[table(folder.path())], &sql(unordered)).await;
    assert_eq!(got, again);
    let mut lines: Vec<&str> = campaigns[0].text.lines().skip(1).collect();
    lines.sort_unstable();
    let got = got[&campaigns[0].arm][0].clone().unwrap();
    assert_eq!(got.lines().skip(1).collect::<Vec<_>>(), lines);
}

/// `identify` answers as its command, and a struct names columns anew.
#[tokio::test]
async fn springs_are_identified_by_group() {
    let folder = tempfile::tempdir().unwrap();
    let campaigns = campaigns(&["kuka_kr240"], 1, 12);
    write(folder.path(), &campaigns);
    let columns = campaigns[0].columns();
    let named = columns.iter().map(|name| format!("'{name}', \"{name}\"")).collect::<Vec<_>>();
    let sql = format!(
        "SELECT arm, found['json'], found['error'] FROM (SELECT arm, identify(robot, row, named_struct({})) AS \
         found FROM runs GROUP BY arm)",
        named.join(", ")
    );
    let got = answers(&here(2), &[table(folder.path())], &sql).await;
    let words = ["identify", "kuka_kr240", "<campaign>", "--json", "-", "--quiet"];
    let want = run(&words, &[("<campaign>", &campaigns[0].text)]);
    assert_eq!(got[&campaigns[0].arm], [Some(want), None]);
}

/// The fields of the answer are those of its JSON.
#[tokio::test]
async fn fields_say_what_the_json_says() {
    let folder = tempfile::tempdir().unwrap();
    let campaigns = campaigns(&["kuka_kr240"], 1, 12);
    write(folder.path(), &campaigns);
    let sql = format!(
        "SELECT found['json'], CAST(found['after'] AS VARCHAR), found['findings'][1]['effect'] || ' at ' || \
         found['findings'][1]['place'] FROM (SELECT diagnose(robot || ' {OPTIONS}', {}) AS found FROM runs)",
        quoted(&campaigns[0].columns())
    );
    let got = answers(&here(2), &[table(folder.path())], &sql).await;
    let (json, [after, finding]) = got.into_iter().next().unwrap();
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    let want = json["gap"]["shrink"]["after"].as_f64().unwrap();
    assert_eq!(after.unwrap().parse::<f64>().unwrap(), want);
    assert_eq!(finding.unwrap(), "joint_compliance at joint 2");
}
