//! The schema told to people and to editors: the tables of `docs/robot-file.md`, and a JSON Schema.

use super::field::{Absent, Field, Slot, Unit};
use super::fields::{BASE, BEAM, FRAME, JOINT, MARKER, PAYLOAD, ROBOT, SECTION, TOOL};
use super::read::{CONVENTIONS, MOTIONS, SIDES, TENSOR};
use crate::robot::{Motion, Robot};

const NUMBER: &str = r#"{ "type": ["number", "string"] }"#;
const TEXT: &str = r#"{ "type": "string" }"#;
/// A section's shapes, which are no fields of the model: it holds their constants.
const SHAPES: [(&str, [&str; 2]); 2] =
    [("tube", ["outer_diameter", "inner_diameter"]), ("box", ["outer", "inner"])];

impl Robot {
    /// The fields of a robot file as tables in Markdown.
    pub fn schema_tables() -> String {
        let tables = [
            table("The file", ROBOT),
            table("`[[joint]]`", JOINT),
            table("`[joint.beam]`", BEAM),
            table("`section` by its constants", SECTION),
            table("`[base]`", BASE),
            table("`[tool]`", TOOL),
            table("`[[frame]]`", FRAME),
            table("`[[marker]]`", MARKER),
            table("`[[payload]]`", PAYLOAD),
        ];
        tables.join("\n")
    }

    /// The JSON Schema of a robot file, for editors.
    pub fn json_schema() -> String {
        let title = "\"$schema\": \"http://json-schema.org/draft-07/schema#\",\n  \
                     \"title\": \"stiffarm robot file\",";
        let schema = object(ROBOT, 0);
        format!("{}\n", schema.replacen('{', &format!("{{\n  {title}"), 1))
    }
}

fn table<T: Default>(title: &str, fields: &[Field<T>]) -> String {
    let mut text = format!("{title}\n\n| key | value | without it | |\n|---|---|---|---|\n");
    for field in fields {
        let absent = match field.absent {
            Absent::Mistake(_) => "a mistake",
            Absent::Default(default) => default,
        };
        let (name, value, says) = (field.name, value(field), field.says);
        text += &format!("| `{name}` | {value} | {absent} | {says} |\n");
    }
    text
}

/// What a file holds for a field, in words.
fn value<T: Default>(field: &Field<T>) -> String {
    let measured = |form: &str| match field.unit {
        Unit::None => form.to_owned(),
        Unit::Is(dimension) => format!("{form} {}", dimension.unit()).trim_end().to_owned(),
        Unit::By(by) => {
            let [revolute, prismatic] = [Motion::Revolute, Motion::Prismatic].map(by);
            let revolute = format!("{form} {}", revolute.unit());
            format!("{}; prismatic: {}", revolute.trim_end(), prismatic.unit())
        }
    };
    let form = match (field.slot)(&mut T::default()) {
        Slot::Text(_) | Slot::MaybeText(_) | Slot::Carries => "text".to_owned(),
        Slot::Convention(_) => words(&CONVENTIONS),
        Slot::Motion(_) => words(&MOTIONS),
        Slot::Side(_) => words(&SIDES),
        Slot::Angle(_) | Slot::Value(_) | Slot::Maybe(_) => measured("number"),
        Slot::Vector(_) | Slot::MaybeVector(_) => measured("[x, y, z]"),
        Slot::Tensor(_) => measured(TENSOR),
        Slot::Rotation(_) => measured("[rx, ry, rz]"),
        Slot::Limits(..) => measured("[lower, upper]"),
        Slot::Row(_) => "number from 1, or text".to_owned(),
        Slot::Outputs(_) => "list of texts".to_owned(),
        Slot::Section(_) | Slot::Beam(_) | Slot::Frame(..) => "table".to_owned(),
        Slot::Joints(_) | Slot::Frames(_) | Slot::Markers(_) => "tables".to_owned(),
        Slot::Effects(_) | Slot::Payloads(_) => "tables".to_owned(),
    };
    let parameter = field.number.is_none() && !matches!(field.unit, Unit::None);
    if parameter { format!("{form}; or a parameter") } else { form }
}

fn words<T>(words: &[(&str, T)]) -> String {
    let each: Vec<String> = words.iter().map(|(word, _)| format!("`\"{word}\"`")).collect();
    each.join(", ")
}

/// A table as a JSON Schema, `depth` levels in.
fn object<T: Default>(fields: &[Field<T>], depth: usize) -> String {
    let indent = "  ".repeat(depth + 1);
    let needed = fields.iter().filter(|field| matches!(field.absent, Absent::Mistake(_)));
    let required: Vec<String> = needed.map(|field| format!("{:?}", field.name)).collect();
    let properties: Vec<String> = fields
        .iter()
        .map(|field| {
            let schema = schema(field, depth + 2);
            let says = format!("{{ \"description\": {:?},", field.says);
            format!("\n{indent}  {:?}: {}", field.name, schema.replacen('{', &says, 1))
        })
        .collect();
    let required = required.join(", ");
    format!(
        "{{\n{indent}\"type\": \"object\",\n{indent}\"additionalProperties\": false,\n{indent}\
         \"required\": [{required}],\n{indent}\"properties\": {{{}\n{indent}}}\n{}}}",
        properties.join(","),
        "  ".repeat(depth)
    )
}

/// The value of a field as a JSON Schema.
fn schema<T: Default>(field: &Field<T>, depth: usize) -> String {
    let choice = |words: Vec<&str>| format!("{{ \"enum\": {words:?} }}");
    match (field.slot)(&mut T::default()) {
        Slot::Text(_) | Slot::MaybeText(_) | Slot::Carries => TEXT.to_owned(),
        Slot::Convention(_) => choice(CONVENTIONS.map(|(word, _)| word).to_vec()),
        Slot::Motion(_) => choice(MOTIONS.map(|(word, _)| word).to_vec()),
        Slot::Side(_) => choice(SIDES.map(|(word, _)| word).to_vec()),
        Slot::Angle(_) | Slot::Value(_) | Slot::Maybe(_) | Slot::Row(_) => NUMBER.to_owned(),
        Slot::Vector(_) | Slot::MaybeVector(_) | Slot::Rotation(_) => list(NUMBER, Some(3)),
        Slot::Tensor(_) => list(NUMBER, Some(6)),
        Slot::Limits(..) => list(NUMBER, Some(2)),
        Slot::Outputs(_) => list(TEXT, None),
        Slot::Section(_) => section(depth),
        Slot::Beam(_) => object(BEAM, depth),
        Slot::Frame(_, fields, _) => object(fields, depth),
        Slot::Joints(_) => list(&object(JOINT, depth), None),
        Slot::Frames(_) => list(&object(FRAME, depth), None),
        Slot::Markers(_) => list(&object(MARKER, depth), None),
        Slot::Payloads(_) => list(&object(PAYLOAD, depth), None),
        Slot::Effects(_) => {
            let known = format!("{{ \"id\": {TEXT}, \"place\": {TEXT} }}");
            let effect = format!(
                "{{ \"type\": \"object\", \"required\": [\"id\", \"place\"], \"properties\": {known}, \
                 \"additionalProperties\": {NUMBER} }}"
            );
            list(&effect, None)
        }
    }
}

fn list(entry: &str, length: Option<usize>) -> String {
    let length = length.map(|n| format!(", \"minItems\": {n}, \"maxItems\": {n}"));
    format!("{{ \"type\": \"array\", \"items\": {entry}{} }}", length.unwrap_or_default())
}

fn section(depth: usize) -> String {
    let shape = |(name, [outer, inner]): (&str, [&str; 2])| {
        let size = if name == "box" { list(NUMBER, Some(2)) } else { NUMBER.to_owned() };
        let shape = format!("\"shape\": {{ \"enum\": [{name:?}] }}");
        format!(
            "{{ \"type\": \"object\", \"additionalProperties\": false, \"required\": [\"shape\", \
             {outer:?}], \"properties\": {{ {shape}, {outer:?}: {size}, {inner:?}: {size} }} }}"
        )
    };
    let [tube, rectangle] = SHAPES.map(shape);
    format!("{{ \"anyOf\": [{tube}, {rectangle}, {}] }}", object(SECTION, depth))
}

#[cfg(test)]
mod tests {
    use super::*;

    const DOCS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/");
    const FENCES: [&str; 2] = ["<!-- schema -->\n", "<!-- end of schema -->"];

    /// `SCHEMA=overwrite cargo test -p stiffarm-tests describe` writes both files.
    #[test]
    fn the_documentation_is_of_this_schema() {
        let page = format!("{DOCS}robot-file.md");
        let text = std::fs::read_to_string(&page).expect("the page is beside the package");
        let (before, rest) = text.split_once(FENCES[0]).expect("the schema begins");
        let (_, after) = rest.split_once(FENCES[1]).expect("the schema ends");
        let [begin, end] = FENCES;
        let tables = format!("{before}{begin}\n{}\n{end}{after}", Robot::schema_tables());
        let json = format!("{DOCS}robot.schema.json");
        if std::env::var("SCHEMA").is_ok_and(|what| what == "overwrite") {
            std::fs::write(&page, &tables).expect("the page can be written");
            std::fs::write(&json, Robot::json_schema()).expect("the schema can be written");
        }
        assert_eq!(std::fs::read_to_string(&page).unwrap(), tables);
        assert_eq!(std::fs::read_to_string(&json).unwrap(), Robot::json_schema());
    }
}
