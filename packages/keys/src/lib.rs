//! Schemas of the TOML files and the tables of their keys in the reference, both out of the types that read the files:
//! a key is declared where its field stands, and nowhere else. `cargo xtask update keys` writes them.
//!
//! A field's comment is one text for schema, page and source. It ends with `Default: VALUE.` where the reader has one,
//! or `Required.` where a case or its scene must have the key. Links in it are relative to `docs/`.

pub mod check;
pub mod page;
pub mod schema;
