//! What every model derives to, as people read it; the files are in the repository's `snapshots/`.

use super::numbers::derived;
use trunnion_codegen::catalogue::MODELS;
use trunnion_codegen::emit::equations;

#[test]
fn equations_of_every_model() {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("../../../snapshots");
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| {
        for (name, _) in MODELS {
            let (model, derivation) = derived(name);
            insta::assert_snapshot!(format!("{name}.text"), equations::text(&model, &derivation));
            insta::assert_snapshot!(format!("{name}.latex"), equations::latex(&model, &derivation));
        }
    });
}
