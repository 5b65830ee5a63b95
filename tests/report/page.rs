//! A page as text: its numbers, its references, its words.

use serde_json::Value;
use std::collections::BTreeSet;

/// A report.
pub struct Page {
    pub html: String,
}

/// Values of an attribute wherever it stands.
fn attributes<'a>(html: &'a str, name: &str) -> Vec<&'a str> {
    let start = format!(" {name}=\"");
    html.split(start.as_str()).skip(1).filter_map(|rest| rest.split('"').next()).collect()
}

fn unescaped(text: &str) -> String {
    let named = [("&lt;", "<"), ("&gt;", ">"), ("&quot;", "\""), ("&#x27;", "'"), ("&#x2f;", "/"), ("&amp;", "&")];
    named.iter().fold(text.to_owned(), |text, (name, is)| text.replace(name, is))
}

/// A printed number as its value and half a unit of its last digit.
fn parsed(text: &str) -> (f64, f64) {
    let text = text.replace('\u{2212}', "-");
    let (mantissa, power) = match text.split_once("\u{202f}×\u{202f}10<sup>") {
        Some((mantissa, power)) => (mantissa, power.strip_suffix("</sup>").unwrap().parse::<i32>().unwrap()),
        None => (text.as_str(), 0),
    };
    let decimals = mantissa.split_once('.').map_or(0, |(_, decimals)| decimals.len() as i32);
    let scale = 10f64.powi(power);
    (mantissa.parse::<f64>().unwrap_or_else(|_| panic!("{text}")) * scale, 0.5 * 10f64.powi(-decimals) * scale)
}

impl Page {
    pub fn new(html: String) -> Self {
        Self { html }
    }

    /// Follows every number into the JSON object, and every text that says where it is from; how many there are.
    pub fn follows(&self, document: &Value) -> usize {
        let mut followed = 0;
        for element in self.html.split("<data ").skip(1) {
            let (tag, rest) = element.split_once('>').unwrap();
            let text = rest.split_once("</data>").unwrap().0;
            let tag = format!(" {tag}");
            let pointer = unescaped(attributes(&tag, "data-json")[0]);
            let there = document.pointer(&pointer).unwrap_or_else(|| panic!("no {pointer}"));
            let number = there.as_f64().unwrap_or_else(|| panic!("{pointer}: {there}"));
            assert_eq!(attributes(&tag, "value")[0].parse::<f64>().unwrap().to_bits(), number.to_bits(), "{pointer}");
            let (printed, half) = parsed(text);
            assert!((printed - number).abs() <= half * (1.0 + 1e-9), "{pointer}: {text} for {number}");
            followed += 1;
        }
        for element in self.html.split("<span data-json=\"").skip(1) {
            let (pointer, rest) = element.split_once("\">").unwrap();
            let there = document.pointer(&unescaped(pointer)).unwrap_or_else(|| panic!("no {pointer}"));
            assert_eq!(unescaped(rest.split_once("</span>").unwrap().0), there.as_str().unwrap(), "{pointer}");
        }
        let told = self.html.matches("data-json=\"").count();
        assert_eq!(told, followed + self.html.matches("<span data-json=\"").count());
        followed
    }

    /// Whether its text has these words, tags apart.
    pub fn says(&self, words: &str) -> bool {
        let mut text = String::new();
        for part in self.html.split('<') {
            text.push_str(part.split_once('>').map_or("", |(_, text)| text));
        }
        unescaped(&text).contains(words)
    }

    /// It needs nothing else, each id is there once, what is referred to is there, and every table and picture has a name.
    pub fn is_whole(&self) {
        let html = &self.html;
        assert!(html.starts_with("<!doctype html>\n<html lang=\"en\" ") && html.ends_with("</html>\n"));
        let without = html.replace("http://www.w3.org/2000/svg", "").replace("http://www.w3.org/1998/Math/MathML", "");
        for outside in
            ["http:", "https:", "//www", " src=", "url(", "@import", "<link", "<script", "<iframe", " onload"]
        {
            assert!(!without.contains(outside) || outside == " src=" && !without.contains("<img"), "{outside}");
        }
        let ids = attributes(html, "id");
        let once: BTreeSet<&str> = ids.iter().copied().collect();
        assert_eq!(once.len(), ids.len(), "{ids:?}");
        let labels = attributes(html, "aria-labelledby").into_iter().flat_map(str::split_whitespace);
        let anchors = attributes(html, "href").into_iter().map(|href| href.strip_prefix('#').unwrap());
        labels.chain(anchors).for_each(|id| assert!(once.contains(id), "{id}"));
        for tag in ["figure", "table", "section", "math", "svg"] {
            let (open, close) = (format!("<{tag}"), format!("</{tag}>"));
            assert_eq!(html.matches(&open).count(), html.matches(&close).count(), "{tag}");
        }
        assert_eq!(html.matches("<figure").count(), html.matches("role=\"img\" aria-label=\"").count());
        assert!(
            html.split("<th").skip(1).all(|th| th.starts_with("ead") || th.contains("scope=\"")),
            "headers say of what"
        );
    }
}
