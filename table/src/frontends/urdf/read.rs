//! Reads a URDF: every number and element that a chain is made of is looked at where it stands.

use core::ops::Range;

use roxmltree::{Document, Node};

use super::angle::meant;
use super::document::{Element, Elements, Kind};
use super::refusal::{Place, Refusal};

/// A URDF that was read.
pub struct Urdf {
    /// Its links and joints.
    pub robot: Elements,
    /// Rounded multiples of π among its angles: joint, as written, as read.
    pub rounded: Vec<(String, f64, f64)>,
}

/// The attributes that hold numbers, and how many.
const VECTORS: [(&str, &str, usize); 4] =
    [("origin", "xyz", 3), ("origin", "rpy", 3), ("axis", "xyz", 3), ("mass", "value", 1)];

/// Reads a URDF. Unless `as_written`, an angle that is a rounding of a simple multiple of π is read
/// as that multiple.
///
/// # Errors
/// [`Refusal`]: what is no URDF, and numbers that are none.
pub fn read(text: &str, as_written: bool) -> Result<Urdf, Refusal> {
    let document = Document::parse(text).map_err(|error| {
        let at = error.pos();
        let place = byte(text, at.row, at.col).map_or(Place::File, Place::Bytes);
        Refusal::new(format!("this is no XML: {error}"), place)
    })?;
    let root = document.root_element();
    if root.tag_name().name() != "robot" {
        let found = root.tag_name().name();
        let message = format!("found the element <{found}>, expected <robot>, the root of a URDF");
        return Err(Refusal::new(message, Place::Bytes(head(text, root))));
    }
    if let Some(node) = root.descendants().find(|n| n.tag_name().namespace().is_some_and(is_xacro))
    {
        let message = "found a xacro element, expected a URDF: macros are not expanded here";
        let help = "run `xacro FILE > arm.urdf` and import what it writes";
        return Err(Refusal::new(message, Place::Bytes(head(text, node))).help(help));
    }
    spelling(text, root)?;
    let robot = Element::new(root, text).elements()?;
    let mut urdf = Urdf { robot, rounded: Vec::new() };
    if !as_written {
        urdf.round();
    }
    Ok(urdf)
}

/// Whether a namespace is that of ROS's macro language, of which there are several spellings.
fn is_xacro(namespace: &str) -> bool {
    namespace.contains("xacro")
}

impl Urdf {
    fn round(&mut self) {
        for joint in &mut self.robot.joints {
            for angle in joint.origin.rpy.iter_mut() {
                if let Some(exact) = meant(*angle).filter(|exact| exact != angle) {
                    // The same angle to the last digits is no rounding that anyone needs to know.
                    if (*angle - exact).abs() > 1e-15 * exact.abs() {
                        self.rounded.push((joint.name.clone(), *angle, exact));
                    }
                    *angle = exact;
                }
            }
            if joint.kind == Kind::Revolute {
                joint.limits = joint.limits.map(|bound| meant(bound).unwrap_or(bound));
            }
        }
    }
}

/// Refuses words that are no numbers, and quaternions, which other readers take for roll, pitch and
/// yaw with an error of up to 0.3° near the gimbal lock.
fn spelling(text: &str, root: Node<'_, '_>) -> Result<(), Refusal> {
    for node in root.descendants().filter(Node::is_element) {
        let name = node.tag_name().name();
        for (_, attribute, count) in VECTORS.iter().filter(|(element, ..)| *element == name) {
            let Some(found) = node.attribute(*attribute) else { continue };
            let numbers = found.split_whitespace().map(str::parse::<f64>);
            let numbers: Option<Vec<f64>> =
                numbers.map(|x| x.ok().filter(|x| x.is_finite())).collect();
            if numbers.is_none_or(|numbers| numbers.len() != *count) {
                let expected =
                    if *count == 1 { "a number".to_owned() } else { format!("{count} numbers") };
                let message = format!("{attribute}: found `{found}`, expected {expected}");
                return Err(Refusal::new(message, Place::Bytes(head(text, node))));
            }
        }
        if name == "origin" && node.has_attribute("quat_xyzw") {
            let message = "found quat_xyzw, expected rpy: roll, pitch and yaw in radians";
            let help = "a quaternion is read to no more than 0.3° where its pitch is near ±90°";
            let place = Place::Bytes(head(text, node));
            return Err(Refusal::new(message, place).help(help));
        }
    }
    Ok(())
}

/// Where a place is in the text, if it is there.
pub fn bytes(text: &str, place: &Place) -> Option<Range<usize>> {
    let (tag, name) = match place {
        Place::File => return None,
        Place::Bytes(range) => return Some(range.clone()),
        Place::Joint(name) => ("joint", name),
        Place::Link(name) => ("link", name),
    };
    let document = Document::parse(text).ok()?;
    let mut elements = document.root_element().children();
    let found = elements.find(|n| n.has_tag_name(tag) && n.attribute("name") == Some(name))?;
    Some(head(text, found))
}

/// The first tag of an element.
pub fn head(text: &str, node: Node<'_, '_>) -> Range<usize> {
    let whole = node.range();
    let tag = text[whole.clone()].find('>').map_or(whole.end, |at| whole.start + at + 1);
    whole.start..tag
}

/// One character at a line and column, from 1.
fn byte(text: &str, row: u32, column: u32) -> Option<Range<usize>> {
    let line = usize::try_from(row).ok()?.checked_sub(1)?;
    let start: usize = text.split_inclusive('\n').take(line).map(str::len).sum();
    let within = text.get(start..)?;
    let skip = usize::try_from(column).ok()?.checked_sub(1)?;
    let (offset, c) = within.char_indices().nth(skip)?;
    Some(start + offset..start + offset + c.len_utf8())
}
