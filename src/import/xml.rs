//! XML within limits, with the lines that its elements begin on.

use roxmltree::{Document, Error, Node, ParsingOptions};

use super::error::{ImportProblem, Wrong};
use crate::data::limits::{NAMESPACES, NODES, TAG};

/// A parsed file.
pub(super) struct Xml<'a> {
    pub document: Document<'a>,
    /// Where each line but the first one begins.
    lines: Vec<usize>,
}

impl<'a> Xml<'a> {
    pub fn parse(text: &'a str) -> Result<Self, ImportProblem> {
        let lines: Vec<usize> = text.match_indices('\n').map(|(at, _)| at + 1).collect();
        let line = |at: usize| 1 + lines.partition_point(|begin| *begin <= at) as u64;
        if let Some(at) = text.find("<!ENTITY") {
            return Err(Wrong::Entity.at(line(at)));
        }
        // What the parser takes grows with the square of the number of namespaces and of the length of a tag.
        if text.matches("xmlns").nth(NAMESPACES).is_some() {
            return Err(Wrong::TooManyNamespaces.of_all());
        }
        if let Some(at) = long_tag(text) {
            return Err(Wrong::LongTag.at(line(at)));
        }
        let options = ParsingOptions { allow_dtd: true, nodes_limit: NODES, ..ParsingOptions::default() };
        match Document::parse_with_options(text, options) {
            Ok(document) => Ok(Self { document, lines }),
            Err(Error::NodesLimitReached) => Err(Wrong::TooManyElements.of_all()),
            // These have no place of their own: the file ends too early.
            Err(error @ (Error::NoRootNode | Error::UnclosedRootNode)) => {
                Err(Wrong::Xml(error.to_string()).at(line(text.len())))
            }
            Err(error) => Err(Wrong::Xml(told(&error)).at(u64::from(error.pos().row))),
        }
    }

    /// The line that an element begins on, counted from 1.
    pub fn line(&self, node: Node) -> u64 {
        1 + self.lines.partition_point(|begin| *begin <= node.range().start) as u64
    }
}

/// Where a tag begins that has more than [`TAG`] bytes.
fn long_tag(text: &str) -> Option<usize> {
    let mut at = 0;
    loop {
        at += text.get(at..)?.find('<')?;
        let tag = text.get(at..)?;
        let passed = [("<!--", "-->"), ("<![CDATA[", "]]>")].into_iter().find(|(begin, _)| tag.starts_with(begin));
        at += match passed {
            Some((_, end)) => tag.find(end)?,
            None => {
                let mut quote = None;
                let closes = |byte: &u8| match (quote, *byte) {
                    (None, b'"' | b'\'') => {
                        quote = Some(*byte);
                        false
                    }
                    (Some(open), byte) if open == byte => {
                        quote = None;
                        false
                    }
                    (open, byte) => open.is_none() && byte == b'>',
                };
                match tag.as_bytes().iter().take(TAG).position(closes) {
                    Some(length) => length,
                    None if tag.len() > TAG => return Some(at),
                    None => return None,
                }
            }
        };
    }
}

/// What the parser says, without the place at its end, which is told before it, and not at any length.
fn told(error: &Error) -> String {
    let text = error.to_string();
    let text = text.rsplit_once(" at ").map_or(text.as_str(), |(text, _)| text);
    text.chars().filter(|letter| !letter.is_control()).take(120).collect()
}

/// The first element of a name within another.
pub(super) fn first<'a, 'i>(node: Node<'a, 'i>, name: &str) -> Option<Node<'a, 'i>> {
    node.descendants().find(|node| node.has_tag_name(name))
}

/// The text of the first element of a name, on one line and of a length that people write.
pub(super) fn text(node: Node, name: &str) -> Option<String> {
    first(node, name).and_then(|node| node.text()).and_then(clean)
}

/// An attribute of the first element of a name, in the same way.
pub(super) fn attribute(node: Node, name: &str, attribute: &str) -> Option<String> {
    first(node, name).and_then(|node| node.attribute(attribute)).and_then(clean)
}

/// Characters of a text that are kept.
const LONGEST: usize = 120;

/// A text of somebody else on one line; none of one that says nothing.
pub(super) fn clean(text: &str) -> Option<String> {
    let text: String = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let text: String = text.chars().filter(|letter| !letter.is_control()).take(LONGEST).collect();
    (!text.is_empty()).then_some(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_tag_is_seen_whatever_is_in_it_and_a_long_text_is_none() {
        let long = "x".repeat(2 * TAG);
        let attributes: String = (0..TAG).map(|i| format!(" a{i}='>'")).collect();
        assert_eq!(long_tag(&format!("<r>{long}<a{attributes}/></r>")), Some(3 + 2 * TAG));
        assert_eq!(long_tag(&format!("<r><a b='{long}'/></r>")), Some(3));
        for fine in [
            format!("<r a=\"'>\">{long}<!--{long}<--><![CDATA[<{long}]]></r>"),
            format!("<r><!--{long}"),
            "<a".to_owned(),
            String::new(),
        ] {
            assert_eq!(long_tag(&fine), None);
        }
    }
}
