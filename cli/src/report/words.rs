//! The diagnosis as it is said: made once, for the terminal and for the page.

/// A unit in which numbers are shown.
#[derive(Clone, Debug, PartialEq)]
pub struct Unit {
    /// As it stands behind a number.
    pub name: &'static str,
    /// What one of it is in SI.
    pub si: f64,
    /// Digits behind the point.
    pub decimals: usize,
}

impl Unit {
    /// A number of this unit, without it.
    pub fn number(&self, si: f64) -> String {
        let text = format!("{:.*}", self.decimals, si / self.si);
        text.replacen('-', "−", 1)
    }

    /// With it.
    pub fn with_unit(&self, si: f64) -> String {
        format!("{} {}", self.number(si), self.name)
    }
}

/// A finding as it is said.
#[derive(Clone, Debug, PartialEq)]
pub struct Told {
    /// What reality does, in half a sentence with its size.
    pub said: String,
    /// Its numbers with their intervals.
    pub numbers: Vec<String>,
}

/// A diagnosis as it is said.
#[derive(Clone, Debug, PartialEq)]
pub struct Words {
    /// What to do about the gap.
    pub sentence: String,
    /// The findings, in their order.
    pub findings: Vec<Told>,
    /// What this data could not have shown, one entry for each reason.
    pub hidden: Vec<String>,
    /// Whether the corrected arm is accepted, and why; `None` where nobody asked.
    pub acceptance: Option<(bool, String)>,
    /// What is different from an earlier diagnosis.
    pub changes: Vec<String>,
    /// Its file.
    pub since: String,
    /// In what translations are shown.
    pub length: Unit,
    /// In what rotations are shown.
    pub angle: Unit,
}
