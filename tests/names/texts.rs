//! Texts that somebody else obeys, where a title, a file's name or a comment comes out.

use std::ffi::OsStr;
use std::process::Command;
use trunnion::data::Unit;
use trunnion::plot::{Chart, Mark, Panel, Scale, Series, Tone};
use trunnion_codegen::emit::{Function, Input, Output, c, equations, header, numpy, rust};
use trunnion_codegen::graph::Graph;
use trunnion_codegen::problems::read_and_derive;

/// Ends of comments and strings, of lines and directions, what a terminal obeys, what a browser runs.
const TEXT: &str =
    "*/ /* \"\"\" ''' \\ \\end{document} %n <script>&amp;</script> \u{1b}[31m \u{9b}2J \u{7} \r \u{202e} \u{2028} ]]>";

fn obeyed(c: char) -> bool {
    (c.is_control() && c != '\n') || matches!(c, '\u{2028}'..='\u{202e}')
}

#[test]
fn printed_source_stays_a_comment() {
    let mut g = Graph::new();
    let [x] = g.inputs();
    let outputs = [Output::array("y", &[(TEXT, x)])];
    let function = Function::new(&g, TEXT, &[TEXT], Input::all(&[TEXT]), &outputs).unwrap();
    let rust = rust::source(core::slice::from_ref(&function), TEXT, &rust::Support::of_solver());
    let (c, numpy) = (c::function(&function, c::Precision::Double), numpy::function(&function));
    for source in [&rust, &c, &numpy, &header("%", TEXT)] {
        assert!(!source.contains(obeyed), "{source:?}");
    }
    assert!(syn::parse_file(&rust).is_ok(), "{rust}");
    assert_eq!((c.matches("*/").count(), c.matches("/*").count()), (2, 2), "{c}");
    assert_eq!(numpy.matches("\"\"\"").count(), 2, "{numpy}");
}

#[test]
fn documents_and_terminals_show_what_they_would_obey() {
    let title: String = TEXT.chars().map(|c| format!("\\U{:08x}", u32::from(c))).collect();
    let titled = format!("\ntitle = \"{title}\"\n");
    let source = super::machines::description("plain", &super::machines::PLAIN).replacen('\n', &titled, 1);
    let (model, derivation) = read_and_derive(&source).unwrap();
    assert_eq!(model.title, TEXT);
    let (text, latex) = (equations::text(&model, &derivation), equations::latex(&model, &derivation));
    assert!(!text.contains(obeyed) && !latex.contains(obeyed));
    for document in [text, latex] {
        assert!(document.lines().next().unwrap().ends_with("]]>"), "{document}");
    }

    let folder = tempfile::tempdir().unwrap();
    let (good, bad) = (folder.path().join("good.toml"), folder.path().join("bad\u{1b}[31m.toml"));
    std::fs::write(&good, &source).unwrap();
    std::fs::write(&bad, source.replace("name = \"plain\"", "name = \"\\u001b[31m\" # \u{202e}")).unwrap();
    let [derive, emit, wrong] = ["derive", "--emit", "\u{1b}[31mlatex\u{7}"].map(OsStr::new);
    for (arguments, code) in [
        (vec![derive, good.as_os_str()], 0),
        (vec![derive, bad.as_os_str()], 2),
        (vec![derive, wrong], 2),
        (vec![derive, good.as_os_str(), emit, wrong], 2),
        (vec![wrong], 2),
    ] {
        let output = Command::new(env!("CARGO_BIN_EXE_trunnion")).args(&arguments).output().unwrap();
        let said = String::from_utf8([output.stdout, output.stderr].concat()).unwrap();
        assert_eq!(output.status.code(), Some(code), "{said}");
        assert!(!said.is_empty() && !said.contains(obeyed), "{said:?}");
    }
}

#[test]
fn a_picture_holds_texts_and_nothing_else() {
    let line = Series { name: TEXT.to_owned(), tone: Tone::Blue, mark: Mark::Line(vec![(0.0, 0.0), (1.0, 1.0)]) };
    let panel = Panel { y: Scale::new(TEXT, Unit::Um), series: vec![line] };
    let svg = Chart { title: TEXT.to_owned(), x: Scale::new("x", Unit::Deg), panels: vec![panel] }.svg().unwrap();
    assert!(svg.contains("&lt;script&gt;&amp;amp;") && !svg.contains("<script"), "{svg}");
    assert!(!svg.contains(obeyed), "{svg:?}");
}
