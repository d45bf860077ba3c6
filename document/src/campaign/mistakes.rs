//! Mistakes of the file: what is wrong, what the error is without it, and how it is mended.

use stiffarm_gap::report::campaign::{Mistaken, Wrong};

use super::Campaign;
use crate::words::{capital, joined};
use crate::{Block, Unit};

/// Other explanations before the rest is counted.
const MOST_SAME: usize = 4;

/// A rotation of less than this part of what it was, where positions have not changed by as much.
const TURNED: f64 = 0.5;

impl Campaign<'_> {
    /// `Joint 2 turns against its reading. With it mended the position error is 0.75 mm instead of 254 mm.`
    pub(super) fn mistaken(&self, wrong: &Mistaken) -> String {
        let what: Vec<String> = wrong.mistakes.iter().map(|wrong| wrong.sentence.clone()).collect();
        let it = match what.len() {
            1 => "With it mended",
            2 => "With both mended",
            _ => "With all mended",
        };
        format!("{}. {it} {}.", capital(&joined(&what, ", and ")), self.change(wrong))
    }

    /// What the error is without mistakes and with them, frames, zeros and springs fitted to both: of positions, or
    /// of rotations where the mistake changes nothing else.
    fn change(&self, wrong: &Mistaken) -> String {
        let [[before, after], [turned, turns]] = [wrong.position, wrong.rotation];
        let in_rotation = after > TURNED * before && turned > 0.0 && turns <= TURNED * turned;
        let (what, unit, [before, after]) = match in_rotation {
            true => ("rotation", "rad", [turned, turns]),
            false => ("position", "m", [before, after]),
        };
        let shown = |size: f64| Unit::of(unit, size).with_unit(size);
        format!("the {what} error is {} instead of {}", shown(after), shown(before))
    }

    /// A gap that is no arm's.
    pub(super) fn no_arms(&self, wrong: &Mistaken) -> String {
        let left = wrong.position[0];
        format!(
            "Nothing explains the position error: with frames, zeros and springs fitted it is {}, no mistake in the \
             file or in the readings explains it, alone or with another one, and no arm is off by as much. Is it \
             another arm, or another file?",
            Unit::of("m", left).with_unit(left)
        )
    }

    /// How mistakes are mended, and what these data do not distinguish from them.
    pub(super) fn mistakes(&self) -> Vec<Block> {
        let Some(wrong) = &self.found.mistaken else { return Vec::new() };
        let mended = |wrong: &Wrong| match wrong.in_robot_file {
            true => format!("{}: --write-robot writes it mended", capital(&wrong.sentence)),
            false => format!("{}: {}", capital(&wrong.sentence), wrong.mending),
        };
        let lines: Vec<String> = wrong.mistakes.iter().map(mended).collect();
        let set = |set: &Vec<Wrong>| {
            let each: Vec<&str> = set.iter().map(|wrong| wrong.sentence.as_str()).collect();
            each.join(", and ")
        };
        let same: Vec<String> = wrong.same.iter().map(set).collect();
        let most = lines.len();
        let notes =
            [Block::notes("Mistaken", lines, most), Block::notes("Or else", same, MOST_SAME)];
        notes.into_iter().flatten().collect()
    }
}
