//! Templates, and how they come to their numbers.

use super::numbers::{beside, decimals, fixed, plain, scientific};
use crate::plot::{MADE, dark_style};
use minijinja::value::Serde;
use minijinja::{Environment, Error, ErrorKind, Output, State, escape_formatter};
use serde_json::Value;
use std::sync::Arc;
use trunnion_codegen::problems::visible;
use trunnion_codegen::quantity::Unit;

const TEMPLATES: [(&str, &str); 8] = [
    ("base.html", include_str!("base.html")),
    ("style.css", include_str!("style.css")),
    ("budget.html", include_str!("budget.html")),
    ("made.html", include_str!("made.html")),
    ("warnings.html", include_str!("warnings.html")),
    ("fit.html", include_str!("fit.html")),
    ("ring.html", include_str!("ring.html")),
    ("offset.html", include_str!("offset.html")),
];

/// Elements whose pictures follow the page's colours.
const PICTURES: &str = "plot";

/// A page of a document and what is shown beside its numbers.
pub(super) fn rendered(template: &str, document: &Value, beside: Value) -> Result<String, Error> {
    let mut environment = Environment::new();
    environment.set_formatter(seen);
    for (name, source) in TEMPLATES {
        environment.add_template(name, source)?;
    }
    numbers(&mut environment, &Arc::new(document.clone()));
    environment.add_filter("pointer", |name: String| name.replace('~', "~0").replace('/', "~1"));
    environment.add_filter("symbol", symbol);
    environment.add_filter("behind", behind);
    environment.add_global("made_by", minijinja::Value::from_safe_string(MADE.to_owned()));
    environment.add_global("dark", minijinja::Value::from_safe_string(dark_style(PICTURES)));
    let mut context = beside;
    context["d"] = document.clone();
    Ok(environment.get_template(template)?.render(Serde(context))? + "\n")
}

/// Texts are shown, not obeyed: neither by the browser nor by who turns its text about.
fn seen(out: &mut Output, state: &mut State, value: &minijinja::Value) -> Result<(), Error> {
    match value.as_str().filter(|_| !value.is_safe()) {
        Some(text) => escape_formatter(out, state, &minijinja::Value::from(visible(text).into_owned())),
        None => escape_formatter(out, state, value),
    }
}

/// A unit as people write it; none of a share.
fn symbol(suffix: String) -> String {
    let units = [Unit::Deg, Unit::Rad, Unit::Urad, Unit::Um, Unit::Mm];
    let unit = units.into_iter().find(|unit| unit.suffix() == suffix);
    unit.map_or(if suffix == "1" { String::new() } else { suffix }, |unit| unit.symbol().to_owned())
}

/// The same behind a number.
fn behind(suffix: String) -> String {
    let symbol = symbol(suffix);
    if symbol.is_empty() || symbol == Unit::Deg.symbol() { symbol } else { format!("\u{a0}{symbol}") }
}

type Printed = Result<minijinja::Value, Error>;

/// Functions that print a number of the document, found by its pointer.
fn numbers(environment: &mut Environment, document: &Arc<Value>) {
    let of = || Document(Arc::clone(document));
    let d = of();
    environment.add_function("num", move |at: String, decimals: usize| d.number(&at, |x| fixed(x, decimals)));
    let d = of();
    environment.add_function("sig", move |at: String, digits: Option<i32>| {
        d.number(&at, |x| fixed(x, decimals(x, digits.unwrap_or(2))))
    });
    let d = of();
    environment.add_function("plain", move |at: String| d.number(&at, plain));
    let d = of();
    environment.add_function("val", move |at: String, uncertainty: String| {
        let u = d.value(&uncertainty)?.as_f64().unwrap_or(0.0);
        d.number(&at, |x| fixed(x, beside(x, u)))
    });
    let d = of();
    environment.add_function("sci", move |at: String, value: String, uncertainty: String| {
        let [value, u] = [&value, &uncertainty].map(|at| d.value(at).map(|x| x.as_f64().unwrap_or(0.0)));
        let (value, u) = (value?, u?);
        d.number(&at, |x| scientific(x, value, u))
    });
    let d = of();
    environment.add_function("text", move |at: String| d.text(&at));
}

struct Document(Arc<Value>);

impl Document {
    fn value(&self, at: &str) -> Result<&Value, Error> {
        self.0.pointer(at).ok_or_else(|| Error::new(ErrorKind::UndefinedError, format!("the document has no {at}")))
    }

    /// A number with where it is from; a dash where there is none.
    fn number(&self, at: &str, print: impl Fn(f64) -> String) -> Printed {
        let value = self.value(at)?;
        let element = match value.as_f64() {
            Some(x) => format!("<data value=\"{value}\" data-json=\"{}\">{}</data>", escaped(at), print(x)),
            None => "\u{2013}".to_owned(),
        };
        Ok(minijinja::Value::from_safe_string(element))
    }

    /// A text with where it is from.
    fn text(&self, at: &str) -> Printed {
        let text = self.value(at)?.as_str().unwrap_or_default();
        let element = format!("<span data-json=\"{}\">{}</span>", escaped(at), escaped(&visible(text)));
        Ok(minijinja::Value::from_safe_string(element))
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
