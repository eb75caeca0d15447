//! One call of a UMAT: the arguments exactly as Abaqus/Standard passes them, and what comes back.

use std::ffi::c_char;
use std::io;
use std::path::Path;

use nalgebra::Matrix3;

use super::arguments::{Arguments, Reals, Umat, Whole};
use super::guarded::{Guard, GuardedArray};
use super::kinematics::{Components, Modulus};
use super::material::{MOST_FIELDS, Material};
use super::shared_memory::Shared;

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
    /// It cannot be loaded, or has no UMAT, or nothing of the name that it should have.
    pub fn load(path: &Path, name: Option<&str>) -> Result<Law, String> {
        let library = open(path)?;
        let umat = symbol::<Umat>(&library, name.unwrap_or("umat")).ok_or_else(|| without_umat(path, name))?;
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

/// Opens a law's library: its own routines are looked for before those of other libraries.
///
/// # Errors
/// It cannot be loaded.
pub fn open(path: &Path) -> Result<libloading::Library, String> {
    opened(path, libc::RTLD_LAZY | libc::RTLD_LOCAL | libc::RTLD_DEEPBIND)
}

/// Opens the routines of Abaqus, for the law's library to find.
///
/// # Errors
/// They cannot be loaded.
pub fn open_utilities(path: &Path) -> Result<libloading::Library, String> {
    opened(path, libc::RTLD_LAZY | libc::RTLD_GLOBAL)
}

fn opened(path: &Path, flags: libc::c_int) -> Result<libloading::Library, String> {
    use libloading::os::unix::Library;
    // SAFETY: what a library does as it is loaded is its author's affair; this process is there to bear it.
    let library = unsafe { Library::open(Some(path), flags) };
    library.map(libloading::Library::from).map_err(|error| why(&error))
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
fn without_umat(path: &Path, wanted: Option<&str>) -> String {
    if let Some(name) = wanted {
        return format!("there is no subroutine {name}");
    }
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
    [
        format!("{name}_"),
        name.to_uppercase(),
        name.to_string(),
        format!("{}_", name.to_lowercase()),
        name.to_lowercase(),
    ]
    .iter()
    .find_map(|name| {
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
    /// DTEMP.
    pub temperature_step: f64,
}

impl Call {
    /// As a cohesive element passes it: a strain of 1 inside is a separation of one unit, and nothing else is deformed.
    pub fn with_separations(&self, unit: f64) -> Call {
        let identity = Matrix3::identity();
        Call {
            strain: self.strain.map(|strain| strain * unit),
            strain_increment: self.strain_increment.map(|strain| strain * unit),
            energies: self.energies.map(|energy| energy * unit),
            rotation: identity,
            f0: identity,
            f1: identity,
            ..self.clone()
        }
    }

    /// As numbers in a row, for [`Shared`] and files.
    pub fn numbers(&self) -> Vec<f64> {
        self.named().into_iter().flat_map(|(_, numbers)| numbers).collect()
    }

    /// The numbers of the row with their names, in order.
    pub fn named(&self) -> [(&'static str, Vec<f64>); 17] {
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
            ("DTEMP", vec![self.temperature_step]),
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
            temperature_step: take(1).map_or(0.0, |step| step[0]),
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
    /// DDSDDT.
    pub by_temperature: Components,
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
    pub fn has_same_bits(&self, other: &Answer) -> bool {
        let bits = |answer: &Answer| {
            let modulus = answer.modulus.iter().flatten();
            let all = answer.stress.iter().chain(&answer.state).chain(modulus).chain(&answer.energies);
            all.map(|value| value.to_bits()).collect::<Vec<_>>()
        };
        bits(self) == bits(other)
    }
}

/// PNEWDT before a call; Abaqus sets it to a large number.
pub const NO_WISH: f64 = 1e36;

/// WorkDir for the calls of one thread.
pub struct Session<'a> {
    law: &'a Law,
    pub material: &'a Material,
    name: [c_char; 80],
    /// PROPS, at first those of the material.
    pub properties: Vec<f64>,
    /// PREDEF and DPRED.
    pub fields: [[f64; MOST_FIELDS]; 2],
    /// Whether inputs that a call writes to are noted, and which these are.
    pub watched: Option<Vec<&'static str>>,
    /// The stress moves in steps: differences are to be taken of large ones.
    pub coarse: bool,
    /// The first PNEWDT that is not larger than 0.
    pub no_step: Option<f64>,
    stress: GuardedArray,
    state: GuardedArray,
    modulus: GuardedArray,
    constants: GuardedArray,
    shared: Option<Shared>,
    records: bool,
    exchanged: bool,
    halved: bool,
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
            stress: GuardedArray::new(components, guard)?,
            state: GuardedArray::new(material.initial.len(), guard)?,
            modulus: GuardedArray::new(components * components, guard)?,
            properties: material.properties.clone(),
            fields: material.passed_fields(),
            watched: None,
            coarse: false,
            no_step: None,
            constants: GuardedArray::new(material.properties.len(), guard)?,
            shared,
            records: true,
            exchanged: false,
            halved: false,
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

    /// Has strains with the tensor's shears from now on, half of those that Abaqus passes; or no longer.
    pub fn halve_shears(&mut self, halved: bool) {
        self.halved = halved && self.material.separation.is_none();
    }

    /// Calls the UMAT.
    pub fn call_law(&mut self, call: &Call) -> Answer {
        if self.halved {
            let mut call = call.clone();
            for values in [&mut call.strain, &mut call.strain_increment] {
                values.iter_mut().skip(self.material.direct()).for_each(|shear| *shear *= 0.5);
            }
            return self.call_law_in_order(&call);
        }
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
        if self.material.separation.is_none() {
            return self.call_as_it_is(call);
        }
        let unit = self.material.unit_of_strain();
        let mut answer = self.call_as_it_is(&call.with_separations(unit));
        answer.modulus = answer.modulus.map(|row| row.map(|entry| entry * unit));
        answer.energies = answer.energies.map(|energy| energy / unit);
        answer
    }

    /// The same of a call as the law sees it.
    pub fn call_as_it_is(&mut self, call: &Call) -> Answer {
        let components = self.material.components;
        self.stress.numbers_mut().copy_from_slice(&call.stress[..components]);
        self.state.numbers_mut().copy_from_slice(&call.state);
        self.modulus.numbers_mut().fill(call.unset);
        self.constants.numbers_mut().copy_from_slice(&self.properties);
        let mut arguments = Arguments::new(call, self.material, self.properties.len(), self.fields);
        let arrays = [&mut self.stress, &mut self.state, &mut self.modulus, &mut self.constants];
        arguments.pass(self.law.umat, arrays.map(GuardedArray::as_mut_ptr), self.name);
        if let Some(watched) = &mut self.watched {
            arguments.note_written(call, &self.fields, &self.properties, self.constants.numbers(), watched);
        }
        let mut answer = Answer {
            stress: [0.0; 6],
            state: self.state.numbers().to_vec(),
            modulus: [[0.0; 6]; 6],
            energies: arguments.energies,
            next_step: arguments.next_step,
            by_temperature: arguments.by_temperature,
        };
        if answer.next_step.is_nan() || answer.next_step <= 0.0 {
            self.no_step.get_or_insert(answer.next_step);
        }
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
            temperature_step: 6.0,
        };
        assert_eq!(Call::from_numbers(&call.numbers()), Some(call.clone()));
        let numbers = call.numbers();
        // Files of earlier versions have neither KSTEP nor DTEMP.
        let without = &numbers[..numbers.len() - 2];
        assert_eq!(Call::from_numbers(without).map(|call| call.step), Some(1));
        assert_eq!(Call::from_numbers(&without[..without.len() - 1]), None);
    }
}
