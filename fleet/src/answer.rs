//! An answer as a value of the engine: what is asked most in fields of its own, and all of it as JSON.

use std::sync::Arc;

use arrow::array::{ArrayRef, Float64Array, ListArray, StringArray, StructArray};
use arrow::buffer::OffsetBuffer;
use arrow::datatypes::{DataType, Field, Fields};
use datafusion::common::ScalarValue;
use stiffarm_gap::report::{Diagnosis, Finding, Parameter};
use stiffarm_gap::shrink::Shrink;

use crate::question::Question;

/// The numbers of a diagnosis that have fields.
const NUMBERS: [&str; 6] = ["before", "after", "shrink_low", "shrink_high", "noise", "unexplained"];

/// The type of the answers.
pub fn kind(question: Question) -> DataType {
    DataType::Struct(fields(question))
}

fn fields(question: Question) -> Fields {
    let text = |name| Field::new(name, DataType::Utf8, true);
    let mut fields = Vec::new();
    if question == Question::Diagnose {
        fields.extend(NUMBERS.map(|name| Field::new(name, DataType::Float64, true)));
        let found = Field::new_list_field(DataType::Struct(finding()), true);
        fields.push(Field::new("findings", DataType::List(Arc::new(found)), true));
    }
    fields.extend([text("error"), text("json")]);
    fields.into()
}

/// Of a finding a row for each of its numbers.
fn finding() -> Fields {
    let text = |name| Field::new(name, DataType::Utf8, true);
    let number = |name| Field::new(name, DataType::Float64, true);
    let set = Field::new_list_field(DataType::Utf8, true);
    Fields::from(vec![
        text("effect"),
        text("place"),
        text("name"),
        number("value"),
        text("unit"),
        number("low"),
        number("high"),
        Field::new("set", DataType::List(Arc::new(set)), true),
    ])
}

/// The answer as one value.
///
/// # Errors
/// A sentence, if the JSON is not what the command writes.
pub fn value(question: Question, answer: Result<String, String>) -> Result<ScalarValue, String> {
    let (json, error) = match answer {
        Ok(json) => (Some(json), None),
        Err(error) => (None, Some(error)),
    };
    let mut columns: Vec<ArrayRef> = Vec::new();
    if question == Question::Diagnose {
        let read = json.as_deref().map(serde_json::from_str::<Diagnosis>).transpose();
        let found = read.map_err(|error| format!("reading the diagnosis again: {error}"))?;
        let numbers = numbers(found.as_ref());
        columns.extend(numbers.map(|x| Arc::new(Float64Array::from(vec![x])) as ArrayRef));
        columns.push(Arc::new(findings(found.as_ref())));
    }
    columns.extend([error, json].map(|text| Arc::new(StringArray::from(vec![text])) as ArrayRef));
    let whole = StructArray::try_new(fields(question), columns, None);
    whole.map(|whole| ScalarValue::Struct(Arc::new(whole))).map_err(|error| error.to_string())
}

fn numbers(found: Option<&Diagnosis>) -> [Option<f64>; NUMBERS.len()] {
    let Some(Diagnosis { gap, unexplained, .. }) = found else { return Default::default() };
    let Shrink { before, after, shrink_ci95: [low, high], .. } = gap.shrink;
    let noise = match &gap.noise {
        noise if noise.position_rms > 0.0 => noise.position_rms,
        noise => noise.rotation_rms,
    };
    [before, after, low, high, noise, unexplained.position_rms].map(Some)
}

fn findings(found: Option<&Diagnosis>) -> ListArray {
    let findings = found.map_or(&[][..], |found| &found.findings);
    let each: Vec<(&Finding, &Parameter)> =
        findings.iter().flat_map(|f| f.parameters.iter().map(move |p| (f, p))).collect();
    // The explanations that the data do not distinguish from it: `soft_zone at joint 1`.
    let set = |finding: &Finding| -> Vec<String> {
        let rivals = finding.indistinguishable();
        rivals.map(|rival| format!("{} at {}", rival.effect, rival.place)).collect()
    };
    let text = |of: fn(&(&Finding, &Parameter)) -> String| -> ArrayRef {
        Arc::new(each.iter().map(of).map(Some).collect::<StringArray>())
    };
    let number = |of: fn(&(&Finding, &Parameter)) -> f64| -> ArrayRef {
        Arc::new(each.iter().map(of).collect::<Float64Array>())
    };
    let sets: Vec<Vec<String>> = each.iter().map(|(finding, _)| set(finding)).collect();
    let rivals: StringArray = sets.iter().flatten().map(Some).collect();
    let set = Arc::new(Field::new_list_field(DataType::Utf8, true));
    let lengths = OffsetBuffer::from_lengths(sets.iter().map(Vec::len));
    let columns: Vec<ArrayRef> = vec![
        text(|(f, _)| f.effect.to_string()),
        text(|(f, _)| f.place.clone()),
        text(|(_, p)| p.name.to_string()),
        number(|(_, p)| p.value),
        text(|(_, p)| p.unit.to_string()),
        number(|(_, p)| p.ci95[0]),
        number(|(_, p)| p.ci95[1]),
        Arc::new(ListArray::new(set, lengths, Arc::new(rivals), None)),
    ];
    let rows = StructArray::new(finding(), columns, None);
    let item = Arc::new(Field::new_list_field(DataType::Struct(finding()), true));
    let whole = OffsetBuffer::from_lengths([each.len()]);
    let nulls = found.is_none().then(|| vec![false].into());
    ListArray::new(item, whole, Arc::new(rows), nulls)
}
