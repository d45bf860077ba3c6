//! Names for C.

/// Headers that the generated text may include itself.
const TAKEN: [&str; 3] = ["float", "math", "stdint"];

/// A name for a robot's functions and files, from any text: lower case, every other character `_`.
pub fn c_name(text: &str) -> String {
    let letter = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' };
    let name: String = text.chars().map(letter).collect();
    let starts_well = name.starts_with(|c: char| c.is_ascii_alphabetic());
    if starts_well && !TAKEN.contains(&name.as_str()) { name } else { format!("arm_{name}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_text_becomes_a_name() {
        assert_eq!(c_name("ur10"), "ur10");
        assert_eq!(c_name("KR 240-2"), "kr_240_2");
        assert_eq!(c_name("2R"), "arm_2r");
        assert_eq!(c_name("Stäubli"), "st_ubli");
        assert_eq!(c_name("math"), "arm_math");
        assert_eq!(c_name(""), "arm_");
    }
}
