//! Simulated campaigns: as the command line writes them, and as tables.

use std::fs;
use std::path::Path;

use stiffarm_cli::host::Host;

/// How the campaigns are diagnosed.
pub const OPTIONS: &str = "--noise-position 30um --noise-rotation 0.005deg";

/// A campaign.
pub struct Campaign {
    pub arm: String,
    pub name: String,
    pub robot: &'static str,
    /// The measurement file.
    pub text: String,
}

/// A spring in joint 2 of each, as large as the arm's number says.
pub fn campaigns(robots: &[&'static str], arms: usize, poses: usize) -> Vec<Campaign> {
    let each = robots.iter().flat_map(|robot| (0..arms).map(move |arm| (*robot, arm)));
    let campaign = |(robot, arm): (&'static str, usize)| {
        let effect = format!("joint_compliance@joint 2={}e-6", 2.0 + 0.2 * arm as f64);
        Campaign {
            arm: format!("{robot}_{arm:03}"),
            name: "2026-Q1".to_owned(),
            robot,
            text: simulated(robot, &effect, poses, "30um", arm),
        }
    };
    each.map(campaign).collect()
}

/// The measurement file of an arm with one effect.
pub fn simulated(robot: &str, effect: &str, poses: usize, noise: &str, seed: usize) -> String {
    let (poses, seed) = (poses.to_string(), seed.to_string());
    let words = ["simulate", robot, "--effect", effect, "--payload", "10kg", "--withhold"];
    let sizes = ["--poses", &poses, "--noise-position", noise, "--seed", &seed, "--csv", "-"];
    without_comments(&run(&[&words[..], &sizes].concat(), &[]))
}

/// What a command prints.
pub fn run(words: &[&str], files: &[(&str, &str)]) -> String {
    let words = words.iter().map(|word| (*word).to_owned()).collect();
    let file = |(name, text): &(&str, &str)| ((*name).to_owned(), text.as_bytes().to_vec());
    let host = Host::new(words, files.iter().map(file).collect());
    let ended = stiffarm_cli::run(&host).expect("nobody asks for the end");
    ended.unwrap_or_else(|failure| panic!("{}", failure.text()));
    let told = host.take().written.into_iter().filter(|(name, _)| name == "-");
    String::from_utf8(told.flat_map(|(_, bytes)| bytes).collect()).expect("UTF-8")
}

fn without_comments(text: &str) -> String {
    text.lines().filter(|line| !line.starts_with('#')).map(|line| format!("{line}\n")).collect()
}

impl Campaign {
    /// What `stiffarm diagnose` says of its file.
    pub fn diagnosed(&self) -> String {
        let words = ["diagnose", self.robot, "<campaign>", "--json", "-", "--quiet"];
        let words: Vec<&str> = words.into_iter().chain(OPTIONS.split(' ')).collect();
        run(&words, &[("<campaign>", &self.text)])
    }

    /// The names of its columns.
    pub fn columns(&self) -> Vec<String> {
        let header = self.text.lines().next().expect("a header");
        header.split(',').map(str::to_owned).collect()
    }
}

/// One CSV for each campaign below `folder`, in folders arm=…, with the columns `robot`, `campaign` and `row`; the
/// rows stand in no order.
pub fn write(folder: &Path, campaigns: &[Campaign]) {
    for campaign in campaigns {
        let within = folder.join(format!("arm={}", campaign.arm));
        fs::create_dir_all(&within).unwrap();
        let mut lines = campaign.text.lines();
        let head = lines.next().unwrap();
        let mut rows: Vec<String> = lines
            .enumerate()
            .map(|(k, line)| format!("{},{},{k},{line}\n", campaign.robot, campaign.name))
            .collect();
        let half = rows.len() / 2;
        rows.rotate_left(half);
        rows.reverse();
        let text = format!("robot,campaign,row,{head}\n{}", rows.concat());
        fs::write(within.join(format!("{}.csv", campaign.name)), text).unwrap();
    }
}

/// `"q1[rad]", …`, with `row` before them.
pub fn quoted(columns: &[String]) -> String {
    let each = columns.iter().map(|name| format!("\"{name}\""));
    std::iter::once("row".to_owned()).chain(each).collect::<Vec<_>>().join(", ")
}
