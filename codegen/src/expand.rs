//! The macro: tokens in, a module out. `stiffarm-macros` is a shim over [`expand`].

use std::path::Path;

use proc_macro2::{Literal, Span, TokenStream};
use quote::{format_ident, quote, quote_spanned};
use syn::{Attribute, Ident, LitStr, Visibility};

use crate::derive::Output;
use crate::emit::{RustOptions, rust};
use crate::robot::{Robot, Source, parse_tokens};

/// Expands a `robot!` invocation. `root` is the folder that robot files are looked for in: the one of
/// the invoking crate's Cargo.toml.
///
/// Mistakes become `compile_error!`s at their tokens, beside a stub of the module with functions of
/// the right names, so that code that uses the module adds no errors of its own.
pub fn expand(input: TokenStream, root: &Path) -> TokenStream {
    let invocation = match parse_tokens(input) {
        Ok(invocation) => invocation,
        Err(rejected) => {
            let errors = rejected.to_compile_errors();
            let module = rejected.module.as_ref();
            let vis = rejected.vis.unwrap_or(Visibility::Inherited);
            let stub = module.map(|name| stub(&rejected.attrs, &vis, name, &default_path()));
            return quote! { #errors #stub };
        }
    };
    let (attrs, vis, module) = (&invocation.attrs, &invocation.vis, &invocation.module);
    let kernels = match &invocation.kernels {
        Some(path) => quote!(#path),
        None => default_path(),
    };
    let options = RustOptions { kernels: path_text(&kernels) };
    let (robot, tracked) = match &invocation.source {
        Source::Table(robot) => (Ok(robot.as_ref().clone()), None),
        Source::File(name) => read(name, root),
    };
    let text = robot.and_then(|robot| {
        let text = rust(&robot, &options);
        text.parse::<TokenStream>().map_err(|e| {
            let message = format!("the generated text is not Rust ({e}): a defect of stiffarm");
            quote_spanned! { module.span() => ::core::compile_error!(#message); }
        })
    });
    match text {
        Ok(items) => quote! { #(#attrs)* #vis mod #module { #tracked #items } },
        Err(errors) => {
            let stub = stub(attrs, vis, module, &kernels);
            quote! { #errors #stub }
        }
    }
}

fn default_path() -> TokenStream {
    quote!(::stiffarm::kernels)
}

fn path_text(path: &TokenStream) -> String {
    path.to_string().replace(' ', "")
}

/// Reads a robot file, with an item that makes the compiler watch it; mistakes are reported at the
/// file's name, each with its own line and column.
fn read(name: &LitStr, root: &Path) -> (Result<Robot, TokenStream>, Option<TokenStream>) {
    let path = root.join(name.value());
    let at = name.span();
    let text = match std::fs::read_to_string(&path) {
        Ok(text) => text,
        Err(e) => {
            let message = format!(
                "cannot read the robot file {}: {e}\nhelp: the name is relative to the folder of Cargo.toml",
                path.display()
            );
            return (Err(quote_spanned! { at => ::core::compile_error!(#message); }), None);
        }
    };
    let watched = Literal::string(&path.to_string_lossy());
    let tracked = quote! { const _: &[u8] = include_bytes!(#watched); };
    let remarks = match Robot::from_toml(&text, &name.value()) {
        // A macro cannot warn on stable Rust, and a doubt must not pass in silence.
        Ok((robot, warnings)) if warnings.is_empty() => return (Ok(robot), Some(tracked)),
        Ok((_, warnings)) => warnings,
        Err(error) => error.errors,
    };
    let errors = remarks.iter().map(|remark| {
        let message = remark.to_string();
        quote_spanned! { at => ::core::compile_error!(#message); }
    });
    (Err(errors.collect()), Some(tracked))
}

/// A module of the same shape for any number of joints.
fn stub(attrs: &[Attribute], vis: &Visibility, name: &Ident, kernels: &TokenStream) -> TokenStream {
    let name = Ident::new(&name.to_string(), Span::call_site());
    let functions = Output::EACH.map(|output| {
        let function = format_ident!("{}", output.name());
        let ty = match output {
            Output::Pose => quote!(Pose<S>),
            Output::Frames => quote!([Pose<S>; N]),
            Output::Jacobian | Output::JacobianTool | Output::StiffnessRegressor => {
                quote!([[S; 6]; N])
            }
            Output::ComplementaryStiffness | Output::GravityStiffness => quote!([[S; N]; N]),
            Output::JointTorque | Output::GravityTorque => quote!([S; N]),
            Output::Compliance => quote!([[S; 6]; 6]),
            Output::DeflectionFirstOrder => quote!([S; 6]),
            Output::Deflection | Output::DeflectionWithGravity => quote!(Result<[S; 6], Unstable>),
            Output::ParameterJacobian => quote!([[S; 6]; 30]),
        };
        let wrench = match output {
            Output::ComplementaryStiffness
            | Output::JointTorque
            | Output::DeflectionFirstOrder
            | Output::Deflection
            | Output::DeflectionWithGravity
            | Output::StiffnessRegressor => quote!(, _wrench: &[S; 6]),
            _ => quote!(),
        };
        quote! {
            pub fn #function<S: Scalar, const N: usize>(_q: &[S; N] #wrench) -> #ty {
                ::core::unreachable!()
            }
        }
    });
    quote! {
        #(#attrs)*
        #[allow(unused, missing_docs, clippy::all)]
        #vis mod #name {
            use #kernels::{Error, Kernels, Output, Pose, Scalar, Unstable};
            pub const N: usize = 6;
            pub const NAME: &str = "";
            #(#functions)*
            pub struct Robot;
            impl<S: Scalar> Kernels<S> for Robot {
                fn name(&self) -> &'static str { NAME }
                fn dof(&self) -> usize { N }
                fn evaluate(&self, _: Output, _: &[S], _: &[S; 6], _: &mut [S]) -> Result<(), Error> {
                    Err(Error::Length)
                }
            }
        }
    }
}
