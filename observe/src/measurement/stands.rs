//! Of which frames measurements are told: where the arm stands, and where what is seen of it sits on the tool.
//!
//! Beside the arm there is one frame in each session, of a tracker say; of cameras one for each camera there, and of cameras on
//! the tool one for each board that they see. On the tool, of every board and of every camera one.

use nalgebra::Isometry3;

use super::Measurements;

/// Which camera shows what.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sight {
    /// Its name, as far as there is one.
    pub camera: String,
    /// The name of the board, as far as there is one.
    pub board: String,
    /// Whether the camera is on the tool, and what it sees beside the arm.
    pub is_on_tool: bool,
    /// Whether it sees a board: else a marker of the robot file.
    pub has_board: bool,
    /// Where what is on the tool is taken to sit in the tool frame by whoever simulates it.
    pub at: Isometry3<f64>,
    /// In its axes, where the first camera's or board's beside the arm are taken to be; identity of the first itself.
    pub first: Isometry3<f64>,
}

impl Sight {
    /// What is beside the arm.
    fn beside(&self) -> &str {
        if self.is_on_tool { &self.board } else { &self.camera }
    }

    /// What is on the tool, in a place of its own.
    pub fn mounted(&self) -> Option<&str> {
        let mounted = if self.is_on_tool { &self.camera } else { &self.board };
        self.has_board.then_some(mounted)
    }
}

/// Where an arm stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Base {
    /// The session; empty where the file has no column.
    pub session: String,
    /// What is beside the arm and has a name.
    pub beside: String,
}

/// All frames of measurements.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Stands {
    /// At least one where there are rows.
    pub bases: Vec<Base>,
    /// Which of them a row is told in.
    pub base_of: Vec<usize>,
    /// The names of what is on the tool in a place of its own.
    pub mounts: Vec<String>,
    /// Which of them a row sees, or sees by.
    pub mount_of: Vec<Option<usize>>,
}

impl Stands {
    /// The bases and mounts that the rows of `data` are told in.
    pub fn of(data: &Measurements) -> Stands {
        let mut stands = Stands::default();
        for rows in data.sessions() {
            // What no camera sees is told where the first one has the arm.
            let (begin, first) =
                (stands.base_of.len(), rows.iter().find_map(|row| row.camera.as_deref()));
            for row in rows {
                let sight = row.camera.as_deref().or(first);
                let number = match stands.base_of.len().checked_sub(1) {
                    // Of what no camera sees there are many rows, and one base.
                    Some(last) if first.is_none() && last >= begin => stands.base_of[last],
                    _ => {
                        let session = row.session.clone().unwrap_or_default();
                        let beside = sight.map_or("", Sight::beside).to_owned();
                        number_of(&mut stands.bases, Base { session, beside })
                    }
                };
                stands.base_of.push(number);
                let mounted = row.camera.as_deref().and_then(Sight::mounted);
                let mount = mounted.map(|name| number_of(&mut stands.mounts, name.to_owned()));
                stands.mount_of.push(mount);
            }
        }
        stands
    }

    /// What a base is called where there are several: by its session, and by what is beside it where that says more.
    pub fn base(&self, number: usize) -> Option<String> {
        let Base { session, beside } = &self.bases[number];
        let is_alone = self.bases.iter().filter(|base| base.session == *session).count() == 1;
        let name = match (is_alone, session.is_empty()) {
            (true, _) => session.clone(),
            (false, true) => beside.clone(),
            (false, false) => format!("{}: {beside}", session.trim_end_matches(':')),
        };
        (self.bases.len() > 1).then_some(name)
    }

    /// What a place on the tool is called where there are several.
    pub fn mount(&self, number: usize) -> Option<String> {
        self.mounts.get(number).filter(|_| self.mounts.len() > 1).cloned()
    }
}

/// The number of an entry, which is put in if it is new.
pub fn number_of<T: PartialEq>(all: &mut Vec<T>, one: T) -> usize {
    all.iter().position(|known| *known == one).unwrap_or_else(|| {
        all.push(one);
        all.len() - 1
    })
}
