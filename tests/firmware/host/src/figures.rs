//! What the kernels cost.

use std::path::Path;

use crate::Failure;
use crate::elf::Image;
use crate::tools::SHIFT;

/// What one kernel costs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Figure {
    /// The kernel's name.
    pub name: String,
    /// Instructions of the shortest and of the longest call.
    pub fewest: u32,
    /// See `fewest`.
    pub most: u32,
    /// Bytes of stack.
    pub stack: u32,
    /// Bytes of flash, with everything that is called.
    pub flash: u32,
    /// Conditional branches, with everything that is called: of loops, of refusals.
    pub branches: u32,
}

/// Nanoseconds of one tick of SysTick: both boards run at 25 MHz.
const TICK: u32 = 40;

/// Kernels whose calls may differ: they solve, and an unstable arm leaves them early; the loop
/// refuses; square roots and arctangents of the inverse kinematics select what the compiler branches
/// on.
const SOLVING: [&str; 7] = [
    "deflection",
    "all",
    "control_period",
    "kuka_kr240_deflection",
    "c_deflection",
    "ur10_inverse_kinematics",
    "kuka_kr240_inverse_kinematics",
];

/// The figures that an image sent, with what its file says of each function.
///
/// # Errors If a line is not as expected, or a function is not as every kernel should be: it
/// recurses, calls by pointer, or takes more instructions for one input than for another and is not
/// one of those that solve.
pub fn read(sent: &[u8], image: &Path) -> Result<Vec<Figure>, Failure> {
    let text = std::str::from_utf8(sent).map_err(|e| format!("the figures: {e}"))?;
    let image = Image::open(image)?;
    let mut lines = text.lines();
    controls(&mut lines)?;
    let figures: Vec<Figure> = lines.map(|line| figure(line, &image)).collect::<Result<_, _>>()?;
    // The control of calls that do not differ: some of the draws are refused, which is quicker.
    match figures.iter().any(|f| f.name == "deflection" && f.fewest < f.most) {
        true => Ok(figures),
        false => Err("no load is refused more quickly than it is borne".to_owned()),
    }
}

/// The first two lines are of functions whose cost is known.
fn controls<'t>(lines: &mut impl Iterator<Item = &'t str>) -> Result<(), Failure> {
    let mut next = |name: &str| match Line::read(lines.next().unwrap_or_default())? {
        line if line.name == name => Ok(line),
        line => Err(format!("{name} was expected, found {}", line.name)),
    };
    let hundred = next("hundred_instructions")?;
    if (hundred.fewest, hundred.most) != (100, 100) {
        return Err(format!("100 instructions are counted as {hundred:?}"));
    }
    // The array, and the registers that are saved around it.
    let words = next("words_of_stack")?;
    match (256..=320).contains(&words.stack) {
        true => Ok(()),
        false => Err(format!("256 bytes of stack are measured as {words:?}")),
    }
}

/// What an image sends of a kernel.
#[derive(Debug)]
struct Line<'t> {
    name: &'t str,
    fewest: u32,
    most: u32,
    stack: u32,
}

impl<'t> Line<'t> {
    fn read(line: &'t str) -> Result<Self, Failure> {
        let words: Vec<&str> = line.split(' ').collect();
        let [name, fewest, most, stack] = words[..] else {
            return Err(format!("`{line}`: a name and three figures were expected"));
        };
        let number = |word: &str| word.parse::<u32>().map_err(|e| format!("`{line}`: {e}"));
        let instructions =
            |word| number(word).map(|ticks| (ticks * TICK + (1 << (SHIFT - 1))) >> SHIFT);
        let (fewest, most) = (instructions(fewest)?, instructions(most)?);
        Ok(Line { name, fewest, most, stack: number(stack)? })
    }
}

fn figure(line: &str, image: &Image) -> Result<Figure, Failure> {
    let Line { name, fewest, most, stack } = Line::read(line)?;
    let module = match name.starts_with("c_") {
        true => "stiffarm_firmware_image::foreign",
        false => "stiffarm_firmware_arms::figures",
    };
    let reached = image.reached(module, name)?;
    let figure = Figure {
        name: name.to_owned(),
        fewest,
        most,
        stack,
        flash: reached.bytes,
        branches: reached.branches,
    };
    if figure.fewest != figure.most && !SOLVING.contains(&name) {
        let Figure { fewest, most, .. } = figure;
        return Err(format!("{name} depends on its data: {fewest} to {most} instructions"));
    }
    Ok(figure)
}
