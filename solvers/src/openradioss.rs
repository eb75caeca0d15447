//! openradioss.

#[doc(hidden)]
#[macro_export]
macro_rules! openradioss {
    ($t:ident; $($law:ty as $name:literal, user $number:literal;)+) => {};
}
