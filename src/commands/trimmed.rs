//! What of a run was trimmed, in JSON.

use serde_json::{Value, json};
use trunnion::import::Cut;

/// Samples that were trimmed, and whether more at either end may be a way to the circle.
pub fn trimmed(cut: &Cut) -> Value {
    let Cut { feed: [fed_in, fed_out], overshoot: [before, after], doubtful: [begins, ends] } = *cut;
    json!({
        "feed_in": fed_in,
        "before": before,
        "after": after,
        "feed_out": fed_out,
        "doubtful": { "feed_in": begins, "feed_out": ends },
    })
}
