//! A campaign and a log of one arm, diagnosed together: the campaign's fit takes the joints' springs as the log has
//! them, and both tell what they have of them.

use serde::Serialize;
use stiffarm_codegen::robot::Robot;
use stiffarm_document::beside::Said;
use stiffarm_document::{Document, Embedded, figure, together};
use stiffarm_gap::log::Model;
use stiffarm_gap::spring::Spring;

use super::campaign::Told as CampaignTold;
use super::log::Told as LogTold;
use super::log::{Part, is_log};
use super::{Campaign, Catalogues, Found, Motion, Settings};
use crate::host::Host;
use crate::input::source::Source;
use crate::terminal::failure::Failure;
use crate::terminal::json;

/// A campaign and a log of one arm.
pub struct Together {
    /// What was measured at rest.
    pub campaign: Campaign,
    /// What was logged in motion.
    pub motion: Motion,
    /// The log's model beside the springs of both.
    model: Model,
    said: Said,
}

/// The diagnosis as it is written.
#[derive(Serialize)]
struct Written<'a> {
    together: &'a Said,
    campaign: CampaignTold<'a>,
    log: LogTold<'a>,
    /// The robot file with what both found: the whole is a robot to every command. Of currents there is
    /// none.
    #[serde(skip_serializing_if = "Option::is_none")]
    corrected: Option<String>,
}

impl Settings {
    /// What is chosen of a campaign, and of a log beside it.
    pub(super) fn both(
        &self,
        catalogues: &Catalogues,
        host: &Host,
    ) -> Result<[Settings; 2], Failure> {
        let of_log = self.check.as_deref().map_or(Ok(false), |path| is_log(path, host))?;
        let is_of_log = |name: &str| catalogues.in_motion.named(name).is_some();
        let is_at_rest = |name: &str| catalogues.at_rest.named(name).is_some();
        // A name that neither knows is the campaign's to refuse.
        let part = |own: bool, keep: &dyn Fn(&str) -> bool| {
            let names = self.effects.as_ref().map(|names| names.iter().filter(|name| keep(name)));
            let effects = names.map(|names| names.cloned().collect());
            Settings { effects, check: self.check.clone().filter(|_| own), ..self.clone() }
        };
        let campaign = part(!of_log, &|name| is_at_rest(name) || !is_of_log(name));
        Ok([campaign, part(of_log, &is_of_log).in_motion()])
    }
}

impl Together {
    /// Reads and diagnoses both: the log first, so that the campaign knows what it tells of springs.
    pub(super) fn new(
        [of_campaign, of_log]: &[Settings; 2],
        source: Source,
        files: Vec<Part>,
        parts: Vec<Part>,
        catalogues: Catalogues,
        host: &Host,
    ) -> Result<Together, Failure> {
        let motion = Motion::new(of_log, source.clone(), parts, catalogues.in_motion, host)?;
        let told = motion.springs();
        let effect = told.effect.identifier();
        let campaign =
            Campaign::new(of_campaign, source, files, &told.told, catalogues.at_rest, host)?;
        let springs = campaign.beside_log().map_or_else(Vec::new, |both| both.springs.clone());
        let known: Vec<Spring> = springs.iter().filter_map(|joined| joined.together).collect();
        let ((_, alone), (model, both)) = (motion.beside(&[])?, motion.beside(&known)?);
        let (measured_in, left) = campaign.left()?;
        let said = Said { effect, springs, measured_in, campaign: left, log: [alone, both] };
        Ok(Together { campaign, motion, model, said })
    }
}

impl Found for Together {
    fn campaign(&self) -> Option<&Campaign> {
        Some(&self.campaign)
    }

    fn motion(&self) -> Option<&Motion> {
        Some(&self.motion)
    }

    fn json(&self) -> Result<String, Failure> {
        json::text(&Written {
            together: &self.said,
            campaign: self.campaign.told(),
            log: self.motion.told(),
            corrected: self.corrected().ok(),
        })
    }

    fn document(&self, is_page: bool) -> Result<(Document, Embedded), Failure> {
        let parts = [self.campaign.document(is_page)?, self.motion.document(is_page)?];
        let document = together::document(&self.said, parts);
        Ok((document, Embedded::new((), &self.said, figure::WITHIN)?))
    }

    /// The campaign's findings, then the log's.
    fn robot(&self) -> Result<(Vec<String>, Robot), Failure> {
        let at_rest = self.campaign.corrections();
        let in_motion = self.motion.put_into(at_rest.robot(), &self.model)?;
        let mut lines = vec![self.campaign.made_with(&self.motion.files())];
        lines.extend([
            together::sentences(&self.said).join(" "),
            String::new(),
            "At rest:".to_owned(),
        ]);
        lines.extend(at_rest.lines());
        lines.extend([String::new(), "In motion:".to_owned()]);
        lines.extend(in_motion.lines);
        Ok((lines, in_motion.robot))
    }
}
