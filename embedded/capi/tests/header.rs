//! The header is the one that the source gives. `UPDATE_HEADER=1` rewrites it.

use std::{env, fs, path::Path};

#[test]
fn header_is_current() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let config = cbindgen::Config::from_file(root.join("cbindgen.toml")).unwrap();
    let sources = ["status", "estimate", "joint", "two_step"];
    let builder = sources.iter().fold(cbindgen::Builder::new().with_config(config), |builder, name| {
        builder.with_src(root.join(format!("src/{name}.rs")))
    });
    let mut header = Vec::new();
    builder.generate().unwrap().write(&mut header);
    let (header, path) = (String::from_utf8(header).unwrap(), root.join("include/trunnion.h"));
    if env::var_os("UPDATE_HEADER").is_some() {
        fs::write(&path, &header).unwrap();
    }
    assert!(fs::read_to_string(path).unwrap() == header, "UPDATE_HEADER=1 rewrites include/trunnion.h");
}
