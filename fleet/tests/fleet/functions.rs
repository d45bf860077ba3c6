//! Functions of columns against the same kernels called pose by pose.

use std::sync::Arc;

use arrow::array::{Array, AsArray, Float64Array, RecordBatch, StringArray};
use arrow::datatypes::{DataType, Field, Float64Type, Schema};
use datafusion::prelude::SessionContext;
use stiffarm_fleet::arms::Arms;
use stiffarm_fleet::session::register;
use stiffarm_kernels::Output;

/// A table `t` of a robot's name and numbers c0, c1, ….
fn session(robots: Vec<Option<&str>>, columns: &[Vec<Option<f64>>], arms: Arms) -> SessionContext {
    let session = SessionContext::new();
    register(&session, &Arc::new(arms));
    let mut fields = vec![Field::new("robot", DataType::Utf8, true)];
    let mut arrays: Vec<Arc<dyn Array>> = vec![Arc::new(StringArray::from(robots))];
    for (k, column) in columns.iter().enumerate() {
        fields.push(Field::new(format!("c{k}"), DataType::Float64, true));
        arrays.push(Arc::new(Float64Array::from(column.clone())));
    }
    let batch = RecordBatch::try_new(Arc::new(Schema::new(fields)), arrays).unwrap();
    session.register_batch("t", batch).unwrap();
    session
}

/// The value of each row; `None` of a null.
async fn ask(session: &SessionContext, what: &str) -> Result<Vec<Option<Vec<f64>>>, String> {
    let query = session.sql(&format!("SELECT {what} AS v FROM t")).await;
    let query = query.map_err(|error| stiffarm_fleet::sentence::of_engine(&error))?;
    let batches = query.collect().await;
    let batches = batches.map_err(|error| stiffarm_fleet::sentence::of_engine(&error))?;
    let rows = batches.iter().flat_map(|batch| {
        let lists = batch.column(0).as_fixed_size_list();
        (0..lists.len()).map(|row| {
            let value = || lists.value(row).as_primitive::<Float64Type>().values().to_vec();
            lists.is_valid(row).then(value)
        })
    });
    Ok(rows.collect())
}

/// Fractions of the golden ratio, spread over `2 × reach`.
fn spread(row: usize, column: usize, reach: f64) -> f64 {
    let turn = 0.618_033_988_749_895 * (row * 31 + column * 7 + 1) as f64;
    2.0 * reach * (turn.fract() - 0.5)
}

fn names(count: usize) -> String {
    (0..count).map(|k| format!("c{k}")).collect::<Vec<_>>().join(", ")
}

/// Every output of every built-in arm, to the last bit, at a number of poses that no lanes divide.
#[tokio::test]
async fn every_output_is_the_kernels() {
    const ROWS: usize = 13;
    for arm in stiffarm_robots::ARMS {
        for output in arm.kernels.outputs() {
            let joints = output.state(arm.kernels.dof());
            let loads = if output.takes(stiffarm_kernels::Input::Wrench) { 6 } else { 0 };
            let column = |k: usize| {
                let reach = if k < joints { 2.0 } else { 60.0 };
                (0..ROWS).map(|row| Some(spread(row, k, reach))).collect::<Vec<_>>()
            };
            let columns: Vec<_> = (0..joints + loads).map(column).collect();
            let session = session(vec![Some(arm.id); ROWS], &columns, Arms::default());
            let what = format!("{}('{}', {})", output.name(), arm.id, names(columns.len()));
            let got = ask(&session, &what).await.unwrap();
            let (rows, width) = output.shape(arm.kernels.dof());
            for (row, got) in got.iter().enumerate() {
                let all: Vec<f64> = columns.iter().map(|column| column[row].unwrap()).collect();
                let (state, wrench) = all.split_at(joints);
                let wrench = <[f64; 6]>::try_from(wrench).unwrap_or_default();
                let mut want = vec![0.0; rows * width];
                let done = arm.kernels.evaluate(*output, state, &wrench, &mut want);
                let finite = want.iter().all(|x| x.is_finite());
                let want = (done.is_ok() && finite).then_some(want);
                assert_eq!(got, &want, "{} of {}, row {row}", output.name(), arm.id);
            }
        }
    }
}

#[tokio::test]
async fn rows_may_be_of_several_robots_and_of_none() {
    let columns: Vec<_> =
        (0..6).map(|k| (0..5).map(|row| Some(spread(row, k, 1.5))).collect::<Vec<_>>()).collect();
    let robots = vec![Some("ur5"), Some("ur10"), Some("ur10"), None, Some("ur5")];
    let session = session(robots.clone(), &columns, Arms::default());
    let got = ask(&session, "pose(robot, c0, c1, c2, c3, c4, c5)").await.unwrap();
    for (row, robot) in robots.iter().enumerate() {
        let q: Vec<f64> = columns.iter().map(|column| column[row].unwrap()).collect();
        let want = robot.map(|robot| {
            let mut want = vec![0.0; 12];
            let arm = stiffarm_robots::arm(robot).unwrap();
            arm.kernels.evaluate(Output::Pose, &q, &[0.0; 6], &mut want).unwrap();
            want
        });
        assert_eq!(got[row], want, "row {row}");
    }
}

/// A null, what is not finite, and a load under which the arm buckles have no value; the others do.
#[tokio::test]
async fn what_has_no_value_is_null() {
    let mut columns: Vec<Vec<Option<f64>>> = vec![vec![Some(0.0); 4]; 12];
    columns[1][0] = None;
    columns[2][1] = Some(f64::INFINITY);
    // Stretched out and pressed from the tip towards the base.
    columns[6][2] = Some(-1e9);
    columns[8][2] = Some(-1e9);
    let session = session(vec![None; 4], &columns, Arms::default());
    let what = format!("deflection('kuka_kr240', {})", names(12));
    let got = ask(&session, &what).await.unwrap();
    let has: Vec<bool> = got.iter().map(Option::is_some).collect();
    assert_eq!(has, [false, false, false, true]);
    assert_eq!(got[3], Some(vec![0.0; 6]));
}

/// A file's table is computed by the textbook, which shares no code with the kernels.
#[tokio::test]
async fn a_file_is_the_textbook() {
    let folder = tempfile::tempdir().unwrap();
    let text = stiffarm_robots::toml("ur10").unwrap();
    std::fs::write(folder.path().join("mine.toml"), text).unwrap();
    let columns: Vec<_> =
        (0..6).map(|k| (0..9).map(|row| Some(spread(row, k, 3.0))).collect::<Vec<_>>()).collect();
    let arms = Arms::new(Some(folder.path().to_owned()));
    let session = session(vec![None; 9], &columns, arms);
    let of = |robot: &str| format!("jacobian('{robot}', c0, c1, c2, c3, c4, c5)");
    let ours = ask(&session, &of("mine")).await.unwrap();
    let kernels = ask(&session, &of("ur10")).await.unwrap();
    for (ours, kernels) in ours.iter().flatten().zip(kernels.iter().flatten()) {
        // Two ways of rounding some forty operations on numbers up to 1.5.
        assert!(
            ours.iter().zip(kernels).all(|(a, b)| (a - b).abs() < 1e-14),
            "{ours:?} {kernels:?}"
        );
    }
    assert_eq!(ours.iter().flatten().count(), 9);
    // A file that changes is read again.
    std::fs::write(folder.path().join("mine.toml"), stiffarm_robots::toml("ur5").unwrap()).unwrap();
    assert_ne!(ask(&session, &of("mine")).await.unwrap(), ours);
}

#[tokio::test]
async fn mistakes_are_sentences() {
    let columns = vec![vec![Some(0.1)]; 6];
    let session = session(vec![None], &columns, Arms::default());
    for (what, says) in [
        ("pose('ur10', c0, c1)", "found 2 joints for UR10, which has 6"),
        ("pose('ur10')", "found 0 numbers behind the robot, expected q1, …, qn"),
        ("deflection('ur10', c0, c1)", "expected q1, …, qn, fx, fy, fz, mx, my, mz"),
        ("pose('ur11', c0, c1, c2, c3, c4, c5)", "found no robot `ur11`"),
        ("pose('../ur10', c0, c1, c2, c3, c4, c5)", "expected the id of a built-in robot"),
    ] {
        let said = ask(&session, what).await.unwrap_err();
        assert!(said.contains(says), "{what}: {said}");
    }
}
