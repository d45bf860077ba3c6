//! Postures that are nowhere stored: `grid(robot, over, steps, at)` is a table of `steps` values for each joint of
//! `over`, from limit to limit, each beside each. The other joints stand where `at` says, as in `stiffarm map`.
//!
//! A cell is made when it is asked for, a batch at a time; a grid of 10⁹ cells takes no more room than one of 10³.

use std::sync::Arc;

use arrow::datatypes::{DataType, Field, Schema, SchemaRef};
use async_trait::async_trait;
use datafusion::catalog::{Session, TableFunctionArgs, TableFunctionImpl, TableProvider};
use datafusion::common::{Result, plan_datafusion_err, plan_err};
use datafusion::logical_expr::{Expr, TableType};
use datafusion::physical_plan::ExecutionPlan;
use serde::{Deserialize, Serialize};

use crate::arms::Arms;
use crate::cells::{Cells, source};

/// Values of a joint beyond which a grid is a mistake.
const MOST_STEPS: i64 = 1_000_000;

/// The function.
#[derive(Debug)]
pub struct GridFunction {
    /// The robots that it knows.
    pub arms: Arc<Arms>,
}

/// The postures, in rad and m: joint by joint its values, one of a joint that stands.
///
/// The joint that moves fastest from cell to cell is the first of `over`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Grid {
    joints: Vec<Joint>,
    cells: u64,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Joint {
    values: Vec<f64>,
    /// Cells for which it keeps a value.
    stays: u64,
}

impl TableFunctionImpl for GridFunction {
    fn call_with_args(&self, args: TableFunctionArgs<'_, '_>) -> Result<Arc<dyn TableProvider>> {
        let wanted = "expected grid(robot, over, steps, at): grid('ur10', 'q2,q3', 1000, 'q4=45deg'), the last of which \
                      may be left out";
        let (given, at) = match args.exprs() {
            [robot, over, steps] => ([robot, over, steps], None),
            [robot, over, steps, at] => ([robot, over, steps], Some(at)),
            other => return plan_err!("grid: found {} arguments, {wanted}", other.len()),
        };
        let text = |given: &Expr| match given {
            Expr::Literal(value, _) => value.try_as_str().flatten().map(str::to_owned),
            _ => None,
        };
        let [robot, over, steps] = given;
        let steps = match steps {
            Expr::Literal(value, _) => value.cast_to(&DataType::Int64).ok(),
            _ => None,
        };
        let steps = steps.and_then(|value| i64::try_from(value).ok());
        let at = at.map_or(Some(String::new()), text);
        let (Some(robot), Some(over), Some(steps), Some(at)) = (text(robot), text(over), steps, at)
        else {
            return plan_err!("grid: found {:?}, {wanted}", args.exprs());
        };
        if !(2..=MOST_STEPS).contains(&steps) {
            return plan_err!("grid: found {steps} steps, expected 2 to {MOST_STEPS}");
        }
        let grid = Grid::new(&self.arms, &robot, &over, &at, steps as usize);
        Ok(Arc::new(grid.map_err(|said| plan_datafusion_err!("grid: {said}"))?))
    }
}

impl Grid {
    /// Of a robot's joints.
    ///
    /// # Errors
    /// A sentence: the robot, its joints, or more cells than can be counted.
    pub fn new(
        arms: &Arms,
        robot: &str,
        over: &str,
        at: &str,
        steps: usize,
    ) -> std::result::Result<Grid, String> {
        let axes = arms.axes(robot, over, at, steps)?;
        let stand = axes.posture.iter().map(|value| Joint { values: vec![*value], stays: 1 });
        let mut joints: Vec<Joint> = stand.collect();
        let mut cells = 1_u64;
        for (joint, values) in axes.joints.into_iter().zip(axes.values) {
            let all = cells.checked_mul(values.len() as u64);
            joints[joint] = Joint { values, stays: cells };
            cells = all.filter(|all| i64::try_from(*all).is_ok()).ok_or_else(|| {
                format!("found more than 2^63 cells over {over}, expected fewer steps or joints")
            })?;
        }
        Ok(Grid { joints, cells })
    }

    /// Its columns, of which `columns` alone are made.
    pub fn schema_of(&self, columns: &[usize]) -> SchemaRef {
        let field = |joint: &usize| Field::new(format!("q{}", joint + 1), DataType::Float64, false);
        Arc::new(Schema::new(columns.iter().map(field).collect::<Vec<_>>()))
    }

    /// The value of a joint in a cell.
    pub fn at(&self, joint: usize, cell: u64) -> f64 {
        let Joint { values, stays } = &self.joints[joint];
        values[(cell / stays % values.len() as u64) as usize]
    }

    fn all(&self) -> Vec<usize> {
        (0..self.joints.len()).collect()
    }
}

#[async_trait]
impl TableProvider for Grid {
    fn schema(&self) -> SchemaRef {
        self.schema_of(&self.all())
    }

    fn table_type(&self) -> TableType {
        TableType::Base
    }

    async fn scan(
        &self,
        state: &dyn Session,
        projection: Option<&Vec<usize>>,
        _filters: &[Expr],
        _limit: Option<usize>,
    ) -> Result<Arc<dyn ExecutionPlan>> {
        let parts = state.config_options().execution.target_partitions.max(1) as u64;
        let columns = projection.cloned().unwrap_or_else(|| self.all());
        Ok(Arc::new(Cells::new(source(self.cells, parts)?, self.clone(), columns)))
    }
}
