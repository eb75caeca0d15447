use toron::driver::eval::{Entry, evaluate};
fn main() {
    let a = std::env::args().nth(1).unwrap();
    let e = match a.as_str() {
        "law" => Entry::Law,
        "block" => Entry::Block,
        "block-f32" => Entry::BlockF32,
        "umat" => Entry::Umat,
        "vumat" => Entry::Vumat,
        "vumat-sp" => Entry::VumatSp,
        "ls-dyna" => Entry::LsDyna,
        _ => Entry::LsDynaVector,
    };
    evaluate(e, std::io::stdin().lock(), std::io::stdout().lock()).unwrap();
}
