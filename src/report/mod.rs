//! A report as one page of HTML that needs nothing else: values in, text out.
//!
//! It is made from the JSON object of the command, so that each of its numbers is one of that object's, and says which
//! (`data-json`, a JSON pointer); only pictures and typeset equations come beside it. No script, nothing fetched from anywhere.

mod numbers;
mod page;
mod pictures;

pub use pictures::picture_files;

use crate::exechon::{OffsetReport, RingReport, offset_picture, ring_picture};
use crate::plot::PlotError;
use crate::study::{Report, Setup};
use serde_json::{Value, json};
use thiserror::Error;
use trunnion_codegen::emit::equations::{Equation, Section, mathml, symbols};

/// Why there is no report.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ReportError {
    /// A picture cannot be drawn.
    #[error(transparent)]
    Plot(#[from] PlotError),
    /// Of a factor, which has no samples to draw.
    #[error(
        "a page shows readings and residuals, which a factor does not keep\n  expected the report of a fit of samples"
    )]
    OfFactor,
    /// The page lacks a number: a defect of its template.
    #[error("the report cannot be set: {0}\n  expected a document of the same version")]
    Page(#[from] minijinja::Error),
}

/// The page of a fit, `document` being its JSON object.
///
/// # Errors
/// [`ReportError`]
pub fn fit(document: &Value, setup: &Setup, report: &Report) -> Result<String, ReportError> {
    if report.of_factor {
        return Err(ReportError::OfFactor);
    }
    let equation = |e: &Equation| json!({ "left": e.left, "terms": e.terms });
    let section =
        |s: &Section| json!({ "title": s.title, "equations": s.equations.iter().map(equation).collect::<Vec<_>>() });
    let equations: Vec<Value> = mathml(&setup.model, &setup.derivation).iter().map(section).collect();
    let beside =
        json!({ "pictures": pictures::fit(report)?, "equations": equations, "symbols": symbols(&setup.model) });
    Ok(page::rendered("fit.html", document, beside)?)
}

/// The page of a ring test.
///
/// # Errors
/// [`ReportError`]
pub fn ring(document: &Value, report: &RingReport) -> Result<String, ReportError> {
    let beside =
        json!({ "pictures": { "ring": ring_picture(&[("", report)], "")?, "histogram": pictures::ring(report)? } });
    Ok(page::rendered("ring.html", document, beside)?)
}

/// The page of a probe's offset.
///
/// # Errors
/// [`ReportError`]
pub fn offset(document: &Value, report: &OffsetReport) -> Result<String, ReportError> {
    Ok(page::rendered("offset.html", document, json!({ "picture": offset_picture(report, "")? }))?)
}
