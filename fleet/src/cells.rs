//! The reading of a grid as a plan of the engine: a source of ranges of cells, a range for each part, and what makes
//! cells of a range, a batch at a time.
//!
//! The ranges are a plan of their own because a cluster gives a task its part by taking the others out of the plan's
//! source, which it can do to sources that it knows.

use std::fmt;
use std::sync::Arc;

use arrow::array::{ArrayRef, AsArray, Float64Array, RecordBatch, RecordBatchOptions, UInt64Array};
use arrow::datatypes::{DataType, Field, Schema, SchemaRef, UInt64Type};
use datafusion::common::tree_node::TreeNodeRecursion;
use datafusion::common::{Result, plan_err};
use datafusion::datasource::memory::MemorySourceConfig;
use datafusion::execution::{SendableRecordBatchStream, TaskContext};
use datafusion::physical_expr::{EquivalenceProperties, Partitioning, PhysicalExpr};
use datafusion::physical_plan::coop::cooperative;
use datafusion::physical_plan::execution_plan::{Boundedness, EmissionType};
use datafusion::physical_plan::stream::RecordBatchStreamAdapter;
use datafusion::physical_plan::{
    ChildrenPropertiesMode, DisplayAs, DisplayFormatType, ExecutionPlan, PlanProperties,
    ReplaceChildrenOptions,
};
use futures::{TryStreamExt, stream};

use crate::grid::Grid;

/// The cells `0..cells` as ranges, `from` to before `to`, in as many parts or fewer.
///
/// # Errors
/// The engine's.
pub fn source(cells: u64, parts: u64) -> Result<Arc<dyn ExecutionPlan>> {
    let field = |name| Field::new(name, DataType::UInt64, false);
    let schema = Arc::new(Schema::new(vec![field("from"), field("to")]));
    let each = cells.div_ceil(parts).max(1);
    let part = |part: u64| {
        let ends = [part * each, cells.min((part + 1) * each)];
        let ends = ends.map(|end| Arc::new(UInt64Array::from(vec![end])) as ArrayRef);
        Ok(vec![RecordBatch::try_new(Arc::clone(&schema), ends.to_vec())?])
    };
    let parts = (0..cells.div_ceil(each)).map(part).collect::<Result<Vec<_>>>()?;
    Ok(MemorySourceConfig::try_new_exec(&parts, schema, None)?)
}

/// The cells of the ranges of `input`, part by part.
#[derive(Debug)]
pub struct Cells {
    input: Arc<dyn ExecutionPlan>,
    /// Of which grid.
    pub grid: Arc<Grid>,
    /// Which of its columns.
    pub columns: Vec<usize>,
    properties: Arc<PlanProperties>,
}

impl Cells {
    /// Of ranges as [`source`] has them.
    pub fn new(
        input: Arc<dyn ExecutionPlan>,
        grid: impl Into<Arc<Grid>>,
        columns: Vec<usize>,
    ) -> Cells {
        let grid = grid.into();
        let parts = input.properties().output_partitioning().partition_count();
        let properties = PlanProperties::new(
            EquivalenceProperties::new(grid.schema_of(&columns)),
            Partitioning::UnknownPartitioning(parts),
            EmissionType::Incremental,
            Boundedness::Bounded,
        );
        Cells { input, grid, columns, properties: Arc::new(properties) }
    }
}

impl DisplayAs for Cells {
    fn fmt_as(&self, _: DisplayFormatType, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Cells: columns={:?}", self.columns)
    }
}

impl ExecutionPlan for Cells {
    fn name(&self) -> &'static str {
        "Cells"
    }

    fn properties(&self) -> &Arc<PlanProperties> {
        &self.properties
    }

    fn children(&self) -> Vec<&Arc<dyn ExecutionPlan>> {
        vec![&self.input]
    }

    // What it is given is one row a part.
    fn benefits_from_input_partitioning(&self) -> Vec<bool> {
        vec![false]
    }

    fn apply_expressions(
        &self,
        _: &mut dyn FnMut(&Arc<dyn PhysicalExpr>) -> Result<TreeNodeRecursion>,
    ) -> Result<TreeNodeRecursion> {
        Ok(TreeNodeRecursion::Continue)
    }

    fn replace_children(
        self: Arc<Self>,
        children: Vec<Arc<dyn ExecutionPlan>>,
        _: ReplaceChildrenOptions,
    ) -> Result<Arc<dyn ExecutionPlan>> {
        let [input] = <[_; 1]>::try_from(children).or_else(|found| {
            plan_err!("grid: found {} inputs, expected the ranges of its cells", found.len())
        })?;
        Ok(Arc::new(Cells::new(input, Arc::clone(&self.grid), self.columns.clone())))
    }

    // What calls this is what has not yet gone over to the one above.
    fn with_new_children(
        self: Arc<Self>,
        children: Vec<Arc<dyn ExecutionPlan>>,
    ) -> Result<Arc<dyn ExecutionPlan>> {
        self.replace_children(
            children,
            ReplaceChildrenOptions::new(ChildrenPropertiesMode::Recompute),
        )
    }

    fn execute(
        &self,
        partition: usize,
        context: Arc<TaskContext>,
    ) -> Result<SendableRecordBatchStream> {
        let batch = context.session_config().batch_size() as u64;
        let ranges = self.input.execute(partition, context)?;
        let (grid, columns) = (Arc::clone(&self.grid), self.columns.clone());
        let schema = self.schema();
        let cells = ranges.map_ok(move |ranges| {
            let [from, to] =
                [0, 1].map(|k| ranges.column(k).as_primitive::<UInt64Type>().values().clone());
            let (grid, columns) = (Arc::clone(&grid), columns.clone());
            let starts = (0..from.len()).flat_map(move |row| {
                let to = to[row];
                (from[row]..to)
                    .step_by(batch as usize)
                    .map(move |from| [from, to.min(from + batch)])
            });
            stream::iter(starts.map(move |range| made(&grid, &columns, range)))
        });
        let cells = RecordBatchStreamAdapter::new(schema, cells.try_flatten());
        Ok(Box::pin(cooperative(cells)))
    }
}

/// A batch: the cells of a range.
fn made(grid: &Grid, columns: &[usize], [from, to]: [u64; 2]) -> Result<RecordBatch> {
    let column = |joint: &usize| -> ArrayRef {
        Arc::new((from..to).map(|cell| grid.at(*joint, cell)).collect::<Float64Array>())
    };
    let schema: SchemaRef = grid.schema_of(columns);
    // A query may ask for no column at all, to count.
    let options = RecordBatchOptions::new().with_row_count(Some((to - from) as usize));
    let columns = columns.iter().map(column).collect();
    Ok(RecordBatch::try_new_with_options(schema, columns, &options)?)
}
