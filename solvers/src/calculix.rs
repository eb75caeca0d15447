//! calculix.

#[doc(hidden)]
#[macro_export]
macro_rules! calculix {
    ($t:ident; $($law:ty as $name:literal, user $number:literal;)+) => {};
}
