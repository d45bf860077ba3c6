//! Values of results.

use crate::derive::Size;
use crate::term::Term;

/// The value of a result: made from a term, from an array or a `Vec` of terms, or from columns of them.
pub struct Entries<'f> {
    /// `None` where columns differ in length.
    pub(super) size: Option<Size>,
    /// Column by column.
    pub(super) terms: Vec<Term<'f>>,
}

impl<'f> From<Term<'f>> for Entries<'f> {
    fn from(term: Term<'f>) -> Self {
        Entries { size: Some(Size::Scalar), terms: vec![term] }
    }
}

impl<'f> From<Vec<Term<'f>>> for Entries<'f> {
    fn from(terms: Vec<Term<'f>>) -> Self {
        Entries { size: Some(Size::Vector(terms.len())), terms }
    }
}

impl<'f, const K: usize> From<[Term<'f>; K]> for Entries<'f> {
    fn from(terms: [Term<'f>; K]) -> Self {
        terms.to_vec().into()
    }
}

impl<'f> From<Vec<Vec<Term<'f>>>> for Entries<'f> {
    fn from(columns: Vec<Vec<Term<'f>>>) -> Self {
        let rows = columns.first().map_or(0, Vec::len);
        let even = columns.iter().all(|column| column.len() == rows);
        let size = even.then_some(Size::Matrix { rows, columns: columns.len() });
        Entries { size, terms: columns.concat() }
    }
}
