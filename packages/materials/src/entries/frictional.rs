//! A step of the law with friction at one point through a C entry as its host would call it, from an old state to an
//! answer in the library's order: for `eval`.

use std::f64::consts::SQRT_2;
use std::ptr::null_mut;

use super::blocks::{message_in, prepared_frictional};
use super::evaluation::{NEIGHBOURS, place};
use super::hosts::{CalculixPoint, MgisPoint, MgisTangent, OpenradiossGroup, Umat};
use super::precision::BlockPrecision;
use toron::Frictional;
use toron::host::abaqus::{self, ExplicitLaw};
use toron::host::laws::LAWS;
use toron::host::lsdyna::{self, UmatVector, UserRoutines};
use toron::host::mgis::INTEGRATED;
use toron::host::openradioss::card::Layout;
use toron::law::parameters::{FIBRE, FRICTIONAL_PROPERTIES};
use toron::law::state::{FRICTIONAL_FAILED, FRICTIONAL_PARTS, FRICTIONAL_STATE};
use toron::law::status;
use toron_c::{Block, Point, TORON_FRICTIONAL};

pub const PROPERTIES: usize = FRICTIONAL_PROPERTIES;
pub const STATE: usize = FRICTIONAL_STATE;

/// The law as a material of OpenRadioss.
const LAYOUT: Layout = Layout::of::<f64, Frictional>(LAWS[TORON_FRICTIONAL as usize].user);

/// What a step starts from.
#[derive(Clone, Copy, Debug)]
pub struct Step<'a> {
    pub properties: &'a [f64; PROPERTIES],
    /// F at its end, by columns.
    pub f: &'a [f64; 9],
    pub state: &'a [f64; STATE],
    /// Whether DDSDDE is wanted.
    pub tangent: bool,
    /// By which the place of the point among others changes.
    pub line: usize,
}

/// The outputs of an entry: stress in the library's order, state, DDSDDE where it is wanted and the entry has it.
#[derive(Clone, Copy, Debug)]
pub struct Answer {
    pub status: i32,
    pub stress: [f64; 6],
    pub state: [f64; STATE],
    pub ddsdde: Option<[[f64; 6]; 6]>,
}

/// What a status means; for properties, which one is wrong.
pub fn message(code: i32, properties: &[f64; PROPERTIES]) -> String {
    prepared_frictional(properties).err().unwrap_or_else(|| {
        let mut text = [0_u8; toron_c::TORON_MESSAGE_CAPACITY];
        // SAFETY: the text has the size passed.
        unsafe { toron_c::toron_status_message(code, text.as_mut_ptr().cast(), text.len()) };
        message_in(&text)
    })
}

fn rounded<T: BlockPrecision, const N: usize>(values: &[f64; N]) -> [T; N] {
    values.map(T::from_f64)
}

impl Step<'_> {
    /// The answer where there is none: no stress, the old state.
    fn refused(&self, status: i32) -> Answer {
        Answer { status, stress: [0.0; 6], state: *self.state, ddsdde: None }
    }

    /// Through the entry for a point in either precision, with a law that has been prepared or its properties.
    pub fn point<T: BlockPrecision>(&self, with_properties: bool) -> Answer {
        let (properties, f, mut state) =
            (rounded::<T, _>(self.properties), rounded::<T, _>(self.f), rounded(self.state));
        let (mut stress, mut rows) = ([T::default(); 6], [[T::default(); 6]; 6]);
        let state_new = state.as_mut_ptr();
        let point = Point {
            measure: toron_c::TORON_TANGENT_JAUMANN,
            deformation_gradient: f.as_ptr(),
            state_old: state_new,
            state_new,
            stress: stress.as_mut_ptr(),
            tangent: if self.tangent { rows.as_mut_ptr().cast() } else { null_mut() },
            ..Point::empty()
        };
        let law = prepared_frictional(&properties).ok().filter(|_| !with_properties);
        let (values, count) = (properties.as_ptr(), properties.len());
        // SAFETY: the arrays have the sizes that the entry asks for; the new state replaces the old one.
        let status = unsafe {
            match law {
                Some(law) => T::FRICTIONAL_POINT(&law, &point, null_mut(), 0),
                None => T::FRICTIONAL_POINT_WITH_PROPERTIES(values, count, &point, null_mut(), 0),
            }
        };
        Answer {
            status,
            stress: stress.map(Into::into),
            state: state.map(Into::into),
            ddsdde: self.tangent.then(|| rows.map(|row| row.map(Into::into))),
        }
    }

    /// Through the entry for blocks, the point amid others, which start at rest.
    pub fn block<T: BlockPrecision>(&self) -> Answer {
        let (n, at, stride) = place(self.line);
        let array = |components: usize| vec![T::default(); components * stride];
        let (mut f, mut fibre, mut state) = (array(9), array(3), array(STATE));
        let (mut stress, mut rows, mut codes) = (array(6), array(36), vec![0; n]);
        for i in 0..n {
            let own = if i == at { self.f } else { &NEIGHBOURS[(self.line + i) % NEIGHBOURS.len()] };
            own.iter().enumerate().for_each(|(c, &value)| f[c * stride + i] = T::from_f64(value));
            for c in 0..3 {
                fibre[c * stride + i] = T::from_f64(self.properties[FIBRE + c]);
            }
        }
        self.state.iter().enumerate().for_each(|(c, &value)| state[c * stride + at] = T::from_f64(value));
        let [energies, invariants, _] = FRICTIONAL_PARTS;
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
            tangent: if self.tangent { rows.as_mut_ptr() } else { null_mut() },
            status: codes.as_mut_ptr(),
            ..Block::empty()
        };
        (block.deformation_gradient[0], block.stress[0]) = (f.as_ptr(), stress.as_mut_ptr());
        // Every other line gives the direction point by point.
        if self.line.is_multiple_of(2) {
            block.fibre[0] = fibre.as_ptr();
        }
        let Ok(law) = prepared_frictional(&rounded::<T, _>(self.properties)) else { return self.point::<T>(true) };
        // SAFETY: the arrays have the sizes that the structure tells; the new state replaces the old one.
        let worst = unsafe { T::FRICTIONAL_BLOCK(&law, &block, null_mut(), 0) };
        let value = |array: &[T], c: usize| array[c * stride + at].into();
        Answer {
            status: if worst > status::INVERTED { worst } else { codes[at] },
            stress: std::array::from_fn(|c| value(&stress, c)),
            state: std::array::from_fn(|c| value(&state, c)),
            ddsdde: self.tangent.then(|| std::array::from_fn(|i| std::array::from_fn(|j| value(&rows, 6 * i + j)))),
        }
    }

    pub fn umat(&self) -> Answer {
        let (mut point, mut ddsdde) = (Umat { statev: *self.state, ..Umat::<STATE>::FRESH }, [[0.0; 6]; 6]);
        let status = point.call_law::<Frictional>(self.properties, self.f, self.tangent.then_some(&mut ddsdde));
        let Umat { stress: [s11, s22, s33, s12, s13, s23], statev, .. } = point;
        let order = [0, 1, 2, 3, 5, 4];
        Answer {
            status,
            stress: [s11, s22, s33, s12, s23, s13],
            state: statev,
            // A matrix of Fortran's, by columns.
            ddsdde: self.tangent.then(|| order.map(|i| order.map(|j| ddsdde[j][i]))),
        }
    }

    /// A VUMAT of one point at the stretch U, 11 22 33 12 23 31; the stress is the corotational one.
    pub fn vumat<T: BlockPrecision>(&self, stretch: &[f64; 6]) -> Answer {
        let (properties, stretch, old) =
            (rounded::<T, _>(self.properties), rounded::<T, _>(stretch), rounded(self.state));
        let (zeros, one) = ([T::default(); 6], [T::from_f64(1.0)]);
        let (mut stress, mut state, mut energies) = (zeros, old, [T::default(); 2]);
        let [internal, inelastic] = &mut energies;
        let block = abaqus::Vumat {
            nblock: 1,
            ndir: 3,
            nshr: 3,
            nstatev: STATE as i32,
            nprops: PROPERTIES as i32,
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
        let status = unsafe { <Frictional<T> as ExplicitLaw<T>>::vumat(&block, null_mut(), 0) };
        Answer { status, stress: stress.map(Into::into), state: state.map(Into::into), ddsdde: None }
    }

    /// LS-DYNA's material constants: 48 of them, the moduli for its time step behind the properties.
    fn lsdyna_constants(&self) -> [f64; 48] {
        let mut cm = [0.0; 48];
        cm[..PROPERTIES].copy_from_slice(self.properties);
        let [bulk, shear] = [PROPERTIES, PROPERTIES + 1].map(|i| &raw mut cm[i]);
        let (values, count) = (self.properties.as_ptr(), PROPERTIES);
        // SAFETY: the arrays have the sizes that the entry asks for. Bad properties are the material routine's to report.
        unsafe { Frictional::<f64>::card_moduli(values, count, bulk, shear, null_mut(), 0) };
        cm
    }

    pub fn lsdyna(&self) -> Answer {
        let (cm, mut history, mut failed) = (self.lsdyna_constants(), [0.0; STATE + 9], 0);
        let mut answer = self.refused(status::OK);
        history[..STATE].copy_from_slice(self.state);
        history[STATE..].copy_from_slice(self.f);
        let element = lsdyna::Umat {
            cm: cm.as_ptr(),
            sig: answer.stress.as_mut_ptr(),
            hsv: history.as_mut_ptr(),
            nhv: STATE as i32,
            failel: &mut failed,
        };
        // SAFETY: the arrays have the sizes that the structure tells.
        answer.status = unsafe { Frictional::<f64>::umat(&element, null_mut(), 0) };
        answer.state.copy_from_slice(&history[..STATE]);
        answer.state[FRICTIONAL_FAILED] = f64::from(failed);
        answer
    }

    /// The element amid others of a vector, elements `lft` to `llt` of `nlq`.
    pub fn lsdyna_vector(&self) -> Answer {
        let (n, at, stride) = place(self.line);
        let first = self.line % 3;
        let (nlq, at, cm) = (stride + first, first + at, self.lsdyna_constants());
        let (mut history, mut stress, mut failed) = (vec![0.0; (STATE + 9) * nlq], vec![0.0; 6 * nlq], vec![0; nlq]);
        for i in 0..n {
            let own = if first + i == at { self.f } else { &NEIGHBOURS[(self.line + i) % NEIGHBOURS.len()] };
            own.iter().enumerate().for_each(|(c, &value)| history[(STATE + c) * nlq + first + i] = value);
        }
        self.state.iter().enumerate().for_each(|(c, &value)| history[c * nlq + at] = value);
        let elements = UmatVector {
            cm: cm.as_ptr(),
            sig: [0, 1, 2, 3, 4, 5].map(|c| stress[c * nlq..].as_mut_ptr()),
            hsvs: history.as_mut_ptr(),
            nhv: STATE as i32,
            lft: first as i32 + 1,
            llt: (first + n) as i32,
            nlq: nlq as i32,
            failels: failed.as_mut_ptr(),
        };
        // SAFETY: the arrays have the sizes that the structure tells.
        let worst = unsafe { Frictional::<f64>::umat_vector(&elements, null_mut(), 0) };
        let mut answer = Answer {
            status: status::OK,
            stress: std::array::from_fn(|c| stress[c * nlq + at]),
            state: std::array::from_fn(|c| history[c * nlq + at]),
            ddsdde: None,
        };
        answer.state[FRICTIONAL_FAILED] = f64::from(failed[at]);
        // LS-DYNA sees no code of an element, only that it failed: the point entry tells why.
        answer.status = match worst > status::INVERTED {
            true => worst,
            false if failed[at] != 0 => self.point::<f64>(false).status,
            false => status::OK,
        };
        answer
    }

    /// Through MGIS; with `tangent` dS/dE too, tensor components 11 22 33 12 13 23.
    pub fn mgis(&self) -> (Answer, Option<[[f64; 6]; 6]>) {
        let mut host = MgisPoint::<STATE> { state_old: *self.state, ..MgisPoint::new(self.f) };
        let request = if self.tangent { MgisTangent::Material } else { MgisTangent::None };
        if host.call_law::<Frictional>(self.properties, request) != INTEGRATED {
            // MGIS gets a text and no code: it is the point entry's.
            let code = self.point::<f64>(false).status;
            return (self.refused(if code == status::OK { status::BAD_ARGUMENT } else { code }), None);
        }
        let [s11, s22, s33, s12, s13, s23] = host.stress;
        let stress = [s11, s22, s33, s12 / SQRT_2, s23 / SQRT_2, s13 / SQRT_2];
        let factor = |i: usize, j: usize| match (i < 3, j < 3) {
            (true, true) => 1.0,
            (false, false) => 2.0,
            _ => SQRT_2,
        };
        let material = || std::array::from_fn(|i| std::array::from_fn(|j| host.k[6 * i + j] / factor(i, j)));
        (Answer { stress, state: host.state, ..self.refused(status::OK) }, self.tangent.then(material))
    }

    /// The second Piola–Kirchhoff stress through CalculiX, in place of the Cauchy stress, and the symmetric part of dS/dE,
    /// tensor components; both 11 22 33 12 13 23.
    pub fn calculix(&self) -> (Answer, [[f64; 6]; 6]) {
        // CalculiX gets a smaller increment and no code: it is the point entry's. For wrong properties the entry would end
        // the process.
        let status = self.point::<f64>(false).status;
        let mut host =
            CalculixPoint::<STATE> { state_old: *self.state, state: *self.state, ..CalculixPoint::new(*self.f) };
        if status == status::OK || status <= status::INVERTED {
            host.call_law::<Frictional>(self.properties);
        }
        let entry = |i: usize, j: usize| host.stiffness[if i <= j { i + j * (j + 1) / 2 } else { j + i * (i + 1) / 2 }];
        let material = std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)));
        (Answer { stress: host.stress, state: host.state, ..self.refused(status) }, material)
    }

    /// The point as an element amid others of a group.
    pub fn openradioss(&self) -> Answer {
        let ((n, at, _), layout) = (place(self.line), LAYOUT);
        // Every other line has the direction in UVAR. That of the properties is checked first.
        let mut group = match OpenradiossGroup::of(layout, n, self.properties, false) {
            Ok(group) => group,
            Err(status) => return self.refused(status),
        };
        if self.line.is_multiple_of(2) {
            group = OpenradiossGroup::of(layout, n, self.properties, true).unwrap_or(group);
            for c in 0..3 {
                group.uvar[(layout.fibre() + c) * n..][..n].fill(self.properties[FIBRE + c]);
            }
        }
        self.state.iter().enumerate().for_each(|(c, &value)| group.uvar[c * n + at] = value);
        for i in 0..n {
            let own = if i == at { self.f } else { &NEIGHBOURS[(self.line + i) % NEIGHBOURS.len()] };
            for (c, &value) in own.iter().enumerate() {
                group.gradient[c * OpenradiossGroup::<f64>::LENGTH + i] = value;
            }
        }
        let code = group.call();
        if code != status::OK {
            return self.refused(code);
        }
        let variable = |number: usize| group.uvar[number * n + at];
        Answer {
            status: variable(layout.deleted()).min(0.0) as i32,
            stress: std::array::from_fn(|c| group.stress[c * OpenradiossGroup::<f64>::LENGTH + at]),
            state: std::array::from_fn(variable),
            ddsdde: None,
        }
    }
}
