//! Places in the macro's input, and the words that its tokens make.

use proc_macro2::{Delimiter, Span, TokenStream, TokenTree};
use quote::quote_spanned;

use crate::robot;
use crate::robot::lexeme::{Kind, Lexeme, lex};
use crate::robot::problem::{Place, Problem};

/// From the start of one token to the end of another.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spot {
    /// The first token.
    pub start: Span,
    /// The last token.
    pub end: Span,
}

impl Spot {
    /// The place of one token.
    pub fn new(span: Span) -> Self {
        Spot { start: span, end: span }
    }

    /// The place of these tokens; `empty` if there are none.
    pub fn of(tokens: &[TokenTree], empty: Spot) -> Self {
        match (tokens.first(), tokens.last()) {
            (Some(first), Some(last)) => Spot { start: first.span(), end: last.span() },
            _ => empty,
        }
    }
}

impl Place for Spot {
    fn to(&self, end: &Self) -> Self {
        Spot { start: self.start, end: end.end }
    }

    fn spot(&self) -> robot::Spot {
        robot::Spot::default()
    }
}

/// One mistake in the macro's input, with the tokens it is about.
#[derive(Clone, Debug)]
pub struct SpannedError {
    /// The first token that the mistake is about.
    pub span: Span,
    /// The last one.
    pub end: Span,
    /// What was found and what was expected.
    pub message: String,
    /// How to mend it, where that is known.
    pub help: Option<String>,
}

impl SpannedError {
    /// The mistake as a `compile_error!` that points at its tokens, first to last.
    pub fn to_compile_error(&self) -> TokenStream {
        let text = match &self.help {
            Some(help) => format!("{}\nhelp: {help}", self.message),
            None => self.message.clone(),
        };
        // The compiler underlines from the first token of an invocation to its last.
        let path = quote_spanned!(self.span=> ::core::compile_error);
        let body = quote_spanned!(self.end=> !{ #text });
        quote::quote!(#path #body)
    }
}

impl From<Problem<Spot>> for SpannedError {
    fn from(problem: Problem<Spot>) -> Self {
        let Problem { at, message, help, .. } = problem;
        SpannedError { span: at.start, end: at.end, message, help }
    }
}

impl From<syn::Error> for Problem<Spot> {
    fn from(error: syn::Error) -> Self {
        Problem::new(Spot::new(error.span()), error.to_string())
    }
}

/// The tokens in order, without the invisible groups that a `macro_rules!` substitution leaves.
pub(super) fn flatten(tokens: TokenStream) -> Vec<TokenTree> {
    let mut flat = Vec::new();
    for token in tokens {
        match token {
            TokenTree::Group(group) if group.delimiter() == Delimiter::None => {
                flat.extend(flatten(group.stream()));
            }
            token => flat.push(token),
        }
    }
    flat
}

/// The words of a cell.
pub(super) fn words(tokens: &[TokenTree]) -> Vec<Lexeme<Spot>> {
    let mut words = Vec::new();
    for token in tokens {
        let at = Spot::new(token.span());
        let text = token.to_string();
        match token {
            // `350mm` is one token to Rust, and so is `N·m`.
            TokenTree::Ident(_) => words.extend(lex(&text, |_| at)),
            TokenTree::Literal(_) if !text.contains(['"', '\'']) => {
                words.extend(lex(&text, |_| at));
            }
            TokenTree::Punct(sign) => {
                words.push(Lexeme { kind: Kind::Sign(sign.as_char()), at });
            }
            _ => words.push(Lexeme { kind: Kind::Other(text), at }),
        }
    }
    words
}

/// Whether a token is this sign.
pub(super) fn is_sign(token: &TokenTree, sign: char) -> bool {
    matches!(token, TokenTree::Punct(p) if p.as_char() == sign)
}

/// Whether a token is this word.
pub(super) fn is_word(token: &TokenTree, word: &str) -> bool {
    matches!(token, TokenTree::Ident(ident) if ident == word)
}
