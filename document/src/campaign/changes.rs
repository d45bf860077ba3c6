//! This campaign against the last one.

use stiffarm_gap::report::{Finding, Parameter, Word};

use super::Campaign;
use crate::Block;
use crate::beside::Reached;
use crate::words::named;

impl Campaign<'_> {
    /// What is different from the last campaign; `None` where nobody asked.
    pub(super) fn changes(&self) -> Option<Block> {
        let compared = self.compared?;
        let mut lines = Vec::new();
        if compared.same_data == Some(true) {
            lines.push("both diagnoses are of the same measurements".to_owned());
        }
        if compared.same_robot == Some(false) {
            lines.push("the two diagnoses start from different robot files".to_owned());
        }
        lines.push(self.reached(&compared.last, &compared.now));
        let names = |each: &[(Word, String)]| -> Vec<String> {
            each.iter().map(|(effect, place)| named(effect, place)).collect()
        };
        lines.extend(names(&compared.added).into_iter().map(|name| format!("new: {name}")));
        for ((effect, place), name) in compared.removed.iter().zip(names(&compared.removed)) {
            let hidden = &self.found.cannot_see;
            let hidden = hidden.iter().find(|c| c.effect == *effect && c.place == *place);
            let why = hidden.map_or_else(String::new, |c| {
                format!(" (these data could not have shown it: {})", c.because())
            });
            lines.push(format!("no longer found: {name}{why}"));
        }
        for number in &compared.numbers {
            let of = |f: &&Finding| f.is(&number.effect, &number.place);
            let Some(finding) = self.found.findings.iter().find(of) else { continue };
            let same = |p: &&Parameter| p.name == number.name;
            let Some(now) = finding.parameters.iter().find(same) else { continue };
            let size = self.size(finding, now);
            let one = |k: usize| {
                let [low, high] = number.ci95[k].map(|x| size.number(x));
                format!("{} [{low} to {high}]", size.number(number.values[k]))
            };
            let verdict = if number.changed { "changed" } else { "no significant change" };
            let name = named(&number.effect, &number.place);
            let (then, now) = (one(0), one(1));
            lines.push(format!("{name}: {} {then} → {now} {}, {verdict}", number.name, size.name));
        }
        Some(Block::Section {
            heading: "Changed".to_owned(),
            remark: format!("since {}, then → now, with 95 % intervals", compared.file),
            blocks: vec![Block::List(lines)],
        })
    }

    fn reached(&self, last: &Reached, now: &Reached) -> String {
        let (least, most) = (last.after.min(now.after), last.before.max(now.before));
        let shown = self.units().main([least, most]);
        let one = |reached: &Reached| {
            let [low, high] = reached.interval().map(|x| shown.number(x));
            format!("{} [{low} to {high}]", shown.number(reached.after))
        };
        format!(
            "{} {} → {}; with the findings {} → {} {}",
            self.error(),
            shown.number(last.before),
            shown.with_unit(now.before),
            one(last),
            one(now),
            shown.name
        )
    }
}
