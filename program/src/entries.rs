//! The C entries as their hosts call them, behind safe functions: for the program's `eval` and `bench` and for the explicit
//! host.

use std::ffi::{c_char, c_int};
use std::ptr::{null, null_mut};

use toron::host::c::{self, Block, LinearBlock};
use toron::host::{abaqus, calculix, lsdyna};
use toron::law::parameters::{FIBRE, HYPERELASTIC_PROPERTIES};
use toron::law::state::{ENERGIES, FAILED, FAILURE_INDEX, HYPERELASTIC_STATE, INVARIANTS, LINEAR_ELASTIC_STATE};
use toron::law::status;
use toron::law::stress::truesdell_of_jaumann;

/// What an entry gives back: stress in the library's order, state, modes where it has them.
#[derive(Clone, Copy, Debug, Default)]
pub struct Answer {
    pub status: i32,
    pub stress: [f64; 6],
    pub state: [f64; HYPERELASTIC_STATE],
    pub modes: Option<[[f64; 6]; 4]>,
    /// The Jaumann modulus of the Kirchhoff stress over J, in the library's order, where it is wanted and the entry has it.
    pub ddsdde: Option<[[f64; 6]; 6]>,
}

/// What a status means; for properties, which one is wrong.
pub fn message(code: i32, properties: &[f64; HYPERELASTIC_PROPERTIES]) -> String {
    let mut text = [0_u8; 512];
    let room = text.as_mut_ptr().cast();
    // SAFETY: the arrays have the sizes passed.
    let length = unsafe {
        match c::hyperelastic_validate_f64(properties.as_ptr(), properties.len(), room, 512, null_mut()) {
            0 => c::status_message(code, room, 512),
            length => length,
        }
    };
    String::from_utf8_lossy(&text[..length.min(511)]).into_owned()
}

/// One point in either precision: stress and state as a solver asks for them, the modes by a call of their own, DDSDDE by a third.
pub fn point<T: BlockPrecision>(properties: &[T; HYPERELASTIC_PROPERTIES], f: &[T; 9], tangent: bool) -> Answer {
    let mut alone = OnePoint::default();
    let status = alone.call(properties, f, false);
    let mut modes = [[T::default(); 6]; 4];
    let (values, count) = (properties.as_ptr(), properties.len());
    let nothing = null_mut();
    // SAFETY: the arrays have the sizes that the entry asks for.
    unsafe {
        let (old, modes) = (null(), modes.as_mut_ptr().cast());
        T::POINT(values, count, f.as_ptr(), null(), old, nothing, nothing, modes, T::default(), nothing);
    }
    let mut answer = Answer {
        status,
        stress: alone.stress.map(Into::into),
        state: alone.state.map(Into::into),
        modes: Some(modes.map(|mode| mode.map(Into::into))),
        ddsdde: None,
    };
    if tangent {
        let mut rows = [[T::default(); 6]; 6];
        // SAFETY: as above. The status is that of the call before, or the tangent's own.
        answer.status = unsafe {
            let measure = c::TORON_TANGENT_JAUMANN;
            let (old, rows) = (null(), rows.as_mut_ptr().cast());
            T::POINT_TANGENT(values, count, f.as_ptr(), null(), old, nothing, nothing, measure, rows)
        };
        answer.ddsdde = Some(rows.map(|row| row.map(Into::into)));
    }
    answer
}

/// The deformations that stand beside the point in a block: rest, a stretched, a compacted and sheared one, and two that
/// cannot be evaluated, none of which may disturb it.
const NEIGHBOURS: [[f64; 9]; 5] = [
    [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
    [1.2, 0.0, 0.0, 0.1, 0.9, 0.0, 0.0, 0.2, 1.1],
    [0.9, 0.3, 0.0, 0.0, 0.6, 0.1, 0.5, 0.0, 0.8],
    [-1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
    [f64::NAN, 0.0, 0.0, 0.0, f64::INFINITY, 0.0, 0.0, 0.0, 1.0],
];

/// Where a line's point stands: the number of points of its block, its place in it, and the leading dimension.
fn place(line: usize) -> (usize, usize, usize) {
    let n = 1 + line * 7 % 23;
    (n, line * 5 % n, n + line % 4)
}

pub type BlockEntry<T> = unsafe extern "C" fn(*const T, usize, *const Block<T>, i32, *mut T) -> i32;

pub fn block<T: Copy + Default + Into<f64> + FromF64>(
    properties: &[T; HYPERELASTIC_PROPERTIES],
    f: &[T; 9],
    line: usize,
    tangent: bool,
    entry: BlockEntry<T>,
) -> Answer {
    let (n, at, stride) = place(line);
    let array = |components: usize| vec![T::default(); components * stride];
    let (mut gradient, mut fibre) = (array(9), array(3));
    for i in 0..n {
        for c in 0..9 {
            gradient[c * stride + i] = if i == at { f[c] } else { T::from_f64(NEIGHBOURS[(line + i) % 5][c]) };
        }
        for c in 0..3 {
            fibre[c * stride + i] = properties[FIBRE + c];
        }
    }
    let (mut stress, mut modes, mut state) = (array(6), array(24), array(HYPERELASTIC_STATE));
    let mut codes = vec![0; n];
    let part = |state: &mut Vec<T>, row: usize| state[row * stride..].as_mut_ptr();
    let block = Block {
        n,
        leading_dimension: stride,
        deformation_gradient: gradient.as_ptr(),
        // Every other line gives the direction point by point.
        fibre: if line.is_multiple_of(2) { fibre.as_ptr() } else { null() },
        energies_old: null(),
        invariants_old: null(),
        failure_old: null(),
        density: T::default(),
        stress: stress.as_mut_ptr(),
        energies: part(&mut state, ENERGIES),
        invariants: part(&mut state, INVARIANTS),
        failure: part(&mut state, FAILURE_INDEX),
        modes: modes.as_mut_ptr(),
        wave_speed: null_mut(),
        status: codes.as_mut_ptr(),
        level: c::TORON_LEVEL_BEST,
    };
    let mut rows = array(36);
    let wanted = if tangent { rows.as_mut_ptr() } else { null_mut() };
    // SAFETY: the arrays have the sizes that the structure tells.
    let worst = unsafe { entry(properties.as_ptr(), properties.len(), &block, c::TORON_TANGENT_JAUMANN, wanted) };
    let value = |array: &[T], c: usize| array[c * stride + at].into();
    let mut answer = Answer { status: codes[at], ..Answer::default() };
    if worst > status::INVERTED && worst != status::OK {
        answer.status = worst; // the call itself was refused, and no point has a code
    }
    answer.stress = std::array::from_fn(|c| value(&stress, c));
    answer.state = std::array::from_fn(|c| value(&state, c));
    answer.modes = Some(std::array::from_fn(|mode| std::array::from_fn(|c| value(&modes, 6 * mode + c))));
    answer.ddsdde = tangent.then(|| std::array::from_fn(|i| std::array::from_fn(|j| value(&rows, 6 * i + j))));
    answer
}

/// What a UMAT gets from Abaqus beside deformation gradient and properties, and gives back, in Abaqus's order.
#[derive(Clone, Copy, Debug)]
pub struct Umat {
    pub stress: [f64; 6],
    pub statev: [f64; HYPERELASTIC_STATE],
    pub ddsdde: [[f64; 6]; 6],
    pub sse: f64,
    pub pnewdt: f64,
}

impl Umat {
    /// A point at the start of an analysis.
    pub const FRESH: Umat =
        Umat { stress: [0.0; 6], statev: [0.0; HYPERELASTIC_STATE], ddsdde: [[0.0; 6]; 6], sse: 0.0, pnewdt: 1.0 };

    /// Calls the UMAT, without `tangent` with a null DDSDDE; returns its status.
    pub fn call(&mut self, properties: &[f64; HYPERELASTIC_PROPERTIES], f: &[f64; 9], tangent: bool) -> i32 {
        // SAFETY: the arrays have the sizes that the entry asks for.
        unsafe {
            abaqus::umat_tangent_f64(
                self.stress.as_mut_ptr(),
                self.statev.as_mut_ptr(),
                if tangent { self.ddsdde.as_mut_ptr().cast() } else { null_mut() },
                &mut self.sse,
                &mut self.pnewdt,
                f.as_ptr(),
                properties.as_ptr(),
                HYPERELASTIC_PROPERTIES as i32,
                HYPERELASTIC_STATE as i32,
                3,
                3,
                1,
            )
        }
    }
}

pub fn umat(properties: &[f64; HYPERELASTIC_PROPERTIES], f: &[f64; 9], tangent: bool) -> Answer {
    let mut point = Umat::FRESH;
    let status = point.call(properties, f, tangent);
    let Umat { stress: [s11, s22, s33, s12, s13, s23], statev, ddsdde, .. } = point;
    let order = [0, 1, 2, 3, 5, 4];
    Answer {
        status,
        stress: [s11, s22, s33, s12, s23, s13],
        state: statev,
        modes: None,
        ddsdde: tangent.then(|| order.map(|i| order.map(|j| ddsdde[i][j]))),
    }
}

/// A VUMAT of one point at the stretch U, 11 22 33 12 23 31; the stress is the corotational one.
pub fn vumat<T: Copy + Default + Into<f64>>(
    properties: &[f64; HYPERELASTIC_PROPERTIES],
    stretch: [f64; 6],
    round: impl Fn(f64) -> T,
    entry: unsafe extern "C" fn(*const abaqus::Vumat<T>) -> i32,
) -> Answer {
    let stretch = stretch.map(&round);
    let properties = properties.map(&round);
    let zeros = [T::default(); HYPERELASTIC_STATE];
    let one = [round(1.0)];
    let (mut stress, mut state, mut energy, mut inelastic) = ([T::default(); 6], zeros, [T::default()], [T::default()]);
    let block = abaqus::Vumat {
        nblock: 1,
        ndir: 3,
        nshr: 3,
        nstatev: HYPERELASTIC_STATE as i32,
        nprops: HYPERELASTIC_PROPERTIES as i32,
        step_time: one[0],
        total_time: one[0],
        props: properties.as_ptr(),
        density: one.as_ptr(),
        strain_inc: zeros.as_ptr(),
        stretch_old: stretch.as_ptr(),
        stretch_new: stretch.as_ptr(),
        stress_old: zeros.as_ptr(),
        state_old: zeros.as_ptr(),
        ener_intern_old: zeros.as_ptr(),
        ener_inelas_old: zeros.as_ptr(),
        stress_new: stress.as_mut_ptr(),
        state_new: state.as_mut_ptr(),
        ener_intern_new: energy.as_mut_ptr(),
        ener_inelas_new: inelastic.as_mut_ptr(),
    };
    // SAFETY: the arrays have the sizes that the structure tells, for one point.
    let status = unsafe { entry(&block) };
    Answer { status, stress: stress.map(Into::into), state: state.map(Into::into), ..Answer::default() }
}

/// LS-DYNA's material constants: 48 of them, the moduli for its time step at 12 and 13.
fn lsdyna_constants(properties: &[f64; HYPERELASTIC_PROPERTIES]) -> [f64; 48] {
    let mut cm = [0.0; 48];
    cm[..HYPERELASTIC_PROPERTIES].copy_from_slice(properties);
    let [bulk, shear] = [11, 12].map(|i| &raw mut cm[i]);
    // SAFETY: the arrays have the sizes that the entry asks for. Bad properties are the material routine's to report.
    unsafe { lsdyna::bulk_and_shear_f64(properties.as_ptr(), properties.len(), bulk, shear) };
    cm
}

/// DDSDDE of LS-DYNA's tangent.
fn jaumann(truesdell: &[[f64; 6]; 6], stress: &[f64; 6]) -> [[f64; 6]; 6] {
    truesdell_of_jaumann(truesdell, &stress.map(|s| -s))
}

pub fn lsdyna(properties: &[f64; HYPERELASTIC_PROPERTIES], f: &[f64; 9], tangent: bool) -> Answer {
    let mut answer = Answer::default();
    let cm = lsdyna_constants(properties);
    let mut history = [0.0; HYPERELASTIC_STATE + 9];
    history[HYPERELASTIC_STATE..].copy_from_slice(f);
    let mut failed = 0;
    // SAFETY: the arrays have the sizes that the entry asks for.
    answer.status = unsafe {
        lsdyna::umat_f64(
            cm.as_ptr(),
            answer.stress.as_mut_ptr(),
            history.as_mut_ptr(),
            HYPERELASTIC_STATE as i32,
            &mut failed,
        )
    };
    answer.state.copy_from_slice(&history[..HYPERELASTIC_STATE]);
    answer.state[FAILED] = f64::from(failed);
    if tangent {
        let mut es = [[0.0; 6]; 6];
        // The element fails by its flag: the tangent of the intact one is wanted.
        history[FAILED] = 0.0;
        // SAFETY: the arrays have the sizes that the entry asks for.
        unsafe { lsdyna::utan_f64(cm.as_ptr(), history.as_ptr(), HYPERELASTIC_STATE as i32, es.as_mut_ptr().cast()) };
        answer.ddsdde = Some(jaumann(&es, &answer.stress));
    }
    answer
}

pub fn lsdyna_vector(properties: &[f64; HYPERELASTIC_PROPERTIES], f: &[f64; 9], line: usize, tangent: bool) -> Answer {
    let (n, at, stride) = place(line);
    // Elements lft to llt of nlq; what stands before them is not the block's.
    let (first, nlq) = (line % 3, stride + line % 3);
    let cm = lsdyna_constants(properties);
    let mut history = vec![0.0; (HYPERELASTIC_STATE + 9) * nlq];
    for i in 0..n {
        for c in 0..9 {
            history[(HYPERELASTIC_STATE + c) * nlq + first + i] =
                if i == at { f[c] } else { NEIGHBOURS[(line + i) % 5][c] };
        }
    }
    let mut stress = vec![0.0; 6 * nlq];
    let mut failed = vec![0; nlq];
    let [sig1, sig2, sig3, sig4, sig5, sig6] = [0, 1, 2, 3, 4, 5].map(|c| stress[c * nlq..].as_mut_ptr());
    // SAFETY: the arrays have the sizes that the entry asks for.
    let worst = unsafe {
        lsdyna::umat_vector_f64(
            cm.as_ptr(),
            sig1,
            sig2,
            sig3,
            sig4,
            sig5,
            sig6,
            history.as_mut_ptr(),
            HYPERELASTIC_STATE as i32,
            first as i32 + 1,
            (first + n) as i32,
            nlq as i32,
            failed.as_mut_ptr(),
        )
    };
    let at = first + at;
    let mut answer = Answer {
        stress: std::array::from_fn(|c| stress[c * nlq + at]),
        state: std::array::from_fn(|c| history[c * nlq + at]),
        ..Answer::default()
    };
    answer.state[FAILED] = f64::from(failed[at]);
    // LS-DYNA sees no code an element, only that it failed; the point entry tells why where it was not the limit.
    let refused = worst > status::INVERTED && worst != status::OK;
    let unexplained = failed[at] != 0 && answer.state[FAILURE_INDEX] < 1.0;
    answer.status = match (refused, unexplained) {
        (true, _) => worst,
        (_, true) => point(properties, f, false).status,
        _ => status::OK,
    };
    if tangent {
        let mut dsave = vec![0.0; 36 * nlq];
        history[FAILED * nlq..(FAILED + 1) * nlq].fill(0.0);
        // SAFETY: as above.
        unsafe {
            lsdyna::utan_vector_f64(
                cm.as_ptr(),
                history.as_ptr(),
                HYPERELASTIC_STATE as i32,
                first as i32 + 1,
                (first + n) as i32,
                nlq as i32,
                dsave.as_mut_ptr(),
            )
        };
        let truesdell = std::array::from_fn(|i| std::array::from_fn(|j| dsave[(6 * i + j) * nlq + at]));
        answer.ddsdde = Some(jaumann(&truesdell, &answer.stress));
    }
    answer
}

/// Rounding to the precision of an entry.
pub trait FromF64 {
    fn from_f64(x: f64) -> Self;
}

impl FromF64 for f64 {
    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        x
    }
}

impl FromF64 for f32 {
    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        x as f32
    }
}

/// A precision of the entries that there are in both.
pub trait BlockPrecision: Copy + Default + Into<f64> + FromF64 + Send + Sync + 'static {
    const ENTRY: unsafe extern "C" fn(*const Self, usize, *const Block<Self>) -> i32;
    const LINEAR_ENTRY: LinearBlockEntry<Self>;
    const POINT: PointEntry<Self>;
    const POINT_TANGENT: PointTangentEntry<Self>;
    const VUMAT: unsafe extern "C" fn(*const abaqus::Vumat<Self>) -> i32;
    const LSDYNA: unsafe extern "C" fn(*const Self, *mut Self, *mut Self, i32, *mut c_int) -> i32;
    const LSDYNA_VECTOR: LsdynaVectorEntry<Self>;
}

pub type LinearBlockEntry<T> = unsafe extern "C" fn(*const T, usize, *const LinearBlock<T>, i32, i32) -> i32;
pub type PointEntry<T> =
    unsafe extern "C" fn(*const T, usize, *const T, *const T, *const T, *mut T, *mut T, *mut T, T, *mut T) -> i32;
pub type PointTangentEntry<T> =
    unsafe extern "C" fn(*const T, usize, *const T, *const T, *const T, *mut T, *mut T, i32, *mut T) -> i32;
pub type LsdynaVectorEntry<T> = unsafe extern "C" fn(
    *const T,
    *mut T,
    *mut T,
    *mut T,
    *mut T,
    *mut T,
    *mut T,
    *mut T,
    i32,
    i32,
    i32,
    i32,
    *mut c_int,
) -> i32;

impl BlockPrecision for f64 {
    const ENTRY: unsafe extern "C" fn(*const f64, usize, *const Block<f64>) -> i32 = c::hyperelastic_block_f64;
    const LINEAR_ENTRY: LinearBlockEntry<f64> = c::linear_elastic_block_f64;
    const POINT: PointEntry<f64> = c::hyperelastic_point_f64;
    const POINT_TANGENT: PointTangentEntry<f64> = c::hyperelastic_point_tangent_f64;
    const VUMAT: unsafe extern "C" fn(*const abaqus::Vumat<f64>) -> i32 = abaqus::vumat_f64;
    const LSDYNA: unsafe extern "C" fn(*const f64, *mut f64, *mut f64, i32, *mut c_int) -> i32 = lsdyna::umat_f64;
    const LSDYNA_VECTOR: LsdynaVectorEntry<f64> = lsdyna::umat_vector_f64;
}

impl BlockPrecision for f32 {
    const ENTRY: unsafe extern "C" fn(*const f32, usize, *const Block<f32>) -> i32 = c::hyperelastic_block_f32;
    const LINEAR_ENTRY: LinearBlockEntry<f32> = c::linear_elastic_block_f32;
    const POINT: PointEntry<f32> = c::hyperelastic_point_f32;
    const POINT_TANGENT: PointTangentEntry<f32> = c::hyperelastic_point_tangent_f32;
    const VUMAT: unsafe extern "C" fn(*const abaqus::Vumat<f32>) -> i32 = abaqus::vumat_f32;
    const LSDYNA: unsafe extern "C" fn(*const f32, *mut f32, *mut f32, i32, *mut c_int) -> i32 = lsdyna::umat_f32;
    const LSDYNA_VECTOR: LsdynaVectorEntry<f32> = lsdyna::umat_vector_f32;
}

/// One point through the C entry: stress and state, the old one on entry; with `tangent` dS/dE.
#[derive(Clone, Copy, Debug, Default)]
pub struct OnePoint<T> {
    pub stress: [T; 6],
    pub state: [T; HYPERELASTIC_STATE],
    pub tangent: [[T; 6]; 6],
}

impl<T: BlockPrecision> OnePoint<T> {
    /// Calls the entry; returns its status.
    pub fn call(&mut self, properties: &[T; HYPERELASTIC_PROPERTIES], f: &[T; 9], tangent: bool) -> i32 {
        let (values, count, state) = (properties.as_ptr(), properties.len(), self.state.as_mut_ptr());
        let stress = self.stress.as_mut_ptr();
        // SAFETY: the arrays have the sizes that the entries ask for; the new state replaces the old one.
        unsafe {
            if tangent {
                let rows = self.tangent.as_mut_ptr().cast();
                let measure = c::TORON_TANGENT_MATERIAL;
                T::POINT_TANGENT(values, count, f.as_ptr(), null(), state, state, stress, measure, rows)
            } else {
                let nothing = null_mut();
                T::POINT(values, count, f.as_ptr(), null(), state, state, stress, nothing, T::default(), nothing)
            }
        }
    }
}

/// One element through LS-DYNA's scalar entry: the state in the first eleven of its history, F behind it.
#[derive(Clone, Copy, Debug)]
pub struct LsdynaElement<T> {
    pub stress: [T; 6],
    pub history: [T; HYPERELASTIC_STATE + 9],
}

impl<T: BlockPrecision> LsdynaElement<T> {
    /// Calls the entry; returns its status.
    pub fn call(&mut self, properties: &[T; HYPERELASTIC_PROPERTIES]) -> i32 {
        let (count, mut failed) = (HYPERELASTIC_STATE as i32, 0);
        // SAFETY: the arrays have the sizes that the entry asks for.
        unsafe {
            T::LSDYNA(properties.as_ptr(), self.stress.as_mut_ptr(), self.history.as_mut_ptr(), count, &mut failed)
        }
    }
}

/// A vector of elements as LS-DYNA keeps it: `history` has the eleven state variables and the nine entries of F, component-major.
#[derive(Debug)]
pub struct LsdynaVector<T> {
    pub n: usize,
    pub stress: Vec<T>,
    pub history: Vec<T>,
    pub failed: Vec<c_int>,
}

impl<T: BlockPrecision> LsdynaVector<T> {
    pub fn new(n: usize) -> Self {
        let array = |components: usize| vec![T::default(); components * n];
        LsdynaVector { n, stress: array(6), history: array(HYPERELASTIC_STATE + 9), failed: vec![0; n] }
    }

    /// Calls the entry; returns its status.
    pub fn call(&mut self, properties: &[T; HYPERELASTIC_PROPERTIES]) -> i32 {
        let n = self.n;
        let [s1, s2, s3, s4, s5, s6] = [0, 1, 2, 3, 4, 5].map(|c| self.stress[c * n..].as_mut_ptr());
        let (history, count, last) = (self.history.as_mut_ptr(), HYPERELASTIC_STATE as i32, n as i32);
        let failed = self.failed.as_mut_ptr();
        // SAFETY: the arrays have the sizes that the entry asks for.
        unsafe { T::LSDYNA_VECTOR(properties.as_ptr(), s1, s2, s3, s4, s5, s6, history, count, 1, last, last, failed) }
    }
}

/// The arrays of a VUMAT, component-major; a step whose stretch does not change.
#[derive(Debug)]
pub struct VumatArrays<T> {
    pub n: usize,
    pub stretch: Vec<T>,
    pub state_old: Vec<T>,
    pub state_new: Vec<T>,
    pub stress: Vec<T>,
    /// Zeros and ones for what the law does not look at, or only at the value of.
    zeros: Vec<T>,
    ones: Vec<T>,
    energies: [Vec<T>; 2],
}

impl<T: BlockPrecision> VumatArrays<T> {
    pub fn new(n: usize) -> Self {
        let array = |components: usize| vec![T::default(); components * n];
        VumatArrays {
            n,
            stretch: array(6),
            state_old: array(HYPERELASTIC_STATE),
            state_new: array(HYPERELASTIC_STATE),
            stress: array(6),
            zeros: array(6),
            ones: vec![T::from_f64(1.0); n],
            energies: [array(1), array(1)],
        }
    }

    /// Calls the entry; returns its status.
    pub fn call(&mut self, properties: &[T; HYPERELASTIC_PROPERTIES]) -> i32 {
        let (zeros, one) = (self.zeros.as_ptr(), T::from_f64(1.0));
        let [internal, inelastic] = &mut self.energies;
        let block = abaqus::Vumat {
            nblock: self.n as i32,
            ndir: 3,
            nshr: 3,
            nstatev: HYPERELASTIC_STATE as i32,
            nprops: HYPERELASTIC_PROPERTIES as i32,
            step_time: one,
            total_time: one,
            props: properties.as_ptr(),
            density: self.ones.as_ptr(),
            strain_inc: zeros,
            stretch_old: self.stretch.as_ptr(),
            stretch_new: self.stretch.as_ptr(),
            stress_old: zeros,
            state_old: self.state_old.as_ptr(),
            ener_intern_old: zeros,
            ener_inelas_old: zeros,
            stress_new: self.stress.as_mut_ptr(),
            state_new: self.state_new.as_mut_ptr(),
            ener_intern_new: internal.as_mut_ptr(),
            ener_inelas_new: inelastic.as_mut_ptr(),
        };
        // SAFETY: the arrays have the sizes that the structure tells.
        unsafe { T::VUMAT(&block) }
    }
}

/// One integration point as CalculiX hands it over: the old and the new state, second Piola–Kirchhoff stress and dS/dE.
#[derive(Clone, Copy, Debug, Default)]
pub struct CalculixPoint {
    pub state_old: [f64; HYPERELASTIC_STATE],
    pub state: [f64; HYPERELASTIC_STATE],
    /// 11 22 33 12 13 23.
    pub stress: [f64; 6],
    /// The upper triangle in that order, by columns.
    pub stiffness: [f64; 21],
    pub pnewdt: f64,
}

impl CalculixPoint {
    /// Calls the entry. It ends the process where the properties are wrong, as CalculiX wants.
    pub fn call(&mut self, properties: &[f64; HYPERELASTIC_PROPERTIES], f: &[f64; 9]) {
        let strain = |i: usize, j: usize| {
            let product = (0..3).map(|k| f[3 * i + k] * f[3 * j + k]).sum::<f64>();
            0.5 * (product - if i == j { 1.0 } else { 0.0 })
        };
        let strain = [strain(0, 0), strain(1, 1), strain(2, 2), strain(0, 1), strain(0, 2), strain(1, 2)];
        let (name, kode, zeros) = ([b' ' as c_char; 80], -100 - HYPERELASTIC_PROPERTIES as i32, [0.0; 9]);
        let (one, none, state_count) = (1, 0, HYPERELASTIC_STATE as i32);
        let (i, d) = (&raw const none, zeros.as_ptr());
        // SAFETY: the arrays have the sizes that CalculiX promises; what the entry does not look at is zero.
        unsafe {
            calculix::hyperelastic(
                name.as_ptr(),
                &one,
                &one,
                &kode,
                properties.as_ptr(),
                strain.as_ptr(),
                d,
                d,
                d,
                d,
                f.as_ptr(),
                d,
                i,
                d,
                d,
                d,
                d,
                i,
                i,
                &one,
                &state_count,
                self.state_old.as_ptr(),
                self.state.as_mut_ptr(),
                self.stress.as_mut_ptr(),
                self.stiffness.as_mut_ptr(),
                i,
                d,
                d,
                &mut self.pnewdt,
                i,
                80,
            );
        }
    }
}

/// The arrays of an explicit solver, component-major with one leading dimension; the history is replaced in place.
#[derive(Debug)]
pub struct SolverBlock<'a, T> {
    /// Number of points, and the distance from one component to the next.
    pub n: usize,
    pub leading_dimension: usize,
    /// In, 9 components: F by columns.
    pub deformation_gradient: &'a [T],
    /// In and out, 11: the state variables; only the groups that are wanted are read and written.
    pub state: &'a mut [T],
    /// Whether energies and invariants are wanted, and whether points may fail.
    pub energies: bool,
    pub failure: bool,
    /// Out, 6: Cauchy stress 11 22 33 12 23 31.
    pub stress: &'a mut [T],
    /// The reference density, and out, 1: a bound of the wave speed.
    pub wave_speed: Option<(T, &'a mut [T])>,
    /// Out: a status code for each point.
    pub status: &'a mut [i32],
}

/// The hyperelastic law at a block of points through `toron_hyperelastic_block_f64` or `_f32`, as an explicit solver calls
/// it; returns the entry's code.
///
/// # Panics
/// An array is shorter than its components need.
pub fn hyperelastic_block<T: BlockPrecision>(properties: &[T], block: SolverBlock<'_, T>) -> i32 {
    let SolverBlock { n, leading_dimension: stride, deformation_gradient, state, stress, status, .. } = block;
    let holds = |length: usize, components: usize| length >= (components - 1) * stride + n;
    let (density, wave_speed) = block.wave_speed.map_or((T::default(), None), |(density, to)| (density, Some(to)));
    assert!(n <= stride && holds(deformation_gradient.len(), 9) && holds(state.len(), HYPERELASTIC_STATE));
    assert!(holds(stress.len(), 6) && status.len() >= n && wave_speed.as_ref().is_none_or(|to| to.len() >= n));
    let state = state.as_mut_ptr();
    // SAFETY: the array holds all rows, as has just been seen.
    let part = |wanted: bool, row: usize| if wanted { unsafe { state.add(row * stride) } } else { null_mut() };
    let (energies, invariants) = (part(block.energies, ENERGIES), part(block.energies, INVARIANTS));
    let failure = part(block.failure, FAILURE_INDEX);
    let arrays = Block {
        n,
        leading_dimension: stride,
        deformation_gradient: deformation_gradient.as_ptr(),
        fibre: null(),
        energies_old: energies,
        invariants_old: invariants,
        failure_old: failure,
        density,
        stress: stress.as_mut_ptr(),
        energies,
        invariants,
        failure,
        modes: null_mut(),
        wave_speed: wave_speed.map_or(null_mut(), <[T]>::as_mut_ptr),
        status: status.as_mut_ptr(),
        level: c::TORON_LEVEL_BEST,
    };
    // SAFETY: the arrays have the sizes that the structure tells; the new state replaces the old one exactly.
    unsafe { T::ENTRY(properties.as_ptr(), properties.len(), &arrays) }
}

/// The arrays of an explicit solver for the linear elastic law, as those of [`SolverBlock`].
#[derive(Debug)]
pub struct LinearSolverBlock<'a, T> {
    /// Number of points, and the distance from one component to the next.
    pub n: usize,
    pub leading_dimension: usize,
    /// In, 9 components each: F by columns at both ends of the step.
    pub f_old: &'a [T],
    pub f_new: &'a [T],
    /// In and out, 10: the state variables.
    pub state: &'a mut [T],
    /// Out, 6: Cauchy stress 11 22 33 12 23 31.
    pub stress: &'a mut [T],
    /// Out: a status code for each point.
    pub status: &'a mut [i32],
}

/// The linear elastic law over a step at a block of points through `toron_linear_elastic_block_f64` or `_f32`; returns the
/// entry's code.
///
/// # Panics
/// An array is shorter than its components need.
pub fn linear_elastic_block<T: BlockPrecision>(
    properties: &[T],
    block: LinearSolverBlock<'_, T>,
    frame: LinearFrame,
    criterion: i32,
) -> i32 {
    let LinearSolverBlock { n, leading_dimension: stride, f_old, f_new, state, stress, status } = block;
    let holds = |length: usize, components: usize| length >= (components - 1) * stride + n;
    assert!(n <= stride && holds(f_old.len(), 9) && holds(f_new.len(), 9));
    assert!(holds(state.len(), LINEAR_ELASTIC_STATE) && holds(stress.len(), 6) && status.len() >= n);
    let state = state.as_mut_ptr();
    let arrays = LinearBlock {
        n,
        leading_dimension: stride,
        f_old: f_old.as_ptr(),
        f_new: f_new.as_ptr(),
        axes: null_mut(),
        state_old: state,
        state_new: state,
        stress: stress.as_mut_ptr(),
        status: status.as_mut_ptr(),
        level: c::TORON_LEVEL_BEST,
    };
    let rotation = match frame {
        LinearFrame::Fibre => c::TORON_ROTATION_FIBRE,
        LinearFrame::Polar => c::TORON_ROTATION_POLAR,
    };
    // SAFETY: the arrays have the sizes that the structure tells; the new state replaces the old one exactly, and neither frame
    // needs axes.
    unsafe { T::LINEAR_ENTRY(properties.as_ptr(), properties.len(), &arrays, rotation, criterion) }
}

/// The frames of the linear elastic law that follow from the deformation gradient alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LinearFrame {
    Fibre,
    Polar,
}
