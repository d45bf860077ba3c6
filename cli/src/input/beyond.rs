//! What a robot file says beyond its table, as commands take it: read, honoured, or refused.

use stiffarm_codegen::robot::beyond::EffectError;
use stiffarm_codegen::robot::{Effect, Located, Robot, Spot};
use stiffarm_document::text::words;
use stiffarm_gap::corrected::{FoldError, folded};
use stiffarm_gap::effects::{Catalogue, Depends, Known};
use stiffarm_gap::log::known::{is_of_motion, is_of_torques};
use stiffarm_gap::whole::{Situation, Whole};
use stiffarm_kernels::generic::Arm;
use stiffarm_kernels::{Input, Output};

use super::source::Source;
use crate::terminal::failure::{Failure, Remark};

impl Source {
    /// The robot as kernels are made of it: its effects compiled.
    ///
    /// # Errors
    /// [`Failure`] names each effect of which none can be made, where it stands.
    pub fn for_kernels(&self) -> Result<Robot, Failure> {
        let each = |e: &EffectError| (e.at.clone(), e.message.clone(), e.help.clone());
        self.file.with_effects().map_err(|wrong| {
            let wrong: Vec<_> = wrong.iter().map(each).collect();
            self.mistakes(
                wrong.iter().map(|(at, message, help)| (at, message.clone(), help.clone())),
            )
        })
    }

    /// The file as it stands, and all its effects as the catalogue knows them: none is taken into the table.
    ///
    /// # Errors
    /// [`Failure`]: a table without numbers; the reading has seen the effects.
    pub fn as_it_stands(&self) -> Result<(Arm, Vec<Known>), Failure> {
        let arm = stiffarm_gap::robot::arm(&self.file)?;
        let known = Known::all(&self.file, &arm, &Catalogue::default());
        let wrong = |all: Vec<_>| all.iter().map(ToString::to_string).collect::<String>();
        let known = known.map_err(|all| Failure::new(wrong(all)))?;
        Ok((arm, known))
    }

    /// The effects of motion that do nothing at rest.
    pub fn in_motion_alone(&self) -> impl Iterator<Item = Effect> {
        self.motion.iter().filter(|effect| !self.file.effects.contains(effect)).cloned()
    }

    /// The effects at rest that do nothing in motion.
    pub fn at_rest_alone(&self) -> impl Iterator<Item = &Known> {
        let moves = |known: &&Known| {
            let id = known.effect.identifier();
            self.motion.iter().any(|e| e.id.value == id && self.file.effects.contains(e))
        };
        self.known.iter().filter(move |known| !moves(known))
    }

    /// Refuses effects of motion for what is asked of rates and torques: no kernel has them.
    ///
    /// # Errors
    /// [`Failure`] names the first where it stands.
    pub fn refuse_motion(&self, outputs: &[Output]) -> Result<(), Failure> {
        let drives = [Input::Accelerations, Input::Torques];
        let moves = |o: &&Output| o.inputs().iter().any(|input| drives.contains(input));
        // What acts at rest and no torque feels (backlash) is in the pose.
        let is_felt = |e: &&Effect| !self.file.effects.contains(e) || is_of_torques(e);
        let felt = self.motion.iter().find(is_felt);
        let (Some(effect), Some(output)) = (felt, outputs.iter().find(moves)) else {
            return Ok(());
        };
        let (id, place) = (words(&effect.id.value), &effect.place.value);
        let message = format!("{} has no {id}, as the file has at {place}", output.name());
        let help = "ask for other --outputs, or take the [[effect]] out of a copy of the file";
        Err(self.mistakes([(&effect.at, message, Some(help.to_owned()))]))
    }

    /// Refuses an effect that nothing decides: neither posture and load nor what else is known.
    ///
    /// # Errors
    /// [`Failure`] names the effect where it stands.
    pub fn refuse_undecided(
        &self,
        command: &str,
        whole: &Whole<'_>,
        at: &Situation,
    ) -> Result<(), Failure> {
        let open = whole.undecided(at);
        open.map_or(Ok(()), |(known, _)| Err(self.refusal(command, known, lacking(known))))
    }

    /// Refuses the same, and an effect of which no output tells everything.
    ///
    /// # Errors
    /// [`Failure`] names the effect where it stands.
    pub fn refuse_untold(
        &self,
        command: &str,
        whole: &Whole<'_>,
        q: &[f64],
        at: &Situation,
    ) -> Result<(), Failure> {
        self.refuse_undecided(command, whole, at)?;
        let untold = whole.untold(q, at);
        untold.map_or(Ok(()), |known| Err(self.refusal(command, known, "")))
    }

    fn refusal(&self, command: &str, known: &Known, because: &str) -> Failure {
        let name = words(known.effect.identifier());
        let place = known.spot.place;
        let message =
            format!("`stiffarm {command}` does not honour the {name} at {place}{because}");
        let help = "take the [[effect]] out of a copy of the file to go on without it".to_owned();
        self.mistakes([(&known.at, message, Some(help))])
    }

    fn mistakes<'m>(
        &self,
        each: impl IntoIterator<Item = (&'m Spot, String, Option<String>)>,
    ) -> Failure {
        let remark = |(at, message, help)| {
            let located = Located::at(&self.given, &self.text, at, message, help);
            Remark::located(&located, &self.text, false)
        };
        Failure::File(each.into_iter().map(remark).collect())
    }

    /// The same with its effects read: those that the table holds are in it then.
    pub(super) fn understood(mut self) -> Result<Source, Failure> {
        // A name that arms at rest know too is told by its numbers. What is the same at rest and in motion (a
        // counterbalance) is both.
        let at_rest = Catalogue::default();
        let arm = self.arm().ok();
        let rests = |e: &Effect| {
            let (Some(arm), Some(effect)) = (&arm, at_rest.named(&e.id.value)) else {
                return false;
            };
            let has = |key: &str| effect.facts().parameters.iter().any(|p| p.key == key);
            e.numbers.iter().all(|number| has(&number.key))
                && effect.places(arm).iter().any(|place| place.to_string() == e.place.value)
        };
        let moves = |e: &&Effect| {
            is_of_motion(e) && (!e.numbers.is_empty() || at_rest.named(&e.id.value).is_none())
        };
        self.motion = self.robot.effects.iter().filter(moves).cloned().collect();
        self.robot.effects.retain(|e| rests(e) || !moves(&e));
        self.file.effects.clone_from(&self.robot.effects);
        if self.robot.effects.is_empty() {
            return Ok(self);
        }
        match folded(&self.robot, &Catalogue::default()) {
            Ok((robot, known)) => Ok(Source { robot, known, ..self }),
            Err(FoldError::Robot(error)) => Err(error.into()),
            Err(FoldError::Effects(wrong)) => {
                Err(self.mistakes(wrong.iter().map(|e| (&e.at, e.message.clone(), e.help.clone()))))
            }
        }
    }
}

/// What a posture and a load do not say of an effect.
fn lacking(known: &Known) -> &'static str {
    match known.effect.depends() {
        Depends::Posture => "",
        Depends::Direction => {
            ": neither columns s1 … sn nor --sides say from where the joints come to rest"
        }
        Depends::Temperature => {
            ": neither a column temperature nor --warming says how warm the arm is"
        }
        Depends::LastMove => ": the move before is not known",
        Depends::Session => ": it belongs to the session of its measurements",
    }
}
