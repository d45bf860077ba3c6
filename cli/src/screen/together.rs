//! What a campaign and a log of one arm say together.

use stiffarm_gap::spring::{Joined, Spring};

use super::{Size, WIDTH, words};
use crate::diagnose::Said;
use crate::terminal::text::{
    Align, bad, bold, decimals, dim, fixed, good, indented, table, wrapped,
};

/// Behind both screens.
pub fn text(said: &Said) -> String {
    let what = dim("compliance of the joints' springs, 95 %");
    let mut text = format!("{}  {what}\n", bold("Together"));
    if !said.springs.is_empty() {
        let heads = ["", "at rest", &words(said.effect), "both"];
        let mut rows = vec![heads.map(dim).to_vec()];
        rows.extend(said.springs.iter().map(|joined| {
            let [joint, at_rest, in_motion, both] = cells(joined);
            let both = if joined.together.is_some() { good(both) } else { bad(both) };
            vec![joint, at_rest, in_motion, both]
        }));
        text.push_str(&indented(&table(&rows, &[Align::Left; 4]), 2));
    }
    text.push_str(&wrapped(&sentences(said).join(" "), WIDTH, 0));
    text
}

/// A joint, its spring at rest, in motion and by both, in one unit.
pub fn cells(joined: &Joined) -> [String; 4] {
    let all = [Some(joined.at_rest), Some(joined.in_motion), joined.together];
    let most = all.iter().flatten().map(|s| s.value.abs()).fold(0.0, f64::max);
    let size = Size::of(&joined.unit, most);
    let shown = |spring: &Spring| {
        let digits = decimals(spring.half_width() / size.si, 2);
        let [value, half] = [spring.value, spring.half_width()].map(|x| fixed(x / size.si, digits));
        let beside = if spring.found { "" } else { ", no finding" };
        format!("{value} ± {half} {}{beside}", size.name)
    };
    let both = joined.together.as_ref().map_or_else(|| "they differ".to_owned(), shown);
    [joined.place.clone(), shown(&joined.at_rest), shown(&joined.in_motion), both]
}

/// The same in words.
pub fn sentences(said: &Said) -> Vec<String> {
    let named = |of: &dyn Fn(&Joined) -> bool| {
        let places: Vec<&str> =
            said.springs.iter().filter(|j| of(j)).map(|j| j.place.as_str()).collect();
        (!places.is_empty()).then(|| together(&places))
    };
    let gives = |joined: &Joined| joined.at_rest.value - joined.in_motion.value;
    let mut sentences = Vec::new();
    if said.springs.is_empty() {
        sentences.push(
            "Neither has found a joint's spring of which the other tells something.".to_owned(),
        );
    }
    if let Some(places) = named(&|j| j.together.is_some()) {
        sentences.push(format!(
            "The spring of {places} is one at rest and in motion: the robot file has that of both, and \
             everything else as it is fitted beside it."
        ));
    }
    if let Some(places) = named(&|j| j.together.is_none() && gives(j) > 0.0) {
        sentences.push(format!(
            "At {places} the campaign shows more give than the log: something gives beyond the joint's encoder, \
             where the log does not see it. Each keeps its own."
        ));
    }
    if let Some(places) = named(&|j| j.together.is_none() && gives(j) < 0.0) {
        sentences.push(format!(
            "At {places} the log shows more give than the campaign: the campaign's readings may be those of the \
             encoder, which have the servo's give in them already. Each keeps its own."
        ));
    }
    let [campaign, log] = [said.campaign, said.log];
    let position = Size::of(said.measured_in, campaign[0].max(campaign[1]));
    sentences.push(format!(
        "With these springs {} is left of the campaign's rows ({} with its own), and {} % of the log's ({} %).",
        position.with_unit(campaign[1]),
        position.with_unit(campaign[0]),
        fixed(100.0 * log[1], 1),
        fixed(100.0 * log[0], 1),
    ));
    sentences
}

/// `joint 1, joint 2 and joint 3`.
fn together(places: &[&str]) -> String {
    match places {
        [first @ .., last] if !first.is_empty() => format!("{} and {last}", first.join(", ")),
        _ => places.concat(),
    }
}
