//! Campaigns by `GROUP BY`: `diagnose(robot, columns…)`, `identify(robot, columns…)`, and `measurements(columns…)`,
//! the measurement file that they answer.
//!
//! What travels between the engine's parts is rows: which of them a fold holds out, and which are left out, is
//! decided when all are there. A campaign without an answer has the sentence that says why.

use std::collections::BTreeSet;
use std::sync::Arc;

use arrow::array::{Array, ArrayRef, AsArray};
use arrow::compute::cast;
use arrow::datatypes::{DataType, Field, FieldRef, Float64Type};
use datafusion::common::{Result, ScalarValue, exec_err};
use datafusion::logical_expr::function::{AccumulatorArgs, StateFieldsArgs};
use datafusion::logical_expr::{
    Accumulator, AggregateUDF, AggregateUDFImpl, Signature, Volatility,
};

use crate::answer;
use crate::arms::Arms;
use crate::question::Question;
use crate::rows::{self, Row};

/// An aggregate of a campaign's rows.
#[derive(Debug, PartialEq, Eq, Hash)]
struct Aggregate {
    /// `None`: the file.
    question: Option<Question>,
    arms: Arc<Arms>,
    signature: Signature,
}

/// All of them.
pub fn aggregates(arms: &Arc<Arms>) -> Vec<AggregateUDF> {
    let each = [Some(Question::Diagnose), Some(Question::Identify), None];
    let aggregate = |question| {
        let signature = Signature::variadic_any(Volatility::Stable);
        AggregateUDF::from(Aggregate { question, arms: Arc::clone(arms), signature })
    };
    each.into_iter().map(aggregate).collect()
}

impl AggregateUDFImpl for Aggregate {
    fn name(&self) -> &str {
        self.question.map_or("measurements", Question::name)
    }

    fn signature(&self) -> &Signature {
        &self.signature
    }

    fn return_type(&self, _: &[DataType]) -> Result<DataType> {
        Ok(self.question.map_or(DataType::Utf8, answer::kind))
    }

    fn state_fields(&self, args: StateFieldsArgs<'_>) -> Result<Vec<FieldRef>> {
        let list = |name: &str, of| {
            let item = Arc::new(Field::new_list_field(of, true));
            Arc::new(Field::new(format!("{}[{name}]", args.name), DataType::List(item), true))
        };
        Ok(vec![
            list("robots", DataType::Utf8),
            list("order", DataType::Float64),
            list("lines", DataType::Utf8),
        ])
    }

    fn accumulator(&self, args: AccumulatorArgs<'_>) -> Result<Box<dyn Accumulator>> {
        let names_robot = usize::from(self.question.is_some());
        if args.expr_fields.len() <= names_robot {
            return exec_err!("{}: found no columns, expected those of measurements", self.name());
        }
        Ok(Box::new(Gathered {
            question: self.question,
            arms: Arc::clone(&self.arms),
            fields: args.expr_fields[names_robot..].to_vec(),
            robots: BTreeSet::new(),
            rows: Vec::new(),
        }))
    }
}

/// The rows of a campaign as far as they have come.
#[derive(Debug)]
struct Gathered {
    question: Option<Question>,
    arms: Arc<Arms>,
    fields: Vec<FieldRef>,
    robots: BTreeSet<String>,
    rows: Vec<Row>,
}

impl Accumulator for Gathered {
    fn update_batch(&mut self, values: &[ArrayRef]) -> Result<()> {
        let values = match self.question {
            None => values,
            Some(_) => {
                let robots = cast(&values[0], &DataType::Utf8)?;
                self.robots.extend(texts(&robots));
                &values[1..]
            }
        };
        self.rows.extend(rows::rows(&self.fields, values)?);
        Ok(())
    }

    fn state(&mut self) -> Result<Vec<ScalarValue>> {
        let rows = std::mem::take(&mut self.rows);
        let list = |values: Vec<ScalarValue>, of| {
            ScalarValue::List(ScalarValue::new_list_nullable(&values, &of))
        };
        let text = |text: String| ScalarValue::Utf8(Some(text));
        let robots = std::mem::take(&mut self.robots).into_iter().map(text).collect();
        let order = rows.iter().map(|row| ScalarValue::Float64(Some(row.order))).collect();
        let lines = rows.into_iter().map(|row| text(row.line)).collect();
        Ok(vec![
            list(robots, DataType::Utf8),
            list(order, DataType::Float64),
            list(lines, DataType::Utf8),
        ])
    }

    fn merge_batch(&mut self, states: &[ArrayRef]) -> Result<()> {
        let [robots, order, lines] = states else {
            return exec_err!("found {} parts of a campaign's rows, expected 3", states.len());
        };
        let (robots, order, lines) =
            (robots.as_list::<i32>(), order.as_list::<i32>(), lines.as_list::<i32>());
        for part in 0..lines.len() {
            self.robots.extend(texts(&robots.value(part)));
            let (order, lines) = (order.value(part), lines.value(part));
            let order = order.as_primitive::<Float64Type>().values();
            let rows = order.iter().zip(texts(&lines));
            self.rows.extend(rows.map(|(order, line)| Row { order: *order, line }));
        }
        Ok(())
    }

    fn evaluate(&mut self) -> Result<ScalarValue> {
        let text = rows::file(&rows::header(&self.fields), std::mem::take(&mut self.rows));
        let Some(question) = self.question else { return Ok(ScalarValue::Utf8(Some(text))) };
        let robots: Vec<&str> = self.robots.iter().map(String::as_str).collect();
        let answer = match robots[..] {
            [robot] => question.ask(&self.arms, robot, text),
            [] => Err("found no robot, expected its name in every row".to_owned()),
            _ => Err(format!("found the robots {}, expected one", robots.join(", "))),
        };
        answer::value(question, answer).or_else(|said| exec_err!("{said}"))
    }

    fn size(&self) -> usize {
        let lines: usize = self.rows.iter().map(|row| row.line.capacity()).sum();
        size_of_val(self) + lines + self.rows.capacity() * size_of::<Row>()
    }
}

fn texts(array: &ArrayRef) -> Vec<String> {
    array.as_string::<i32>().iter().flatten().map(str::to_owned).collect()
}
