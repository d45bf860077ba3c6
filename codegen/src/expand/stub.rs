//! The module that stands in for one whose table has mistakes: the same names, no content.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};
use stiffarm_kernels::{Form, Input, Output, Side};
use syn::{Attribute, Ident, Visibility};

use crate::robot::Outline;

/// Joints of a stub whose table shows none.
const JOINTS: usize = 6;

/// A module with everything that code outside can name but the fields of a posture, which only the table tells. Its
/// functions take any number of joints: a row may be among the mistakes.
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
    let offsets = constants.as_ref().filter(|_| outline.offsets);
    let sides = outline.sides.then(|| quote!(, _: &[S; M]));
    let warming = outline.warming.then(|| quote!(, _: S));
    let joints_of = quote!(_: &[S; M] #sides #warming);
    let by_joints = quote!(#constants #joints_of);
    let given = quote!(#constants _: &Posture<S, M>);
    let functions = Output::EACH.map(|output| function(output, &by_joints, &given));
    let parameters = symbolic.then(|| parameters(&symbols));
    let all = all(outline, &by_joints, &given);
    let robot = robot(symbolic, outline);
    let places = outline.places.iter().filter_map(|name| syn::parse_str::<Ident>(name).ok());
    let places = places.map(|name| quote!(pub mod #name { pub use super::super::*; }));
    quote! {
        #(#attrs)*
        #[allow(unused, missing_docs, clippy::all, clippy::pedantic)]
        #vis mod #name {
            use #kernels::{
                Arm, Convention, DhRow, Error, Kernels, Motion, Numeric, Ops, Output, Pose, Row, Scalar,
                Unstable, has,
            };
            pub const NAME: &str = "";
            pub const N: usize = #joints;
            const ROW: DhRow = DhRow {
                joint: "",
                motion: Motion::Revolute,
                theta: "",
                d: "",
                a: "",
                alpha: "",
                beta: "",
                stiffness: "",
            };
            pub const DH: [DhRow; N] = [ROW; N];
            pub const OUTPUTS: [Output; Output::EACH.len()] = Output::EACH;
            pub const OPS: Ops = Ops { add: 0, mul: 0, neg: 0, div: 0, sin_cos: 0 };
            #parameters
            #[derive(Clone, Copy, Debug, PartialEq)]
            pub struct Posture<S, const M: usize = N>([S; M]);
            impl<S: Scalar, const M: usize> Posture<S, M> {
                pub fn new(#offsets #joints_of) -> Self { ::core::unreachable!() }
            }
            pub fn joints<S: Scalar, const M: usize>(#joints_of) -> [S; M] {
                ::core::unreachable!()
            }
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

/// What an output's functions take beside a posture, and what they return.
fn signature(output: Output) -> (TokenStream, TokenStream) {
    let beside = output.beside().map(|input| match input.side() {
        Side::Joints => quote!(, _: &[S; M]),
        side => {
            let count = side.count(0);
            quote!(, _: &[S; #count])
        }
    });
    let returned = match (ty(output), output.is_fallible()) {
        (ty, true) => quote!(Result<#ty, Unstable>),
        (ty, false) => ty,
    };
    (beside.collect(), returned)
}

/// The function of an output, given what makes a posture, and its module: the kernel, given a posture, and the figures.
fn function(output: Output, by_joints: &TokenStream, given: &TokenStream) -> TokenStream {
    let name = format_ident!("{}", output.name());
    let (beside, returned) = signature(output);
    let n = quote!(super::N);
    let (rows, columns) = (size(output.rows(), &n, &n), size(output.columns(), &n, &n));
    quote! {
        pub fn #name<S: Scalar, const M: usize>(#by_joints #beside) -> #returned {
            ::core::unreachable!()
        }
        pub mod #name {
            use super::*;
            pub use super::OPS;
            pub const SPARSITY: [[bool; #rows]; #columns] = [[true; #rows]; #columns];
            pub fn given<S: Scalar, const M: usize>(#given #beside) -> #returned {
                ::core::unreachable!()
            }
        }
    }
}

/// The fused function.
fn all(outline: &Outline, by_joints: &TokenStream, given: &TokenStream) -> TokenStream {
    let fields = Output::ALL.map(|output| {
        let (name, ty) = (format_ident!("{}", output.name()), ty(output));
        quote!(pub #name: #ty,)
    });
    let asked = |output: &&Output| outline.asked.is_empty() || outline.asked.contains(output);
    let together: Vec<&Output> = Output::ALL.iter().filter(asked).collect();
    let loaded = together.iter().any(|output| output.takes(Input::Wrench));
    let wrench = loaded.then(|| quote!(, _: &[S; 6]));
    let returned = match together.iter().any(|output| output.is_fallible()) {
        true => quote!(Result<all::All<S, M>, Unstable>),
        false => quote!(all::All<S, M>),
    };
    quote! {
        pub fn all<S: Scalar, const M: usize>(#by_joints #wrench) -> #returned {
            ::core::unreachable!()
        }
        pub mod all {
            use super::*;
            pub use super::OPS;
            #[derive(Clone, Copy, Debug, PartialEq)]
            pub struct All<S, const M: usize = N> { #(#fields)* }
            pub fn given<S: Scalar, const M: usize>(#given #wrench) -> #returned {
                ::core::unreachable!()
            }
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

/// The robot behind a pointer, and for what is written against an arm: one of any number of joints.
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
    // The table in numbers says how many joints it has, and takes none from which that could be told.
    let generic = (outline.sides || outline.warming).then(|| quote!(<S: Scalar>));
    let numeric = (!symbolic).then(|| {
        quote! {
            impl #generic Numeric<N> for #ty {
                const CONVENTION: Convention = Convention::Standard;
                const ROWS: [Row; N] = [Row {
                    theta: 0.0, d: 0.0, a: 0.0, alpha: 0.0, stiffness: None, mass: 0.0, com: [0.0; 3]
                }; N];
                const GRAVITY: [f64; 3] = [0.0; 3];
            }
        }
    });
    let has = Output::EACH.map(|output| has(output, &ty));
    quote! {
        #definition
        #numeric
        impl<S: Scalar, const M: usize> Arm<M, S> for #ty {
            const NAME: &'static str = NAME;
            const DH: [DhRow; M] = [ROW; M];
            const LIMITS: [Option<[f64; 2]>; M] = [None; M];
            type Posture = Posture<S, M>;
            fn posture(&self, _: &[S; M]) -> Posture<S, M> { ::core::unreachable!() }
        }
        #(#has)*
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

/// The trait of an output.
fn has(output: Output, robot: &TokenStream) -> TokenStream {
    let (name, of) = (format_ident!("{}", output.name()), format_ident!("{output:?}"));
    let (beside, returned) = signature(output);
    let columns = matches!(output.columns(), Side::Entries | Side::Moments)
        .then(|| quote!(type Columns = #returned;));
    quote! {
        impl<S: Scalar, const M: usize> has::#of<M, S> for #robot {
            #columns
            fn #name(&self, _: &Posture<S, M> #beside) -> #returned { ::core::unreachable!() }
        }
    }
}
