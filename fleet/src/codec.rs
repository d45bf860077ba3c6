//! Grids on their way through a cluster, beside what Ballista sends itself: client to scheduler as a table, scheduler
//! to executors as a reading of it.

use std::sync::Arc;

use arrow::datatypes::SchemaRef;
use ballista_core::serde::{BallistaLogicalExtensionCodec, BallistaPhysicalExtensionCodec};
use datafusion::catalog::TableProvider;
use datafusion::common::{Result, TableReference, exec_datafusion_err, plan_err};
use datafusion::datasource::file_format::FileFormatFactory;
use datafusion::execution::TaskContext;
use datafusion::logical_expr::{Extension, LogicalPlan};
use datafusion::physical_plan::ExecutionPlan;
use datafusion_proto::logical_plan::LogicalExtensionCodec;
use datafusion_proto::physical_plan::{PhysicalExtensionCodec, PhysicalProtoConverterExtension};
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::cells::Cells;
use crate::grid::Grid;

/// Before a reading of a grid. What Ballista sends begins with the number of a field of a message, which is not 0.
const MARK: &[u8] = b"\0grid";

/// Plans as they are asked.
#[derive(Debug, Default)]
pub struct Logical(BallistaLogicalExtensionCodec);

/// Plans as they are run.
#[derive(Debug, Default)]
pub struct Physical(BallistaPhysicalExtensionCodec);

fn write(value: &impl Serialize, buffer: &mut Vec<u8>) -> Result<()> {
    serde_json::to_writer(buffer, value).map_err(|error| exec_datafusion_err!("grid: {error}"))
}

fn read<T: DeserializeOwned>(buffer: &[u8]) -> Result<T> {
    serde_json::from_slice(buffer).map_err(|error| exec_datafusion_err!("grid: {error}"))
}

impl LogicalExtensionCodec for Logical {
    fn try_decode_table_provider(
        &self,
        buffer: &[u8],
        _: &TableReference,
        _: SchemaRef,
        _: &TaskContext,
    ) -> Result<Arc<dyn TableProvider>> {
        Ok(Arc::new(read::<Grid>(buffer)?))
    }

    fn try_encode_table_provider(
        &self,
        name: &TableReference,
        table: Arc<dyn TableProvider>,
        buffer: &mut Vec<u8>,
    ) -> Result<()> {
        match table.downcast_ref::<Grid>() {
            Some(grid) => write(grid, buffer),
            None => {
                plan_err!("table {name}: found {table:?}, expected files or a grid on a cluster")
            }
        }
    }

    fn try_decode(
        &self,
        buffer: &[u8],
        inputs: &[LogicalPlan],
        context: &TaskContext,
    ) -> Result<Extension> {
        self.0.try_decode(buffer, inputs, context)
    }

    fn try_encode(&self, node: &Extension, buffer: &mut Vec<u8>) -> Result<()> {
        self.0.try_encode(node, buffer)
    }

    fn try_decode_file_format(
        &self,
        buffer: &[u8],
        context: &TaskContext,
    ) -> Result<Arc<dyn FileFormatFactory>> {
        self.0.try_decode_file_format(buffer, context)
    }

    fn try_encode_file_format(
        &self,
        buffer: &mut Vec<u8>,
        format: Arc<dyn FileFormatFactory>,
    ) -> Result<()> {
        self.0.try_encode_file_format(buffer, format)
    }
}

impl PhysicalExtensionCodec for Physical {
    fn try_decode(
        &self,
        buffer: &[u8],
        inputs: &[Arc<dyn ExecutionPlan>],
        context: &TaskContext,
        converter: &dyn PhysicalProtoConverterExtension,
    ) -> Result<Arc<dyn ExecutionPlan>> {
        match buffer.strip_prefix(MARK) {
            Some(cells) => {
                let (grid, columns) = read::<(Grid, Vec<usize>)>(cells)?;
                match inputs {
                    [ranges] => Ok(Arc::new(Cells::new(Arc::clone(ranges), grid, columns))),
                    _ => plan_err!("grid: found {} inputs, expected one", inputs.len()),
                }
            }
            None => self.0.try_decode(buffer, inputs, context, converter),
        }
    }

    fn try_encode(
        &self,
        node: Arc<dyn ExecutionPlan>,
        buffer: &mut Vec<u8>,
        converter: &dyn PhysicalProtoConverterExtension,
    ) -> Result<()> {
        match node.downcast_ref::<Cells>() {
            Some(cells) => {
                buffer.extend_from_slice(MARK);
                write(&(cells.grid.as_ref(), &cells.columns), buffer)
            }
            None => self.0.try_encode(node, buffer, converter),
        }
    }
}
