//! Whether the columns of a header together make a measurement, and which.

use super::Kind;
use super::header::Head;
use super::role::{
    BOARD_NAMES, BOARD_QUATERNION, FROM_NAMES, Family, Layout, NORMAL_NAMES, PIXEL_NAMES,
    POSE_NAMES, Role, SIGMA_PREFIX, TILT_NAMES, nearest_name,
};
use crate::io::{Fault, Mistakes};

/// To which kind of columns that belongs which is measured.
pub(super) fn family(kind: Kind) -> Family {
    match kind {
        Kind::Pose { .. } | Kind::Coordinates { .. } => Family::Pose,
        Kind::Displacement { .. } => Family::Displacement,
        Kind::Distance | Kind::Bench { .. } => Family::Distance,
    }
}

/// Which components are measured and which are simulated by the user. What is missing or does not
/// fit goes to `mistakes`; `None` if nothing is measured.
pub(super) fn of(
    heads: &[Head],
    line: u64,
    layout: &Layout,
    mistakes: &mut Mistakes,
) -> Option<(Kind, [bool; 6])> {
    let mut all = All { heads, line, mistakes };
    all.need_joints(layout);
    let of_board = |h: &&Head| matches!(h.role, Some(Role::BoardPose(_) | Role::BoardTurn(_)));
    if let Some(column) = heads.iter().find(of_board) {
        return Some((all.board(column), [false; 6]));
    }
    if let Some(column) = heads.iter().find(|h| h.role.is_some_and(Role::is_of_bench)) {
        return Some((all.bench(column), [false; 6]));
    }
    all.of_tracker()
}

/// All columns of a header.
struct All<'h, 'm> {
    heads: &'h [Head],
    line: u64,
    mistakes: &'m mut Mistakes,
}

/// The columns of one kind, each where it is there.
type Group<'h> = Vec<Option<&'h Head>>;

impl<'h> All<'h, '_> {
    fn find(&self, role: Role) -> Option<&'h Head> {
        self.heads.iter().find(|head| head.role == Some(role))
    }

    fn has(&self, roles: &[Role]) -> bool {
        roles.iter().any(|role| self.find(*role).is_some())
    }

    /// Those from the first to the last of these numbers.
    fn group(&self, of: core::ops::Range<usize>, role: impl Fn(usize) -> Role) -> Group<'h> {
        of.map(|k| self.find(role(k))).collect()
    }

    fn wrong(&mut self, head: &Head, fault: Fault) {
        self.mistakes.add(fault.at(self.line, Some(head.column.clone())));
    }

    /// A column without those that belong to it.
    fn without(&mut self, head: &Head, missing: &str, expected: &str, help: &str) {
        self.wrong(head, Fault::new(format!("`{}` without {missing}", head.name), expected, help));
    }

    /// A column beside one that it cannot stand beside.
    fn beside(&mut self, head: &Head, column: &Head, expected: &str, help: &str) {
        let found = format!("`{}` beside `{}`", head.name, column.name);
        self.wrong(head, Fault::new(found, expected, help));
    }

    /// Columns that stand together: all of them, or none; `help` says why.
    fn whole(&mut self, group: &[Option<&Head>], names: &[&str], expected: &str, help: &str) {
        let missing = absent(group, names);
        if let (Some(head), false) = (group.iter().flatten().next(), missing.is_empty()) {
            self.without(head, &missing, expected, help);
        }
    }

    /// The point from which a distance is measured, with all its coordinates or none.
    fn whole_point(&mut self) {
        let help = "the point from which a distance is measured has three coordinates";
        let at = self.group(0..3, Role::FromAt);
        self.whole(&at, &FROM_NAMES, "all of from_x, from_y, from_z or none", help);
    }

    fn need_joints(&mut self, layout: &Layout) {
        let needed = if layout.readings { layout.motions.len() } else { 0 };
        let missing: Vec<usize> =
            (0..needed).filter(|joint| self.find(Role::Reading(*joint)).is_none()).collect();
        for joint in missing {
            let missing = format!("q{}", joint + 1);
            let is_meant = |head: &&Head| {
                head.role == Some(Role::Extra)
                    && nearest_name(&head.name, layout).as_deref() == Some(&*missing)
            };
            let not_it = self.heads.iter().find(is_meant).map_or_else(String::new, |head| {
                format!(" (`{}` is not it: names are case-sensitive and exact)", head.name)
            });
            let (found, help) = (format!("no column {missing}"), format!("add it{not_it}"));
            let fault = Fault::new(found, "a reading of every joint", help);
            self.mistakes.add(fault.at(self.line, None));
        }
    }

    /// A file of what a tracker, a probe or a ball bar measures.
    fn of_tracker(&mut self) -> Option<(Kind, [bool; 6])> {
        let measured = |all: &Self, family| all.group(0..6, |k| Role::Measured(family, k));
        let first = |family| {
            let heads = measured(self, family).into_iter().flatten();
            Some((family, heads.min_by_key(|head| head.column.number)?))
        };
        let there: Vec<(Family, &Head)> = Family::ALL.into_iter().filter_map(first).collect();
        let Some(&(family, of_it)) = there.first() else {
            let expected = "any of `x y z` (a position), any of `dx dy dz drx dry drz` (a displacement), \
                            `distance`, `point`, `plane`, `along`, `tilt_x tilt_y` or `u v`";
            let fault = Fault::new("no measured column", expected, "add what was measured");
            self.mistakes.add(fault.at(self.line, None));
            return None;
        };
        if let Some((other, head)) = there.get(1) {
            let (one, two) = (family.words(), other.words());
            let (it, beside) = (&of_it.name, &head.name);
            let found = format!("both {one} (`{it}`) and {two} (`{beside}`) that were measured");
            self.wrong(head, Fault::new(found, "one kind", "split the file in two"));
            return None;
        }
        let has = measured(self, family);
        let components: [bool; 6] = core::array::from_fn(|k| has[k].is_some());
        let turns = "an orientation is a rotation vector with three components";
        let kind = match family {
            Family::Displacement => Kind::Displacement { components },
            Family::Distance => Kind::Distance,
            Family::Pose if components[3..] == [false; 3] && components[..3] != [true; 3] => {
                let [x, y, z, ..] = components;
                Kind::Coordinates { components: [x, y, z] }
            }
            Family::Pose => {
                let missing = absent(&has[..3], &POSE_NAMES);
                if !missing.is_empty() {
                    let expected = "all of x, y, z beside an orientation";
                    self.without(of_it, &missing, expected, "it is that of the tool at a position");
                }
                self.whole(&has[3..], &POSE_NAMES[3..], "all of rx, ry, rz or none", turns);
                Kind::Pose { orientation: components[3..] == [true; 3] }
            }
        };
        let others = Family::ALL.into_iter().filter(|other| *other != family);
        for (other, k) in others.flat_map(|other| (0..6).map(move |k| (other, k))) {
            if let Some(head) = self.find(Role::Sim(other, k)) {
                let (is, measures) = (other.words(), family.words());
                let found = format!("`{}`, {is}, in a file that measures {measures}", head.name);
                let expected = format!("`sim_{}`", of_it.name);
                self.wrong(head, Fault::new(found, expected, "predict what is measured"));
            }
        }
        let sim = self.group(0..6, |k| Role::Sim(family, k));
        if let Kind::Pose { .. } = kind {
            let names = ["sim_rx", "sim_ry", "sim_rz"];
            self.whole(&sim[3..], &names, "all of sim_rx, sim_ry, sim_rz or none", turns);
        }
        let (at, named) = (self.group(0..3, Role::FromAt), self.find(Role::From));
        let at = at.into_iter().flatten().next();
        if let Some(head) = at.or(named).filter(|_| family != Family::Distance) {
            let found = format!("`{}` in a file that measures no distance", head.name);
            let help = "add it, or remove the point";
            self.wrong(head, Fault::new(found, "a column `distance`", help));
        }
        self.whole_point();
        if let (Some(named), Some(head)) = (named, at) {
            let found = format!("both a point's name (`from`) and its place (`{}`)", head.name);
            let help = "a point with a name alone is fitted";
            self.wrong(named, Fault::new(found, "one of them", help));
        }
        if let Some((head, missing)) = self.sigma(family, kind) {
            let expected = "the standard deviation of every measured component of its kind";
            let help = format!("add {missing}, or `sigma` for all positions");
            self.without(head, &missing, expected, &help);
        }
        Some((kind, core::array::from_fn(|k| sim[k].is_some())))
    }

    /// A file of a board's poses in a camera's axes; `column` is one of theirs.
    fn board(&mut self, column: &Head) -> Kind {
        for head in self.heads {
            let is_other = head.role.is_some_and(Role::is_of_bench)
                || matches!(head.role, Some(Role::Measured(..) | Role::Sim(..) | Role::Sigma(_)));
            if is_other {
                let help = "put what another instrument measured into a file of its own";
                self.beside(head, column, "a board's pose alone", help);
            }
        }
        let turn = self.group(0..4, Role::BoardTurn);
        let no_place = absent(&self.group(0..3, Role::BoardPose), &BOARD_NAMES[..3]);
        let no_vector = absent(&self.group(3..6, Role::BoardPose), &BOARD_NAMES[3..]);
        let no_turn = absent(&turn, &BOARD_QUATERNION);
        let help = "a board's pose is its place and either a rotation vector or a quaternion";
        if !no_place.is_empty() {
            self.without(column, &no_place, "all of cx, cy, cz", help);
        }
        let both = "cx cy cz, and crx cry crz or cqw cqx cqy cqz";
        match (no_vector.is_empty(), no_turn.is_empty()) {
            (false, false) => {
                let missing = if turn.iter().any(Option::is_some) { no_turn } else { no_vector };
                self.without(column, &missing, both, help);
            }
            (true, true) => self.wrong(column, Fault::new("two orientations", both, "remove one")),
            _ => {}
        }
        Kind::Pose { orientation: true }
    }

    /// A file of what instruments read that are no trackers; `column` is one of theirs.
    fn bench(&mut self, column: &Head) -> Kind {
        for head in self.heads {
            let of_tracker = match head.role {
                Some(Role::Measured(family, _)) => family != Family::Distance,
                Some(Role::Sim(..) | Role::Sigma(Some(_))) => true,
                _ => false,
            };
            if of_tracker {
                let help = "put what a tracker measured into a file of its own; `sigma` is the standard \
                            deviation of each row's reading";
                let expected = "`distance`, `point`, `plane`, `along`, `tilt_x tilt_y` or `u v`";
                self.beside(head, column, expected, help);
            }
        }
        let help = "an inclinometer reads two angles";
        self.whole(&self.group(0..2, Role::Tilt), &TILT_NAMES, "both tilt_x and tilt_y", help);
        let help = "a place in a picture has two coordinates";
        self.whole(&self.group(0..2, Role::Pixel), &PIXEL_NAMES, "both u and v", help);
        let (along, normal) = (self.find(Role::Along), self.group(0..3, Role::Normal));
        if let (Some(zero), None) = (self.find(Role::Zero), along) {
            let help = "the zero is that of a dial gauge";
            self.without(zero, "along", "a component along a direction", help);
        }
        let help = "the direction of a component has three numbers";
        if let Some(along) = along.filter(|_| normal.iter().all(Option::is_none)) {
            self.without(along, "nx, ny, nz", "its direction", help);
        }
        self.whole(&normal, &NORMAL_NAMES, "all of nx, ny, nz", help);
        self.whole_point();
        let one = self.has(&[Role::Plane, Role::Along, Role::Measured(Family::Distance, 0)]);
        let lengths = if self.has(&[Role::Point]) { 3 } else { usize::from(one) };
        Kind::Bench { lengths, angles: self.has(&[Role::Tilt(0), Role::Pixel(0)]) }
    }

    /// A column of a standard deviation, and those that are missing beside it.
    fn sigma(&self, family: Family, kind: Kind) -> Option<(&'h Head, String)> {
        let measured = kind.components();
        let own = |k| self.find(Role::Sigma(Some((family, k))));
        let of = |k: usize| own(k).or_else(|| self.find(Role::Sigma(None)).filter(|_| k < 3));
        let names = |missing: Vec<usize>| {
            let each = missing.iter().map(|k| format!("{SIGMA_PREFIX}{}", family.names()[*k]));
            each.collect::<Vec<_>>().join(", ")
        };
        let is_other = |h: &&Head| matches!(h.role, Some(Role::Sigma(Some((f, _)))) if f != family);
        if let Some(other) = self.heads.iter().find(is_other) {
            return Some((other, names((0..6).filter(|&k| measured[k]).collect())));
        }
        [0..3, 3..6].into_iter().find_map(|range| {
            let (has, lacks): (Vec<usize>, Vec<usize>) =
                range.filter(|&k| measured[k]).partition(|&k| of(k).is_some());
            let first = has.first().and_then(|k| of(*k))?;
            (!lacks.is_empty()).then(|| (first, names(lacks)))
        })
    }
}

/// The names of those of a group that are not there.
fn absent(group: &[Option<&Head>], names: &[&str]) -> String {
    let lacking = names.iter().zip(group).filter(|(_, head)| head.is_none());
    lacking.map(|(name, _)| *name).collect::<Vec<_>>().join(", ")
}
