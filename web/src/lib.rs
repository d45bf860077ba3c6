//! The commands of stiffarm, for a page: it hands over words and files, and takes what is written.
//!
//! A command runs to its end on the worker that calls it. The page shows how far it is, and ends it by ending the worker.

use std::collections::HashMap;

use serde::Serialize;
use stiffarm_cli::host::Host;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
extern "C" {
    /// The worker's function of that name: what is being done, and what part of it from 0 to 1, or less than 0 if that is
    /// not known.
    #[wasm_bindgen(js_namespace = globalThis)]
    fn hears(what: &str, part: f64);

    /// The worker's function of that name: where a defect of the program ended it, and why.
    #[wasm_bindgen(js_namespace = globalThis)]
    fn breaks(why: &str);
}

/// How a command ended.
#[derive(Serialize)]
struct Answer {
    /// Whether everything was as it should be.
    good: bool,
    /// Why nothing was done.
    failure: Option<String>,
    /// Texts, each with the name of its file; `-` is what a terminal would show.
    written: Vec<(String, String)>,
    /// What is to be known.
    remarks: Vec<String>,
}

/// Files that a command reads, by the names that its words have for them.
#[wasm_bindgen]
#[derive(Default)]
pub struct Files(HashMap<String, Vec<u8>>);

#[wasm_bindgen]
impl Files {
    /// None.
    #[wasm_bindgen(constructor)]
    pub fn new() -> Files {
        Files::default()
    }

    /// One more.
    pub fn add(&mut self, name: String, bytes: Vec<u8>) {
        self.0.insert(name, bytes);
    }
}

/// Runs the command of these words, and returns its answer in JSON: `good`, `failure`, `written`, `remarks`. Results go to
/// names that begin with `<`.
#[wasm_bindgen]
pub fn run(words: Vec<String>, files: Files) -> String {
    std::panic::set_hook(Box::new(|panic| breaks(&panic.to_string())));
    let tell = |what: &str, part: Option<f64>| hears(what, part.unwrap_or(-1.0));
    let host = Host::hearing(words, files.0, Some(tell));
    let ended = stiffarm_cli::run(&host);
    let heard = host.take();
    let (good, failure) = match ended {
        Ok(Ok(good)) => (good, None),
        Ok(Err(failure)) => (false, Some(failure.text())),
        Err(_) => (false, Some("the work was ended".to_owned())),
    };
    let text =
        |(name, bytes): (String, Vec<u8>)| (name, String::from_utf8_lossy(&bytes).into_owned());
    let written = heard.written.into_iter().map(text).collect();
    let answer = Answer { good, failure, written, remarks: heard.remarks };
    serde_json::to_string(&answer).unwrap_or_default()
}
