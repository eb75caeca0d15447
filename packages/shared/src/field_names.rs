//! The keys of a table that is read as a struct.

use serde::de::value::Error;
use serde::de::{DeserializeOwned, Deserializer, Error as _, Visitor};

/// The names of the struct's fields, as files have them.
pub fn field_names<T: DeserializeOwned>() -> &'static [&'static str] {
    let mut asked = AskedFields(&[]);
    // Deserialising fails, since there is no value; but before that serde passes the names of the struct's fields.
    let _ = T::deserialize(&mut asked);
    asked.0
}

/// A deserializer without data, which keeps the names of the fields that a struct asks for.
struct AskedFields(&'static [&'static str]);

impl<'de> Deserializer<'de> for &mut AskedFields {
    type Error = Error;

    fn deserialize_any<V: Visitor<'de>>(self, _: V) -> Result<V::Value, Error> {
        Err(Error::custom("no value"))
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        fields: &'static [&'static str],
        _: V,
    ) -> Result<V::Value, Error> {
        self.0 = fields;
        Err(Error::custom("no value"))
    }

    serde::forward_to_deserialize_any! {
        bool i8 i16 i32 i64 u8 u16 u32 u64 f32 f64 char str string bytes byte_buf option unit unit_struct
        newtype_struct seq tuple tuple_struct map enum identifier ignored_any
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_are_called_as_in_the_file() {
        #[derive(serde::Deserialize)]
        #[serde(rename_all = "kebab-case")]
        #[expect(dead_code, reason = "only its names are asked for")]
        struct Keys {
            half_length: Option<f64>,
            #[serde(rename = "box")]
            walls: bool,
        }
        assert_eq!(field_names::<Keys>(), ["half-length", "box"]);
        assert!(field_names::<f64>().is_empty());
    }
}
