//! Commands that a user may copy into a shell.

use std::path::Path;

/// The words as a shell takes them: one with blanks or signs of the shell in quotes.
pub fn command(words: &[String]) -> String {
    words.iter().map(|text| word(text)).collect::<Vec<_>>().join(" ")
}

/// The command that goes on with a run of this scene into this directory, with these options.
pub fn again(name: &str, scene: &Path, output: &Path, options: &[String]) -> String {
    let [scene, output] = [scene, output].map(|path| path.display().to_string());
    let words = ["toron", name, &scene, "-o", &output, "--restart"].map(str::to_string);
    command(&[&words[..], options].concat())
}

fn word(text: &str) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || "-_./:=,+@%".contains(c);
    if !text.is_empty() && text.chars().all(is_plain) {
        return text.to_string();
    }
    format!("'{}'", text.replace('\'', r"'\''"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_quoted_where_a_shell_would_split_them() {
        let words = ["toron", "a b", "it's", "", "x-1/y.toml", "$HOME"].map(str::to_string);
        assert_eq!(command(&words), r"toron 'a b' 'it'\''s' '' x-1/y.toml '$HOME'");
    }
}
