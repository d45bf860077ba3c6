//! `stiffarm diagnose --report` and `identify --report`: the pages, and the pages in a browser.

mod browser;

use crate::diagnose::plant::{Bench, SPRING};
use crate::support::{Folder, flat, has, read, stiffarm};

const LIN: [&str; 5] =
    ["diagnose", "lin_planar", "robots/data/lin1991_table3.csv", "--rival", "ycd"];

/// A report of a plant with a spring and a wave that its robot file does not have.
fn plant() -> String {
    let bench = Bench::new();
    let run = bench.measured(
        "run.csv",
        &[SPRING, "transmission_error@joint 3: cos 2 = 0.4 mrad"],
        1,
        false,
    );
    stiffarm(&["diagnose", &bench.robot, &run, "--report", "-"]).good()
}

/// The sentence that the page opens with, as text.
fn sentence(page: &str) -> String {
    let (_, rest) = page.split_once(r#"<p id="sentence" class="sentence">"#).expect("a sentence");
    let (sentence, _) = rest.split_once("</p>").expect("its end");
    sentence.to_owned()
}

/// The page that a command writes to `path`, and its sentence, which the screen says, too.
fn paged(words: &[&str], path: &str) -> (String, String) {
    let screen = stiffarm(&[words, &["--report", path]].concat()).good();
    let page = read(path);
    let said = sentence(&page);
    assert!(flat(&screen).contains(&said), "{said}");
    assert!(!page.contains("http"));
    (page, said)
}

#[test]
fn the_page_says_what_the_screen_says() {
    let folder = Folder::new();
    let path = folder.name("out.html");
    let (page, said) = paged(&LIN, &path);
    assert!(said.starts_with("Joint 1 twists 41.4 µrad/(N·m) more than modelled; "), "{said}");
    assert!(said.contains("7.41 → 0.89 mil rms"), "{said}");
    assert!(page.contains("<dt>seed</dt><dd>0</dd>"));
    // On standard output, in place of the screen, it is the same but for how it was asked for.
    let printed = stiffarm(&[&LIN[..], &["--report", "-"]].concat()).good();
    let asked = format!("--rival ycd --report {path}</dd>");
    assert!(page.contains(&asked), "{path}");
    assert!(printed == page.replace(&asked, "--rival ycd --report -</dd>"));
    // `sha256sum` of the file.
    let sum = "487b91e5c6af94d94366ec715617250cb5d712d94e8be693ababca91a0add06e";
    assert!(page.contains(&format!("<dt>SHA-256 of the measurements</dt><dd>{sum}</dd>")));
    assert_eq!(folder.names(), ["out.html"]);
}

const WORKBENCH: [&str; 3] = ["identify", "docs/workbench/arm.toml", "docs/workbench/run.csv"];

#[test]
fn the_page_of_an_identification_says_what_its_screen_says() {
    let (page, said) = paged(&WORKBENCH, &Folder::new().name("out.html"));
    assert!(
        said.starts_with("Joint 2 is 1.83 times as compliant as in the robot file, "),
        "{said}"
    );
    assert!(said.contains("0.797 → 0.034 mm"), "{said}");
    assert!(page.contains("<td>3.61e6 N·m/rad</td>"));
}

#[test]
#[ignore = "needs chromium"]
fn needs_chromium_a_browser_turns_the_arm_and_follows_the_links() {
    let folder = Folder::new();
    let lin = stiffarm(&[&LIN[..], &["--report", "-"]].concat()).good();
    let springs = stiffarm(&[&WORKBENCH[..], &["--report", "-"]].concat()).good();
    for (page, list) in [(plant(), "where.csv"), (lin, "where.csv"), (springs, "parameters.csv")] {
        let said = sentence(&page);
        let seen = browser::visit(&folder, &page);
        assert_eq!(seen["problems"], serde_json::json!([]));
        assert_eq!(seen["sentence"], said);
        for what in ["turned", "dragged", "switched", "redrawn", "dark", "component"] {
            assert_eq!(seen[what], true, "{what} in {seen}");
        }
        let files = seen["files"].as_object().expect("one for each link");
        for name in ["rows.csv", "vectors.csv", "report.json", list] {
            let lines = files.get(name).and_then(serde_json::Value::as_u64);
            assert!(lines.is_some_and(|n| n >= 2), "{name} in {seen}");
        }
        assert!(seen["panels"].as_u64() >= Some(3), "{seen}");
    }
}

#[test]
#[ignore = "needs chromium"]
fn needs_chromium_a_browser_reads_the_ledger_and_the_withheld_check() {
    let folder = Folder::new();
    let ledger = stiffarm(&["papers", "--report"]).good();
    let withheld = ["withhold", "lin_planar", "--cases", "4", "--poses", "8", "--report", "-"];
    let withheld = stiffarm(&withheld).good();
    for (page, file, least) in [(ledger, "ledger.csv", 800), (withheld, "cases.csv", 5)] {
        let seen = browser::read(&folder, &page);
        assert_eq!(seen["problems"], serde_json::json!([]));
        assert_eq!(seen["sentence"], sentence(&page));
        assert_eq!(seen["dark"], true, "{seen}");
        assert!(seen["files"][file].as_u64() >= Some(least), "{seen}");
    }
}

/// One sheet that says what the page says, the same bytes each time.
#[test]
fn a_certificate_is_one_sheet() {
    let folder = Folder::new();
    let (first, again) = (folder.name("a.pdf"), folder.name("b.pdf"));
    let data = "robots/data/lin1991_table3.csv";
    for file in [&first, &again] {
        stiffarm(&["diagnose", "lin_planar", data, "--quiet", "--certificate", file]).good();
    }
    let bytes = std::fs::read(&first).expect("written");
    assert!(bytes == std::fs::read(&again).expect("written"));
    assert!(bytes.starts_with(b"%PDF-1.") && bytes.trim_ascii_end().ends_with(b"%%EOF"));
    let text: String = bytes.iter().map(|b| *b as char).collect();
    assert_eq!(text.matches("/Type /Page\n").count(), 1, "{text}");
    has(&text, &["Lin 1991 two-link planar arm", "SHA-256 of the robot file", "7.41", "ISO 9283"]);
}
