//! What a robot file and the macro's tokens are read into: values in lists and tables, each with its place.

use crate::robot::lexeme::Lexeme;

/// A value and its place.
#[derive(Clone, Debug)]
pub(crate) struct Node<L> {
    /// Where it stands.
    pub at: L,
    /// What a robot file calls such a value: `a number`. Tokens are not of a kind before they are read.
    pub kind: Option<&'static str>,
    /// The words of a number, a quantity, an angle or a parameter; `None` of what cannot be one.
    pub words: Option<Vec<Lexeme<L>>>,
    /// What it holds.
    pub content: Content<L>,
}

/// What a value holds.
#[derive(Clone, Debug)]
pub(crate) enum Content<L> {
    /// Words alone.
    Cell,
    /// A text in quotes.
    Text(String),
    /// A list.
    List(Vec<Node<L>>),
    /// A table.
    Table(Table<L>),
    /// What could not be read: its mistake has been reported, and causes no second one.
    #[cfg_attr(not(feature = "macro"), allow(dead_code))]
    Broken,
}

/// Keys and their values.
#[derive(Clone, Debug)]
pub(crate) struct Table<L> {
    /// In the order in which they stand.
    pub pairs: Vec<Pair<L>>,
    /// Keys whose mistakes have been reported: these are not missing.
    pub meant: Vec<String>,
}

/// A key with its value.
#[derive(Clone, Debug)]
pub(crate) struct Pair<L> {
    /// The key.
    pub key: String,
    /// Where the key stands.
    pub at: L,
    /// The value.
    pub value: Node<L>,
}

impl<L> Table<L> {
    /// The value of a key.
    pub fn get(&self, key: &str) -> Option<&Node<L>> {
        self.pairs.iter().find(|pair| pair.key == key).map(|pair| &pair.value)
    }
}

impl<L> Node<L> {
    /// The table, if it is one.
    pub fn table(&self) -> Option<&Table<L>> {
        match &self.content {
            Content::Table(table) => Some(table),
            _ => None,
        }
    }

    /// The entries, if it is a list.
    pub fn list(&self) -> Option<&[Node<L>]> {
        match &self.content {
            Content::List(entries) => Some(entries),
            _ => None,
        }
    }

    /// Whether its mistake has been reported.
    pub fn is_broken(&self) -> bool {
        matches!(self.content, Content::Broken)
    }
}

#[cfg(feature = "macro")]
impl<L: Clone> Node<L> {
    /// What was put together of several tokens.
    pub fn made(at: &L, content: Content<L>) -> Self {
        Node { at: at.clone(), kind: None, words: None, content }
    }

    /// A text.
    pub fn text(at: &L, text: impl Into<String>) -> Self {
        Node::made(at, Content::Text(text.into()))
    }

    /// What has been reported.
    pub fn broken(at: &L) -> Self {
        Node::made(at, Content::Broken)
    }
}

#[cfg(feature = "macro")]
impl<L: Clone> Table<L> {
    /// A table without keys.
    pub fn new() -> Self {
        Table { pairs: Vec::new(), meant: Vec::new() }
    }

    /// Adds a key and its value.
    pub fn put(&mut self, key: &str, at: &L, value: Node<L>) {
        self.pairs.push(Pair { key: key.to_owned(), at: at.clone(), value });
    }
}
