//! Rows per second of functions on the engine, beside a plain loop over the same columns and the batch that they are
//! made of, on one core: `cargo run --release --example speed`.

use std::hint::black_box;
use std::sync::Arc;
use std::time::Instant;

use arrow::array::{ArrayRef, Float64Array, RecordBatch};
use datafusion::physical_plan::execute_stream;
use datafusion::prelude::{SessionConfig, SessionContext};
use futures::StreamExt;
use stiffarm_fleet::arms::Arms;
use stiffarm_fleet::session::register;
use stiffarm_kernels::{Input, Kernels, Output};
use stiffarm_robots::{kuka_kr240, ur10};

/// Rows of a batch of the engine, and how many batches.
const ROWS: usize = 8192;
const BATCHES: usize = 2;

fn column(k: usize) -> Vec<f64> {
    (0..ROWS).map(|row| 3.0 * ((0.618_034 * (row + 997 * k + 1) as f64).fract() - 0.5)).collect()
}

/// The least time of many, in seconds: what others do on the machine only adds.
async fn least<F: Future<Output = ()>>(run: impl Fn() -> F) -> f64 {
    let mut least = f64::INFINITY;
    for _ in 0..200 {
        let began = Instant::now();
        run().await;
        least = least.min(began.elapsed().as_secs_f64());
    }
    least
}

#[tokio::main(flavor = "current_thread")]
async fn main() -> datafusion::error::Result<()> {
    println!(
        "output              engine   plain loop   batch     rows/s; engine over plain, over batch"
    );
    for output in [Output::Pose, Output::Jacobian, Output::Deflection] {
        compare("kuka_kr240", &kuka_kr240::Robot, output).await?;
    }
    compare("ur10", &ur10::Robot, Output::InverseDynamics).await
}

async fn compare(
    id: &str,
    robot: &impl Kernels<f64>,
    output: Output,
) -> datafusion::error::Result<()> {
    let dof = robot.dof();
    let count = output.state(dof) + if output.takes(Input::Wrench) { 6 } else { 0 };
    let columns: Vec<Vec<f64>> = (0..count).map(column).collect();
    let (rows, width) = output.shape(dof);
    let session = session(&columns)?;
    let names = (0..count).map(|k| format!("c{k}")).collect::<Vec<_>>().join(", ");
    let sql = format!("SELECT {}('{id}', {names}) AS v FROM t", output.name());
    let plan = session.sql(&sql).await?.create_physical_plan().await?;
    let engine = least(|| async {
        let stream = execute_stream(Arc::clone(&plan), session.task_ctx());
        let mut stream = stream.expect("the query was planned");
        while let Some(batch) = stream.next().await {
            black_box(batch.expect("every row has a value"));
        }
    });
    let engine = engine.await;
    let plain = least(|| async {
        for _ in 0..BATCHES {
            let mut out = vec![0.0; ROWS * rows * width];
            for (row, out) in out.chunks_exact_mut(rows * width).enumerate() {
                let all: [f64; 18] =
                    core::array::from_fn(|k| columns.get(k).map_or(0.0, |c| c[row]));
                let load = core::array::from_fn(|k| all[6 + k]);
                let state = &all[..output.state(dof)];
                robot.evaluate(output, state, &load, out).expect("the arm is stable");
            }
            black_box(out);
        }
    });
    let plain = plain.await;
    let slices: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
    let (q, load) = slices.split_at(output.state(dof));
    let arm = stiffarm_robots::arm(id).expect("it is of the collection");
    let batch = least(|| async {
        for _ in 0..BATCHES {
            let mut out = vec![0.0; ROWS * rows * width];
            arm.batched.evaluate_columns(output, q, load, &mut out).expect("the arm is stable");
            black_box(out);
        }
    });
    let batch = batch.await;
    let speed = |seconds: f64| (ROWS * BATCHES) as f64 / seconds;
    println!(
        "{:18} {:9.3e} {:9.3e} {:9.3e}   {:.2} {:.2}",
        output.name(),
        speed(engine),
        speed(plain),
        speed(batch),
        plain / engine,
        batch / engine
    );
    Ok(())
}

fn session(columns: &[Vec<f64>]) -> datafusion::error::Result<SessionContext> {
    let config = SessionConfig::new().with_target_partitions(1).with_batch_size(ROWS);
    let session = SessionContext::new_with_config(config);
    register(&session, &Arc::new(Arms::default()));
    let array = |column: &Vec<f64>| Arc::new(Float64Array::from(column.clone())) as ArrayRef;
    let named = columns.iter().enumerate().map(|(k, column)| (format!("c{k}"), array(column)));
    let batch = RecordBatch::try_from_iter(named)?;
    let schema = batch.schema();
    let table = datafusion::datasource::MemTable::try_new(schema, vec![vec![batch; BATCHES]])?;
    session.register_table("t", Arc::new(table))?;
    Ok(session)
}
