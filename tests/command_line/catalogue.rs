//! Every model of the catalogue as a user meets it: no option but its name.

use super::{object, succeeds, trunnion};
use rayon::prelude::*;
use std::fs;
use trunnion_codegen::catalogue::MODELS;

#[test]
fn every_model_works_with_its_defaults() {
    MODELS.into_par_iter().for_each(|(model, _)| {
        let directory = tempfile::tempdir().unwrap();
        let at = directory.path();
        succeeds(at, &["simulate", model, "--out", "."]);
        let mut files: Vec<String> = fs::read_dir(at)
            .unwrap()
            .filter_map(|entry| entry.unwrap().file_name().into_string().ok())
            .filter(|name| name.ends_with(".csv"))
            .collect();
        files.sort();
        let table = files.iter().position(|name| name == "table.csv").map(|i| files.remove(i));
        let runs: Vec<String> = files.iter().map(|name| format!("{}={name}", name.trim_end_matches(".csv"))).collect();
        let mut arguments = vec!["fit", model, "--json"];
        arguments.extend(runs.iter().flat_map(|run| ["--run", run]));
        arguments.extend(table.iter().flat_map(|table| ["--table", table]));
        let fit = object(&succeeds(at, &arguments));
        assert!(fit["condition"].as_f64().unwrap() < 1000.0, "{model}");
        assert_eq!(fit["warnings"], serde_json::json!([]), "{model}");
        for function in fit["functions"].as_array().unwrap() {
            assert_eq!(function["determined"], true, "{model}: {}", function["name"]);
        }
        let drawn = object(&succeeds(at, &["monte-carlo", model, "--trials", "5", "--json"]));
        for study in drawn["studies"].as_array().unwrap() {
            assert_eq!(study["determined"], true, "{model}");
        }
        let plan = object(&succeeds(at, &["plan", model, "--json"]));
        let recommended = plan["recommended"].as_array().unwrap();
        assert_eq!(recommended.len(), fit["functions"].as_array().unwrap().len(), "{model}");
    });
    let listed = trunnion(std::env::temp_dir().as_path(), &["models"]);
    let listed = String::from_utf8(listed.stdout).unwrap();
    for (model, _) in MODELS {
        assert!(listed.lines().any(|line| line.starts_with(&format!("{model} "))), "{model}");
    }
}
