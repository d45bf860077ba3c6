//! The elements of a URDF that a serial chain is made of.

use core::str::FromStr;

use roxmltree::Node;

use super::refusal::{Place, Refusal};
use crate::robot::space::Vector;

/// What a `<robot>` holds of kinematics and masses.
#[derive(Clone, Debug)]
pub struct Elements {
    /// Its name, which may be missing.
    pub name: String,
    /// As they stand.
    pub links: Vec<Link>,
    /// As they stand.
    pub joints: Vec<Joint>,
}

/// A `<link>`.
#[derive(Clone, Debug)]
pub struct Link {
    pub name: String,
    /// kg.
    pub mass: f64,
    /// Of its mass.
    pub centre: Origin,
    /// xx, xy, xz, yy, yz, zz about that centre in the axes of its origin, kg·m².
    pub inertia: [f64; 6],
}

/// A `<joint>`.
#[derive(Clone, Debug)]
pub struct Joint {
    pub name: String,
    pub kind: Kind,
    pub origin: Origin,
    pub parent: String,
    pub child: String,
    /// Not yet of length 1.
    pub axis: Vector,
    /// Lower and upper, rad or m.
    pub limits: [f64; 2],
    /// Viscous and dry friction.
    pub friction: [f64; 2],
    /// The joint that it follows.
    pub mimic: Option<String>,
}

/// An `<origin>`: m, and roll, pitch and yaw in rad.
#[derive(Clone, Copy, Debug, Default)]
pub struct Origin {
    pub xyz: Vector,
    pub rpy: Vector,
}

/// The types of joints.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Revolute,
    Continuous,
    Prismatic,
    Fixed,
    Floating,
    Planar,
    Spherical,
}

impl FromStr for Kind {
    type Err = ();

    fn from_str(text: &str) -> Result<Kind, ()> {
        Ok(match text {
            "revolute" => Kind::Revolute,
            "continuous" => Kind::Continuous,
            "prismatic" => Kind::Prismatic,
            "fixed" => Kind::Fixed,
            "floating" => Kind::Floating,
            "planar" => Kind::Planar,
            "spherical" => Kind::Spherical,
            _ => return Err(()),
        })
    }
}

/// The element of a node, and where it stands in the file.
#[derive(Clone, Copy)]
pub struct Element<'a> {
    node: Node<'a, 'a>,
    text: &'a str,
}

impl<'a> Element<'a> {
    pub fn new(node: Node<'a, 'a>, text: &'a str) -> Element<'a> {
        Element { node, text }
    }

    /// Its tag, and its name if it has one.
    fn said(self) -> String {
        let tag = self.node.tag_name().name();
        let name = self.node.attribute("name");
        name.map_or_else(|| format!("<{tag}>"), |name| format!("{tag} `{}`", name.escape_debug()))
    }

    fn refused(self, what: &str) -> Refusal {
        let help = "a joint has name, type, parent and child; a limit has effort and velocity; an \
                    inertial has mass and inertia";
        let message = format!("this is no URDF: {} {what}", self.said());
        Refusal::new(message, Place::Bytes(super::read::head(self.text, self.node))).help(help)
    }

    fn attribute(self, name: &str) -> Result<&'a str, Refusal> {
        self.node.attribute(name).ok_or_else(|| self.refused(&format!("has no {name}")))
    }

    /// A name: one line, as a robot file has it.
    fn name(self) -> Result<String, Refusal> {
        let found = self.attribute("name")?;
        if found.chars().any(char::is_control) {
            return Err(self.refused("has a control character in its name, expected none"));
        }
        Ok(found.to_owned())
    }

    /// The same of what is told from others by it.
    fn own_name(self) -> Result<String, Refusal> {
        let found = self.name()?;
        if found.trim().is_empty() { Err(self.refused("has an empty name")) } else { Ok(found) }
    }

    /// A finite number.
    fn number(self, name: &str) -> Result<f64, Refusal> {
        let found = self.attribute(name)?;
        found
            .trim()
            .parse::<f64>()
            .ok()
            .filter(|x| !x.is_nan())
            .ok_or_else(|| self.refused(&format!("has {name}=\"{found}\", expected a number")))
    }

    /// Three numbers, or those of a missing attribute; their spelling was looked at before.
    fn vector(self, name: &str, missing: Vector) -> Vector {
        let Some(found) = self.node.attribute(name) else { return missing };
        let mut numbers = found.split_whitespace().map(|x| x.parse().unwrap_or(f64::NAN));
        core::array::from_fn(|_| numbers.next().unwrap_or(f64::NAN))
    }

    fn children(self, tag: &'a str) -> impl Iterator<Item = Element<'a>> {
        let text = self.text;
        let nodes = self.node.children().filter(move |n| n.has_tag_name(tag));
        nodes.map(move |node| Element { node, text })
    }

    /// The one child of a kind.
    fn child(self, tag: &'a str) -> Result<Option<Element<'a>>, Refusal> {
        let mut all = self.children(tag);
        let first = all.next();
        match all.next() {
            None => Ok(first),
            Some(second) => Err(second.refused(&format!("stands twice in {}", self.said()))),
        }
    }

    fn needed(self, tag: &'a str) -> Result<Element<'a>, Refusal> {
        self.child(tag)?.ok_or_else(|| self.refused(&format!("has no <{tag}>")))
    }

    fn origin(self) -> Result<Origin, Refusal> {
        let origin = self.child("origin")?;
        Ok(origin.map_or_else(Origin::default, |origin| Origin {
            xyz: origin.vector("xyz", [0.0; 3]),
            rpy: origin.vector("rpy", [0.0; 3]),
        }))
    }

    /// What a `<robot>` holds.
    ///
    /// # Errors
    /// [`Refusal`] at what is missing.
    pub fn elements(self) -> Result<Elements, Refusal> {
        // Before version 1.2 a limit must have a velocity; since then what is missing is unlimited.
        let version = self.node.attribute("version").and_then(|v| v.trim().parse::<f64>().ok());
        let unlimited = version.is_some_and(|version| version >= 1.2);
        Ok(Elements {
            name: match self.node.has_attribute("name") {
                true => self.name()?,
                false => String::new(),
            },
            links: self.children("link").map(Element::link).collect::<Result<_, _>>()?,
            joints: self
                .children("joint")
                .map(|joint| joint.joint(unlimited))
                .collect::<Result<_, _>>()?,
        })
    }

    fn link(self) -> Result<Link, Refusal> {
        let name = self.own_name()?;
        let Some(inertial) = self.child("inertial")? else {
            return Ok(Link { name, mass: 0.0, centre: Origin::default(), inertia: [0.0; 6] });
        };
        let tensor = inertial.needed("inertia")?;
        let mut inertia = [0.0; 6];
        for (entry, name) in inertia.iter_mut().zip(["ixx", "ixy", "ixz", "iyy", "iyz", "izz"]) {
            *entry = tensor.number(name)?;
        }
        let mass = inertial.needed("mass")?.number("value")?;
        Ok(Link { name, mass, centre: inertial.origin()?, inertia })
    }

    fn joint(self, unlimited: bool) -> Result<Joint, Refusal> {
        let kind = self.attribute("type")?;
        let kind = kind.parse().map_err(|()| {
            let each = "revolute, continuous, prismatic, fixed, floating, planar or spherical";
            self.refused(&format!("has type=\"{kind}\", expected {each}"))
        })?;
        let link = |role| self.needed(role)?.attribute("link").map(str::to_owned);
        let mimic = self.child("mimic")?.map(|m| m.attribute("joint")).transpose()?;
        Ok(Joint {
            name: self.own_name()?,
            kind,
            origin: self.origin()?,
            parent: link("parent")?,
            child: link("child")?,
            axis: self.child("axis")?.map_or([1.0, 0.0, 0.0], |a| a.vector("xyz", [1.0, 0.0, 0.0])),
            limits: self.child("limit")?.map_or(Ok([0.0; 2]), |l| l.limits(unlimited))?,
            friction: self.child("dynamics")?.map_or(Ok([0.0; 2]), Element::friction)?,
            mimic: mimic.map(str::to_owned),
        })
    }

    fn friction(self) -> Result<[f64; 2], Refusal> {
        let mut found = [0.0; 2];
        for (entry, name) in found.iter_mut().zip(["damping", "friction"]) {
            if self.node.attribute(name).is_some() {
                *entry = self.number(name)?;
            }
            if *entry < 0.0 {
                return Err(self.refused(&format!("has its {name} below zero")));
            }
        }
        Ok(found)
    }

    fn limits(self, unlimited: bool) -> Result<[f64; 2], Refusal> {
        let or = |name, missing: f64| match self.node.attribute(name) {
            None => Ok(missing),
            Some(_) => self.number(name),
        };
        or("effort", 0.0)?;
        if !unlimited {
            self.number("velocity")?;
        }
        let none = if unlimited { f64::INFINITY } else { 0.0 };
        let [lower, upper] = [or("lower", -none)?, or("upper", none)?];
        if unlimited && upper < lower {
            return Err(self.refused("has its upper bound below its lower one"));
        }
        Ok([lower, upper])
    }
}
