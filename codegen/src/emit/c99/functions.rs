//! The model's own functions: a push for each run, a value for each estimated function.

use super::file::File;
use super::{c, model};
use crate::emit::function::{Function, Input};
use crate::emit::layout::{listed, prose};
use crate::emit::model::EstimatedFunction;
use crate::graph::Unbound;
use crate::identify::Derivation;
use crate::ids::{FunctionId, RunId};
use crate::model::Model;

/// What goes into the header, and what into the source.
#[derive(Default)]
pub(super) struct Printed {
    pub declarations: String,
    pub definitions: String,
    pub pushes: Vec<Push>,
    pub values: Vec<Value>,
}

/// The function that takes a sample of a run: the fit, `inputs`, the reading, the known functions there.
pub(in crate::emit) struct Push {
    pub run: RunId,
    pub called: String,
    pub inputs: Vec<Input>,
}

/// The function that evaluates an estimated function: the estimate, the lengths, the coordinate unless it is a location
/// error, where value and standard deviation go.
pub(in crate::emit) struct Value {
    pub function: FunctionId,
    pub called: String,
}

pub(super) fn functions(model: &Model, derivation: &Derivation, file: &mut File) -> Result<Printed, Unbound> {
    let mut printed = Printed::default();
    for (at, run) in derivation.runs.iter_enumerated() {
        if !run.regressors.is_empty() {
            let function = model::run(model, derivation, at)?;
            push(&mut printed, model, derivation, at, &function, file);
        }
    }
    for function in model::estimated(model, derivation)? {
        value(&mut printed, function, file);
    }
    Ok(printed)
}

/// A function of this file alone.
fn internal(file: &File, function: &Function, called: &str) -> String {
    format!(
        "\n{}",
        c::function_in(&file.scope, function, called, &file.dialect).replacen("\nvoid ", "\nstatic void ", 1)
    )
}

fn push(
    printed: &mut Printed,
    model: &Model,
    derivation: &Derivation,
    at: RunId,
    function: &Function,
    file: &mut File,
) {
    let run = &derivation.runs[at];
    let (row, push) = (file.claim("row_of", &run.name), file.claim("push", &run.name));
    let (prefix, upper, kind) = (&file.prefix, file.upper(), file.dialect.real.name());
    let mut locals = file.scope.clone();
    let inputs: Vec<String> = function.inputs.iter().map(|input| locals.claim(&input.name)).collect();
    let [fit, reading] = ["fit", "reading"].map(|name| locals.claim(name));
    let error = |f: FunctionId| model.alphabet.error_name(model.functions[f].error);
    let known: Vec<String> = run.known.iter().map(|(f, _)| locals.claim(error(*f))).collect();
    let [place, seen, all, factors, i] = ["place", "seen", "row", "factors", "i"].map(|name| locals.claim(name));

    let values = inputs.iter().chain([&reading]).chain(&known).map(|name| format!("{kind} {name}"));
    let parameters: Vec<String> = [format!("{prefix}_fit *{fit}")].into_iter().chain(values).collect();
    let signature = listed(&format!("{prefix}_status {push}("), &parameters, ")", 4);
    let ways = if model::motion(model, at).is_empty() { "" } else { ", how axes move" };
    let also = if known.is_empty() { "" } else { ", the known functions there (mm or rad)" };
    let told = format!("Takes a sample of run `{}`: lengths (mm), sweep (rad){ways}, reading (mm){also}. */", run.name);
    printed.declarations += &format!("\n{}\n{signature};\n", prose("/* ", &told, 3));

    let n = run.regressors.len();
    let places: Vec<String> = run.regressors.iter().map(|(base, _)| base.to_string()).collect();
    let mut arguments = inputs;
    arguments.push(seen.clone());
    printed.definitions += &internal(file, function, &row);
    printed.definitions += &format!("\n{signature}\n{{\n");
    printed.definitions += &listed(&format!("    static const unsigned short {place}[{n}] = {{"), &places, "};\n", 8);
    printed.definitions += &format!("    {kind} {seen}[{n}], {all}[{upper}_UNKNOWNS] = {{0}};\n");
    if !known.is_empty() {
        printed.definitions += &format!("    {kind} {factors}[{}];\n", known.len());
        arguments.push(factors.clone());
    }
    printed.definitions += &format!("    int {i};\n\n");
    printed.definitions += &listed(&format!("    {row}("), &arguments, ");\n", 8);
    printed.definitions +=
        &format!("    for ({i} = 0; {i} < {n}; {i}++) {{\n        {all}[{place}[{i}]] = {seen}[{i}];\n    }}\n");
    for (at, known) in known.iter().enumerate() {
        printed.definitions += &format!("    {reading} -= {factors}[{at}] * {known};\n");
    }
    printed.definitions += &format!("    return {prefix}_push({fit}, {all}, {reading}, 1);\n}}\n");
    printed.pushes.push(Push { run: at, called: push, inputs: function.inputs.clone() });
}

fn value(printed: &mut Printed, estimated: EstimatedFunction, file: &mut File) {
    let located = estimated.coordinate().is_none();
    let EstimatedFunction { function: of, basis: function, base: places } = estimated;
    let n = places.len();
    let (basis, called) = (file.claim("basis_of", &function.name), file.claim("value_of", &function.name));
    let (prefix, upper, real) = (&file.prefix, file.upper(), file.dialect.real);
    let kind = real.name();
    let mut locals = file.scope.clone();
    let inputs: Vec<String> = function.inputs.iter().map(|input| locals.claim(&input.name)).collect();
    let [estimate, value, std, place, at, sum, variance, i, j] =
        ["estimate", "value", "std", "place", "at", "sum", "variance", "i", "j"].map(|name| locals.claim(name));
    let values = inputs.iter().map(|name| format!("{kind} {name}"));
    let first = format!("const {prefix}_estimate *{estimate}");
    let results = [format!("{kind} *{value}"), format!("{kind} *{std}")];
    let parameters: Vec<String> = [first].into_iter().chain(values).chain(results).collect();
    let signature = listed(&format!("{prefix}_status {called}("), &parameters, ")", 4);
    let told = if located {
        "The location error, and its standard deviation."
    } else {
        "The estimated function at a coordinate, and its standard deviation there."
    };
    printed.declarations += &format!("\n/* {told} */\n{signature};\n");
    let places: Vec<String> = places.iter().map(ToString::to_string).collect();
    let places = listed(&format!("    static const unsigned short {place}[{n}] = {{"), &places, "};", 8);
    let arguments: Vec<String> = inputs.iter().chain([&at]).cloned().collect();
    let call = listed(&format!("    {basis}("), &arguments, ");", 8);
    let root = real.pick("sqrt", "sqrtf");
    printed.definitions += &internal(file, &function, &basis);
    printed.definitions += &format!(
        "
{signature}
{{
{places}
    {kind} {at}[{n}], {sum} = 0, {variance} = 0;
    int {i}, {j};

    if (!{estimate} || !{value} || !{std}) {{
        return {upper}_NULL_POINTER;
    }}
    if ({estimate}->mark != {upper}_ESTIMATE_MARK) {{
        return {upper}_NOT_INITIALISED;
    }}
{call}
    for ({i} = 0; {i} < {n}; {i}++) {{
        {sum} += {at}[{i}] * {estimate}->value[{place}[{i}]];
        for ({j} = 0; {j} < {n}; {j}++) {{
            {variance} += {at}[{i}] * {estimate}->covariance[{place}[{i}]][{place}[{j}]] * {at}[{j}];
        }}
    }}
    if (!isfinite({sum}) || !isfinite({variance})) {{
        return {upper}_NOT_FINITE;
    }}
    *{value} = {sum};
    /* Rounding can take a vanishing variance below zero. */
    *{std} = {variance} > 0 ? {root}({variance}) : 0;
    return {upper}_OK;
}}
"
    );
    printed.values.push(Value { function: of, called });
}
