//! Mistakes in a robot file or in readings: a sign, a zero by a quarter of a turn, a coupling of one, a unit.
//!
//! They come before mechanics. A gap that is larger than makers' tolerances leave beside fitted frames, zeros
//! and springs is first asked for mistakes: each is taken out exactly, with the frames refitted (`fit`), alone
//! and in pairs (`search`). What is named leaves what an arm leaves; the diagnosis then goes on without
//! it. A gap of decimetres that no mistake explains is no arm's: no effect is looked for.

mod bench;
mod fit;
mod kind;
mod list;
mod off;
mod rows;
mod search;
mod words;

use stiffarm_kernels::generic::Arm;
use stiffarm_table::number::Number;
use stiffarm_table::robot::{Angle, Convention, Joint, Robot, Value};

use crate::constants::{BEST_ROWS, FEWEST_POSES, LARGE_GAP, NEARLY_ALL_ROWS};
use crate::diagnose::{Nuisance, Options};
use crate::doubts::frames::Displaced;
use crate::doubts::{self, reach};
use crate::effects::{Catalogue, Known};
use crate::infer::{ascending, middle, percentile};
use crate::measurement::Measurements;
use crate::report::campaign::{Mistaken, Wrong};
use crate::simulate::is_stream;
use kind::{Entry, Mistake};
use rows::Rows;
pub(crate) use rows::moved;
use search::{Found, Search, Tried};

/// Part of the reach that a rad of the tool's rotation counts: a tool's own length.
const LEVER: f64 = 0.2;

/// A file without its mistakes: what the diagnosis goes on with.
pub struct Mended {
    /// The arm.
    pub arm: Arm,
    /// The measurements.
    pub data: Measurements,
    /// What the robot file says of the arm beyond its table.
    pub known: Vec<Known>,
    /// Whether the rows say enough without the mistakes; not where a reading is stuck in most of them.
    pub is_whole: bool,
    mistakes: Vec<Mistake>,
    family: Vec<Robot>,
}

/// What is wrong with an arm's file or with the measurements, if anything is.
pub fn mistaken(arm: &Arm, data: &Measurements, options: &Options) -> Option<Mistaken> {
    find(arm, data, options).map(|(mistaken, _)| mistaken)
}

/// What is wrong, if anything is, and the file without it.
pub(crate) fn find(
    arm: &Arm,
    data: &Measurements,
    options: &Options,
) -> Option<(Mistaken, Option<Mended>)> {
    let numbers = bench::numbers(data).unwrap_or(if data.kind.components()[3] { 6 } else { 3 });
    // A dozen positions, or six poses.
    let fits = is_read(data)
        && !data.sim_given.contains(&true)
        && data.poses * numbers >= 6 * FEWEST_POSES;
    let size = |row: &crate::measurement::Row| row.q.len() == arm.dof();
    let reach = reach(arm);
    if !fits || !data.rows.iter().all(size) || !reach.is_finite() || reach <= 0.0 {
        return None;
    }
    let others = options.family.iter().map(|robot| (robot, crate::robot::arm(robot)));
    let is_other = |other: &Arm| {
        let motions = |arm: &Arm| arm.joints.iter().map(|j| j.motion).collect::<Vec<_>>();
        let table = |arm: &Arm| arm.joints.iter().map(|j| [j.a, j.d, j.alpha]).collect::<Vec<_>>();
        motions(other) == motions(arm) && table(other) != table(arm)
    };
    let others: Vec<(&Robot, Arm)> =
        others.filter_map(|(robot, arm)| Some((robot, arm.ok().filter(&is_other)?))).collect();
    let family: Vec<Arm> = others.iter().map(|(_, arm)| arm.clone()).collect();
    let extent = if data.kind.is_pose() { extent(data) } else { reach };
    let mut search = Search {
        kept: BEST_ROWS,
        arm,
        rows: Rows::of(arm, data, &options.known),
        all: Mistake::all(arm, data, family.len()),
        family: &family,
        lever: LEVER * reach.min(extent),
        reach: reach.min(3.0 * extent),
        base_is_known: !options.nuisances.contains(&Nuisance::BaseFrame),
        bench: bench::numbers(data).map(|_| options),
    };
    let is_stream = data.sessions().any(is_stream);
    let mut nothing = search.tried(Vec::new())?;
    let names: Vec<&str> = others.iter().map(|(robot, _)| robot.name.as_str()).collect();
    let mut found = search.run(&nothing, is_stream);
    if matches!(found, Found::Nothing) && nothing.left.of_nearly_all > LARGE_GAP * search.reach {
        search.kept = NEARLY_ALL_ROWS;
        nothing.left.size = nothing.left.of_nearly_all;
        found = search.run(&nothing, is_stream);
        // Rows that are just wrong are left out by the diagnosis.
        if matches!(found, Found::Unexplained) {
            found = Found::Nothing;
        }
    }
    match found {
        Found::Nothing => None,
        Found::Unexplained => Some((told(&nothing, None, &[], &names, data.rows.len()), None)),
        Found::Mistakes(best, same) => {
            let best = search.polished(best);
            let mended = Mended {
                arm: search.arm_without(&best.mistakes),
                data: search.rows.mended(&best.mistakes, None),
                known: known(&best.mistakes, &options.known, &options.catalogue),
                is_whole: search.rows.are_enough(&best.mistakes),
                family: others.iter().map(|(robot, _)| (*robot).clone()).collect(),
                mistakes: best.mistakes.clone(),
            };
            Some((told(&nothing, Some(&best), &same, &names, data.rows.len()), Some(mended)))
        }
    }
}

/// Frames that stand elsewhere than the robot file says by so much that their motion is nearly all of the gap, as
/// mistakes beside those in `told`: no effect moves a base by a part of the reach. They are fitted along.
pub(crate) fn displaced(
    arm: &Arm,
    data: &Measurements,
    options: &Options,
    told: Option<Mistaken>,
) -> Option<(Mistaken, Vec<Nuisance>)> {
    let Displaced { frames, gap: position } =
        doubts::frames::displaced(arm, data, &options.known, &options.nuisances)?;
    let mut mistaken = told.unwrap_or(Mistaken {
        mistakes: Vec::new(),
        same: Vec::new(),
        position,
        rotation: [0.0; 2],
    });
    mistaken.mistakes.extend(frames.iter().map(|(frame, moved, turned)| {
        let (moved, degrees) = (1e3 * moved, turned.to_degrees());
        let (place, sentence) = match frame {
            Nuisance::BaseFrame => {
                let turned = format!(", turned by {degrees:.1}°");
                let turned = if degrees < 0.05 { "" } else { &turned };
                (
                    "base",
                    format!(
                        "the base stands {moved:.1} mm from where the robot file has it{turned}"
                    ),
                )
            }
            Nuisance::ToolFrame => (
                "tool",
                format!("the measured point is {moved:.1} mm from where the robot file has it"),
            ),
        };
        Wrong {
            kind: "unknown_frame".into(),
            place: place.to_owned(),
            sentence,
            mending: format!("it is fitted along, as by --nuisance {}", frame.identifier()),
            in_robot_file: false,
        }
    }));
    Some((mistaken, frames.into_iter().map(|(frame, ..)| frame).collect()))
}

/// Whether mistakes are looked for in what such a file has.
fn is_read(data: &Measurements) -> bool {
    data.kind.is_pose() || bench::numbers(data).is_some()
}

/// Half of the space in which three quarters of the measured points are, m.
fn extent(data: &Measurements) -> f64 {
    let spread = |axis: usize| {
        let all = ascending(data.rows.iter().map(|row| row.measured[axis]));
        let at = |part: f64| percentile(&all, part);
        at(0.875) - at(0.125)
    };
    // One coordinate may be in another unit, whatever it says.
    middle([0, 1, 2].map(spread)).unwrap_or_default().max(1e-3)
}

fn told(
    nothing: &Tried,
    best: Option<&Tried>,
    same: &[Tried],
    family: &[&str],
    rows: usize,
) -> Mistaken {
    let wrong = |mistake: &Mistake| Wrong {
        kind: mistake.kind().into(),
        place: mistake.place(),
        sentence: mistake.sentence(family, rows),
        mending: mistake.mending(),
        in_robot_file: mistake.is_of_robot(),
    };
    let mistakes = best.map_or_else(Vec::new, |best| best.mistakes.iter().map(wrong).collect());
    let after = best.unwrap_or(nothing).left;
    Mistaken {
        mistakes,
        same: same.iter().map(|tried| tried.mistakes.iter().map(wrong).collect()).collect(),
        position: [nothing.left.position, after.position],
        rotation: [nothing.left.rotation, after.rotation],
    }
}

/// The effects of a robot file with those that hold what joints do beside their readings.
fn known(mistakes: &[Mistake], known: &[Known], catalogue: &Catalogue) -> Vec<Known> {
    let mut known = known.to_vec();
    for mistake in mistakes {
        let (joint, of, ratio) = match *mistake {
            Mistake::Sign { joint } => (joint, joint, -2.0),
            Mistake::Coupling { joint, of, ratio } | Mistake::Geared { joint, of, ratio } => {
                (joint, of, ratio)
            }
            _ => continue,
        };
        let Some((effect, spot)) =
            catalogue.iter().find_map(|effect| Some((effect, effect.turns_with(joint, of)?)))
        else {
            continue;
        };
        match known.iter_mut().find(|known| known.effect == effect && known.spot == spot) {
            Some(known) => known.values[0] += ratio,
            None => known.push(Known {
                effect,
                spot,
                values: vec![ratio],
                session: None,
                at: stiffarm_table::robot::Spot::default(),
            }),
        }
    }
    known
}

impl Mended {
    /// Another file of the arm, its readings mended as those were; `None` if nothing is wrong with them. Where a
    /// reading is stuck says nothing of another file.
    pub fn readings(&self, other: &Measurements) -> Option<Measurements> {
        let again: Vec<Mistake> = self
            .mistakes
            .iter()
            .filter(|mistake| !mistake.is_of_robot() && !mistake.is_stuck())
            .copied()
            .collect();
        let fits = is_read(other) && other.rows.iter().all(|r| r.q.len() == self.arm.dof());
        (fits && !again.is_empty()).then(|| Rows::of(&self.arm, other, &[]).mended(&again, None))
    }

    /// The robot file without the mistakes that its table has.
    pub fn robot(&self, robot: &Robot) -> Robot {
        let mut robot = robot.clone();
        for mistake in &self.mistakes {
            match *mistake {
                Mistake::Other(k) => {
                    let other = self.family[k].clone();
                    robot = Robot {
                        name: other.name,
                        joints: other.joints,
                        convention: other.convention,
                        ..robot
                    };
                }
                Mistake::Convention => {
                    robot.convention = match robot.convention {
                        Convention::Standard => Convention::Modified,
                        Convention::Modified => Convention::Standard,
                    }
                }
                Mistake::Entry { row, .. }
                | Mistake::TwistSign { row }
                | Mistake::Twist { row, .. }
                | Mistake::Zero { joint: row, .. }
                | Mistake::Off { row, .. } => entries(&mut robot.joints[row], mistake),
                _ => {}
            }
        }
        robot
    }
}

/// Changes the entries of a row as a mistake's mending changes the arm's.
fn entries(joint: &mut Joint, mistake: &Mistake) {
    let moved = |value: &mut Value, to: &dyn Fn(f64) -> f64| {
        if let Value::Number(number) = value {
            *number = Number::rounded(to(number.to_f64()));
        }
    };
    let turned = |angle: &mut Angle, to: &dyn Fn(f64) -> f64| {
        let to = angle.radians().map(to);
        *angle = to.and_then(Angle::from_radians).unwrap_or_else(|| angle.clone());
    };
    match *mistake {
        Mistake::Entry { entry: Entry::A, factor, .. } => moved(&mut joint.a, &|x| factor * x),
        Mistake::Entry { entry: Entry::D, factor, .. } => moved(&mut joint.d, &|x| factor * x),
        Mistake::Off { entry: Entry::A, by, .. } => moved(&mut joint.a, &|x| x + by),
        Mistake::Off { entry: Entry::D, by, .. } => moved(&mut joint.d, &|x| x + by),
        Mistake::Off { entry: Entry::Theta, by, .. } => turned(&mut joint.theta, &|x| x + by),
        Mistake::Off { entry: Entry::Alpha, by, .. } => turned(&mut joint.alpha, &|x| x + by),
        Mistake::Entry { entry: Entry::Theta, factor, .. } => {
            turned(&mut joint.theta, &|x| factor * x);
        }
        Mistake::Entry { entry: Entry::Alpha, factor, .. } => {
            turned(&mut joint.alpha, &|x| factor * x);
        }
        Mistake::TwistSign { .. } => turned(&mut joint.alpha, &|x| -x),
        Mistake::Twist { by, .. } => {
            turned(&mut joint.alpha, &|x| x + kind::DEGREE * f64::from(by));
        }
        Mistake::Zero { by, .. } => turned(&mut joint.theta, &|x| x + kind::DEGREE * f64::from(by)),
        _ => {}
    }
}
