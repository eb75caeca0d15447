//! One call of a UMAT: the arguments exactly as Abaqus/Standard passes them, and what comes back.

use std::ffi::c_char;
use std::io;
use std::path::Path;

use nalgebra::Matrix3;

use super::guarded::{Guard, Guarded};
use super::kinematics::{Components, Modulus};
use super::material::Material;
use super::shared::Shared;

type Reals = *mut f64;
/// A law may write to what is its caller's own.
type Whole = *mut i32;

/// `SUBROUTINE UMAT(STRESS, STATEV, DDSDDE, SSE, ...)`, with the length of CMNAME behind the last argument.
type Umat = unsafe extern "C" fn(
    Reals,       // STRESS
    Reals,       // STATEV
    Reals,       // DDSDDE
    Reals,       // SSE
    Reals,       // SPD
    Reals,       // SCD
    Reals,       // RPL
    Reals,       // DDSDDT
    Reals,       // DRPLDE
    Reals,       // DRPLDT
    Reals,       // STRAN
    Reals,       // DSTRAN
    Reals,       // TIME
    Reals,       // DTIME
    Reals,       // TEMP
    Reals,       // DTEMP
    Reals,       // PREDEF
    Reals,       // DPRED
    *mut c_char, // CMNAME
    Whole,       // NDI
    Whole,       // NSHR
    Whole,       // NTENS
    Whole,       // NSTATV
    Reals,       // PROPS
    Whole,       // NPROPS
    Reals,       // COORDS
    Reals,       // DROT
    Reals,       // PNEWDT
    Reals,       // CELENT
    Reals,       // DFGRD0
    Reals,       // DFGRD1
    Whole,       // NOEL
    Whole,       // NPT
    Whole,       // LAYER
    Whole,       // KSPT
    Whole,       // JSTEP(4)
    Whole,       // KINC
    usize,
);
/// `SUBROUTINE SDVINI(STATEV, COORDS, NSTATV, NCRDS, NOEL, NPT, LAYER, KSPT)`.
type Sdvini = unsafe extern "C" fn(Reals, Reals, Whole, Whole, Whole, Whole, Whole, Whole);
/// `SUBROUTINE SIGINI(SIGMA, COORDS, NTENS, NCRDS, NOEL, NPT, LAYER, KSPT, LREBAR, NAMES)`, NAMES of two.
type Sigini =
    unsafe extern "C" fn(Reals, Reals, Whole, Whole, Whole, Whole, Whole, Whole, Whole, *mut [c_char; 80], usize);
/// `SUBROUTINE UEXTERNALDB(LOP, LRESTART, TIME, DTIME, KSTEP, KINC)`.
type Uexternaldb = unsafe extern "C" fn(Whole, Whole, Reals, Reals, Whole, Whole);

/// A loaded library's subroutines.
pub struct Law {
    umat: Umat,
    sdvini: Option<Sdvini>,
    sigini: Option<Sigini>,
    uexternaldb: Option<Uexternaldb>,
    library: libloading::Library,
}

impl Law {
    /// Loads a library; symbols that are missing are looked for when they are called.
    ///
    /// # Errors
    /// It cannot be loaded, or has no UMAT.
    pub fn load(path: &Path) -> Result<Law, String> {
        use libloading::os::unix::{Library, RTLD_LAZY, RTLD_LOCAL};
        // SAFETY: what a library does as it is loaded is its author's affair; this process is there to bear it.
        let library = unsafe { Library::open(Some(path), RTLD_LAZY | RTLD_LOCAL) };
        let library = libloading::Library::from(library.map_err(|error| why(&error))?);
        let umat = symbol::<Umat>(&library, "umat").ok_or_else(|| without_umat(path))?;
        let (sdvini, uexternaldb) = (symbol(&library, "sdvini"), symbol(&library, "uexternaldb"));
        let sigini = symbol(&library, "sigini");
        Ok(Law { umat, sdvini, sigini, uexternaldb, library })
    }

    /// Has a build that counts its lines write the counts; whether it is one.
    pub fn write_counts(&self) -> bool {
        write_counts(&self.library)
    }

    /// LOP = 0: the beginning of the analysis; Abaqus calls it before all else.
    pub fn begin(&self) {
        if let Some(uexternaldb) = self.uexternaldb {
            let (mut time, mut step) = ([0.0; 2], 0.0);
            let [mut when, mut restart, mut number, mut increment] = [0, 0, 1, 0];
            // SAFETY: the arguments that Abaqus passes, each as long as it is declared.
            unsafe {
                uexternaldb(&mut when, &mut restart, time.as_mut_ptr(), &mut step, &mut number, &mut increment);
            }
        }
    }
}

/// Why a library is not loaded, in the loader's words.
pub fn why(error: &libloading::Error) -> String {
    use std::error::Error;
    error.source().map_or_else(|| error.to_string(), |source| format!("{error}: {source}"))
}

/// Has a build that counts its lines write the counts; whether it is one.
pub fn write_counts(library: &libloading::Library) -> bool {
    let write = symbol::<unsafe extern "C" fn()>(library, "toron_counts");
    // SAFETY: the routine of `counts.c`, without arguments.
    write.map(|write| unsafe { write() }).is_some()
}

/// The error of a library without UMAT: which other routine it has, by the names of its symbols.
fn without_umat(path: &Path) -> String {
    let bytes = std::fs::read(path).unwrap_or_default();
    let is_name = |text: &&str| text.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_');
    let texts = bytes.split(|&byte| byte == 0).filter_map(|text| std::str::from_utf8(text).ok()).filter(is_name);
    let mut names: Vec<String> = texts
        .filter(|text| text.to_lowercase().contains("umat") && text.ends_with('_'))
        .map(|text| text.trim_end_matches('_').to_uppercase())
        .collect();
    names.sort();
    names.dedup();
    let instead = if names.is_empty() { String::new() } else { format!("; there is {}", names.join(", ")) };
    format!("there is no subroutine UMAT (symbol umat_){instead}")
}

/// The address of a subroutine, under the names that compilers give it.
pub fn symbol<T: Copy>(library: &libloading::Library, name: &str) -> Option<T> {
    [format!("{name}_"), name.to_uppercase(), name.to_string()].iter().find_map(|name| {
        // SAFETY: the caller's type is that of the subroutine of this name.
        unsafe { library.get::<T>(name.as_bytes()) }.ok().map(|symbol| *symbol)
    })
}

/// What a call gets, but for the material.
#[derive(Clone, Debug, PartialEq)]
pub struct Call {
    pub stress: Components,
    pub state: Vec<f64>,
    /// SSE, SPD, SCD.
    pub energies: [f64; 3],
    pub strain: Components,
    pub strain_increment: Components,
    /// TIME: of the step and in all, at the increment's beginning.
    pub time: [f64; 2],
    pub time_step: f64,
    pub temperature: f64,
    /// DROT.
    pub rotation: Matrix3<f64>,
    pub f0: Matrix3<f64>,
    pub f1: Matrix3<f64>,
    /// NOEL, NPT.
    pub place: [i32; 2],
    /// KINC.
    pub increment: i32,
    /// What DDSDDE has before.
    pub unset: f64,
    /// KSTEP.
    pub step: i32,
}

impl Call {
    /// As numbers in a row, for [`Shared`] and files.
    pub fn numbers(&self) -> Vec<f64> {
        self.named().into_iter().flat_map(|(_, numbers)| numbers).collect()
    }

    /// The numbers of the row with their names, in order.
    pub fn named(&self) -> [(&'static str, Vec<f64>); 16] {
        [
            ("NSTATV", vec![self.state.len() as f64]),
            ("STRESS", self.stress.to_vec()),
            ("STATEV", self.state.clone()),
            ("SSE, SPD, SCD", self.energies.to_vec()),
            ("STRAN", self.strain.to_vec()),
            ("DSTRAN", self.strain_increment.to_vec()),
            ("TIME", self.time.to_vec()),
            ("DTIME", vec![self.time_step]),
            ("TEMP", vec![self.temperature]),
            ("DROT, by columns", self.rotation.iter().copied().collect()),
            ("DFGRD0, by columns", self.f0.iter().copied().collect()),
            ("DFGRD1, by columns", self.f1.iter().copied().collect()),
            ("NOEL, NPT", self.place.map(f64::from).to_vec()),
            ("KINC", vec![f64::from(self.increment)]),
            ("DDSDDE before the call", vec![self.unset]),
            ("KSTEP", vec![f64::from(self.step)]),
        ]
    }

    /// From the bits of numbers in a row: they need not be finite.
    pub fn from_bits(row: &[u64]) -> Option<Call> {
        Call::from_numbers(&row.iter().map(|&bits| f64::from_bits(bits)).collect::<Vec<f64>>())
    }

    /// From numbers in a row.
    pub fn from_numbers(row: &[f64]) -> Option<Call> {
        let mut rest = row.iter().copied();
        let states = rest.next()? as usize;
        let mut take = |count: usize| {
            let taken: Vec<f64> = rest.by_ref().take(count).collect();
            (taken.len() == count).then_some(taken)
        };
        let six = |row: Vec<f64>| Components::try_from(row).ok();
        Some(Call {
            stress: six(take(6)?)?,
            state: take(states)?,
            energies: take(3)?.try_into().ok()?,
            strain: six(take(6)?)?,
            strain_increment: six(take(6)?)?,
            time: take(2)?.try_into().ok()?,
            time_step: take(1)?[0],
            temperature: take(1)?[0],
            rotation: Matrix3::from_vec(take(9)?),
            f0: Matrix3::from_vec(take(9)?),
            f1: Matrix3::from_vec(take(9)?),
            place: [take(1)?[0] as i32, take(1)?[0] as i32],
            increment: take(1)?[0] as i32,
            unset: take(1)?[0],
            step: take(1).map_or(1, |step| step[0] as i32),
        })
    }
}

/// What a call gives.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    pub stress: Components,
    pub state: Vec<f64>,
    /// DDSDDE, by rows.
    pub modulus: Modulus,
    /// SSE, SPD, SCD.
    pub energies: [f64; 3],
    /// PNEWDT; below 1 the law wants a smaller increment.
    pub next_step: f64,
}

impl Answer {
    pub fn refused(&self) -> bool {
        self.next_step < 1.0
    }

    pub fn finite(&self) -> bool {
        let modulus = self.modulus.iter().flatten();
        self.stress.iter().chain(&self.state).chain(modulus).all(|value| value.is_finite())
    }

    /// Every bit is the same; a NaN equals itself.
    pub fn same(&self, other: &Answer) -> bool {
        let bits = |answer: &Answer| {
            let modulus = answer.modulus.iter().flatten();
            let all = answer.stress.iter().chain(&answer.state).chain(modulus).chain(&answer.energies);
            all.map(|value| value.to_bits()).collect::<Vec<_>>()
        };
        bits(self) == bits(other)
    }
}

/// PNEWDT before a call; Abaqus sets it to a large number.
const NO_WISH: f64 = 1e36;

/// WorkDir for the calls of one thread.
pub struct Session<'a> {
    law: &'a Law,
    pub material: &'a Material,
    name: [c_char; 80],
    /// PROPS, at first those of the material.
    pub properties: Vec<f64>,
    /// Whether inputs that a call writes to are noted, and which these are.
    pub watched: Option<Vec<&'static str>>,
    /// The stress moves in steps: differences are to be taken of large ones.
    pub coarse: bool,
    stress: Guarded,
    state: Guarded,
    modulus: Guarded,
    constants: Guarded,
    shared: Option<Shared>,
    records: bool,
    exchanged: bool,
}

/// The places of 13 and 23.
const PLACES: (usize, usize) = (4, 5);

impl<'a> Session<'a> {
    /// # Errors
    /// The system has no memory.
    pub fn new(law: &'a Law, material: &'a Material, guard: Guard, shared: Option<Shared>) -> io::Result<Self> {
        let components = material.components;
        let mut session = Session {
            law,
            material,
            name: [b' ' as c_char; 80],
            stress: Guarded::new(components, guard)?,
            state: Guarded::new(material.initial.len(), guard)?,
            modulus: Guarded::new(components * components, guard)?,
            properties: material.properties.clone(),
            watched: None,
            coarse: false,
            constants: Guarded::new(material.properties.len(), guard)?,
            shared,
            records: true,
            exchanged: false,
        };
        session.call_material(&material.name);
        if let Some(shared) = shared {
            let arrays = [&session.state, &session.constants, &session.stress, &session.modulus];
            for (index, array) in arrays.into_iter().enumerate() {
                let (first, end) = array.addresses();
                shared.keep_array(index, first, end);
            }
        }
        Ok(session)
    }

    /// CMNAME from now on.
    pub fn call_material(&mut self, name: &str) {
        self.name = [b' ' as c_char; 80];
        for (place, letter) in self.name.iter_mut().zip(name.to_uppercase().bytes()) {
            *place = letter as c_char;
        }
    }

    pub fn shared(&self) -> Option<Shared> {
        self.shared
    }

    /// Counts the calls but does not keep their arguments: of several threads one would write over the other's.
    pub fn without_records(mut self) -> Self {
        self.records = false;
        self
    }

    /// The state variables of a point before its first increment, by SDVINI if there is one.
    pub fn initial_state(&mut self, place: [i32; 2]) -> Vec<f64> {
        self.state.numbers_mut().copy_from_slice(&self.material.initial);
        if let Some(sdvini) = self.law.sdvini {
            if let Some(shared) = self.shared {
                shared.count();
            }
            let mut coordinates = [0.0; 3];
            let mut states = self.material.initial.len() as i32;
            let [mut element, mut point] = place;
            let [mut axes, mut layer, mut section] = [3, 1, 1];
            // SAFETY: the arguments that Abaqus passes, each as long as it is declared.
            unsafe {
                sdvini(
                    self.state.as_mut_ptr(),
                    coordinates.as_mut_ptr(),
                    &mut states,
                    &mut axes,
                    &mut element,
                    &mut point,
                    &mut layer,
                    &mut section,
                );
            }
        }
        self.state.numbers().to_vec()
    }

    /// The stress of a point before its first increment, by SIGINI if there is one.
    pub fn initial_stress(&mut self, place: [i32; 2]) -> Components {
        let mut stress = self.material.stress;
        if let Some(sigini) = self.law.sigini {
            if let Some(shared) = self.shared {
                shared.count();
            }
            let (mut coordinates, mut names) = ([0.0; 3], [[b' ' as c_char; 80]; 2]);
            let mut components = self.material.components as i32;
            let [mut element, mut point] = place;
            let [mut axes, mut layer, mut section, mut rebar] = [3, 1, 1, 0];
            // SAFETY: the arguments that Abaqus passes, each as long as it is declared.
            unsafe {
                sigini(
                    stress.as_mut_ptr(),
                    coordinates.as_mut_ptr(),
                    &mut components,
                    &mut axes,
                    &mut element,
                    &mut point,
                    &mut layer,
                    &mut section,
                    &mut rebar,
                    names.as_mut_ptr(),
                    80,
                );
            }
        }
        stress
    }

    /// Takes 13 and 23 for each other from now on, as a law does that was written for VUMAT's order; or no longer.
    pub fn exchange(&mut self, exchanged: bool) {
        self.exchanged = exchanged && self.material.components == 6;
    }

    /// Calls the UMAT.
    pub fn call_law(&mut self, call: &Call) -> Answer {
        if !self.exchanged {
            return self.call_law_in_order(call);
        }
        let (first, second) = PLACES;
        let mut call = call.clone();
        for values in [&mut call.stress, &mut call.strain, &mut call.strain_increment] {
            values.swap(first, second);
        }
        let mut answer = self.call_law_in_order(&call);
        answer.stress.swap(first, second);
        answer.modulus.swap(first, second);
        for row in &mut answer.modulus {
            row.swap(first, second);
        }
        answer
    }

    fn call_law_in_order(&mut self, call: &Call) -> Answer {
        if let Some(shared) = self.shared {
            if self.records { shared.record(&call.numbers()) } else { shared.count() }
        }
        let components = self.material.components;
        self.stress.numbers_mut().copy_from_slice(&call.stress[..components]);
        self.state.numbers_mut().copy_from_slice(&call.state);
        self.modulus.numbers_mut().fill(call.unset);
        self.constants.numbers_mut().copy_from_slice(&self.properties);
        let mut name = self.name;
        let [mut elastic, mut plastic, mut creep] = call.energies;
        let (mut heat, mut heat_by_temperature) = (0.0, 0.0);
        let (mut by_temperature, mut heat_by_strain) = ([0.0; 6], [0.0; 6]);
        let (mut strain, mut strain_increment) = (call.strain, call.strain_increment);
        let (mut time, mut time_step) = (call.time, call.time_step);
        let (mut temperature, mut temperature_step) = (call.temperature, 0.0);
        let (mut field, mut field_step) = ([0.0; 8], [0.0; 8]);
        let (mut coordinates, mut rotation) = ([0.0; 3], call.rotation);
        let (mut next_step, mut length) = (NO_WISH, 1.0);
        let (mut f0, mut f1) = (call.f0, call.f1);
        let mut direct = self.material.direct() as i32;
        let mut all = components as i32;
        let mut shear = all - direct;
        let mut states = call.state.len() as i32;
        let mut constants = self.properties.len() as i32;
        let [mut element, mut point] = call.place;
        let [mut layer, mut section, mut increment] = [1, 1, call.increment];
        // JSTEP: the step, a static one, NLGEOM=YES, no perturbation.
        let mut step = [call.step, 1, 1, 0];
        // SAFETY: the arguments of a UMAT, each as long as Abaqus declares it; matrices are in Fortran's order. What
        // the subroutine does beyond is its author's affair, and this process is there to bear it.
        unsafe {
            (self.law.umat)(
                self.stress.as_mut_ptr(),
                self.state.as_mut_ptr(),
                self.modulus.as_mut_ptr(),
                &mut elastic,
                &mut plastic,
                &mut creep,
                &mut heat,
                by_temperature.as_mut_ptr(),
                heat_by_strain.as_mut_ptr(),
                &mut heat_by_temperature,
                strain.as_mut_ptr(),
                strain_increment.as_mut_ptr(),
                time.as_mut_ptr(),
                &mut time_step,
                &mut temperature,
                &mut temperature_step,
                field.as_mut_ptr(),
                field_step.as_mut_ptr(),
                name.as_mut_ptr(),
                &mut direct,
                &mut shear,
                &mut all,
                &mut states,
                self.constants.as_mut_ptr(),
                &mut constants,
                coordinates.as_mut_ptr(),
                rotation.as_mut_slice().as_mut_ptr(),
                &mut next_step,
                &mut length,
                f0.as_mut_slice().as_mut_ptr(),
                f1.as_mut_slice().as_mut_ptr(),
                &mut element,
                &mut point,
                &mut layer,
                &mut section,
                step.as_mut_ptr(),
                &mut increment,
                self.name.len(),
            );
        }
        if let Some(watched) = &mut self.watched {
            let changed = |before: &[f64], after: &[f64]| {
                !before.iter().map(|value| value.to_bits()).eq(after.iter().map(|value| value.to_bits()))
            };
            let counts = [
                (direct, self.material.direct() as i32),
                (all, components as i32),
                (states, call.state.len() as i32),
                (constants, self.properties.len() as i32),
                (element, call.place[0]),
                (point, call.place[1]),
                (increment, call.increment),
                (step[0], call.step),
            ];
            let inputs = [
                ("PROPS", changed(&self.properties, self.constants.numbers())),
                ("STRAN", changed(&call.strain, &strain)),
                ("DSTRAN", changed(&call.strain_increment, &strain_increment)),
                ("DFGRD0", changed(call.f0.as_slice(), f0.as_slice())),
                ("DFGRD1", changed(call.f1.as_slice(), f1.as_slice())),
                ("DROT", changed(call.rotation.as_slice(), rotation.as_slice())),
                ("TIME", changed(&call.time, &time)),
                ("DTIME", changed(&[call.time_step], &[time_step])),
                ("TEMP", changed(&[call.temperature], &[temperature])),
                ("a count or number", counts.iter().any(|(after, before)| after != before)),
            ];
            for (name, changed) in inputs {
                if changed && !watched.contains(&name) {
                    watched.push(name);
                }
            }
        }
        let mut answer = Answer {
            stress: [0.0; 6],
            state: self.state.numbers().to_vec(),
            modulus: [[0.0; 6]; 6],
            energies: [elastic, plastic, creep],
            next_step,
        };
        answer.stress[..components].copy_from_slice(self.stress.numbers());
        for (index, &entry) in self.modulus.numbers().iter().enumerate() {
            answer.modulus[index % components][index / components] = entry;
        }
        answer
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_call_comes_back_from_its_numbers() {
        let call = Call {
            stress: [1.0, 2.0, 3.0, 4.0, 5.0, 6.0],
            state: vec![7.0, 8.0],
            energies: [9.0, 10.0, 11.0],
            strain: [12.0; 6],
            strain_increment: [13.0; 6],
            time: [14.0, 15.0],
            time_step: 16.0,
            temperature: 17.0,
            rotation: Matrix3::new(1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0),
            f0: Matrix3::identity(),
            f1: Matrix3::identity() * 2.0,
            place: [3, 4],
            increment: 5,
            unset: 0.0,
            step: 2,
        };
        assert_eq!(Call::from_numbers(&call.numbers()), Some(call.clone()));
        let numbers = call.numbers();
        // Files of earlier versions have no KSTEP.
        let without = &numbers[..numbers.len() - 1];
        assert_eq!(Call::from_numbers(without).map(|call| call.step), Some(1));
        assert_eq!(Call::from_numbers(&without[..without.len() - 1]), None);
    }
}
