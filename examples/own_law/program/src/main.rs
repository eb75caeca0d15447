//! A program for the reinforced solid: `reinforced run`, `params`, `deck`, `eval`, `header` and `bench`.

fn main() -> std::process::ExitCode {
    toron_materials::of_law::<reinforced_solid::ReinforcedSolid>("REINFORCED", 3)
}
