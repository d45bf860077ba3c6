//! The places of the chain at which something can give.

/// A place of `T = E_base · Π [P_i D_i M_i S_i L_i] · T_tool E_tool`; rows count from 0.
///
/// `P_i` is the part of row i before its joint's motion `M_i`, `S_i` the part behind it: a standard
/// row has no `P`, a modified one no `S`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Site {
    /// Where the arm stands; base axes.
    Base,
    /// On the joint's axis, z along it; x and y do not turn with the joint.
    Joint(usize),
    /// Behind the row, in its frame.
    Link(usize),
    /// The tool frame.
    Tool,
}

impl Site {
    /// Number of sites of an arm with `joints` joints.
    pub fn count(joints: usize) -> usize {
        2 * joints + 2
    }

    /// Its number from base to tool.
    pub fn index(self, joints: usize) -> usize {
        match self {
            Site::Base => 0,
            Site::Joint(row) => 2 * row + 1,
            Site::Link(row) => 2 * row + 2,
            Site::Tool => 2 * joints + 1,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sites_are_numbered_from_base_to_tool() {
        let all = [Site::Base, Site::Joint(0), Site::Link(0), Site::Joint(1), Site::Link(1)];
        let numbers = all.map(|site| site.index(2));
        assert_eq!(numbers, [0, 1, 2, 3, 4]);
        assert_eq!(Site::Tool.index(2), 5);
        assert_eq!(Site::count(2), 6);
    }
}
