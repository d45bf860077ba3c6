//! The figures of ISO 9283 as the page has them.

use stiffarm_gap::performance::{POSES, Performance, VISITS};

use super::Report;

/// Rows of the table (what, mean, worst pose), and what the data do not have of what the standard asks.
pub struct Figures {
    pub rows: Vec<[String; 3]>,
    pub caveat: String,
}

/// The figures, or why there are none.
pub fn figures(report: &Report<'_>) -> Figures {
    let gaps = [&report.gaps.before[..], &report.gaps.after[..]];
    let Some(found) = Performance::of(report.data, gaps) else {
        let caveat = match report.data.kind.is_pose() {
            true => {
                "No pose was left and visited again, so that these data say nothing of them: what is \
                 read twice without a move shows the instrument, not the arm."
            }
            false => "They are those of positions, which these data do not have.",
        };
        return Figures { rows: Vec::new(), caveat: caveat.to_owned() };
    };
    let unit = report.main_unit();
    let row = |name: &str, over: stiffarm_gap::performance::Over| {
        [name.to_owned(), unit.with_unit(over.mean), unit.with_unit(over.most)]
    };
    let [before, after] = found.accuracy;
    let rows = vec![
        row("pose accuracy AP, robot file", before),
        row("pose accuracy AP, with the findings", after),
        row("pose repeatability RP", found.repeatability),
    ];
    let [least, most] = found.visits;
    let visits = if least == most { format!("{least}") } else { format!("{least} to {most}") };
    let poses = if found.poses == 1 { "pose" } else { "poses" };
    let asked = match found.is_standard() {
        true => "as many as the standard asks for".to_owned(),
        false => format!("the standard asks for {POSES} poses and {VISITS} visits"),
    };
    let caveat = format!(
        "From {} {poses} with {visits} visits each: {asked}. It also asks for poses in a plane of a cube, \
         the rated load and the rated speed, of which the file says nothing. What is commanded is what \
         the model says; AP is that of models fitted to these rows.",
        found.poses
    );
    Figures { rows, caveat }
}
