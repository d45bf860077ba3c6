//! The document of a campaign and a log of one arm: what both show of the joints' springs, then each.

use stiffarm_gap::spring::{Joined, Spring};

use super::words::{joined, words};
use super::{Block, Cell, Document, Embedded, Row, Table, Unit};
use crate::beside::Said;
use crate::text::{decimals, fixed};

/// The document; `parts` are those of the campaign and of the log, with what their pages embed.
pub fn document(said: &Said, parts: [(Document, Embedded); 2]) -> Document {
    let robot = parts[1].0.robot.clone();
    let mut blocks = vec![Block::Sentence(sentences(said).join(" "))];
    if !said.springs.is_empty() {
        let mut table = Table::new(["", "at rest", &words(said.effect), "both"]);
        table.rows = said.springs.iter().map(row).collect();
        table.caption = "With 95 % intervals.".to_owned();
        blocks.push(Block::section("Joint compliance", vec![Block::Table(table)]));
    }
    blocks.extend(parts.map(|(part, embedded)| Block::Document(part, embedded)));
    Document {
        robot,
        about: "at rest and in motion",
        facts: "a campaign at rest and a log in motion, diagnosed together".to_owned(),
        blocks,
    }
}

/// A joint, its compliance at rest, in motion and by both, in one unit.
fn row(spring: &Joined) -> Row {
    let all = [Some(spring.at_rest), Some(spring.in_motion), spring.together];
    let most = all.iter().flatten().map(|s| s.value.abs()).fold(0.0, f64::max);
    let size = Unit::of(&spring.unit, most);
    let shown = |spring: &Spring| {
        let digits = decimals(spring.half_width() / size.si, 2);
        let [value, half] = [spring.value, spring.half_width()].map(|x| fixed(x / size.si, digits));
        let beside = if spring.found { "" } else { ", not a finding" };
        format!("{value} ± {half} {}{beside}", size.name)
    };
    let both = spring.together.as_ref();
    let text = both.map_or_else(|| "they differ".to_owned(), shown);
    vec![
        spring.place.as_str().into(),
        shown(&spring.at_rest).into(),
        shown(&spring.in_motion).into(),
        Cell::Judged(both.is_some(), text),
    ]
}

/// What both show, in sentences.
pub fn sentences(said: &Said) -> Vec<String> {
    let places = |of: &dyn Fn(&Joined) -> bool| {
        let places = said.springs.iter().filter(|spring| of(spring));
        let places: Vec<String> = places.map(|spring| spring.place.clone()).collect();
        (!places.is_empty()).then(|| joined(&places, " and "))
    };
    let more = |spring: &Joined| spring.at_rest.value - spring.in_motion.value;
    let mut sentences = Vec::new();
    if said.springs.is_empty() {
        let none = "Neither finds a joint compliance that the other can estimate.";
        sentences.push(none.to_owned());
    }
    if let Some(places) = places(&|j| j.together.is_some()) {
        sentences.push(format!(
            "The compliance of {places} is the same at rest and in motion: the robot file has the estimate from \
             both, and all other parameters are refitted with it."
        ));
    }
    if let Some(places) = places(&|j| j.together.is_none() && more(j) > 0.0) {
        sentences.push(format!(
            "At {places} the campaign shows more compliance than the log: the arm is compliant beyond the joint's \
             encoder, where the log does not see it. Each keeps its own estimate."
        ));
    }
    if let Some(places) = places(&|j| j.together.is_none() && more(j) < 0.0) {
        sentences.push(format!(
            "At {places} the log shows more compliance than the campaign: the campaign's joint values may be encoder \
             positions, which include the servo's compliance. Each keeps its own estimate."
        ));
    }
    let [campaign, log] = [said.campaign, said.log];
    let position = Unit::of(said.measured_in, campaign[0].max(campaign[1]));
    sentences.push(format!(
        "With these compliances the campaign's error is {} rms ({} with its own), and the log's {} % ({} %).",
        position.with_unit(campaign[1]),
        position.with_unit(campaign[0]),
        fixed(100.0 * log[1], 1),
        fixed(100.0 * log[0], 1),
    ));
    sentences
}
