//! abaqus.

#[doc(hidden)]
#[macro_export]
macro_rules! abaqus {
    ($t:ident; $($law:ty as $name:literal, user $number:literal;)+) => {};
}
