//! The macro's input: `robot! { … }` with an inline table, or with the name of a robot file.
//!
//! ```text
//! /// Documentation of the module.
//! pub mod kr240;                        // or: pub mod kr240 from "kr240.toml";
//!                                       // or: pub mod kr240 from "kr240.urdf", base "base_link", tip "tool0";
//! name: "KUKA KR 240-2";                // optional; the module's name if absent
//! convention: modified_dh;              // or standard_dh
//! gravity: [0, 0, -9.80665];            // optional
//! base: translation [1, 0, 0] rotation [0, 0, pi/2];           // optional, either part
//! tool: translation [0, 0, 100 mm] rotation [0, 0, pi/2];      // optional, either part
//! frame: elbow on 3 translation [0, 0, 100 mm];   // optional, any number: on the link of a joint, as tool
//! marker: smr1 [0, 100 mm, 20 mm];      // optional, any number; the place may be left out
//! payload: gripper mass 1.2 kg, com [0, 0, 60 mm];   // optional, any number: a load, with `inertia` if wanted
//! carries: gripper;                     // optional: the load that hangs on the tool
//! outputs: pose, jacobian at elbow;     // optional: what is generated, every output of the tool if absent
//! products: fused;                      // optional: into sums, or separate
//! crate: ::stiffarm_kernels;            // optional: where the generated code finds the kernels
//! joint | theta  | d      | a      | alpha  | stiffness     | mass | com            | limits
//! a1    | q      | 0      | 0      | 0      | 3.8e6 N*m/rad | 120  | [0.3, 0, 0.1]  | -
//! a2    | q + t2 | 0      | 350 mm | 90 deg | k2            | m2   | [c2, 0, 0]     | [-2, 2]
//! ```
//!
//! Columns after `joint` may stand in any order. `theta`, `d`, `a`, `alpha`, `beta` are 0 where a column or
//! cell (`-`) is absent; `stiffness`, `mass`, `com`, `limits`, `beam`, `source` are then not given.
//! A stiffness that is not given may also be written `rigid`.
//!
//! A beam's cell is `{ youngs_modulus: 69 GPa, shear_modulus: 26 GPa, section: tube(0.2, 0.18) }`,
//! with `density` and `shear_coefficient` if wanted. Its section is `tube(outer diameter, inner
//! diameter)` or `box([b, h], [inner b, inner h])`, the inner part being optional, or
//! `{ area: …, iy: …, iz: …, j: … }`.
//!
//! One row is one line; a line that ends or the next one that begins with `|` continues the row.

mod beam;
mod cells;
mod header;
mod outline;
mod parts;
mod rows;
mod spot;
mod table;
#[cfg(test)]
mod tests;

use proc_macro2::TokenStream;
use syn::parse::{ParseStream, Parser};
use syn::{Attribute, Ident, LitStr, Path, Token, Visibility};

use crate::robot::Robot;
use crate::robot::frames::{Wanted, ask};
use crate::robot::problem::{Problem, Report};
use crate::schema::{self, Language, Reader, carry};
pub use outline::Outline;
pub use spot::SpannedError;
use spot::{Spot, flatten};

/// What a `robot!` invocation asks for.
pub struct Invocation {
    /// Attributes and documentation of the module.
    pub attrs: Vec<Attribute>,
    /// The module's visibility.
    pub vis: Visibility,
    /// The module's name.
    pub module: Ident,
    /// Where the generated code finds the kernels; `None` leaves it to the macro.
    pub kernels: Option<Path>,
    /// Whether products are fused into sums.
    pub fused: bool,
    /// The robot itself, or where to read it.
    pub source: Source,
}

/// Where the robot of an invocation comes from.
pub enum Source {
    /// From an inline table, read and validated.
    Table(Box<Robot>),
    /// From a robot file or a URDF, whose name is given.
    File(File),
}

/// A file that an invocation names.
pub struct File {
    /// Its name, relative to the folder of the invoking crate's Cargo.toml.
    pub name: LitStr,
    /// The link of a URDF at which the arm begins.
    pub base: Option<LitStr>,
    /// The link of a URDF at which it ends.
    pub tip: Option<LitStr>,
    /// What is to be generated, instead of what the file says itself; that if there are none.
    outputs: Vec<(Wanted, Spot)>,
    /// The payload that hangs on the tool, beside what the file says itself.
    carries: Option<(String, Spot)>,
}

impl File {
    /// Whether it is a URDF.
    pub fn is_urdf(&self) -> bool {
        self.name.value().ends_with(".urdf")
    }

    /// Hangs on its robot what the invocation says, and has generated what it asks for, where it does.
    ///
    /// # Errors
    /// What the robot does not have.
    pub fn ask(&self, robot: &mut Robot) -> Result<(), Vec<SpannedError>> {
        let mut report = Report::new();
        if !self.outputs.is_empty() {
            robot.want_nothing();
            ask(robot, &self.outputs, &mut report);
        }
        carry(robot, self.carries.as_ref(), &mut report);
        let errors: Vec<_> = report.errors.into_iter().map(SpannedError::from).collect();
        if errors.is_empty() { Ok(()) } else { Err(errors) }
    }
}

/// An invocation that cannot be read: every mistake in it, and as much of its head as was read, so
/// that the macro can put a stub in the module's place.
pub struct Rejected {
    /// Attributes and documentation of the module, as far as they were read.
    pub attrs: Vec<Attribute>,
    /// The module's visibility, if it was read.
    pub vis: Option<Visibility>,
    /// The module's name, if it was read.
    pub module: Option<Ident>,
    /// Where the generated code finds the kernels, if that was said.
    pub kernels: Option<Path>,
    /// The robot file, if one was named.
    pub file: Option<LitStr>,
    /// What the inline table seems to describe.
    pub outline: Outline,
    /// At least one mistake, in the order of the input.
    pub errors: Vec<SpannedError>,
}

impl Rejected {
    /// All mistakes as `compile_error!` invocations.
    pub fn to_compile_errors(&self) -> TokenStream {
        self.errors.iter().map(SpannedError::to_compile_error).collect()
    }
}

/// Reads the input of `robot!`. Nothing is read from disk: a [`Source::File`] is only named.
///
/// # Errors
/// Every mistake in the input, each at its tokens. What is a warning in a robot file (a rounded
/// multiple of π) is an error here.
pub fn parse_tokens(input: TokenStream) -> Result<Invocation, Box<Rejected>> {
    let mut head = Head::default();
    let mut outline = Outline::default();
    let mut report = Report::new();
    let parsed = (|stream: ParseStream<'_>| head.read(stream)).parse2(input);
    let rest = report.keep(parsed.map_err(Problem::from));
    let source = match (&head.module, rest) {
        (Some(module), Some(rest)) => {
            let file = head.file.take();
            body(&mut head.said, &mut outline, (module, file), rest, &mut report)
        }
        _ => None,
    };
    // A macro cannot warn on stable Rust.
    report.errors.append(&mut report.warnings);
    match (source, head) {
        (Some(source), Head { attrs, vis: Some(vis), module: Some(module), said, .. })
            if report.errors.is_empty() =>
        {
            let Said { kernels, fused } = said;
            Ok(Invocation { attrs, vis, module, kernels, fused, source })
        }
        (source, Head { attrs, vis, module, said: Said { kernels, .. }, .. }) => {
            let file = match source {
                Some(Source::File(file)) => Some(file.name),
                _ => None,
            };
            let mut errors: Vec<_> = report.errors.into_iter().map(SpannedError::from).collect();
            errors.sort_by_key(|e| (e.span.start().line, e.span.start().column));
            Err(Box::new(Rejected { attrs, vis, module, kernels, file, outline, errors }))
        }
    }
}

/// What stands before the settings.
#[derive(Default)]
struct Head {
    attrs: Vec<Attribute>,
    vis: Option<Visibility>,
    module: Option<Ident>,
    file: Option<File>,
    said: Said,
}

/// What the settings say about the text, whatever the robot is.
#[derive(Default)]
struct Said {
    kernels: Option<Path>,
    fused: bool,
}

impl Head {
    /// Reads `mod name;` or `mod name from "file";`, of a URDF with base and tip, and returns what follows.
    fn read(&mut self, input: ParseStream<'_>) -> syn::Result<TokenStream> {
        let here = |error: syn::Error, message: &str| syn::Error::new(error.span(), message);
        self.attrs = input.call(Attribute::parse_outer)?;
        self.vis = Some(input.parse()?);
        input
            .parse::<Token![mod]>()
            .map_err(|e| here(e, "expected `mod name;` or `mod name from \"robot.toml\";`"))?;
        self.module = Some(input.parse().map_err(|e| here(e, "expected a name for the module"))?);
        if !input.peek(Token![;]) {
            let message = "expected `;`, or `from` and the name of a robot file";
            let word: Ident = input.parse().map_err(|e| here(e, message))?;
            if word != "from" {
                return Err(syn::Error::new(word.span(), message));
            }
            let message = "expected the name of a robot file in quotes";
            let name = input.parse().map_err(|e| here(e, message))?;
            self.file =
                Some(File { name, base: None, tip: None, outputs: Vec::new(), carries: None });
        }
        while let Some(file) = self.file.as_mut().filter(|_| input.peek(Token![,])) {
            input.parse::<Token![,]>()?;
            let message =
                "expected `base \"link\"` or `tip \"link\"`, each once, behind the name of a URDF";
            let word: Ident = input.parse().map_err(|e| here(e, message))?;
            let urdf = file.is_urdf();
            let link = match word.to_string().as_str() {
                "base" if urdf && file.base.is_none() => &mut file.base,
                "tip" if urdf && file.tip.is_none() => &mut file.tip,
                _ => return Err(syn::Error::new(word.span(), message)),
            };
            *link =
                Some(input.parse().map_err(|e| here(e, "expected the name of a link in quotes"))?);
        }
        input.parse::<Token![;]>().map_err(|e| here(e, "expected `;`"))?;
        input.parse()
    }
}

fn body(
    said: &mut Said,
    outline: &mut Outline,
    (module, file): (&Ident, Option<File>),
    rest: TokenStream,
    report: &mut Report<Spot>,
) -> Option<Source> {
    let tokens = flatten(rest);
    let at = Spot::new(module.span());
    let (mut settings, table) = header::read(&tokens, report);
    *said = Said { kernels: settings.kernels.take(), fused: settings.fused };
    if let Some(file) = file {
        let mut reader = Reader::new(Language::Macro, report);
        let outputs = settings.take("outputs").map(|node| schema::outputs(&node, &mut reader));
        let carries = settings.take("carries");
        let carries = carries.and_then(|node| Some((reader.word(&node)?, node.at)));
        let file = File { outputs: outputs.unwrap_or_default(), carries, ..file };
        settings.refuse_for_a_file(report);
        if !table.is_empty() {
            let message = "a table and a robot file: one of them is enough";
            report.error(Problem::new(Spot::of(table, at), message));
        }
        return Some(Source::File(file));
    }
    *outline = Outline::of_table(&tokens[..tokens.len() - table.len()], table);
    let joints = table::read(table, at, report);
    let robot = settings.into_robot(module, joints, report);
    Some(Source::Table(Box::new(schema::read(&robot, Language::Macro, report))))
}
