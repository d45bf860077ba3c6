//! Where the frames and tools of a program's points are.

use nalgebra::Isometry3;
use stiffarm_compensate::program::{DEFAULT, Language, Place, Point, Program};

use super::program::remark;
use crate::host::Host;
use crate::terminal::failure::Failure;

/// A frame in the robot's base, and a tool on the flange or the robot files' own.
pub(super) type FrameAndTool = (Isometry3<f64>, Option<Isometry3<f64>>);

/// A name and what was given for it; whether a point has asked for it.
struct Named {
    name: String,
    /// `None` for the robot files' own.
    pose: Option<Isometry3<f64>>,
    asked: bool,
}

/// Frame and tool of each point.
pub(super) fn places(
    program: &Program,
    (frames, tools): (&[String], &[String]),
    host: &Host,
) -> Result<Vec<FrameAndTool>, Failure> {
    let mut frames = given("--frame", frames, program.language)?;
    let mut tools = given("--tool", tools, program.language)?;
    let (mut places, mut remarks, mut own) = (Vec::new(), Vec::new(), false);
    for point in &program.points {
        let frame = placed(&point.frame, &mut frames);
        let tool = placed(&point.tool, &mut tools);
        let default = matches!(&point.tool, Place::Named(name) if name == DEFAULT);
        own |= tool.is_none() && default;
        let tool = tool.or(default.then_some(None));
        let is_pose = point.is_pose();
        if is_pose {
            remarks.extend(frame.is_none().then_some(("frame", point, &point.frame)));
            remarks.extend(tool.is_none().then_some(("tool", point, &point.tool)));
        }
        places.push((frame.flatten().unwrap_or_default(), tool.flatten()));
    }
    if !remarks.is_empty() {
        return Err(undefined(program, &remarks));
    }
    for (option, all) in [("--frame", &frames), ("--tool", &tools)] {
        if let Some(unused) = all.iter().find(|named| !named.asked) {
            let name = &unused.name;
            let message = format!("{option} {name}: no point of the program asks for it");
            return Err(Failure::with_help(message, "leave it out, or check its name"));
        }
    }
    if own {
        host.note("where the program names no tool, its tool is the [tool] of the robot files");
    }
    Ok(places)
}

/// NAME=POSE of each option.
fn given(option: &str, texts: &[String], language: Language) -> Result<Vec<Named>, Failure> {
    let each = texts.iter().map(|text| {
        let parts = text.split_once('=').map(|(name, pose)| (name.trim(), pose.trim()));
        let pose = match parts {
            Some((_, "robot")) if option == "--tool" => Some(None),
            Some((_, pose)) => language.pose(pose).map(Some),
            None => None,
        };
        let (Some((name, _)), Some(pose)) = (parts, pose) else {
            let message = format!("{option}: found `{text}`, expected NAME=POSE");
            return Err(Failure::with_help(
                message,
                format!("a pose is {}", language.pose_format()),
            ));
        };
        Ok(Named { name: name.to_lowercase(), pose, asked: false })
    });
    each.collect()
}

/// Where that is: as the option says, else as the program; `None` if neither does.
fn placed(place: &Place, given: &mut [Named]) -> Option<Option<Isometry3<f64>>> {
    match place {
        Place::Is(pose) => Some(Some(*pose)),
        Place::Named(name) => {
            let name = name.to_lowercase();
            let named = given.iter_mut().find(|named| named.name == name)?;
            named.asked = true;
            Some(named.pose)
        }
    }
}

/// The frames and tools that nothing defines, each at the first point that asks for it.
fn undefined(program: &Program, remarks: &[(&str, &Point, &Place)]) -> Failure {
    let mut told: Vec<(&str, &Place)> = Vec::new();
    let mut all = Vec::new();
    for (what, point, place) in remarks {
        let Place::Named(name) = place else { continue };
        if told.contains(&(what, place)) {
            continue;
        }
        told.push((what, place));
        let which = match name.as_str() {
            DEFAULT => format!("a {what} that the program does not say"),
            name => format!("the {what} {name}, which the program does not define"),
        };
        let message = format!("{} stands in {which}", point.name);
        let message = if *what == "tool" {
            message.replace(" stands in ", " is a pose of ")
        } else {
            message
        };
        let help = format!("give it: --{what} {name}=POSE, {}", program.language.pose_format());
        all.push(remark(&program.files[point.file], &point.span, &message, &help));
    }
    Failure::File(all)
}
