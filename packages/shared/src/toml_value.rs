//! A value of a TOML file read as a type. toml's own deserializers are three, for a file, a table and a value, and a
//! struct of many keys would be compiled for each of them, and for each way to look at a value; here it is compiled once.

use std::fmt::{self, Display};
use std::ops::Range;
use std::slice;

use serde::de::value::StrDeserializer;
use serde::de::{
    DeserializeSeed, Deserializer, Error as _, Expected, IntoDeserializer, MapAccess, SeqAccess, Unexpected, Visitor,
};
use serde_spanned::de::{SpannedDeserializer, is_spanned};
use toml::Spanned;
use toml::de::{DeFloat, DeInteger, DeString, DeValue};
use toml::map;

/// What is wrong with a value, and the innermost place that is known.
#[derive(Debug)]
pub struct Wrong {
    pub place: Option<Range<usize>>,
    pub message: String,
}

impl Wrong {
    fn at(self, place: Range<usize>) -> Wrong {
        Wrong { place: self.place.or(Some(place)), ..self }
    }
}

impl Display for Wrong {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Wrong {}

impl serde::de::Error for Wrong {
    fn custom<T: Display>(message: T) -> Wrong {
        Wrong { place: None, message: message.to_string() }
    }
}

/// A value, from which a type is deserialized.
#[derive(Clone, Copy)]
pub struct Value<'a, 't>(pub &'a Spanned<DeValue<'t>>);

impl Value<'_, '_> {
    /// # Errors
    /// It is not what the visitor wants.
    fn is_not(&self, expected: &dyn Expected) -> Wrong {
        let found = match self.0.get_ref() {
            DeValue::String(text) => Unexpected::Str(text),
            DeValue::Integer(number) => match integer(number) {
                Some(number) => Unexpected::Signed(number),
                None => Unexpected::Other("an integer of more than 64 bits"),
            },
            DeValue::Float(number) => match float(number) {
                Some(number) => Unexpected::Float(number),
                None => Unexpected::Other("a number beyond the largest"),
            },
            DeValue::Boolean(value) => Unexpected::Bool(*value),
            DeValue::Datetime(_) => Unexpected::Other("a date"),
            DeValue::Array(_) => Unexpected::Seq,
            DeValue::Table(_) => Unexpected::Map,
        };
        Wrong::invalid_type(found, expected).at(self.0.span())
    }

    fn number<'de, V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Wrong> {
        match self.0.get_ref() {
            DeValue::Integer(number) => match (integer(number), u64::from_str_radix(number.as_str(), number.radix())) {
                (Some(number), _) => visitor.visit_i64(number),
                (None, Ok(number)) => visitor.visit_u64(number),
                (None, Err(_)) => Err(self.is_not(&visitor)),
            },
            DeValue::Float(number) => match float(number) {
                Some(number) => visitor.visit_f64(number),
                None => Err(self.is_not(&visitor)),
            },
            _ => Err(self.is_not(&visitor)),
        }
        .map_err(|wrong| wrong.at(self.0.span()))
    }
}

fn integer(number: &DeInteger) -> Option<i64> {
    i64::from_str_radix(number.as_str(), number.radix()).ok()
}

/// None is a number that is written with digits and beyond the largest.
fn float(number: &DeFloat) -> Option<f64> {
    let text = number.as_str();
    text.parse().ok().filter(|value: &f64| !value.is_infinite() || text.contains("inf"))
}

/// Methods of a [`Deserializer`] that do what another one does.
macro_rules! as_another {
    ($($method:ident $(($($argument:ty),*))? => $other:ident;)*) => {$(
        fn $method<V: Visitor<'de>>(self, $($(_: $argument,)*)? visitor: V) -> Result<V::Value, Wrong> {
            self.$other(visitor)
        }
    )*};
}

impl<'de> Deserializer<'de> for Value<'_, '_> {
    type Error = Wrong;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Wrong> {
        match self.0.get_ref() {
            DeValue::String(_) => self.deserialize_str(visitor),
            DeValue::Integer(_) | DeValue::Float(_) => self.number(visitor),
            DeValue::Boolean(_) => self.deserialize_bool(visitor),
            DeValue::Datetime(_) => Err(self.is_not(&visitor)),
            DeValue::Array(_) => self.deserialize_seq(visitor),
            DeValue::Table(_) => self.deserialize_map(visitor),
        }
    }

    fn deserialize_bool<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Wrong> {
        let DeValue::Boolean(value) = self.0.get_ref() else { return Err(self.is_not(&visitor)) };
        visitor.visit_bool(*value).map_err(|wrong: Wrong| wrong.at(self.0.span()))
    }

    fn deserialize_str<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Wrong> {
        let DeValue::String(text) = self.0.get_ref() else { return Err(self.is_not(&visitor)) };
        visitor.visit_str(text).map_err(|wrong: Wrong| wrong.at(self.0.span()))
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Wrong> {
        visitor.visit_some(self)
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(self, _: &'static str, visitor: V) -> Result<V::Value, Wrong> {
        visitor.visit_newtype_struct(self).map_err(|wrong| wrong.at(self.0.span()))
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Wrong> {
        let DeValue::Array(entries) = self.0.get_ref() else { return Err(self.is_not(&visitor)) };
        visitor.visit_seq(Entries(entries.iter())).map_err(|wrong| wrong.at(self.0.span()))
    }

    fn deserialize_map<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Wrong> {
        let DeValue::Table(table) = self.0.get_ref() else { return Err(self.is_not(&visitor)) };
        let keys = Keys { keys: table.iter(), value: None };
        visitor.visit_map(keys).map_err(|wrong| wrong.at(self.0.span()))
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Wrong> {
        match is_spanned(name) {
            true => visitor.visit_map(SpannedDeserializer::new(self, self.0.span())),
            false => self.deserialize_map(visitor),
        }
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Wrong> {
        let DeValue::String(text) = self.0.get_ref() else { return Err(self.is_not(&"a word in quotes")) };
        visitor.visit_enum(StrDeserializer::new(text)).map_err(|wrong: Wrong| wrong.at(self.0.span()))
    }

    fn deserialize_ignored_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Wrong> {
        visitor.visit_unit()
    }

    as_another! {
        deserialize_i8 => number;
        deserialize_i16 => number;
        deserialize_i32 => number;
        deserialize_i64 => number;
        deserialize_u8 => number;
        deserialize_u16 => number;
        deserialize_u32 => number;
        deserialize_u64 => number;
        deserialize_f32 => number;
        deserialize_f64 => number;
        deserialize_char => deserialize_str;
        deserialize_string => deserialize_str;
        deserialize_identifier => deserialize_str;
        deserialize_tuple(usize) => deserialize_seq;
        deserialize_tuple_struct(&'static str, usize) => deserialize_seq;
        deserialize_bytes => deserialize_any;
        deserialize_byte_buf => deserialize_any;
        deserialize_unit => deserialize_any;
        deserialize_unit_struct(&'static str) => deserialize_any;
    }
}

impl IntoDeserializer<'_, Wrong> for Value<'_, '_> {
    type Deserializer = Self;

    fn into_deserializer(self) -> Self {
        self
    }
}

/// The entries of a list.
struct Entries<'a, 't>(slice::Iter<'a, Spanned<DeValue<'t>>>);

impl<'de> SeqAccess<'de> for Entries<'_, '_> {
    type Error = Wrong;

    fn next_element_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<Option<S::Value>, Wrong> {
        let Some(entry) = self.0.next() else { return Ok(None) };
        // What is wrong with a value of the right type is the list's: `half is [1, 0]; allowed: each a number > 0`.
        seed.deserialize(Value(entry)).map(Some)
    }

    fn size_hint(&self) -> Option<usize> {
        Some(self.0.len())
    }
}

/// The keys of a table, and the value of the last one.
struct Keys<'a, 't> {
    keys: map::Iter<'a, Spanned<DeString<'t>>, Spanned<DeValue<'t>>>,
    value: Option<&'a Spanned<DeValue<'t>>>,
}

impl<'de> MapAccess<'de> for Keys<'_, '_> {
    type Error = Wrong;

    fn next_key_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<Option<S::Value>, Wrong> {
        let Some((key, value)) = self.keys.next() else { return Ok(None) };
        self.value = Some(value);
        seed.deserialize(Key(key)).map(Some).map_err(|wrong| wrong.at(key.span()))
    }

    fn next_value_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<S::Value, Wrong> {
        let value = self.value.take().ok_or_else(|| Wrong::custom("a value without its key"))?;
        seed.deserialize(Value(value)).map_err(|wrong| wrong.at(value.span()))
    }
}

/// A key, which may be asked for its place.
#[derive(Clone, Copy)]
struct Key<'a, 't>(&'a Spanned<DeString<'t>>);

impl<'de> Deserializer<'de> for Key<'_, '_> {
    type Error = Wrong;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Wrong> {
        visitor.visit_str(self.0.get_ref())
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Wrong> {
        match is_spanned(name) {
            true => visitor.visit_map(SpannedDeserializer::new(&**self.0.get_ref(), self.0.span())),
            false => self.deserialize_any(visitor),
        }
    }

    serde::forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf option unit unit_struct
        newtype_struct seq tuple tuple_struct map enum identifier ignored_any
    }
}
