//! One size in a process of its own: what it takes of memory is then its own.

use std::error::Error;
use std::process::Command;
use std::sync::OnceLock;
use std::time::Instant;

/// The argument by which a bench asks itself for one size.
const ONE: &str = "--one";

/// The size that this process is to work through, if it was started for one.
pub fn wanted() -> Option<usize> {
    let mut arguments = std::env::args().skip_while(|a| a != ONE);
    arguments.nth(1)?.parse().ok()
}

/// The number after `name` on the command line.
pub fn option(name: &str) -> Option<usize> {
    let mut arguments = std::env::args().skip_while(|a| a != name);
    arguments.nth(1)?.parse().ok()
}

/// What a process of its own tells of one size: the numbers of its line.
///
/// # Errors
/// It does not start, fails, or tells no numbers.
pub fn run(size: usize) -> Result<Vec<f64>, Box<dyn Error>> {
    let output = Command::new(std::env::current_exe()?).args([ONE, &size.to_string()]).output()?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into_owned().into());
    }
    let text = String::from_utf8(output.stdout)?;
    Ok(text.split_whitespace().map(str::parse).collect::<Result<_, _>>()?)
}

/// Tells the process that asked.
pub fn tell(numbers: &[f64]) {
    let numbers: Vec<String> = numbers.iter().map(f64::to_string).collect();
    println!("{}", numbers.join(" "));
}

/// The most memory that this process has had, bytes; 0 where the system does not say.
pub fn peak() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|l| l.strip_prefix("VmHWM:"));
    let kilobytes = line.and_then(|l| l.split_whitespace().next()?.parse::<f64>().ok());
    1024.0 * kilobytes.unwrap_or(0.0)
}

/// Seconds of processor time that all threads of this process have had, to hundredths; those since
/// it began where the system does not say. Others on the machine do not lengthen it.
pub fn processor() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    // The name of the program, in brackets, may have spaces.
    let behind = stat.rsplit_once(')').map_or("", |(_, behind)| behind);
    let ticks: Vec<f64> =
        behind.split_whitespace().skip(11).take(2).filter_map(|n| n.parse().ok()).collect();
    static BEGUN: OnceLock<Instant> = OnceLock::new();
    match ticks[..] {
        [user, system] => (user + system) / 100.0,
        _ => BEGUN.get_or_init(Instant::now).elapsed().as_secs_f64(),
    }
}
