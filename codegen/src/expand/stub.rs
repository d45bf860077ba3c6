//! The module that stands in for one whose table has mistakes: the same names, no content.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};
use stiffarm_kernels::{Form, Output, Side};
use syn::{Attribute, Ident, Visibility};

use crate::robot::Outline;

/// Joints of a stub whose table shows none.
const JOINTS: usize = 6;

/// A module with everything that code outside can name. Its functions take any number of joints: a
/// row may be among the mistakes.
pub(super) fn stub(
    (attrs, vis, name): (&[Attribute], &Visibility, &Ident),
    kernels: &TokenStream,
    outline: &Outline,
) -> TokenStream {
    let joints = outline.joints.unwrap_or(JOINTS);
    let symbols: Vec<Ident> =
        outline.symbols.iter().filter_map(|name| syn::parse_str(name).ok()).collect();
    let symbolic = !symbols.is_empty();
    let constants = symbolic.then(|| quote!(_: &Constants<S>,));
    let sides = outline.sides.then(|| quote!(, _: &[S; M]));
    let warming = outline.warming.then(|| quote!(, _: S));
    let posture = quote!(#constants _: &[S; M] #sides #warming);
    let functions = Output::EACH.map(|output| function(output, &posture));
    let parameters = symbolic.then(|| parameters(&symbols));
    let all = all(&posture);
    let robot = robot(symbolic, outline);
    let places = outline.places.iter().filter_map(|name| syn::parse_str::<Ident>(name).ok());
    let places = places.map(|name| quote!(pub mod #name { pub use super::super::*; }));
    quote! {
        #(#attrs)*
        #[allow(unused, missing_docs, clippy::all, clippy::pedantic)]
        #vis mod #name {
            use #kernels::{DhRow, Error, Kernels, Motion, Ops, Output, Pose, Scalar, Unstable};
            pub const NAME: &str = "";
            pub const N: usize = #joints;
            pub const DH: [DhRow; N] = [DhRow {
                joint: "",
                motion: Motion::Revolute,
                theta: "",
                d: "",
                a: "",
                alpha: "",
                beta: "",
                stiffness: "",
            }; N];
            pub const OUTPUTS: [Output; Output::EACH.len()] = Output::EACH;
            pub const OPS: Ops = Ops { add: 0, mul: 0, neg: 0, div: 0, sin_cos: 0 };
            #parameters
            pub fn joints<S: Scalar, const M: usize>(#posture) -> [S; M] { ::core::unreachable!() }
            #(#functions)*
            #all
            #robot
            pub mod at { #(#places)* }
        }
    }
}

/// The type of an output for `M` joints.
fn ty(output: Output) -> TokenStream {
    let (rows, columns) = (
        size(output.rows(), &quote!(M), &quote!(N)),
        size(output.columns(), &quote!(M), &quote!(N)),
    );
    match output.form() {
        Form::Pose => quote!(Pose<S>),
        Form::Poses => quote!([Pose<S>; M]),
        Form::Vector => quote!([S; #rows]),
        Form::Matrix => quote!([[S; #rows]; #columns]),
        Form::Stack => {
            let each = size(output.columns().each(), &quote!(M), &quote!(N));
            quote!([[[S; #rows]; #each]; M])
        }
    }
}

/// How many rows or columns there are: `joints` where that is what they are, else in terms of `n`.
fn size(side: Side, joints: &TokenStream, n: &TokenStream) -> TokenStream {
    match (side, side.count(0), side.count(1)) {
        (Side::Joints, ..) => joints.clone(),
        (Side::JointsByJoints, ..) => quote!(#joints * #joints),
        (_, none, one) if none == one => quote!(#one),
        (_, none, one) => {
            let slope = one - none;
            quote!(#slope * #n + #none)
        }
    }
}

/// The function of an output, given what makes a posture and what it takes beside, and the figures in its module.
fn function(output: Output, posture: &TokenStream) -> TokenStream {
    let name = format_ident!("{}", output.name());
    let beside = output.beside().map(|input| match input.side() {
        Side::Joints => quote!(, _: &[S; M]),
        side => {
            let count = side.count(0);
            quote!(, _: &[S; #count])
        }
    });
    let ty = match (ty(output), output.is_fallible()) {
        (ty, true) => quote!(Result<#ty, Unstable>),
        (ty, false) => ty,
    };
    let n = quote!(super::N);
    let (rows, columns) = (size(output.rows(), &n, &n), size(output.columns(), &n, &n));
    quote! {
        pub fn #name<S: Scalar, const M: usize>(#posture #(#beside)*) -> #ty {
            ::core::unreachable!()
        }
        pub mod #name {
            pub use super::OPS;
            pub const SPARSITY: [[bool; #rows]; #columns] = [[true; #rows]; #columns];
        }
    }
}

/// The fused function.
fn all(posture: &TokenStream) -> TokenStream {
    let fields = Output::ALL.map(|output| {
        let (name, ty) = (format_ident!("{}", output.name()), ty(output));
        quote!(pub #name: #ty,)
    });
    quote! {
        pub fn all<S: Scalar, const M: usize>(
            #posture, _: &[S; 6]
        ) -> Result<all::All<S, M>, Unstable> {
            ::core::unreachable!()
        }
        pub mod all {
            use super::{N, Pose};
            pub use super::OPS;
            #[derive(Clone, Copy, Debug, PartialEq)]
            pub struct All<S, const M: usize = N> { #(#fields)* }
        }
    }
}

/// The structs of a table with symbolic parameters.
fn parameters(symbols: &[Ident]) -> TokenStream {
    quote! {
        #[allow(non_snake_case)]
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Parameters<S> { #(pub #symbols: S,)* }
        #[allow(non_snake_case)]
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Constants<S> { #(pub #symbols: S,)* }
        impl<S: Scalar> Constants<S> {
            pub fn new(_: &Parameters<S>) -> Self { ::core::unreachable!() }
        }
    }
}

/// The robot behind a pointer.
fn robot(symbolic: bool, outline: &Outline) -> TokenStream {
    let sides = outline.sides.then(|| quote!(pub sides: [S; N],));
    let warming = outline.warming.then(|| quote!(pub warming: S,));
    let (definition, ty) = match symbolic {
        // No effect is understood of a table with parameters.
        false if outline.sides || outline.warming => (
            quote! {
                #[derive(Clone, Copy, Debug, PartialEq)]
                pub struct Robot<S> { #sides #warming }
                impl<S: Scalar> Default for Robot<S> {
                    fn default() -> Self { ::core::unreachable!() }
                }
            },
            quote!(Robot<S>),
        ),
        true => (
            quote! {
                #[derive(Clone, Copy, Debug, PartialEq)]
                pub struct Robot<S> { pub constants: Constants<S> }
                impl<S: Scalar> Robot<S> {
                    pub fn new(_: &Parameters<S>) -> Self { ::core::unreachable!() }
                }
            },
            quote!(Robot<S>),
        ),
        false => (
            quote! {
                #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
                pub struct Robot;
            },
            quote!(Robot),
        ),
    };
    quote! {
        #definition
        impl<S: Scalar> Kernels<S> for #ty {
            fn name(&self) -> &'static str { NAME }
            fn dof(&self) -> usize { N }
            fn outputs(&self) -> &'static [Output] { &OUTPUTS }
            fn evaluate(
                &self, _: Output, _: &[S], _: &[S; 6], _: &mut [S]
            ) -> Result<(), Error> {
                Err(Error::Length)
            }
        }
    }
}
