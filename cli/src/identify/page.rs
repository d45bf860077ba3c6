//! What the page of an identification shows beside the screen's words.

use stiffarm_gap::Measurements;
use stiffarm_gap::identify::measured::{Answer, Question};

use crate::input::source::Source;
use crate::report::Unit;
use crate::screen::Size;
use crate::terminal::text::decimals;

/// Units of translations and rotations, with digits for what is left.
pub fn units(answer: &Answer) -> [Unit; 2] {
    let (before, after) = (&answer.gap.before, &answer.gap.held_out);
    let unit = |name, [before, after]: [f64; 2]| {
        let size = Size::of(name, before.max(after));
        let least = before.min(after) / size.si;
        Unit { name: size.name, si: size.si, decimals: decimals(least, 2).min(3) }
    };
    [
        unit("m", [before.position_rms, after.position_rms]),
        unit("rad", [before.rotation_rms, after.rotation_rms]),
    ]
}

/// Names and values of what it was given.
pub fn facts(
    question: &Question,
    source: &Source,
    data: &Measurements,
    answer: &Answer,
) -> Vec<(&'static str, String)> {
    let mut looked_for = vec!["joints"];
    looked_for.extend(question.links.then_some("links"));
    looked_for.extend(question.base.then_some("base"));
    let noise = match answer.noise.from {
        "option" => "as given by option",
        "repeats" => "from repeats",
        _ => "from what is left",
    };
    vec![
        ("stiffarm", env!("CARGO_PKG_VERSION").to_owned()),
        ("robot", source.given.clone()),
        ("measurements", data.file.clone()),
        ("looked for", looked_for.join(", ")),
        ("folds of poses", answer.gap.folds.to_string()),
        ("seed", question.seed.to_string()),
        ("noise", noise.to_owned()),
        ("degrees of freedom", answer.freedom.to_string()),
        ("condition number of the scaled columns", format!("{:.3}", answer.scaled_condition)),
    ]
}
