//! A page in headless Chromium: a script that stands beside the page's own uses it as a reader
//! would, and writes what it saw into the document.

use std::process::Command;

use serde_json::Value;

use crate::support::Folder;

/// Stands before everything: what goes wrong is kept.
const WATCH: &str = r#"<script>
window.problems = [];
window.addEventListener("error", (e) => window.problems.push(e.message));
window.addEventListener("unhandledrejection", (e) => window.problems.push(String(e.reason)));
console.error = (...words) => window.problems.push(words.join(" "));
</script>"#;

/// Stands after a page without an arm: the sentence, the theme, and the files behind its links.
const READ: &str = r##"<script>
(async () => {
  const seen = { files: {} };
  try {
    seen.sentence = document.getElementById("sentence").textContent;
    const colour = () => getComputedStyle(document.body).backgroundColor;
    const theme = document.getElementById("theme");
    const light = colour();
    theme.click();
    seen.dark = colour() !== light && theme.getAttribute("aria-pressed") === "true";
    document.addEventListener("click", (event) => event.preventDefault());
    for (const link of document.querySelectorAll("a[download]")) {
      link.click();
      const file = await (await fetch(link.href)).text();
      seen.files[link.download] = file.trimEnd().split("\n").length;
    }
  } catch (error) {
    window.problems.push(String(error));
  }
  seen.problems = window.problems;
  document.documentElement.dataset.seen = JSON.stringify(seen);
})();
</script>"##;

/// Stands after a page with an arm.
const USE: &str = r##"<script>
(async () => {
  const seen = { files: {} };
  const picture = () => document.getElementById("arm-picture").innerHTML;
  const differs = (act) => { const before = picture(); act(); return picture() !== before; };
  const arm = document.getElementById("arm");
  const key = (name) => arm.dispatchEvent(new KeyboardEvent("keydown", { key: name }));
  const drag = (kind, clientX) => arm.dispatchEvent(
    new PointerEvent(kind, { clientX, clientY: 5, pointerId: 1 }));
  arm.setPointerCapture = () => {};
  try {
    seen.sentence = document.getElementById("sentence").textContent;
    seen.turned = ["ArrowLeft", "ArrowUp", "+"].every((name) => differs(() => key(name)));
    seen.dragged = differs(() => {
      drag("pointerdown", 5);
      drag("pointermove", 60);
      drag("pointerup", 60);
    }) && !differs(() => drag("pointermove", 90));
    seen.switched = differs(() => document.querySelector('input[value="after"]').click());
    const magnify = document.getElementById("magnify");
    seen.redrawn = differs(() => {
      magnify.value = "0.5";
      magnify.dispatchEvent(new Event("input"));
    });
    const colour = () => getComputedStyle(document.body).backgroundColor;
    const theme = document.getElementById("theme");
    const light = colour();
    theme.click();
    seen.dark = colour() !== light && theme.getAttribute("aria-pressed") === "true";
    theme.click();
    seen.dark = seen.dark && colour() === light;
    const panels = document.getElementById("residuals");
    const choice = document.getElementById("component");
    const before = panels.innerHTML;
    choice.selectedIndex = (choice.selectedIndex + 1) % choice.length;
    choice.dispatchEvent(new Event("change"));
    seen.component = choice.length === 1 || panels.innerHTML !== before;
    seen.panels = panels.children.length;
    document.addEventListener("click", (event) => event.preventDefault());
    for (const link of document.querySelectorAll("a[data-csv], a[data-json]")) {
      link.click();
      const file = await (await fetch(link.href)).text();
      const { csv } = link.dataset;
      if (!csv) JSON.parse(file);
      seen.files[csv ? `${csv}.csv` : "report.json"] = file.trimEnd().split("\n").length;
    }
  } catch (error) {
    window.problems.push(String(error));
  }
  for (const svg of document.querySelectorAll("svg[aria-labelledby]")) {
    if (!svg.querySelector("title")) window.problems.push("a picture without a title");
    if (/NaN|Infinity|undefined/.test(svg.innerHTML)) window.problems.push("a picture with NaN");
  }
  seen.problems = window.problems;
  document.documentElement.dataset.seen = JSON.stringify(seen);
})();
</script>"##;

/// What a reader of a page with an arm sees.
pub fn visit(folder: &Folder, page: &str) -> Value {
    visited(folder, page, USE)
}

/// What a reader of any other page sees.
pub fn read(folder: &Folder, page: &str) -> Value {
    visited(folder, page, READ)
}

fn visited(folder: &Folder, page: &str, script: &str) -> Value {
    let page = page.replacen("<head>", &format!("<head>{WATCH}"), 1);
    let page = page.replacen("</body>", &format!("{script}</body>"), 1);
    let file = folder.file("visited.html", page);
    let profile = folder.name("profile");
    let output = ["chromium", "chromium-browser"].into_iter().find_map(|name| {
        let mut chromium = Command::new(name);
        chromium.args([
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--disable-quic",
            "--no-first-run",
            "--disable-background-networking",
            "--disable-component-update",
            "--disable-sync",
            "--enable-logging=stderr",
            "--virtual-time-budget=10000",
            "--dump-dom",
        ]);
        chromium.arg(format!("--user-data-dir={profile}")).arg(format!("file://{file}"));
        chromium.output().ok()
    });
    let output = output.expect("chromium is on the path");
    let err = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{err}");
    let console: Vec<&str> = err.lines().filter(|line| line.contains("CONSOLE")).collect();
    assert!(console.is_empty(), "{console:?}");
    let document = String::from_utf8(output.stdout).expect("the document is text");
    let (_, rest) = document.split_once("data-seen=\"").expect("the script came to its end");
    let (json, _) = rest.split_once('"').expect("the attribute ends");
    let json = json.replace("&quot;", "\"").replace("&lt;", "<").replace("&gt;", ">");
    serde_json::from_str(&json.replace("&amp;", "&")).expect("JSON")
}
