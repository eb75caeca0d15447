//! One call of a VUMAT: the arguments exactly as Abaqus/Explicit passes them, and what comes back.

use std::ffi::{c_char, c_void};
use std::io;
use std::path::Path;

use super::super::call::{open, write_counts};
use super::super::guarded::{Guard, GuardedArray};
use super::super::material::Material;
use super::super::shared_memory::{OF_UMAT, OF_VUMAT, Shared};

/// `real*8` or, in a build for single precision, `real*4`.
type Reals = *mut c_void;
/// A law may write to what is its caller's own.
type Whole = *mut i32;

/// `SUBROUTINE VUMAT(NBLOCK, NDIR, NSHR, ...)`, with the length of CMNAME behind the last argument.
type Vumat = unsafe extern "C" fn(
    Whole,         // nblock, npt, layer, kspt, noel(nblock)
    Whole,         // ndir
    Whole,         // nshr
    Whole,         // nstatev
    Whole,         // nfieldv
    Whole,         // nprops
    Whole,         // lanneal, or jInfoArray
    Reals,         // stepTime
    Reals,         // totalTime
    Reals,         // dt, or dtArray
    *const c_char, // cmname
    Reals,         // coordMp
    Reals,         // charLength
    Reals,         // props
    Reals,         // density
    Reals,         // strainInc
    Reals,         // relSpinInc
    Reals,         // tempOld
    Reals,         // stretchOld
    Reals,         // defgradOld
    Reals,         // fieldOld
    Reals,         // stressOld
    Reals,         // stateOld
    Reals,         // enerInternOld
    Reals,         // enerInelasOld
    Reals,         // tempNew
    Reals,         // stretchNew
    Reals,         // defgradNew
    Reals,         // fieldNew
    Reals,         // stressNew
    Reals,         // stateNew
    Reals,         // enerInternNew
    Reals,         // enerInelasNew
    usize,
);

/// A loaded library's subroutine.
pub struct Law {
    vumat: Vumat,
    library: libloading::Library,
}

/// The names that compilers give a subroutine.
fn symbols(name: &str) -> [String; 3] {
    [format!("{name}_"), name.to_uppercase(), name.to_string()]
}

/// Whether a library has a VUMAT and no UMAT.
///
/// # Errors
/// It cannot be loaded.
pub fn only_vumat(path: &Path) -> Result<bool, String> {
    let library = open(path)?;
    let has = |name: &str| {
        // SAFETY: only whether there is such a symbol is asked.
        symbols(name).iter().any(|symbol| unsafe { library.get::<*const c_void>(symbol.as_bytes()) }.is_ok())
    };
    Ok(has("vumat") && !has("umat"))
}

impl Law {
    /// Loads a library; symbols that are missing are looked for when they are called.
    ///
    /// # Errors
    /// It cannot be loaded, or has no VUMAT.
    pub fn load(path: &Path) -> Result<Law, String> {
        let library = open(path)?;
        let vumat = symbols("vumat").iter().find_map(|symbol| {
            // SAFETY: the type is that of the subroutine of this name.
            unsafe { library.get::<Vumat>(symbol.as_bytes()) }.ok().map(|symbol| *symbol)
        });
        Ok(Law { vumat: vumat.ok_or("there is no subroutine VUMAT")?, library })
    }
}

impl Law {
    /// Has a build that counts its lines write the counts; whether it is one.
    pub fn write_counts(&self) -> bool {
        write_counts(&self.library)
    }
}

/// What reals are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    Double,
    Single,
}

/// stepTime and totalTime, which are the same here, and dt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Time {
    pub end: f64,
    pub step: f64,
}

impl Time {
    /// The call before all others, by which Abaqus finds the speed of waves.
    pub fn data_check(material: &Material) -> Time {
        Time { end: 0.0, step: material.time_step }
    }
}

/// 11 22 33 12 23 31; plane elements have the first four.
pub type Components = [f64; 6];

/// What a call gets of a point.
#[derive(Clone, Debug, PartialEq)]
pub struct PointInput {
    pub density: f64,
    /// Tensor components.
    pub strain_increment: Components,
    /// The rotation vector of the increment beyond that of the axes.
    pub spin: [f64; 3],
    pub stretch: [Components; 2],
    /// 11 22 33 12 23 31 21 32 13.
    pub gradient: [[f64; 9]; 2],
    pub stress: Components,
    pub state: Vec<f64>,
    /// enerInternOld, enerInelasOld.
    pub energies: [f64; 2],
    pub temperature: f64,
}

/// What a call gives of a point.
#[derive(Clone, Debug, PartialEq)]
pub struct PointOutput {
    pub stress: Components,
    pub state: Vec<f64>,
    /// enerInternNew, enerInelasNew.
    pub energies: [f64; 2],
}

impl PointOutput {
    pub fn numbers(&self) -> impl Iterator<Item = f64> + '_ {
        self.stress.iter().chain(&self.state).chain(&self.energies).copied()
    }

    pub fn finite(&self) -> bool {
        self.numbers().all(f64::is_finite)
    }

    /// Every bit is the same; a NaN equals itself.
    pub fn has_same_bits(&self, other: &PointOutput) -> bool {
        self.numbers().map(f64::to_bits).eq(other.numbers().map(f64::to_bits))
    }

    /// What differs first, in words.
    pub fn difference(&self, other: &PointOutput) -> String {
        let differ = |a: &[f64], b: &[f64]| a.iter().zip(b).position(|(a, b)| a.to_bits() != b.to_bits());
        if let Some(c) = differ(&self.stress, &other.stress) {
            format!("stressNew(:, {})", c + 1)
        } else if let Some(c) = differ(&self.state, &other.state) {
            format!("stateNew(:, {})", c + 1)
        } else if differ(&self.energies[..1], &other.energies[..1]).is_some() {
            "enerInternNew".to_string()
        } else {
            "enerInelasNew".to_string()
        }
    }
}

/// Arrays in the order of [`OF_VUMAT`].
#[derive(Clone, Copy)]
enum Array {
    Position,
    Length,
    Properties,
    Density,
    StrainIncrement,
    Spin,
    TemperatureOld,
    StretchOld,
    GradientOld,
    FieldOld,
    StressOld,
    StateOld,
    InternalOld,
    InelasticOld,
    TemperatureNew,
    StretchNew,
    GradientNew,
    FieldNew,
    StressNew,
    StateNew,
    InternalNew,
    InelasticNew,
}

const ARRAYS: usize = OF_VUMAT.len();
/// The first array that the law writes to.
const WRITTEN: usize = Array::StressNew as usize;

/// Arrays for blocks of one size, each between pages that must not be touched.
struct Arrays {
    points: usize,
    arrays: Vec<GuardedArray>,
    precision: Precision,
}

impl Arrays {
    fn new(points: usize, material: &Material, precision: Precision, guard: Guard) -> io::Result<Arrays> {
        let tensor = material.components;
        let gradient = if tensor == 6 { 9 } else { 5 };
        let states = material.initial.len();
        let components: [usize; ARRAYS] =
            [3, 1, 0, 1, tensor, tensor - 3, 1, tensor, gradient, 0, tensor, states, 1, 1, 1, tensor, gradient, 0]
                .into_iter()
                .chain([tensor, states, 1, 1])
                .collect::<Vec<_>>()
                .try_into()
                .unwrap_or([0; ARRAYS]);
        let arrays = components.iter().enumerate().map(|(index, &count)| {
            let length = if index == Array::Properties as usize { material.properties.len() } else { points * count };
            GuardedArray::new(length, guard)
        });
        Ok(Arrays { points, arrays: arrays.collect::<io::Result<_>>()?, precision })
    }

    /// Component `c` of point `i`.
    fn put(&mut self, array: Array, c: usize, i: usize, value: f64) {
        let (place, array) = (c * self.points + i, &mut self.arrays[array as usize]);
        match self.precision {
            Precision::Double => array.numbers_mut()[place] = value,
            Precision::Single => array.single_mut()[place] = value as f32,
        }
    }

    fn take(&self, array: Array, c: usize, i: usize) -> f64 {
        let (place, array) = (c * self.points + i, &self.arrays[array as usize]);
        match self.precision {
            Precision::Double => array.numbers()[place],
            Precision::Single => f64::from(array.single()[place]),
        }
    }

    fn pointer(&mut self, array: Array) -> Reals {
        self.arrays[array as usize].as_mut_ptr().cast()
    }

    /// The bits of all that the law must not write to.
    fn read_only(&self) -> Vec<Vec<u64>> {
        let bits = |array: &GuardedArray| array.numbers().iter().map(|value| value.to_bits()).collect();
        self.arrays[..WRITTEN].iter().map(bits).collect()
    }
}

/// How a law may have misread the arguments: a session that alters them so gets right answers from it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Misread {
    /// 13 and 23 as a UMAT has them, in the place of 23 and 31.
    Order,
    /// Shears of strainInc that are twice the tensor's.
    Shears,
}

impl Misread {
    pub const ALL: [Misread; 2] = [Misread::Order, Misread::Shears];

    pub fn name(self) -> &'static str {
        match self {
            Misread::Order => "23 and 31 exchanged",
            Misread::Shears => "engineering shears",
        }
    }

    fn given(self, given: &PointInput) -> PointInput {
        let mut given = given.clone();
        match self {
            Misread::Order => {
                for values in [&mut given.strain_increment, &mut given.stress].into_iter().chain(&mut given.stretch) {
                    values.swap(4, 5);
                }
            }
            Misread::Shears => {
                for shear in &mut given.strain_increment[3..] {
                    *shear *= 2.0;
                }
            }
        }
        given
    }
}

/// WorkDir for the calls of one thread.
pub struct Session<'a> {
    law: &'a Law,
    pub material: &'a Material,
    name: [c_char; 80],
    precision: Precision,
    guard: Guard,
    arrays: Option<Arrays>,
    shared: Option<Shared>,
    /// What outputs are before a call.
    pub unset: f64,
    /// The state of a point that has not been deformed, once it is known.
    pub undeformed: Option<Vec<f64>>,
    /// What arguments are altered by.
    pub misread: Option<Misread>,
    /// Elements have the numbers of their points in the block, and not all 1.
    pub numbered: bool,
}

impl<'a> Session<'a> {
    pub fn new(
        law: &'a Law,
        material: &'a Material,
        precision: Precision,
        guard: Guard,
        shared: Option<Shared>,
    ) -> Session<'a> {
        let mut name = [b' ' as c_char; 80];
        for (place, letter) in name.iter_mut().zip(material.name.to_uppercase().bytes()) {
            *place = letter as c_char;
        }
        Session {
            law,
            material,
            name,
            precision,
            guard,
            arrays: None,
            shared,
            unset: 0.0,
            undeformed: None,
            misread: None,
            numbered: false,
        }
    }

    /// Another one for a thread, with room at both ends of its arrays.
    pub fn for_thread(&self, law: &'a Law) -> Session<'a> {
        let undeformed = self.undeformed.clone();
        Session { undeformed, ..Session::new(law, self.material, self.precision, Guard::Padded, self.shared) }
    }

    /// Calls the VUMAT for a block.
    ///
    /// # Errors
    /// The system has no memory.
    pub fn call_law(&mut self, time: Time, points: &[PointInput]) -> io::Result<Vec<PointOutput>> {
        let count = points.len();
        let material = self.material;
        let mut arrays = match self.arrays.take() {
            Some(arrays) if arrays.points == count => arrays,
            _ => {
                let arrays = Arrays::new(count, material, self.precision, self.guard)?;
                // Threads have room at the ends of their arrays, and would write over each other's.
                if let Some(shared) = self.shared.filter(|_| self.guard != Guard::Padded) {
                    for (index, array) in arrays.arrays.iter().enumerate() {
                        let (first, end) = array.addresses();
                        shared.keep_array(OF_UMAT.len() + index, first, end);
                    }
                }
                arrays
            }
        };
        if let Some(shared) = self.shared {
            shared.count();
        }
        match self.misread {
            None => self.fill(&mut arrays, points),
            Some(misread) => {
                let altered: Vec<PointInput> = points.iter().map(|given| misread.given(given)).collect();
                self.fill(&mut arrays, &altered);
            }
        }
        self.call(&mut arrays, time);
        let found = (0..count).map(|i| self.found(&arrays, i)).collect();
        self.arrays = Some(arrays);
        Ok(found)
    }

    /// The arguments that a call changes though it must not.
    ///
    /// # Errors
    /// The system has no memory.
    pub fn overwritten(&mut self, time: Time, points: &[PointInput]) -> io::Result<Vec<&'static str>> {
        let mut arrays = Arrays::new(points.len(), self.material, self.precision, Guard::Padded)?;
        self.fill(&mut arrays, points);
        let before = arrays.read_only();
        self.call(&mut arrays, time);
        let changed = arrays.read_only().into_iter().zip(before).zip(OF_VUMAT);
        Ok(changed.filter(|((after, before), _)| after != before).map(|(_, name)| name).collect())
    }

    fn fill(&self, arrays: &mut Arrays, points: &[PointInput]) {
        let tensor = self.material.components;
        let gradient = gradient_places(tensor);
        for (i, &value) in self.material.properties.iter().enumerate() {
            // One row, however many points there are.
            match self.precision {
                Precision::Double => arrays.arrays[Array::Properties as usize].numbers_mut()[i] = value,
                Precision::Single => arrays.arrays[Array::Properties as usize].single_mut()[i] = value as f32,
            }
        }
        for (i, point) in points.iter().enumerate() {
            for c in 0..3 {
                arrays.put(Array::Position, c, i, 0.0);
            }
            arrays.put(Array::Length, 0, i, 1.0);
            arrays.put(Array::Density, 0, i, point.density);
            for array in [Array::TemperatureOld, Array::TemperatureNew] {
                arrays.put(array, 0, i, point.temperature);
            }
            for c in 0..tensor {
                arrays.put(Array::StrainIncrement, c, i, point.strain_increment[c]);
                arrays.put(Array::StretchOld, c, i, point.stretch[0][c]);
                arrays.put(Array::StretchNew, c, i, point.stretch[1][c]);
                arrays.put(Array::StressOld, c, i, point.stress[c]);
                arrays.put(Array::StressNew, c, i, self.unset);
            }
            // Of plane elements about the third axis.
            let spins = if tensor == 6 { &[0, 1, 2][..] } else { &[2] };
            for (c, &spin) in spins.iter().enumerate() {
                arrays.put(Array::Spin, c, i, point.spin[spin]);
            }
            for (c, &place) in gradient.iter().enumerate() {
                arrays.put(Array::GradientOld, c, i, point.gradient[0][place]);
                arrays.put(Array::GradientNew, c, i, point.gradient[1][place]);
            }
            for (c, &value) in point.state.iter().enumerate() {
                arrays.put(Array::StateOld, c, i, value);
                arrays.put(Array::StateNew, c, i, self.unset);
            }
            arrays.put(Array::InternalOld, 0, i, point.energies[0]);
            arrays.put(Array::InelasticOld, 0, i, point.energies[1]);
            arrays.put(Array::InternalNew, 0, i, self.unset);
            arrays.put(Array::InelasticNew, 0, i, self.unset);
        }
    }

    /// nblock and lanneal, each with what stands behind it.
    fn whole_numbers(&self, points: usize) -> [Vec<i32>; 2] {
        let elements = |k: usize| if self.numbered { k as i32 } else { 1 };
        let elements: Vec<i32> = (1..=points).map(elements).collect();
        // The first argument of laws that declare it as JBLOCK(*) has the elements' numbers behind.
        let block = [points as i32, 1, 1, 1].into_iter().chain(elements.clone()).collect();
        // lanneal, or in newer versions jInfoArray, whose first entry it is: integration point, layer, section point,
        // whether moduli are asked for, and where the elements' numbers begin.
        let information = [0, 1, 1, 1, 0, 7].into_iter().chain(elements).collect();
        [block, information]
    }

    fn call(&self, arrays: &mut Arrays, time: Time) {
        let [mut block, mut information] = self.whole_numbers(arrays.points);
        let [mut direct, mut shear] = [3, self.material.components as i32 - 3];
        let mut states = self.material.initial.len() as i32;
        let mut fields = 0;
        let mut constants = self.material.properties.len() as i32;
        // dt, or in newer versions dtArray, whose first entry it is, with two more for each point.
        let mut times = vec![0.0; 3 + 2 * arrays.points];
        times[..3].copy_from_slice(&[time.end, time.end, time.step]);
        let mut single: Vec<f32> = times.iter().map(|&time| time as f32).collect();
        let precision = self.precision;
        let mut scalar = |index: usize| -> Reals {
            match precision {
                Precision::Double => times[index..].as_mut_ptr().cast(),
                Precision::Single => single[index..].as_mut_ptr().cast(),
            }
        };
        let [step_time, total_time, increment] = [scalar(0), scalar(1), scalar(2)];
        use Array::*;
        // SAFETY: the arguments of a VUMAT, each as long as Abaqus declares it, of the precision that the library is
        // built for. What the subroutine does beyond is its author's affair, and this process is there to bear it.
        unsafe {
            (self.law.vumat)(
                block.as_mut_ptr(),
                &mut direct,
                &mut shear,
                &mut states,
                &mut fields,
                &mut constants,
                information.as_mut_ptr(),
                step_time,
                total_time,
                increment,
                self.name.as_ptr(),
                arrays.pointer(Position),
                arrays.pointer(Length),
                arrays.pointer(Properties),
                arrays.pointer(Density),
                arrays.pointer(StrainIncrement),
                arrays.pointer(Spin),
                arrays.pointer(TemperatureOld),
                arrays.pointer(StretchOld),
                arrays.pointer(GradientOld),
                arrays.pointer(FieldOld),
                arrays.pointer(StressOld),
                arrays.pointer(StateOld),
                arrays.pointer(InternalOld),
                arrays.pointer(InelasticOld),
                arrays.pointer(TemperatureNew),
                arrays.pointer(StretchNew),
                arrays.pointer(GradientNew),
                arrays.pointer(FieldNew),
                arrays.pointer(StressNew),
                arrays.pointer(StateNew),
                arrays.pointer(InternalNew),
                arrays.pointer(InelasticNew),
                self.name.len(),
            );
        }
    }

    fn found(&self, arrays: &Arrays, i: usize) -> PointOutput {
        let mut stress = [0.0; 6];
        for (c, value) in stress.iter_mut().enumerate().take(self.material.components) {
            *value = arrays.take(Array::StressNew, c, i);
        }
        if self.misread == Some(Misread::Order) {
            stress.swap(4, 5);
        }
        PointOutput {
            stress,
            state: (0..self.material.initial.len()).map(|c| arrays.take(Array::StateNew, c, i)).collect(),
            energies: [arrays.take(Array::InternalNew, 0, i), arrays.take(Array::InelasticNew, 0, i)],
        }
    }
}

/// Which of the nine components of F are passed: plane elements have 11 22 33 12 21.
fn gradient_places(components: usize) -> &'static [usize] {
    if components == 6 { &[0, 1, 2, 3, 4, 5, 6, 7, 8] } else { &[0, 1, 2, 3, 6] }
}
