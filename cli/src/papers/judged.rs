//! Judges the papers and writes the ledger.

use std::path::Path;

use stiffarm_papers::methods::jweeg::figure;
use stiffarm_papers::{Ledger, Paper, built_in, column, read};

use super::{Args, Figure};
use crate::Verdict;
use crate::host::Host;
use crate::input::source;
use crate::terminal::failure::{Failure, Remark};
use crate::terminal::output::Target;

pub fn run(args: &Args, host: &Host) -> Result<Verdict, Failure> {
    if let Some(Figure::Growth) = args.figure {
        match &args.svg {
            Some(target) => host.write(target, &figure::svg())?,
            None => host.print(&figure::table())?,
        }
        return Ok(Verdict::Good);
    }
    let papers = match args.files.as_slice() {
        [] => built_in().map_err(|error| Failure::new(error.to_string()))?,
        files => from_files(files, host)?,
    };
    let ledger = Ledger::with(&papers, &column);
    let (target, text) = match (&args.markdown, &args.html, &args.json) {
        (Some(target), _, _) => (target, ledger.to_markdown()),
        (_, Some(target), _) => (target, ledger.to_html()),
        (_, _, Some(target)) => (target, ledger.to_json()),
        _ => (&Target::Stdout, ledger.to_text()),
    };
    host.write(target, &text)?;
    Ok(Verdict::Good)
}

/// Reads every file; the mistakes of all of them are reported together.
fn from_files(files: &[std::path::PathBuf], host: &Host) -> Result<Vec<Paper>, Failure> {
    let mut papers = Vec::new();
    let mut remarks = Vec::new();
    for file in files {
        match paper(file, host)? {
            Ok(paper) => papers.push(paper),
            Err(mistakes) => remarks.extend(mistakes),
        }
    }
    if remarks.is_empty() { Ok(papers) } else { Err(Failure::File(remarks)) }
}

fn paper(path: &Path, host: &Host) -> Result<Result<Paper, Vec<Remark>>, Failure> {
    let text = source::text(path, host)?;
    let remarks =
        |located: &stiffarm_codegen::robot::Located| Remark::located(located, &text, false);
    let read = read(&text, &path.to_string_lossy());
    Ok(read.map_err(|error| error.errors.iter().map(remarks).collect()))
}
