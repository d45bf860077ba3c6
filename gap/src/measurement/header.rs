//! The header row: what each column is, and whether the columns together make a measurement.

use super::Kind;
use super::role::{
    BOARD_NAMES, BOARD_QUATERNION, FROM_NAMES, Family, Layout, NORMAL_NAMES, PIXEL_NAMES,
    POSE_NAMES, Role, SIGMA_PREFIX, TILT_NAMES, nearest_name,
};
use crate::io::columns::{Header, split};
use crate::io::{Column, Dimension, Fault, Map, Mistakes, Unit};

/// One column of the file.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Head {
    pub(crate) column: Column,
    /// The header without its unit.
    pub(crate) name: String,
    /// The text in the brackets.
    pub(crate) unit_text: Option<String>,
    /// `None` if the name is itself a mistake.
    pub(crate) role: Option<Role>,
    /// The unit of its numbers, if they have one.
    pub(crate) unit: Option<Unit>,
}

/// Reads the header row. What is wrong with it goes to `mistakes`.
pub(crate) fn read(
    line: u64,
    names: &[String],
    layout: &Layout,
    mistakes: &mut Mistakes,
) -> Vec<Head> {
    let header = Header {
        line: Some(line),
        names,
        bare: &|name| split(name).0,
        map: &Map::default(),
        known: &|_| None,
        ours: "",
    };
    let wrong = |fault: Fault, k: usize| fault.at(line, Some(header.column(k)));
    let parts: Vec<Result<(&str, Option<&str>), Fault>> = names.iter().map(|n| parts(n)).collect();
    let named = |k: usize| parts[k].as_ref().ok().map(|(name, _)| (*name).to_owned());
    header.assign(&named, mistakes);
    let mut heads: Vec<Head> = Vec::with_capacity(names.len());
    for (k, parts) in parts.into_iter().enumerate() {
        let mut head = Head {
            column: header.column(k),
            name: String::new(),
            unit_text: None,
            role: None,
            unit: None,
        };
        let read = parts.and_then(|(name, unit)| {
            head.name = name.to_owned();
            head.unit_text = unit.map(str::to_owned);
            let role = Role::of(name, layout)?;
            head.role = Some(role);
            unit_of(role, name, unit, layout)
        });
        match read {
            Ok(unit) => head.unit = unit,
            Err(fault) => mistakes.add(wrong(fault, k)),
        }
        heads.push(head);
    }
    heads
}

/// `name[unit]` into its parts.
fn parts(text: &str) -> Result<(&str, Option<&str>), Fault> {
    let (name, unit) = split(text);
    let expected = "`name` or `name[unit]`";
    if text.is_empty() {
        let help = "name the column or remove it (a trailing comma makes one)";
        return Err(Fault::new("no name", expected, help));
    }
    if name.is_empty() || [name, unit.unwrap_or_default()].concat().contains(['[', ']']) {
        return Err(Fault::new(format!("`{text}`"), expected, "mend the brackets"));
    }
    Ok((name, unit))
}

fn unit_of(
    role: Role,
    name: &str,
    found: Option<&str>,
    layout: &Layout,
) -> Result<Option<Unit>, Fault> {
    let Some(expected) = role.dimension(layout) else {
        return match found {
            Some(found) if role != Role::Extra => {
                let (found, help) = (format!("the unit `{found}`"), format!("write `{name}`"));
                Err(Fault::new(found, "none", help))
            }
            _ => Ok(None),
        };
    };
    // Of a bench the standard deviation has the unit of the row's reading.
    let of_reading = |found: &&str| {
        let unit = Unit::named(found).filter(|_| role == Role::Sigma(None))?;
        matches!(unit.dimension, Dimension::Angle | Dimension::Pixels).then_some(unit)
    };
    if let Some(unit) = found.as_ref().and_then(of_reading) {
        return Ok(Some(unit));
    }
    found.map_or_else(|| Ok(expected.si()), |found| expected.unit(found, Unit::named)).map(Some)
}

/// To which kind of columns that belongs which is measured.
pub(crate) fn family(kind: Kind) -> Family {
    match kind {
        Kind::Pose { .. } | Kind::Coordinates { .. } => Family::Pose,
        Kind::Displacement { .. } => Family::Displacement,
        Kind::Distance | Kind::Bench { .. } => Family::Distance,
    }
}

/// Which components are measured and which are simulated by the user. What is missing or does not
/// fit goes to `mistakes`; `None` if nothing is measured.
pub(crate) fn kind(
    heads: &[Head],
    line: u64,
    layout: &Layout,
    mistakes: &mut Mistakes,
) -> Option<(Kind, [bool; 6])> {
    missing_joints(heads, line, layout, mistakes);
    let find = |role| heads.iter().find(|h| h.role == Some(role));
    let measured = |family| (0..6).map(move |k| find(Role::Measured(family, k)));
    let first = |family| measured(family).flatten().min_by_key(|h| h.column.number);
    let mut wrong =
        |head: &Head, fault: Fault| mistakes.add(fault.at(line, Some(head.column.clone())));
    let mut of_each = Family::ALL.into_iter().filter_map(|f| first(f).map(|head| (f, head)));
    let of_board = |h: &&Head| matches!(h.role, Some(Role::BoardPose(_) | Role::BoardTurn(_)));
    if let Some(column) = heads.iter().find(of_board) {
        return board(heads, column, &mut wrong);
    }
    if let Some(column) = heads.iter().find(|h| h.role.is_some_and(Role::is_of_bench)) {
        return bench(heads, column, &mut wrong);
    }
    let Some((family, of_it)) = of_each.next() else {
        let expected = "any of `x y z` (a position), any of `dx dy dz drx dry drz` (a displacement), \
                        `distance`, `point`, `plane`, `along`, `tilt_x tilt_y` or `u v`";
        mistakes.add(
            Fault::new("no measured column", expected, "add what was measured").at(line, None),
        );
        return None;
    };
    if let Some((other, head)) = of_each.next() {
        let found = format!(
            "both {} (`{}`) and {} (`{}`) that were measured",
            family.words(),
            of_it.name,
            other.words(),
            head.name
        );
        wrong(head, Fault::new(found, "one kind", "split the file in two"));
        return None;
    }
    let has: Vec<_> = measured(family).collect();
    let components: [bool; 6] = core::array::from_fn(|k| has[k].is_some());
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
                let help = "it is that of the tool at a position";
                wrong(of_it, without(of_it, &missing, expected, help));
            }
            if let Some((head, missing)) = partial(&has[3..], &POSE_NAMES[3..]) {
                wrong(head, incomplete(head, &missing, "rx, ry, rz"));
            }
            Kind::Pose { orientation: components[3..] == [true; 3] }
        }
    };
    let others = Family::ALL.into_iter().filter(|other| *other != family);
    for (other, k) in others.flat_map(|other| (0..6).map(move |k| (other, k))) {
        if let Some(head) = find(Role::Sim(other, k)) {
            let (is, measures) = (other.words(), family.words());
            let found = format!("`{}`, {is}, in a file that measures {measures}", head.name);
            let expected = format!("`sim_{}`", of_it.name);
            wrong(head, Fault::new(found, expected, "predict what is measured"));
        }
    }
    let sim: Vec<_> = (0..6).map(|k| find(Role::Sim(family, k))).collect();
    if let (Kind::Pose { .. }, Some((head, missing))) =
        (&kind, partial(&sim[3..], &POSE_NAMES[3..]))
    {
        wrong(head, incomplete(head, &format!("sim_{missing}"), "sim_rx, sim_ry, sim_rz"));
    }
    let at: Vec<_> = (0..3).map(|k| find(Role::FromAt(k))).collect();
    let from = at.iter().flatten().copied().chain(find(Role::From)).next();
    if let Some(head) = from.filter(|_| family != Family::Distance) {
        let found = format!("`{}` in a file that measures no distance", head.name);
        wrong(head, Fault::new(found, "a column `distance`", "add it, or remove the point"));
    }
    whole_point(&at, &mut wrong);
    if let (Some(named), Some(head)) = (find(Role::From), at.iter().flatten().next()) {
        let found = format!("both a point's name (`from`) and its place (`{}`)", head.name);
        wrong(named, Fault::new(found, "one of them", "a point with a name alone is fitted"));
    }
    let mut given = [false; 6];
    for (flag, head) in given.iter_mut().zip(sim) {
        *flag = head.is_some();
    }
    if let Some((head, missing)) = sigma(heads, family, kind) {
        let expected = "the standard deviation of every measured component of its kind";
        let help = format!("add {missing}, or `sigma` for all positions");
        wrong(head, without(head, &missing, expected, &help));
    }
    Some((kind, given))
}

/// The point from which a distance is measured, with all its coordinates or none.
fn whole_point(at: &[Option<&Head>], wrong: &mut dyn FnMut(&Head, Fault)) {
    if let Some((head, missing)) = partial(at, &FROM_NAMES) {
        let help = "the point from which a distance is measured has three coordinates";
        wrong(head, without(head, &missing, "all of from_x, from_y, from_z or none", help));
    }
}

/// A file of a board's poses in a camera's axes; `column` is one of theirs.
fn board(
    heads: &[Head],
    column: &Head,
    wrong: &mut dyn FnMut(&Head, Fault),
) -> Option<(Kind, [bool; 6])> {
    let find = |role| heads.iter().find(|h| h.role == Some(role));
    for head in heads {
        let is_other = head.role.is_some_and(Role::is_of_bench)
            || matches!(head.role, Some(Role::Measured(..) | Role::Sim(..) | Role::Sigma(_)));
        if is_other {
            let found = format!("`{}` beside `{}`", head.name, column.name);
            let help = "put what another instrument measured into a file of its own";
            wrong(head, Fault::new(found, "a board's pose alone", help));
        }
    }
    let place: Vec<_> = (0..3).map(|k| find(Role::BoardPose(k))).collect();
    let vector: Vec<_> = (3..6).map(|k| find(Role::BoardPose(k))).collect();
    let turn: Vec<_> = (0..4).map(|k| find(Role::BoardTurn(k))).collect();
    let help = "a board's pose is its place and either a rotation vector or a quaternion";
    let [no_place, no_vector, no_turn] = [
        absent(&place, &BOARD_NAMES[..3]),
        absent(&vector, &BOARD_NAMES[3..]),
        absent(&turn, &BOARD_QUATERNION),
    ];
    if !no_place.is_empty() {
        wrong(column, without(column, &no_place, "all of cx, cy, cz", help));
    }
    let both = "cx cy cz, and crx cry crz or cqw cqx cqy cqz";
    match (no_vector.is_empty(), no_turn.is_empty()) {
        (false, false) => {
            let missing = if turn.iter().any(Option::is_some) { no_turn } else { no_vector };
            wrong(column, without(column, &missing, both, help));
        }
        (true, true) => wrong(column, Fault::new("two orientations", both, "remove one")),
        _ => {}
    }
    Some((Kind::Pose { orientation: true }, [false; 6]))
}

/// A file of what instruments read that are no trackers; `column` is one of theirs.
fn bench(
    heads: &[Head],
    column: &Head,
    wrong: &mut dyn FnMut(&Head, Fault),
) -> Option<(Kind, [bool; 6])> {
    let find = |role| heads.iter().find(|h| h.role == Some(role));
    for head in heads {
        let of_tracker = match head.role {
            Some(Role::Measured(family, _)) => family != Family::Distance,
            Some(Role::Sim(..) | Role::Sigma(Some(_))) => true,
            _ => false,
        };
        if of_tracker {
            let found = format!("`{}` beside `{}`", head.name, column.name);
            let help = "put what a tracker measured into a file of its own; `sigma` is the standard deviation \
                        of each row's reading";
            let expected = "`distance`, `point`, `plane`, `along`, `tilt_x tilt_y` or `u v`";
            wrong(head, Fault::new(found, expected, help));
        }
    }
    type Two = (fn(usize) -> Role, [&'static str; 2], &'static str);
    let twos: [Two; 2] = [
        (Role::Tilt, TILT_NAMES, "an inclinometer reads two angles"),
        (Role::Pixel, PIXEL_NAMES, "a place in a picture has two coordinates"),
    ];
    for (role, names, help) in twos {
        let both: Vec<_> = (0..2).map(|k| find(role(k))).collect();
        if let Some((head, missing)) = partial(&both, &names) {
            wrong(
                head,
                without(head, &missing, &format!("both {} and {}", names[0], names[1]), help),
            );
        }
    }
    if let (Some(zero), None) = (find(Role::Zero), find(Role::Along)) {
        let help = "the zero is that of a dial gauge";
        wrong(zero, without(zero, "along", "a component along a direction", help));
    }
    let normal: Vec<_> = (0..3).map(|k| find(Role::Normal(k))).collect();
    let help = "the direction of a component has three numbers";
    match (find(Role::Along), partial(&normal, &NORMAL_NAMES)) {
        (Some(along), None) if normal[0].is_none() => {
            wrong(along, without(along, "nx, ny, nz", "its direction", help));
        }
        (_, Some((head, missing))) => {
            wrong(head, without(head, &missing, "all of nx, ny, nz", help))
        }
        _ => {}
    }
    let at: Vec<_> = (0..3).map(|k| find(Role::FromAt(k))).collect();
    whole_point(&at, wrong);
    let has = |roles: &[Role]| roles.iter().any(|role| find(*role).is_some());
    let one = has(&[Role::Plane, Role::Along, Role::Measured(Family::Distance, 0)]);
    let lengths = if has(&[Role::Point]) { 3 } else { usize::from(one) };
    let angles = has(&[Role::Tilt(0), Role::Pixel(0)]);
    Some((Kind::Bench { lengths, angles }, [false; 6]))
}

/// A column of a standard deviation, and those that are missing beside it.
fn sigma(heads: &[Head], family: Family, kind: Kind) -> Option<(&Head, String)> {
    let measured = kind.components();
    let find = |role| heads.iter().find(|h| h.role == Some(role));
    let own = |k| find(Role::Sigma(Some((family, k))));
    let of = |k: usize| own(k).or_else(|| find(Role::Sigma(None)).filter(|_| k < 3));
    let names = |missing: Vec<usize>| {
        let each = missing.iter().map(|k| format!("{SIGMA_PREFIX}{}", family.names()[*k]));
        each.collect::<Vec<_>>().join(", ")
    };
    let other =
        heads.iter().find(|h| matches!(h.role, Some(Role::Sigma(Some((f, _)))) if f != family));
    if let Some(other) = other {
        return Some((other, names((0..6).filter(|&k| measured[k]).collect())));
    }
    [0..3, 3..6].into_iter().find_map(|range| {
        let (has, lacks): (Vec<usize>, Vec<usize>) =
            range.filter(|&k| measured[k]).partition(|&k| of(k).is_some());
        let first = has.first().and_then(|k| of(*k))?;
        (!lacks.is_empty()).then(|| (first, names(lacks)))
    })
}

fn missing_joints(heads: &[Head], line: u64, layout: &Layout, mistakes: &mut Mistakes) {
    let needed = if layout.readings { layout.motions.len() } else { 0 };
    let is_missing = |joint: &usize| !heads.iter().any(|h| h.role == Some(Role::Reading(*joint)));
    let missing: Vec<usize> = (0..needed).filter(is_missing).collect();
    if missing.is_empty() {
        return;
    }
    let extra = heads.iter().filter(|h| h.role == Some(Role::Extra));
    let near: Vec<_> = extra.filter_map(|h| Some((nearest_name(&h.name, layout)?, h))).collect();
    for joint in missing {
        let missing = format!("q{}", joint + 1);
        let meant = near.iter().find(|(near, _)| *near == missing);
        let not_it = meant.map_or_else(String::new, |(_, head)| {
            format!(" (`{}` is not it: names are case-sensitive and exact)", head.name)
        });
        let found = format!("no column {missing}");
        let fault = Fault::new(found, "a reading of every joint", format!("add it{not_it}"));
        mistakes.add(fault.at(line, None));
    }
}

fn absent(has: &[Option<&Head>], names: &[&'static str]) -> String {
    let lacking = names.iter().zip(has).filter(|(_, h)| h.is_none());
    lacking.map(|(name, _)| *name).collect::<Vec<_>>().join(", ")
}

/// Some of them but not all: the first present, and the names of the absent.
fn partial<'a>(has: &[Option<&'a Head>], names: &[&'static str]) -> Option<(&'a Head, String)> {
    let missing = absent(has, names);
    let head = has.iter().copied().flatten().next()?;
    (!missing.is_empty()).then_some((head, missing))
}

/// A column without those that belong to it.
fn without(head: &Head, missing: &str, expected: &str, help: &str) -> Fault {
    Fault::new(format!("`{}` without {missing}", head.name), expected, help)
}

fn incomplete(head: &Head, missing: &str, all: &str) -> Fault {
    let help = "an orientation is a rotation vector with three components";
    without(head, missing, &format!("all of {all} or none"), help)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn splits_names_and_units() {
        assert_eq!(parts("q1 [ deg ]"), Ok(("q1", Some("deg"))));
        assert_eq!(parts("pose"), Ok(("pose", None)));
        assert_eq!(parts("").unwrap_err().found, "no name");
        for bad in ["q1[", "q1]", "q1[]", "[deg]", "q1[deg]x", "q1[[deg]]", "q1[a][b]"] {
            assert_eq!(&*parts(bad).unwrap_err().help, "mend the brackets", "{bad}");
        }
    }
}
