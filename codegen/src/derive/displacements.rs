//! Which displacements of a flexible chain stay in its closed form.

/// Names of a displacement's components: `δx δy δz dψ dβ dφ`.
pub const COMPONENTS: [&str; 6] = ["dx", "dy", "dz", "dpsi", "dbeta", "dphi"];

/// Which components of which displacements stay in the closed form; the others are zero.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Displacements(Vec<[bool; 6]>);

impl Displacements {
    /// All six at every place of an arm with `dof` joints.
    pub fn all(dof: usize) -> Self {
        Displacements(vec![[true; 6]; dof + 2])
    }

    /// A list such as `dx,dy,dphi` (at every link) or `dphi1,dx2` (at place 1, at place 2).
    ///
    /// # Errors
    /// What in the list is no displacement of an arm with `dof` joints.
    pub fn read(list: &str, dof: usize) -> Result<Self, String> {
        let mut kept = vec![[false; 6]; dof + 2];
        for word in list.split(',').map(str::trim) {
            let (name, place) =
                word.split_at(word.find(|c: char| c.is_ascii_digit()).unwrap_or(word.len()));
            let component = COMPONENTS.iter().position(|known| *known == name);
            let places = match place {
                "" => Some(1..=dof),
                place => place.parse().ok().filter(|k| *k <= dof + 1).map(|k| k..=k),
            };
            let (Some(component), Some(places)) = (component, places) else {
                return Err(format!(
                    "`{word}` is no displacement: write one of {}, for every link, or with a place \
                     from 0 (the base) to {} (the tool), like dphi1",
                    COMPONENTS.join(", "),
                    dof + 1
                ));
            };
            places.for_each(|place| kept[place][component] = true);
        }
        Ok(Displacements(kept))
    }

    /// Whether a component at a place stays symbolic.
    pub fn has(&self, place: usize, component: usize) -> bool {
        self.0.get(place).is_some_and(|kept| kept[component])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_displacement_is_named() {
        let kept = Displacements::read("dx,dphi0", 2).unwrap();
        assert!(kept.has(1, 0) && kept.has(2, 0) && !kept.has(0, 0) && kept.has(0, 5));
        for wrong in ["", "x", "dx4", "dphi-1", "dx1 dy1"] {
            let message = Displacements::read(wrong, 2).unwrap_err();
            assert!(message.contains("dphi1") && message.contains(wrong), "{message}");
        }
    }
}
