//! A run as it stands in a model file.

use core::fmt::{Display, Formatter, Result};

use super::draft::{DraftBall, DraftReading, DraftRun};
use crate::source::Text;

/// The run's table, which reads back as the same run.
impl Display for DraftRun {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        writeln!(f, "[run.{}]", key(&self.name.value))?;
        writeln!(f, "sweep = {}", string(&self.sweep.value))?;
        if !self.define.is_empty() {
            let define = self.define.iter().map(|(name, is)| format!("{} = {}", key(&name.value), string(&is.value)));
            writeln!(f, "define = {{ {} }}", define.collect::<Vec<_>>().join(", "))?;
        }
        let at: Vec<String> =
            self.at.iter().map(|(axis, at)| format!("{} = {}", key(&axis.value), string(&at.value))).collect();
        writeln!(f, "at = {{ {} }}", at.join(", "))?;
        ball(f, "workpiece_ball", &self.workpiece_ball)?;
        ball(f, "tool_ball", &self.tool_ball)?;
        match &self.reading {
            DraftReading::Bar(bar) => writeln!(f, "reading = {}", string(&bar.value)),
            DraftReading::Displacement(along) => match along.as_slice() {
                [one] => writeln!(f, "reading = {{ displacement = {} }}", string(&one.value)),
                all => writeln!(f, "reading = {{ displacement = {} }}", list(all)),
            },
        }?;
        if self.nuisance.is_empty() { Ok(()) } else { writeln!(f, "nuisance = {}", list(&self.nuisance)) }
    }
}

fn ball(f: &mut Formatter<'_>, name: &str, ball: &DraftBall) -> Result {
    let at = Some(&ball.at).filter(|at| !at.is_empty()).map(|at| format!("at = {}", list(at)));
    let setup = Some(&ball.setup).filter(|setup| !setup.is_empty()).map(|setup| format!("setup = {}", list(setup)));
    match at.into_iter().chain(setup).collect::<Vec<_>>().as_slice() {
        [] => Ok(()),
        parts => writeln!(f, "{name} = {{ {} }}", parts.join(", ")),
    }
}

fn list(texts: &[Text]) -> String {
    format!("[{}]", texts.iter().map(|t| string(&t.value)).collect::<Vec<_>>().join(", "))
}

/// A text as a TOML string; no name and no expression has control characters.
pub fn string(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\""))
}

/// A name as a TOML key.
pub fn key(name: &str) -> String {
    let bare = !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric() || matches!(c, '_' | '-'));
    if bare { name.to_owned() } else { string(name) }
}

#[cfg(test)]
mod tests {
    use super::super::{candidates, read_draft};
    use crate::catalogue;
    use crate::ids::AxisId;
    use crate::source::Text;
    use std::collections::BTreeMap;

    #[test]
    fn what_is_written_reads_back() {
        let mut written = 0;
        for (name, source) in catalogue::MODELS {
            let draft = read_draft(source).unwrap();
            let model = draft.build().unwrap();
            let axes: Vec<AxisId> = (0..model.axes().count()).map(AxisId::from).collect();
            for run in draft.runs.iter().chain(&candidates(&model, &axes).unwrap()) {
                let text = run.to_string();
                let again = read_draft(&format!("name = \"m\"\n\n{text}")).unwrap().runs.remove(0);
                assert_eq!(again.to_string(), text, "{name}");
                let at = |run: &super::DraftRun| {
                    let pairs = run.at.iter().map(|(axis, at)| (axis.value.clone(), at.value.clone()));
                    pairs.collect::<BTreeMap<String, String>>()
                };
                let texts = |run: &super::DraftRun| {
                    let balls =
                        [&run.workpiece_ball.at, &run.workpiece_ball.setup, &run.tool_ball.at, &run.tool_ball.setup];
                    let of = |list: &Vec<Text>| list.iter().map(|t| t.value.clone()).collect::<Vec<_>>();
                    (run.name.value.clone(), run.sweep.value.clone(), balls.map(of))
                };
                assert_eq!((at(&again), texts(&again)), (at(run), texts(run)), "{name}: {text}");
                written += 1;
            }
        }
        assert!(written > 200);
    }
}
