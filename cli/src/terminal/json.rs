//! JSON that people can read too: objects over lines, a list of plain values on one.

use serde::Serialize;
use serde_json::Value;

use super::failure::Failure;

/// The text, with a newline at its end.
///
/// # Errors
/// [`Failure`] if the value cannot be written as JSON.
pub fn text(value: &impl Serialize) -> Result<String, Failure> {
    let value = self::value(value)?;
    let mut text = String::new();
    write(&mut text, &value, 0);
    text.push('\n');
    Ok(text)
}

/// The same as a value.
///
/// # Errors
/// [`Failure`] if it cannot be written as JSON.
pub fn value(value: &impl Serialize) -> Result<Value, Failure> {
    serde_json::to_value(value)
        .map_err(|error| Failure::new(format!("cannot write the result as JSON: {error}")))
}

fn write(text: &mut String, value: &Value, depth: usize) {
    let entries: Vec<(Option<&String>, &Value)> = match value {
        Value::Array(values) => values.iter().map(|v| (None, v)).collect(),
        Value::Object(map) => map.iter().map(|(key, v)| (Some(key), v)).collect(),
        plain => return text.push_str(&plain.to_string()),
    };
    let (open, close) = if value.is_array() { ('[', ']') } else { ('{', '}') };
    let plain = |v: &Value| !(v.is_array() || v.is_object());
    let inline = entries.is_empty() || value.is_array() && entries.iter().all(|(_, v)| plain(v));
    text.push(open);
    for (k, (key, entry)) in entries.iter().enumerate() {
        match (inline, k) {
            (true, 0) => {}
            (true, _) => text.push_str(", "),
            (false, _) => {
                text.push_str(if k > 0 { ",\n" } else { "\n" });
                indent(text, depth + 1);
            }
        }
        if let Some(key) = key {
            text.push_str(&Value::from(key.as_str()).to_string());
            text.push_str(": ");
        }
        write(text, entry, depth + 1);
    }
    if !inline {
        text.push('\n');
        indent(text, depth);
    }
    text.push(close);
}

fn indent(text: &mut String, depth: usize) {
    text.extend(std::iter::repeat_n("  ", depth));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_of_numbers_stand_on_one_line() {
        let value = serde_json::json!({
            "z": [[1.0, 2.5], [3e-12, -1]], "a": {"b": null, "c": []}, "d": {}, "e": ["x\n", true]
        });
        let want = "{\n  \"z\": [\n    [1.0, 2.5],\n    [3e-12, -1]\n  ],\n  \"a\": {\n    \
                    \"b\": null,\n    \"c\": []\n  },\n  \"d\": {},\n  \
                    \"e\": [\"x\\n\", true]\n}\n";
        assert_eq!(super::text(&value).unwrap(), want);
        assert_eq!(serde_json::from_str::<Value>(want).unwrap(), value);
    }
}
