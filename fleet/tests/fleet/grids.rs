//! Grids against `stiffarm map`, which makes its own.

use std::collections::BTreeMap;
use std::sync::Arc;

use arrow::array::{Array, AsArray};
use arrow::compute::cast;
use arrow::datatypes::{DataType, Float64Type};
use stiffarm_fleet::arms::Arms;
use stiffarm_fleet::sentence::of_engine;
use stiffarm_fleet::session::Engine;

use crate::campaigns::run;

/// Rows of numbers; `None` of a null.
pub async fn numbers(engine: &Engine, sql: &str) -> Result<Vec<Vec<Option<f64>>>, String> {
    let wrong = |error| of_engine(&error);
    let session = engine.session(&Arc::new(Arms::default()), &[]).await.map_err(wrong)?;
    let batches = session.sql(sql).await.map_err(wrong)?.collect().await.map_err(wrong)?;
    let mut rows = Vec::new();
    for batch in batches {
        let columns = batch.columns().iter().map(|c| cast(c, &DataType::Float64).unwrap());
        let columns: Vec<_> = columns.collect();
        for row in 0..batch.num_rows() {
            let cell = |column: &Arc<dyn Array>| {
                let column = column.as_primitive::<Float64Type>();
                column.is_valid(row).then(|| column.value(row))
            };
            rows.push(columns.iter().map(cell).collect());
        }
    }
    Ok(rows)
}

fn here(partitions: usize) -> Engine {
    Engine { cluster: None, partitions: Some(partitions) }
}

/// The length of the displacement in mm, as `stiffarm map` has it.
pub const DEFLECTION: &str = "SELECT q2, q3, 1e3 * sqrt(d[1] * d[1] + d[2] * d[2] + d[3] * d[3]) AS mm FROM \
                              (SELECT q2, q3, deflection('kuka_kr240', q1, q2, q3, q4, q5, q6, 0, 0, -2000, 200, 200, 0) \
                              AS d FROM grid('kuka_kr240', 'q2,q3', 9, 'q4=45deg,q5=45deg'))";

#[tokio::test]
async fn a_grid_has_the_numbers_of_a_map() {
    let words = [
        "map",
        "kuka_kr240",
        "--over",
        "q2,q3",
        "--of",
        "deflection",
        "--at",
        "q4=45deg,q5=45deg",
        "--wrench",
        "0,0,-2000,200,200,0",
        "--steps",
        "9",
        "--csv",
        "-",
    ];
    let text = run(&words, &[]);
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("q2[deg],q3[deg],deflection[mm]"));
    let want: BTreeMap<String, f64> = lines
        .map(|line| {
            let (at, value) = line.rsplit_once(',').unwrap();
            (at.to_owned(), value.parse().unwrap())
        })
        .collect();
    let shown = |radians: f64| (1e9 * radians.to_degrees()).round() / 1e9 + 0.0;
    for partitions in [1, 4] {
        let rows = numbers(&here(partitions), DEFLECTION).await.unwrap();
        assert_eq!((rows.len(), want.len()), (81, 81));
        for row in rows {
            let [q2, q3, got] = [0, 1, 2].map(|k| row[k].unwrap());
            let want = want[&format!("{},{}", shown(q2), shown(q3))];
            // The kernels in lanes, and the textbook.
            assert!((got / want - 1.0).abs() < 1e-12, "{got} {want}");
        }
    }
}

/// Into however many parts it is split, and whatever is asked of it.
#[tokio::test]
async fn every_cell_is_there_once() {
    let grid = "grid('ur10', 'q2,q3,q5', 23, 'q1=0.5')";
    let sql = format!(
        "SELECT (SELECT count(*) FROM {grid}) AS all, count(*), min(q1), max(q1), sum(q4 + q6) FROM \
         (SELECT DISTINCT * FROM {grid})"
    );
    let want = vec![vec![Some(12167.0), Some(12167.0), Some(0.5), Some(0.5), Some(0.0)]];
    for partitions in [1, 2, 7, 12] {
        assert_eq!(numbers(&here(partitions), &sql).await.unwrap(), want, "{partitions}");
    }
    let sql = "SELECT q3 FROM grid('ur10', 'q3', 3) ORDER BY q3";
    let limits = stiffarm_cli::RobotArgs::named("ur10")
        .load(&stiffarm_cli::host::Host::default())
        .unwrap()
        .arm()
        .unwrap();
    let [low, high] =
        limits.joints[2].limits.unwrap_or([-std::f64::consts::PI, std::f64::consts::PI]);
    let want = [low, 0.5 * (low + high), high].map(|q| vec![Some(q)]);
    assert_eq!(numbers(&here(2), sql).await.unwrap(), want);
}

/// 10¹⁵ cells, of which three are asked for: the others are not made.
#[tokio::test]
async fn what_is_not_asked_for_is_not_made() {
    let sql = "SELECT q1, q2, q3 FROM grid('ur10', 'q1,q2,q3', 100000) LIMIT 3";
    assert_eq!(numbers(&here(2), sql).await.unwrap().len(), 3);
}

#[tokio::test]
async fn mistakes_are_sentences() {
    for (grid, says) in [
        ("grid('ur10')", "found 1 arguments, expected grid(robot, over, steps, at)"),
        ("grid('ur10', 'q2', 'many')", "expected grid(robot, over, steps, at)"),
        ("grid('ur10', 'q2', 1)", "found 1 steps, expected 2 to 1000000"),
        ("grid('ur11', 'q2', 5)", "found no robot `ur11`"),
        ("grid('ur10', 'q7', 5)", "found `q7`, expected a joint, q1 to q6"),
        ("grid('ur10', 'q2,q2', 5)", "found q2 twice"),
        ("grid('ur10', 'q2,q3', 5, 'q3=1')", "is one of those that move"),
        ("grid('ur10', 'q1,q2,q3,q4', 1000000)", "more than 2^63 cells"),
    ] {
        let said = numbers(&here(1), &format!("SELECT count(*) FROM {grid}")).await.unwrap_err();
        assert!(said.contains(says), "{grid}: {said}");
    }
}
