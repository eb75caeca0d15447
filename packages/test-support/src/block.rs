//! The block kernel as a host calls it, point by point in and out, with guards around every array.

use std::fmt::Debug;

use nalgebra::Matrix3;
use toron::Level;
use toron::Real;
use toron::law::block::{Points, Precision, components, components_mut};
use toron::law::interface::Law;
use toron::law::state::{ENERGIES, FAILURE_INDEX, HYPERELASTIC_STATE, INVARIANTS};
use toron::{Hyperelastic, Request};

/// A precision, with what the tests need of it beside.
pub trait Number: Precision + Default + Debug + nalgebra::Scalar {
    /// One part of rounding.
    const ROUNDING: f64;
    fn bits(self) -> u64;
    /// The number of the lowest bits.
    fn from_bits(bits: u64) -> Self;
}

impl Number for f64 {
    const ROUNDING: f64 = f64::EPSILON / 2.0;
    fn bits(self) -> u64 {
        self.to_bits()
    }
    fn from_bits(bits: u64) -> Self {
        f64::from_bits(bits)
    }
}

impl Number for f32 {
    const ROUNDING: f64 = f32::EPSILON as f64 / 2.0;
    fn bits(self) -> u64 {
        u64::from(self.to_bits())
    }
    fn from_bits(bits: u64) -> Self {
        f32::from_bits(bits as u32)
    }
}

/// What a point brings: columns of F, fibre direction, old state.
#[derive(Clone, Copy, Debug)]
pub struct Input<T> {
    pub f: [T; 9],
    pub fibre: [T; 3],
    pub old: [T; HYPERELASTIC_STATE],
}

impl<T: Number> Input<T> {
    /// A point that has seen nothing yet.
    pub fn fresh(f: [f64; 9], fibre: [f64; 3]) -> Self {
        Input { f: f.map(T::splat), fibre: fibre.map(T::splat), old: [T::default(); HYPERELASTIC_STATE] }
    }

    pub fn deformation_gradient(&self) -> Matrix3<T> {
        Matrix3::from_column_slice(&self.f)
    }
}

/// How many values a point gives back: stress 6, state 11, modes 24, wave speed 1.
pub const VALUES: usize = 42;
const STATE: usize = 6;
const MODES: usize = STATE + HYPERELASTIC_STATE;
const WAVE: usize = MODES + 24;

/// What a point gives back, bit by bit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Output {
    pub bits: [u64; VALUES],
    pub status: i32,
}

impl Output {
    pub fn values<T: Number>(&self) -> [f64; VALUES] {
        self.bits.map(|bits| T::from_bits(bits).into())
    }

    /// What the outputs asked for hold; the rest is 0.
    pub fn masked(mut self, asked: Asked) -> Output {
        for (c, bits) in self.bits.iter_mut().enumerate() {
            if !asked.value(c) {
                *bits = 0;
            }
        }
        self.status = if asked.status { self.status } else { 0 };
        self
    }

    /// What the scalar law says, with the fibre direction of the properties.
    pub fn scalar<T: Number>(law: &Hyperelastic<T>, input: &Input<T>, density: T) -> Output {
        Output::along(law, None, input, density)
    }

    /// What the scalar law says, with a fibre direction of the point's own.
    pub fn along<T: Number>(law: &Hyperelastic<T>, fibre: Option<[T; 3]>, input: &Input<T>, density: T) -> Output {
        let columns = std::array::from_fn(|j| std::array::from_fn(|i| input.f[3 * j + i]));
        let point = law.point_along(&columns, fibre, &input.old, Request::ALL);
        let speed = Real::sqrt(point.wave_modulus) / Real::sqrt(density);
        let values = [&point.stress[..], &point.state, point.modes.as_flattened(), &[speed]].concat();
        Output { bits: std::array::from_fn(|c| values[c].bits()), status: point.status }
    }
}

/// Which outputs the caller has room for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Asked {
    pub stress: bool,
    pub energies: bool,
    pub invariants: bool,
    pub failure: bool,
    pub modes: bool,
    pub wave_speed: bool,
    pub status: bool,
}

impl Asked {
    pub const ALL: Asked = Asked::from_bits(0x7f);
    /// What explicit hosts ask for, and two smaller requests: each has a kernel of its own.
    pub const USUAL: [Asked; 3] = [Asked::from_bits(0x4f), Asked::from_bits(0x43), Asked::from_bits(0x41)];

    /// One bit an output, in the order of the fields.
    pub const fn from_bits(bits: u8) -> Asked {
        Asked {
            stress: bits & 1 != 0,
            energies: bits & 2 != 0,
            invariants: bits & 4 != 0,
            failure: bits & 8 != 0,
            modes: bits & 16 != 0,
            wave_speed: bits & 32 != 0,
            status: bits & 64 != 0,
        }
    }

    /// Whether value `c` of the state is asked for.
    pub fn of_state(&self, c: usize) -> bool {
        self.value(STATE + c)
    }

    /// Whether value `c` of an output is asked for.
    fn value(&self, c: usize) -> bool {
        match c {
            0..STATE => self.stress,
            _ if c < STATE + INVARIANTS => self.energies,
            _ if c < STATE + FAILURE_INDEX => self.invariants,
            _ if c < MODES => self.failure,
            _ if c < WAVE => self.modes,
            _ => self.wave_speed,
        }
    }
}

/// Where the old state stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Old {
    /// In the arrays of the new one.
    InPlace,
    /// In arrays of its own.
    Apart,
    /// Nowhere: fresh.
    Null,
}

/// How a block is called.
#[derive(Clone, Copy, Debug)]
pub struct Call<T> {
    pub level: Level,
    pub asked: Asked,
    /// A fibre direction for each point, instead of the property.
    pub fibres: bool,
    pub old: Old,
    /// By how much the leading dimension exceeds the number of points.
    pub gap: usize,
    /// How far into its allocation each array begins, so that it stands on no boundary in particular.
    pub offset: usize,
    pub density: T,
}

impl<T: Number> Call<T> {
    pub fn new(level: Level) -> Self {
        Call {
            level,
            asked: Asked::ALL,
            fibres: false,
            old: Old::InPlace,
            gap: 0,
            offset: 0,
            density: T::splat(1351.4),
        }
    }
}

/// Fills what no point owns, and outputs beforehand: a NaN of its own, so that reading it shows too.
const GUARD: u64 = 0x7ff8_0000_7fc0_5a5a;
const GUARD_CODE: i32 = 0x5a5a_5a5a;

/// A component-major array in the midst of its allocation.
struct Array<T> {
    values: Vec<T>,
    offset: usize,
    stride: usize,
    /// The entries that belong to points.
    owned: Vec<bool>,
}

impl<T: Number> Array<T> {
    fn new(components: usize, n: usize, call: &Call<T>) -> Self {
        let (offset, stride) = (call.offset, n + call.gap);
        let length = offset + components * stride + 9;
        let mut owned = vec![false; length];
        for c in 0..components {
            owned[offset + c * stride..][..n].fill(true);
        }
        Array { values: vec![T::from_bits(GUARD); length], offset, stride, owned }
    }

    fn filled<const N: usize>(inputs: &[Input<T>], call: &Call<T>, row: impl Fn(&Input<T>) -> [T; N]) -> Self {
        let mut array = Array::new(N, inputs.len(), call);
        for (i, input) in inputs.iter().enumerate() {
            for (c, x) in row(input).into_iter().enumerate() {
                let at = array.at(c, i);
                array.values[at] = x;
            }
        }
        array
    }

    fn at(&self, component: usize, point: usize) -> usize {
        self.offset + component * self.stride + point
    }

    fn bits(&self, component: usize, point: usize) -> u64 {
        self.values[self.at(component, point)].bits()
    }

    /// From component `row` on; null unless wanted.
    fn pointer(&mut self, row: usize, wanted: bool) -> *mut T {
        let at = self.at(row, 0);
        if wanted { self.values.as_mut_ptr().wrapping_add(at) } else { std::ptr::null_mut() }
    }

    fn assert_guards(&self, what: &str, call: &Call<T>) {
        for (at, x) in self.values.iter().enumerate() {
            assert!(self.owned[at] || x.bits() == T::from_bits(GUARD).bits(), "{what}: wrote to entry {at}, {call:?}");
        }
    }
}

/// Runs a block and returns what every point gave back, and the worst code.
///
/// Inputs must come back untouched, and so must whatever stands between, before and behind the components.
pub fn run<T: Number>(law: &Hyperelastic<T>, inputs: &[Input<T>], call: &Call<T>) -> (Vec<Output>, i32) {
    let n = inputs.len();
    let (stride, asked) = (n + call.gap, call.asked);
    let mut gradient = Array::filled(inputs, call, |input| input.f);
    let mut fibre = Array::filled(inputs, call, |input| input.fibre);
    let mut old = Array::filled(inputs, call, |input| input.old);
    let mut state = match call.old {
        Old::InPlace => Array::filled(inputs, call, |input| input.old),
        _ => Array::new(HYPERELASTIC_STATE, n, call),
    };
    let [mut stress, mut modes, mut wave] = [6, 24, 1].map(|components| Array::new(components, n, call));
    let mut codes = vec![GUARD_CODE; call.offset + n + 9];

    let [energies, invariants, failure] =
        [(ENERGIES, asked.energies), (INVARIANTS, asked.invariants), (FAILURE_INDEX, asked.failure)]
            .map(|(row, wanted)| state.pointer(row, wanted));
    let [energies_old, invariants_old, failure_old] = match call.old {
        Old::InPlace => [energies, invariants, failure],
        Old::Apart => [ENERGIES, INVARIANTS, FAILURE_INDEX].map(|row| old.pointer(row, true)),
        Old::Null => [std::ptr::null_mut(); 3],
    };
    let block = Points {
        f_new: components(gradient.pointer(0, true), stride),
        fibre: components(fibre.pointer(0, call.fibres), stride),
        state_old: [energies_old, invariants_old, failure_old].map(<*mut T>::cast_const),
        density: call.density,
        stress: components_mut(stress.pointer(0, asked.stress), stride),
        state_new: [energies, invariants, failure],
        modes: modes.pointer(0, asked.modes),
        wave_speed: wave.pointer(0, asked.wave_speed),
        status: if asked.status { codes[call.offset..].as_mut_ptr() } else { std::ptr::null_mut() },
        level: Some(call.level),
        ..Points::without_arrays(n, stride)
    };
    // SAFETY: every array has its components with this leading dimension, and only the state may stand twice.
    let worst = unsafe { law.step(&block) }.expect("a good call");

    let outputs = (0..n).map(|i| Output {
        bits: std::array::from_fn(|c| match c {
            0..STATE => stress.bits(c, i),
            _ if c < MODES => state.bits(c - STATE, i),
            _ if c < WAVE => modes.bits(c - MODES, i),
            _ => wave.bits(0, i),
        }),
        status: codes[call.offset + i],
    });
    let outputs = outputs.map(|output| output.masked(asked)).collect();
    for (array, what) in [(&gradient, "F"), (&fibre, "fibre"), (&old, "old state"), (&stress, "stress")]
        .into_iter()
        .chain([(&state, "state"), (&modes, "modes"), (&wave, "wave speed")])
    {
        array.assert_guards(what, call);
    }
    for (i, input) in inputs.iter().enumerate() {
        assert!((0..9).all(|c| gradient.bits(c, i) == input.f[c].bits()), "F of point {i} changed, {call:?}");
        assert!((0..3).all(|c| fibre.bits(c, i) == input.fibre[c].bits()), "fibre of point {i} changed, {call:?}");
        assert!((0..11).all(|c| old.bits(c, i) == input.old[c].bits()), "old state of point {i} changed, {call:?}");
    }
    let beside = codes[..call.offset].iter().chain(&codes[call.offset + n..]);
    assert!(beside.into_iter().all(|&code| code == GUARD_CODE), "wrote beside the codes, {call:?}");
    (outputs, worst)
}

/// The levels that this machine has, from the lowest.
pub fn levels() -> impl Iterator<Item = Level> {
    Level::ALL.into_iter().filter(|&level| level <= Level::best())
}
