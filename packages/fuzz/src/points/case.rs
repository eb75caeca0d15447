//! A case: what a caller passes to an entry, as plain numbers, and a random one of a seed.

use fastrand::Rng;
use nalgebra::Matrix3;

use super::random::{any_rotation, between, direction, gradient, hostile, one_in, power_of_ten};

/// The laws of the library.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Law {
    Hyperelastic,
    Frictional,
    Linear,
}

pub const LAWS: [Law; 3] = [Law::Hyperelastic, Law::Frictional, Law::Linear];

impl Law {
    pub fn properties(self) -> usize {
        [11, 13, 10][self as usize]
    }

    pub fn state(self) -> usize {
        [11, 15, 10][self as usize]
    }

    /// The place of the latch in the state; the flag of deletion follows it.
    pub fn failed(self) -> usize {
        self.state() - 2
    }

    /// How many entries of F a host keeps for it behind its state.
    pub fn kept(self) -> usize {
        if self.is_linear() { 9 } else { 0 }
    }

    /// The place of the fibre direction in the properties.
    pub fn fibre(self) -> usize {
        [8, 8, 4][self as usize]
    }

    pub fn is_linear(self) -> bool {
        self == Law::Linear
    }
}

/// What a case is for: the C entries alone, or a host's entry beside them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Host {
    None,
    Umat,
    Vumat,
    Mgis,
    LsDyna,
    OpenRadioss,
    CalculiX,
}

pub const HOSTS: [Host; 7] =
    [Host::None, Host::Umat, Host::Vumat, Host::Mgis, Host::LsDyna, Host::OpenRadioss, Host::CalculiX];

impl Host {
    /// Whether it has an entry for one point.
    pub fn has_points(self) -> bool {
        matches!(self, Host::Umat | Host::Mgis | Host::LsDyna | Host::CalculiX)
    }

    /// Whether it has an entry for a block; such a host takes elements out whose points are refused.
    pub fn has_blocks(self) -> bool {
        matches!(self, Host::Vumat | Host::LsDyna | Host::OpenRadioss)
    }

    /// Whether the state of the new step is in the place of the old one.
    pub fn is_in_place(self) -> bool {
        matches!(self, Host::Umat | Host::LsDyna | Host::OpenRadioss)
    }

    /// Whether it keeps F of the last step among its variables: 0 there is a point at rest.
    fn keeps_gradient(self) -> bool {
        matches!(self, Host::LsDyna | Host::OpenRadioss | Host::CalculiX)
    }
}

/// Where the old state stands: in an array of its own, in that of the new one, or nowhere.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Old {
    Apart,
    InPlace,
    Null,
}

pub const OLDS: [Old; 3] = [Old::Apart, Old::InPlace, Old::Null];

/// The outputs and own inputs of a case, one bit each.
pub mod with {
    pub const STRESS: u64 = 1;
    pub const ENERGIES: u64 = 2;
    pub const INVARIANTS: u64 = 4;
    /// The rest of the state; of the linear elastic law all of it.
    pub const FAILURE: u64 = 8;
    pub const MODES: u64 = 16;
    pub const WAVE_SPEED: u64 = 32;
    pub const TANGENT: u64 = 64;
    pub const STATUS: u64 = 128;
    pub const ACTIVE: u64 = 256;
    pub const STATE: u64 = ENERGIES | INVARIANTS | FAILURE;
    /// Own inputs of the points.
    pub const FIBRE: u64 = 512;
    pub const SECOND_AXIS: u64 = 1024;
    pub const LIMIT: u64 = 2048;
}

/// The groups of arrays that have a layout.
pub mod group {
    pub const GRADIENT: usize = 0;
    pub const FIBRE: usize = 1;
    pub const STATE: usize = 2;
    pub const STRESS: usize = 3;
    /// Of the linear elastic law that of the axes.
    pub const MODES: usize = 4;
    pub const TANGENT: usize = 5;
    pub const LIMIT: usize = 6;
    pub const COUNT: usize = 7;
}

/// How an array is laid out: a form, what it is wider than it must be, and how far into its allocation it begins.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Placing {
    pub form: Form,
    pub gap: usize,
    pub offset: usize,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Form {
    /// As the block says.
    #[default]
    Plain,
    /// With a leading dimension of its own.
    Leading,
    /// Points in rows.
    Rows,
    /// With a stride and a leading dimension.
    Strided,
    /// A pointer for each component.
    Pointers,
}

pub const FORMS: [Form; 5] = [Form::Plain, Form::Leading, Form::Rows, Form::Strided, Form::Pointers];

/// What a point brings, in double precision; a case in single precision rounds it.
#[derive(Clone, Debug, PartialEq)]
pub struct Input {
    /// By columns.
    pub f: [f64; 9],
    /// At the start of the step, of the linear elastic law.
    pub f_old: [f64; 9],
    pub fibre: [f64; 3],
    pub second_axis: [f64; 3],
    pub limit: f64,
    pub axes: [f64; 9],
    pub state: Vec<f64>,
}

impl Input {
    /// Makes of the gradients what this host has: stretches, symmetric, whatever they are; no old one that is 0.
    pub fn fit_host(&mut self, host: Host) {
        if host == Host::Vumat {
            for f in [&mut self.f, &mut self.f_old] {
                (f[1], f[2], f[5]) = (f[3], f[6], f[7]);
            }
        }
        // As single precision reads it.
        if host.keeps_gradient() && self.f_old[..3].iter().all(|&x| x as f32 == 0.0) {
            self.f_old = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
        }
    }
}

#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    pub law: Law,
    pub single: bool,
    pub host: Host,
    pub old: Old,
    pub with: u64,
    pub level: i32,
    pub measure: i32,
    pub rotation: i32,
    pub criterion: i32,
    /// By how much the leading dimension of the block exceeds the number of points.
    pub gap: usize,
    pub density: f64,
    pub properties: Vec<f64>,
    pub placings: [Placing; group::COUNT],
    pub points: Vec<Input>,
    /// For what a check chooses at random.
    pub seed: u64,
}

impl Case {
    pub fn asks(&self, what: u64) -> bool {
        self.with & what != 0
    }

    /// Whether the state is asked for with all its parts.
    pub fn asks_state(&self) -> bool {
        self.with & with::STATE == with::STATE || (self.law.is_linear() && self.asks(with::FAILURE))
    }

    pub fn tangent_size(&self) -> usize {
        if self.measure == 3 { 9 } else { 6 }
    }

    /// The same case with one of its points.
    pub fn of_point(&self, index: usize) -> Case {
        Case { points: vec![self.points[index].clone()], ..self.clone() }
    }

    /// A random case.
    pub fn random(seed: u64) -> Case {
        let rng = &mut Rng::with_seed(seed);
        let law = LAWS[rng.usize(..3)];
        let host = if one_in(rng, 2) { HOSTS[rng.usize(1..HOSTS.len())] } else { Host::None };
        let single = rng.bool() && (host == Host::None || host.has_blocks());
        let properties = properties(rng, law, single);
        let n = match rng.u8(0..20) {
            0 => 0,
            1..=7 => 1,
            8..=13 => rng.usize(2..10),
            14..=17 => rng.usize(10..40),
            _ => rng.usize(60..140),
        };
        let mut case = Case {
            law,
            single,
            host,
            old: OLDS[rng.usize(..3)],
            with: if one_in(rng, 3) { rng.u64(0..4096) } else { 4095 & !(with::TANGENT * u64::from(rng.bool())) },
            level: rng.i32(0..4),
            measure: rng.i32(0..4),
            rotation: if one_in(rng, 2) { 0 } else { rng.i32(0..3) },
            criterion: rng.i32(0..2),
            gap: if rng.bool() { 0 } else { rng.usize(0..9) },
            density: if one_in(rng, 20) { power_of_ten(rng, -30.0, 30.0) } else { 1351.4 },
            properties,
            placings: std::array::from_fn(|_| Placing {
                form: if rng.bool() { Form::Plain } else { FORMS[rng.usize(..5)] },
                gap: rng.usize(0..5),
                offset: rng.usize(0..4),
            }),
            points: Vec::new(),
            seed,
        };
        if !rng.bool() {
            case.with &= !(with::FIBRE | with::SECOND_AXIS);
        }
        if !rng.bool() {
            case.with &= !with::LIMIT;
        }
        case.fit_host(rng);
        case.points = (0..n).map(|_| input(rng, &case)).collect();
        case
    }

    /// What a host asks for, if there is one; a vector of points has a state in whole.
    fn fit_host(&mut self, rng: &mut Rng) {
        if self.law.is_linear() {
            self.with &= !with::MODES;
        }
        if self.host == Host::None {
            return;
        }
        // The tangents of LS-DYNA are others.
        let has_tangent = self.host.has_points() && !self.host.has_blocks();
        // Without its tangent a point that is singular but for roundings may be refused or not: CalculiX has both always.
        let is_asked = rng.bool() || self.host == Host::CalculiX;
        let tangent = if has_tangent && is_asked { with::TANGENT } else { 0 };
        let own = match self.host {
            Host::Mgis | Host::LsDyna => 0,
            Host::OpenRadioss => self.with & (with::LIMIT | with::FIBRE) | with::WAVE_SPEED,
            _ => self.with & with::LIMIT,
        };
        self.with = with::STRESS | with::STATE | with::STATUS | tangent | own;
        self.level = 0;
        if self.host == Host::OpenRadioss {
            self.rotation = self.rotation.min(1);
        } else {
            (self.rotation, self.criterion) = (0, 0);
        }
        self.measure = match self.host {
            Host::Mgis | Host::CalculiX => 0,
            _ => 2,
        };
        self.old = if self.host.is_in_place() { Old::InPlace } else { Old::Apart };
    }
}

/// Properties, most of them right.
fn properties(rng: &mut Rng, law: Law, single: bool) -> Vec<f64> {
    let mut size = |value: f64| match rng.u8(0..24) {
        0 | 1 => 0.0,
        2 => power_of_ten(rng, -25.0, 25.0),
        3 if !single => power_of_ten(rng, -300.0, 25.0),
        4..=9 => value * power_of_ten(rng, -1.0, 1.0),
        _ => value,
    };
    let mut values = match law {
        Law::Linear => vec![size(79.414), size(0.794), size(0.126), size(3.637)],
        _ => {
            let stiffness = [size(82.341), size(1.055), 2.2, size(0.64974), size(0.05)];
            [&stiffness[..], &[size(0.0458), size(1.8), size(0.3)]].concat()
        }
    };
    let fibre = direction(rng);
    values.extend(fibre);
    match law {
        Law::Hyperelastic => (),
        Law::Frictional => {
            values.extend([
                between(rng, 0.0, 0.9) * f64::from(rng.u8(0..2)),
                power_of_ten(rng, -4.0, 0.0) * f64::from(rng.u8(0..2)),
            ]);
        }
        Law::Linear if rng.bool() => values.extend([0.0; 3]),
        Law::Linear => values.extend(direction(rng)),
    }
    if !law.is_linear() {
        let exponents = [1.0000001, 1.2, 1.5, 2.0, 2.2, 2.5, 3.0, 5.0, 40.0];
        values[2] = if rng.bool() { 2.2 } else { exponents[rng.usize(..exponents.len())] };
    }
    if one_in(rng, 24) {
        let place = rng.usize(..values.len());
        values[place] = hostile(rng);
    }
    values
}

/// A point of a case.
fn input(rng: &mut Rng, case: &Case) -> Input {
    let at = case.law.fibre();
    let mut fibre = [case.properties[at], case.properties[at + 1], case.properties[at + 2]];
    if case.asks(with::FIBRE) {
        fibre = direction(rng);
    }
    let f = gradient(rng, fibre);
    let f_old = match rng.u8(0..4) {
        0 => Matrix3::identity(),
        1 => f,
        2 => gradient(rng, fibre),
        _ => f * Matrix3::from_fn(|i, j| f64::from(u8::from(i == j)) + 0.05 * between(rng, -1.0, 1.0)),
    };
    let mut axes = any_rotation(rng);
    if one_in(rng, 8) {
        axes[rng.usize(0..9)] += 0.003 * between(rng, -1.0, 1.0);
    }
    if one_in(rng, 30) {
        axes[rng.usize(0..9)] = hostile(rng);
    }
    let limit = match rng.u8(0..12) {
        0..=4 => 0.0,
        5 => hostile(rng),
        _ => power_of_ten(rng, -2.0, 0.0),
    };
    let second_axis = if rng.bool() { [0.0; 3] } else { direction(rng) };
    let state = state(rng, case.law);
    let by_columns = |f: Matrix3<f64>| f.as_slice().try_into().expect("nine");
    let mut input =
        Input { f: by_columns(f), f_old: by_columns(f_old), fibre, second_axis, limit, axes: by_columns(axes), state };
    input.fit_host(case.host);
    input
}

/// An old state: fresh, of some history, failed, or hostile.
fn state(rng: &mut Rng, law: Law) -> Vec<f64> {
    let mut state = vec![0.0; law.state()];
    let failed = law.failed();
    if one_in(rng, 3) {
        return state;
    }
    if law.is_linear() {
        for value in &mut state[..8] {
            *value = between(rng, -1.0, 1.0);
        }
    } else {
        for (c, value) in state[..failed].iter_mut().enumerate() {
            *value = if c < 4 { between(rng, 0.0, 2.0) } else { between(rng, -0.5, 0.5) };
        }
        state[failed - 1] = between(rng, 0.0, 1.2);
    }
    if law == Law::Frictional {
        let size = power_of_ten(rng, -6.0, 3.0) * f64::from(rng.u8(0..2));
        let (i_te, lost) = (rng.f64(), rng.f64());
        state[8..12].copy_from_slice(&[lost, i_te, between(rng, -size, size), between(rng, -size, size)]);
    }
    state[failed + 1] = 1.0;
    match rng.u8(0..24) {
        0 | 1 => (state[failed], state[failed + 1]) = (1.0, 0.0),
        2 | 3 => {
            let place = rng.usize(..state.len());
            state[place] = hostile(rng);
        }
        _ => (),
    }
    state
}
