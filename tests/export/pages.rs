//! The pages: what they say of each format is what the program says, their numbers are what comes out.

use trunnion::export::{AllFormat, Format, Grid, OneFormat, Subject, Table, Told, Verified, write, write_all};
use trunnion::study::Setup;
use trunnion_codegen::algebra::ErrorId;
use trunnion_codegen::kinematics::ErrorValues;

const TABLES: &str = include_str!("../../docs/export.md");
const SIGNS: &str = include_str!("../../docs/which-sign.md");

/// The axis is told 90° and stands at 90.002°.
const ERROR: f64 = 0.002;

#[test]
fn the_page_of_tables_has_what_is_known_of_each_format() {
    let row = |format: Format| {
        let facts = format.facts();
        let verified = match facts.verified {
            Verified::Tried => "tried",
            Verified::Documented => "**not verified**",
            Verified::NoControl => "no control",
        };
        let rows = facts.rows.map_or("any".to_owned(), |rows| format!("at most {rows}"));
        let directions = if facts.both { "each" } else { "one for both" };
        let cells = [
            &format!("`{}`", format.name()),
            facts.unit,
            facts.sign,
            facts.between.words(),
            facts.ends.words(),
            facts.turn,
            &rows,
            directions,
            verified,
            facts.needs,
            facts.source,
        ];
        format!("| {} |", cells.join(" | "))
    };
    let lacking: Vec<String> = Format::ALL.into_iter().map(row).filter(|row| !TABLES.contains(row)).collect();
    assert!(lacking.is_empty(), "docs/export.md lacks\n{}", lacking.join("\n"));
    let rows = TABLES.lines().filter(|line| line.starts_with("| `")).count();
    assert_eq!(rows, Format::ALL.len());
}

/// One error, the same everywhere.
struct Only(ErrorId, f64);

impl ErrorValues for Only {
    fn value(&self, error: ErrorId, _: f64) -> f64 {
        if error == self.0 { self.1 } else { 0.0 }
    }
}

/// The row of the page that speaks of something.
fn row(of: &str) -> &'static str {
    SIGNS.lines().find(|line| line.starts_with(&format!("| {of}"))).unwrap_or_else(|| panic!("no row of {of}"))
}

#[test]
fn the_page_of_signs_follows_one_number() {
    let setup = Setup::from_catalogue("tilting-table-a", &[]).unwrap();
    let function = setup.estimated().next().unwrap();
    let error = ERROR.to_radians();
    assert!(row("error").contains(&format!("{:+.3} µrad", error * 1e6)));
    // What the bar reads with everything else perfect.
    let tilting = setup.run("tilting").unwrap();
    let exact = setup.exact(tilting, &[90f64.to_radians()]);
    let read = exact.values(&Only(setup.model.functions[function].error, error)).next().unwrap();
    assert!(row("reading").contains(&format!("{:+.3} µm", read * 1e3)), "{read}");
    // What each control is told.
    let subject = Subject::new(&setup, function, None).unwrap();
    let grid = Grid::new(0.0, 180.0, 90.0).unwrap();
    let table = Table::new(subject, grid, false, |at| [if at == 90.0 { error } else { 0.0 }; 2]);
    let told = |row: &str, text: &str, at: &str| {
        let number = row.split('`').nth_back(1).unwrap();
        assert!(text.lines().any(|line| line.starts_with(at) && line.ends_with(number)), "{row}\n{text}");
    };
    let one = |format| write(&table, format, &Told::default()).unwrap().text;
    told(row("LinuxCNC"), &one(OneFormat::LinuxCnc), "90.");
    told(row("SINUMERIK"), &one(OneFormat::Sinumerik840d), "$AA_ENC_COMP[0,1,A]=");
    told(row("SINUMERIK"), &one(OneFormat::Cec), "$AN_CEC[0,1]=");
    told(row("Heidenhain"), &one(OneFormat::Heidenhain), "1 90.");
    let iso = |format| write_all(std::slice::from_ref(&table), &[], format, &[]).0;
    told(row("ISG"), &iso(AllFormat::Volcomp), "90.");
    told(row("ISG"), &iso(AllFormat::Etalon), "90.");
    let csv = one(OneFormat::Csv);
    assert!(row("`fit`").contains("34.906585") && csv.contains("EAA_urad") && csv.contains("\n90.000000,34.906585\n"));
    // The first section, and the sum behind it.
    let fanuc = one(OneFormat::Fanuc);
    let first: Vec<&str> = fanuc.lines().find(|line| line.contains(" 90.000 ")).unwrap().split_whitespace().collect();
    assert_eq!(first[1..], ["0.000", "90.000", "-2", "-2"]);
    assert!(row("Fanuc").ends_with("`-2` |"));
}
