//! c.

#[doc(hidden)]
#[macro_export]
macro_rules! c {
    ($t:ident; $($law:ty as $name:literal, user $number:literal;)+) => {};
}
