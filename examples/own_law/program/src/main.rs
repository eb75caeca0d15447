//! A program for the reinforced solid: `reinforced run`, `impact`, `fabric`, `params`, `deck`, `eval`,
//! `header` and `bench`.

fn main() -> std::process::ExitCode {
    toron_strikes::of_law::<reinforced_solid::ReinforcedSolid>("REINFORCED", 3)
}
