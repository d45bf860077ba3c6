//! An image as it is flashed: its functions, what they call, how large they are.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use object::{Object as _, ObjectSection as _, ObjectSymbol as _, SymbolKind};

use crate::Failure;
use crate::code::{Flow, flows};

/// The functions of an image, by address.
pub struct Image {
    functions: BTreeMap<u32, Function>,
}

struct Function {
    name: String,
    size: u32,
    flows: Vec<Flow>,
}

/// A function with all that it calls.
#[derive(Debug, PartialEq, Eq)]
pub struct Reached {
    /// Bytes of code and of the constants between the code.
    pub bytes: u32,
    /// Conditional branches.
    pub branches: u32,
}

impl Image {
    /// Reads an image.
    pub fn open(path: &Path) -> Result<Self, Failure> {
        let place = |e: String| format!("{}: {e}", path.display());
        let bytes = std::fs::read(path).map_err(|e| place(e.to_string()))?;
        let file = object::File::parse(bytes.as_slice()).map_err(|e| place(e.to_string()))?;
        // $t and $d say where instructions and where data begin (ELF for the Arm Architecture,
        // 5.5.5).
        let mut marks = BTreeMap::new();
        let mut sizes = BTreeMap::new();
        for symbol in file.symbols() {
            let Ok(name) = symbol.name() else { continue };
            let address = symbol.address() as u32;
            if name.starts_with("$t") || name.starts_with("$d") {
                marks.insert(address, name.starts_with("$t"));
            } else if symbol.kind() == SymbolKind::Text && symbol.size() > 0 {
                let name = format!("{:#}", rustc_demangle::demangle(name));
                sizes.insert(address & !1, (name, symbol.size() as u32));
            }
        }
        let mut functions = BTreeMap::new();
        for (address, (name, size)) in sizes {
            let section = file.sections().find(|section| {
                let range = section.address()..section.address() + section.size();
                section.name() == Ok(".text") && range.contains(&u64::from(address))
            });
            let Some(section) = section else { continue };
            let data = section
                .data_range(address.into(), size.into())
                .map_err(|e| place(e.to_string()))?
                .ok_or_else(|| place(format!("{name} lies outside its section")))?;
            let flows = runs(&marks, address, size)
                .flat_map(|(from, to)| {
                    let part = &data[(from - address) as usize..(to - address) as usize];
                    flows(part, from)
                })
                .collect();
            functions.insert(address, Function { name, size, flows });
        }
        Ok(Image { functions })
    }

    /// What is reached from the function `name` of a module `module`.
    ///
    /// # Errors If there is no such function, or it recurses, calls by pointer, or flows out of all
    /// functions.
    pub fn reached(&self, module: &str, name: &str) -> Result<Reached, Failure> {
        let path = format!("{module}::{name}");
        let whole = |found: &str| found.split("::<").next() == Some(&path);
        let (start, _) = self
            .functions
            .iter()
            .find(|(_, function)| whole(&function.name))
            .ok_or_else(|| format!("no function {path} in the image"))?;
        let mut seen = BTreeSet::new();
        self.follow(*start, &mut seen, &mut Vec::new())?;
        let reached = |f: fn(&Function) -> u32| seen.iter().map(|at| f(&self.functions[at])).sum();
        let branches = |f: &Function| {
            f.flows.iter().filter(|flow| matches!(flow, Flow::Branch(_))).count() as u32
        };
        Ok(Reached { bytes: reached(|f| f.size), branches: reached(branches) })
    }

    fn follow(
        &self,
        at: u32,
        seen: &mut BTreeSet<u32>,
        open: &mut Vec<u32>,
    ) -> Result<(), Failure> {
        let function = &self.functions[&at];
        if open.contains(&at) {
            return Err(format!("{} recurses", function.name));
        }
        if !seen.insert(at) {
            return Ok(());
        }
        open.push(at);
        let inside = at..at + function.size;
        for flow in &function.flows {
            let to = match *flow {
                Flow::Indirect => return Err(format!("{} calls by pointer", function.name)),
                Flow::Call(to) => to,
                Flow::Jump(to) | Flow::Branch(to) if inside.contains(&to) => continue,
                Flow::Jump(to) | Flow::Branch(to) => to,
            };
            let (start, next) = self
                .functions
                .range(..=to)
                .next_back()
                .filter(|(start, next)| to < *start + next.size)
                .ok_or_else(|| format!("{} flows to {to:#x}, no function", function.name))?;
            if next.name != function.name || *start != at {
                self.follow(*start, seen, open)?;
            } else if matches!(flow, Flow::Call(_)) {
                return Err(format!("{} recurses", function.name));
            }
        }
        open.pop();
        Ok(())
    }
}

/// The parts of a function that are instructions.
fn runs(
    marks: &BTreeMap<u32, bool>,
    address: u32,
    size: u32,
) -> impl Iterator<Item = (u32, u32)> + use<> {
    let end = address + size;
    let before = marks.range(..=address).next_back().is_none_or(|(_, code)| *code);
    let mut edges = vec![(address, before)];
    edges.extend(marks.range(address + 1..end).map(|(at, code)| (*at, *code)));
    edges.push((end, false));
    let pairs: Vec<_> = edges.windows(2).map(|w| (w[0], w[1].0)).collect();
    pairs.into_iter().filter(|((_, code), _)| *code).map(|((from, _), to)| (from, to))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An image of functions at 0, 100, 200 …, 10 bytes each.
    fn image(functions: &[(&str, &[Flow])]) -> Image {
        let function = |(k, (name, flows)): (usize, &(&str, &[Flow]))| {
            let name = format!("m::{name}");
            (100 * k as u32, Function { name, size: 10, flows: flows.to_vec() })
        };
        Image { functions: functions.iter().enumerate().map(function).collect() }
    }

    #[test]
    fn what_is_called_counts_once() {
        let [to_b, to_c] = [Flow::Call(100), Flow::Jump(200)];
        let image = image(&[
            ("a::<f32>", &[to_b, to_c, Flow::Branch(4)]),
            ("b", &[to_c]),
            ("c", &[Flow::Branch(202)]),
            ("ab", &[]),
        ]);
        assert_eq!(image.reached("m", "a"), Ok(Reached { bytes: 30, branches: 2 }));
        assert_eq!(image.reached("m", "ab"), Ok(Reached { bytes: 10, branches: 0 }));
    }

    #[test]
    fn what_no_kernel_does_is_refused() {
        let said = |flows: &[Flow]| {
            let image = image(&[("a", flows), ("b", &[Flow::Call(0)])]);
            image.reached("m", "a").expect_err("refused")
        };
        assert!(said(&[Flow::Call(0)]).contains("m::a recurses"));
        assert!(said(&[Flow::Call(100)]).contains("m::a recurses"));
        assert!(said(&[Flow::Indirect]).contains("m::a calls by pointer"));
        assert!(said(&[Flow::Call(50)]).contains("flows to 0x32, no function"));
        assert!(image(&[]).reached("m", "a").is_err());
    }
}
