//! A step at one point through a C entry as its host would call it, from an old state to an answer in the library's
//! order: for `eval`.

use std::f64::consts::SQRT_2;
use std::marker::PhantomData;
use std::ptr::null_mut;

use super::blocks::{message_in, prepared, prepared_frictional};
use super::hosts::{CalculixPoint, MgisPoint, MgisTangent, OpenradiossGroup, Umat};
use super::precision::{BlockPrecision, PreparedEntry, PropertiesEntry};
use toron::host::Material;
use toron::host::abaqus::{self, ExplicitLaw, StandardLaw};
use toron::host::calculix::CalculixLaw;
use toron::host::laws::LAWS;
use toron::host::lsdyna::{self, UmatVector, UserRoutines, Utan, UtanVector};
use toron::host::mgis::{INTEGRATED, MgisLaw};
use toron::host::openradioss::SolidLaw;
use toron::host::openradioss::card::Layout;
use toron::law::interface::Law;
use toron::law::parameters::FIBRE;
use toron::law::state::{FRICTIONAL_STATE, HYPERELASTIC_STATE};
use toron::law::status;
use toron::law::stress::truesdell_of_jaumann;
use toron::{Frictional, Hyperelastic};
use toron_c::{Block, FrictionalLaw, HyperelasticLaw, Point, TORON_FRICTIONAL, TORON_HYPERELASTIC};

/// A law of the library whose steps are evaluated here, with `STATE` state variables, through every host.
pub trait Stepped<const STATE: usize>:
    StandardLaw + CalculixLaw + MgisLaw + Material<f64, Law: Functions<f64>> + Material<f32, Law: Functions<f32>>
{
    /// Its number in C.
    const NUMBER: usize;
}

impl Stepped<HYPERELASTIC_STATE> for Hyperelastic {
    const NUMBER: usize = TORON_HYPERELASTIC as usize;
}

impl Stepped<FRICTIONAL_STATE> for Frictional {
    const NUMBER: usize = TORON_FRICTIONAL as usize;
}

/// The C functions of a law in one precision.
pub trait Functions<T>: ExplicitLaw<T> + UserRoutines<T> + SolidLaw<T>
where
    T: BlockPrecision,
{
    type Prepared;
    const POINT: PreparedEntry<Self::Prepared, Point<T>>;
    const POINT_WITH_PROPERTIES: PropertiesEntry<T, Point<T>>;
    const BLOCK: PreparedEntry<Self::Prepared, Block<T>>;

    /// # Errors
    /// The properties are wrong: the entry's message.
    fn prepared(properties: &[T]) -> Result<Self::Prepared, String>;
}

impl<T: BlockPrecision> Functions<T> for Hyperelastic<T>
where
    Self: ExplicitLaw<T> + UserRoutines<T> + SolidLaw<T>,
{
    type Prepared = HyperelasticLaw<T>;
    const POINT: PreparedEntry<Self::Prepared, Point<T>> = T::POINT;
    const POINT_WITH_PROPERTIES: PropertiesEntry<T, Point<T>> = T::POINT_WITH_PROPERTIES;
    const BLOCK: PreparedEntry<Self::Prepared, Block<T>> = T::BLOCK;

    fn prepared(properties: &[T]) -> Result<Self::Prepared, String> {
        prepared(properties)
    }
}

impl<T: BlockPrecision> Functions<T> for Frictional<T> {
    type Prepared = FrictionalLaw<T>;
    const POINT: PreparedEntry<Self::Prepared, Point<T>> = T::FRICTIONAL_POINT;
    const POINT_WITH_PROPERTIES: PropertiesEntry<T, Point<T>> = T::FRICTIONAL_POINT_WITH_PROPERTIES;
    const BLOCK: PreparedEntry<Self::Prepared, Block<T>> = T::FRICTIONAL_BLOCK;

    fn prepared(properties: &[T]) -> Result<Self::Prepared, String> {
        prepared_frictional(properties)
    }
}

/// What a step of the law `L` starts from.
#[derive(Clone, Copy, Debug)]
pub struct Step<'a, L, const STATE: usize> {
    /// In the order of the law's table.
    pub properties: &'a [f64],
    /// F at its end, by columns.
    pub f: &'a [f64; 9],
    pub state: &'a [f64; STATE],
    /// Whether DDSDDE is wanted.
    pub tangent: bool,
    /// By which the place of the point among others changes.
    pub line: usize,
    pub law: PhantomData<L>,
}

/// The outputs of an entry: stress in the library's order, state, and where the entry has them modes and, if it is
/// wanted, DDSDDE: the Jaumann modulus of the Kirchhoff stress over J, in the library's order.
#[derive(Clone, Copy, Debug)]
pub struct Answer<const STATE: usize> {
    pub status: i32,
    pub stress: [f64; 6],
    pub state: [f64; STATE],
    pub modes: Option<[[f64; 6]; 4]>,
    pub ddsdde: Option<[[f64; 6]; 6]>,
}

/// The deformations that stand beside the point in a block: rest, a stretched, a compacted and sheared one, and two
/// that cannot be evaluated, none of which may disturb it.
pub const NEIGHBOURS: [[f64; 9]; 5] = [
    [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
    [1.2, 0.0, 0.0, 0.1, 0.9, 0.0, 0.0, 0.2, 1.1],
    [0.9, 0.3, 0.0, 0.0, 0.6, 0.1, 0.5, 0.0, 0.8],
    [-1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
    [f64::NAN, 0.0, 0.0, 0.0, f64::INFINITY, 0.0, 0.0, 0.0, 1.0],
];

/// Where a line's point stands: the number of points of its block, its place in it, and the leading dimension.
pub fn place(line: usize) -> (usize, usize, usize) {
    let n = 1 + line * 7 % 23;
    (n, line * 5 % n, n + line % 4)
}

/// What a status means; for properties, which one is wrong.
pub fn message<L: Stepped<STATE>, const STATE: usize>(code: i32, properties: &[f64]) -> String {
    Precise::<L, f64>::prepared(properties).err().unwrap_or_else(|| {
        let mut text = [0_u8; toron_c::TORON_MESSAGE_CAPACITY];
        // SAFETY: the text has the size passed.
        unsafe { toron_c::toron_status_message(code, text.as_mut_ptr().cast(), text.len()) };
        message_in(&text)
    })
}

/// The law in a precision.
type Precise<L, T> = <L as Material<T>>::Law;

fn rounded<T: BlockPrecision>(values: &[f64]) -> Vec<T> {
    values.iter().map(|&value| T::from_f64(value)).collect()
}

fn widened<T: BlockPrecision, const N: usize>(values: [T; N]) -> [f64; N] {
    values.map(Into::into)
}

/// The stress of UMATs and MGIS, 11 22 33 12 13 23, in the library's order.
fn library_order([s11, s22, s33, s12, s13, s23]: [f64; 6]) -> [f64; 6] {
    [s11, s22, s33, s12, s23, s13]
}

/// DDSDDE of a Truesdell modulus.
pub fn jaumann(truesdell: &[[f64; 6]; 6], stress: &[f64; 6]) -> [[f64; 6]; 6] {
    truesdell_of_jaumann(truesdell, &stress.map(|s| -s))
}

impl<L: Stepped<STATE>, const STATE: usize> Step<'_, L, STATE> {
    /// The law's numbers of properties and of state variables.
    const PROPERTIES: usize = Precise::<L, f64>::DESCRIPTION.properties.len();
    /// The latch among the state variables.
    const FAILED: usize = Precise::<L, f64>::DESCRIPTION.failed;

    /// The answer where there is none: no stress, the old state.
    fn refused(&self, status: i32) -> Answer<STATE> {
        Answer { status, stress: [0.0; 6], state: *self.state, modes: None, ddsdde: None }
    }

    /// F of a point of a block whose own point is at `at`.
    fn gradient(&self, point: usize, at: usize) -> &[f64; 9] {
        if point == at { self.f } else { &NEIGHBOURS[(self.line + point) % NEIGHBOURS.len()] }
    }

    /// Through the entry for a point in either precision, with a law that has been prepared or its properties.
    pub fn point<T: BlockPrecision>(&self, with_properties: bool) -> Answer<STATE>
    where
        L: Material<T, Law: Functions<T>>,
    {
        let properties = rounded::<T>(self.properties);
        let (f, mut state) = (self.f.map(T::from_f64), self.state.map(T::from_f64));
        let (mut stress, mut modes, mut rows) = ([T::default(); 6], [[T::default(); 6]; 4], [[T::default(); 6]; 6]);
        let state_new = state.as_mut_ptr();
        let point = Point {
            measure: toron_c::TORON_TANGENT_JAUMANN,
            deformation_gradient: f.as_ptr(),
            state_old: state_new,
            state_new,
            stress: stress.as_mut_ptr(),
            modes: modes.as_mut_ptr().cast(),
            tangent: if self.tangent { rows.as_mut_ptr().cast() } else { null_mut() },
            ..Point::empty()
        };
        let law = Precise::<L, T>::prepared(&properties).ok().filter(|_| !with_properties);
        let (values, count) = (properties.as_ptr(), properties.len());
        // SAFETY: the arrays have the sizes that the entry asks for; the new state replaces the old one.
        let status = unsafe {
            match law {
                Some(law) => Precise::<L, T>::POINT(&law, &point, null_mut(), 0),
                None => Precise::<L, T>::POINT_WITH_PROPERTIES(values, count, &point, null_mut(), 0),
            }
        };
        Answer {
            status,
            stress: widened(stress),
            state: widened(state),
            modes: Some(modes.map(widened)),
            ddsdde: self.tangent.then(|| rows.map(widened)),
        }
    }

    /// Through the entry for blocks, the point amid others, which start at rest.
    pub fn block<T: BlockPrecision>(&self) -> Answer<STATE>
    where
        L: Material<T, Law: Functions<T>>,
    {
        let (n, at, stride) = place(self.line);
        let array = |components: usize| vec![T::default(); components * stride];
        let (mut f, mut fibre, mut state) = (array(9), array(3), array(STATE));
        let (mut stress, mut modes, mut rows, mut codes) = (array(6), array(24), array(36), vec![0; n]);
        for i in 0..n {
            (0..9).for_each(|c| f[c * stride + i] = T::from_f64(self.gradient(i, at)[c]));
            (0..3).for_each(|c| fibre[c * stride + i] = T::from_f64(self.properties[FIBRE + c]));
        }
        (0..STATE).for_each(|c| state[c * stride + at] = T::from_f64(self.state[c]));
        let [energies, invariants, _] = Precise::<L, f64>::PARTS;
        let [energies, invariants, failure] =
            [0, energies, energies + invariants].map(|row| &raw mut state[row * stride]);
        let mut block = Block {
            n,
            leading_dimension: stride,
            measure: toron_c::TORON_TANGENT_JAUMANN,
            energies_old: energies,
            invariants_old: invariants,
            failure_old: failure,
            energies,
            invariants,
            failure,
            modes: modes.as_mut_ptr(),
            tangent: if self.tangent { rows.as_mut_ptr() } else { null_mut() },
            status: codes.as_mut_ptr(),
            ..Block::empty()
        };
        (block.deformation_gradient[0], block.stress[0]) = (f.as_ptr(), stress.as_mut_ptr());
        // Every other line gives the direction point by point.
        if self.line.is_multiple_of(2) {
            block.fibre[0] = fibre.as_ptr();
        }
        let Ok(law) = Precise::<L, T>::prepared(&rounded::<T>(self.properties)) else {
            return self.point::<T>(true);
        };
        // SAFETY: the arrays have the sizes that the structure tells; the new state replaces the old one.
        let worst = unsafe { Precise::<L, T>::BLOCK(&law, &block, null_mut(), 0) };
        let value = |array: &[T], c: usize| array[c * stride + at].into();
        Answer {
            // A call that was refused as a whole has no codes of points.
            status: if worst > status::INVERTED { worst } else { codes[at] },
            stress: std::array::from_fn(|c| value(&stress, c)),
            state: std::array::from_fn(|c| value(&state, c)),
            modes: Some(std::array::from_fn(|mode| std::array::from_fn(|c| value(&modes, 6 * mode + c)))),
            ddsdde: self.tangent.then(|| std::array::from_fn(|i| std::array::from_fn(|j| value(&rows, 6 * i + j)))),
        }
    }

    pub fn umat(&self) -> Answer<STATE> {
        let (mut point, mut ddsdde) = (Umat { statev: *self.state, ..Umat::<STATE>::FRESH }, [[0.0; 6]; 6]);
        let status = point.call_law::<L>(self.properties, self.f, self.tangent.then_some(&mut ddsdde));
        let order = [0, 1, 2, 3, 5, 4];
        Answer {
            stress: library_order(point.stress),
            state: point.statev,
            // A matrix of Fortran's, by columns.
            ddsdde: self.tangent.then(|| order.map(|i| order.map(|j| ddsdde[j][i]))),
            ..self.refused(status)
        }
    }

    /// A VUMAT of one point at the stretch U, 11 22 33 12 23 31; the stress is the corotational one.
    pub fn vumat<T: BlockPrecision>(&self, stretch: &[f64; 6]) -> Answer<STATE>
    where
        L: Material<T, Law: Functions<T>>,
    {
        let (properties, stretch) = (rounded::<T>(self.properties), stretch.map(T::from_f64));
        let old = self.state.map(T::from_f64);
        let (zeros, one) = ([T::default(); 6], [T::from_f64(1.0)]);
        let (mut stress, mut state, mut energies) = (zeros, old, [T::default(); 2]);
        let [internal, inelastic] = &mut energies;
        let block = abaqus::Vumat {
            nblock: 1,
            ndir: 3,
            nshr: 3,
            nstatev: STATE as i32,
            nprops: properties.len() as i32,
            step_time: 1.0,
            total_time: 1.0,
            props: properties.as_ptr(),
            density: one.as_ptr(),
            strain_inc: zeros.as_ptr(),
            stretch_old: stretch.as_ptr(),
            stretch_new: stretch.as_ptr(),
            stress_old: zeros.as_ptr(),
            state_old: old.as_ptr(),
            ener_intern_old: zeros.as_ptr(),
            ener_inelas_old: zeros.as_ptr(),
            stress_new: stress.as_mut_ptr(),
            state_new: state.as_mut_ptr(),
            ener_intern_new: internal,
            ener_inelas_new: inelastic,
            ..abaqus::Vumat::empty()
        };
        // SAFETY: the arrays have the sizes that the structure tells, for one point.
        let status = unsafe { Precise::<L, T>::vumat(&block, null_mut(), 0) };
        Answer { stress: widened(stress), state: widened(state), ..self.refused(status) }
    }

    /// LS-DYNA's material constants: 48 of them, the moduli for its time step behind the properties.
    fn lsdyna_constants(&self) -> [f64; 48] {
        let mut cm = [0.0; 48];
        cm[..Self::PROPERTIES].copy_from_slice(self.properties);
        let [bulk, shear] = [Self::PROPERTIES, Self::PROPERTIES + 1].map(|i| &raw mut cm[i]);
        let (values, count) = (self.properties.as_ptr(), self.properties.len());
        // SAFETY: the arrays have the sizes that the entry asks for. Bad properties are the material routine's to
        // report.
        unsafe { Precise::<L, f64>::card_moduli(values, count, bulk, shear, null_mut(), 0) };
        cm
    }

    pub fn lsdyna(&self) -> Answer<STATE> {
        let (cm, mut history, mut failed) = (self.lsdyna_constants(), [self.state.as_slice(), self.f].concat(), 0);
        let mut answer = self.refused(status::OK);
        let nhv = STATE as i32;
        let (cm, sig, hsv) = (cm.as_ptr(), answer.stress.as_mut_ptr(), history.as_mut_ptr());
        let element = lsdyna::Umat { cm, sig, hsv, nhv, failel: &mut failed };
        // SAFETY: the arrays have the sizes that the structure tells.
        answer.status = unsafe { Precise::<L, f64>::umat(&element, null_mut(), 0) };
        answer.state.copy_from_slice(&history[..STATE]);
        answer.state[Self::FAILED] = f64::from(failed);
        if self.tangent {
            let mut es = [[0.0; 6]; 6];
            // The element fails by its flag: the tangent of the intact one is wanted.
            history[Self::FAILED] = 0.0;
            let element = Utan { cm, hsv: history.as_ptr(), nhv, es: es.as_mut_ptr().cast() };
            // SAFETY: as above.
            unsafe { Precise::<L, f64>::utan(&element, null_mut(), 0) };
            answer.ddsdde = Some(jaumann(&es, &answer.stress));
        }
        answer
    }

    /// The element amid others of a vector, elements `lft` to `llt` of `nlq`; what stands before them is not the
    /// vector's.
    pub fn lsdyna_vector(&self) -> Answer<STATE> {
        let (n, at, stride) = place(self.line);
        let first = self.line % 3;
        let (nlq, own, cm) = (stride + first, first + at, self.lsdyna_constants());
        let (mut history, mut stress, mut failed) = (vec![0.0; (STATE + 9) * nlq], vec![0.0; 6 * nlq], vec![0; nlq]);
        for i in 0..n {
            (0..9).for_each(|c| history[(STATE + c) * nlq + first + i] = self.gradient(i, at)[c]);
        }
        (0..STATE).for_each(|c| history[c * nlq + own] = self.state[c]);
        let (cm, nhv, lft, llt) = (cm.as_ptr(), STATE as i32, first as i32 + 1, (first + n) as i32);
        let elements = UmatVector {
            cm,
            sig: [0, 1, 2, 3, 4, 5].map(|c| stress[c * nlq..].as_mut_ptr()),
            hsvs: history.as_mut_ptr(),
            nhv,
            lft,
            llt,
            nlq: nlq as i32,
            failels: failed.as_mut_ptr(),
        };
        // SAFETY: the arrays have the sizes that the structure tells.
        let worst = unsafe { Precise::<L, f64>::umat_vector(&elements, null_mut(), 0) };
        let mut answer = Answer {
            stress: std::array::from_fn(|c| stress[c * nlq + own]),
            state: std::array::from_fn(|c| history[c * nlq + own]),
            ..self.refused(status::OK)
        };
        answer.state[Self::FAILED] = f64::from(failed[own]);
        // LS-DYNA sees no code of an element, only that it failed: the point entry tells why.
        answer.status = match worst > status::INVERTED {
            true => worst,
            false if failed[own] != 0 => Step { tangent: false, ..*self }.point::<f64>(false).status,
            false => status::OK,
        };
        if self.tangent {
            let mut dsave = vec![0.0; 36 * nlq];
            history[Self::FAILED * nlq..(Self::FAILED + 1) * nlq].fill(0.0);
            let (hsvs, dsave_) = (history.as_ptr(), dsave.as_mut_ptr());
            let elements = UtanVector { cm, hsvs, nhv, lft, llt, nlq: nlq as i32, dsave: dsave_ };
            // SAFETY: as above.
            unsafe { Precise::<L, f64>::utan_vector(&elements, null_mut(), 0) };
            let truesdell = std::array::from_fn(|i| std::array::from_fn(|j| dsave[(6 * i + j) * nlq + own]));
            answer.ddsdde = Some(jaumann(&truesdell, &answer.stress));
        }
        answer
    }

    /// Through MGIS; where a tangent is wanted dS/dE too, tensor components 11 22 33 12 13 23.
    pub fn mgis(&self) -> (Answer<STATE>, Option<[[f64; 6]; 6]>) {
        let mut host = MgisPoint::<STATE> { state_old: *self.state, ..MgisPoint::new(self.f) };
        let request = if self.tangent { MgisTangent::Material } else { MgisTangent::None };
        if host.call_law::<L>(self.properties, request) != INTEGRATED {
            // MGIS gets a text and no code: it is the point entry's.
            let code = self.point::<f64>(false).status;
            return (self.refused(if code == status::OK { status::BAD_ARGUMENT } else { code }), None);
        }
        let [s11, s22, s33, s12, s13, s23] = host.stress;
        let stress = library_order([s11, s22, s33, s12 / SQRT_2, s13 / SQRT_2, s23 / SQRT_2]);
        // MGIS gets √2 times the components 12, 13 and 23, on both sides. The quotient, rounded, is mostly the number
        // that has been multiplied.
        let factor = |i: usize, j: usize| match (i < 3, j < 3) {
            (true, true) => 1.0,
            (false, false) => 2.0,
            _ => SQRT_2,
        };
        let material = || std::array::from_fn(|i| std::array::from_fn(|j| host.k[6 * i + j] / factor(i, j)));
        (Answer { stress, state: host.state, ..self.refused(status::OK) }, self.tangent.then(material))
    }

    /// The second Piola–Kirchhoff stress through CalculiX, in place of the Cauchy stress, and the symmetric part of
    /// dS/dE, tensor components; both 11 22 33 12 13 23.
    pub fn calculix(&self) -> (Answer<STATE>, [[f64; 6]; 6]) {
        // CalculiX gets a smaller increment and no code: it is the point entry's. For wrong properties the entry would
        // end the process.
        let status = Step { tangent: true, ..*self }.point::<f64>(false).status;
        let mut host =
            CalculixPoint::<STATE> { state_old: *self.state, state: *self.state, ..CalculixPoint::new(*self.f) };
        if status == status::OK || status <= status::INVERTED {
            host.call_law::<L>(self.properties);
        }
        let entry = |i: usize, j: usize| host.stiffness[if i <= j { i + j * (j + 1) / 2 } else { j + i * (i + 1) / 2 }];
        let material = std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)));
        (Answer { stress: host.stress, state: host.state, ..self.refused(status) }, material)
    }

    /// The point as an element amid others of a group.
    pub fn openradioss(&self) -> Answer<STATE> {
        let ((n, at, _), layout) = (place(self.line), Layout::of::<f64, Precise<L, f64>>(LAWS[L::NUMBER].user));
        // Every other line has the direction in UVAR. That of the properties is checked first.
        let mut group = match OpenradiossGroup::of(layout, n, self.properties, false) {
            Ok(group) => group,
            Err(status) => return self.refused(status),
        };
        if self.line.is_multiple_of(2) {
            group = OpenradiossGroup::of(layout, n, self.properties, true).unwrap_or(group);
            (0..3).for_each(|c| group.uvar[(layout.fibre() + c) * n..][..n].fill(self.properties[FIBRE + c]));
        }
        (0..STATE).for_each(|c| group.uvar[c * n + at] = self.state[c]);
        for i in 0..n {
            (0..9).for_each(|c| group.gradient[c * OpenradiossGroup::<f64>::LENGTH + i] = self.gradient(i, at)[c]);
        }
        let code = group.call();
        if code != status::OK {
            return self.refused(code);
        }
        let variable = |number: usize| group.uvar[number * n + at];
        Answer {
            stress: std::array::from_fn(|c| group.stress[c * OpenradiossGroup::<f64>::LENGTH + at]),
            state: std::array::from_fn(variable),
            ..self.refused(variable(layout.deleted()).min(0.0) as i32)
        }
    }
}
