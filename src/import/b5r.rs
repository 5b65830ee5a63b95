//! Tests of Renishaw Ballbar 20, `.b5r`.
//!
//! The form is nowhere documented: it is what several independent readers of such files expect. Elements are looked for
//! wherever they are, whatever is around them; those that are not known are passed over.

use roxmltree::Node;

use super::arc::Arc;
use super::error::{FEWEST, ImportProblem, Inconclusive, NoArc, Wrong};
use super::feed::feed_arcs;
use super::trace::{About, AnglesFrom, Cut, Feature, Imported, Stated, Trace, TraceSample, UnitFrom};
use super::unit::{alike, circularity};
use super::xml::{Xml, attribute, clean, first, text};
use crate::circular::{Direction, Plane};
use crate::data::limits::SAMPLES;
use trunnion_codegen::quantity::Unit;

/// The first element of such a file.
const ROOT: &str = "TEST_DOCUMENT";

/// What a run's roundness is called.
const CIRCULARITY: &str = "AF_CIRCULARITY";

/// A run as the file has it.
#[derive(Clone)]
struct Run {
    /// That of its readings.
    line: u64,
    direction: Direction,
    /// In the file's unit.
    readings: Vec<f64>,
    features: Vec<Feature>,
}

/// Reads a test from the text of its file.
///
/// # Errors
/// [`ImportProblem`] where it is no such file, or does not say enough and neither does what is stated.
pub fn b5r(file: &str, stated: &Stated) -> Result<Imported, ImportProblem> {
    let xml = Xml::parse(file)?;
    let root = xml.document.root_element();
    if first(root, ROOT).is_none() {
        let name = clean(root.tag_name().name()).unwrap_or_default();
        return Err(Wrong::Other(name).at(xml.line(root)));
    }
    let mut about = about(&xml, root, stated)?;
    let elements = outermost(root, "BALLBAR_RUN");
    if elements.is_empty() {
        return Err(Wrong::NoRuns.of_all());
    }
    let runs = (1..).zip(&elements).map(|(number, node)| run(&xml, *node, number)).collect::<Result<Vec<_>, _>>()?;
    if runs.iter().map(|run| run.readings.len()).sum::<usize>() > SAMPLES {
        return Err(Wrong::ManyReadings.of_all());
    }
    let all = features(&xml, root)?;
    about.features =
        all.into_iter().filter(|(node, _)| !elements.iter().any(|run| within(*run, *node))).map(|f| f.1).collect();
    let angles = angles(&xml, root, &about, stated)?;
    let units = units(&runs, &angles, stated)?;
    let traces = runs.into_iter().zip(units).map(|(run, unit)| trace(run, unit, &angles)).collect::<Result<_, _>>()?;
    Ok(Imported { about, traces })
}

fn about(xml: &Xml, root: Node, stated: &Stated) -> Result<About, ImportProblem> {
    let length = number(xml, root, "NOMINAL_LENGTH")?;
    if let Some((line, mm)) = length.filter(|(_, mm)| !(*mm > 0.0 && *mm <= 10_000.0)) {
        return Err(Wrong::Length(mm).at(line));
    }
    let instrument = [attribute(root, "INSTRUMENT", "MANUFACTURER"), attribute(root, "INSTRUMENT", "MODEL")];
    Ok(About {
        test: attribute(root, "TEST_SPEC", "NAME"),
        instrument: instrument.into_iter().flatten().reduce(|maker, model| format!("{maker} {model}")),
        serial: text(root, "SERIAL_NUMBER"),
        calibrated: text(root, "LAST_CALIBRATED"),
        machine: attribute(root, "MACHINE_TESTED", "NAME").or_else(|| text(root, "MACHINE_TESTED")),
        operator: text(root, "OPERATOR"),
        started: text(root, "DATE_STARTED"),
        completed: text(root, "DATE_COMPLETED"),
        plane: plane(xml, root, stated)?,
        bar_mm: length.map(|(_, mm)| mm),
        feed: number(xml, root, "PROGRAMMED_FEEDRATE")?.map(|(_, feed)| feed),
        features: Vec::new(),
    })
}

/// The plane of the test, which its axes and what is stated must not contradict.
fn plane(xml: &Xml, root: Node, stated: &Stated) -> Result<Option<Plane>, ImportProblem> {
    let Some(node) = first(root, "PLANE") else { return Ok(stated.plane) };
    let Some(name) = node.attribute("TEST_PLANE").and_then(clean) else { return Ok(stated.plane) };
    let line = xml.line(node);
    let mut plane = Plane::named(&name).ok_or_else(|| Wrong::NoPlane(name).at(line))?;
    if let (Some(a), Some(b)) = (text(node, "A_AXIS_NAME"), text(node, "B_AXIS_NAME")) {
        // An axis may have a number: X1. Angles count from the first of them to the second.
        let letters: String = [&a, &b].iter().filter_map(|axis| axis.chars().next()).collect();
        let axes = Plane::named(&letters).filter(|axes| axes.is_along(plane));
        plane = axes.ok_or_else(|| Wrong::Axes { plane, axes: format!("{a} and {b}") }.at(line))?;
    }
    match stated.plane {
        Some(stated) if stated == plane => Ok(Some(plane)),
        Some(stated) if stated.is_along(plane) => Err(Wrong::Exchanged { found: plane, stated }.at(line)),
        Some(stated) => Err(Wrong::OtherPlane { found: plane, stated }.at(line)),
        None => Ok(Some(plane)),
    }
}

/// The number in the first element of a name, and its line; none where there is no such element.
fn number(xml: &Xml, root: Node, element: &'static str) -> Result<Option<(u64, f64)>, ImportProblem> {
    let Some(node) = first(root, element) else { return Ok(None) };
    let line = xml.line(node);
    Ok(Some((line, parsed(element, node.text().unwrap_or_default(), line)?)))
}

/// A finite number.
fn parsed(element: &'static str, text: &str, line: u64) -> Result<f64, ImportProblem> {
    let number = text.trim().parse::<f64>().ok().filter(|number| number.is_finite());
    number.ok_or_else(|| Wrong::Number { element, text: clean(text).unwrap_or_default() }.at(line))
}

fn run(xml: &Xml, node: Node, number: usize) -> Result<Run, ImportProblem> {
    let line = xml.line(node);
    let direction = text(node, "RUN_DIRECTION").unwrap_or_default();
    let direction = match direction.to_uppercase().as_str() {
        "CCW" => Direction::Counterclockwise,
        "CW" => Direction::Clockwise,
        _ => {
            return Err(
                Wrong::Direction(direction).at(first(node, "RUN_DIRECTION").map_or(line, |node| xml.line(node)))
            );
        }
    };
    let element = first(node, "READINGS").ok_or_else(|| Wrong::NoReadings(number).at(line))?;
    let line = xml.line(element);
    let text: String = element.descendants().filter(Node::is_text).filter_map(|node| node.text()).collect();
    let readings = text.split_whitespace().take(SAMPLES + 1).map(|reading| parsed("READINGS", reading, line));
    let readings = readings.collect::<Result<Vec<f64>, _>>()?;
    match readings.len() {
        0 => Err(Wrong::NoReadings(number).at(line)),
        count if count < FEWEST => Err(Wrong::FewReadings(count).at(line)),
        _ => Ok(Run { line, direction, readings, features: features(xml, node)?.into_iter().map(|f| f.1).collect() }),
    }
}

fn within(outer: Node, inner: Node) -> bool {
    outer.range().start <= inner.range().start && inner.range().end <= outer.range().end
}

/// The elements of a name that are in no other one of it.
fn outermost<'a, 'i>(root: Node<'a, 'i>, name: &str) -> Vec<Node<'a, 'i>> {
    let mut end = 0;
    let own = |node: &Node| {
        let own = node.range().start >= end;
        end = if own { node.range().end } else { end };
        own
    };
    root.descendants().filter(|node| node.has_tag_name(name)).filter(own).collect()
}

fn features<'a, 'i>(xml: &Xml, node: Node<'a, 'i>) -> Result<Vec<(Node<'a, 'i>, Feature)>, ImportProblem> {
    let elements = node.descendants().filter(|node| node.has_tag_name("FEATURE"));
    let feature = |node: Node<'a, 'i>| {
        let text = |name| node.attribute(name).and_then(clean).unwrap_or_default();
        let (name, unit, line) = (text("NAME"), text("DT"), xml.line(node));
        // Other features may well be words.
        let value = match parsed("FEATURE", node.text().unwrap_or_default(), line) {
            Err(problem) if name == CIRCULARITY => return Some(Err(problem)),
            value => value.ok()?,
        };
        Some(Ok((node, Feature { name, unit, value, line })))
    };
    elements.filter_map(feature).collect()
}

/// The arc of the runs, and where it is from.
fn angles(xml: &Xml, root: Node, about: &About, stated: &Stated) -> Result<(Arc, AnglesFrom), ImportProblem> {
    let overshoot_deg = stated.overshoot_deg;
    if let Some((from_deg, to_deg)) = stated.ends_deg {
        let arc = Arc { from_deg, to_deg, overshoot_deg };
        return Ok((arc, AnglesFrom::Stated(arc)));
    }
    let view = attribute(root, "PLANE", "VIEW").filter(|view| view != "+A+B");
    let name = about.test.as_deref().unwrap_or_default();
    let arc = view.map_or_else(|| Arc::named(name), |view| Err(NoArc::View(view)));
    let place = first(root, "TEST_SPEC").unwrap_or(root);
    let arc = Arc { overshoot_deg, ..arc.map_err(|why| Wrong::NoEnds(why).at(xml.line(place)))? };
    Ok((arc, AnglesFrom::Name(arc)))
}

/// The unit of each run's readings, and where it is from.
fn units(runs: &[Run], angles: &(Arc, AnglesFrom), stated: &Stated) -> Result<Vec<(Unit, UnitFrom)>, ImportProblem> {
    if let Some(unit) = stated.unit {
        return Ok(vec![(unit, UnitFrom::Stated); runs.len()]);
    }
    let found = runs.iter().map(|run| by_circularity(run, angles)).collect::<Result<Vec<_>, _>>()?;
    let mut known = found.iter().flatten().map(|(unit, _)| *unit);
    let Some(unit) = known.next() else { return Err(Wrong::NoUnit(Inconclusive::NoCircularity).of_all()) };
    if known.any(|other| other != unit) {
        return Err(Wrong::NoUnit(Inconclusive::Different).of_all());
    }
    Ok(found.into_iter().map(|own| own.unwrap_or((unit, UnitFrom::OtherRun))).collect())
}

/// The unit in which the readings of a run are as round as it says; none where it says nothing.
fn by_circularity(run: &Run, angles: &(Arc, AnglesFrom)) -> Result<Option<(Unit, UnitFrom)>, ImportProblem> {
    let Some(told) = run.features.iter().find(|feature| feature.name == CIRCULARITY) else { return Ok(None) };
    let told_mm = match told.unit.as_str() {
        "UT_LENGTH_MM" => told.value,
        "UT_LENGTH_UM" => Unit::Um.to_inner(told.value),
        other => return Err(Wrong::FeatureUnit(other.to_owned()).at(told.line)),
    };
    // What is trimmed depends on the unit: each is tried with all that follows from it.
    let round = |unit: Unit| {
        let trace = trace(run.clone(), (unit, UnitFrom::Stated), angles)?;
        Ok(circularity(trace.kept().iter().map(|s| (s.angle_rad, s.reading_mm))).unwrap_or(0.0))
    };
    let [in_mm, in_um] = [round(Unit::Mm)?, round(Unit::Um)?];
    let found = [(Unit::Mm, in_mm), (Unit::Um, in_um)].into_iter().find(|(_, own)| alike(*own, told_mm));
    let unlike = || Wrong::NoUnit(Inconclusive::Unlike { readings: in_mm, told_mm }).at(run.line);
    let (unit, readings_mm) = found.ok_or_else(unlike)?;
    Ok(Some((unit, UnitFrom::Circularity { readings_mm, told_mm })))
}

/// A run with its angles, in mm, and trimmed.
fn trace(
    run: Run,
    (unit, unit_from): (Unit, UnitFrom),
    (arc, from): &(Arc, AnglesFrom),
) -> Result<Trace, ImportProblem> {
    let Run { line, direction, readings, features } = run;
    let readings: Vec<f64> = readings.iter().map(|reading| unit.to_inner(*reading)).collect();
    let feed @ [begin, end] = feed_arcs(&readings);
    let count = readings.len() - begin - end;
    let sample = |(at, reading): (usize, &f64)| {
        let along = at as f64 - begin as f64;
        let along = if direction == Direction::Counterclockwise { along } else { (count - 1) as f64 - along };
        TraceSample { angle_rad: arc.angle_rad(along, count), reading_mm: *reading, line }
    };
    let mut trace = Trace {
        samples: readings.iter().enumerate().map(sample).collect(),
        cut: Cut { feed, ..Cut::default() },
        direction: Some(direction),
        unit,
        unit_from,
        angles_from: from.clone(),
        features,
    };
    trace.trim(Some((arc.from_deg, arc.to_deg)))?;
    Ok(trace)
}
