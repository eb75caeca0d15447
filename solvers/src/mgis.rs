//! mgis.

#[doc(hidden)]
#[macro_export]
macro_rules! mgis {
    ($t:ident; $($law:ty as $name:literal, user $number:literal;)+) => {};
}
