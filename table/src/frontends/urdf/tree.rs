//! Links and joints as a tree, and the way from a base link to a tip link.

use std::collections::{HashMap, HashSet};

use super::document::{Elements, Joint, Kind, Link};
use super::refusal::{Place, Refusal};

/// Links by their names, each with the joint above it and the joints below.
pub struct Tree<'a> {
    robot: &'a Elements,
    above: HashMap<&'a str, &'a Joint>,
    below: HashMap<&'a str, Vec<&'a Joint>>,
}

/// Whether a joint moves at all.
pub fn moves(joint: &Joint) -> bool {
    !matches!(joint.kind, Kind::Fixed)
}

impl<'a> Tree<'a> {
    /// Of a URDF.
    ///
    /// # Errors
    /// [`Refusal`]: names that stand twice or nowhere, a link with two parents, a loop.
    pub fn new(robot: &'a Elements) -> Result<Tree<'a>, Refusal> {
        let mut below: HashMap<&str, Vec<&Joint>> = HashMap::new();
        for link in &robot.links {
            if below.insert(&link.name, Vec::new()).is_some() {
                let message = format!("two links are called `{}`", link.name);
                return Err(Refusal::new(message, Place::Link(link.name.clone())));
            }
        }
        let mut above: HashMap<&str, &Joint> = HashMap::new();
        let mut names = HashSet::new();
        for joint in &robot.joints {
            let at = || Place::Joint(joint.name.clone());
            if !names.insert(&joint.name) {
                return Err(Refusal::new(format!("two joints are called `{}`", joint.name), at()));
            }
            let (parent, child) = (joint.parent.as_str(), joint.child.as_str());
            for (role, name) in [("parent", parent), ("child", child)] {
                if !below.contains_key(name) {
                    let message = format!(
                        "joint `{}`: its {role} is `{name}`, expected a link of the file",
                        joint.name
                    );
                    return Err(Refusal::new(message, at()));
                }
            }
            if let Some(other) = above.insert(child, joint) {
                let message = format!(
                    "link `{child}` hangs on two joints, `{}` and `{}`: expected an open chain",
                    other.name, joint.name
                );
                return Err(Refusal::new(message, at()));
            }
            below.entry(parent).or_default().push(joint);
        }
        let tree = Tree { robot, above, below };
        tree.refuse_loops()?;
        Ok(tree)
    }

    fn refuse_loops(&self) -> Result<(), Refusal> {
        for link in &self.robot.links {
            let mut at = link.name.as_str();
            for _ in 0..=self.robot.joints.len() {
                match self.above.get(at) {
                    Some(joint) => at = &joint.parent,
                    None => break,
                }
            }
            if let Some(joint) = self.above.get(at) {
                let message = format!("joint `{}` closes a loop: expected a tree", joint.name);
                return Err(Refusal::new(message, Place::Joint(joint.name.clone())));
            }
        }
        Ok(())
    }

    /// The joints that hang on a link.
    pub fn below(&self, link: &str) -> &[&'a Joint] {
        self.below.get(link).map_or(&[], Vec::as_slice)
    }

    /// The link of that name.
    pub fn link(&self, name: &str) -> Option<&'a Link> {
        self.robot.links.iter().find(|link| link.name == name)
    }

    /// The root link.
    ///
    /// # Errors
    /// [`Refusal`] if there is not exactly one.
    pub fn root(&self) -> Result<&'a str, Refusal> {
        let roots = self.robot.links.iter().map(|link| link.name.as_str());
        let roots: Vec<&str> = roots.filter(|name| !self.above.contains_key(name)).collect();
        match roots[..] {
            [root] => Ok(root),
            [] => Err(Refusal::new("found no links, expected a chain of links", Place::File)),
            _ => {
                let message = format!("found {} root links, expected one", roots.len());
                let help = format!("choose one with --base: {}", roots.join(", "));
                Err(Refusal::new(message, Place::File).help(help))
            }
        }
    }

    /// The way from `base` to `tip`, base first.
    ///
    /// # Errors
    /// [`Refusal`] if the tip does not hang on the base.
    pub fn path(&self, base: &str, tip: &str) -> Result<Vec<&'a Joint>, Refusal> {
        for (option, name) in [("--base", base), ("--tip", tip)] {
            if self.link(name).is_none() {
                let known = self.robot.links.iter().map(|l| l.name.as_str()).collect::<Vec<_>>();
                let message = format!("{option}: found no link `{name}` in the file");
                let help = format!("its links are {}", known.join(", "));
                return Err(Refusal::new(message, Place::File).help(help));
            }
        }
        let mut path = Vec::new();
        let mut at = tip;
        while at != base {
            let Some(joint) = self.above.get(at) else {
                let message = format!("link `{tip}` does not hang on link `{base}`");
                let help = "--tip must be farther from the root than --base";
                return Err(Refusal::new(message, Place::Link(tip.to_owned())).help(help));
            };
            path.push(*joint);
            at = &joint.parent;
        }
        path.reverse();
        Ok(path)
    }

    /// The tip below `base`, if there is only one.
    ///
    /// # Errors
    /// [`Refusal`] lists the candidates, those with the most joints first.
    pub fn only_tip(&self, base: &str) -> Result<&'a str, Refusal> {
        let leaves = self.robot.links.iter().map(|link| link.name.as_str());
        let leaves = leaves.filter(|name| self.below(name).is_empty());
        let mut tips: Vec<(usize, &str)> = leaves
            .filter_map(|leaf| {
                let path = self.path(base, leaf).ok()?;
                Some((path.iter().filter(|joint| moves(joint)).count(), leaf))
            })
            .collect();
        tips.sort_by_key(|(joints, _)| core::cmp::Reverse(*joints));
        match tips[..] {
            [(_, tip)] => Ok(tip),
            _ => {
                let each = tips.iter().map(|(n, tip)| format!("{tip} ({n} moving)"));
                let message = format!("the tree below `{base}` ends in {} links", tips.len());
                let list = each.collect::<Vec<_>>().join(", ");
                let help = format!("choose the tip with --tip: {list}");
                Err(Refusal::new(message, Place::File).help(help))
            }
        }
    }
}
