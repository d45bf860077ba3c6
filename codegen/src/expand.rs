//! The macro: tokens in, a module out. `stiffarm-macros` is a shim over [`expand`].

mod stub;
#[cfg(feature = "urdf")]
mod urdf;

use std::path::Path;

use proc_macro2::{Literal, TokenStream};
use quote::{quote, quote_spanned};
use syn::{LitStr, Visibility};

use crate::emit::{RustOptions, rust};
use crate::robot::{
    File, Located, Outline, Rejected, Robot, Source, SpannedError, closest, parse_tokens,
};
use stub::stub;
#[cfg(feature = "urdf")]
use urdf::invoked;

/// Expands a `robot!` invocation. `root` is the folder that robot files are looked for in: the one of
/// the invoking crate's Cargo.toml.
///
/// Mistakes become `compile_error!`s at their tokens, beside a stub of the module with functions of
/// the right names, so that code that uses the module adds no errors of its own.
pub fn expand(input: TokenStream, root: &Path) -> TokenStream {
    let invocation = match parse_tokens(input) {
        Ok(invocation) => invocation,
        Err(rejected) => return refused(&rejected, root),
    };
    let (attrs, vis, module) = (&invocation.attrs, &invocation.vis, &invocation.module);
    let kernels = invocation.kernels.map_or_else(default_path, |path| quote!(#path));
    let robot = match invocation.source {
        Source::Table(robot) => Ok((*robot, Vec::new(), None)),
        Source::File(file) => {
            read(&file, root).map(|(robot, remarks, watched)| (robot, remarks, Some(watched)))
        }
    };
    let (robot, remarks, watched) = match robot {
        Ok(read) => read,
        Err(unread) => {
            let Unread { errors, watched, outline } = *unread;
            let stub = stub((attrs, vis, module), &kernels, &outline);
            return quote! { #errors #watched #stub };
        }
    };
    let options = RustOptions { kernels: path_text(&kernels), fused: invocation.fused };
    let text = rust(&robot, &options);
    match text.parse::<TokenStream>() {
        // A length or a cosine may happen to be near a well-known constant; a list of expressions has the
        // place of the table, and no lines.
        Ok(items) => quote! {
            #[allow(clippy::approx_constant, clippy::possible_missing_comma)]
            #(#attrs)*
            #(#[doc = ""] #[doc = #remarks])*
            #vis mod #module { #watched #items }
        },
        Err(e) => {
            let message = format!("the generated text is not Rust ({e}): a defect of stiffarm");
            quote_spanned! { module.span() => ::core::compile_error!(#message); }
        }
    }
}

/// The mistakes of an invocation, beside the stub of its module.
fn refused(rejected: &Rejected, root: &Path) -> TokenStream {
    let errors = rejected.to_compile_errors();
    let kernels = rejected.kernels.as_ref().map_or_else(default_path, |path| quote!(#path));
    let inherited = Visibility::Inherited;
    let vis = rejected.vis.as_ref().unwrap_or(&inherited);
    let outline = match &rejected.file {
        // What the file's own mistakes are is told once the invocation is mended.
        Some(name) => {
            Outline::of_file(&std::fs::read_to_string(root.join(name.value())).unwrap_or_default())
        }
        None => rejected.outline.clone(),
    };
    let stub =
        rejected.module.as_ref().map(|name| stub((&rejected.attrs, vis, name), &kernels, &outline));
    quote! { #errors #stub }
}

fn default_path() -> TokenStream {
    quote!(::stiffarm::kernels)
}

fn path_text(path: &TokenStream) -> String {
    path.to_string().replace(' ', "")
}

/// Where a file that is not there may be instead.
fn whereabouts(path: &Path) -> String {
    let here = path.parent().and_then(|folder| folder.read_dir().ok()).into_iter().flatten();
    let names = here.flatten().map(|file| file.file_name().to_string_lossy().into_owned());
    let robots = |name: &String| name.ends_with(".toml") || name.ends_with(".urdf");
    let mut names: Vec<String> = names.filter(robots).collect();
    names.sort();
    let wanted = path.file_name().unwrap_or_default().to_string_lossy();
    match closest(&wanted, names.iter().map(String::as_str)) {
        Some(near) if near != wanted => format!("did you mean `{near}`, in the same folder?"),
        _ => "the name is relative to the folder of this package's Cargo.toml".to_owned(),
    }
}

/// A robot file that is no robot.
struct Unread {
    errors: TokenStream,
    /// Makes the compiler watch the file, if there is one.
    watched: Option<TokenStream>,
    outline: Outline,
}

/// Reads a robot file or a URDF, with what its documentation is to say, and with an item that makes the compiler
/// watch it; mistakes are reported at the file's name, each with its own line and column.
fn read(file: &File, root: &Path) -> Result<(Robot, Vec<String>, TokenStream), Box<Unread>> {
    let name = &file.name;
    let path = root.join(name.value());
    let at = name.span();
    let text = std::fs::read_to_string(&path).map_err(|e| {
        let message = format!("cannot read the robot file: {e}\nhelp: {}", whereabouts(&path));
        let errors = quote_spanned! { at => ::core::compile_error!(#message); };
        Box::new(Unread { errors, watched: None, outline: Outline::default() })
    })?;
    let watch = Literal::string(&path.to_string_lossy());
    let watched = quote! { const _: &[u8] = include_bytes!(#watch); };
    let errors: TokenStream = match understood(file, &text) {
        Ok((mut robot, remarks)) => match file.ask(&mut robot) {
            Ok(()) => return Ok((robot, remarks, watched)),
            Err(errors) => errors.iter().map(SpannedError::to_compile_error).collect(),
        },
        Err(remarks) => {
            let each = remarks.iter().map(|remark| {
                let message = remark.to_string();
                quote_spanned! { at => ::core::compile_error!(#message); }
            });
            each.collect()
        }
    };
    let outline = Outline::of_file(&text);
    Err(Box::new(Unread { errors, watched: Some(watched), outline }))
}

/// The robot in a file's text, and remarks on it.
fn understood(file: &File, text: &str) -> Result<(Robot, Vec<String>), Vec<Located>> {
    let name = file.name.value();
    if file.is_urdf() {
        let [base, tip] = [&file.base, &file.tip].map(|link| link.as_ref().map(LitStr::value));
        return invoked(text, &name, (base.as_deref(), tip.as_deref()));
    }
    match Robot::for_kernels(text, &name) {
        // A macro cannot warn on stable Rust, and a doubt must not pass in silence.
        Ok((robot, warnings)) if warnings.is_empty() => Ok((robot, Vec::new())),
        Ok((_, warnings)) => Err(warnings),
        Err(error) => Err(error.errors),
    }
}

#[cfg(not(feature = "urdf"))]
fn invoked(
    text: &str,
    path: &str,
    _: (Option<&str>, Option<&str>),
) -> Result<(Robot, Vec<String>), Vec<Located>> {
    let message = "this is a URDF, which is read where the feature `urdf` of stiffarm is on";
    Err(vec![Located::on_file(path, text, message)])
}
