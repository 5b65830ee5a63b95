fn main() -> Result<(), trunnion_codegen::build::Failed> {
    trunnion_codegen::build::model("rotary-table.toml")
}
