//! The page of a campaign and a log of one arm: what both say of what both see, and the page of each.

use askama::Template;

use crate::diagnose::Said;
use crate::screen::together::{cells, sentences};

/// What such a page is made of.
pub struct Both<'a> {
    /// The robot's name.
    pub robot: &'a str,
    /// What both say.
    pub said: &'a Said,
    /// The campaign's page.
    pub campaign: String,
    /// The log's.
    pub log: String,
}

#[derive(Template)]
#[template(path = "both.html")]
struct Page<'a> {
    version: &'a str,
    robot: &'a str,
    effect: String,
    springs: Vec<[String; 4]>,
    sentence: String,
    style: &'static str,
    script: &'static str,
    campaign: String,
    log: String,
}

impl Both<'_> {
    /// The page.
    ///
    /// # Errors
    /// [`askama::Error`] if the template cannot be filled.
    pub fn html(self) -> Result<String, askama::Error> {
        let page = Page {
            version: env!("CARGO_PKG_VERSION"),
            robot: self.robot,
            effect: self.said.effect.replace('_', " "),
            springs: self.said.springs.iter().map(cells).collect(),
            sentence: sentences(self.said).join(" "),
            style: include_str!("style.css"),
            script: concat!(include_str!("script/theme.js"), include_str!("script/both.js")),
            campaign: self.campaign,
            log: self.log,
        };
        page.render()
    }
}
