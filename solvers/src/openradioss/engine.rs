//! The engine's five calls for a group of elements.

use std::cell::Cell;
use std::ffi::c_char;
use std::ptr::{null, null_mut};
use std::thread::LocalKey;

use toron::host::constants::TORON_MESSAGE_CAPACITY;
use toron::host::openradioss::{Group, Laws, MyReal, group_of_f32, group_of_f64, needs_nodes};

use super::solver::{coordinates_of_nodes, stop};

/// What the first calls pass.
#[derive(Clone, Copy)]
pub struct Remembered<T> {
    group: Group<T>,
    /// The number of the material in the model, and nn of `/MAT/USERnn`.
    material: i32,
    number: i32,
    /// NCYCLE.
    cycle: i32,
}

impl<T: MyReal> Remembered<T> {
    fn nothing() -> Self {
        let group = Group {
            elements: 0,
            parameters: 0,
            variables: 0,
            time: T::splat(0.0),
            time_step: T::splat(0.0),
            uparam: null(),
            numbers: null(),
            density: null(),
            deformation_gradient: [null(); 9],
            stress: [null_mut(); 6],
            viscous: [null_mut(); 6],
            sound_speed: null_mut(),
            viscosity: null_mut(),
            uvar: null_mut(),
            off: null_mut(),
            nodes: null(),
            volume: null(),
        };
        Remembered { group, material: 0, number: 0, cycle: 0 }
    }
}

/// The solver's real numbers, in this library's calls.
pub trait Engine: MyReal {
    /// Between the first and the fourth call of a group on this thread.
    fn remembered() -> &'static LocalKey<Cell<Option<Remembered<Self>>>>;

    /// The entry for a group.
    const EVALUATE: unsafe fn(&Laws<Self>, &Group<Self>, *mut c_char, usize) -> i32;
}

macro_rules! engines {
    ($($t:ty: $evaluate:path;)*) => {$(
        impl Engine for $t {
            fn remembered() -> &'static LocalKey<Cell<Option<Remembered<$t>>>> {
                thread_local! {
                    static REMEMBERED: Cell<Option<Remembered<$t>>> = const { Cell::new(None) };
                }
                &REMEMBERED
            }

            const EVALUATE: unsafe fn(&Laws<$t>, &Group<$t>, *mut c_char, usize) -> i32 = $evaluate;
        }
    )*};
}

engines! {
    f64: group_of_f64;
    f32: group_of_f32;
}

fn remember<T: Engine>(change: impl FnOnce(&mut Remembered<T>)) {
    let mut remembered = T::remembered().get().unwrap_or_else(Remembered::nothing);
    change(&mut remembered);
    T::remembered().set(Some(remembered));
}

/// The first call.
pub fn begin<T: Engine>(cycle: i32, material: i32, density: *const T) {
    let nothing = Remembered::nothing();
    let group = Group { density, ..nothing.group };
    T::remembered().set(Some(Remembered { cycle, material, group, ..nothing }));
}

/// The second call.
pub fn deform<T: Engine>(deformation_gradient: [*const T; 9]) {
    remember(|call| call.group.deformation_gradient = deformation_gradient);
}

/// The third call: `number` is nn, and `fill` sets counts and arrays.
pub fn group<T: Engine>(number: i32, fill: impl FnOnce(&mut Group<T>)) {
    remember(|call| {
        call.number = number;
        fill(&mut call.group);
    });
}

/// The fourth call.
///
/// # Safety
/// The arrays have the solver's vector length, and those of the calls before are still valid.
pub unsafe fn evaluate<T: Engine>(laws: &Laws<T>, stress: [*mut T; 6]) {
    let Remembered { group, material, number, cycle } = T::remembered().take().unwrap_or_else(Remembered::nothing);
    let group = Group { stress, ..group };
    let elements = usize::try_from(group.elements).unwrap_or(0);
    let coordinates = if needs_nodes(cycle) { coordinates_of_nodes::<T>(elements) } else { Vec::new() };
    let nodes = if coordinates.is_empty() { null() } else { coordinates.as_ptr() };
    let group = Group { nodes, ..group };
    let mut text = [0_u8; TORON_MESSAGE_CAPACITY];
    // SAFETY: the same; the text has the size passed.
    let status = unsafe { T::EVALUATE(laws, &group, text.as_mut_ptr().cast::<c_char>(), text.len()) };
    if status < 0 {
        let text = text.split(|&byte| byte == 0).next().unwrap_or_default();
        stop(&format!("/MAT/USER{number:02}/{material}: {}", String::from_utf8_lossy(text)));
    }
}
