//! Pictures from the reference data: same text each time, and every part on the sheet.

use std::fs;
use std::path::{Path, PathBuf};

use trunnion::data::{Radius, Sweep, Unit};
use trunnion::plot::{Chart, Mark, Panel, PlotError, PolarChart, Rim, Scale, Series, Tone};

fn reference(set: &str, file: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference/tilting-table").join(set).join(file)
}

/// Degrees and µm.
fn run(set: &str, file: &str) -> Vec<(f64, f64)> {
    let sweep = Sweep::read(&reference(set, file), "a", Radius::new(150.0).unwrap(), 11).unwrap();
    let shown =
        |s: &trunnion::data::SweepSample| (Unit::Deg.from_inner(s.angle_rad), Unit::Um.from_inner(s.reading_mm));
    sweep.samples().iter().map(shown).collect()
}

fn runs(set: &str) -> Vec<Series> {
    let line = |name: &str, tone, file| Series { name: name.into(), tone, mark: Mark::Line(run(set, file)) };
    vec![
        line("ΔR_{1}, tilting", Tone::Blue, "tilting.csv"),
        line("ΔR_{2}, separation", Tone::Vermilion, "separation.csv"),
    ]
}

fn figure3(set: &str) -> Chart {
    let panel = Panel { y: Scale::new("Radial deviation", Unit::Um), series: runs(set) };
    Chart { title: "Both runs".into(), x: Scale::new("Tilting angle a", Unit::Deg), panels: vec![panel] }
}

/// The truth of a set with an estimate made up from it, in the layout of the paper's Fig. 4.
fn figure4(set: &str) -> Chart {
    let text = fs::read_to_string(reference(set, "truth.json")).unwrap();
    let truth: serde_json::Value = serde_json::from_str(&text).unwrap();
    let point = |p: &serde_json::Value| (p["a_deg"].as_f64().unwrap(), p["urad"].as_f64().unwrap());
    let truth: Vec<_> = truth["eps_xa"].as_array().unwrap().iter().map(point).collect();
    let error = |a: f64| 0.9 * (a.to_radians() * 1.5).sin() - 0.2;
    let estimate: Vec<_> = truth.iter().map(|(a, e)| (*a, e + error(*a))).collect();
    let band = estimate.iter().map(|(a, e)| (*a, e - 1.5, e + 1.5)).collect();
    let errors = truth.iter().map(|(a, _)| (*a, error(*a))).collect();
    let limits = truth.iter().map(|(a, _)| (*a, -1.5, 1.5)).collect();
    let series = |name: &str, tone, mark| Series { name: name.into(), tone, mark };
    Chart {
        title: "Angular error of the tilting table".into(),
        x: Scale::new("Tilting angle a", Unit::Deg),
        panels: vec![
            Panel {
                y: Scale::new("ε_{xa}", Unit::Urad),
                series: vec![
                    series("95 % band", Tone::Blue, Mark::Band(band)),
                    series("ε_{xa} estimated", Tone::Blue, Mark::Line(estimate)),
                    series("ε_{xa} true", Tone::Black, Mark::Dashed(truth)),
                ],
            },
            Panel {
                y: Scale::new("Error", Unit::Urad),
                series: vec![
                    series("", Tone::Vermilion, Mark::Band(limits)),
                    series("estimated − true", Tone::Vermilion, Mark::Line(errors)),
                ],
            },
        ],
    }
}

fn polar(set: &str) -> PolarChart {
    let deviation = Scale::new("ΔR", Unit::Um);
    PolarChart { title: "Radial deviation".into(), deviation, rim: Rim::Degrees, series: runs(set) }
}

/// Every coordinate of the drawing lies within its sheet. One on the edge was moved there by the drawing library.
fn inside(svg: &str) {
    let field = |name: &str, of: &str| {
        let start = of.find(&format!(" {name}=\"")).map(|at| at + name.len() + 3)?;
        of.get(start..)?.split('"').next().map(str::to_owned)
    };
    let number = |text: &str| text.parse::<f64>().unwrap();
    let sheet: Vec<f64> = field("viewBox", svg).unwrap().split(' ').map(number).collect();
    let mut drawn = 0;
    for tag in svg.split('<') {
        let points = field("points", tag).unwrap_or_default();
        let place = (field("x", tag), field("y", tag));
        let place = if let (Some(x), Some(y)) = place { format!("{x},{y}") } else { String::new() };
        for pair in points.split_whitespace().chain(place.split_whitespace()) {
            let (x, y) = pair.split_once(',').unwrap();
            let (x, y) = (number(x), number(y));
            let within = 0.0 < x && x < sheet[2] && 0.0 < y && y < sheet[3];
            assert!(within || tag.starts_with("rect"), "{tag}");
            drawn += 1;
        }
    }
    assert!(drawn > 100, "{drawn}");
}

#[test]
fn pictures_are_repeatable_and_on_their_sheet() {
    // Left there to be looked at.
    let pictures = Path::new(env!("CARGO_TARGET_TMPDIR"));
    for set in ["full", "arc220"] {
        let draw = || [figure3(set).svg(), figure4(set).svg(), polar(set).svg()].map(Result::unwrap);
        let drawn = draw();
        assert_eq!(drawn, draw());
        drawn.iter().for_each(|svg| inside(svg));
        for (name, svg) in ["figure3", "figure4", "polar"].iter().zip(&drawn) {
            fs::write(pictures.join(format!("{name}-{set}.svg")), svg).unwrap();
        }
    }
}

#[test]
fn what_cannot_be_drawn_is_named() {
    let chart = |points: Vec<(f64, f64)>| {
        let series = vec![Series { name: String::new(), tone: Tone::Blue, mark: Mark::Line(points) }];
        Chart {
            title: String::new(),
            x: Scale::new("a", Unit::Deg),
            panels: vec![Panel { y: Scale::new("y", Unit::Mm), series }],
        }
        .svg()
    };
    assert_eq!(chart(vec![]), Err(PlotError::NoPoints { panel: 1 }));
    assert_eq!(chart(vec![(0.0, f64::NAN)]), Err(PlotError::NotFinite { panel: 1 }));
    assert_eq!(chart(vec![(0.0, f64::MAX)]), Err(PlotError::NotFinite { panel: 1 }));
    assert!(chart(vec![(0.0, 1.0)]).is_ok());
    assert!(chart(vec![(-1e99, 1e99), (1e99, 1e99)]).is_ok());
}
