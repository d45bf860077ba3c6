//! The figures of ISO 9283 as the page has them.

use stiffarm_gap::performance::{Over, POSES, Performance, VISITS};

use super::{Campaign, Fitted};
use crate::text::counted;
use crate::{Block, Cell, Table};

impl Campaign<'_> {
    /// The figures and what the standard asks beyond, or why there are none.
    pub(super) fn performance(&self, fitted: &Fitted<'_>) -> Vec<Block> {
        let gaps = [&fitted.gaps.before[..], &fitted.gaps.after[..]];
        let Some(found) = Performance::of(self.data, gaps) else {
            let caveat = match self.data.kind.is_pose() {
                true => {
                    "The figures of ISO 9283 need poses that were left and visited again, which these data \
                     do not have. Repeated readings without a move show the instrument, not the arm."
                }
                false => "The figures of ISO 9283 need positions, which these data do not have.",
            };
            return vec![Block::Paragraph(caveat.to_owned())];
        };
        let unit = self.main();
        let row = |name: &str, over: Over| {
            let [mean, most] = [over.mean, over.most].map(|x| Cell::number(unit.with_unit(x)));
            vec![name.into(), mean, most]
        };
        let [before, after] = found.accuracy;
        let [least, most] = found.visits;
        let visits = if least == most { format!("{least}") } else { format!("{least} to {most}") };
        let asked = match found.is_standard() {
            true => "as many as the standard asks for".to_owned(),
            false => format!("the standard asks for {POSES} poses and {VISITS} visits"),
        };
        let caption = format!(
            "From {} with {visits} visits each: {asked}. The standard also asks for poses in a plane of a cube, \
             the rated load and the rated speed, which the file does not state. The commanded pose is that of the \
             model; AP is that of models fitted to these rows.",
            counted(found.poses, "loaded pose"),
        );
        let table = Table {
            heads: ["ISO 9283", "mean over poses", "worst pose"].map(str::to_owned).to_vec(),
            rows: vec![
                row("pose accuracy AP, robot file", before),
                row("pose accuracy AP, with the findings", after),
                row("pose repeatability RP", found.repeatability),
            ],
            caption,
        };
        vec![Block::Table(table)]
    }
}
