//! Points and arrays as their hosts keep them, and the calls of the C entries on them.

use std::ffi::{c_char, c_int};
use std::ptr::{null, null_mut};

use nalgebra::Matrix3;

use super::aligned::Aligned;
use super::precision::BlockPrecision;
use toron::host::abaqus::StandardLaw;
use toron::host::calculix::{Behaviour, CalculixLaw};
use toron::host::mgis::{self, BehaviourDataView, MgisLaw, StateView};
use toron::host::openradioss;
use toron::host::openradioss::card::{self, Layout};
use toron::host::{abaqus, calculix, lsdyna};
use toron::law::block::Circumstances;
use toron::law::parameters::HYPERELASTIC_PROPERTIES;
use toron::law::state::HYPERELASTIC_STATE;
use toron::{Hyperelastic, Real};
use toron_c::{HyperelasticLaw, Point};

/// The law as an entry for points takes it: its properties, which are checked in every call, or prepared from them.
#[derive(Clone, Copy)]
pub enum Given<'a, T> {
    Properties(&'a [T; HYPERELASTIC_PROPERTIES]),
    Prepared(&'a HyperelasticLaw<T>),
}

/// What a solver keeps of a point of its own between calls: F by columns, stress and state.
#[derive(Clone, Copy, Debug)]
pub struct OnePoint<T> {
    pub deformation_gradient: [T; 9],
    pub stress: [T; 6],
    pub state: [T; HYPERELASTIC_STATE],
    pub status: i32,
}

/// What is asked of the C entry for one point: the stress alone, with the state, with the state and dS/dE.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PointOutputs {
    Stress,
    State,
    Tangent,
}

impl<T: Real> OnePoint<T> {
    /// A point at the start of an analysis.
    pub fn new(deformation_gradient: [T; 9]) -> Self {
        let zero = T::splat(0.0);
        OnePoint { deformation_gradient, stress: [zero; 6], state: [zero; HYPERELASTIC_STATE], status: 0 }
    }
}

impl<T: BlockPrecision> OnePoint<T> {
    /// Calls the entry for each of the points; a tangent goes to `tangent`, and the next one there too. The structure
    /// is filled as in a solver's loop: what does not change, once.
    #[inline]
    pub fn call_each(points: &mut [Self], law: Given<'_, T>, outputs: PointOutputs, tangent: &mut [[T; 6]; 6]) {
        let mut call = Point { measure: toron_c::TORON_TANGENT_MATERIAL, ..Point::empty() };
        if outputs == PointOutputs::Tangent {
            call.tangent = tangent.as_mut_ptr().cast();
        }
        for point in points {
            call.deformation_gradient = point.deformation_gradient.as_ptr();
            call.stress = point.stress.as_mut_ptr();
            if outputs != PointOutputs::Stress {
                call.state_new = point.state.as_mut_ptr();
                call.state_old = call.state_new;
            }
            // SAFETY: the arrays have the sizes that the entry asks for; the new state replaces the old one.
            point.status = unsafe { call_point(law, &call) };
        }
    }
}

/// Calls the entry for one point; returns its status.
///
/// # Safety
/// The arrays of the point have the sizes that the entry asks for.
#[inline]
pub unsafe fn call_point<T: BlockPrecision>(law: Given<'_, T>, point: &Point<T>) -> i32 {
    // SAFETY: the point's arrays are as just said.
    unsafe {
        match law {
            Given::Properties(values) => T::POINT_WITH_PROPERTIES(values.as_ptr(), values.len(), point, null_mut(), 0),
            Given::Prepared(law) => T::POINT(law, point, null_mut(), 0),
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
    /// An element at the start of an analysis.
    pub fn new(f: [T; 9]) -> Self {
        let mut history = [T::default(); HYPERELASTIC_STATE + 9];
        history[HYPERELASTIC_STATE..].copy_from_slice(&f);
        LsdynaElement { stress: [T::default(); 6], history }
    }

    /// Calls the entry; returns its status.
    #[inline]
    pub fn call(&mut self, properties: &[T; HYPERELASTIC_PROPERTIES]) -> i32 {
        let (mut failed, nhv) = (0, HYPERELASTIC_STATE as i32);
        let (cm, sig, hsv) = (properties.as_ptr(), self.stress.as_mut_ptr(), self.history.as_mut_ptr());
        let element = lsdyna::Umat { cm, sig, hsv, nhv, failel: &mut failed };
        // SAFETY: the arrays have the sizes that the structure tells.
        unsafe { T::LSDYNA(&element, null_mut(), 0) }
    }
}

/// A vector of elements as LS-DYNA keeps it, component-major: stress, and the history of eleven state variables and the
/// nine entries of F. They lie behind each other, so that how they share the cache is the same in every program.
#[derive(Debug)]
pub struct LsdynaVector<T> {
    n: usize,
    arrays: Aligned<T>,
    failed: Vec<c_int>,
}

impl<T: BlockPrecision> LsdynaVector<T> {
    pub fn new(n: usize) -> Self {
        let arrays = Aligned::new(T::default(), (6 + HYPERELASTIC_STATE + 9) * n);
        LsdynaVector { n, arrays, failed: vec![0; n] }
    }

    /// An entry of F by columns in an element's history.
    pub fn set_gradient(&mut self, element: usize, entry: usize, value: T) {
        self.arrays[(6 + HYPERELASTIC_STATE + entry) * self.n + element] = value;
    }

    /// Calls the entry; returns its status.
    pub fn call(&mut self, properties: &[T; HYPERELASTIC_PROPERTIES]) -> i32 {
        let (n, s1, last) = (self.n, self.arrays.as_mut_ptr(), self.n as i32);
        let row = |c: usize| s1.wrapping_add(c * n);
        let elements = lsdyna::UmatVector {
            cm: properties.as_ptr(),
            sig: [row(0), row(1), row(2), row(3), row(4), row(5)],
            hsvs: row(6),
            nhv: HYPERELASTIC_STATE as i32,
            lft: 1,
            llt: last,
            nlq: last,
            failels: self.failed.as_mut_ptr(),
        };
        // SAFETY: the arrays have the sizes that the structure tells.
        unsafe { T::LSDYNA_VECTOR(&elements, null_mut(), 0) }
    }
}

/// The arrays of a VUMAT, component-major; a step whose stretch does not change.
#[derive(Debug)]
pub struct VumatArrays<T> {
    pub n: usize,
    pub stretch: Aligned<T>,
    pub state_old: Aligned<T>,
    pub state_new: Aligned<T>,
    pub stress: Aligned<T>,
    /// Zeros and ones for what the law does not look at, or only at the value of.
    zeros: Aligned<T>,
    ones: Aligned<T>,
    energies: [Aligned<T>; 2],
}

impl<T: BlockPrecision> VumatArrays<T> {
    pub fn new(n: usize) -> Self {
        let array = |components: usize| Aligned::new(T::default(), components * n);
        VumatArrays {
            n,
            stretch: array(6),
            state_old: array(HYPERELASTIC_STATE),
            state_new: array(HYPERELASTIC_STATE),
            stress: array(6),
            zeros: array(6),
            ones: Aligned::new(T::from_f64(1.0), n),
            energies: [array(1), array(1)],
        }
    }

    /// Calls the entry; returns its status.
    pub fn call(&mut self, properties: &[T; HYPERELASTIC_PROPERTIES]) -> i32 {
        let zeros = self.zeros.as_ptr();
        let [internal, inelastic] = &mut self.energies;
        let block = abaqus::Vumat {
            nblock: self.n as i32,
            ndir: 3,
            nshr: 3,
            nstatev: HYPERELASTIC_STATE as i32,
            nprops: HYPERELASTIC_PROPERTIES as i32,
            step_time: 1.0,
            total_time: 1.0,
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
            ..abaqus::Vumat::empty()
        };
        // SAFETY: the arrays have the sizes that the structure tells.
        unsafe { T::VUMAT(&block, null_mut(), 0) }
    }
}

/// One integration point as CalculiX hands it over: F and E, the old and the new state, second Piola–Kirchhoff stress
/// and dS/dE.
#[derive(Clone, Copy, Debug)]
pub struct CalculixPoint<const STATE: usize = HYPERELASTIC_STATE> {
    pub deformation_gradient: [f64; 9],
    /// E, 11 22 33 12 13 23.
    pub strain: [f64; 6],
    pub state_old: [f64; STATE],
    pub state: [f64; STATE],
    /// 11 22 33 12 13 23.
    pub stress: [f64; 6],
    /// The upper triangle in that order, by columns.
    pub stiffness: [f64; 21],
    pub pnewdt: f64,
}

impl<const STATE: usize> CalculixPoint<STATE> {
    /// A point at the start of an analysis.
    pub fn new(deformation_gradient: [f64; 9]) -> Self {
        let f = Matrix3::from_column_slice(&deformation_gradient);
        let strain = 0.5 * (f.tr_mul(&f) - Matrix3::identity());
        let strain = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)].map(|component| strain[component]);
        let (state, stress, stiffness) = ([0.0; STATE], [0.0; 6], [0.0; 21]);
        CalculixPoint { deformation_gradient, strain, state_old: state, state, stress, stiffness, pnewdt: 0.0 }
    }

    /// Calls a law's entry. It ends the process where the properties are wrong, as CalculiX wants.
    #[inline(always)]
    fn with(&mut self, properties: &[f64], entry: impl FnOnce(&Behaviour)) {
        let (name, kode, zeros) = ([b' ' as c_char; 80], -100 - properties.len() as i32, [0.0; 9]);
        let (one, none, state_count) = (1, 0, STATE as i32);
        let call = Behaviour {
            amat: name.as_ptr(),
            iel: &one,
            iint: &one,
            kode: &kode,
            elconloc: properties.as_ptr(),
            emec: self.strain.as_ptr(),
            beta: zeros.as_ptr(),
            xkl: self.deformation_gradient.as_ptr(),
            mi: &one,
            nstate_: &state_count,
            xstateini: self.state_old.as_ptr(),
            xstate: self.state.as_mut_ptr(),
            stre: self.stress.as_mut_ptr(),
            stiff: self.stiffness.as_mut_ptr(),
            iorien: &none,
            pgauss: zeros.as_ptr(),
            orab: zeros.as_ptr(),
            pnewdt: &mut self.pnewdt,
            circumstances: Circumstances::UNKNOWN,
        };
        entry(&call);
    }

    /// Calls the entry of another law than the hyperelastic one.
    ///
    /// # Panics
    /// The law has another number of state variables.
    pub fn call_law<L: CalculixLaw>(&mut self, properties: &[f64]) {
        assert_eq!(L::DESCRIPTION.history(), STATE);
        // SAFETY: the arrays have the sizes that CalculiX promises.
        self.with(properties, |call| unsafe { L::behaviour(call) });
    }
}

impl CalculixPoint {
    /// Calls the entry of the hyperelastic law.
    #[inline]
    pub fn call(&mut self, properties: &[f64; HYPERELASTIC_PROPERTIES]) {
        // SAFETY: the arrays have the sizes that CalculiX promises.
        self.with(properties, |call| unsafe { calculix::hyperelastic(call) });
    }
}

/// What a UMAT gets from Abaqus beside deformation gradient and properties, and gives back, in Abaqus's order.
#[derive(Clone, Copy, Debug)]
pub struct Umat<const STATE: usize = HYPERELASTIC_STATE> {
    pub stress: [f64; 6],
    pub statev: [f64; STATE],
    pub sse: f64,
    pub pnewdt: f64,
}

impl<const STATE: usize> Umat<STATE> {
    /// A point at the start of an analysis.
    pub const FRESH: Self = Umat { stress: [0.0; 6], statev: [0.0; STATE], sse: 0.0, pnewdt: 1.0 };

    /// Calls the UMAT of a law, without a place for DDSDDE with a null one; returns its status.
    ///
    /// # Panics
    /// The law has another number of properties or of state variables.
    #[inline(always)]
    pub fn call_law<L: StandardLaw>(
        &mut self,
        properties: &[f64],
        f: &[f64; 9],
        ddsdde: Option<&mut [[f64; 6]; 6]>,
    ) -> i32 {
        assert!(L::DESCRIPTION.state.len() == STATE && L::DESCRIPTION.properties.len() == properties.len());
        let call = abaqus::Umat {
            stress: self.stress.as_mut_ptr(),
            statev: self.statev.as_mut_ptr(),
            ddsdde: ddsdde.map_or(null_mut(), |rows| rows.as_mut_ptr().cast()),
            sse: &mut self.sse,
            pnewdt: &mut self.pnewdt,
            dfgrd0: null(),
            dfgrd1: f.as_ptr(),
            props: properties.as_ptr(),
            nprops: properties.len() as i32,
            nstatv: STATE as i32,
            ndi: 3,
            nshr: 3,
            nlgeom: 1,
            circumstances: Circumstances::UNKNOWN,
        };
        // SAFETY: the arrays have the sizes that the structure tells.
        unsafe { L::umat(&call, null_mut(), 0) }
    }
}

impl Umat {
    /// Calls the UMAT of the hyperelastic law.
    #[inline]
    pub fn call(
        &mut self,
        properties: &[f64; HYPERELASTIC_PROPERTIES],
        f: &[f64; 9],
        ddsdde: Option<&mut [[f64; 6]; 6]>,
    ) -> i32 {
        self.call_law::<Hyperelastic>(properties, f, ddsdde)
    }
}

/// The tangent that a call through MGIS requests.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MgisTangent {
    None,
    /// dσ/dF, 6×9: what MGIS and MTest request if they are not told otherwise.
    CauchyByGradient,
    /// dS/dE, 6×6.
    Material,
}

/// One integration point in three dimensions as MGIS hands it over, in MFront's orders.
#[derive(Clone, Copy, Debug)]
pub struct MgisPoint<const STATE: usize = HYPERELASTIC_STATE> {
    /// 11 22 33 12 21 13 31 23 32.
    pub gradients: [f64; 9],
    pub state_old: [f64; STATE],
    pub state: [f64; STATE],
    /// Cauchy stress 11 22 33 √2·12 √2·13 √2·23.
    pub stress: [f64; 6],
    pub stored_energy: f64,
    pub dissipated_energy: f64,
    /// The request, and the tangent by rows.
    pub k: [f64; 54],
}

impl<const STATE: usize> MgisPoint<STATE> {
    /// A point at the start of an analysis.
    pub const FRESH: Self = MgisPoint {
        gradients: [1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        state_old: [0.0; STATE],
        state: [0.0; STATE],
        stress: [0.0; 6],
        stored_energy: 0.0,
        dissipated_energy: 0.0,
        k: [0.0; 54],
    };

    /// A point at the start of an analysis, but for its F, given by columns.
    pub fn new(&[f11, f21, f31, f12, f22, f32, f13, f23, f33]: &[f64; 9]) -> Self {
        MgisPoint { gradients: [f11, f22, f33, f12, f21, f13, f31, f23, f32], ..Self::FRESH }
    }

    /// Calls a law's behaviour; returns what it returns: 1, or −1 if the point is not integrated.
    #[inline(always)]
    fn with(
        &mut self,
        properties: &[f64],
        tangent: MgisTangent,
        behaviour: impl FnOnce(&mut BehaviourDataView) -> i32,
    ) -> i32 {
        /// Neither the old stress nor the external state variables are read, nor the first gradients for these
        /// tangents.
        const AT_REST: &[f64; 9] = &MgisPoint::<0>::FRESH.gradients;
        (self.k[0], self.k[1], self.k[2]) = match tangent {
            MgisTangent::None => (0.0, 0.0, 0.0),
            MgisTangent::CauchyByGradient => (4.0, 0.0, 0.0),
            MgisTangent::Material => (4.0, 0.0, 1.0),
        };
        let (nothing, mut rdt) = (null_mut::<f64>(), 1.0);
        let mut view = BehaviourDataView {
            error_message: null_mut(),
            dt: 0.0,
            k: self.k.as_mut_ptr(),
            rdt: &mut rdt,
            speed_of_sound: nothing,
            s0: StateView {
                gradients: AT_REST.as_ptr(),
                thermodynamic_forces: nothing,
                mass_density: nothing,
                material_properties: properties.as_ptr(),
                internal_state_variables: self.state_old.as_mut_ptr(),
                stored_energy: nothing,
                dissipated_energy: nothing,
                external_state_variables: nothing,
            },
            s1: StateView {
                gradients: self.gradients.as_ptr(),
                thermodynamic_forces: self.stress.as_mut_ptr(),
                mass_density: nothing,
                material_properties: properties.as_ptr(),
                internal_state_variables: self.state.as_mut_ptr(),
                stored_energy: &mut self.stored_energy,
                dissipated_energy: &mut self.dissipated_energy,
                external_state_variables: nothing,
            },
        };
        behaviour(&mut view)
    }

    /// Calls the behaviour of another law than the hyperelastic one.
    ///
    /// # Panics
    /// The law has another number of state variables.
    pub fn call_law<L: MgisLaw>(&mut self, properties: &[f64], tangent: MgisTangent) -> i32 {
        assert_eq!(L::DESCRIPTION.history(), STATE);
        // SAFETY: the arrays have the sizes that the symbols of the behaviour tell.
        self.with(properties, tangent, |view| unsafe { L::integrate(view) })
    }
}

impl MgisPoint {
    /// Calls the behaviour of the hyperelastic law.
    #[inline]
    pub fn call(&mut self, properties: &[f64; HYPERELASTIC_PROPERTIES], tangent: MgisTangent) -> i32 {
        // SAFETY: the arrays have the sizes that the symbols of the behaviour tell.
        self.with(properties, tangent, |view| unsafe { mgis::hyperelastic(view) })
    }
}

/// A group of elements as OpenRadioss keeps it: F, by columns, and the stress in arrays of the solver's vector length,
/// the others of the group's.
#[derive(Debug)]
pub struct OpenradiossGroup<T> {
    pub n: usize,
    pub gradient: Aligned<T>,
    pub stress: Aligned<T>,
    pub uvar: Aligned<T>,
    pub off: Aligned<T>,
    sound_speed: Aligned<T>,
    uparam: Aligned<T>,
    density: T,
    layout: Layout,
}

impl<T: BlockPrecision> OpenradiossGroup<T> {
    /// The solver's vector length: no group has more elements.
    pub const LENGTH: usize = 129;

    /// `n` elements at the start, of the hyperelastic law. Their fibre direction is that of the properties, or that of
    /// UVAR.
    ///
    /// # Errors
    /// The properties are wrong: the status code.
    pub fn new(n: usize, properties: &[T; HYPERELASTIC_PROPERTIES], fibre_in_uvar: bool) -> Result<Self, i32> {
        Self::of(card::HYPERELASTIC, n, properties, fibre_in_uvar)
    }

    /// The same of any law with a fibre.
    ///
    /// # Errors
    /// The properties are wrong: the status code.
    pub fn of(layout: Layout, n: usize, properties: &[T], fibre_in_uvar: bool) -> Result<Self, i32> {
        let array = |components: usize, length: usize| Aligned::new(T::default(), components * length);
        let mut uparam = array(1, layout.parameters());
        let option = [T::from_f64(if fibre_in_uvar { 2.0 } else { 0.0 })];
        let values = [properties, &option].concat();
        openradioss::read(&T::TORON, layout.number, &values, &mut uparam).map_err(|error| error.code())?;
        Ok(OpenradiossGroup {
            n,
            gradient: array(9, Self::LENGTH),
            stress: array(6, Self::LENGTH),
            uvar: array(layout.variables(), n),
            off: Aligned::new(T::from_f64(1.0), n),
            sound_speed: array(1, n),
            uparam,
            density: T::from_f64(1.0),
            layout,
        })
    }

    /// Calls the entry, as in a later cycle than the first; returns its status.
    pub fn call(&mut self) -> i32 {
        // Addresses by steps from the first, without a check of each, which would take a tenth of a call for few
        // elements.
        let (first, stress) = (self.gradient.as_ptr(), self.stress.as_mut_ptr());
        let f = |row: usize, column: usize| first.wrapping_add((3 * column + row) * Self::LENGTH);
        let stress = |c: usize| stress.wrapping_add(c * Self::LENGTH);
        let group = openradioss::Group {
            elements: self.n as i32,
            parameters: self.uparam.len() as i32,
            variables: self.layout.variables() as i32,
            time: T::from_f64(1e-6),
            time_step: T::from_f64(1e-9),
            uparam: self.uparam.as_ptr(),
            numbers: null(),
            density: &self.density,
            deformation_gradient: [f(0, 0), f(1, 1), f(2, 2), f(0, 1), f(1, 2), f(2, 0), f(1, 0), f(2, 1), f(0, 2)],
            stress: [stress(0), stress(1), stress(2), stress(3), stress(4), stress(5)],
            viscous: [null_mut(); 6],
            sound_speed: self.sound_speed.as_mut_ptr(),
            viscosity: null_mut(),
            uvar: self.uvar.as_mut_ptr(),
            off: self.off.as_mut_ptr(),
            nodes: null(),
            volume: null(),
        };
        // SAFETY: the arrays have the sizes that the structure tells.
        unsafe { T::OPENRADIOSS(&group, null_mut(), 0) }
    }
}
