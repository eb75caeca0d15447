//! JSON schemas of the types that files are read as, with the feature `schema`. A key's meaning is its field's
//! comment, its bounds and words are its type's.

use std::borrow::Cow;
use std::marker::PhantomData;
use std::ops::Bound::{Excluded, Included, Unbounded};

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::DeserializeOwned;
pub use serde_json::Value as Anything;
use serde_json::Value;

use super::checked::{Bound, Number, Whole};
use super::field_names::field_names;
use super::spanned::Spanned;
use super::toml_file::Numbers;

/// Where a table's schema has the names of its keys in the order of the fields.
pub const ORDER: &str = "x-order";

/// Gives the schema of this struct the order of its fields.
pub fn order<T: DeserializeOwned>(schema: &mut Schema) {
    schema.insert(ORDER.to_string(), field_names::<T>().into());
}

/// Takes keys out of a table's schema.
pub fn without(keys: &'static [&str]) -> impl Fn(&mut Schema) {
    move |schema| {
        if let Some(Value::Object(properties)) = schema.get_mut("properties") {
            properties.retain(|key, _| !keys.contains(&key.as_str()));
        }
        if let Some(Value::Array(order)) = schema.get_mut(ORDER) {
            order.retain(|key| !keys.iter().any(|taken| key == taken));
        }
    }
}

/// Has the tables of a list need their names.
pub fn named(schema: &mut Schema) {
    if let Some(Value::Object(table)) = schema.get_mut("items") {
        table.insert("required".to_string(), ["name"].as_slice().into());
    }
}

/// A table whose keys are those of two structs, and no others.
pub struct Both<A, B>(PhantomData<(A, B)>);

impl<A: JsonSchema, B: JsonSchema> JsonSchema for Both<A, B> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        format!("{} and {}", A::schema_name(), B::schema_name()).into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let mut both = A::json_schema(generator);
        let mut other = B::json_schema(generator);
        for part in ["properties", ORDER] {
            match (both.get_mut(part), other.get_mut(part)) {
                (Some(Value::Object(both)), Some(Value::Object(other))) => both.append(other),
                (Some(Value::Array(both)), Some(Value::Array(other))) => both.append(other),
                _ => unreachable!("structs have properties, in an order"),
            }
        }
        both.insert("additionalProperties".to_string(), false.into());
        both.remove("description");
        both
    }
}

impl<T: JsonSchema> JsonSchema for Spanned<T> {
    fn inline_schema() -> bool {
        T::inline_schema()
    }

    fn schema_name() -> Cow<'static, str> {
        T::schema_name()
    }

    fn schema_id() -> Cow<'static, str> {
        T::schema_id()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        T::json_schema(generator)
    }
}

impl<B: Bound> JsonSchema for Number<B> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        B::ALLOWED.into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let mut schema = json_schema!({ "type": "number" });
        let (least, most) = B::LIMITS;
        for (bound, included, excluded) in
            [(least, "minimum", "exclusiveMinimum"), (most, "maximum", "exclusiveMaximum")]
        {
            match bound {
                Included(bound) => schema.insert(included.to_string(), bound.into()),
                Excluded(bound) if bound.is_finite() => schema.insert(excluded.to_string(), bound.into()),
                Excluded(_) | Unbounded => None,
            };
        }
        schema
    }
}

impl<const LEAST: usize, const MOST: usize> JsonSchema for Whole<LEAST, MOST> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        format!("Whole from {LEAST} to {MOST}").into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "integer", "minimum": LEAST, "maximum": MOST })
    }
}

impl<const N: usize, T: JsonSchema> JsonSchema for Numbers<N, T> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        format!("{N} of {}", T::schema_name()).into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let entry = generator.subschema_for::<T>();
        json_schema!({ "type": "array", "items": entry, "minItems": N, "maxItems": N })
    }
}
