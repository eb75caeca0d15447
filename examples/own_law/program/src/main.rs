//! A program for the reinforced solid: `reinforced run`, `params`, `deck`, `eval` and `header`.

fn main() -> std::process::ExitCode {
    toron_program::of_law::<reinforced_solid::ReinforcedSolid>("REINFORCED", 3)
}
